// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VERTEX_RINGS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VERTEX_RINGS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/internal/sort_by_key.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/prefetch.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What can be wrong with the connectivity at a vertex.
enum class Ring_defect : std::uint8_t { NONE, ISOLATED, REPEATED_HALFEDGE, SEVERAL_FANS };

// The connectivity of a triangle mesh as one ring of neighbours a vertex, counterclockwise:
//
//           r2 ---- r1        The triangles at v are (v, r_i, r_i+1). Inside the surface the ring
//          /  \    /  \       is closed and may begin anywhere; at the border it is open and
//        r3 --- v --- r0      begins and ends with the two border neighbours.
//          \  /    \  /
//           r4 ---- r5
//
// One 64-byte line a vertex; rings of more than 14 vertices go to a spill pool. The line of a
// removed vertex is left as it was.
class Vertex_rings
{
public:
  static constexpr std::uint32_t line_capacity = 14;

  Vertex_rings() {}

  // Builds the rings of `mesh`; `defect()` says whether they exist.
  explicit Vertex_rings(const Indexed_triangle_mesh& mesh) { build(mesh); }

  std::size_t size() const { return m_lines.size(); }

  // The first vertex whose triangles do not form one fan, or `no_vertex`.
  Vertex_index defective_vertex() const { return m_defective_vertex; }
  Ring_defect defect() const { return m_defect; }

  std::uint32_t degree(Vertex_index v) const { return m_lines[v].degree & degree_mask; }

  // The degree if it is below 255, and 255 otherwise: one byte instead of a line to look up.
  int small_degree(Vertex_index v) const { return m_small_degree[v]; }
  bool is_border(Vertex_index v) const { return (m_lines[v].degree & border_flag) != 0; }

  const Vertex_index* ring(Vertex_index v) const
  {
    const Line& line = m_lines[v];
    return (line.degree & spill_flag) != 0 ? m_spill[line.ring[0]].data() : line.ring;
  }

  // Asks for the line of v.
  void prefetch(Vertex_index v) const { internal::prefetch(&m_lines[v]); }

  // Whether the collapse of v into ring vertex k keeps a manifold of the same topology: v and
  // r_k have only the opposite vertices of their common triangles as common neighbours, and no
  // triangle pair is folded onto another.
  bool is_collapse_valid(Vertex_index v, std::uint32_t k) const;

  // Whether the ring of the kept vertex would have to leave its line, which only one thread may do.
  bool needs_new_spill(Vertex_index v, std::uint32_t k) const
  {
    const Vertex_index t = ring(v)[k];
    const std::uint32_t gained = degree(v) - (is_border(v) ? 2 : 3);
    return (m_lines[t].degree & spill_flag) == 0 && degree(t) - 1 + gained > line_capacity;
  }

  // Collapses v into its ring vertex k. Precondition: `is_collapse_valid(v, k)`.
  void collapse(Vertex_index v, std::uint32_t k);

  // Undoes the collapse of v into t that took the triangles (v, t, b) and (v, a, t) away, one of
  // which there may not have been: b or a is `no_vertex` then. Precondition: t is on the border in
  // that case, and those given are different and in the ring of t, b before a if that is open.
  void split(Vertex_index v, Vertex_index t, Vertex_index b, Vertex_index a);

private:
  static constexpr std::uint32_t border_flag = 1u << 31;
  static constexpr std::uint32_t spill_flag = 1u << 30;
  static constexpr std::uint32_t degree_mask = spill_flag - 1;

  struct alignas(64) Line
  {
    Line() {} // not set: who builds the rings touches the memory first

    Vertex_index ring[line_capacity];
    std::uint32_t degree; // with the two flags
    std::uint32_t unused;
  };

  void build(const Indexed_triangle_mesh& mesh);
  bool link_small_fan(Vertex_index v, const std::array<Vertex_index, 2>* wedges,
                      std::uint32_t count);
  Ring_defect link_fan(Vertex_index v, std::vector<std::array<Vertex_index, 2>>& wedges,
                       std::vector<Vertex_index>& ring);
  void set_ring(Vertex_index v, const std::vector<Vertex_index>& ring, bool is_border);
  Vertex_index* mutable_ring(Vertex_index v) { return const_cast<Vertex_index*>(ring(v)); }
  std::uint32_t position(Vertex_index v, Vertex_index neighbor) const;
  void erase(Vertex_index v, std::uint32_t at);
  void insert(Vertex_index v, std::uint32_t at, Vertex_index neighbor);
  void replace(Vertex_index v, Vertex_index old_neighbor, Vertex_index new_neighbor);
  void splice(Vertex_index v, std::uint32_t at, const Vertex_index* first, std::uint32_t count);

  void note_degree(Vertex_index v)
  {
    m_small_degree[v] = std::uint8_t((std::min)(degree(v), std::uint32_t(255)));
  }

  std::vector<Line> m_lines;
  std::vector<std::uint8_t> m_small_degree;
  std::vector<std::vector<Vertex_index>> m_spill;
  std::vector<Vertex_index> m_scratch;
  Vertex_index m_defective_vertex = no_vertex;
  Ring_defect m_defect = Ring_defect::NONE;
};

inline std::uint32_t Vertex_rings::position(Vertex_index v, Vertex_index neighbor) const
{
  const Vertex_index* r = ring(v);
  std::uint32_t i = 0;
  while(r[i] != neighbor)
    ++i;
  CGAL_assertion(i < degree(v));
  return i;
}

inline void Vertex_rings::set_ring(Vertex_index v, const std::vector<Vertex_index>& ring,
                                   bool is_border)
{
  Line& line = m_lines[v];
  const bool had_spill = (line.degree & spill_flag) != 0;
  line.degree = std::uint32_t(ring.size()) | (is_border ? border_flag : 0);
  if(ring.size() <= line_capacity) {
    std::copy(ring.begin(), ring.end(), line.ring);
  } else if(had_spill) {
    line.degree |= spill_flag;
    m_spill[line.ring[0]] = ring;
  } else {
    line.degree |= spill_flag;
    line.ring[0] = std::uint32_t(m_spill.size());
    m_spill.push_back(ring);
  }
}

// The common case: few wedges that form one fan. Returns false, for the careful version to say
// why, if they do not.
inline bool Vertex_rings::link_small_fan(Vertex_index v, const std::array<Vertex_index, 2>* wedges,
                                         std::uint32_t count)
{
  if(count == 0 || count >= line_capacity)
    return false;
  std::uint32_t start = 0, number_of_starts = 0;
  for(std::uint32_t i = 0; i < count; ++i) {
    bool has_predecessor = false;
    for(std::uint32_t j = 0; j < count; ++j)
      has_predecessor |= wedges[j][1] == wedges[i][0];
    if(!has_predecessor) {
      start = i;
      ++number_of_starts;
    }
  }
  Line& line = m_lines[v];
  std::uint32_t used = 0, at = start;
  for(; used < count; ++used) {
    line.ring[used] = wedges[at][0];
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
    line.ring[count] = wedges[at][1];
  line.degree = (count + (border ? 1 : 0)) | (border ? border_flag : 0);
  // A repeated halfedge leaves a wedge out, or another start
  return used == count && number_of_starts <= 1 && (border || wedges[at][1] == wedges[start][0]);
}

// Orders the wedges (a, b) of the triangles (v, a, b) into a ring.
inline Ring_defect Vertex_rings::link_fan(Vertex_index v,
                                          std::vector<std::array<Vertex_index, 2>>& wedges,
                                          std::vector<Vertex_index>& ring)
{
  ring.clear();
  if(wedges.empty())
    return Ring_defect::ISOLATED;
  // Sorted by their first vertex, a wedge finds its successor by bisection.
  std::sort(wedges.begin(), wedges.end());
  const auto find = [&wedges](Vertex_index a) {
    const auto it = std::lower_bound(wedges.begin(), wedges.end(),
                                     std::array<Vertex_index, 2>{a, 0});
    return (it != wedges.end() && (*it)[0] == a) ? it : wedges.end();
  };
  std::vector<Vertex_index>& seconds = m_scratch;
  seconds.clear();
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
  set_ring(v, ring, number_of_starts > 0);
  return (number_of_starts > 1 || ring.size() != expected) ? Ring_defect::SEVERAL_FANS
                                                           : Ring_defect::NONE;
}

inline void Vertex_rings::build(const Indexed_triangle_mesh& mesh)
{
  typedef std::array<Vertex_index, 2> Wedge;
  const std::size_t n = mesh.points.size();
  const auto for_each_wedge = [&mesh](const auto& use) {
    for(const Triangle_indices& t : mesh.triangles) {
      use(t[0], Wedge{t[1], t[2]});
      use(t[1], Wedge{t[2], t[0]});
      use(t[2], Wedge{t[0], t[1]});
    }
  };
  Blocked_execution::internal::Uninitialized_vector<Wedge> all;
  const auto begin = Blocked_execution::internal::sort_by_key(
    n, for_each_wedge, [&all](std::size_t count) { all.resize(count); },
    [&all](std::uint32_t i, const Wedge& wedge) { all[i] = wedge; });
  m_lines.resize(n);
  m_small_degree.resize(n);
  std::vector<std::uint8_t> is_done(n);
  Blocked_execution::blocked_for(n, 16384, [&](std::size_t first, std::size_t last) {
    for(std::size_t v = first; v < last; ++v) {
      m_lines[v].degree = 0;
      is_done[v] = link_small_fan(Vertex_index(v), all.data() + begin[v], begin[v + 1] - begin[v]);
      note_degree(Vertex_index(v));
    }
  });
  std::vector<std::array<Vertex_index, 2>> wedges;
  std::vector<Vertex_index> ring;
  for(std::size_t v = 0; v < n; ++v) {
    if(is_done[v])
      continue;
    wedges.assign(all.begin() + begin[v], all.begin() + begin[v + 1]);
    const Ring_defect defect = link_fan(Vertex_index(v), wedges, ring);
    if(defect != Ring_defect::NONE && m_defect == Ring_defect::NONE) {
      m_defect = defect;
      m_defective_vertex = Vertex_index(v);
    }
    note_degree(Vertex_index(v));
  }
}

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

inline void Vertex_rings::erase(Vertex_index v, std::uint32_t at)
{
  Vertex_index* r = mutable_ring(v);
  const std::uint32_t d = degree(v);
  std::copy(r + at + 1, r + d, r + at);
  --m_lines[v].degree;
  note_degree(v);
}

inline void Vertex_rings::replace(Vertex_index v, Vertex_index old_neighbor,
                                  Vertex_index new_neighbor)
{
  mutable_ring(v)[position(v, old_neighbor)] = new_neighbor;
}

// Puts `count` vertices in the place of the ring vertex at `at`.
inline void Vertex_rings::splice(Vertex_index v, std::uint32_t at, const Vertex_index* first,
                                 std::uint32_t count)
{
  Line& line = m_lines[v];
  const std::uint32_t d = degree(v);
  const std::uint32_t e = d - 1 + count;
  if((line.degree & spill_flag) == 0 && e > line_capacity) {
    m_spill.emplace_back(line.ring, line.ring + d);
    line.ring[0] = std::uint32_t(m_spill.size() - 1);
    line.degree |= spill_flag;
  }
  if((line.degree & spill_flag) != 0 && m_spill[line.ring[0]].size() < e)
    m_spill[line.ring[0]].resize(2 * e);
  Vertex_index* r = mutable_ring(v);
  if(count > 1)
    std::copy_backward(r + at + 1, r + d, r + e);
  else if(count == 0)
    std::copy(r + at + 1, r + d, r + at);
  std::copy(first, first + count, r + at);
  line.degree = (line.degree & ~degree_mask) | e;
  note_degree(v);
}

inline void Vertex_rings::insert(Vertex_index v, std::uint32_t at, Vertex_index neighbor)
{
  std::vector<Vertex_index> changed(ring(v), ring(v) + degree(v));
  changed.insert(changed.begin() + at, neighbor);
  set_ring(v, changed, is_border(v));
  note_degree(v);
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

//        a                a
//      / |              / | \        The reverse of the drawing above: v gets the ring vertices of t
//    ..  t -    ->    .. v - t -      from b to a and gives way to them in the ring of t. Without a
//      \ |              \ | /        they end with the ring of t, without b they begin with it.
//        b                b
inline void Vertex_rings::split(Vertex_index v, Vertex_index t, Vertex_index b, Vertex_index a)
{
  const bool has_b = b != no_vertex, has_a = a != no_vertex;
  CGAL_precondition(a != b && ((has_a && has_b) || is_border(t)));
  const std::uint32_t d = degree(t);
  const std::uint32_t first = has_b ? position(t, b) : 0, last = has_a ? position(t, a) : d - 1;
  std::vector<Vertex_index> of_t(ring(t), ring(t) + d), of_v;
  if(!is_border(t)) // begin with b, so that nothing goes round the end
    std::rotate(of_t.begin(), of_t.begin() + first, of_t.end());
  const std::uint32_t begin = is_border(t) ? first : 0;
  const std::uint32_t end = (is_border(t) ? last : (last + d - first) % d) + 1;
  of_v.assign(of_t.begin() + begin, of_t.begin() + end);
  for(std::uint32_t i = has_b ? 1 : 0; i + (has_a ? 1 : 0) < of_v.size(); ++i)
    replace(of_v[i], t, v);
  if(has_b) // v lies between t and what was before it
    insert(b, position(b, t), v);
  if(has_a)
    insert(a, position(a, t) + 1, v);
  of_t.erase(of_t.begin() + begin + (has_b ? 1 : 0), of_t.begin() + end - (has_a ? 1 : 0));
  of_t.insert(of_t.begin() + begin + (has_b ? 1 : 0), v);
  const bool is_inside = has_a && has_b;
  of_v.insert(has_b ? of_v.begin() : of_v.end(), t);
  set_ring(t, of_t, is_border(t));
  set_ring(v, of_v, !is_inside);
  note_degree(t);
  note_degree(v);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VERTEX_RINGS_H
