// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_VERTEX_RINGS_H
#define CGAL_INDEXED_MESH_VERTEX_RINGS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/internal/Ring_lines.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// A triangle (v, a, b) as seen from its corner v.
typedef std::array<Vertex_index, 2> Ring_wedge;

struct Defective_vertex
{
  Ring_defect defect = Ring_defect::NONE;
  Vertex_index vertex = no_vertex;
};

// The common case: few wedges that form one fan. Returns false, for the careful version to say
// why, if they do not.
inline bool link_small_fan(Vertex_index v, const Ring_wedge* wedges, std::uint32_t count,
                           Ring_lines& lines)
{
  if(count == 0 || count >= Ring_lines::line_capacity)
    return false;
  std::uint32_t start = 0, number_of_starts = 0;
  for(std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t predecessors = 0;
    for(std::uint32_t j = 0; j < count; ++j)
      predecessors += wedges[j][1] == wedges[i][0];
    if(predecessors > 1) // a repeated halfedge: the walk below would run in a circle
      return false;
    if(predecessors == 0) {
      start = i;
      ++number_of_starts;
    }
  }
  Vertex_index* ring = lines.line(v);
  std::uint32_t used = 0, at = start;
  for(; used < count; ++used) {
    ring[used] = wedges[at][0];
    std::uint32_t successor = 0;
    while(successor < count && wedges[successor][0] != wedges[at][1])
      ++successor;
    if(successor == count || successor == start) {
      ++used;
      break;
    }
    at = successor;
  }
  const bool border = number_of_starts > 0;
  if(border)
    ring[count] = wedges[at][1];
  lines.set_line(v, count + (border ? 1 : 0), border);
  // A repeated halfedge leaves a wedge out, or another start
  return used == count && number_of_starts <= 1 && (border || wedges[at][1] == wedges[start][0]);
}

// Orders the wedges (a, b) of the triangles (v, a, b) into a ring.
inline Ring_defect link_fan(Vertex_index v, std::vector<Ring_wedge>& wedges, Ring_lines& lines)
{
  if(wedges.empty())
    return Ring_defect::ISOLATED;
  // Sorted by their first vertex, a wedge finds its successor by bisection.
  std::sort(wedges.begin(), wedges.end());
  const auto find = [&wedges](Vertex_index a) {
    const auto it = std::lower_bound(wedges.begin(), wedges.end(), Ring_wedge{a, 0});
    return (it != wedges.end() && (*it)[0] == a) ? it : wedges.end();
  };
  std::vector<Vertex_index> ring, seconds;
  for(std::size_t i = 0; i < wedges.size(); ++i) {
    if(i > 0 && wedges[i][0] == wedges[i - 1][0])
      return Ring_defect::REPEATED_HALFEDGE;
    seconds.push_back(wedges[i][1]);
  }
  std::sort(seconds.begin(), seconds.end());
  if(std::adjacent_find(seconds.begin(), seconds.end()) != seconds.end())
    return Ring_defect::REPEATED_HALFEDGE;
  auto first = wedges.begin();
  int number_of_starts = 0;
  for(auto it = wedges.begin(); it != wedges.end(); ++it)
    if(!std::binary_search(seconds.begin(), seconds.end(), (*it)[0])) {
      first = it;
      ++number_of_starts;
    }
  for(auto it = first; it != wedges.end();) {
    ring.push_back((*it)[0]);
    if(number_of_starts > 0 && find((*it)[1]) == wedges.end())
      ring.push_back((*it)[1]);
    it = find((*it)[1]);
    if(it == first)
      break;
  }
  const std::size_t expected = wedges.size() + (number_of_starts > 0 ? 1 : 0);
  lines.set_ring(v, ring, number_of_starts > 0);
  return (number_of_starts > 1 || ring.size() != expected) ? Ring_defect::SEVERAL_FANS
                                                           : Ring_defect::NONE;
}

// Sets the rings of a mesh; returns the first vertex whose triangles do not form one fan, if there
// is one.
inline Defective_vertex link_rings(const Indexed_triangle_mesh& mesh, Ring_lines& lines)
{
  const std::size_t n = mesh.points.size();
  const auto for_each_wedge = [&mesh](const auto& use) {
    for(const Triangle_indices& t : mesh.triangles) {
      use(t[0], Ring_wedge{t[1], t[2]});
      use(t[1], Ring_wedge{t[2], t[0]});
      use(t[2], Ring_wedge{t[0], t[1]});
    }
  };
  Blocked_execution::Uninitialized_vector<Ring_wedge> all;
  const auto begin = Blocked_execution::sort_by_key(
    n, for_each_wedge, [&all](std::size_t count) { all.resize(count); },
    [&all](std::uint32_t i, const Ring_wedge& wedge) { all[i] = wedge; });
  lines.resize(n);
  std::vector<std::uint8_t> is_done(n);
  Blocked_execution::blocked_for(n, 16384, [&](std::size_t first, std::size_t last) {
    for(std::size_t v = first; v < last; ++v) {
      lines.set_line(Vertex_index(v), 0, false);
      is_done[v] = link_small_fan(Vertex_index(v), all.data() + begin[v], begin[v + 1] - begin[v],
                                  lines);
    }
  });
  Defective_vertex result;
  std::vector<Ring_wedge> wedges;
  for(std::size_t v = 0; v < n; ++v) {
    if(is_done[v])
      continue;
    wedges.assign(all.begin() + begin[v], all.begin() + begin[v + 1]);
    const Ring_defect defect = link_fan(Vertex_index(v), wedges, lines);
    if(defect != Ring_defect::NONE && result.defect == Ring_defect::NONE)
      result = {defect, Vertex_index(v)};
  }
  return result;
}

} // namespace internal

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

  /// The same for the rings that become longer when the collapse of v into t is undone.
  bool needs_new_spill_to_split(Vertex_index v, Vertex_index t) const;

  /// Collapses v into its ring vertex k. Precondition: `is_collapse_valid(v, k)`.
  void collapse(Vertex_index v, std::uint32_t k);

  /// Undoes the collapse of v into t. Precondition: it is the last that was not undone. The rings of
  /// vertices inside the surface may begin elsewhere than before.
  void split(Vertex_index v, Vertex_index t);

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

inline bool Vertex_rings::needs_new_spill_to_split(Vertex_index v, Vertex_index t) const
{
  const Vertex_index* r = ring(v);
  return std::any_of(r, r + degree(v), [&](Vertex_index w) {
    const bool may_grow = w != t || degree(v) <= 3;
    return may_grow && !is_spilled(w) && degree(w) >= line_capacity;
  });
}

// The picture of collapse(), from right to left.
inline void Vertex_rings::split(Vertex_index v, Vertex_index t)
{
  const Vertex_index* r = ring(v);
  const std::uint32_t d = degree(v), k = position(v, t);
  const bool border = is_border(v);
  const bool has_before = !border || k != 0, has_after = !border || k + 1 != d;
  const Vertex_index a = r[k == 0 ? d - 1 : k - 1], b = r[k + 1 == d ? 0 : k + 1];
  for(std::uint32_t i = 0; i < d; ++i)
    if(i != k && !(has_before && r[i] == a) && !(has_after && r[i] == b))
      replace(r[i], t, v);
  if(has_before) {
    const Vertex_index both[2] = {t, v};
    splice(a, position(a, t), both, 2);
  }
  if(has_after) {
    const Vertex_index both[2] = {v, t};
    splice(b, position(b, t), both, 2);
  }
  // The ring of t without what lies between b and a
  const std::uint32_t count = d - 1 - (has_before ? 1 : 0) - (has_after ? 1 : 0), e = degree(t);
  const Vertex_index* q = ring(t);
  std::vector<Vertex_index> ring_of_t;
  ring_of_t.reserve(e + 1 - count);
  if(!is_border(t)) {
    ring_of_t.push_back(v);
    for(std::uint32_t i = 0, first = position(t, a); i < e - count; ++i)
      ring_of_t.push_back(q[(first + i) % e]);
  } else {
    const std::uint32_t first = has_after ? position(t, b) + 1 : 0;
    ring_of_t.assign(q, q + first);
    ring_of_t.push_back(v);
    ring_of_t.insert(ring_of_t.end(), q + first + count, q + e);
  }
  set_ring(t, ring_of_t, is_border(t));
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the border cycles, each with the surface on its left. Linear time.
inline std::vector<std::vector<Vertex_index>> border_loops(const Vertex_rings& rings)
{
  std::vector<std::vector<Vertex_index>> loops;
  std::vector<bool> is_seen(rings.size(), false);
  for(Vertex_index start = 0; start < rings.size(); ++start) {
    if(!rings.is_border(start) || is_seen[start])
      continue;
    loops.emplace_back();
    for(Vertex_index v = start; !is_seen[v]; v = rings.ring(v)[0]) {
      is_seen[v] = true;
      loops.back().push_back(v);
    }
  }
  return loops;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns for each vertex whether it can be reached from `seed` along edges. Linear time.
inline std::vector<bool> component_of(const Vertex_rings& rings, Vertex_index seed)
{
  // Every vertex points to its smallest neighbour; few trees result, and only edges between trees
  // are looked at one by one
  constexpr std::size_t block = 16384;
  const std::size_t n = rings.size();
  std::vector<Vertex_index> parent(n);
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      const Vertex_index* r = rings.ring(Vertex_index(v));
      const std::uint32_t d = rings.degree(Vertex_index(v));
      parent[v] = (std::min)(Vertex_index(v), *std::min_element(r, r + d));
    }
  });
  for(std::size_t v = 0; v < n; ++v) // parents are smaller, and settled
    parent[v] = parent[parent[v]];
  std::vector<std::vector<std::pair<Vertex_index, Vertex_index>>> links(
    Blocked_execution::number_of_blocks(n, block));
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    auto& found = links[begin / block];
    for(std::size_t v = begin; v < end; ++v)
      for(std::uint32_t i = 0; i < rings.degree(Vertex_index(v)); ++i) {
        const Vertex_index w = rings.ring(Vertex_index(v))[i];
        if(parent[w] < parent[v]
           && (found.empty() || found.back() != std::make_pair(parent[v], parent[w])))
          found.push_back({parent[v], parent[w]});
      }
  });
  Disjoint_sets sets(std::move(parent));
  for(const auto& block_links : links)
    for(const auto& [a, b] : block_links)
      sets.join(a, b);
  const Vertex_index root = sets.find(seed);
  std::vector<bool> is_reached(n);
  for(std::size_t v = 0; v < n; ++v)
    is_reached[v] = sets.find(Vertex_index(v)) == root;
  return is_reached;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_VERTEX_RINGS_H
