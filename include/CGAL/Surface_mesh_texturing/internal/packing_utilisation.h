// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_UTILISATION_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_UTILISATION_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/rasterize_outline.h>

#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The number of texels that a chart touches where it is placed.
inline std::size_t texels_touched(const Chart_shape& chart, const Chart_placement& placement)
{
  Chart_shape placed = chart;
  for(auto& p : placed.uv)
    p = placement(p);
  const Chart_outline outline = chart_outline(placed, 1.);
  const Rotation_and_scale map(0., 1.);
  const auto box = bounding_box(outline, map);
  Vector_2d centre;
  for(int c = 0; c < 2; ++c) // as it lies on the texels
    centre[c] = outline.centre[c] - std::floor(outline.centre[c] + box[0][c]);
  Texel_mask mask(int(std::floor(centre[0] + box[1][0])) + 1,
                  int(std::floor(centre[1] + box[1][1])) + 1);
  add_outline(outline, map, centre, mask);
  return mask.count();
}

// Adds both measures to a packing.
inline void measure_utilisation(const std::vector<Chart_shape>& charts,
                                const Packing_options& options, Packing_result& result)
{
  const double page = double(options.width) * double(options.height) * double(result.pages);
  std::vector<double> area(charts.size(), 0.), texels(charts.size(), 0.);
  Blocked_execution::blocked_for(charts.size(), 1, [&](std::size_t i, std::size_t) {
    texels[i] = double(texels_touched(charts[i], result.placements[i]));
    for(const auto& t : charts[i].triangles) {
      const auto p = charts[i].uv[t[1]] - charts[i].uv[t[0]];
      const auto q = charts[i].uv[t[2]] - charts[i].uv[t[0]];
      const double s = result.texels_per_unit; // of each factor: the product may not exist
      area[i] += 0.5 * std::abs(p.x() * s * (q.y() * s) - p.y() * s * (q.x() * s));
    }
  });
  for(std::size_t i = 0; i < charts.size(); ++i) {
    result.utilisation += area[i] / page;
    result.texel_utilisation += texels[i] / page;
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_UTILISATION_H
