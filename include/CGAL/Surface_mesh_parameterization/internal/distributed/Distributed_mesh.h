// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_MESH_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_MESH_H

#include <CGAL/Surface_mesh_parameterization/internal/distributed/Ranks.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Mesh_block.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The other vertices of the triangles than [first, last), ascending.
inline std::vector<std::uint32_t>
vertices_outside(const std::vector<Indexed_mesh::Triangle_indices>& triangles, std::size_t first,
                 std::size_t last)
{
  std::vector<std::uint32_t> result;
  for(const Indexed_mesh::Triangle_indices& t : triangles)
    for(const std::uint32_t v : t)
      if(v < first || v >= last)
        result.push_back(v);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// What one rank has of a mesh that is not sorted: a range of its vertices, and some triangles.
struct Mesh_part
{
  typedef Indexed_mesh::Triangle_indices Triangle_indices;

  Offsets begin;                                  // vertices of the ranks
  std::vector<Three_numbers> points;              // of the range
  std::vector<bool> is_used;                      // of the range: others are not in the sorted mesh
  std::vector<Triangle_indices> triangles;        // of the whole mesh, by ranks in its order
  bool has_cotangents = false;                    // else they are those of the points
  std::vector<Three_numbers> cotangents;          // of the triangles
};

// What one rank has of a mesh whose vertices are sorted along a space-filling curve and cut into
// blocks of equal size, as a `Streamed_mesh`: some of the blocks, one after the other. The mesh is
// the same for any number of ranks.
struct Distributed_mesh
{
  typedef Indexed_mesh::Triangle_indices Triangle_indices;

  std::size_t block_size = 0;               // vertices
  Offsets begin;                            // vertices of the ranks
  std::size_t first = 0;                    // the first vertex of this one
  std::vector<Three_numbers> points;        // of its vertices
  std::vector<std::uint32_t> source;        // what these are in the mesh that this was made of
  std::vector<std::uint32_t> number;        // what that mesh's vertices on this rank are here
  std::vector<std::uint32_t> ghosts;        // other vertices of its triangles, ascending
  std::vector<Three_numbers> ghost_points;
  std::vector<Triangle_indices> triangles;  // all at its vertices, by blocks: first those of no
                                            // earlier block, then the ghosts, as `Streamed_mesh`
  std::vector<Three_numbers> cotangents;    // of these; empty: those of the points
  std::vector<std::size_t> triangle_begin;  // by blocks

  // Calls `use(array, name)` for all of its arrays.
  template <class Use>
  void for_each_array(const Use& use)
  {
    use(begin, "begin");
    use(points, "points");
    use(source, "source");
    use(number, "number");
    use(ghosts, "ghosts");
    use(ghost_points, "ghost_points");
    use(triangles, "triangles");
    use(cotangents, "cotangents");
    use(triangle_begin, "triangle_begin");
  }

  std::size_t number_of_vertices() const { return begin.back(); }
  std::size_t number_of_blocks() const { return triangle_begin.size() - 1; } // of this rank
  bool is_own(std::uint32_t v) const { return v - first < source.size(); }

  // Calls `use(triangle)` for those that no other rank calls it for.
  template <class Use>
  void for_each_own_triangle(const Use& use) const
  {
    for(std::size_t b = 0; b < number_of_blocks(); ++b)
      for(std::size_t t = triangle_begin[b]; t < triangle_begin[b + 1]; ++t) {
        const Triangle_indices& v = triangles[t];
        if((std::min)({v[0], v[1], v[2]}) >= first + b * block_size)
          use(v);
      }
  }

  // Corners of triangles at vertices of this rank.
  std::size_t number_of_own_corners() const
  {
    std::size_t result = 0;
    for(std::size_t b = 0; b < number_of_blocks(); ++b) {
      const std::size_t from = first + b * block_size;
      for(std::size_t t = triangle_begin[b]; t < triangle_begin[b + 1]; ++t)
        for(const std::uint32_t v : triangles[t])
          result += is_own(v) && v - from < block_size ? 1 : 0;
    }
    return result;
  }

  const Three_numbers& point(std::uint32_t v) const
  {
    if(is_own(v))
      return points[v - first];
    return ghost_points[std::size_t(std::lower_bound(ghosts.begin(), ghosts.end(), v)
                                    - ghosts.begin())];
  }

  Mesh_block block(std::size_t b) const
  {
    const std::ptrdiff_t from = std::ptrdiff_t(triangle_begin[b]),
                         to = std::ptrdiff_t(triangle_begin[b + 1]);
    std::vector<Three_numbers> given;
    if(!cotangents.empty())
      given.assign(cotangents.begin() + from, cotangents.begin() + to);
    const std::size_t first_of_block = first + b * block_size;
    return Mesh_block(first_of_block,
                      (std::min)(block_size, first + points.size() - first_of_block),
                      {triangles.begin() + from, triangles.begin() + to}, given,
                      [this](std::uint32_t v) -> const Three_numbers& { return point(v); });
  }
};

// Sorts a mesh: each vertex to the rank that has its place on the curve, each triangle to those of
// its vertices.
class Mesh_sorter
{
public:
  typedef Indexed_mesh::Triangle_indices Triangle_indices;

  Mesh_sorter(Ranks& ranks, Mesh_part part) : m_ranks(ranks), m_part(std::move(part)) {}

  // `vertices`: those that are used, of all ranks. The part is used up.
  Distributed_mesh sort(const Curve_cube& cube, std::size_t vertices, std::size_t block_size)
  {
    m_mesh.block_size = block_size;
    const std::size_t blocks = Blocked_execution::number_of_blocks(vertices, block_size);
    for(std::size_t r = 0; r <= m_ranks.size(); ++r)
      m_mesh.begin.push_back((std::min)(vertices, first_block(r, blocks) * block_size));
    m_mesh.first = m_mesh.begin[m_ranks.rank()];
    sort_vertices(cube);
    number_triangles();
    send_triangles();
    sort_triangles(first_block(m_ranks.rank(), blocks), first_block(m_ranks.rank() + 1, blocks));
    fetch_ghosts();
    return std::move(m_mesh);
  }

private:
  struct Sorted_vertex
  {
    std::uint64_t key; // place on the curve, and number in the source: no two are equal
    Three_numbers point;
  };

  std::size_t first_block(std::size_t rank, std::size_t blocks) const
  {
    return Blocked_execution::number_of_blocks(rank * blocks, m_ranks.size());
  }
  static std::size_t rank_in(const Offsets& begin, std::size_t v)
  {
    return std::size_t(std::upper_bound(begin.begin(), begin.end(), v) - begin.begin()) - 1;
  }
  std::size_t rank_of(std::uint32_t v) const
  {
    return rank_in(m_mesh.begin, v);
  }

  std::vector<std::size_t> sort_by_key(std::vector<Sorted_vertex>& vertices) const;
  void sort_vertices(const Curve_cube& cube);
  void number_triangles();
  void send_triangles();
  void sort_triangles(std::size_t first, std::size_t last);
  void fetch_ghosts();

  // Calls `use(rank)` for those to which a triangle goes.
  template <class Use>
  void for_each_rank(const Triangle_indices& t, const Use& use) const
  {
    const std::array<std::size_t, 3> r = {rank_of(t[0]), rank_of(t[1]), rank_of(t[2])};
    use(r[0]);
    if(r[1] != r[0])
      use(r[1]);
    if(r[2] != r[0] && r[2] != r[1])
      use(r[2]);
  }

  Ranks& m_ranks;
  Mesh_part m_part;
  Distributed_mesh m_mesh;
};

// Sorts the vertices of this rank, and finds by bisection which of them come before the place in
// the order of all at which each rank begins: returns how many each rank gets.
inline std::vector<std::size_t> Mesh_sorter::sort_by_key(std::vector<Sorted_vertex>& vertices) const
{
  const auto precedes = [](const Sorted_vertex& v, std::uint64_t key) { return v.key < key; };
  std::sort(vertices.begin(), vertices.end(),
            [](const Sorted_vertex& v, const Sorted_vertex& w) { return v.key < w.key; });
  const std::size_t ranks = m_ranks.size();
  std::vector<std::uint64_t> low(ranks, 0), high(ranks, std::uint64_t(1) << 62), before(ranks);
  const auto number_before = [&](std::uint64_t key) {
    return std::uint64_t(std::lower_bound(vertices.begin(), vertices.end(), key, precedes)
                         - vertices.begin());
  };
  for(int bit = 0; bit < 62; ++bit) {
    for(std::size_t r = 0; r < ranks; ++r)
      before[r] = number_before((low[r] + high[r]) / 2);
    MPI_Allreduce(MPI_IN_PLACE, before.data(), int(ranks), MPI_UINT64_T, MPI_SUM, m_ranks.comm());
    for(std::size_t r = 0; r < ranks; ++r)
      (before[r] <= m_mesh.begin[r] ? low : high)[r] = (low[r] + high[r]) / 2;
  }
  std::vector<std::size_t> counts(ranks);
  for(std::size_t r = 0; r < ranks; ++r)
    counts[r] = (r + 1 < ranks ? number_before(low[r + 1]) : vertices.size())
              - number_before(low[r]);
  return counts;
}

inline void Mesh_sorter::sort_vertices(const Curve_cube& cube)
{
  std::vector<Sorted_vertex> vertices;
  const std::size_t first = m_part.begin[m_ranks.rank()];
  for(std::size_t i = 0; i < m_part.points.size(); ++i)
    if(m_part.is_used[i])
      vertices.push_back({std::uint64_t(cube.code(m_part.points[i])) << 32
                            | std::uint64_t(first + i), m_part.points[i]});
  m_part.points = std::vector<Three_numbers>();
  const std::vector<std::size_t> counts = sort_by_key(vertices);
  auto received = counts;
  std::vector<Sorted_vertex> sorted = m_ranks.exchange(vertices, received);
  std::sort(sorted.begin(), sorted.end(),
            [](const Sorted_vertex& v, const Sorted_vertex& w) { return v.key < w.key; });
  for(const Sorted_vertex& v : sorted) {
    m_mesh.source.push_back(std::uint32_t(v.key));
    m_mesh.points.push_back(v.point);
  }
  sorted = std::vector<Sorted_vertex>();
  // The new numbers go back the way on which the vertices came, which is by their source's ranks.
  std::vector<std::uint32_t> order(m_mesh.source.size()), numbers;
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [this](std::uint32_t i, std::uint32_t j) {
    return rank_in(m_part.begin, m_mesh.source[i]) < rank_in(m_part.begin, m_mesh.source[j]);
  });
  for(const std::uint32_t i : order)
    numbers.push_back(std::uint32_t(m_mesh.first + i));
  numbers = m_ranks.exchange(numbers, received);
  m_mesh.number.assign(m_part.is_used.size(), Indexed_mesh::no_vertex);
  for(std::size_t i = 0; i < vertices.size(); ++i)
    m_mesh.number[std::uint32_t(vertices[i].key) - first] = numbers[i];
}

inline void Mesh_sorter::number_triangles()
{
  const std::size_t first = m_part.begin[m_ranks.rank()], last = first + m_mesh.number.size();
  const Known_entries<std::uint32_t> number(m_ranks, m_part.begin, m_mesh.number,
                                            vertices_outside(m_part.triangles, first, last));
  for(Triangle_indices& t : m_part.triangles)
    for(std::uint32_t& v : t)
      v = number[v];
}

inline void Mesh_sorter::send_triangles()
{
  std::vector<std::size_t> counts(m_ranks.size(), 0);
  for(const Triangle_indices& t : m_part.triangles)
    for_each_rank(t, [&counts](std::size_t r) { ++counts[r]; });
  Offsets at(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, at.begin() + 1);
  const std::size_t all = at.back() + counts.back();
  const auto send = [&](const auto& of, auto& to) {
    std::decay_t<decltype(to)> sent(all);
    Offsets place = at;
    for(std::size_t t = 0; t < of.size(); ++t)
      for_each_rank(m_part.triangles[t], [&](std::size_t r) { sent[place[r]++] = of[t]; });
    auto received = counts;
    to = m_ranks.exchange(sent, received);
  };
  if(m_part.has_cotangents)
    send(m_part.cotangents, m_mesh.cotangents);
  m_part.cotangents = std::vector<Three_numbers>();
  send(m_part.triangles, m_mesh.triangles);
  m_part.triangles = std::vector<Triangle_indices>();
}

// By blocks; a triangle comes to each block in which it has a vertex.
inline void Mesh_sorter::sort_triangles(std::size_t first, std::size_t last)
{
  const std::size_t size = m_mesh.block_size;
  const auto for_each_block = [&](const Triangle_indices& t, const auto& use) {
    const std::array<std::size_t, 3> b = {t[0] / size, t[1] / size, t[2] / size};
    const std::size_t own = (std::min)({b[0], b[1], b[2]});
    for(std::size_t c = 0; c < 3; ++c)
      if(b[c] >= first && b[c] < last && (c < 1 || b[c] != b[0]) && (c < 2 || b[c] != b[1]))
        use(b[c] - first, b[c] == own ? 0u : 1u);
  };
  std::vector<std::size_t> at(2 * (last - first) + 1, 0);
  for(const Triangle_indices& t : m_mesh.triangles)
    for_each_block(t, [&at](std::size_t b, unsigned int is_ghost) { ++at[2 * b + is_ghost + 1]; });
  std::partial_sum(at.begin(), at.end(), at.begin());
  for(std::size_t b = 0; b <= last - first; ++b)
    m_mesh.triangle_begin.push_back(at[2 * b]);
  std::vector<Triangle_indices> triangles(at.back());
  std::vector<Three_numbers> cotangents(m_mesh.cotangents.empty() ? 0 : at.back());
  for(std::size_t i = 0; i < m_mesh.triangles.size(); ++i)
    for_each_block(m_mesh.triangles[i], [&](std::size_t b, unsigned int is_ghost) {
      const std::size_t place = at[2 * b + is_ghost]++;
      triangles[place] = m_mesh.triangles[i];
      if(!cotangents.empty())
        cotangents[place] = m_mesh.cotangents[i];
    });
  m_mesh.triangles.swap(triangles);
  m_mesh.cotangents.swap(cotangents);
}

inline void Mesh_sorter::fetch_ghosts()
{
  m_mesh.ghosts
    = vertices_outside(m_mesh.triangles, m_mesh.first, m_mesh.first + m_mesh.points.size());
  m_mesh.ghost_points = m_ranks.values_at<Three_numbers>(
    m_mesh.ghosts, m_mesh.begin, [this](std::size_t i) { return m_mesh.points[i]; });
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_MESH_H
