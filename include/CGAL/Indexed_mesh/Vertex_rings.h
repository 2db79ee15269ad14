// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_VERTEX_RINGS_H
#define CGAL_INDEXED_MESH_VERTEX_RINGS_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/internal/Ring_lines.h>
#include <CGAL/Indexed_mesh/internal/link_rings.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/*!
\ingroup PkgHLSCMIndexedMesh

The class `Vertex_rings` is the connectivity of a triangle mesh that collapses make coarser: one
ring of neighbours a vertex, counterclockwise. Linear time to build; 64 bytes a vertex.
*/
//
//           r2 ---- r1        The triangles at v are (v, r_i, r_i+1). Inside the surface the ring
//          /  \    /  \       is closed and may begin anywhere; at the border it is open and
//        r3 --- v --- r0      begins and ends with the two border neighbours.
//          \  /    \  /
//           r4 ---- r5
//
// The ring of a removed vertex is left as it was.
class Vertex_rings
  : private internal::Ring_lines
{
public:
  using internal::Ring_lines::degree;
  using internal::Ring_lines::is_border;
  using internal::Ring_lines::line_capacity;
  using internal::Ring_lines::prefetch;
  using internal::Ring_lines::ring;
  using internal::Ring_lines::size;
  using internal::Ring_lines::small_degree;

  /// Has no vertices.
  Vertex_rings() {}

  /// Builds the rings of `mesh`; `defect()` says whether they exist.
  explicit Vertex_rings(const Indexed_triangle_mesh& mesh) : m_defect(internal::link_rings(mesh, *this)) {}

  /// Returns the first vertex whose triangles do not form one fan, or `no_vertex`.
  Vertex_index defective_vertex() const { return m_defect.vertex; }
  /// Returns what is wrong with that vertex.
  Ring_defect defect() const { return m_defect.defect; }

  /// Returns whether the collapse of v into ring vertex k keeps a manifold of the same topology: v
  /// and r_k have only the opposite vertices of their common triangles as common neighbours, and no
  // triangle pair is folded onto another.
  bool is_collapse_valid(Vertex_index v, std::uint32_t k) const;

  /// Whether the ring of the kept vertex would have to leave its line, which only one thread may do.
  bool needs_new_spill(Vertex_index v, std::uint32_t k) const
  {
    const Vertex_index t = ring(v)[k];
    const std::uint32_t gained = degree(v) - (is_border(v) ? 2 : 3);
    return !is_spilled(t) && degree(t) - 1 + gained > line_capacity;
  }

  /// Collapses v into its ring vertex k. Precondition: `is_collapse_valid(v, k)`.
  void collapse(Vertex_index v, std::uint32_t k);

private:
  internal::Defective_vertex m_defect;
};

inline bool Vertex_rings::is_collapse_valid(Vertex_index v, std::uint32_t k) const
{
  const Vertex_index* r = ring(v);
  const std::uint32_t d = degree(v);
  const Vertex_index t = r[k];
  const bool border = is_border(v);
  if(border && k != 0 && k + 1 != d)
    return false;
  // The opposite vertices of the triangles that die, and what they must keep
  const std::uint32_t before = k == 0 ? d - 1 : k - 1;
  const std::uint32_t after = k + 1 == d ? 0 : k + 1;
  const bool has_before = !border || k != 0;
  const bool has_after = !border || k + 1 != d;
  for(const auto& side : {std::make_pair(has_before, before), std::make_pair(has_after, after)})
    if(side.first && degree(r[side.second]) <= (is_border(r[side.second]) ? 2u : 3u))
      return false;
  if(border && d == 2 && degree(t) == 2) // a single triangle
    return false;
  const Vertex_index* q = ring(t);
  const std::uint32_t e = degree(t);
  for(std::uint32_t i = 0; i < d; ++i) {
    if(i == k || (has_before && i == before) || (has_after && i == after))
      continue;
    for(std::uint32_t j = 0; j < e; ++j)
      if(q[j] == r[i])
        return false;
  }
  return true;
}

//        a                    a             In the ring of t the vertex v gives way to the ring
//      / | \                / |             vertices of v strictly between b and a; in the rings
//     .. v -- t    ->     .. -- t           of a and b it disappears; in all others it becomes t.
//      \ | /                \ |
//        b                    b
inline void Vertex_rings::collapse(Vertex_index v, std::uint32_t k)
{
  CGAL_precondition(is_collapse_valid(v, k));
  const Vertex_index* r = ring(v);
  const std::uint32_t d = degree(v);
  const Vertex_index t = r[k];
  const bool border = is_border(v);
  const bool has_before = !border || k != 0;     // a = r[k - 1] exists
  const bool has_after = !border || k + 1 != d;  // b = r[k + 1] exists
  // The ring vertices that become neighbours of t, counterclockwise from b to a
  std::uint32_t first = k + (has_after ? 2 : 1);
  const std::uint32_t count = d - 1 - (has_before ? 1 : 0) - (has_after ? 1 : 0);
  Vertex_index small[line_capacity];
  std::vector<Vertex_index> large;
  Vertex_index* moved = small;
  if(count > line_capacity) {
    large.resize(count);
    moved = large.data();
  }
  if(!has_after) // k is the last: those between r[0] and a
    first = 0;
  for(std::uint32_t i = 0; i < count; ++i) {
    moved[i] = r[(first + i) % d];
    replace(moved[i], v, t);
  }
  if(has_before) {
    const Vertex_index a = r[k == 0 ? d - 1 : k - 1];
    erase(a, position(a, v));
  }
  if(has_after) {
    const Vertex_index b = r[k + 1 == d ? 0 : k + 1];
    erase(b, position(b, v));
  }
  splice(t, position(t, v), moved, count);
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_VERTEX_RINGS_H
