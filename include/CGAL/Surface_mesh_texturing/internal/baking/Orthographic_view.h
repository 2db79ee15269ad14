// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_ORTHOGRAPHIC_VIEW_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_ORTHOGRAPHIC_VIEW_H

#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Bounding_ball.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Uv_rasterizer.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/corner_tangents.h>

#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The unit vectors to the vertices of an icosahedron.
inline std::array<Vector_3, 12> icosahedron_directions()
{
  const double golden = 0.5 * (1. + std::sqrt(5.));
  std::array<Vector_3, 12> result;
  for(int i = 0; i < 12; ++i) {
    std::array<double, 3> v = {0., 0., 0.};
    v[(i / 4 + 1) % 3] = i % 2 == 0 ? 1. : -1.;
    v[(i / 4 + 2) % 3] = i / 2 % 2 == 0 ? golden : -golden;
    result[i] = normalized(Vector_3(v[0], v[1], v[2]));
  }
  return result;
}

// A square image of what lies in a ball, seen from the direction `towards`.
class Orthographic_view
{
public:
  typedef Indexed_triangle_mesh::Point_3 Point_3;

  Orthographic_view(const Vector_3& towards, const Bounding_ball& ball, std::size_t size)
    : m_size(size), m_ball(ball), m_z(towards), m_x(any_orthogonal(towards))
    , m_y(cross_product(m_z, m_x))
  {}

  // For each pixel, row by row, the point that is seen there; of equally near ones that of the
  // first triangle.
  std::vector<Surface_point> visible_points(const std::vector<Point_3>& points,
                                            const std::vector<Triangle_indices>& triangles) const
  {
    std::vector<Textured_triangle_mesh::Point_2> places(points.size());
    std::vector<double> heights(points.size());
    const double scale = m_ball.radius > 0. ? 0.499 / m_ball.radius : 0.;
    for(std::size_t v = 0; v < points.size(); ++v) {
      const Vector_3 p = points[v] - m_ball.center;
      places[v] = {0.5 + scale * (p * m_x), 0.5 + scale * (p * m_y)};
      heights[v] = scale * (p * m_z);
    }
    const Uv_rasterizer raster(places, triangles, m_size, m_size, m_size);
    std::vector<Surface_point> result(m_size * m_size);
    std::vector<double> highest(m_size * m_size, -1.);
    raster.visit(0, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
      const Surface_point p = raster.point(t, std::size_t(x), std::size_t(y));
      const std::size_t pixel = std::size_t(y) * m_size + std::size_t(x);
      const double height = p.weights[0] * heights[triangles[t][0]]
                          + p.weights[1] * heights[triangles[t][1]]
                          + p.weights[2] * heights[triangles[t][2]];
      if(height > highest[pixel]) {
        highest[pixel] = height;
        result[pixel] = p;
      }
    });
    return result;
  }

private:
  std::size_t m_size;
  Bounding_ball m_ball;
  Vector_3 m_z, m_x, m_y;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_ORTHOGRAPHIC_VIEW_H
