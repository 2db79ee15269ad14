// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Bbox_2.h>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

struct Chart_shape
{
  std::vector<Simple_cartesian<double>::Point_2> uv;
  std::vector<Surface_mesh_multiresolution::Triangle_indices> triangles;
};
struct Packing_options
{
  std::size_t width = 1024, height = 1024, padding = 2;
  unsigned mip_levels = 0;
  int rotations = 8;
  std::size_t max_pages = 1;
  double texels_per_unit = 0.;
  double time_budget = 0.;
  std::function<bool(double)> progress;
};
struct Chart_placement
{
  std::uint32_t page = 0;
  double cosine = 1., sine = 0., scale = 1.;
  Simple_cartesian<double>::Vector_2 offset{0., 0.};
  Simple_cartesian<double>::Point_2 operator()(const Simple_cartesian<double>::Point_2& p) const
  {
    return {scale * (cosine * p.x() - sine * p.y()) + offset.x(), scale * (sine * p.x() + cosine * p.y()) + offset.y()};
  }
};
struct Packing_result
{
  std::vector<Chart_placement> placements;
  std::size_t pages = 0;
  double texels_per_unit = 0., utilisation = 0., texel_utilisation = 0.;
  std::string error;
};
inline Packing_result pack_charts(const std::vector<Chart_shape>& shapes, const Packing_options& o)
{
  Packing_result r;
  const std::size_t n = std::size_t(std::ceil(std::sqrt(double(shapes.size()))));
  const double cell = double(o.width) / double(n);
  double largest = 0.;
  std::vector<Bbox_2> boxes;
  for(const auto& s : shapes) {
    Bbox_2 b;
    for(const auto& p : s.uv) b += p.bbox();
    boxes.push_back(b);
    largest = (std::max)({largest, b.xmax() - b.xmin(), b.ymax() - b.ymin()});
  }
  r.texels_per_unit = (cell - 2. * double(o.padding)) / largest;
  for(std::size_t i = 0; i < shapes.size(); ++i) {
    Chart_placement p;
    p.scale = r.texels_per_unit;
    p.offset = {double(i % n) * cell + double(o.padding) - p.scale * boxes[i].xmin(),
                double(i / n) * cell + double(o.padding) - p.scale * boxes[i].ymin()};
    r.placements.push_back(p);
  }
  r.pages = 1;
  return r;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
