// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INDEXED_TRIANGLE_MESH_H
#define CGAL_INDEXED_MESH_INDEXED_TRIANGLE_MESH_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/mesh_indices.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

/*
A mesh is two arrays, and what is asked of it is built beside them once and passed on:
`Triangle_adjacency` (across edges), `Triangles_at_vertices`, `Vertex_rings` (under collapses).

A chart, a part of a mesh that is laid out in the plane, passes through these types. A new one is
needed only where it has to know something that none of them has.

  type              knows                                           from -> to
  Face_charts       all charts of a mesh, as seams and labels       segmentation -> all that follows
  Chart_state       charts while they are merged: a Chart_piece     patches -> Face_charts
                    each, and the Seam_graph between them
  Chart_mesh        one chart as a mesh of its own, cut along       Chart_cutter -> its map
                    seams, with the way back to the whole mesh
  Prepared_mesh     any mesh normalized and sorted, with rings      prepare_mesh() -> collapses
  Chart             a Prepared_mesh that is a disk, its borders     the caller's mesh -> the solver
  Mapped_chart      a Chart_mesh with uv and a report               map_chart() -> packing
  Chart_shape       uv and triangles, no surface any more           pack_charts() -> packer
  Chart_outline,    what a packer sees of a shape: its border       packer -> Chart_placement
  Chart_raster      turned and its texels
  Textured_triangle_mesh  the whole mesh again, with uv             atlas -> levels, baking, files
*/

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the triangle of a halfedge or corner.
constexpr Triangle_index triangle_of(Halfedge h) { return h / 3; }

/// \ingroup PkgHLSCMIndexedMesh
/// Returns which corner of its triangle a corner is, or a halfedge starts from: 0, 1 or 2.
constexpr std::uint32_t corner_of(Halfedge h) { return h % 3; }

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the next halfedge around the triangle of `h`, counterclockwise.
constexpr Halfedge next_halfedge(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the halfedge before `h` around its triangle.
constexpr Halfedge previous_halfedge(Halfedge h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the vertex from which a halfedge starts: that of the corner.
inline Vertex_index vertex_of(const std::vector<Triangle_indices>& triangles, Halfedge h)
{
  return triangles[triangle_of(h)][corner_of(h)];
}

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Triangle_corner` is a corner \f$ 3 t + c \f$ taken apart, for loops over many of them:
without branches, which nobody could guess.
*/
struct Triangle_corner
{
  Triangle_index triangle; ///< \f$ t \f$
  std::uint32_t next;      ///< the corner after \f$ c \f$ of the triangle
  std::uint32_t last;      ///< the corner before \f$ c \f$ of the triangle

  /// Takes a corner apart.
  explicit Triangle_corner(Halfedge corner)
    : triangle(triangle_of(corner))
  {
    const std::uint32_t twice_c = 2 * (corner - 3 * triangle);
    next = (9u >> twice_c) & 3u;  // 1, 2, 0
    last = (18u >> twice_c) & 3u; // 2, 0, 1
  }
};

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Indexed_triangle_mesh` is a triangle mesh as two arrays.

Invariant: the entries of `triangles` are smaller than `points.size()`.
*/
struct Indexed_triangle_mesh
{
  /// The point type.
  typedef Simple_cartesian<double>::Point_3 Point_3;

  std::vector<Point_3> points;             ///< The position of each vertex.
  std::vector<Triangle_indices> triangles; ///< The vertices of each triangle.
};

/// \ingroup PkgHLSCMIndexedMesh
/// A point of a triangle mesh: a triangle and the barycentric coordinates in it.
struct Surface_point
{
  Triangle_index triangle = no_triangle;     ///< or `no_triangle`
  std::array<double, 3> weights = {0, 0, 0}; ///< of its corners

  /// Returns whether there is a point.
  bool exists() const { return triangle != no_triangle; }
};

/// \ingroup PkgHLSCMIndexedMesh
/// Returns for each of `n` things its position among the members, or `no_vertex`.
inline std::vector<Vertex_index> ranks(const std::vector<Vertex_index>& members, std::size_t n)
{
  constexpr std::size_t block = 32768;
  std::vector<Vertex_index> result;
  Blocked_execution::resize_blocked(result, n);
  Blocked_execution::blocked_for(n, block, [&result](std::size_t begin, std::size_t end) {
    std::fill(result.begin() + begin, result.begin() + end, no_vertex);
  });
  Blocked_execution::blocked_for(members.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      result[members[i]] = Vertex_index(i);
  });
  return result;
}

/// Spreads the low ten bits of x to every third bit.
inline std::uint32_t spread_bits(std::uint32_t x)
{
  x = (x | (x << 16)) & 0x030000FF;
  x = (x | (x << 8)) & 0x0300F00F;
  x = (x | (x << 4)) & 0x030C30C3;
  return (x | (x << 2)) & 0x09249249;
}

/// The order of the keys, stable: three passes of a radix sort by eleven bits. Each block of the old
/// order has its own places in the new one for each digit.
inline std::vector<std::uint32_t> sorted_order(const std::vector<std::uint32_t>& keys)
{
  constexpr std::size_t block = 65536, digits = 2048;
  std::vector<std::uint32_t> order(keys.size()), next(keys.size());
  std::vector<std::array<std::uint32_t, digits>> at(
    Blocked_execution::number_of_blocks(keys.size(), block));
  for(int shift = 0; shift < 32; shift += 11) {
    const auto source = [&](std::size_t i) { return shift == 0 ? std::uint32_t(i) : order[i]; };
    const auto digit = [&](std::uint32_t i) { return (keys[i] >> shift) & (digits - 1); };
    Blocked_execution::blocked_for(keys.size(), block, [&](std::size_t begin, std::size_t end) {
      at[begin / block].fill(0);
      for(std::size_t i = begin; i < end; ++i)
        ++at[begin / block][digit(source(i))];
    });
    std::uint32_t before = 0;
    for(std::size_t d = 0; d < digits; ++d)
      for(auto& of_block : at)
        before += std::exchange(of_block[d], before);
    Blocked_execution::blocked_for(keys.size(), block, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i) {
        const std::uint32_t s = source(i);
        next[at[begin / block][digit(s)]++] = s;
      }
    });
    order.swap(next);
  }
  return order;
}

/// Points of one block of a loop.
constexpr std::size_t block_of_points = 16384;

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the bounding box of points; that of no points is empty, from plus to minus infinity.
inline Bbox_3 bounding_box(const std::vector<Indexed_triangle_mesh::Point_3>& points)
{
  return Blocked_execution::blocked_sum<Bbox_3>(
    points.size(), block_of_points, [&points](std::size_t begin, std::size_t end) {
      Bbox_3 box;
      for(std::size_t i = begin; i < end; ++i) {
        const auto& p = points[i];
        box += Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
      }
      return box;
    });
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the length of the longest side of a box.
inline double longest_side(const Bbox_3& box)
{
  return (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
}

/// The Morton code of a point, ten bits an axis, in a cube of 1024 cells a side at `corner`.
template <class Point, class Corner>
std::uint32_t morton_code(const Point& p, const Corner& corner, double cells_per_length)
{
  std::uint32_t code = 0;
  for(int c = 0; c < 3; ++c)
    code |= spread_bits(std::uint32_t((p[c] - corner[c]) * cells_per_length)) << c;
  return code;
}

/// The Morton code of each point in the bounding cube.
inline std::vector<std::uint32_t>
morton_codes(const std::vector<Indexed_triangle_mesh::Point_3>& points)
{
  std::vector<std::uint32_t> codes(points.size());
  if(points.empty())
    return codes;
  const Bbox_3 box = bounding_box(points);
  const double extent = longest_side(box);
  const double scale = extent > 0. ? 1023.999 / extent : 0.;
  const std::array<double, 3> corner = {box.xmin(), box.ymin(), box.zmin()};
  Blocked_execution::blocked_for(points.size(), block_of_points,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      codes[i] = morton_code(points[i], corner, scale);
  });
  return codes;
}

/// Sorts triangles by their smallest vertex, which becomes the first.
inline void sort_by_smallest_vertex(std::size_t number_of_vertices,
                                    std::vector<Triangle_indices>& triangles)
{
  Blocked_execution::blocked_for(triangles.size(), block_of_points,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const Triangle_indices t = triangles[i];
      const bool is_1 = t[1] < t[0] && t[1] <= t[2], is_2 = t[2] < t[0] && t[2] < t[1];
      const unsigned int first = is_1 ? 1 : (is_2 ? 2 : 0);
      triangles[i] = {t[first], t[(9u >> 2 * first) & 3u], t[(18u >> 2 * first) & 3u]};
    }
  });
  std::vector<Triangle_indices> sorted;
  const auto for_each_triangle = [&triangles](const auto& use) {
    for(const Triangle_indices& t : triangles)
      use(t[0], t);
  };
  Blocked_execution::sort_by_key(
    number_of_vertices, for_each_triangle,
    [&sorted](std::size_t n) { Blocked_execution::resize_blocked(sorted, n); },
    [&sorted](std::uint32_t i, const Triangle_indices& t) { sorted[i] = t; });
  triangles.swap(sorted);
}

/*!
\ingroup PkgHLSCMIndexedMesh

Renumbers the vertices of `mesh` along a Morton curve and its triangles by their smallest vertex, so
that what is near on the surface is near in memory, which makes all later passes over the mesh
faster.

\return for each new vertex index the old one.

Linear time; 12 bytes a vertex and 12 a triangle of temporary memory.
*/
inline std::vector<Vertex_index> sort_spatially(Indexed_triangle_mesh& mesh)
{
  std::vector<Vertex_index> source = sorted_order(morton_codes(mesh.points));
  std::vector<Vertex_index> rank(source.size());
  std::vector<Indexed_triangle_mesh::Point_3> points(source.size());
  Blocked_execution::blocked_for(source.size(), block_of_points,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      rank[source[i]] = Vertex_index(i);
      points[i] = mesh.points[source[i]];
    }
  });
  mesh.points.swap(points);
  Blocked_execution::blocked_for(mesh.triangles.size(), block_of_points,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      for(Vertex_index& v : mesh.triangles[i])
        v = rank[v];
  });
  sort_by_smallest_vertex(source.size(), mesh.triangles);
  return source;
}

/*!
\ingroup PkgHLSCMIndexedMesh

Moves the centre of the bounding box of `mesh` to the origin and scales the mean edge length to 1,
so that sizes of the order of 1e-30 or 1e30, or a position far from the origin, do no harm.

\return the factor by which lengths were multiplied, or 0 if the mesh has no extent (it is then left
unscaled).
*/
inline double normalize(Indexed_triangle_mesh& mesh)
{
  if(mesh.points.empty())
    return 0.;
  const Bbox_3 box = bounding_box(mesh.points);
  const double extent = longest_side(box);
  if(!(extent > 0.))
    return 0.;
  const auto move = [&mesh](const std::array<double, 3>& origin, double unit) {
    Blocked_execution::blocked_for(mesh.points.size(), block_of_points,
                                   [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i) {
        auto& p = mesh.points[i];
        p = Indexed_triangle_mesh::Point_3((p.x() - origin[0]) / unit, (p.y() - origin[1]) / unit,
                                           (p.z() - origin[2]) / unit);
      }
    });
  };
  // In two steps: squares of lengths may not exist before the first.
  move({0.5 * (box.xmin() + box.xmax()), 0.5 * (box.ymin() + box.ymax()),
        0.5 * (box.zmin() + box.zmax())}, extent);
  const double sum = Blocked_execution::blocked_sum<double>(
    mesh.triangles.size(), block_of_points, [&mesh](std::size_t begin, std::size_t end) {
      double lengths = 0.;
      for(std::size_t i = begin; i < end; ++i) {
        const Triangle_indices& t = mesh.triangles[i];
        for(int c = 0; c < 3; ++c)
          lengths += std::sqrt(squared_distance(mesh.points[t[c]], mesh.points[t[(c + 1) % 3]]));
      }
      return lengths;
    });
  if(!(sum > 0.))
    return 0.;
  const double mean = sum / (3. * double(mesh.triangles.size()));
  move({0., 0., 0.}, mean);
  return 1. / (extent * mean);
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INDEXED_TRIANGLE_MESH_H
