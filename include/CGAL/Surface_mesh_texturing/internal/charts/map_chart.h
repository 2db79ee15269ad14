// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHART_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHART_H

#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef Simple_cartesian<double>::Point_2 Point_2;

// How charts are mapped, and what becomes of those whose maps fail.
struct Chart_mapping
{
  std::function<std::vector<Point_2>(const Indexed_triangle_mesh&)> parameterize;
  Distortion_bound bound;
  bool is_bounded = true; // if not, charts beyond the bound are not cut for that
  double least_fill = 0.75;
  std::size_t coarse_faces = 4000;
  std::vector<std::uint8_t> no_seams = {}; // of the whole mesh; see Texture_atlas_options
};

// A chart with its map, in units of length of the surface, and whether it may stay as it is.
struct Mapped_chart
{
  Chart_mesh chart;
  std::vector<Point_2> uv;
  Chart_report report;
  bool is_valid = false;
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

// Scales a map so that its area is that of the surface. False if it has no area.
inline bool scale_to_surface(Chart_distortion& distortion, std::vector<Point_2>& uv)
{
  const double scale = std::sqrt(distortion.area / distortion.uv_area);
  if(!(scale > 0.) || !std::isfinite(scale))
    return false;
  for(Point_2& p : uv)
    p = Point_2(scale * p.x(), scale * p.y());
  distortion.uv_area *= scale * scale;
  return true;
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

// Repairs flipped triangles: without moving the border, which could then meet itself, if that is
// enough. Returns the numbers of those that are left. Where much would have to move, the chart had
// better be cut.
inline std::pair<std::size_t, std::size_t> repair_flips(const Indexed_triangle_mesh& mesh,
                                                        const std::vector<Border_edge>& border,
                                                        std::vector<Point_2>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  SMP::Flip_repair_options repair;
  repair.last_rings = 32;
  repair.largest_patch = 5000;
  SMP::repair_flipped_faces(mesh, uv, border_vertices(mesh.points.size(), border), repair);
  const auto left = count_flips(mesh.triangles, uv);
  if(left.first + left.second == 0)
    return left;
  SMP::repair_flipped_faces(mesh, uv, repair);
  return count_flips(mesh.triangles, uv);
}

// Maps a chart and says whether the map is one-to-one and within the bound.
inline Mapped_chart map_chart(Chart_mesh chart, const Chart_mapping& mapping)
{
  Mapped_chart result;
  result.chart = std::move(chart);
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
  result.uv = mapping.parameterize(mesh);
  if(result.uv.size() != mesh.points.size())
    return result;
  result.report.distortion = measure_chart_distortion(mesh, result.uv);
  const auto is_allowed = [&mapping](const Chart_distortion& distortion) {
    return !mapping.is_bounded || distortion.is_within(mapping.bound);
  };
  if(!scale_to_surface(result.report.distortion, result.uv)
     || !is_allowed(result.report.distortion))
    return result;
  const auto flips = count_flips(mesh.triangles, result.uv);
  auto left = flips;
  if(flips.first + flips.second > 0) {
    left = repair_flips(mesh, border, result.uv);
    result.report.distortion = measure_chart_distortion(mesh, result.uv);
  }
  result.report.repaired_flips = flips.first - (std::min)(flips.first, left.first);
  result.report.is_one_to_one
    = left.first == 0 && Surface_mesh_parameterization::is_simple_border(border, result.uv);
  result.is_valid = result.report.is_one_to_one && is_allowed(result.report.distortion);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHART_H
