// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PACKING_ESTIMATE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PACKING_ESTIMATE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Place_search.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What is packed on trial: an outline, and its rasters, which are kept since it is packed many times.
class Packable_shape
{
public:
  explicit Packable_shape(Chart_outline outline) : m_outline(std::move(outline)) {}

  const Chart_outline& outline() const { return m_outline; }

  // In each of that many directions, the same for all calls at a level, with `density` texels per unit of the
  // outline. Called by several threads, most of them at levels of their own.
  const std::vector<Chart_raster>& rasters(int level, double density, int rotations,
                                           const Packing_raster& raster) const
  {
    Rasters& rasters = rasters_of(level);
    const std::lock_guard<std::mutex> guard(rasters.mutex);
    for(int r = int(rasters.directions.size()); r < rotations; ++r)
      rasters.directions.push_back(chart_raster(
        m_outline, m_outline.angle + 2. * CGAL_PI * r / rotations, density, raster, Rims::ALL));
    return rasters.directions;
  }

  // Rasters of lower levels are not needed any more.
  void forget_below(int level) const { m_rasters.erase(m_rasters.begin(), m_rasters.lower_bound(level)); }

private:
  struct Rasters
  {
    std::mutex mutex;
    std::vector<Chart_raster> directions;
  };

  Rasters& rasters_of(int level) const
  {
    const std::lock_guard<std::mutex> guard(m_mutex);
    return m_rasters[level];
  }

  Chart_outline m_outline;
  mutable std::mutex m_mutex;
  mutable std::map<int, Rasters> m_rasters; // by level
};

typedef std::shared_ptr<const Packable_shape> Packable;

// Estimates how densely shapes of a fixed area can be packed, by some orders on a coarse raster.
//
// Densities are levels: at level 0 the shapes would have the area of all pages, at level -64 half of
// it.
class Packing_estimate
{
public:
  // `area` is that of all shapes, in units of the outlines; the raster is the coarser the fewer triangles they
  // have, so that the time follows these.
  Packing_estimate(const Packing_options& options, double area, std::size_t shapes, std::size_t triangles)
    : m_pages((std::max)(std::size_t(1), options.max_pages)),
      m_raster(coarser_raster(exact_raster(options),
                              (std::max)(std::clamp(4. * double(triangles), 64. * 64., 96. * 96.),
                                         64. * double(shapes)))),
      m_highest(std::sqrt(double(options.width) * double(options.height) * double(m_pages) / area))
  {}

  // The part of the pages that the shapes have at a level.
  static double used(int level) { return std::exp2(level / levels_of_half); }
  // The first level at which they have at least this part.
  static int level_of(double used)
  {
    constexpr double least = 0x1p-16; // what is less makes no difference
    return int(std::ceil(levels_of_half * std::log2((std::max)(least, used)) - 1e-9));
  }

  // Texels along a unit of the outlines.
  double density(int level) const { return m_highest * std::exp2(0.5 * level / levels_of_half); }

  // The highest level found from `least` on, or `least` - 1 if none is.
  int highest_level(const std::vector<Packable>& shapes, int least) const
  {
    constexpr int first_step = 4;
    int low = least - 1, high = 1;
    for(int level = least, step = first_step; high - low > 1;) {
      if(fits(shapes, level))
        low = level;
      else
        high = level;
      if(low < least)
        return low;
      level = high > 0 ? (std::min)(0, low + step) : low + (high - low) / 2;
      step *= 2;
    }
    return low;
  }

  // Whether they can be packed at a level.
  bool fits(const std::vector<Packable>& shapes, int level) const
  {
    Packing_keys keys;
    for(const Packable& shape : shapes)
      keys.push_back(key_of(shape->outline()));
    std::array<char, 2> fit = {}; // with each order
    Blocked_execution::blocked_for(shapes.size() == 1 ? 1 : fit.size(), 1, [&](std::size_t i, std::size_t) {
      fit[i] = fits(shapes, level, order_of(i == 0 ? keys : perturbed(keys, i))) ? 1 : 0;
    });
    return fit[0] || fit[1];
  }

  // The positions of all shapes that were packed so far, most of which need no look.
  double work() const { return double(m_work); }

private:
  static constexpr double levels_of_half = 64.;
  static constexpr int rotations = 8, rotations_alone = 48;

  bool fits(const std::vector<Packable>& shapes, int level, const std::vector<std::uint32_t>& order) const
  {
    const int directions = shapes.size() == 1 ? rotations_alone : rotations;
    std::vector<Page_raster> pages;
    for(const std::uint32_t shape : order) {
      m_work += std::uint64_t(directions) * std::uint64_t(m_raster.width) * std::uint64_t(m_raster.height);
      const std::vector<Chart_raster>& rasters
        = shapes[shape]->rasters(level, density(level), directions, m_raster);
      Place_search search(Place_criterion::SNUG);
      for(std::size_t p = 0; p < m_pages && !search.best().is_found(); ++p) {
        if(p == pages.size())
          pages.emplace_back(m_raster.width, m_raster.height);
        for(std::size_t r = 0; r < rasters.size(); ++r)
          search.search(rasters[r], pages[p], std::uint32_t(p), int(r));
      }
      const Raster_place& place = search.best();
      if(!place.is_found())
        return false;
      pages[place.page].take(rasters[place.rotation].padded, place.x, place.y);
    }
    return true;
  }

  std::size_t m_pages;
  Packing_raster m_raster;
  double m_highest; // the density of level 0
  mutable std::atomic<std::uint64_t> m_work{0};
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_PACKING_ESTIMATE_H
