// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_state.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/rough_bound.h>
#include <CGAL/Surface_mesh_texturing/segment_into_charts.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// How charts are mapped, and what becomes of those whose maps fail.
struct Chart_mapping
{
  Chart_map parameterize;
  Distortion_bound bound;
  bool is_bounded = true; // if not, charts beyond the bound are not cut for that
  bool may_stretch = false; // charts beyond the bound on areas
  double least_fill = 0.75;
  std::size_t coarse_faces = 4000;
  std::vector<std::uint8_t> no_seams = {}; // of the whole mesh; see Texture_atlas_options
  std::function<bool()> is_over = {};      // whether the quickest way is to be taken from now on
  // Of a chart that may have a higher bound where the surface is rough, see `rough_bound()`
  std::size_t least_rough_faces = (std::numeric_limits<std::size_t>::max)();
  std::size_t most_charts = (std::numeric_limits<std::size_t>::max)(); // or none at all
  bool gives_up = false; // on a large chart if a coarser version of it has no valid map

  bool has_time() const { return !is_over || !is_over(); }
};

// A chart with its map, in units of length of the surface, and whether it may stay as it is.
struct Mapped_chart
{
  Chart_mesh chart;
  std::vector<Point_2> uv;
  Chart_report report;
  Distortion_bound bound; // of itself and of its parts
  bool is_stretched = false; // to be within the bound
  bool is_valid = false;
  bool is_affine = false; // whether bending only stretches it: its map became invalid where it bent
};

// The triangles that are flipped, and those without area, by exact predicates.
inline std::pair<std::size_t, std::size_t>
count_flips(const std::vector<Triangle_indices>& triangles, const std::vector<Point_2>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  std::pair<std::size_t, std::size_t> count = {0, 0};
  for(const Triangle_indices& t : triangles) {
    const auto p = [&](int c) { return SMP::Uv_point(uv[t[c]].x(), uv[t[c]].y()); };
    const Orientation sign = SMP::orientation_of({p(0), p(1), p(2)});
    count.first += sign == RIGHT_TURN ? 1 : 0;
    count.second += sign == COLLINEAR ? 1 : 0;
  }
  return count;
}

// A single triangle laid out in the plane. One without area becomes a flat one, so that it has a
// place in the texture.
inline std::vector<Point_2> lay_out_triangle(const Indexed_triangle_mesh& mesh)
{
  const Triangle_indices& t = mesh.triangles[0];
  const auto length = [&](int c, int d) {
    return std::sqrt(squared_distance(mesh.points[t[c]], mesh.points[t[d]]));
  };
  // Along the longest side; the square root of a difference of squares would lose flat triangles
  int c = 0;
  for(int d = 1; d < 3; ++d)
    if(length(d, (d + 1) % 3) > length(c, (c + 1) % 3))
      c = d;
  const double base = length(c, (c + 1) % 3), side = length(c, (c + 2) % 3);
  const auto a = mesh.points[t[(c + 1) % 3]] - mesh.points[t[c]];
  const auto b = mesh.points[t[(c + 2) % 3]] - mesh.points[t[c]];
  constexpr double least_height = 1e-3; // in sides
  const double x = base > 0. ? (a * b) / base : 0.;
  const double height = (std::max)(std::sqrt((std::max)(0., side * side - x * x)),
                                   least_height * (base > 0. ? base : 1.));
  std::vector<Point_2> uv(mesh.points.size(), Point_2(0., 0.));
  uv[t[c]] = Point_2(0., 0.);
  uv[t[(c + 1) % 3]] = Point_2(base > 0. ? base : least_height, 0.);
  uv[t[(c + 2) % 3]] = Point_2(x, height);
  return uv;
}

inline double border_length(const Indexed_triangle_mesh& mesh,
                            const std::vector<Border_edge>& border)
{
  double sum = 0.;
  for(const Border_edge& e : border)
    sum += std::sqrt(squared_distance(mesh.points[e[0]], mesh.points[e[1]]));
  return sum;
}

// For each of n vertices whether it is on the border.
inline std::vector<bool> border_vertices(std::size_t n, const std::vector<Border_edge>& border)
{
  std::vector<bool> result(n, false);
  for(const Border_edge& e : border)
    result[e[0]] = result[e[1]] = true;
  return result;
}

// Repairs what is flipped in the map of a chart whose border moved, and measures it; returns whether it is
// one-to-one then, by exact predicates, and within the bound.
inline bool mend_map(const Indexed_triangle_mesh& mesh, const std::vector<Border_edge>& border,
                     const Distortion_bound& bound, std::vector<Point_2>& uv, Chart_distortion& distortion)
{
  namespace SMP = Surface_mesh_parameterization;
  if(const auto flips = count_flips(mesh.triangles, uv); flips.first + flips.second > 0)
    SMP::repair_flipped_faces(mesh, uv, border_vertices(uv.size(), border));
  distortion = measure_chart_distortion(mesh, uv);
  return distortion.flipped_faces + distortion.degenerate_faces == 0 && distortion.is_within(bound)
      && SMP::is_simple_border(border, uv);
}

// Repairs flipped triangles: without moving the border, which could then meet itself, if that is
// enough. Returns the numbers of those that are left. Where much would have to move, the chart had
// better be cut.
inline std::pair<std::size_t, std::size_t> repair_flips(const Indexed_triangle_mesh& mesh,
                                                        const std::vector<Border_edge>& border,
                                                        const Chart_mapping& mapping,
                                                        std::vector<Point_2>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  SMP::Flip_repair_options repair;
  repair.last_rings = 32;
  repair.largest_patch = 5000;
  repair.progress = [&mapping](double) { return mapping.has_time(); };
  SMP::repair_flipped_faces(mesh, uv, border_vertices(mesh.points.size(), border), repair);
  const auto left = count_flips(mesh.triangles, uv);
  if(left.first + left.second == 0)
    return left;
  SMP::repair_flipped_faces(mesh, uv, repair);
  return count_flips(mesh.triangles, uv);
}

constexpr std::size_t large_chart = 50000; // triangles, of which a coarser version tells something

// A coarser version of a chart.
inline Chart_mesh coarse_version(const Indexed_triangle_mesh& chart)
{
  Chart_mesh result;
  Segmentation_options options;
  options.coarse_faces = 5000;
  segment_coarse_to_fine(chart, options, [&](const Indexed_triangle_mesh& coarse) {
    std::vector<Triangle_index> all(coarse.triangles.size());
    std::iota(all.begin(), all.end(), Triangle_index(0));
    const Triangle_adjacency adjacency(coarse.triangles);
    result = Chart_cutter<Triangle_adjacency>(coarse, adjacency)(std::move(all));
    Segmentation_result no_charts;
    no_charts.cancel();
    return no_charts;
  });
  return result;
}

// Takes the map with little stretch of a chart if that is within the bound.
inline void stretch_within_bound(const std::vector<Border_edge>& border, const Chart_mapping& mapping,
                                 bool is_one_to_one, Mapped_chart& mapped)
{
  const Indexed_triangle_mesh& mesh = mapped.chart.mesh;
  const auto progress = [&mapping](double) { return mapping.has_time(); };
  std::vector<Point_2> uv = is_one_to_one ? stretch_map(mesh, true, progress)
                                          : stretch_map(mesh, border, mapped.bound, progress);
  if(uv.empty())
    return;
  const Chart_distortion distortion = measure_chart_distortion(mesh, uv);
  if(!distortion.is_within(mapped.bound))
    return;
  mapped.uv = std::move(uv);
  mapped.report.distortion = distortion;
  mapped.is_stretched = true;
}

// Maps a chart and says whether the map is one-to-one and within the bound.
inline Mapped_chart map_chart(Chart_mesh chart, const Distortion_bound& bound,
                              const Chart_mapping& mapping)
{
  Mapped_chart result;
  result.chart = std::move(chart);
  result.bound = bound;
  const Indexed_triangle_mesh& mesh = result.chart.mesh;
  result.report.faces = mesh.triangles.size();
  const std::vector<Border_edge> border = result.chart.border_edges();
  result.report.border_length = border_length(mesh, border);
  if(mesh.triangles.size() == 1) {
    result.uv = lay_out_triangle(mesh);
    result.report.distortion = measure_chart_distortion(mesh, result.uv);
    result.is_valid = true;
    return result;
  }
  result.report.is_one_to_one = false;
  const auto is_allowed = [&](const Chart_distortion& distortion) {
    return !mapping.is_bounded || distortion.is_within(result.bound) || !mapping.has_time();
  };
  if(mesh.triangles.size() >= large_chart && (mapping.may_stretch || mapping.gives_up)
     && mapping.has_time()) {
    constexpr double margin = 1.1; // the power of the bound, for a coarser version, which is mapped soon
    const Distortion_bound about = {std::pow(bound.area_scale, margin),
                                    std::pow(bound.quasi_conformal, margin)};
    const Mapped_chart coarse = map_chart(coarse_version(mesh), about, mapping);
    if(!coarse.is_valid && mapping.gives_up)
      return result;
    if(coarse.is_valid && coarse.is_stretched) // borders that meet are often seen on the fine chart alone
      stretch_within_bound(border, mapping, true, result);
  }
  if(!result.is_stretched) {
    result.uv = mapping.parameterize(mesh);
    if(result.uv.size() != mesh.points.size())
      return result;
    result.report.distortion = measure_chart_distortion(mesh, result.uv);
    if(mesh.triangles.size() >= mapping.least_rough_faces && !is_allowed(result.report.distortion))
      result.bound = higher_bound(bound, rough_bound(mesh, mapping.parameterize, mapping.bound));
    if(mapping.may_stretch && mapping.has_time()
       && is_worth_stretching(result.report.distortion, result.bound))
      stretch_within_bound(border, mapping, false, result);
  }
  if(!scale_to_surface(result.report.distortion, result.uv)
     || !is_allowed(result.report.distortion))
    return result;
  const auto flips = count_flips(mesh.triangles, result.uv);
  auto left = flips;
  if(flips.first + flips.second > 0) {
    left = repair_flips(mesh, border, mapping, result.uv);
    result.report.distortion = measure_chart_distortion(mesh, result.uv);
  }
  result.report.repaired_flips = flips.first - (std::min)(flips.first, left.first);
  result.report.is_one_to_one
    = left.first == 0 && Surface_mesh_parameterization::is_simple_border(border, result.uv);
  result.is_valid = result.report.is_one_to_one && is_allowed(result.report.distortion);
  result.report.is_rough = mapping.is_bounded && !result.report.distortion.is_within(mapping.bound)
                        && result.report.distortion.is_within(result.bound);
  return result;
}

// Cuts off a disk with half of the triangles; what is left may be in several pieces. The last resort: it
// always gives smaller charts. Precondition: two triangles or more.
inline Face_charts halve_chart(const Indexed_triangle_mesh& mesh)
{
  const Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> label(mesh.triangles.size(), 0);
  for(const Triangle_index t : disk_around(mesh, adjacency, 0, mesh.triangles.size() / 2))
    label[t] = 1;
  return charts_of_labels(adjacency, label);
}

// Maps charts side by side, the largest ones first, within a bound for each.
inline std::vector<Mapped_chart> map_each(std::vector<Chart_mesh> charts,
                                          const std::vector<Distortion_bound>& bounds,
                                          const Chart_mapping& mapping)
{
  std::vector<Mapped_chart> result(charts.size());
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&charts](std::size_t i, std::size_t j) {
    return charts[i].mesh.triangles.size() > charts[j].mesh.triangles.size();
  });
  Blocked_execution::blocked_for(order.size(), 1, [&](std::size_t i, std::size_t) {
    result[order[i]] = map_chart(std::move(charts[order[i]]), bounds[order[i]], mapping);
  });
  return result;
}

// Cuts a chart that may not stay as it is into smaller ones, given as parts of the whole mesh.
inline std::vector<Chart_mesh> cut_again(const Mapped_chart& mapped,
                                         const Chart_mapping& mapping)
{
  constexpr double margin = 0.9; // below the bound, which the chart just missed
  constexpr double effort = 20.; // a few charts are soon found
  constexpr std::size_t coarse_faces = 1500;
  const Chart_mesh& chart = mapped.chart;
  Chart_growth_options growth;
  growth.bound = mapped.bound;
  growth.bound.area_scale = (std::max)(1.1, margin * mapped.bound.area_scale);
  growth.least_charts = 2;
  growth.least_fill = mapping.least_fill;
  growth.may_stretch = mapping.may_stretch;
  growth.effort = effort;
  growth.is_enough = mapping.is_over;
  Segmentation_options segmentation;
  segmentation.coarse_faces = (std::min)(coarse_faces, mapping.coarse_faces);
  segmentation.no_seams = chart.entries_of(mapping.no_seams);
  Segmentation_result cut;
  if(mapping.has_time())
    cut = segment_into_charts(chart.mesh, segmentation, growth);
  if(!cut.is_ok() || cut.charts.number_of_charts < 2)
    cut.charts = halve_chart(chart.mesh);
  std::vector<Chart_mesh> parts = chart_meshes(chart.mesh, cut.charts);
  for(Chart_mesh& part : parts) {
    for(Vertex_index& v : part.vertices)
      v = chart.vertices[v];
    for(std::uint32_t& t : part.triangles)
      t = chart.triangles[t];
  }
  return parts;
}

// The charts and their maps; those that fail are cut until all are valid, which single triangles
// always are. In the order of their first triangles. `proceed(part done)` says whether to go on.
// Nothing if not, or as soon as it is known that there are more than `mapping.most_charts`.
inline std::vector<Mapped_chart> map_charts(std::vector<Chart_mesh> charts,
                                            const Chart_mapping& mapping,
                                            const std::function<bool(double)>& proceed,
                                            std::size_t& recut)
{
  std::vector<Mapped_chart> done;
  std::vector<Distortion_bound> bounds(charts.size(), mapping.bound);
  recut = 0;
  for(int round = 0; !charts.empty(); ++round) {
    if(done.size() + charts.size() > mapping.most_charts)
      return {};
    std::vector<Mapped_chart> mapped = map_each(std::move(charts), bounds, mapping);
    charts.clear();
    bounds.clear();
    std::vector<std::vector<Chart_mesh>> parts(mapped.size());
    Blocked_execution::blocked_for(mapped.size(), 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        if(!mapped[i].is_valid)
          parts[i] = cut_again(mapped[i], mapping);
    });
    for(std::size_t i = 0; i < mapped.size(); ++i) {
      recut += round == 0 && !mapped[i].is_valid ? 1 : 0;
      bounds.insert(bounds.end(), parts[i].size(), mapped[i].bound);
      if(mapped[i].is_valid)
        done.push_back(std::move(mapped[i]));
      std::move(parts[i].begin(), parts[i].end(), std::back_inserter(charts));
    }
    if(!proceed(double(round + 1) / double(round + 2)))
      return {};
  }
  std::sort(done.begin(), done.end(), [](const Mapped_chart& a, const Mapped_chart& b) {
    return a.chart.triangles.front() < b.chart.triangles.front();
  });
  return done;
}

// The same for one chart, whose map is not used.
inline std::vector<Mapped_chart> map_anew(Chart_mesh chart, Chart_mapping mapping)
{
  mapping.gives_up = true;
  std::vector<Chart_mesh> charts;
  charts.push_back(std::move(chart));
  std::size_t recut;
  return map_charts(std::move(charts), mapping, [](double) { return true; }, recut);
}

// The charts whose triangles these are, with all seams between wedges.
inline Face_charts charts_of_maps(const Triangle_adjacency& adjacency,
                                  const std::vector<Mapped_chart>& maps)
{
  std::vector<std::uint8_t> seams(adjacency.number_of_halfedges() / 3);
  for(const Mapped_chart& map : maps)
    for(const Halfedge h : map.chart.border)
      mark(seams, 3 * map.chart.triangles[triangle_of(h)] + corner_of(h));
  return charts_between(adjacency, std::move(seams));
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H
