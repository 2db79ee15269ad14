// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_MERGER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_MERGER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Union_finder.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What counts when charts are merged; all terms are free of units.
struct Merge_weights
{
  double distortion = 1.; // of the union, 1 at the bound
  double seam = 1.;       // times the seam removed, to the shorter one of the two perimeters
  double crease = 0.3;    // times the part of the seam removed that lies on features
  double size = 0.05;     // times the logarithm of the union's share of the area
  double fill = 0.5;      // times the part of its convex hull that the union leaves empty
};

// Charts that are merged two by two. A chart is a set of triangles that form a disk when cut along
// the seams; a merge removes one arc of the seams between two charts, so that the union is one too.
class Chart_merger
{
  static constexpr double least_neck = 0.12; // between two charts, to the smaller perimeter

public:
  typedef Chart_state::Indices Indices;

  // Merges keep within `bound`, and leave `least` charts in each component.
  Chart_merger(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature,
               const Distortion_bound& bound, double least_fill, std::size_t least)
    : m_surface(surface), m_bound(bound), m_least_fill(least_fill), m_least(least)
    , m_finder(surface, is_feature), m_cutter(surface.mesh, surface.adjacency)
    , m_is_opened(3 * surface.size(), 0)
  {
    for(const double a : surface.area)
      m_area += a;
  }

  // From now on charts may be mapped with little stretch, see `try_map()`, until `merge()` has done so
  // much more work.
  void allow_stretch(double most_work)
  {
    m_may_stretch = true;
    m_most_work = m_work + most_work;
    for(auto known = m_known.begin(); known != m_known.end();)
      known = is_worth_stretching(known->second.distortion, m_bound) ? m_known.erase(known)
                                                                     : std::next(known);
  }

  // The charts with the given seams and labels of triangles, which are less than `number`; not all
  // of these need have triangles.
  Chart_state start(const Seam_graph& graph, const Indices& label, std::size_t number);

  // Merges while a union of two charts, one of which is among the `active` ones or made of them, is
  // within the bound.
  void merge(Chart_state& state, const Indices& active, const Merge_weights& weights);

  // Merges the union of least distortion, whatever it is, until no more than `number` are left or
  // nothing can be merged.
  void merge_down_to(Chart_state& state, std::size_t number);

  bool is_good(const Trial_map& trial) const
  {
    return trial.is_disk && trial.is_one_to_one && trial.distortion.is_within(m_bound)
        && trial.fill >= m_least_fill;
  }

  double work() const { return m_work; } // triangles mapped so far, as if all had been conformally
  void set_progress(std::function<bool()> goes_on) { m_goes_on = std::move(goes_on); }

private:
  typedef Chart_state::Pair Pair;
  typedef std::map<Pair, Chart_union> Candidates;
  typedef std::vector<Candidates::value_type*> Some_candidates; // in their order

  Some_candidates add_candidates(Chart_state& state, std::uint32_t c, Candidates& candidates);
  static Some_candidates all_of(Candidates& candidates)
  {
    Some_candidates result;
    for(auto& candidate : candidates)
      result.push_back(&candidate);
    return result;
  }
  void try_all(const Chart_state& state, const Some_candidates& candidates);
  std::vector<Chart_union*> try_arcs(const Chart_state& state, const Some_candidates& candidates,
                                     bool may_be_draft);
  void finish_drafts(const Chart_state& state, const Some_candidates& candidates)
  {
    try_arcs(state, candidates, false);
  }
  double cost(const Chart_state& state, const Pair& pair, const Chart_union& candidate,
              const Merge_weights& weights) const;
  bool may_merge(const Chart_state& state, const Pair& pair) const
  {
    const Chart_piece& piece = state.pieces[pair.first];
    return state.charts_of_component[m_surface.component[piece.triangles[0]]] > m_least;
  }
  bool has_thin_neck(const Chart_state& state, const Pair& pair, const Chart_union& candidate) const
  {
    return candidate.removed < least_neck * (std::min)(state.pieces[pair.first].perimeter,
                                                       state.pieces[pair.second].perimeter);
  }
  bool is_far_beyond_bound(const Trial_map& trial) const
  {
    constexpr double much = 1.3; // the power of the bound
    return trial.is_disk && part_of_bound(trial.distortion, m_bound) > much;
  }
  Some_candidates merge_pair(Chart_state& state, const Pair& pair, Candidates& candidates);
  void apply(Chart_state& state, const Pair& pair, const Chart_union& candidate) const;

  const Growth_surface& m_surface;
  Distortion_bound m_bound;
  bool m_may_stretch = false;
  double m_least_fill;
  std::size_t m_least;
  Union_finder m_finder;
  Chart_cutter<Halfedge_triangles> m_cutter;
  std::vector<std::uint8_t> m_is_opened; // of each halfedge; all 0 between calls
  double m_area = 0.;
  double m_work = 0., m_most_work = (std::numeric_limits<double>::infinity)();
  std::size_t m_stamp = 0; // of the last candidate
  std::unordered_map<std::uint64_t, Trial_map> m_known; // by a hash of triangles and seams
  std::function<bool()> m_goes_on;
};

inline Chart_state Chart_merger::start(const Seam_graph& graph, const Indices& label, std::size_t number)
{
  Chart_state state = {graph, label, std::vector<Chart_piece>(number), 0,
                       std::vector<std::size_t>(m_surface.number_of_components, 0)};
  for(std::uint32_t t = 0; t < label.size(); ++t)
    state.pieces[label[t]].triangles.push_back(t);
  Candidates candidates;
  for(std::uint32_t c = 0; c < number; ++c) {
    Chart_piece& piece = state.pieces[c];
    if(piece.triangles.empty())
      continue;
    state.measure(m_surface, piece);
    ++state.number_of_charts;
    ++state.charts_of_component[m_surface.component[piece.triangles[0]]];
    candidates[Pair(c, c)];
  }
  try_all(state, all_of(candidates));
  finish_drafts(state, all_of(candidates));
  for(const auto& [pair, candidate] : candidates)
    state.pieces[pair.first].trial = candidate.trial;
  return state;
}

// Returns those that are new.
inline Chart_merger::Some_candidates
Chart_merger::add_candidates(Chart_state& state, std::uint32_t c, Candidates& candidates)
{
  Some_candidates result;
  for(const std::uint32_t d : state.neighbors(c)) {
    const Pair pair(std::minmax(c, d));
    if(candidates.count(pair) > 0)
      continue;
    result.push_back(&*candidates.emplace(pair, m_finder.find(state, pair)).first);
    result.back()->second.stamp = ++m_stamp;
  }
  return result;
}

// Maps the unions that have not been mapped yet, with a cut to a tip if they are too much distorted
// without; (a, a) stands for chart a alone.
inline void Chart_merger::try_all(const Chart_state& state, const Some_candidates& candidates)
{
  bool has_darts = false;
  for(Chart_union* c : try_arcs(state, candidates, true))
    if(c->trial.is_disk && !c->trial.distortion.is_within(m_bound)
       && m_finder.make_dart(state, *c)) {
      c->is_known = false;
      has_darts = true;
    }
  if(has_darts)
    try_arcs(state, candidates, true);
  for(Candidates::value_type* item : candidates)
    item->second.is_hopeless = item->second.is_hopeless || is_far_beyond_bound(item->second.trial);
}

// The same without cuts; returns those that were not known, or known as drafts if that is not enough.
inline std::vector<Chart_union*> Chart_merger::try_arcs(const Chart_state& state,
                                                        const Some_candidates& candidates, bool may_be_draft)
{
  struct Item
  {
    Chart_union* candidate;
    std::uint64_t key;
    Chart_mesh chart;
  };
  std::vector<Chart_union*> fresh;
  std::vector<Item> items;
  const auto is_enough = [&](const Trial_map& trial) { return may_be_draft || !trial.is_draft; };
  const auto is_open = [&](Halfedge h) { return m_is_opened[h] || !state.graph.is_seam(h); };
  const auto set_opened = [&](const Chart_union& candidate, std::uint8_t value) {
    for(const Halfedge h : candidate.opened)
      m_is_opened[h] = m_is_opened[state.graph.opposite(h)] = value;
  };
  for(Candidates::value_type* item : candidates) {
    auto& [pair, candidate] = *item;
    if((candidate.is_known && is_enough(candidate.trial)) || candidate.is_hopeless)
      continue;
    candidate.is_known = true;
    fresh.push_back(&candidate);
    set_opened(candidate, 1);
    Indices triangles = state.union_of(pair);
    const std::uint64_t key = hash_of(triangles, is_open);
    const auto known = m_known.find(key);
    if(known != m_known.end())
      candidate.trial = known->second;
    if(known == m_known.end() || !is_enough(known->second))
      items.push_back({&candidate, key, m_cutter(std::move(triangles), is_open)});
    set_opened(candidate, 0);
  }
  Blocked_execution::blocked_for(items.size(), 1, [&](std::size_t i, std::size_t) {
    items[i].candidate->trial = may_be_draft ? try_draft(items[i].chart, m_bound, m_may_stretch)
                                             : finished_draft(items[i].chart, m_bound);
  });
  for(const Item& item : items) {
    m_known.insert_or_assign(item.key, item.candidate->trial);
    m_work += item.candidate->trial.work * double(item.chart.mesh.triangles.size());
  }
  return fresh;
}

// Of a union that has not been mapped yet, what it costs at least; where maps take long, what it may cost.
inline double Chart_merger::cost(const Chart_state& state, const Pair& pair, const Chart_union& candidate,
                                 const Merge_weights& weights) const
{
  const Chart_piece &a = state.pieces[pair.first], &b = state.pieces[pair.second];
  const double hope = m_may_stretch ? 1.2 : 0.7; // for a union, which may be less distorted than a part
  const auto part = [this](const Trial_map& trial) { return part_of_bound(trial.distortion, m_bound); };
  const double parts = (std::max)(part(a.trial), part(b.trial));
  const double distortion = candidate.is_known ? part(candidate.trial)
                                               : hope * (parts < 1. ? parts : 1.); // not a number without area
  return weights.distortion * distortion
       - weights.seam * candidate.removed / (std::min)(a.perimeter, b.perimeter)
       + weights.crease * candidate.crease / candidate.removed
       + weights.size * std::log((a.area + b.area) / m_area)
       + weights.fill * (candidate.is_known ? 1. - candidate.trial.fill : 0.);
}

inline void Chart_merger::apply(Chart_state& state, const Pair& pair, const Chart_union& candidate) const
{
  Chart_piece both;
  both.triangles = state.union_of(pair);
  both.trial = candidate.trial;
  for(const std::uint32_t t : state.replace(pair.second, Chart_piece()).triangles)
    state.set_label(t, pair.first);
  for(const std::uint32_t h : candidate.opened)
    state.set_seam(h, false);
  state.measure(m_surface, both);
  state.count(m_surface.component[both.triangles[0]], false);
  state.replace(pair.first, std::move(both));
}

// Merges the pair and renews the candidates, which are those of neighbours: what was hopeless with a
// part is so with the union. Returns the new ones.
inline Chart_merger::Some_candidates
Chart_merger::merge_pair(Chart_state& state, const Pair& pair, Candidates& candidates)
{
  Indices foes;
  for(const std::uint32_t part : {pair.first, pair.second})
    for(const std::uint32_t c : state.neighbors(part)) {
      const auto found = candidates.find(Pair(std::minmax(part, c)));
      if(found == candidates.end() || found->first == pair)
        continue;
      if(found->second.is_hopeless)
        foes.push_back(c);
      candidates.erase(found);
    }
  apply(state, pair, candidates[pair]);
  candidates.erase(pair);
  const Some_candidates result = add_candidates(state, pair.first, candidates);
  for(const std::uint32_t c : foes)
    candidates[Pair(std::minmax(pair.first, c))].is_hopeless = true;
  return result;
}

inline void Chart_merger::merge(Chart_state& state, const Indices& active,
                                const Merge_weights& weights)
{
  // What it costs to merge a pair; that of the least cost comes first, of equal ones the first pair
  struct Offer
  {
    double cost;
    Pair pair;
    std::size_t stamp;
    bool operator<(const Offer& o) const
    {
      return cost != o.cost ? cost > o.cost : pair > o.pair;
    }
  };
  std::priority_queue<Offer> offers;
  Candidates candidates;
  const auto offer = [&](const Candidates::value_type& item) {
    const auto& [pair, candidate] = item;
    if(candidate.is_hopeless || has_thin_neck(state, pair, candidate)
       || (candidate.is_known && !is_good(candidate.trial)))
      return;
    const double c = cost(state, pair, candidate, weights);
    if(c < (std::numeric_limits<double>::max)())
      offers.push({c, pair, candidate.stamp});
  };
  for(const std::uint32_t c : active)
    add_candidates(state, c, candidates);
  for(const Candidates::value_type& item : candidates)
    offer(item);
  Candidates::iterator best;
  // Takes those from the offers whose turn comes before that of one that is not wanted, which `best` is then.
  const auto take = [&](std::size_t most, const auto& is_wanted) {
    Some_candidates result;
    for(; !offers.empty() && result.size() < most; offers.pop()) {
      const Offer& o = offers.top();
      best = candidates.find(o.pair);
      if(best == candidates.end() || best->second.stamp != o.stamp || !may_merge(state, o.pair))
        continue;
      if(!is_wanted(best->second))
        break;
      result.push_back(&*best);
    }
    return result;
  };
  const auto is_draft = [](const Chart_union& c) { return c.is_known && c.trial.is_draft; };
  constexpr std::size_t at_a_time = 4, drafts_at_a_time = 2; // of those that are mapped
  while(!m_goes_on || m_goes_on()) {
    const bool is_worn = m_work >= m_most_work; // then nothing more is mapped
    Some_candidates some = take(at_a_time, [&](const Chart_union& c) {
      return !c.is_known || (is_worn && is_draft(c));
    });
    if(is_worn && !some.empty())
      continue;
    if(!some.empty())
      try_all(state, some);
    else if(offers.empty())
      return;
    else if(is_draft(best->second))
      finish_drafts(state, some = take(drafts_at_a_time, is_draft));
    else
      some = merge_pair(state, Pair(best->first), candidates);
    for(const Candidates::value_type* item : some)
      offer(*item);
  }
}

inline void Chart_merger::merge_down_to(Chart_state& state, std::size_t number)
{
  Candidates candidates;
  for(std::uint32_t c = 0; c < state.pieces.size(); ++c)
    add_candidates(state, c, candidates);
  while(state.number_of_charts > number && (!m_goes_on || m_goes_on())) {
    for(auto& [pair, candidate] : candidates)
      candidate.is_hopeless = false;
    try_all(state, all_of(candidates));
    Candidates::value_type* best = nullptr;
    std::pair<int, double> least;
    for(auto& item : candidates) {
      const auto& [pair, candidate] = item;
      const Trial_map& trial = candidate.trial;
      if(!may_merge(state, pair) || candidate.opened.empty())
        continue;
      const int defect = !trial.is_disk ? 2 : trial.is_one_to_one ? 0 : 1;
      const std::pair<int, double> c(
        defect, trial.distortion.area_scale * trial.distortion.quasi_conformal);
      if(best == nullptr || c < least) {
        least = c;
        best = &item;
      }
    }
    if(best == nullptr)
      return;
    if(best->second.trial.is_draft)
      finish_drafts(state, {best});
    else
      merge_pair(state, Pair(best->first), candidates);
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_MERGER_H
