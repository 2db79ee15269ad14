// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_UNION_FINDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_UNION_FINDER_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_state.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What would become of two charts.
struct Chart_union
{
  std::vector<std::uint32_t> opened; // halfedges that would be no seams any more
  double removed = 0.;      // their length
  double crease = 0.;       // their length on features
  std::size_t arc = 0;      // how many of them, the first ones, may stay as a cut to a tip
  Trial_map trial;
  bool is_known = false;    // the trial is
  bool is_hopeless = false; // far beyond the bound, or a part of it is
  std::size_t stamp = 0;    // tells it from one of the same charts, when they were others
};

// By what a chart is known: a hash of its triangles and of which of their sides are open.
template <class IsOpen>
std::uint64_t hash_of(const Chart_state::Indices& triangles, const IsOpen& is_open)
{
  std::uint64_t key = 0xcbf29ce484222325u;
  for(const Triangle_index t : triangles)
    for(Halfedge h = 3 * t; h < 3 * t + 3; ++h) {
      key = (key ^ (2 * h + (is_open(h) ? 1 : 0))) * 0x100000001b3u;
      key ^= key >> 29;
    }
  return key;
}

// Finds the seams whose removal joins two charts to one, which is again a disk: one arc, a path of
// seams between junctions, and seams that would end within the chart then.
class Union_finder
{
  static constexpr double least_dart_defect = 0.3; // radians
  typedef Chart_state::Indices Indices;
  typedef Chart_state::Pair Pair;

public:
  Union_finder(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature)
    : m_surface(surface), m_is_feature(is_feature)
  {}

  // The union along the longest arc between the charts. The state is the same again afterwards.
  Chart_union find(Chart_state& state, const Pair& pair) const;

  // Leaves a part of the arc, from an end to the vertex of largest curvature, as a cut within the
  // union. Returns whether there is such a vertex.
  bool make_dart(const Chart_state& state, Chart_union& candidate) const;

private:
  Indices longest_arc(const Chart_state& state, std::uint32_t a, std::uint32_t b) const;

  void measure(Chart_union& candidate) const
  {
    candidate.removed = candidate.crease = 0.;
    for(const std::uint32_t h : candidate.opened) {
      candidate.removed += m_surface.length[h];
      candidate.crease += m_is_feature[h] ? m_surface.length[h] : 0.;
    }
  }

  const Growth_surface& m_surface;
  const std::vector<std::uint8_t>& m_is_feature;
};

// The longest arc of the seams between charts a and b, as halfedges of a. If it is a loop, so that
// the two charts are a sphere, half of it.
inline Union_finder::Indices Union_finder::longest_arc(const Chart_state& state, std::uint32_t a,
                                                       std::uint32_t b) const
{
  const Seam_graph& graph = state.graph;
  const auto is_between = [&](std::uint32_t h) {
    return graph.is_seam(h) && !graph.is_border(h)
        && state.label[triangle_of(graph.opposite(h))] == b;
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
  std::uint32_t some = no_halfedge;
  for(const std::uint32_t t : state.pieces[a].triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      if(is_between(h)) {
        some = some == no_halfedge ? h : some;
        if(graph.degree(graph.source(h)) != 2)
          follow(h, unlimited);
      }
  if(best.empty() && some != no_halfedge)
    follow(some, 0.25 * (state.pieces[a].perimeter + state.pieces[b].perimeter));
  return best;
}

inline Chart_union Union_finder::find(Chart_state& state, const Pair& pair) const
{
  Chart_union result;
  result.opened = longest_arc(state, pair.first, pair.second);
  if(result.opened.empty())
    return result;
  Seam_graph& graph = state.graph;
  const std::uint32_t from = graph.source(result.opened.front());
  const std::uint32_t to = graph.target(result.opened.back());
  result.arc = result.opened.size();
  for(const std::uint32_t h : result.opened)
    graph.remove_seam(h);
  graph.zip(from, result.opened);
  graph.zip(to, result.opened);
  if(graph.is_single_edge(from)) { // a sphere with a slit of one edge is none any more
    graph.add_seam(result.opened.front());
    result.opened.erase(result.opened.begin());
    result.arc = 0;
  }
  for(const std::uint32_t h : result.opened)
    graph.add_seam(h);
  measure(result);
  return result;
}

inline bool Union_finder::make_dart(const Chart_state& state, Chart_union& candidate) const
{
  if(candidate.arc < 2)
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
  measure(candidate);
  return true;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_UNION_FINDER_H
