// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_RING_LINES_H
#define CGAL_INDEXED_MESH_INTERNAL_RING_LINES_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// The memory of rings of vertices: one 64-byte line a vertex; rings of more than 14 vertices go to
// a spill pool.
class Ring_lines
{
public:
  static constexpr std::uint32_t line_capacity = 14;

  std::size_t size() const { return m_lines.size(); }
  std::uint32_t degree(Vertex_index v) const { return m_lines[v].degree & degree_mask; }

  // The degree if it is below 255, and 255 otherwise: one byte instead of a line to look up.
  int small_degree(Vertex_index v) const { return m_small_degree[v]; }
  bool is_border(Vertex_index v) const { return (m_lines[v].degree & border_flag) != 0; }
  bool is_spilled(Vertex_index v) const { return (m_lines[v].degree & spill_flag) != 0; }

  const Vertex_index* ring(Vertex_index v) const
  {
    const Line& line = m_lines[v];
    return (line.degree & spill_flag) != 0 ? m_spill[line.ring[0]].data() : line.ring;
  }

  // Where a neighbour is in the ring of v.
  std::uint32_t position(Vertex_index v, Vertex_index neighbor) const;

  // Asks for the line of v.
  void prefetch(Vertex_index v) const { Blocked_execution::prefetch(&m_lines[v]); }

  // Makes room for n rings, which `set_line()` or `set_ring()` set.
  void resize(std::size_t n)
  {
    m_lines.resize(n);
    m_small_degree.resize(n);
  }

  // The line of v, and what tells that it has a ring: several threads may set different lines.
  Vertex_index* line(Vertex_index v) { return m_lines[v].ring; }
  void set_line(Vertex_index v, std::uint32_t degree, bool is_border)
  {
    m_lines[v].degree = degree | (is_border ? border_flag : 0);
    note_degree(v);
  }

  // Gives v a ring, if it has one already another.
  void set_ring(Vertex_index v, const std::vector<Vertex_index>& ring, bool is_border);

  void erase(Vertex_index v, std::uint32_t at);
  void replace(Vertex_index v, Vertex_index old_neighbor, Vertex_index new_neighbor)
  {
    mutable_ring(v)[position(v, old_neighbor)] = new_neighbor;
  }

  // Puts `count` vertices in the place of the ring vertex at `at`.
  void splice(Vertex_index v, std::uint32_t at, const Vertex_index* first, std::uint32_t count);

private:
  static constexpr std::uint32_t border_flag = 1u << 31;
  static constexpr std::uint32_t spill_flag = 1u << 30;
  static constexpr std::uint32_t degree_mask = spill_flag - 1;

  struct alignas(64) Line
  {
    Vertex_index ring[line_capacity];
    std::uint32_t degree; // with the two flags
    std::uint32_t unused;
  };

  Vertex_index* mutable_ring(Vertex_index v) { return const_cast<Vertex_index*>(ring(v)); }

  void note_degree(Vertex_index v)
  {
    m_small_degree[v] = std::uint8_t((std::min)(degree(v), std::uint32_t(255)));
  }

  // Not set by resize(): who builds the rings touches the memory first
  Blocked_execution::Uninitialized_vector<Line> m_lines;
  std::vector<std::uint8_t> m_small_degree;
  std::vector<std::vector<Vertex_index>> m_spill;
};

inline std::uint32_t Ring_lines::position(Vertex_index v, Vertex_index neighbor) const
{
  const Vertex_index* r = ring(v);
  std::uint32_t i = 0;
  while(r[i] != neighbor)
    ++i;
  CGAL_assertion(i < degree(v));
  return i;
}

inline void Ring_lines::set_ring(Vertex_index v, const std::vector<Vertex_index>& ring,
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
  note_degree(v);
}

inline void Ring_lines::erase(Vertex_index v, std::uint32_t at)
{
  Vertex_index* r = mutable_ring(v);
  const std::uint32_t d = degree(v);
  std::copy(r + at + 1, r + d, r + at);
  --m_lines[v].degree;
  note_degree(v);
}

inline void Ring_lines::splice(Vertex_index v, std::uint32_t at, const Vertex_index* first,
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

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_RING_LINES_H
