// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H
#define CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Textured_triangle_mesh;

/// \ingroup PkgHLSCMTexturing
/// A vector in space.
typedef Simple_cartesian<double>::Vector_3 Vector_3;

using Indexed_mesh::Surface_point;

/// \ingroup PkgHLSCMTexturing
/// Returns the linear interpolation of the vectors that the corners `corners` of a triangle have.
inline Vector_3 interpolate(const std::array<double, 3>& weights, const Triangle_indices& corners,
                            const std::vector<Vector_3>& values)
{
  const Vector_3 &a = values[corners[0]], &b = values[corners[1]], &c = values[corners[2]];
  return Vector_3(weights[0] * a.x() + weights[1] * b.x() + weights[2] * c.x(),
                  weights[0] * a.y() + weights[1] * b.y() + weights[2] * c.y(),
                  weights[0] * a.z() + weights[1] * b.z() + weights[2] * c.z());
}

namespace internal {

inline bool indices_are_below(const std::vector<Triangle_indices>& triangles, std::size_t bound)
{
  return std::all_of(triangles.begin(), triangles.end(), [bound](const Triangle_indices& t) {
    return t[0] < bound && t[1] < bound && t[2] < bound;
  });
}

// The unit vector, or the zero vector if there is none.
inline Vector_3 normalized(const Vector_3& v)
{
  const double squared_length = v * v;
  return squared_length > 0. ? v / std::sqrt(squared_length) : Vector_3(0., 0., 0.);
}

// The point of a surface, relative to `origin` so that its distance costs no digits.
inline Vector_3 position(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                         const Triangle_indices& triangle, const std::array<double, 3>& weights,
                         const Indexed_triangle_mesh::Point_3& origin)
{
  return weights[0] * (points[triangle[0]] - origin) + weights[1] * (points[triangle[1]] - origin)
       + weights[2] * (points[triangle[2]] - origin);
}

} // namespace internal

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H
