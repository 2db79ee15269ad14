// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BOUNDING_BALL_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BOUNDING_BALL_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A ball around points: its centre is that of the bounding box.
struct Bounding_ball
{
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;

  Point_3 center;
  double radius = 0.;

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

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_BOUNDING_BALL_H
