// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H
#define CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
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

/// \ingroup PkgHLSCMTexturing
/// A ball around points; its centre is that of their bounding box.
struct Bounding_ball
{
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;

  Point_3 center;     ///< the centre
  double radius = 0.; ///< the radius; 0 without points

  /// Constructs the ball of all points of the sets. Linear time.
  explicit Bounding_ball(std::initializer_list<const std::vector<Point_3>*> sets)
  {
    std::array<double, 3> lo, hi;
    lo.fill(std::numeric_limits<double>::infinity());
    hi.fill(-std::numeric_limits<double>::infinity());
    for(const auto* points : sets)
      for(const Point_3& p : *points)
        for(int c = 0; c < 3; ++c) {
          lo[c] = (std::min)(lo[c], p[c]);
          hi[c] = (std::max)(hi[c], p[c]);
        }
    center = Point_3(0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2]));
    for(const auto* points : sets)
      for(const Point_3& p : *points)
        radius = (std::max)(radius, std::sqrt((p - center) * (p - center)));
  }
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SURFACE_POINT_H
