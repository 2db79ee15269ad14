// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_GREEDY_PACKING_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_GREEDY_PACKING_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Place_search.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The places of charts that were placed one after the other.
struct Raster_packing
{
  std::vector<std::uint32_t> order;
  std::vector<Raster_place> places; // of each chart
  std::size_t pages = 0;
  bool is_complete = false; // whether all charts have a place; the others were not tried any more
};

// Places charts one after the other, each where it is best at the time.
class Greedy_packing
{
public:
  // The rasters must outlive this.
  explicit Greedy_packing(const Packing_raster& raster, std::size_t max_pages)
    : m_raster(raster), m_max_pages(max_pages)
  {}

  // Places all charts, which must have been made, in the given order; each on the first page where
  // it has a place in one of its directions.
  Raster_packing pack(const Chart_rasters& charts, const std::vector<std::uint32_t>& order,
                      Place_criterion criterion)
  {
    Raster_packing result = start(charts, order);
    constexpr std::size_t most_snug = 128; // the others lie between these
    for(std::size_t i = 0; i < order.size(); ++i) {
      const std::uint32_t chart = order[i];
      place(charts, chart, i < most_snug ? criterion : Place_criterion::LOW, result.places[chart]);
      if(!take(charts, chart, result))
        return result;
    }
    result.is_complete = true;
    return result;
  }

  // Does again what was done on a coarser raster: each chart goes to the best place in its old
  // direction and near its old place, or, if there is none, where it finds one.
  Raster_packing refine(Chart_rasters& charts, const Raster_packing& coarse,
                        const Chart_rasters& coarse_charts);

private:
  Raster_packing start(const Chart_rasters& charts, const std::vector<std::uint32_t>& order)
  {
    m_pages.clear();
    Raster_packing result;
    result.order = order;
    result.places.resize(charts.size());
    return result;
  }

  const Page_raster& page(std::size_t index)
  {
    if(index == m_pages.size())
      m_pages.emplace_back(m_raster.width, m_raster.height);
    return m_pages[index];
  }

  bool is_allowed(std::size_t page) const { return m_max_pages == 0 || page < m_max_pages; }

  void place(const Chart_rasters& charts, std::uint32_t chart, Place_criterion criterion,
             Raster_place& place)
  {
    bool fits = false;
    std::vector<Chart_raster> with_rims; // if there is need of rims that have not been made
    for(int r = 0; r < charts.rotations() && criterion == Place_criterion::SNUG
                   && !charts.have_rims(); ++r)
      with_rims.push_back(charts.with_rim(chart, r));
    for(int r = 0; r < charts.rotations(); ++r)
      fits = fits || charts.made(chart, r).width > 0;
    for(std::size_t p = 0; fits && is_allowed(p) && !place.is_found(); ++p) {
      Place_search search(criterion);
      for(int r = 0; r < charts.rotations(); ++r)
        search.search(with_rims.empty() ? charts.made(chart, r) : with_rims[r], page(p),
                      std::uint32_t(p), r);
      place = search.best();
    }
  }

  // Takes the cells of a chart's place; returns whether it has one.
  bool take(const Chart_rasters& charts, std::uint32_t chart, Raster_packing& result)
  {
    const Raster_place& place = result.places[chart];
    if(!place.is_found())
      return false;
    m_pages[place.page].take(charts.made(chart, place.rotation).padded, place.x, place.y);
    result.pages = (std::max)(result.pages, std::size_t(place.page) + 1);
    return true;
  }

  Packing_raster m_raster;
  std::size_t m_max_pages;
  std::vector<Page_raster> m_pages;
};

inline Raster_packing Greedy_packing::refine(Chart_rasters& charts, const Raster_packing& coarse,
                                             const Chart_rasters& coarse_charts)
{
  const double ratio = coarse_charts.raster().cell / m_raster.cell;
  const int radius = int(std::ceil(1.5 * ratio)) + 1;
  charts.make_where([&](std::size_t i, int r) { return coarse.places[i].rotation == r; });
  Raster_packing result = start(charts, coarse.order);
  for(const std::uint32_t chart : coarse.order) {
    const Raster_place& old = coarse.places[chart];
    const Vector_2d from = coarse_charts.made(chart, old.rotation).centre;
    const Chart_raster& shape = charts.made(chart, old.rotation);
    Raster_place hint = old;
    hint.x = int(std::lround((old.x + from[0]) * ratio - shape.centre[0]));
    hint.y = int(std::lround((old.y + from[1]) * ratio - shape.centre[1]));
    for(std::size_t p = m_pages.size(); p <= old.page; ++p)
      page(p);
    Place_search search(Place_criterion::SNUG);
    search.search_near(shape, page(old.page), hint, radius);
    result.places[chart] = search.best();
    if(!search.best().is_found()) {
      charts.make(chart);
      place(charts, chart, Place_criterion::LOW, result.places[chart]);
    }
    if(!take(charts, chart, result))
      return result;
  }
  result.is_complete = true;
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_GREEDY_PACKING_H
