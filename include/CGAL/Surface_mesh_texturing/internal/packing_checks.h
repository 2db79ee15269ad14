// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHECKS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHECKS_H

#include <CGAL/Surface_mesh_texturing/internal/Chart_raster.h>

#include <cmath>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What is wrong with the options, or nothing.
inline std::string packing_options_error(const Packing_options& options)
{
  constexpr std::size_t largest_side = 32768;
  constexpr int most_rotations = 3600;
  if(options.width == 0 || options.width > largest_side || options.height == 0
     || options.height > largest_side)
    return "the sides of a page must have 1 to 32768 texels";
  if(options.mip_levels > 15 || options.padding > largest_side || exact_raster(options).width == 0)
    return "the padding leaves nothing of a page";
  if(options.rotations < 0 || options.rotations > most_rotations)
    return "the number of rotations must be 0 to 3600";
  if(!std::isfinite(options.texels_per_unit) || options.texels_per_unit < 0.)
    return "the texels per unit of length must be finite and not negative";
  if(!std::isfinite(options.time_budget) || options.time_budget < 0.)
    return "the time budget must be finite and not negative";
  if(options.max_pages == 0 && options.texels_per_unit == 0.)
    return "any number of pages needs a given density of texels";
  return {};
}

// What is wrong with the chart, or nothing.
inline std::string chart_error(const Chart_shape& chart)
{
  for(const auto& p : chart.uv)
    if(!std::isfinite(p.x()) || !std::isfinite(p.y()))
      return "a coordinate that is not finite";
  for(const auto& t : chart.triangles)
    for(const auto v : t)
      if(v >= chart.uv.size())
        return "a triangle with a vertex that does not exist";
  const auto box = bounding_box(chart);
  if(!std::isfinite(std::hypot(box[1][0] - box[0][0], box[1][1] - box[0][1])))
    return "a size that is not finite";
  return {};
}

// What is wrong with the input of `pack_charts()`, or nothing.
inline std::string packing_error(const std::vector<Chart_shape>& charts,
                                 const Packing_options& options)
{
  const std::string error = packing_options_error(options);
  if(!error.empty())
    return error;
  for(std::size_t i = 0; i < charts.size(); ++i) {
    const std::string reason = chart_error(charts[i]);
    if(!reason.empty())
      return "chart " + std::to_string(i) + " has " + reason;
  }
  return {};
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHECKS_H
