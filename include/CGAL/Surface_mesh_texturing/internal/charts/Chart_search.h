// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_merger.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/grow_patches.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Seams along features count less, so that they stay there.
constexpr double feature_length_factor = 0.25;

// Lets seams that run around two sides of a triangle go along the third one, if that is shorter.
class Seam_corner_cutter
{
public:
  Seam_corner_cutter(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature)
    : m_surface(surface), m_is_feature(is_feature)
  {}

  // Changes the triangles for which `may_change` until no seam gets shorter.
  template <class MayChange>
  void run(Seam_graph& graph, std::vector<std::uint32_t>& label, const MayChange& may_change) const
  {
    std::vector<std::uint32_t> waiting;
    for(std::uint32_t t = 0; t < label.size(); ++t)
      waiting.push_back(t);
    // Each step makes the seams shorter; rounding could undo that only for sides of equal length
    for(std::size_t i = 0; i < waiting.size() && i < 8 * label.size(); ++i)
      if(may_change(waiting[i]) && cut_corner(graph, label, waiting[i]))
        for(std::uint32_t h = 3 * waiting[i], end = h + 3; h < end; ++h)
          waiting.push_back(triangle_of(graph.opposite(h)));
  }

private:
  double weight(std::uint32_t h) const
  {
    return m_surface.length[h] * (m_is_feature[h] ? feature_length_factor : 1.);
  }

  //      b            b
  //   __ v __      _______     The seam around the corner v, which no other seam meets, goes along
  //     / \                    the opposite side; t goes from one chart to the other.
  //  a /_t_\    =>  a  t
  //
  bool cut_corner(Seam_graph& graph, std::vector<std::uint32_t>& label, std::uint32_t t) const
  {
    for(std::uint32_t third = 3 * t; third < 3 * t + 3; ++third) {
      const std::uint32_t first = next_halfedge(third), second = next_halfedge(first);
      if(graph.is_seam(third) || !graph.is_seam(first) || !graph.is_seam(second)
         || graph.is_border(first) || graph.is_border(second)
         || graph.degree(graph.target(first)) != 2
         || !(weight(first) + weight(second) > (1. + 1e-9) * weight(third)))
        continue;
      label[t] = label[triangle_of(graph.opposite(first))];
      graph.remove_seam(first);
      graph.remove_seam(second);
      graph.add_seam(third);
      return true;
    }
    return false;
  }

  const Growth_surface& m_surface;
  const std::vector<std::uint8_t>& m_is_feature;
};

// What is searched with, from Chart_growth_options: angles in radians, the part of the bound that is
// used.
struct Search_options
{
  Distortion_bound bound;
  std::size_t least_charts = 1;
  std::size_t max_charts = 0;
  double feature_angle = 0.5; // radians
  double least_fill = 0.65;
  std::size_t patch_size = 25;
  bool may_stretch = false;
  double effort = 150.;
  bool is_thorough = false;
  std::function<bool()> is_enough;
  std::function<bool(double)> progress;
};

// Looks for few charts: merges patches, then takes charts and their neighbours apart and merges
// them again in another order, and keeps what is better.
class Chart_search
{
  typedef Chart_state State;
  static constexpr std::size_t few_neighbors = 4;   // one more than are taken apart with a chart
  static constexpr std::size_t many_neighbors = 13; // the same when fewer have not helped any more
  static constexpr std::size_t most_failures = 8;  // rounds without success in succession
  static constexpr double least_gain = 1e-9;       // of the length of the seams

public:
  Chart_search(const Growth_surface& surface, const Search_options& options)
    : m_surface(surface), m_options(options)
    , m_is_feature(feature_edges(surface, options.feature_angle))
    , m_merger(surface, m_is_feature, options.bound, options.least_fill, options.least_charts)
    , m_most_work(options.effort * double(surface.size()))
  {
    m_merger.set_progress([this] { return tell_progress() && !is_enough(); });
  }

  // Returns false if it was cancelled.
  bool run();

  const State& best() const { return *m_best; }

private:
  State start();
  void improve();
  bool improve_around(std::uint32_t c, std::size_t round);
  void straighten();
  State straightened(const std::vector<bool>& is_fixed);
  std::vector<std::uint32_t> charts_by_area() const;
  bool tell_progress();
  bool is_enough() const { return m_options.is_enough && m_options.is_enough(); }
  bool is_worn() const { return m_merger.work() >= m_most_work || is_enough(); }

  const Growth_surface& m_surface;
  const Search_options& m_options;
  const std::vector<std::uint8_t> m_is_feature;
  Chart_merger m_merger;
  double m_most_work;
  std::size_t m_neighbors = few_neighbors;
  double m_seam_length = 0.; // of the best charts
  bool m_is_cancelled = false;
  std::optional<State> m_atoms, m_best;
};

inline bool Chart_search::tell_progress()
{
  if(!m_is_cancelled && m_options.progress)
    m_is_cancelled = !m_options.progress((std::min)(1., m_merger.work() / m_most_work));
  return !m_is_cancelled;
}

// The patches, finer where they are not within the bound.
inline Chart_search::State Chart_search::start()
{
  Patch_growth growth(m_surface, m_is_feature);
  const std::size_t number = m_surface.size() / m_options.patch_size;
  constexpr std::size_t least_patches = 6; // of a component
  growth.grow(number, (std::max)(least_patches, 2 * m_options.least_charts));
  const Seam_corner_cutter corner_cutter(m_surface, m_is_feature);
  for(;;) {
    Seam_graph graph = growth.seams();
    std::vector<std::uint32_t> patch = growth.patch(), bad;
    corner_cutter.run(graph, patch, [](std::uint32_t) { return true; });
    State state = m_merger.start(graph, patch, growth.number_of_patches());
    for(std::uint32_t p = 0; p < state.pieces.size(); ++p)
      if(!m_merger.is_good(state.pieces[p].trial))
        bad.push_back(p);
    if(is_enough() || !growth.refine(bad))
      return state;
  }
}

inline bool Chart_search::run()
{
  if(!tell_progress())
    return false;
  m_atoms = start();
  m_best = m_atoms;
  std::vector<std::uint32_t> all(m_best->pieces.size());
  std::iota(all.begin(), all.end(), 0u);
  m_merger.merge(*m_best, all, Merge_weights());
  improve();
  if(m_options.may_stretch) { // from the first on there would be no fewer charts, and more stretched ones
    constexpr double share = 6.; // of the work of the search
    m_merger.allow_stretch(share * m_most_work);
    m_merger.merge(*m_best, all, Merge_weights());
  }
  if(m_options.max_charts > 0)
    m_merger.merge_down_to(*m_best, m_options.max_charts);
  straighten();
  return tell_progress();
}

inline std::vector<std::uint32_t> Chart_search::charts_by_area() const
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t c = 0; c < m_best->pieces.size(); ++c)
    if(!m_best->pieces[c].triangles.empty())
      result.push_back(c);
  std::stable_sort(result.begin(), result.end(), [this](std::uint32_t c, std::uint32_t d) {
    return m_best->pieces[c].area < m_best->pieces[d].area;
  });
  return result;
}

// Merges chart c and its smallest neighbours anew, or the patches of c alone; returns whether that
// was better. The weights change from round to round.
inline bool Chart_search::improve_around(std::uint32_t c, std::size_t round)
{
  static constexpr std::array<Merge_weights, 4> weights = {{
    Merge_weights(), {1., 0.2, 0.2, 0.3, 0.5}, {0.5, 1., 0.3, 0.05, 1.},
    {0.3, 0.3, 0.2, 0.6, 0.3}}};
  State& state = *m_best;
  std::vector<std::uint32_t> charts = state.neighbors(c);
  std::stable_sort(charts.begin(), charts.end(), [&state](std::uint32_t a, std::uint32_t b) {
    return state.pieces[a].area < state.pieces[b].area;
  });
  charts.resize((std::min)(charts.size(), round % m_neighbors));
  charts.push_back(c);
  const std::size_t number_before = state.number_of_charts;
  Chart_changes changes;
  state.changes = &changes;
  const std::vector<std::uint32_t> active = state.take_apart(m_surface, *m_atoms, charts);
  m_merger.merge(state, active, weights[round % weights.size()]);
  const bool is_better
    = state.number_of_charts != number_before
        ? state.number_of_charts < number_before
        : state.growth_of_seams(changes) < -least_gain * m_seam_length;
  if(m_is_cancelled || !is_better) {
    state.undo(std::move(changes));
    return false;
  }
  state.changes = nullptr;
  m_seam_length = state.seam_length();
  return true;
}

inline void Chart_search::improve()
{
  std::size_t failures = 0;
  m_seam_length = m_best->seam_length();
  for(std::size_t round = 0; failures < most_failures && !is_worn() && !m_is_cancelled; ++round) {
    bool is_improved = false;
    for(const std::uint32_t c : charts_by_area()) {
      if(is_worn() || m_is_cancelled)
        break;
      if(!m_best->pieces[c].triangles.empty())
        is_improved = improve_around(c, round) || is_improved;
    }
    failures = is_improved ? 0 : failures + 1;
    if(failures == most_failures && m_options.is_thorough && m_neighbors < many_neighbors) {
      failures = 0;
      m_neighbors += 3;
    }
  }
}

// The best charts with straight seams, but for those around the charts that are fixed.
inline Chart_search::State Chart_search::straightened(const std::vector<bool>& is_fixed)
{
  Seam_graph graph = m_best->graph;
  std::vector<std::uint32_t> label = m_best->label;
  Seam_corner_cutter(m_surface, m_is_feature).run(graph, label, [&](std::uint32_t t) {
    bool may_change = !is_fixed[label[t]];
    for(Halfedge h = 3 * t; h < 3 * t + 3; ++h) {
      const Halfedge g = m_surface.adjacency.opposite(h);
      may_change = may_change && (g == no_halfedge || !is_fixed[label[triangle_of(g)]]);
    }
    return may_change;
  });
  return m_merger.start(graph, label, m_best->pieces.size());
}

// Straightens the seams of the best charts where their maps stay good.
inline void Chart_search::straighten()
{
  std::vector<bool> is_fixed(m_best->pieces.size(), false);
  const auto is_good = [this](const State& state, std::size_t c) {
    return state.pieces[c].triangles.empty() || m_merger.is_good(state.pieces[c].trial);
  };
  for(std::size_t c = 0; c < is_fixed.size(); ++c)
    is_fixed[c] = !is_good(*m_best, c);
  for(bool is_changed = true; is_changed && !m_is_cancelled && !is_enough(); ) {
    State state = straightened(is_fixed);
    is_changed = false;
    for(std::size_t c = 0; c < is_fixed.size(); ++c)
      if(!is_fixed[c] && !is_good(state, c))
        is_fixed[c] = is_changed = true;
    if(!is_changed)
      m_best = std::move(state);
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_SEARCH_H
