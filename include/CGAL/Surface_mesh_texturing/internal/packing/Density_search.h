// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_DENSITY_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_DENSITY_SEARCH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Overlap_search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The side of the cells on which all places are looked at, of which there are 72 to 288 a chart.
inline int coarse_ratio(const Packing_raster& exact, std::size_t pages, std::size_t charts)
{
  const double cells = double(exact.width) * exact.height * double(pages);
  int ratio = 1;
  while(cells / (4. * ratio * ratio) >= 72. * double(charts))
    ratio *= 2;
  return ratio;
}

// Densities in steps of a quarter of a percent; no packing has a density above that of level 0.
class Density_ladder
{
public:
  // The area of the charts must not exceed that of the pages, nor a chart's diameter the diagonal
  // of a page.
  Density_ladder(const std::vector<Chart_outline>& outlines, const Packing_raster& raster,
                 std::size_t pages)
  {
    double area = 0., diameter = 0.;
    for(const Chart_outline& outline : outlines) {
      area += outline.area;
      diameter = (std::max)(diameter, outline.diameter);
    }
    const double w = raster.width * raster.cell, h = raster.height * raster.cell;
    m_highest = (std::numeric_limits<double>::infinity)();
    if(diameter > 0.)
      m_highest = std::hypot(w, h) / diameter;
    if(area > 0.)
      m_highest = (std::min)(m_highest, std::sqrt(w * h * double(pages) / area));
    if(!(m_highest < (std::numeric_limits<double>::infinity)()))
      m_highest = 1.; // all charts are points
  }

  // In texels per unit.
  double density(double level) const { return m_highest * std::exp2(level / 256.); }

  // A level at which all charts are smaller than a texel.
  int lowest() const { return -256 * 64; }

private:
  double m_highest;
};

// Returns the highest level up to 0 for which `succeeds(level)`, if there is one among those
// tried, or `lowest` - 1: success is taken to be monotone. Begins at `guess` with steps of `step`,
// which grow until the level is between two; ends when these are `precision` apart.
template <class Succeeds>
int highest_level(int lowest, int guess, int step, const Succeeds& succeeds, int precision = 1)
{
  int low = lowest - 1, high = 1; // success, failure
  for(int level = guess; high - low > (low < lowest ? 1 : precision);) {
    if(succeeds(level))
      low = level;
    else
      high = level;
    if(low < lowest)
      level = (std::max)(lowest, high - step);
    else if(high > 0)
      level = (std::min)(0, low + step);
    else
      level = low + (high - low) / 2;
    step *= 2;
  }
  return low;
}

// A packing on the raster of texels, and its level.
struct Raised_packing
{
  double level = 0.;
  std::vector<Raster_place> places; // empty if there is none better than the first one
};

// Raises the density of a packing step by step, each time moving charts until none overlap.
class Density_raising
{
public:
  // `base` and `ladder` must outlive this.
  Density_raising(Overlap_search_base& base, const Density_ladder& ladder)
    : m_base(base), m_ladder(ladder)
  {}

  // The best packing found from one with this level as long as `may_go_on()`, and then by small moves
  // between two levels as long as `may_end()`.
  template <class May_go_on, class May_end>
  Raised_packing run(int level, const std::vector<Loose_place>& packing, const May_go_on& may_go_on,
             const May_end& may_end);

private:
  Overlap_search& search(int level)
  {
    std::unique_ptr<Overlap_search>& s = m_searches[level];
    if(!s)
      s.reset(new Overlap_search(m_base, m_ladder.density(level)));
    return *s;
  }

  template <class May_go_on>
  Raised_packing raise(int level, std::vector<Loose_place>& packing, const May_go_on& may_go_on);

  // Makes the packing the best one, if all pages are used; returns whether they are.
  bool take(double level, Overlap_search& search, const std::vector<Loose_place>& places,
            Raised_packing& result) const
  {
    if(!uses_all_pages(places))
      return false;
    result.level = level;
    result.places.clear();
    for(std::size_t i = 0; i < places.size(); ++i)
      result.places.push_back(search.exact().raster_place(i, places[i]));
    return true;
  }

  std::vector<Loose_place> with_two_swapped(std::vector<Loose_place> places)
  {
    const std::size_t i = m_base.random.index(places.size());
    const std::size_t j = m_base.random.index(places.size());
    std::swap(places[i].centre, places[j].centre);
    std::swap(places[i].page, places[j].page);
    return places;
  }

  bool uses_all_pages(const std::vector<Loose_place>& places) const
  {
    std::vector<char> is_used(m_base.pages, 0);
    for(const Loose_place& place : places)
      is_used[place.page] = 1;
    return std::find(is_used.begin(), is_used.end(), 0) == is_used.end();
  }

  Overlap_search_base& m_base;
  const Density_ladder& m_ladder;
  std::map<int, std::unique_ptr<Overlap_search>> m_searches; // by level
};

// On the middle raster the density rises as far as possible; each state without overlap there is
// then finished at the lowest density that would be better than the best, and those above. `packing`
// becomes that of the result.
template <class May_go_on>
Raised_packing Density_raising::raise(int level, std::vector<Loose_place>& packing,
                                               const May_go_on& may_go_on)
{
  constexpr int failures_allowed = 10;
  constexpr double work_of_a_round = 1e6; // even if a chart is larger than the page at once
  Raised_packing result = {double(level), {}};
  std::vector<Loose_place> loose = packing;
  int best = level, top = level, step = 4, failures = 0;
  while(best < 0 && may_go_on()) {
    m_base.work += work_of_a_round;
    const int target = (std::min)(0, top + step);
    std::vector<Loose_place> places = failures > 0 ? with_two_swapped(loose) : loose;
    if(!search(target).separate(places, may_go_on)) {
      ++failures;
      if(step > 1) {
        step /= 2;
        failures = 0;
      } else if(failures % failures_allowed == 0)
        top = (std::max)(best - 1, top - 1);
      continue;
    }
    failures = top == target ? failures + 1 : 0;
    top = target;
    loose = places;
    while(best < top && search(best + 1).finish(places, may_go_on)
          && take(best + 1, search(best + 1), places, result)) {
      ++best;
      packing = places;
      m_searches.erase(m_searches.begin(), m_searches.lower_bound(best));
      places = loose;
    }
  }
  return result;
}

template <class May_go_on, class May_end>
Raised_packing Density_raising::run(int level, const std::vector<Loose_place>& packing,
                                             const May_go_on& may_go_on, const May_end& may_end)
{
  constexpr double least_step = 0.125; // of levels
  std::vector<Loose_place> best = packing;
  Raised_packing result = raise(level, best, may_go_on);
  for(double step = 0.5; step >= least_step && result.level < 0.; step /= 2.) {
    Overlap_search between(m_base, m_ladder.density(result.level + step));
    std::vector<Loose_place> places = best;
    if(between.finish(places, may_end) && take(result.level + step, between, places, result))
      best = places;
  }
  return result;
}

// A packing that is to become denser.
struct Raising_task
{
  const std::vector<Chart_outline>& outlines;
  int rotations;
  const Packing_raster& exact;
  std::size_t pages;
  const Density_ladder& ladder;
  int level;
  std::vector<Loose_place> packing;
  double work; // of each search, about the nanoseconds
};

// The best packing of some searches with other random numbers, in parallel. `tell(work)` gets the mean
// of their work so far, from one thread at a time, and returns whether to go on.
template <class Tell>
Raised_packing raised_packing(const Raising_task& task, const Tell& tell)
{
  constexpr std::size_t searches = 2;
  constexpr int steps = 4;         // to the density searched first
  constexpr double end_work = 5e7; // for the moves between two levels
  const int ratio = coarse_ratio(task.exact, task.pages, task.outlines.size());
  const double density = task.ladder.density((std::min)(0, task.level + steps));
  std::vector<Raised_packing> raised(searches);
  std::vector<double> told(searches, 0.);
  std::mutex mutex;
  Blocked_execution::blocked_for(searches, 1, [&](std::size_t i, std::size_t) {
    double work = 0.;
    const auto goes_on = [&](double most) {
      const std::lock_guard<std::mutex> lock(mutex);
      told[i] = (std::min)(work, task.work);
      return tell(std::accumulate(told.begin(), told.end(), 0.) / double(searches)) && work < most;
    };
    Overlap_search_base base = {
      Silhouettes(task.outlines, task.rotations, density, Silhouette_raster(task.exact, ratio), work),
      task.exact, task.pages, Xorshift(i + 1), work};
    raised[i] = Density_raising(base, task.ladder)
                  .run(task.level, task.packing, [&] { return goes_on(task.work); },
                       [&] { return goes_on(task.work + end_work); });
  });
  return *std::max_element(raised.begin(), raised.end(), [](const auto& a, const auto& b) {
    return a.level < b.level;
  });
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_DENSITY_SEARCH_H
