// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/principal_axes.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/ch_graham_andrew.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Whether a chart with this conformal map may come within the bound by a map with little stretch, which
// keeps angles less and areas better.
inline bool is_worth_stretching(const Chart_distortion& conformal, const Distortion_bound& bound)
{
  constexpr double most = 2.5; // the power of the bound
  return conformal.area_scale > bound.area_scale
      && conformal.area_scale <= std::pow(bound.area_scale, most)
      && conformal.quasi_conformal <= bound.quasi_conformal;
}

// The power of the bound that a map needs: 1 at the bound.
inline double part_of_bound(const Chart_distortion& distortion, const Distortion_bound& bound)
{
  return (std::max)(std::log(distortion.area_scale) / std::log(bound.area_scale),
                    std::log(distortion.quasi_conformal) / std::log(bound.quasi_conformal));
}

typedef Simple_cartesian<double>::Point_2 Trial_uv;

// A map with little stretch, without a flipped triangle, whose border may meet itself if it need not be
// one-to-one; empty if there is none. `progress` as of `Low_stretch_options`.
inline std::vector<Trial_uv> stretch_map(const Indexed_mesh::Indexed_triangle_mesh& chart,
                                         bool is_one_to_one,
                                         const std::function<bool(double)>& progress = nullptr)
{
  Surface_mesh_parameterization::Low_stretch_options options;
  options.tolerance = 1e-2;
  options.progress = progress;
  options.is_one_to_one = is_one_to_one;
  Indexed_mesh::Indexed_triangle_mesh turned = chart;
  const double factor = turn_along_principal_axes(turned);
  std::vector<Trial_uv> uv = Surface_mesh_parameterization::low_stretch_map(turned, options).uv;
  for(Trial_uv& p : uv)
    p = factor > 0. ? Trial_uv(p.x() / factor, p.y() / factor) : p;
  return uv;
}

// The same; only if such a map is within the bound, and its border meets itself, that which does not, which
// takes longer.
inline std::vector<Trial_uv> stretch_map(const Indexed_mesh::Indexed_triangle_mesh& chart,
                                         const std::vector<Border_edge>& border,
                                         const Distortion_bound& bound,
                                         const std::function<bool(double)>& progress = nullptr)
{
  std::vector<Trial_uv> uv = stretch_map(chart, false, progress);
  if(uv.empty() || !measure_chart_distortion(chart, uv).is_within(bound)
     || Surface_mesh_parameterization::is_simple_border(border, uv))
    return uv;
  return stretch_map(chart, true, progress);
}

// What the map of a possible chart is like.
struct Trial_map
{
  Chart_distortion distortion;
  bool is_disk = false;       // and has been mapped
  bool is_one_to_one = false; // no flipped triangle, and the border does not meet itself
  bool is_draft = false;      // the border may still meet itself; to be tried in full before it counts
  double fill = 0.;           // the part of its convex hull that the chart fills in the plane
  double work = 1.;           // of mapping it, to that of mapping it conformally

  bool is_within(const Distortion_bound& bound) const
  {
    return is_disk && is_one_to_one && distortion.is_within(bound);
  }
};

inline double hull_area(const std::vector<Border_edge>& border, const std::vector<Trial_uv>& uv)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_2 Exact_point; // for predicates
  std::vector<Exact_point> points, hull;
  for(const Border_edge& e : border)
    points.push_back(Exact_point(uv[e[0]].x(), uv[e[0]].y()));
  ch_graham_andrew(points.begin(), points.end(), std::back_inserter(hull));
  double twice = 0.;
  for(std::size_t i = 0; i < hull.size(); ++i) {
    const Exact_point &p = hull[i], &q = hull[(i + 1) % hull.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

// What this map of a chart that is a disk is like.
inline Trial_map judge_map(const Chart_mesh& chart, const std::vector<Border_edge>& border,
                           const std::vector<Trial_uv>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  Trial_map result;
  result.is_disk = true;
  result.distortion = measure_chart_distortion(chart.mesh, uv);
  result.is_one_to_one
    = result.distortion.flipped_faces == 0 && result.distortion.degenerate_faces == 0;
  if(result.is_one_to_one)
    SMP::visit_crossing_edges(border, uv, [&result](const Border_edge&, const Border_edge&) {
      return result.is_one_to_one = false;
    });
  const double hull = hull_area(border, uv);
  result.fill = hull > 0. ? result.distortion.uv_area / hull : 0.;
  return result;
}

// Maps the chart, if it is a disk, conformally.
inline Trial_map try_conformally(const Chart_mesh& chart)
{
  const auto map = Surface_mesh_parameterization::border_first_map(chart.mesh);
  return map.is_ok() ? judge_map(chart, chart.border_edges(), map.uv) : Trial_map();
}

// Maps a chart that is a disk with little stretch.
inline Trial_map try_with_little_stretch(const Chart_mesh& chart, bool is_one_to_one)
{
  const std::vector<Trial_uv> uv = stretch_map(chart.mesh, is_one_to_one);
  Trial_map result = uv.empty() ? Trial_map() : judge_map(chart, chart.border_edges(), uv);
  result.work = is_one_to_one ? 15. : 6.5; // as measured
  return result;
}

// Maps the chart, if it is a disk, as the whole chart will be mapped later: conformally, or, if it may
// be, with little stretch where only then it is within the bound. What takes longest, to keep the border
// of a map with little stretch from meeting itself, is left to `finished_draft()`.
inline Trial_map try_draft(const Chart_mesh& chart, const Distortion_bound& bound, bool may_stretch)
{
  Trial_map conformal = try_conformally(chart);
  if(!conformal.is_disk || !may_stretch || !is_worth_stretching(conformal.distortion, bound))
    return conformal;
  Trial_map result = try_with_little_stretch(chart, false);
  conformal.work += result.work;
  result.work = conformal.work;
  if(result.is_disk && !result.is_one_to_one && result.distortion.is_within(bound))
    result.is_draft = result.is_one_to_one = true;
  return result.is_within(bound) ? result : conformal;
}

// The map of a chart of which there is a draft.
inline Trial_map finished_draft(const Chart_mesh& chart, const Distortion_bound& bound)
{
  const Trial_map result = try_with_little_stretch(chart, true);
  if(result.is_within(bound))
    return result;
  Trial_map conformal = try_conformally(chart);
  conformal.work += result.work;
  return conformal;
}

inline Trial_map try_map(const Chart_mesh& chart, const Distortion_bound& bound, bool may_stretch)
{
  const Trial_map draft = try_draft(chart, bound, may_stretch);
  return draft.is_draft ? finished_draft(chart, bound) : draft;
}

// A chart, or nothing if it has no triangles.
struct Chart_piece
{
  std::vector<std::uint32_t> triangles; // ascending
  Trial_map trial;
  double perimeter = 0.; // with cuts within the chart twice
  double area = 0.;
};

// What charts were before some changes.
struct Chart_changes
{
  typedef std::uint32_t Index;

  std::vector<std::pair<Index, Chart_piece>> pieces;
  std::vector<std::pair<Index, Index>> labels; // of triangles
  std::vector<Halfedge> seams;                 // the edges that became one, or are none any more
  std::vector<std::pair<Index, bool>> counts;  // components, and whether they had one more
};

// Charts while they are merged: sets of triangles that form disks when cut along the seams. A chart
// has the index of one of the patches of which it was merged.
struct Chart_state
{
  typedef std::vector<std::uint32_t> Indices;
  typedef std::pair<std::uint32_t, std::uint32_t> Pair; // of charts, the smaller index first

  Seam_graph graph;
  Indices label; // of each triangle, an index into pieces
  std::vector<Chart_piece> pieces;
  std::size_t number_of_charts = 0;
  std::vector<std::size_t> charts_of_component;

  // Sets perimeter and area.
  void measure(const Growth_surface& surface, Chart_piece& piece) const;

  // The charts that have an edge in common with chart c, ascending.
  Indices neighbors(std::uint32_t c) const;

  // The triangles of both charts, ascending; (a, a) stands for chart a alone.
  Indices union_of(const Pair& pair) const;

  // Replaces the charts by pieces of `atoms`, of which they were merged; returns which pieces these
  // are now, ascending.
  Indices take_apart(const Growth_surface& surface, const Chart_state& atoms,
                     const Indices& charts);

  double seam_length() const;

  // Changes that can be undone, the last ones first, if `changes` is not null.
  Chart_piece replace(std::uint32_t c, Chart_piece piece)
  {
    std::swap(pieces[c], piece);
    if(changes != nullptr)
      changes->pieces.push_back({c, piece});
    return piece;
  }
  void set_label(Triangle_index t, std::uint32_t c)
  {
    if(changes != nullptr)
      changes->labels.push_back({t, label[t]});
    label[t] = c;
  }
  void set_seam(Halfedge h, bool is_seam)
  {
    if(graph.is_seam(h) == is_seam || graph.is_border(h))
      return;
    is_seam ? graph.add_seam(h) : graph.remove_seam(h);
    if(changes != nullptr)
      changes->seams.push_back(h);
  }
  void count(std::uint32_t component, bool is_more)
  {
    is_more ? ++number_of_charts : --number_of_charts;
    is_more ? ++charts_of_component[component] : --charts_of_component[component];
    if(changes != nullptr)
      changes->counts.push_back({component, !is_more});
  }

  // How much longer the seams have become.
  double growth_of_seams(const Chart_changes& made) const;

  void undo(Chart_changes&& made);

  Chart_changes* changes = nullptr;
};

// A piece may have changed several times; the first entry is what it was before.
inline double Chart_state::growth_of_seams(const Chart_changes& made) const
{
  std::vector<std::pair<std::uint32_t, std::size_t>> first;
  for(std::size_t i = 0; i < made.pieces.size(); ++i)
    first.push_back({made.pieces[i].first, i});
  std::sort(first.begin(), first.end());
  double sum = 0.;
  for(std::size_t i = 0; i < first.size(); ++i)
    if(i == 0 || first[i].first != first[i - 1].first)
      sum += pieces[first[i].first].perimeter - made.pieces[first[i].second].second.perimeter;
  return 0.5 * sum;
}

inline void Chart_state::undo(Chart_changes&& made)
{
  changes = nullptr;
  for(std::size_t i = made.pieces.size(); i-- > 0;)
    pieces[made.pieces[i].first] = std::move(made.pieces[i].second);
  for(std::size_t i = made.labels.size(); i-- > 0;)
    label[made.labels[i].first] = made.labels[i].second;
  for(const Halfedge h : made.seams)
    set_seam(h, !graph.is_seam(h));
  for(const auto& [component, had_more] : made.counts)
    count(component, had_more);
}

inline void Chart_state::measure(const Growth_surface& surface, Chart_piece& piece) const
{
  piece.perimeter = piece.area = 0.;
  for(const std::uint32_t t : piece.triangles) {
    piece.area += surface.area[t];
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      piece.perimeter += graph.is_seam(h) ? surface.length[h] : 0.;
  }
}

inline Chart_state::Indices Chart_state::union_of(const Pair& pair) const
{
  const Indices &s = pieces[pair.first].triangles, &t = pieces[pair.second].triangles;
  if(pair.first == pair.second)
    return s;
  Indices result(s.size() + t.size());
  std::merge(s.begin(), s.end(), t.begin(), t.end(), result.begin());
  return result;
}

inline Chart_state::Indices Chart_state::neighbors(std::uint32_t c) const
{
  Indices result;
  for(const std::uint32_t t : pieces[c].triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t g = graph.opposite(h);
      if(!graph.is_border(h) && label[triangle_of(g)] != c)
        result.push_back(label[triangle_of(g)]);
    }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

inline Chart_state::Indices Chart_state::take_apart(const Growth_surface& surface,
                                                    const Chart_state& atoms,
                                                    const Indices& charts)
{
  const auto is_apart = [&](std::uint32_t c) {
    return std::find(charts.begin(), charts.end(), c) != charts.end();
  };
  Indices triangles, result;
  for(const std::uint32_t c : charts) {
    count(surface.component[pieces[c].triangles[0]], false);
    triangles.insert(triangles.end(), pieces[c].triangles.begin(), pieces[c].triangles.end());
  }
  for(const std::uint32_t t : triangles)
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      if(!graph.is_border(h) && is_apart(label[triangle_of(graph.opposite(h))])
         && atoms.graph.is_seam(h))
        set_seam(h, true);
  for(const std::uint32_t c : charts)
    replace(c, Chart_piece());
  for(const std::uint32_t t : triangles) {
    set_label(t, atoms.label[t]);
    result.push_back(atoms.label[t]);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  for(const std::uint32_t c : result) {
    replace(c, atoms.pieces[c]);
    count(surface.component[pieces[c].triangles[0]], true);
  }
  return result;
}

inline double Chart_state::seam_length() const
{
  double sum = 0.;
  for(const Chart_piece& piece : pieces)
    sum += piece.perimeter;
  return 0.5 * sum;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CHART_STATE_H
