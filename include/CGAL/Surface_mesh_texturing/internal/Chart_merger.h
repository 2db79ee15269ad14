// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_MERGER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_MERGER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/Seam_graph.h>
#include <CGAL/Surface_mesh_texturing/internal/trial_map.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
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
  double seam = 0.6;      // times the seam removed, to the shorter one of the two perimeters
  double crease = 0.4;    // times the part of the seam removed that lies on features
  double size = 0.15;     // times the logarithm of the union's share of the area
  double fill = 0.5;      // times the part of its convex hull that the union leaves empty
};

// A chart as a mesh of its own, with its border and a hash of its triangles and seams.
struct Cut_mesh
{
  Indexed_triangle_mesh mesh;
  std::vector<Border_edge> border;
  std::uint64_t key = 0xcbf29ce484222325u;

  void add_to_key(std::uint64_t x)
  {
    key = (key ^ x) * 0x100000001b3u;
    key ^= key >> 29;
  }
};

// Charts that are merged two by two. A chart is a set of triangles that form a disk when cut along
// the seams; a merge removes one arc of the seams between two charts, so that the union is one too.
class Chart_merger
{
  static constexpr std::uint32_t none = Surface_mesh_multiresolution::no_vertex;
  static constexpr double least_dart_defect = 0.3; // radians
  static constexpr double least_neck = 0.12; // between two charts, to the smaller perimeter

public:
  typedef std::vector<std::uint32_t> Indices;

  // A chart, or nothing if it has no triangles.
  struct Piece
  {
    Indices triangles; // ascending
    Trial_map trial;
    double perimeter = 0.;
    double area = 0.;
  };

  // What may change and be put back.
  struct State
  {
    Seam_graph graph;
    Indices label; // of each triangle, an index into pieces
    std::vector<Piece> pieces;
    std::size_t number_of_charts = 0;
    std::vector<std::size_t> charts_of_component;
  };

  // Merges keep within `bound`, and leave `least` charts in each component.
  Chart_merger(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature,
               const Distortion_bound& bound, double least_fill, std::size_t least)
    : m_surface(surface), m_is_feature(is_feature), m_bound(bound), m_least_fill(least_fill)
    , m_least(least), m_position(surface.size())
  {
    for(const double a : surface.area)
      m_area += a;
  }

  // The charts with the given seams and labels of triangles, which are less than `number`; not all
  // of these need have triangles.
  State start(const Seam_graph& graph, const Indices& label, std::size_t number);

  // Merges while a union of two charts, one of which `is_active`, is within the bound.
  void merge(State& state, const std::vector<bool>& is_active, const Merge_weights& weights);

  // Merges the union of least distortion, whatever it is, until no more than `number` are left or
  // nothing can be merged.
  void merge_down_to(State& state, std::size_t number);

  // Replaces the charts by pieces of `atoms`, of which they were merged; returns which pieces these
  // are now.
  std::vector<bool> take_apart(State& state, const State& atoms, const Indices& charts) const;

  // The charts that have an edge in common with chart c, ascending.
  Indices neighbors(const State& state, std::uint32_t c) const;

  double seam_length(const State& state) const;
  bool is_good(const Trial_map& trial) const
  {
    return trial.is_disk && trial.is_one_to_one && trial.distortion.is_within(m_bound)
        && trial.fill >= m_least_fill;
  }

  std::size_t work() const { return m_work; }       // triangles mapped so far
  void set_progress(std::function<bool()> goes_on) { m_goes_on = std::move(goes_on); }

private:
  typedef std::pair<std::uint32_t, std::uint32_t> Pair; // of charts, the smaller index first

  // What would become of two charts.
  struct Candidate
  {
    Indices opened;      // halfedges that would be no seams any more
    double removed = 0.; // their length
    double crease = 0.;  // their length on features
    std::size_t arc = 0; // the number of those on an arc between the charts
    Trial_map trial;
    bool is_known = false;
    bool is_hopeless = false; // far beyond the bound, or a part of it is
  };
  typedef std::map<Pair, Candidate> Candidates;

  Indices longest_arc(const State& state, std::uint32_t a, std::uint32_t b) const;
  Candidate candidate(State& state, const Pair& pair) const;
  Indices union_of(const State& state, const Pair& pair) const;
  Cut_mesh cut_mesh(const Seam_graph& graph, const Indices& triangles, const Indices& opened);
  void add_candidates(State& state, std::uint32_t c, Candidates& candidates) const;
  void try_all(const State& state, Candidates& candidates);
  void try_known_arcs(const State& state, Candidates& candidates, std::vector<Candidate*>& fresh);
  bool make_dart(const State& state, Candidate& candidate) const;
  double cost(const State& state, const Pair& pair, const Candidate& candidate,
              const Merge_weights& weights) const;
  bool may_merge(const State& state, const Pair& pair) const
  {
    const Piece& piece = state.pieces[pair.first];
    return state.charts_of_component[m_surface.component[piece.triangles[0]]] > m_least;
  }
  bool has_thin_neck(const State& state, const Pair& pair, const Candidate& candidate) const
  {
    return candidate.removed < least_neck * (std::min)(state.pieces[pair.first].perimeter,
                                                       state.pieces[pair.second].perimeter);
  }
  bool is_far_beyond_bound(const Trial_map& trial) const
  {
    constexpr double much = 1.3; // the power of the bound
    return trial.is_disk
        && (trial.distortion.area_scale > std::pow(m_bound.area_scale, much)
            || trial.distortion.quasi_conformal > std::pow(m_bound.quasi_conformal, much));
  }
  void merge_pair(State& state, const Pair& pair, Candidates& candidates) const;
  void apply(State& state, const Pair& pair, const Candidate& candidate) const;
  void measure(const Seam_graph& graph, Piece& piece) const;

  const Growth_surface& m_surface;
  const std::vector<std::uint8_t>& m_is_feature;
  Distortion_bound m_bound;
  double m_least_fill;
  std::size_t m_least;
  Indices m_position; // of triangles in a chart
  double m_area = 0.;
  std::size_t m_work = 0;
  std::unordered_map<std::uint64_t, Trial_map> m_known; // by a hash of triangles and seams
  std::function<bool()> m_goes_on;
};

inline void Chart_merger::measure(const Seam_graph& graph, Piece& piece) const
{
  piece.perimeter = piece.area = 0.;
  for(const std::uint32_t t : piece.triangles) {
    piece.area += m_surface.area[t];
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      piece.perimeter += graph.is_seam(h) ? m_surface.length[h] : 0.;
  }
}

inline Chart_merger::State Chart_merger::start(const Seam_graph& graph, const Indices& label,
                                               std::size_t number)
{
  State state = {graph, label, std::vector<Piece>(number), 0,
                 std::vector<std::size_t>(m_surface.number_of_components, 0)};
  for(std::uint32_t t = 0; t < label.size(); ++t)
    state.pieces[label[t]].triangles.push_back(t);
  Candidates candidates;
  for(std::uint32_t c = 0; c < number; ++c) {
    Piece& piece = state.pieces[c];
    if(piece.triangles.empty())
      continue;
    measure(graph, piece);
    ++state.number_of_charts;
    ++state.charts_of_component[m_surface.component[piece.triangles[0]]];
    candidates[Pair(c, c)];
  }
  try_all(state, candidates);
  for(const auto& [pair, candidate] : candidates)
    state.pieces[pair.first].trial = candidate.trial;
  return state;
}

// The mesh of the triangles, cut along the seams but those that are opened.
inline Cut_mesh Chart_merger::cut_mesh(const Seam_graph& graph, const Indices& triangles,
                                       const Indices& opened)
{
  for(std::uint32_t i = 0; i < triangles.size(); ++i)
    m_position[triangles[i]] = i;
  std::vector<std::uint8_t> is_open(3 * triangles.size());
  for(std::uint32_t i = 0; i < is_open.size(); ++i)
    is_open[i] = !graph.is_seam(3 * triangles[i / 3] + i % 3);
  for(const std::uint32_t h : opened)
    for(const std::uint32_t g : {h, graph.opposite(h)})
      is_open[3 * m_position[g / 3] + g % 3] = 1;
  Disjoint_sets corners(is_open.size());
  Cut_mesh result;
  for(std::uint32_t i = 0; i < is_open.size(); ++i) {
    const std::uint32_t h = 3 * triangles[i / 3] + i % 3;
    result.add_to_key(2 * h + is_open[i]);
    if(!is_open[i] || graph.opposite(h) > h)
      continue;
    const std::uint32_t g = graph.opposite(h), j = 3 * m_position[g / 3] + g % 3;
    corners.join(i, next_halfedge(j));
    corners.join(next_halfedge(i), j);
  }
  Indices wedge(is_open.size());
  result.mesh.triangles.resize(triangles.size());
  for(std::uint32_t i = 0; i < is_open.size(); ++i) {
    const std::uint32_t first = corners.find(i);
    if(first == i) {
      wedge[i] = std::uint32_t(result.mesh.points.size());
      result.mesh.points.push_back(
        m_surface.mesh.points[m_surface.mesh.triangles[triangles[i / 3]][i % 3]]);
    }
    result.mesh.triangles[i / 3][i % 3] = wedge[first];
  }
  for(std::uint32_t i = 0; i < is_open.size(); ++i)
    if(!is_open[i])
      result.border.push_back({wedge[corners.find(i)], wedge[corners.find(next_halfedge(i))]});
  return result;
}

// The longest arc of the seams between charts a and b, as halfedges of a. If it is a loop, so that
// the two charts are a sphere, half of it.
inline Chart_merger::Indices Chart_merger::longest_arc(const State& state, std::uint32_t a,
                                                       std::uint32_t b) const
{
  const Seam_graph& graph = state.graph;
  const auto is_between = [&](std::uint32_t h) {
    return graph.is_seam(h) && !graph.is_border(h) && state.label[graph.opposite(h) / 3] == b;
  };
  Indices best;
  double longest = -1.;
  const auto follow = [&](std::uint32_t first, double most) {
    Indices arc;
    double sum = 0.;
    for(std::uint32_t h = first; ; h = graph.next_seam(h)) {
      arc.push_back(h);
      sum += m_surface.length[h];
      if(graph.degree(graph.target(h)) != 2 || graph.next_seam(h) == first || sum >= most)
        break;
    }
    if(sum > longest) {
      longest = sum;
      best.swap(arc);
    }
  };
  const double unlimited = (std::numeric_limits<double>::max)();
  std::uint32_t some = none;
  for(const std::uint32_t t : state.pieces[a].triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      if(is_between(h)) {
        some = some == none ? h : some;
        if(graph.degree(graph.source(h)) != 2)
          follow(h, unlimited);
      }
  if(best.empty() && some != none)
    follow(some, 0.25 * (state.pieces[a].perimeter + state.pieces[b].perimeter));
  return best;
}

inline Chart_merger::Candidate Chart_merger::candidate(State& state, const Pair& pair) const
{
  Candidate result;
  result.opened = longest_arc(state, pair.first, pair.second);
  if(result.opened.empty())
    return result;
  Seam_graph& graph = state.graph;
  const std::uint32_t from = graph.source(result.opened.front());
  const std::uint32_t to = graph.target(result.opened.back());
  result.arc = result.opened.size();
  for(const std::uint32_t h : result.opened)
    graph.open(h);
  graph.zip(from, result.opened);
  graph.zip(to, result.opened);
  if(graph.is_single_edge(from)) { // a sphere with a slit of one edge is none any more
    graph.close(result.opened.front());
    result.opened.erase(result.opened.begin());
    result.arc = 0;
  }
  for(const std::uint32_t h : result.opened) {
    graph.close(h);
    result.removed += m_surface.length[h];
    result.crease += m_is_feature[h] ? m_surface.length[h] : 0.;
  }
  return result;
}

inline Chart_merger::Indices Chart_merger::union_of(const State& state, const Pair& pair) const
{
  const Indices &s = state.pieces[pair.first].triangles, &t = state.pieces[pair.second].triangles;
  if(pair.first == pair.second)
    return s;
  Indices result(s.size() + t.size());
  std::merge(s.begin(), s.end(), t.begin(), t.end(), result.begin());
  return result;
}

inline Chart_merger::Indices Chart_merger::neighbors(const State& state, std::uint32_t c) const
{
  Indices result;
  for(const std::uint32_t t : state.pieces[c].triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t g = m_surface.adjacency.opposite(h);
      if(g != none && state.label[g / 3] != c)
        result.push_back(state.label[g / 3]);
    }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

inline void Chart_merger::add_candidates(State& state, std::uint32_t c,
                                         Candidates& candidates) const
{
  for(const std::uint32_t d : neighbors(state, c)) {
    const Pair pair(std::minmax(c, d));
    if(candidates.count(pair) == 0)
      candidates.emplace(pair, candidate(state, pair));
  }
}

// Maps the unions that have not been mapped yet; (a, a) stands for chart a alone.
inline void Chart_merger::try_all(const State& state, Candidates& candidates)
{
  std::vector<Candidate*> fresh;
  try_known_arcs(state, candidates, fresh);
  bool has_darts = false;
  for(Candidate* c : fresh)
    has_darts = make_dart(state, *c) || has_darts;
  if(has_darts)
    try_known_arcs(state, candidates, fresh);
  for(auto& [pair, candidate] : candidates)
    candidate.is_hopeless = candidate.is_hopeless || is_far_beyond_bound(candidate.trial);
}

// If the union is too much distorted, leaves a part of the seam, from an end to the vertex of
// largest curvature, as a cut within the union. Returns whether there is such a vertex.
inline bool Chart_merger::make_dart(const State& state, Candidate& candidate) const
{
  const Trial_map& trial = candidate.trial;
  if(!trial.is_disk || trial.distortion.is_within(m_bound) || candidate.arc < 2)
    return false;
  const Seam_graph& graph = state.graph;
  std::size_t tip = 0;
  double largest = least_dart_defect;
  for(std::size_t i = 0; i + 1 < candidate.arc; ++i) {
    const double defect = m_surface.defect[graph.target(candidate.opened[i])];
    if(defect > largest) {
      largest = defect;
      tip = i + 1;
    }
  }
  if(tip == 0)
    return false;
  const auto begin = candidate.opened.begin();
  const auto length = [&](auto from, auto to) {
    double sum = 0.;
    for(; from != to; ++from)
      sum += m_surface.length[*from];
    return sum;
  };
  if(length(begin, begin + tip) > length(begin + tip, begin + candidate.arc))
    candidate.opened.resize(tip);
  else
    candidate.opened = Indices(begin + tip, begin + candidate.arc);
  candidate.arc = 0;
  candidate.removed = candidate.crease = 0.;
  for(const std::uint32_t h : candidate.opened) {
    candidate.removed += m_surface.length[h];
    candidate.crease += m_is_feature[h] ? m_surface.length[h] : 0.;
  }
  candidate.is_known = false;
  return true;
}

inline void Chart_merger::try_known_arcs(const State& state, Candidates& candidates,
                                         std::vector<Candidate*>& fresh)
{
  struct Item
  {
    Candidate* candidate;
    Cut_mesh chart;
  };
  std::vector<Item> items;
  for(auto& [pair, candidate] : candidates) {
    if(candidate.is_known || candidate.is_hopeless)
      continue;
    candidate.is_known = true;
    fresh.push_back(&candidate);
    Cut_mesh chart = cut_mesh(state.graph, union_of(state, pair), candidate.opened);
    const auto known = m_known.find(chart.key);
    if(known != m_known.end())
      candidate.trial = known->second;
    else
      items.push_back({&candidate, std::move(chart)});
  }
  Blocked_execution::blocked_for(items.size(), 1, [&](std::size_t i, std::size_t) {
    items[i].candidate->trial = try_map(items[i].chart.mesh, items[i].chart.border);
  });
  for(const Item& item : items) {
    m_known.emplace(item.chart.key, item.candidate->trial);
    m_work += item.chart.mesh.triangles.size();
  }
}

// What the union costs; it is not to be had if that is infinite.
inline double Chart_merger::cost(const State& state, const Pair& pair, const Candidate& candidate,
                                 const Merge_weights& weights) const
{
  const Piece &a = state.pieces[pair.first], &b = state.pieces[pair.second];
  const double distortion
    = (std::max)(std::log(candidate.trial.distortion.area_scale) / std::log(m_bound.area_scale),
                 std::log(candidate.trial.distortion.quasi_conformal)
                   / std::log(m_bound.quasi_conformal));
  return weights.distortion * distortion
       - weights.seam * candidate.removed / (std::min)(a.perimeter, b.perimeter)
       + weights.crease * candidate.crease / candidate.removed
       + weights.size * std::log((a.area + b.area) / m_area)
       + weights.fill * (1. - candidate.trial.fill);
}

inline void Chart_merger::apply(State& state, const Pair& pair, const Candidate& candidate) const
{
  Piece& a = state.pieces[pair.first];
  Indices all = union_of(state, pair);
  for(const std::uint32_t t : state.pieces[pair.second].triangles)
    state.label[t] = pair.first;
  state.pieces[pair.second] = Piece();
  a.triangles.swap(all);
  a.trial = candidate.trial;
  for(const std::uint32_t h : candidate.opened)
    state.graph.open(h);
  measure(state.graph, a);
  --state.number_of_charts;
  --state.charts_of_component[m_surface.component[a.triangles[0]]];
}

// Merges the pair and renews the candidates: what was hopeless with a part is so with the union.
inline void Chart_merger::merge_pair(State& state, const Pair& pair, Candidates& candidates) const
{
  apply(state, pair, candidates[pair]);
  Indices foes;
  for(auto it = candidates.begin(); it != candidates.end(); ) {
    const auto [a, b] = it->first;
    const bool has_a = a == pair.first || a == pair.second;
    const bool has_b = b == pair.first || b == pair.second;
    if(has_a != has_b && it->second.is_hopeless)
      foes.push_back(has_a ? b : a);
    it = has_a || has_b ? candidates.erase(it) : std::next(it);
  }
  add_candidates(state, pair.first, candidates);
  for(const std::uint32_t c : foes)
    candidates[Pair(std::minmax(pair.first, c))].is_hopeless = true;
}

inline void Chart_merger::merge(State& state, const std::vector<bool>& is_active,
                                const Merge_weights& weights)
{
  Candidates candidates;
  for(std::uint32_t c = 0; c < state.pieces.size(); ++c)
    if(is_active[c])
      add_candidates(state, c, candidates);
  while(!m_goes_on || m_goes_on()) {
    try_all(state, candidates);
    const Pair* best = nullptr;
    double least = (std::numeric_limits<double>::max)();
    for(const auto& [pair, candidate] : candidates) {
      if(!is_good(candidate.trial) || !may_merge(state, pair)
         || has_thin_neck(state, pair, candidate))
        continue;
      const double c = cost(state, pair, candidate, weights);
      if(c < least) {
        least = c;
        best = &pair;
      }
    }
    if(best == nullptr)
      return;
    merge_pair(state, Pair(*best), candidates);
  }
}

inline std::vector<bool> Chart_merger::take_apart(State& state, const State& atoms,
                                                  const Indices& charts) const
{
  std::vector<bool> is_apart(state.pieces.size(), false);
  for(const std::uint32_t c : charts) {
    is_apart[c] = true;
    --state.number_of_charts;
    --state.charts_of_component[m_surface.component[state.pieces[c].triangles[0]]];
  }
  Indices triangles;
  for(const std::uint32_t c : charts)
    triangles.insert(triangles.end(), state.pieces[c].triangles.begin(),
                     state.pieces[c].triangles.end());
  std::vector<bool> is_atom(state.pieces.size(), false);
  for(const std::uint32_t t : triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      if(!state.graph.is_border(h) && is_apart[state.label[state.graph.opposite(h) / 3]]
         && atoms.graph.is_seam(h))
        state.graph.close(h);
  for(const std::uint32_t c : charts)
    state.pieces[c] = Piece();
  for(const std::uint32_t t : triangles) {
    state.label[t] = atoms.label[t];
    is_atom[atoms.label[t]] = true;
  }
  for(std::uint32_t c = 0; c < is_atom.size(); ++c)
    if(is_atom[c]) {
      state.pieces[c] = atoms.pieces[c];
      ++state.number_of_charts;
      ++state.charts_of_component[m_surface.component[state.pieces[c].triangles[0]]];
    }
  return is_atom;
}

inline double Chart_merger::seam_length(const State& state) const
{
  double sum = 0.;
  for(const Piece& piece : state.pieces)
    sum += piece.perimeter;
  return 0.5 * sum;
}

inline void Chart_merger::merge_down_to(State& state, std::size_t number)
{
  Candidates candidates;
  for(std::uint32_t c = 0; c < state.pieces.size(); ++c)
    add_candidates(state, c, candidates);
  while(state.number_of_charts > number && (!m_goes_on || m_goes_on())) {
    for(auto& [pair, candidate] : candidates)
      candidate.is_hopeless = false;
    try_all(state, candidates);
    const Pair* best = nullptr;
    std::pair<int, double> least;
    for(const auto& [pair, candidate] : candidates) {
      const Trial_map& trial = candidate.trial;
      if(!may_merge(state, pair) || candidate.opened.empty())
        continue;
      const int defect = !trial.is_disk ? 2 : trial.is_one_to_one ? 0 : 1;
      const std::pair<int, double> c(
        defect, trial.distortion.area_scale * trial.distortion.quasi_conformal);
      if(best == nullptr || c < least) {
        least = c;
        best = &pair;
      }
    }
    if(best == nullptr)
      return;
    merge_pair(state, Pair(*best), candidates);
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_MERGER_H
