// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_GIVEN_MAPS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_GIVEN_MAPS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Texture_defect.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The image of a triangle of a chart.
inline Surface_mesh_parameterization::Uv_triangle uv_triangle_of(const Mapped_chart& map,
                                                                 std::size_t t)
{
  Surface_mesh_parameterization::Uv_triangle result;
  for(int c = 0; c < 3; ++c) {
    const Point_2& p = map.uv[map.chart.mesh.triangles[t][c]];
    result[c] = Surface_mesh_parameterization::Uv_point(p.x(), p.y());
  }
  return result;
}

// The two first triangles found whose images have a common area, as indices in the chart; none if
// the map is one-to-one. Precondition: no triangle is flipped, but all may be.
inline std::optional<std::pair<std::size_t, std::size_t>> overlap_of(const Mapped_chart& map)
{
  namespace SMP = Surface_mesh_parameterization;
  const std::size_t n = map.chart.mesh.triangles.size();
  std::vector<std::pair<Bbox_2, SMP::Uv_face>> items;
  for(std::size_t t = 0; t < n; ++t) {
    SMP::Uv_triangle p = uv_triangle_of(map, t);
    const Orientation sign = SMP::orientation_of(p);
    if(sign == RIGHT_TURN)
      std::swap(p[1], p[2]);
    if(sign != COLLINEAR)
      items.push_back({p[0].bbox() + p[1].bbox() + p[2].bbox(), {t, p}});
  }
  const std::size_t twice_edges = 3 * n + map.chart.border.size();
  const bool is_disk = 2 * (map.chart.mesh.points.size() + n) == twice_edges + 2;
  if(is_disk && items.size() == n
     && SMP::is_simple_border(map.chart.border_edges(), map.uv)) // see certify_map()
    return std::nullopt;
  std::optional<std::pair<std::size_t, std::size_t>> result;
  SMP::visit_pairs_of_boxes(items, [&result](const SMP::Uv_face& a, const SMP::Uv_face& b) {
    if(a.overlaps(b))
      result = std::minmax(a.position, b.position);
    return !result;
  });
  return result;
}

// Why a map is not one-to-one.
inline Texture_defect defect_of_chart(const Mapped_chart& map, double least_area)
{
  namespace SMP = Surface_mesh_parameterization;
  const auto& triangles = map.chart.triangles;
  const Chart_distortion& d = map.report.distortion;
  Texture_defect result;
  result.size = triangles.size();
  const auto take = [&](Texture_defect::Kind kind, std::size_t s, std::size_t t) {
    result.kind = kind;
    result.triangles = {{triangles[s], triangles[t]}};
  };
  if(!(d.uv_area > 0.) && d.area > least_area) {
    take(Texture_defect::NO_AREA, 0, 0);
    return result;
  }
  const Orientation flipped = map.report.is_mirrored ? LEFT_TURN : RIGHT_TURN;
  for(std::size_t t = triangles.size(); t-- > 0;)
    if(SMP::orientation_of(uv_triangle_of(map, t)) == flipped) {
      take(Texture_defect::FLIPPED_TRIANGLE, t, t);
      ++result.flipped;
    }
  if(result.kind == Texture_defect::NONE)
    if(const auto overlap = overlap_of(map))
      take(Texture_defect::OVERLAP, overlap->first, overlap->second);
  return result;
}

// A chart with the map that the texture gives it, in the texture's own unit, and its report.
inline Mapped_chart given_map(Chart_mesh chart, const Textured_triangle_mesh& texture)
{
  Mapped_chart result;
  result.chart = std::move(chart);
  const Indexed_triangle_mesh& mesh = result.chart.mesh;
  result.uv.resize(mesh.points.size(), Point_2(0., 0.));
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      result.uv[mesh.triangles[t][c]] = texture.uv[texture.wedges[result.chart.triangles[t]][c]];
  result.report.faces = mesh.triangles.size();
  result.report.border_length = border_length(mesh, result.chart.border_edges());
  result.report.distortion = measure_chart_distortion(mesh, result.uv);
  result.report.is_mirrored = result.report.distortion.uv_area < 0.;
  if(result.report.is_mirrored) {
    std::vector<Point_2> upright;
    for(const Point_2& p : result.uv)
      upright.emplace_back(-p.x(), p.y());
    result.report.distortion = measure_chart_distortion(mesh, upright);
  }
  result.is_valid = true;
  return result;
}

// The area of a map, flipped triangles counted like others.
inline double absolute_area(const Mapped_chart& map)
{
  double twice = 0.;
  for(const Triangle_indices& t : map.chart.mesh.triangles) {
    const auto p = map.uv[t[1]] - map.uv[t[0]], q = map.uv[t[2]] - map.uv[t[0]];
    twice += std::abs(p.x() * q.y() - p.y() * q.x());
  }
  return 0.5 * twice;
}

// Scales the maps to the surface: each so that its area is that of its chart, or all by one factor.
// Charts without area, here or there, take the common factor.
inline void scale_given_maps(Chart_scale scale, std::vector<Mapped_chart>& maps)
{
  const auto factor = [](double area, double uv_area) { return std::sqrt(area / uv_area); };
  const auto is_factor = [](double f) { return f > 0. && std::isfinite(f); };
  double area = 0., uv_area = 0.;
  for(const Mapped_chart& map : maps) {
    area += map.report.distortion.area;
    uv_area += absolute_area(map);
  }
  const double common = is_factor(factor(area, uv_area)) ? factor(area, uv_area) : 1.;
  for(Mapped_chart& map : maps) {
    Chart_distortion& d = map.report.distortion;
    const double own = factor(d.area, absolute_area(map));
    const double used = scale == Chart_scale::EQUAL_DENSITY && is_factor(own) ? own : common;
    for(Point_2& p : map.uv)
      p = Point_2(used * p.x(), used * p.y());
    d.uv_area *= used * used;
  }
}

// The charts of a texture on `mesh`, which has its triangles, with their maps, in the order of their
// first triangles; `defects` gets those of all charts that have one. If one is refused, or the
// texture has no area at all, there are no maps.
inline std::vector<Mapped_chart> given_maps(const Indexed_triangle_mesh& mesh,
                                            const Triangle_adjacency& adjacency,
                                            const Textured_triangle_mesh& texture,
                                            const Repacking_options& options,
                                            std::vector<Texture_defect>& defects)
{
  constexpr double negligible = 1e-12; // of the area of the surface, for charts without uv area
  std::vector<Chart_mesh> charts = chart_meshes(mesh, adjacency, charts_of_texture(texture));
  std::vector<Mapped_chart> maps(charts.size());
  std::vector<Texture_defect> all(charts.size());
  Blocked_execution::blocked_for(charts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      maps[i] = given_map(std::move(charts[i]), texture);
  });
  double area = 0., uv_area = 0.;
  for(const Mapped_chart& map : maps) {
    area += map.report.distortion.area;
    uv_area += map.report.distortion.uv_area;
  }
  Blocked_execution::blocked_for(maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      all[i] = defect_of_chart(maps[i], negligible * area);
  });
  for(std::size_t i = 0; i < all.size(); ++i)
    if(all[i].kind != Texture_defect::NONE) {
      all[i].chart = i;
      maps[i].report.is_one_to_one = false;
      defects.push_back(all[i]);
    }
  if(!defects.empty() && (options.defects == Defective_charts::REFUSE || !(uv_area > 0.)))
    return {};
  scale_given_maps(options.scale, maps);
  return maps;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_GIVEN_MAPS_H
