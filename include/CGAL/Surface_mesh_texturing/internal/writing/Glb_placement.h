// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_PLACEMENT_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_PLACEMENT_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Glb_builder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Where the node of a mesh lies, whose positions are floats: a point is centre + scale * position.
//
// Positions are those of the surface unless rounding would move them by more than a thousandth of
// its mean edge, far from the origin or below the smallest floats. Then they are relative to the
// centre of the bounding box, and in units of a power of two if the box is extremely small or large.
class Glb_placement
{
public:
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;

  // Of the surface of these triangles; `point_of(v)` is the point of a vertex.
  template <class Point_of>
  Glb_placement(const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                const Point_of& point_of)
  {
    constexpr double unit_of_rounding = 0x1p-24, half_of_smallest = 0x1p-150, allowed = 1e-3;
    Bbox_3 box;
    double sum = 0.;
    for(const auto& t : triangles)
      for(int c = 0; c < 3; ++c) {
        const Point_3 &p = point_of(t[c]), &q = point_of(t[(c + 1) % 3]);
        box += p.bbox();
        sum += std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z()) / 3.;
      }
    double greatest = 0., extent = 0.;
    for(int c = 0; c < 3; ++c) {
      greatest = (std::max)({greatest, std::abs((box.min)(c)), std::abs((box.max)(c))});
      extent = (std::max)(extent, (box.max)(c) - (box.min)(c));
    }
    const double rounding = (std::max)(unit_of_rounding * greatest, half_of_smallest);
    if(!(extent > 0.) || rounding * double(triangles.size()) <= allowed * sum)
      return;
    m_is_needed = true;
    for(int c = 0; c < 3; ++c)
      m_centre[c] = 0.5 * (box.min)(c) + 0.5 * (box.max)(c);
    constexpr int usual = 60; // powers of two that squares of floats have
    const int exponent = std::ilogb(extent);
    if(std::abs(exponent) > usual)
      m_scale = std::ldexp(1., exponent);
  }

  std::array<float, 3> position(const Point_3& p) const
  {
    std::array<float, 3> result = {float(p.x()), float(p.y()), float(p.z())};
    for(int c = 0; c < 3 && m_is_needed; ++c)
      result[c] = float((p[c] - m_centre[c]) / m_scale);
    return result;
  }

  // The members of the node, each after a comma.
  std::string json() const
  {
    if(!m_is_needed)
      return {};
    const auto list = [](const std::array<double, 3>& v) {
      return json_list({json_number(v[0]), json_number(v[1]), json_number(v[2])});
    };
    return (m_scale == 1. ? "" : ",\"scale\":" + list({m_scale, m_scale, m_scale}))
         + ",\"translation\":" + list(m_centre);
  }

private:
  bool m_is_needed = false;
  std::array<double, 3> m_centre = {0., 0., 0.};
  double m_scale = 1.;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_PLACEMENT_H
