// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H
#define CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/packing/Density_search.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/keep_axes.h>
#endif

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Horizon_packer` packs charts as in the game of Tetris (Lévy, Petitjean, Ray and Maillot,
*Least Squares Conformal Maps for Automatic Texture Atlas Generation*, SIGGRAPH 2002, section 4):
the charts stand upright and are laid from above, the highest first, each where the fewest texels
between its lower profile and the horizon are lost; its upper profile is then part of the horizon.
Notches that are open to the sides and holes remain empty.

Simple and fast: \f$ O(n w \bar{w}) \f$ for \f$ n \f$ charts of mean width \f$ \bar{w} \f$ on a page
of width \f$ w \f$, times the number of densities tried. `Packing_options::rotations` and
`time_budget` do not count.

\cgalModels{ChartPacker}
*/
class Horizon_packer
{
public:
  /// Packs charts; see `ChartPacker`.
  Packing_result operator()(const std::vector<Chart_shape>& charts,
                            const Packing_options& options) const;
};

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
namespace internal {

// A chart seen from below and from above.
struct Chart_profile
{
  int height = 0;               // in cells; 0 if the chart is larger than a page
  std::vector<int> lower;       // of each column, the first cell
  std::vector<int> upper;       // of each column, one more than the last cell; 0 if there is none
  Vector_2d centre = {};        // of the chart, from the lower left corner
  double angle = 0.;
};

// The profile of a chart whose smallest rectangle stands upright.
inline Chart_profile chart_profile(const Chart_outline& outline, double density,
                                   const Packing_raster& raster)
{
  Chart_profile result;
  result.angle = outline.angle + 0.5 * CGAL_PI;
  const Rasterized_chart chart
    = rasterize(outline, result.angle, density / raster.cell, raster.width, raster.height);
  result.height = chart.mask.height();
  result.centre = chart.centre;
  result.lower.assign(chart.mask.width(), result.height);
  result.upper.assign(chart.mask.width(), 0);
  for(const Cell_run& run : chart.mask.runs())
    for(int x = run.begin; x < run.end; ++x) {
      result.lower[x] = (std::min)(result.lower[x], run.y);
      result.upper[x] = run.y + 1;
    }
  return result;
}

// A page on which charts are laid from above: for each column the first cell above all of them and
// the padding.
class Horizon
{
public:
  Horizon(int width, int height) : m_top(width, 0), m_height(height) {}

  // Finds the place where the fewest cells between the horizon and the chart are lost, the leftmost
  // one of several.
  bool find(const Chart_profile& chart, int& best_x, int& best_y) const
  {
    const int w = int(chart.lower.size()), none = -1;
    std::int64_t least = (std::numeric_limits<std::int64_t>::max)();
    best_x = none;
    for(int x = 0; x + w <= int(m_top.size()); ++x) {
      int y = 0;
      for(int i = 0; i < w; ++i)
        y = (std::max)(y, m_top[x + i] - chart.lower[i]);
      if(y + chart.height > m_height)
        continue;
      std::int64_t lost = 0;
      for(int i = 0; i < w; ++i)
        lost += y + chart.lower[i] - m_top[x + i];
      if(lost < least) {
        least = lost;
        best_x = x;
        best_y = y;
      }
    }
    return best_x != none;
  }

  void lay(const Chart_profile& chart, int x, int y, int padding)
  {
    const int w = int(chart.upper.size());
    for(int i = 0; i < w; ++i) {
      const int begin = (std::max)(0, x + i - padding);
      const int end = (std::min)(int(m_top.size()), x + i + padding + 1);
      for(int j = begin; j < end && chart.upper[i] > 0; ++j)
        m_top[j] = (std::max)(m_top[j], y + chart.upper[i] + padding);
    }
  }

private:
  std::vector<int> m_top;
  int m_height;
};

// The packing of charts at one density, on as many pages as allowed. Returns no
// placements but an error if a chart does not fit.
inline Packing_result horizon_packing(const std::vector<Chart_outline>& outlines, double unit,
                                      double density, const Packing_raster& raster,
                                      const Packing_options& options)
{
  std::vector<Chart_profile> profiles;
  for(const Chart_outline& outline : outlines)
    profiles.push_back(chart_profile(outline, density, raster));
  std::vector<std::uint32_t> order(outlines.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return profiles[a].height > profiles[b].height;
  });
  std::vector<Horizon> pages;
  Packing_result result;
  result.texels_per_unit = density / unit;
  std::vector<Chart_placement> placements(outlines.size());
  for(const std::uint32_t chart : order) {
    const Chart_profile& profile = profiles[chart];
    int x = 0, y = 0;
    std::size_t page = 0;
    for(;; ++page) {
      if(profile.height == 0 || (options.max_pages != 0 && page == options.max_pages)) {
        result.fail(Mesh_status::FAILED, misfit_message(chart, profile.height == 0, options));
        return result;
      }
      if(page == pages.size())
        pages.emplace_back(raster.width, raster.height);
      if(pages[page].find(profile, x, y))
        break;
    }
    pages[page].lay(profile, x, y, raster.padding);
    placements[chart]
      = chart_placement(outlines[chart], raster, std::uint32_t(page), profile.angle,
                        result.texels_per_unit, {x + profile.centre[0], y + profile.centre[1]});
  }
  result.pages = pages.size();
  result.placements = std::move(placements);
  return result;
}

} // namespace internal

CGAL_HLSCM_INLINE Packing_result Horizon_packer::operator()(const std::vector<Chart_shape>& charts,
                                                            const Packing_options& options) const
{
  double unit = 1.;
  std::vector<internal::Chart_outline> outlines = internal::chart_outlines(charts, unit);
  internal::keep_axes(options, outlines);
  const internal::Packing_raster raster = internal::exact_raster(options);
  const auto pack = [&](double density) {
    return internal::horizon_packing(outlines, unit, density, raster, options);
  };
  if(options.texels_per_unit > 0.)
    return pack(options.texels_per_unit * unit);
  Packing_result result;
  bool is_cancelled = false;
  const internal::Density_ladder ladder(outlines, raster, options.max_pages);
  internal::highest_level(ladder.lowest(), -128, 16, [&](int level) {
    is_cancelled = is_cancelled || (options.progress && !options.progress(0.5));
    Packing_result trial = is_cancelled ? Packing_result() : pack(ladder.density(level));
    if(!trial.placements.empty() || result.placements.empty())
      result = trial;
    return !trial.placements.empty();
  });
  if(is_cancelled) {
    result = Packing_result();
    result.cancel();
  }
  return result;
}
#endif

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H
