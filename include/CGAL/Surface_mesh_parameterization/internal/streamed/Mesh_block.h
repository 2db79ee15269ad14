// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_MESH_BLOCK_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_MESH_BLOCK_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_mesh.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Vertices of what is in memory: its corners have numbers of 32 bits.
constexpr std::size_t most_with_32_bits = std::size_t(1) << 28;
// Levels in memory need so many bytes a vertex of the finest of them, blocks 500.
constexpr std::size_t bytes_of_vertex = 650;
// Of smaller blocks nearly all vertices are at others, and stay.
constexpr std::size_t least_in_block = 200;

// The size of blocks of equal size, with at most so many vertices.
inline std::size_t size_of_blocks(std::size_t vertices, std::size_t most)
{
  const std::size_t blocks = Blocked_execution::number_of_blocks(vertices, most);
  return (vertices + blocks - 1) / blocks;
}

// A block of a streamed mesh in memory: its own vertices, all triangles at these, and the other
// vertices of those triangles, the ghosts. A ghost whose triangles here are several fans is there
// once for each of them: then this is a manifold if the whole mesh is one.
//
//    own vertices       0 ... own - 1, which are `first` ... of the whole mesh
//    ghosts             own ..., `ghosts[i]` of the whole mesh
struct Mesh_block
{
  typedef Indexed_mesh::Triangle_indices Triangle_indices;

  std::size_t first = 0, own = 0;
  std::vector<std::uint32_t> ghosts;
  Indexed_mesh::Indexed_triangle_mesh mesh; // triangles by their smallest vertex, the first one
  Half_cotangents cotangents;               // of these
  std::size_t own_mollified = 0;            // of those that no earlier block has

  Mesh_block(const Streamed_mesh& whole, std::size_t block);

  // Of all triangles at the vertices [first, first + own) of a mesh, those first that no earlier
  // block has. `given`: their cotangents; if empty, they are those of the points. `point(v)` is
  // asked for these vertices and the others of the triangles.
  template <class Point>
  Mesh_block(std::size_t first_vertex, std::size_t number_of_own,
             std::vector<Triangle_indices> triangles, const std::vector<Three_numbers>& given,
             const Point& point);

  // What a vertex is in the whole mesh.
  std::uint32_t global(std::uint32_t v) const
  {
    return v < own ? std::uint32_t(first + v) : ghosts[v - own];
  }
  bool is_own(std::uint32_t v) const { return v < own; }

  // Whether a triangle of this block or of one that was made of it is in no earlier block.
  bool owns(const Triangle_indices& t) const
  {
    return global(t[0]) >= first && global(t[1]) >= first && global(t[2]) >= first;
  }

  // For each vertex whether it is a ghost or has one for a neighbour.
  std::vector<bool> is_at_ghosts() const
  {
    std::vector<bool> result(mesh.points.size(), false);
    for(const Triangle_indices& t : mesh.triangles)
      if(!is_own(t[0]) || !is_own(t[1]) || !is_own(t[2]))
        result[t[0]] = result[t[1]] = result[t[2]] = true;
    return result;
  }

private:
  template <class Point>
  void take(std::vector<Triangle_indices> triangles, const std::vector<Three_numbers>& given,
            const Point& point);
  void measure();
  void number_ghosts();
  void split_ghosts();
  void sort_triangles(const std::vector<Three_numbers>& given);
};

template <class Point>
Mesh_block::Mesh_block(std::size_t first_vertex, std::size_t number_of_own,
                       std::vector<Triangle_indices> triangles,
                       const std::vector<Three_numbers>& given, const Point& point)
  : first(first_vertex), own(number_of_own)
{
  take(std::move(triangles), given, point);
  if(given.empty())
    measure();
}

template <class Point>
void Mesh_block::take(std::vector<Triangle_indices> triangles,
                      const std::vector<Three_numbers>& given, const Point& point)
{
  mesh.triangles = std::move(triangles);
  number_ghosts();
  split_ghosts();
  sort_triangles(given);
  mesh.points.reserve(own + ghosts.size());
  for(std::uint32_t v = 0; v < own + ghosts.size(); ++v) {
    const Three_numbers& p = point(global(v));
    mesh.points.emplace_back(p[0], p[1], p[2]);
  }
}

// The cotangents are those of the points.
inline void Mesh_block::measure()
{
  cotangents = Half_cotangents(mesh);
  if(cotangents.mollified > 0)
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if(owns(mesh.triangles[t]) && conformal_triangle(mesh, t).is_mollified())
        ++own_mollified;
}

// What a block has of an array that is sorted by blocks, and of that of the ghosts.
template <class T, class Begin>
std::vector<T> part_of_block(std::size_t block, const Mapped_array<T>& own, const Begin& own_begin,
                             const Mapped_array<T>& ghosts, const Begin& ghost_begin)
{
  std::vector<T> result;
  if(!own.empty())
    result.assign(own.begin() + own_begin[block], own.begin() + own_begin[block + 1]);
  if(!ghosts.empty())
    result.insert(result.end(), ghosts.begin() + ghost_begin[block],
                  ghosts.begin() + ghost_begin[block + 1]);
  return result;
}

inline Mesh_block::Mesh_block(const Streamed_mesh& whole, std::size_t block)
  : first(block * whole.block_size)
  , own((std::min)(whole.block_size, whole.number_of_vertices() - first))
{
  take(part_of_block(block, whole.triangles, whole.triangle_begin, whole.ghosts, whole.ghost_begin),
       part_of_block(block, whole.cotangents, whole.triangle_begin, whole.ghost_cotangents,
                     whole.ghost_begin),
       [&whole](std::uint32_t v) -> const Three_numbers& { return whole.points[v]; });
  whole.points.release();
  whole.triangles.release(whole.triangle_begin[block], whole.triangle_begin[block + 1]);
  if(whole.cotangents.empty())
    measure();
  else
    whole.cotangents.release(whole.triangle_begin[block], whole.triangle_begin[block + 1]);
}

// From numbers in the whole mesh to those of the block.
inline void Mesh_block::number_ghosts()
{
  const auto is_outside = [this](std::uint32_t v) { return v < first || v >= first + own; };
  for(const Triangle_indices& t : mesh.triangles)
    for(const std::uint32_t v : t)
      if(is_outside(v))
        ghosts.push_back(v);
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  for(Triangle_indices& t : mesh.triangles)
    for(std::uint32_t& v : t)
      v = is_outside(v) ? std::uint32_t(own + (std::lower_bound(ghosts.begin(), ghosts.end(), v)
                                               - ghosts.begin()))
                        : std::uint32_t(v - first);
}

//      a ------- b         The corner of (g, a, b) at g is in one fan with that of a triangle
//       \       /          (g, b, c): one ends where the other begins.
//        \     /
//          g
inline void Mesh_block::split_ghosts()
{
  struct Side
  {
    std::uint32_t ghost, other, corner; // halfedge of the corner
    bool operator<(const Side& s) const
    {
      return ghost != s.ghost ? ghost < s.ghost : other != s.other ? other < s.other
                                                                   : corner < s.corner;
    }
  };
  std::vector<Side> begins;
  std::vector<std::uint32_t> ends;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(std::uint32_t c = 0; c < 3; ++c)
      if(!is_own(mesh.triangles[t][c]))
        begins.push_back({mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3], 3 * t + c});
  std::sort(begins.begin(), begins.end());
  for(const Side& side : begins)
    ends.push_back(mesh.triangles[side.corner / 3][(side.corner + 2 - side.corner / 3 * 3) % 3]);
  Indexed_mesh::Disjoint_sets fans(begins.size());
  for(std::uint32_t i = 0; i < begins.size(); ++i) {
    const Side end = {begins[i].ghost, ends[i], 0};
    const auto next = std::lower_bound(begins.begin(), begins.end(), end);
    if(next != begins.end() && next->ghost == end.ghost && next->other == end.other)
      fans.join(i, std::uint32_t(next - begins.begin()));
  }
  std::vector<std::uint32_t> copy(begins.size());
  for(std::uint32_t i = 0; i < begins.size(); ++i) { // the first of a set comes first
    const std::uint32_t ghost = begins[i].ghost;
    if(fans.find(i) != i)
      copy[i] = copy[fans.find(i)];
    else if(i == 0 || begins[i - 1].ghost != ghost)
      copy[i] = ghost;
    else {
      copy[i] = std::uint32_t(own + ghosts.size());
      ghosts.push_back(ghosts[ghost - own]);
    }
  }
  for(std::uint32_t i = 0; i < begins.size(); ++i)
    mesh.triangles[begins[i].corner / 3][begins[i].corner % 3] = copy[i];
}

// As `sort_spatially()` does, with the cotangents that were given.
inline void Mesh_block::sort_triangles(const std::vector<Three_numbers>& given)
{
  std::vector<std::uint32_t> turn(mesh.triangles.size()); // the corner that becomes the first
  for(std::size_t t = 0; t < turn.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    turn[t] = std::uint32_t(std::min_element(v.begin(), v.end()) - v.begin());
  }
  std::vector<std::uint32_t> order;
  Blocked_execution::sort_by_key(
    own + ghosts.size(),
    [&](const auto& use) {
      for(std::uint32_t t = 0; t < turn.size(); ++t)
        use(mesh.triangles[t][turn[t]], t);
    },
    [&order](std::size_t n) { order.resize(n); },
    [&order](std::uint32_t i, std::uint32_t t) { order[i] = t; });
  std::vector<Triangle_indices> sorted(order.size());
  if(!given.empty())
    cotangents.value.resize(3 * order.size());
  Blocked_execution::blocked_for(order.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const std::uint32_t t = order[i], first_corner = turn[t];
      for(std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t from = (first_corner + c) % 3;
        sorted[i][c] = mesh.triangles[t][from];
        if(!given.empty())
          cotangents.value[3 * i + c] = given[t][from];
      }
    }
  });
  mesh.triangles.swap(sorted);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_MESH_BLOCK_H
