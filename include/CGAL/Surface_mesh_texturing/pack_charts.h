// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/Raster_packer.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/rasterize_outline.h>

#include <cmath>
#include <string>
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
inline Mesh_outcome packing_error(const std::vector<Chart_shape>& charts,
                                  const Packing_options& options)
{
  Mesh_outcome result;
  result.fail(Mesh_status::BAD_OPTIONS, packing_options_error(options));
  for(std::size_t i = 0; i < charts.size() && result.is_ok(); ++i) {
    const std::string reason = chart_error(charts[i]);
    if(!reason.empty())
      result.fail(Mesh_status::BAD_MESH, "chart " + std::to_string(i) + " has " + reason);
  }
  return result;
}

// What is wrong with what a packer returns without an error, or nothing.
inline std::string foreign_packing_error(const std::vector<Chart_shape>& charts,
                                         const Packing_result& result)
{
  if(result.placements.size() != charts.size())
    return "the packer has placed " + std::to_string(result.placements.size()) + " of "
           + std::to_string(charts.size()) + " charts";
  for(const Chart_placement& p : result.placements) {
    if(p.page >= result.pages)
      return "the packer has placed a chart on a page that does not exist";
    if(!std::isfinite(p.angle) || !std::isfinite(p.scale) || !std::isfinite(p.offset.x())
       || !std::isfinite(p.offset.y()))
      return "the packer has placed a chart where there is no finite place";
  }
  return {};
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Lays charts side by side on pages of texels: each is turned and moved, never mirrored, and all are
scaled by the same factor. `Packing_options` defines the padding between them.

The result has an error, and nothing else, if a coordinate is not finite, an index is out of range,
an option makes no sense, a packer of the user returns no such result, a chart is larger than a page
at the density asked for, the charts need more pages than allowed, or `Packing_options::progress` says
stop. Charts without area are placed, too; each takes one texel at least. Without charts the result is empty.

The result does not depend on the number of threads.

\tparam Packer a model of `ChartPacker`
\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
*/
template <class Packer = Raster_packer, class ConcurrencyTag = Default>
Packing_result pack_charts(const std::vector<Chart_shape>& charts,
                           const Packing_options& options = Packing_options(),
                           const Packer& packer = Packer())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Packing_result result;
  if(result.fail(internal::packing_error(charts, options)) || charts.empty())
    return result;
  result = packer(charts, options);
  if(!result.is_ok() && result.status == Mesh_status::OK) // it gave the sentence alone
    result.status = Mesh_status::FAILED;
  if(result.is_ok()
     && !result.fail(Mesh_status::FAILED, internal::foreign_packing_error(charts, result)))
    internal::measure_utilisation(charts, options, result);
  else
    result.placements.clear();
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
