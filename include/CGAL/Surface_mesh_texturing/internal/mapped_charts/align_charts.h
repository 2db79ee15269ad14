// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_ALIGN_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_ALIGN_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The direction of a segment up to quarter turns, in [0, pi / 2), and its length.
typedef std::pair<double, double> Direction_and_length;

inline Direction_and_length direction_of(const Point_2& p, const Point_2& q)
{
  const double x = q.x() - p.x(), y = q.y() - p.y(), quarter = 0.5 * CGAL_PI;
  double angle = std::atan2(y, x);
  while(angle < 0.)
    angle += quarter;
  while(angle >= quarter)
    angle -= quarter;
  return {angle, std::hypot(x, y)};
}

// The direction up to quarter turns in which most of the length of these segments runs, up to a
// degree; within that the median, so that a few that are a little off do not turn the others. 0
// without segments.
inline double main_direction(std::vector<Direction_and_length> segments)
{
  constexpr double width = CGAL_PI / 180., clearly = 1. + 1e-9; // ties must not depend on rounding
  const std::size_t n = segments.size();
  std::sort(segments.begin(), segments.end());
  for(std::size_t i = 0; i < n; ++i) // once around
    segments.push_back({segments[i].first + 0.5 * CGAL_PI, segments[i].second});
  double sum = 0., best = 0.;
  std::size_t best_begin = 0, best_end = 0;
  for(std::size_t begin = 0, end = 0; begin < n; ++begin) {
    for(; end < begin + n && segments[end].first <= segments[begin].first + width; ++end)
      sum += segments[end].second;
    if(sum > clearly * best) {
      best = sum;
      best_begin = begin;
      best_end = end;
    }
    sum -= segments[begin].second;
  }
  double half = 0.;
  for(std::size_t i = best_begin; i < best_end; ++i) {
    half += segments[i].second;
    if(half >= 0.5 * best)
      return segments[i].first;
  }
  return 0.;
}

// The directions of the border of a chart and of the creases within it, and of the edges of polygons: of
// triangles that have `diagonals`, three bits for each triangle of the whole mesh, those of the others.
inline std::vector<Direction_and_length>
directions_of(const Mapped_chart& map, const std::vector<std::uint8_t>& diagonals)
{
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  const double flat = std::cos(Crease_weights().flat_angle * CGAL_PI / 180.);
  std::vector<Direction_and_length> result;
  const auto add = [&](Halfedge h) {
    result.push_back(direction_of(map.uv[vertex_of(mesh.triangles, h)],
                                  map.uv[vertex_of(mesh.triangles, next_halfedge(h))]));
  };
  for(const Halfedge h : map.chart.border)
    add(h);
  const auto normal = [&mesh](Triangle_index t) {
    const Triangle_indices& v = mesh.triangles[t];
    return cross_product(mesh.points[v[1]] - mesh.points[v[0]],
                         mesh.points[v[2]] - mesh.points[v[0]]);
  };
  const std::vector<std::uint8_t> inner = map.chart.entries_of(diagonals);
  const auto is_of_polygon = [&inner](Halfedge h, Halfedge o) {
    return !inner.empty() && (inner[triangle_of(h)] | inner[triangle_of(o)]) != 0
        && !is_marked(inner, h) && !is_marked(inner, o);
  };
  const Triangle_adjacency adjacency(mesh.triangles);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const Halfedge o = adjacency.opposite(h);
    if(o == no_halfedge || o < h)
      continue;
    const auto p = normal(triangle_of(h)), q = normal(triangle_of(o));
    if(p * q < flat * std::sqrt((p * p) * (q * q)) || is_of_polygon(h, o))
      add(h);
  }
  return result;
}

// Turns the maps so that as much of these as possible runs along the axes.
inline void align_charts(const std::vector<std::uint8_t>& diagonals, std::vector<Mapped_chart>& maps)
{
  Blocked_execution::blocked_for(maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const double angle = main_direction(directions_of(maps[i], diagonals));
      const double c = std::cos(angle), s = std::sin(angle);
      for(Point_2& p : maps[i].uv)
        p = Point_2(c * p.x() + s * p.y(), c * p.y() - s * p.x());
    }
  });
}

// Turns maps that are turned by quarters on their pages, so that their places do not turn them any
// more: what is parallel to the axes then stays so exactly.
inline void turn_by_quarters(std::vector<Mapped_chart>& maps,
                             std::vector<Chart_placement>& placements)
{
  constexpr double negligible = 1e-9; // other angles are those of packers that turn as they like
  for(std::size_t i = 0; i < maps.size(); ++i) {
    const double quarters = placements[i].angle / (0.5 * CGAL_PI), whole = std::round(quarters);
    if(std::abs(quarters - whole) > negligible)
      continue;
    const int number = int(std::fmod(whole, 4.) + 4.) % 4;
    for(Point_2& p : maps[i].uv)
      for(int k = 0; k < number; ++k)
        p = Point_2(-p.y(), p.x());
    placements[i].angle = 0.;
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_ALIGN_CHARTS_H
