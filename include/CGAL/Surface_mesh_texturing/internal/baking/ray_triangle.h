// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_RAY_TRIANGLE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_RAY_TRIANGLE_H

#include <CGAL/Surface_mesh_texturing/Along_rays.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Where a ray meets the plane of a triangle of which it is known that it meets it: the weights are
// those of the nearest point of the triangle up to rounding, so none is negative. No hit if the ray
// lies in the plane.
inline Ray_hit hit_of_triangle(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                               const std::vector<Triangle_indices>& triangles, std::uint32_t t,
                               const Indexed_triangle_mesh::Point_3& origin,
                               const Vector_3& direction)
{
  const Vector_3 a = points[triangles[t][0]] - origin, b = points[triangles[t][1]] - origin;
  const Vector_3 c = points[triangles[t][2]] - origin;
  const Vector_3 normal = cross_product(b - a, c - a);
  const double slope = normal * direction;
  if(slope == 0.)
    return {};
  // Volumes of the tetrahedra between the ray and the sides
  Ray_hit hit;
  hit.point.triangle = t;
  hit.point.weights = {(std::max)(0., direction * cross_product(b, c) / slope),
                       (std::max)(0., direction * cross_product(c, a) / slope),
                       (std::max)(0., direction * cross_product(a, b) / slope)};
  hit.distance = (normal * a) / slope;
  const double sum = hit.point.weights[0] + hit.point.weights[1] + hit.point.weights[2];
  if(!(sum > 0.) || !std::isfinite(sum) || !std::isfinite(hit.distance))
    return {};
  for(double& w : hit.point.weights)
    w /= sum;
  return hit;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_RAY_TRIANGLE_H
