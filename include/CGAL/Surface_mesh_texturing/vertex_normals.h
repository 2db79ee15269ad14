// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_VERTEX_NORMALS_H
#define CGAL_SURFACE_MESH_TEXTURING_VERTEX_NORMALS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The unit normal of a triangle and its angles.
struct Weighted_normal
{
  Vector_3 normal = Vector_3(0., 0., 0.);
  std::array<double, 3> angles = {0., 0., 0.};
};

inline Weighted_normal weighted_normal(const Indexed_triangle_mesh::Point_3& a,
                                       const Indexed_triangle_mesh::Point_3& b,
                                       const Indexed_triangle_mesh::Point_3& c)
{
  const Vector_3 ab = b - a, bc = c - b, ca = a - c;
  const Vector_3 normal = cross_product(ab, -ca);
  const double area = std::sqrt(normal * normal); // twice
  if(!(area > 0.))
    return {};
  return {normal / area,
          {std::atan2(area, -(ab * ca)), std::atan2(area, -(bc * ab)),
           std::atan2(area, -(ca * bc))}};
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the unit normal of each vertex: the mean of the normals of its triangles, weighted with the
angles that they have there (Thuermer, Wuethrich 1998). Vertices have one normal, also where the
texture has a seam. A vertex without triangles that have an area has the normal (0, 0, 1). If an
index is out of range, there are no normals. Linear time.
*/
inline std::vector<Vector_3>
vertex_normals(const std::vector<Indexed_triangle_mesh::Point_3>& points,
               const std::vector<Triangle_indices>& triangles)
{
  if(!internal::indices_are_below(triangles, points.size()))
    return {};
  std::vector<internal::Weighted_normal> weighted(triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 1 << 14, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i) {
      const Triangle_indices& t = triangles[i];
      weighted[i] = internal::weighted_normal(points[t[0]], points[t[1]], points[t[2]]);
    }
  });
  std::vector<Vector_3> result(points.size(), Vector_3(0., 0., 0.));
  for(std::size_t i = 0; i < triangles.size(); ++i)
    for(int c = 0; c < 3; ++c) {
      Vector_3& sum = result[triangles[i][c]];
      sum = sum + weighted[i].angles[c] * weighted[i].normal;
    }
  Blocked_execution::blocked_for(points.size(), 1 << 14, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i) {
      const Vector_3 normal = internal::normalized(result[i]);
      result[i] = normal * normal > 0. ? normal : Vector_3(0., 0., 1.);
    }
  });
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// Returns the unit normal of each vertex of `mesh`; see the other overload.
inline std::vector<Vector_3> vertex_normals(const Textured_triangle_mesh& mesh)
{
  return vertex_normals(mesh.points, mesh.triangles);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_VERTEX_NORMALS_H
