// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INDEXED_TRIANGLE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INDEXED_TRIANGLE_MESH_H

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The index of a vertex, 32 bits.
typedef std::uint32_t Vertex_index;

/// \ingroup PkgHLSCMMultiresolution
/// The vertices of a triangle, counterclockwise.
typedef std::array<Vertex_index, 3> Triangle_indices;

/// \ingroup PkgHLSCMMultiresolution
/// "No vertex".
constexpr Vertex_index no_vertex = Vertex_index(-1);

/*!
\ingroup PkgHLSCMMultiresolution

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

namespace internal {

// For each of `n` things its position among the members, or `no_vertex`.
inline std::vector<Vertex_index> ranks(const std::vector<Vertex_index>& members, std::size_t n)
{
  std::vector<Vertex_index> result(n, no_vertex);
  for(Vertex_index i = 0; i < members.size(); ++i)
    result[members[i]] = i;
  return result;
}

// Spreads the low ten bits of x to every third bit.
inline std::uint32_t spread_bits(std::uint32_t x)
{
  x = (x | (x << 16)) & 0x030000FF;
  x = (x | (x << 8)) & 0x0300F00F;
  x = (x | (x << 4)) & 0x030C30C3;
  return (x | (x << 2)) & 0x09249249;
}

// The order of the keys, stable: three passes of a radix sort by eleven bits.
inline std::vector<std::uint32_t> sorted_order(const std::vector<std::uint32_t>& keys)
{
  std::vector<std::uint32_t> order(keys.size()), next(keys.size());
  for(std::uint32_t i = 0; i < order.size(); ++i)
    order[i] = i;
  for(int shift = 0; shift < 32; shift += 11) {
    std::array<std::uint32_t, 2049> begin = {};
    for(const std::uint32_t key : keys)
      ++begin[((key >> shift) & 2047u) + 1];
    for(int i = 0; i < 2048; ++i)
      begin[i + 1] += begin[i];
    for(const std::uint32_t i : order)
      next[begin[(keys[i] >> shift) & 2047u]++] = i;
    order.swap(next);
  }
  return order;
}

// The Morton code of each point: ten bits an axis in the bounding cube.
inline std::vector<std::uint32_t>
morton_codes(const std::vector<Indexed_triangle_mesh::Point_3>& points)
{
  std::vector<std::uint32_t> codes(points.size());
  if(points.empty())
    return codes;
  std::array<double, 3> lo, hi;
  for(int c = 0; c < 3; ++c)
    lo[c] = hi[c] = points[0][c];
  for(const auto& p : points)
    for(int c = 0; c < 3; ++c) {
      lo[c] = (std::min)(lo[c], p[c]);
      hi[c] = (std::max)(hi[c], p[c]);
    }
  const double extent = (std::max)({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  const double scale = extent > 0. ? 1023.999 / extent : 0.;
  for(std::size_t i = 0; i < points.size(); ++i)
    for(int c = 0; c < 3; ++c)
      codes[i] |= spread_bits(std::uint32_t((points[i][c] - lo[c]) * scale)) << c;
  return codes;
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

Renumbers the vertices of `mesh` along a Morton curve and its triangles by their smallest vertex, so
that what is near on the surface is near in memory, which makes all later passes over the mesh
faster.

\return for each new vertex index the old one.

Linear time; 12 bytes a vertex and 12 a triangle of temporary memory.
*/
inline std::vector<Vertex_index> sort_spatially(Indexed_triangle_mesh& mesh)
{
  std::vector<Vertex_index> source = internal::sorted_order(internal::morton_codes(mesh.points));
  std::vector<Vertex_index> rank(source.size());
  std::vector<Indexed_triangle_mesh::Point_3> points(source.size());
  for(Vertex_index i = 0; i < source.size(); ++i) {
    rank[source[i]] = i;
    points[i] = mesh.points[source[i]];
  }
  mesh.points.swap(points);
  std::vector<Vertex_index> begin(source.size() + 1, 0);
  for(Triangle_indices& t : mesh.triangles) {
    for(Vertex_index& v : t)
      v = rank[v];
    while(t[0] > t[1] || t[0] > t[2])
      std::rotate(t.begin(), t.begin() + 1, t.end());
    ++begin[t[0] + 1];
  }
  for(std::size_t i = 0; i < source.size(); ++i)
    begin[i + 1] += begin[i];
  std::vector<Triangle_indices> triangles(mesh.triangles.size());
  for(const Triangle_indices& t : mesh.triangles)
    triangles[begin[t[0]]++] = t;
  mesh.triangles.swap(triangles);
  return source;
}

/*!
\ingroup PkgHLSCMMultiresolution

Moves the centre of the bounding box of `mesh` to the origin and scales the mean edge length to 1,
so that sizes of the order of 1e-30 or 1e30, or a position far from the origin, do no harm.

\return the factor by which lengths were multiplied, or 0 if the mesh has no extent (it is then left
unscaled).
*/
inline double normalize(Indexed_triangle_mesh& mesh)
{
  if(mesh.points.empty())
    return 0.;
  std::array<double, 3> lo, hi;
  for(int c = 0; c < 3; ++c)
    lo[c] = hi[c] = mesh.points[0][c];
  for(const auto& p : mesh.points)
    for(int c = 0; c < 3; ++c) {
      lo[c] = (std::min)(lo[c], p[c]);
      hi[c] = (std::max)(hi[c], p[c]);
    }
  const double extent = (std::max)({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  if(!(extent > 0.))
    return 0.;
  const auto move = [&mesh](const std::array<double, 3>& origin, double unit) {
    for(auto& p : mesh.points)
      p = Indexed_triangle_mesh::Point_3((p.x() - origin[0]) / unit, (p.y() - origin[1]) / unit,
                                         (p.z() - origin[2]) / unit);
  };
  // In two steps: squares of lengths may not exist before the first.
  move({0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2])}, extent);
  double sum = 0.;
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c)
      sum += std::sqrt(squared_distance(mesh.points[t[c]], mesh.points[t[(c + 1) % 3]]));
  if(!(sum > 0.))
    return 0.;
  const double mean = sum / (3. * double(mesh.triangles.size()));
  move({0., 0., 0.}, mean);
  return 1. / (extent * mean);
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INDEXED_TRIANGLE_MESH_H
