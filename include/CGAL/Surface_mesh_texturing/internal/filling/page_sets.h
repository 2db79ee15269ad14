// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_SETS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_SETS_H

#include <CGAL/Surface_mesh_texturing/internal/filling/Page_filler.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The height of pages of which most is used, as far as a quick packing tells.
inline std::size_t best_page_height(double largest_aspect, Packing_options packing,
                                    const Chart_mapping& mapping, std::vector<Mapped_chart>& charts)
{
  constexpr double clearly_more = 0.02; // of the pages
  constexpr std::size_t least_height = 16;
  std::size_t best = packing.height;
  if(!(largest_aspect >= 2.) || packing.texels_per_unit > 0. || charts.empty())
    return best;
  const auto used = [&] { return Page_filler(charts, packing, mapping).used(); };
  double most_used = used();
  for(packing.height /= 2;
      packing.height >= least_height && mapping.has_time()
      && double(packing.width) <= largest_aspect * double(packing.height)
      && packing_options_error(packing).empty(); packing.height /= 2)
    if(const double here = used(); here > most_used + clearly_more) {
      most_used = here;
      best = packing.height;
    }
  return best;
}

// The charts that are to lie on the same pages; see `Texture_atlas_options::page_set`.
inline std::vector<std::vector<Mapped_chart>>
sets_of_pages(const std::vector<std::uint32_t>& page_set, std::vector<Mapped_chart> charts)
{
  std::map<std::uint32_t, std::vector<Mapped_chart>> sets;
  for(Mapped_chart& chart : charts)
    sets[page_set.empty() ? 0 : page_set[chart.chart.triangles.front()]].push_back(std::move(chart));
  std::vector<std::vector<Mapped_chart>> result;
  for(auto& set : sets)
    result.push_back(std::move(set.second));
  return result;
}

// Adds packed charts to others, on pages of their own, which may have another density.
inline void add_pages(std::vector<Mapped_chart> more, Packing_result packing,
                      std::vector<Mapped_chart>& charts, Packing_result& result)
{
  std::move(more.begin(), more.end(), std::back_inserter(charts));
  if(result.pages == 0) {
    result = std::move(packing);
    return;
  }
  for(Chart_placement& placement : packing.placements) {
    placement.page += std::uint32_t(result.pages);
    result.placements.push_back(placement);
  }
  const double before = double(result.pages), pages = double(packing.pages);
  const double texels_before = before * result.utilisation, texels = pages * packing.utilisation;
  const auto area = [](double texels, double density) { return texels / (density * density); };
  if(texels_before + texels > 0.)
    result.texels_per_unit = std::sqrt(
      (texels_before + texels)
      / (area(texels_before, result.texels_per_unit) + area(texels, packing.texels_per_unit)));
  result.pages += packing.pages;
  result.utilisation = (texels_before + texels) / double(result.pages);
  result.texel_utilisation
    = (before * result.texel_utilisation + pages * packing.texel_utilisation) / double(result.pages);
}

// Sorts packed charts by their first triangles.
inline void sort_by_first_triangle(std::vector<Mapped_chart>& charts,
                                   std::vector<Chart_placement>& placements)
{
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&charts](std::size_t i, std::size_t j) {
    return charts[i].chart.triangles.front() < charts[j].chart.triangles.front();
  });
  std::vector<Mapped_chart> sorted_charts;
  std::vector<Chart_placement> sorted_placements;
  for(const std::size_t i : order) {
    sorted_charts.push_back(std::move(charts[i]));
    sorted_placements.push_back(placements[i]);
  }
  charts = std::move(sorted_charts);
  placements = std::move(sorted_placements);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PAGE_SETS_H
