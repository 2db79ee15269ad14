// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTER_PACKING_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTER_PACKING_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Density_search.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Greedy_packing.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Less than the cells that charts take on a raster, each with its share of the padding: for every
// chart the cells along the longest of its edges.
inline double least_cells(const std::vector<double>& longest_edges, double density,
                          const Packing_raster& raster)
{
  constexpr double rounding = 1. - 1e-9;
  const double padding = raster.padding, cells = rounding * density / raster.cell / std::sqrt(2.);
  double sum = 0.;
  for(const double length : longest_edges) // a side of the box around the edge is so long at least
    sum += ((std::max)(1., cells * length) + padding) * (padding + 1.);
  return sum;
}

// The search for the packing with the highest density, or for one with a given density.
class Raster_packing_search
{
public:
  // `unit` is that of the outlines.
  Raster_packing_search(const std::vector<Chart_outline>& outlines, double unit,
                        const Packing_options& options)
    : m_outlines(outlines), m_unit(unit), m_options(options),
      m_exact(options.is_draft ? draft_raster(exact_raster(options)) : exact_raster(options)),
      m_rotations(options.rotations > 0 ? options.rotations : free_rotations()),
      m_coarse(coarser_raster(m_exact, coarse_cells())),
      m_ladder(outlines, m_exact, (std::max)(std::size_t(1), options.max_pages)),
      m_longest_edges(longest_edges(outlines))
  {}

  Packing_result run()
  {
    if(m_options.texels_per_unit > 0.)
      return with_density(m_options.texels_per_unit * m_unit);
    Packing_result result;
    maximize();
    if(m_is_cancelled)
      result.cancel();
    else if(!m_best.is_complete)
      result.fail(Mesh_status::FAILED, misfit_message(0, false, m_options));
    else
      result = packing_result(m_best, *m_best_charts, m_best_density);
    return result;
  }

private:
  // An order that succeeded on the coarse raster.
  struct Plan
  {
    Packing_keys keys;
    int level = 0;
    Raster_packing packing;
  };

  static constexpr std::size_t tries = 8;         // orders at a time
  static constexpr double first_work = 1.2e8;      // positions compared before those of the budget
  static constexpr double work_per_second = 1e9;  // see `Packing_options::time_budget`

  // With more charts than these, other orders are better than raising the density.
  static constexpr std::size_t most_raised = 64;

  // Enough for charts of equal sizes on one page to have 8 cells a side.
  double coarse_cells() const { return (std::max)(128. * 128., 64. * m_outlines.size()); }

  // For higher densities, before the work of the budget: less for few charts, small pages and small
  // meshes, more for large ones, of which all else takes longer. None for drafts, and for many charts, of
  // which so short a time does not make a denser packing.
  double raising_work() const
  {
    constexpr double most_charts = 40., least_size = 0.15, largest_size = 4., largest = 8.;
    const double charts = double(m_outlines.size());
    if(charts > most_charts || m_options.is_draft)
      return 0.;
    double triangles = 0.;
    for(const Chart_outline& outline : m_outlines)
      triangles += double(outline.triangles);
    const double size = (std::min)(largest_size, (std::max)(least_size, triangles / 1e4));
    const double side = std::sqrt(double(m_exact.width) * m_exact.height) / 1000.;
    return 1.5e8 * (std::min)(1., charts / 12.) * (std::min)(largest, size * side);
  }

  Packing_result with_density(double density);
  void maximize();
  Plan first_plan();
  bool improve(Plan& plan);
  void refine(const Plan& plan);
  std::vector<Loose_place> best_places(int factor) const;
  void raise_density();

  Packing_result packing_result(const Raster_packing& packing, const Chart_rasters& charts,
                                double density) const;

  // The directions if their number is free: a chart alone is turned to where it is the smallest.
  int free_rotations() const { return is_dust() ? 4 : m_outlines.size() == 1 ? 48 : 8; }

  // So many charts are mostly single triangles: a little more density is not worth minutes.
  bool is_dust() const { return m_outlines.size() > 1000; }
  int precision() const { return is_dust() ? 8 : 1; } // in levels

  // So many charts take much memory, and a look at each takes time.
  bool are_many() const { return m_outlines.size() > 512; }
  Rims rims() const { return are_many() ? Rims::NONE : Rims::ALL; }

  // Whether charts are clearly too large at a level: then there is no need to try.
  bool is_beyond_pages(const Packing_raster& raster, int level) const
  {
    const double page = double(raster.width + raster.padding) * (raster.height + raster.padding);
    return least_cells(m_longest_edges, m_ladder.density(level), raster)
         > page * double((std::max)(std::size_t(1), m_options.max_pages));
  }

  // The charts on the coarse raster.
  Chart_rasters& coarse_charts(int level)
  {
    std::unique_ptr<Chart_rasters>& charts = m_coarse_charts[level];
    if(!charts) {
      charts.reset(new Chart_rasters(m_outlines, m_rotations, m_ladder.density(level), m_coarse,
                                     rims()));
      charts->make_all();
    }
    return *charts;
  }

  // Charts of a level that no plan has; few are kept, for another look.
  void forget_charts(int level)
  {
    if(are_many())
      m_coarse_charts.erase(level);
  }

  Raster_packing pack_coarse(const Packing_keys& keys, int level)
  {
    return Greedy_packing(m_coarse, m_options.max_pages)
      .pack(*m_coarse_charts.at(level), order_of(keys), Place_criterion::SNUG);
  }

  // Tells the part of the work done, which is not known before; returns whether to go on.
  bool report()
  {
    const double all = first_work + raising_work() + work_per_second * m_options.time_budget;
    const double part = (std::min)(0.99, m_work / all);
    m_is_cancelled = m_is_cancelled || (m_options.progress && !m_options.progress(part));
    return !m_is_cancelled;
  }

  bool is_enough() const { return m_options.is_enough && m_options.is_enough(); }

  // Counts the positions of some orders.
  void count_work(const Packing_raster& raster, std::size_t orders)
  {
    m_work += double(orders) * m_outlines.size() * m_rotations * raster.width
              * raster.height;
  }

  const std::vector<Chart_outline>& m_outlines;
  double m_unit;
  const Packing_options& m_options;
  Packing_raster m_exact;
  int m_rotations; // of the orders
  Packing_raster m_coarse;
  Density_ladder m_ladder;
  std::vector<double> m_longest_edges; // of each chart
  std::map<int, std::unique_ptr<Chart_rasters>> m_coarse_charts; // by level

  Raster_packing m_best; // on the exact raster
  int m_best_level = 0;
  double m_best_density = 0.;
  std::unique_ptr<Chart_rasters> m_best_charts;
  double m_work = 0.; // positions compared
  std::size_t m_rounds = 0;
  bool m_is_cancelled = false;
};

inline Raster_packing_search::Plan Raster_packing_search::first_plan()
{
  Plan plan;
  plan.keys = keys_by_area(m_outlines);
  plan.level = highest_level(m_ladder.lowest(), -62, 16, [&](int level) {
    if(!report() || (plan.packing.is_complete && is_enough()))
      return false;
    count_work(m_coarse, 1);
    if(is_beyond_pages(m_coarse, level))
      return false;
    coarse_charts(level);
    Raster_packing packing = pack_coarse(plan.keys, level);
    const bool is_complete = packing.is_complete;
    if(is_complete)
      plan.packing = std::move(packing);
    if(is_complete)
      m_coarse_charts.erase(m_coarse_charts.begin(), m_coarse_charts.lower_bound(level));
    else
      forget_charts(level);
    return is_complete;
  }, precision());
  return plan;
}

// Tries other orders near that of the plan at higher levels; returns whether one of them succeeds,
// which the plan then is.
inline bool Raster_packing_search::improve(Plan& plan)
{
  std::vector<Plan> plans(tries);
  for(std::size_t i = 0; i < tries; ++i)
    plans[i].keys = perturbed(plan.keys, m_rounds * tries + i + 1);
  ++m_rounds;
  bool is_better = false;
  for(int level = plan.level + 1; level <= 0 && report(); ++level) {
    count_work(m_coarse, plans.size());
    if(is_beyond_pages(m_coarse, level))
      break;
    coarse_charts(level);
    Blocked_execution::blocked_for(plans.size(), 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        plans[i].packing = pack_coarse(plans[i].keys, level);
    });
    const auto fails = [](const Plan& p) { return !p.packing.is_complete; };
    plans.erase(std::remove_if(plans.begin(), plans.end(), fails), plans.end());
    if(plans.empty()) {
      forget_charts(level);
      break;
    }
    is_better = true;
    plan = plans[0];
    plan.level = level;
  }
  return is_better;
}

// Refines a plan at the highest density possible; keeps the packing if it is denser than the best.
inline void Raster_packing_search::refine(const Plan& plan)
{
  const auto succeeds = [&](int level) {
    if(!report() || (m_best.is_complete && is_enough()))
      return false;
    count_work(m_coarse, 2); // few positions are compared, but it takes this time
    if(is_beyond_pages(m_exact, level))
      return false;
    std::unique_ptr<Chart_rasters> charts(
      new Chart_rasters(m_outlines, m_rotations, m_ladder.density(level), m_exact));
    Raster_packing packing = Greedy_packing(m_exact, m_options.max_pages)
                               .refine(*charts, plan.packing, *m_coarse_charts.at(plan.level));
    const bool is_complete = packing.is_complete;
    if(is_complete) {
      m_best = std::move(packing);
      m_best_level = level;
      m_best_density = m_ladder.density(level);
      m_best_charts = std::move(charts);
    }
    return is_complete;
  };
  if(m_best.is_complete)
    highest_level(m_best_level + 1, m_best_level + 1, 1, succeeds);
  else
    highest_level(m_ladder.lowest(), plan.level, 4, succeeds, precision());
}

// The places of the best packing, for `factor` times as many directions.
inline std::vector<Loose_place> Raster_packing_search::best_places(int factor) const
{
  std::vector<Loose_place> result;
  for(std::size_t i = 0; i < m_outlines.size(); ++i) {
    const Raster_place& p = m_best.places[i];
    const Vector_2d& centre = m_best_charts->made(i, p.rotation).centre;
    const double shift = 0.5 * m_exact.padding;
    result.push_back({p.page, factor * p.rotation,
                      {p.x + centre[0] + shift, p.y + centre[1] + shift}});
  }
  return result;
}

// Continues from the best packing, with more directions if their number is free.
inline void Raster_packing_search::raise_density()
{
  constexpr int finer = 6;
  const double work = raising_work() + work_per_second * m_options.time_budget;
  if(!m_best.is_complete || m_is_cancelled || m_outlines.size() < 2 || !(work > 0.))
    return;
  const int factor = m_options.rotations > 0 ? 1 : finer, rotations = factor * m_rotations;
  const double before = m_work;
  const auto tell = [&](double work) {
    m_work = before + work;
    return report() && !is_enough();
  };
  Raised_packing raised = raised_packing(
    {m_outlines, rotations, m_exact, m_best.pages, m_ladder, m_best_level, best_places(factor), work}, tell);
  if(raised.places.empty())
    return;
  m_best.places = std::move(raised.places);
  m_best_density = m_ladder.density(raised.level);
  m_best_charts.reset(new Chart_rasters(m_outlines, rotations, m_best_density, m_exact));
  m_best_charts->make_where(
    [&](std::size_t i, int r) { return m_best.places[i].rotation == r; });
}

// The first part of the search takes up to 8 rounds, 3 for a draft; all plans on the way are refined,
// since the best one on the coarse raster need not be the best.
inline void Raster_packing_search::maximize()
{
  const std::size_t first_rounds = m_options.is_draft ? 3 : 8;
  std::vector<Plan> plans(1, first_plan());
  if(!plans[0].packing.is_complete) { // very many charts, or very long pages
    m_coarse = m_exact;
    m_coarse_charts.clear();
    plans[0] = first_plan();
  }
  if(!plans[0].packing.is_complete)
    return;
  const auto improve_last = [&] {
    Plan plan = plans.back();
    const bool is_better = improve(plan);
    if(is_better)
      plans.push_back(std::move(plan));
    return is_better;
  };
  const auto may_go_on = [&](double work) {
    return m_work < work && plans.back().level < 0 && !m_is_cancelled && !is_enough();
  };
  while(m_rounds < first_rounds && may_go_on(first_work))
    improve_last();
  for(auto plan = plans.rbegin(); plan != plans.rend() && !m_is_cancelled; ++plan)
    refine(*plan);
  if(m_outlines.size() <= most_raised) {
    raise_density();
    return;
  }
  const double work = m_work + work_per_second * m_options.time_budget;
  while(may_go_on(work))
    if(improve_last())
      refine(plans.back());
}

inline Packing_result Raster_packing_search::with_density(double density)
{
  Packing_result result;
  if(!report()) {
    result.cancel();
    return result;
  }
  Chart_rasters charts(m_outlines, m_rotations, density, m_exact, rims());
  charts.make_all();
  const std::vector<std::uint32_t> order = order_of(keys_by_area(m_outlines));
  const Raster_packing packing
    = Greedy_packing(m_exact, m_options.max_pages).pack(charts, order, Place_criterion::SNUG);
  if(packing.is_complete)
    return packing_result(packing, charts, density);
  std::size_t misfit = 0;
  bool fits = true;
  for(std::size_t i = 0; i < m_outlines.size() && fits; misfit = i++) {
    fits = false;
    for(int r = 0; r < m_rotations; ++r)
      fits = fits || charts.made(i, r).width > 0;
  }
  result.fail(Mesh_status::FAILED, misfit_message(misfit, !fits, m_options));
  return result;
}

inline Packing_result Raster_packing_search::packing_result(const Raster_packing& packing,
                                                            const Chart_rasters& charts,
                                                            double density) const
{
  Packing_result result;
  result.pages = packing.pages;
  result.texels_per_unit = density / m_unit;
  for(std::size_t i = 0; i < m_outlines.size(); ++i) {
    const Raster_place& place = packing.places[i];
    const Vector_2d& centre = charts.made(i, place.rotation).centre;
    result.placements.push_back(chart_placement(m_outlines[i], m_exact, place.page,
                                                charts.angle(i, place.rotation),
                                                result.texels_per_unit,
                                                {place.x + centre[0], place.y + centre[1]}));
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTER_PACKING_SEARCH_H
