// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_OUTLINE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_OUTLINE_H

#include <CGAL/Surface_mesh_texturing/Chart_packing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef std::array<double, 2> Vector_2d;

// An edge, and how often the region to the left of it is covered more often than that to the right.
struct Outline_edge
{
  Vector_2d from, to;
  int winding;
};

// What a chart covers, without its inner edges. A point is covered if the winding number of one of
// the parts around it is not 0. The first part is made of the edges whose triangles do not cancel;
// the others are the triangles whose orientation is not that of the chart: where these are not, all
// triangles count with the same sign, so that the winding number of the first part is their number.
struct Chart_outline
{
  std::vector<std::vector<Outline_edge>> parts; // relative to the centre, in common units
  Vector_2d centre = {0., 0.};                  // of the bounding box, in the chart's plane
  double angle = 0.;    // of the rotation that aligns the smallest rectangle, long side along x
  double area = 0.;     // of all triangles, in common units
  std::size_t triangles = 0;
  double diameter = 0.; // about, and not more, in common units: however the chart is turned
};

// The bounding box (lower left, upper right) of the vertices of the triangles.
inline std::array<Vector_2d, 2> bounding_box(const Chart_shape& chart)
{
  std::array<Vector_2d, 2> box = {};
  bool is_first = true;
  for(const auto& t : chart.triangles)
    for(const auto v : t)
      for(int c = 0; c < 2; ++c) {
        const double x = chart.uv[v][c];
        box[0][c] = is_first ? x : (std::min)(box[0][c], x);
        box[1][c] = is_first ? x : (std::max)(box[1][c], x);
        is_first = is_first && c == 0;
      }
  return box;
}

// The edges where triangles end: those that are there as often in one direction as in the other
// cancel.
inline std::vector<Outline_edge> uncancelled_edges(
  const std::vector<Indexed_mesh::Triangle_indices>& triangles,
  const std::vector<Vector_2d>& points)
{
  // The edges by their smaller vertex
  typedef std::pair<std::uint32_t, int> Larger_vertex; // and +1 if the edge leads to it, or -1
  std::vector<std::size_t> begin(points.size() + 2, 0);
  for(const auto& t : triangles)
    for(int c = 0; c < 3; ++c)
      ++begin[(std::min)(t[c], t[(c + 1) % 3]) + 2];
  for(std::size_t v = 0; v + 1 < begin.size(); ++v)
    begin[v + 1] += begin[v];
  std::vector<Larger_vertex> edges(3 * triangles.size());
  for(const auto& t : triangles)
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      edges[begin[(std::min)(a, b) + 1]++] = {(std::max)(a, b), a < b ? 1 : -1};
    }
  std::vector<Outline_edge> result;
  for(std::size_t v = 0; v < points.size(); ++v) {
    std::sort(edges.begin() + begin[v], edges.begin() + begin[v + 1]);
    for(std::size_t i = begin[v]; i < begin[v + 1];) {
      const std::uint32_t w = edges[i].first;
      int winding = 0;
      for(; i < begin[v + 1] && edges[i].first == w; ++i)
        winding += edges[i].second;
      if(winding != 0)
        result.push_back({points[v], points[w], winding});
    }
  }
  return result;
}

// The three edges of a triangle.
inline std::vector<Outline_edge> edges_of(
  const Indexed_mesh::Triangle_indices& t, const std::vector<Vector_2d>& points)
{
  return {{points[t[0]], points[t[1]], 1},
          {points[t[1]], points[t[2]], 1},
          {points[t[2]], points[t[0]], 1}};
}

inline double cross(const Vector_2d& o, const Vector_2d& a, const Vector_2d& b)
{
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

// The convex hull, counterclockwise (Andrew's monotone chain).
inline std::vector<Vector_2d> convex_hull(std::vector<Vector_2d> points)
{
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if(points.size() < 3)
    return points;
  std::vector<Vector_2d> hull;
  for(int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for(const Vector_2d& p : points) {
      while(hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// The largest extent of the points in some directions: not more than their diameter, and not less
// than 0.995 times that.
inline double largest_extent(const std::vector<Vector_2d>& points)
{
  constexpr int directions = 16;
  double result = 0.;
  for(int i = 0; i < directions && !points.empty(); ++i) {
    const double angle = CGAL_PI * i / directions, c = std::cos(angle), s = std::sin(angle);
    const auto along = [c, s](const Vector_2d& p) { return c * p[0] + s * p[1]; };
    double low = along(points[0]), high = low;
    for(const Vector_2d& p : points) {
      low = (std::min)(low, along(p));
      high = (std::max)(high, along(p));
    }
    result = (std::max)(result, high - low);
  }
  return result;
}

// The sides of a hull whose directions are tried: all, but for very many the longest ones.
inline std::vector<std::size_t> tried_sides(const std::vector<Vector_2d>& hull)
{
  constexpr std::size_t most = 2000;
  std::vector<std::size_t> sides(hull.size());
  std::iota(sides.begin(), sides.end(), std::size_t(0));
  if(sides.size() <= most)
    return sides;
  const auto length = [&hull](std::size_t i) {
    const Vector_2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    return std::hypot(b[0] - a[0], b[1] - a[1]);
  };
  std::stable_sort(sides.begin(), sides.end(),
                   [&](std::size_t i, std::size_t j) { return length(i) > length(j); });
  sides.resize(most);
  std::sort(sides.begin(), sides.end());
  return sides;
}

// The rotation after which the rectangle of the smallest area around the points, one side of which
// is a side of their hull, is parallel to the axes with its long side along x.
inline double aligning_angle(const std::vector<Vector_2d>& points)
{
  constexpr double clearly_smaller = 1. - 1e-9; // ties must not depend on rounding
  const std::vector<Vector_2d> hull = convex_hull(points);
  double best = -1., angle = 0.;
  for(const std::size_t i : tried_sides(hull)) {
    if(hull.size() < 2)
      break;
    const Vector_2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    Vector_2d lo = {0., 0.}, hi = {0., 0.};
    for(const Vector_2d& p : hull) {
      const double along = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length;
      const double across = ((p[1] - a[1]) * dx - (p[0] - a[0]) * dy) / length;
      lo = {(std::min)(lo[0], along), (std::min)(lo[1], across)};
      hi = {(std::max)(hi[0], along), (std::max)(hi[1], across)};
    }
    const double w = hi[0] - lo[0], h = hi[1] - lo[1];
    if(best >= 0. && w * h >= best * clearly_smaller)
      continue;
    best = w * h;
    angle = -std::atan2(dy, dx) + (w < h * clearly_smaller ? 0.5 * CGAL_PI : 0.);
  }
  return angle;
}

// Whether the edges of the triangle cancel each other; its area may be 0 up to rounding only.
inline bool has_repeated_vertex(const Indexed_mesh::Triangle_indices& t)
{
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// The outline of a chart with finite coordinates, lengths divided by `unit`.
inline Chart_outline chart_outline(const Chart_shape& chart, double unit)
{
  Chart_outline result;
  result.triangles = chart.triangles.size();
  const auto box = bounding_box(chart);
  std::vector<Vector_2d> points(chart.uv.size());
  for(int c = 0; c < 2; ++c) {
    result.centre[c] = 0.5 * box[0][c] + 0.5 * box[1][c];
    for(std::size_t v = 0; v < points.size(); ++v)
      points[v][c] = (chart.uv[v][c] - result.centre[c]) / unit;
  }
  std::vector<double> areas;
  double sum = 0.;
  for(const auto& t : chart.triangles) {
    areas.push_back(0.5 * cross(points[t[0]], points[t[1]], points[t[2]]));
    sum += areas.back();
    result.area += std::abs(areas.back());
  }
  result.parts.push_back(uncancelled_edges(chart.triangles, points));
  std::vector<Vector_2d> corners;
  for(std::size_t t = 0; t < areas.size(); ++t)
    if(has_repeated_vertex(chart.triangles[t]) || !((sum < 0. ? -areas[t] : areas[t]) > 0.))
      result.parts.push_back(edges_of(chart.triangles[t], points));
  for(const auto& part : result.parts)
    for(const Outline_edge& e : part) {
      corners.push_back(e.from);
      corners.push_back(e.to);
    }
  result.angle = aligning_angle(corners);
  result.diameter = largest_extent(corners);
  return result;
}

// The outlines of all charts, and the unit of length they are in: the largest side of a bounding
// box.
inline std::vector<Chart_outline> chart_outlines(const std::vector<Chart_shape>& charts,
                                                 double& unit)
{
  unit = 0.;
  for(const Chart_shape& chart : charts) {
    const auto box = bounding_box(chart);
    unit = (std::max)({unit, box[1][0] - box[0][0], box[1][1] - box[0][1]});
  }
  if(!(unit > 0.))
    unit = 1.;
  std::vector<Chart_outline> result;
  for(const Chart_shape& chart : charts)
    result.push_back(chart_outline(chart, unit));
  return result;
}

// The longest edge of each chart.
inline std::vector<double> longest_edges(const std::vector<Chart_outline>& outlines)
{
  std::vector<double> result;
  for(const Chart_outline& outline : outlines) {
    double longest = 0.;
    for(const auto& part : outline.parts)
      for(const Outline_edge& e : part)
        longest = (std::max)(longest, std::hypot(e.to[0] - e.from[0], e.to[1] - e.from[1]));
    result.push_back(longest);
  }
  return result;
}

// xorshift64* (Vigna 2016)
class Xorshift
{
public:
  explicit Xorshift(std::uint64_t seed) : m_state(seed * 0x9E3779B97F4A7C15u + 1) {}

  // Of the numbers below `n`, which must be less than 2^32.
  std::size_t index(std::size_t n) { return std::size_t((next() >> 32) * n >> 32); }

  // Of [0, 1).
  double fraction() { return double(next() >> 11) * 0x1p-53; }

private:
  std::uint64_t next()
  {
    m_state ^= m_state >> 12;
    m_state ^= m_state << 25;
    m_state ^= m_state >> 27;
    return m_state * 0x2545F4914F6CDD1Du;
  }

  std::uint64_t m_state;
};

typedef std::vector<double> Packing_keys; // of the charts; the largest is placed first

// The logarithm of the area, rounded so that equal charts are equal.
inline double key_of(const Chart_outline& outline)
{
  const double thickened = outline.area + 1e-3 * outline.diameter * outline.diameter;
  return thickened > 0. ? std::round(1e6 * std::log(thickened)) / 1e6 : -1e3;
}

inline Packing_keys keys_by_area(const std::vector<Chart_outline>& outlines)
{
  Packing_keys keys;
  for(const Chart_outline& o : outlines)
    keys.push_back(key_of(o));
  return keys;
}

// Keys near those of areas; the same for the same seed.
inline Packing_keys perturbed(const Packing_keys& keys, std::size_t seed)
{
  constexpr double range = 0.5; // of the logarithm of the area
  Packing_keys result = keys;
  Xorshift random(seed);
  for(double& key : result)
    key += range * (2. * random.fraction() - 1.);
  return result;
}

// The order of these keys: the largest first, ties by index.
inline std::vector<std::uint32_t> order_of(const Packing_keys& keys)
{
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_OUTLINE_H
