// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_PACKED_CHARTS_H
#define HLSCM_TEST_SUPPORT_PACKED_CHARTS_H

// Packings against the definition: touched texels, found by trial of all.

#include <support/chart_shapes.h>

#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace packed_charts {

using namespace test_support;
using namespace CGAL::Surface_mesh_texturing;

typedef Chart_shape::Point_2 Point_2;
typedef std::vector<Chart_shape> Charts;
typedef std::array<Point_2, 3> Triangle;
typedef std::pair<int, int> Texel;

constexpr std::uint64_t seed = 4711;

inline Packing_options small_page(std::size_t width = 80, std::size_t height = 80)
{
  Packing_options options;
  options.width = width;
  options.height = height;
  return options;
}

inline std::vector<Triangle> placed_triangles(const Chart_shape& chart, const Chart_placement& placement)
{
  std::vector<Triangle> result;
  for(const auto& t : chart.triangles)
    result.push_back({placement(chart.uv[t[0]]), placement(chart.uv[t[1]]),
                      placement(chart.uv[t[2]])});
  return result;
}

// Whether a line with the given normal separates the triangle from the texel
// [x, x + 1] x [y, y + 1].
inline bool separates(double nx, double ny, const Triangle& t, int x, int y)
{
  double lo = std::numeric_limits<double>::infinity(), hi = -lo, low = lo, high = hi;
  for(const Point_2& p : t) {
    lo = (std::min)(lo, nx * p.x() + ny * p.y());
    hi = (std::max)(hi, nx * p.x() + ny * p.y());
  }
  for(int i = 0; i < 4; ++i) {
    const double d = nx * (x + i % 2) + ny * (y + i / 2);
    low = (std::min)(low, d);
    high = (std::max)(high, d);
  }
  return hi < low || high < lo;
}

inline std::set<Texel> touched_texels(const std::vector<Triangle>& triangles)
{
  std::set<Texel> result;
  for(const Triangle& t : triangles) {
    const auto x = std::minmax({t[0].x(), t[1].x(), t[2].x()});
    const auto y = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    for(int i = int(std::floor(x.first)); i <= x.second; ++i)
      for(int j = int(std::floor(y.first)); j <= y.second; ++j) {
        bool is_touched = true;
        for(int k = 0; k < 3; ++k) {
          const auto edge = t[(k + 1) % 3] - t[k];
          is_touched = is_touched && !separates(edge.y(), -edge.x(), t, i, j);
        }
        if(is_touched)
          result.insert({i, j});
      }
  }
  return result;
}

// The texels of the coarsest mip level, counted from the upper left corner.
inline std::set<Texel> touched_blocks(const std::set<Texel>& texels, const Packing_options& options)
{
  const int size = 1 << options.mip_levels;
  const auto divided = [size](int x) { return x >= 0 ? x / size : -1; };
  std::set<Texel> result;
  for(const Texel& t : texels)
    result.insert({divided(t.first), divided(int(options.height) - 1 - t.second)});
  return result;
}

inline std::string at(std::size_t chart, const Texel& t)
{
  return "chart " + std::to_string(chart) + " at " + std::to_string(t.first) + ", "
         + std::to_string(t.second);
}

// The padding between charts and at the border, by definition.
inline std::string padding_error(const Charts& charts, const Packing_options& options,
                                 const Packing_result& result)
{
  const int p = int(options.padding), border = (p + 1) / 2;
  const int w = int(options.width >> options.mip_levels);
  const int h = int(options.height >> options.mip_levels);
  for(std::size_t page = 0; page < result.pages; ++page) {
    std::vector<int> owner(std::size_t(w * h), -1);
    std::vector<std::set<Texel>> blocks(charts.size());
    for(std::size_t c = 0; c < charts.size(); ++c) {
      if(result.placements[c].page != page)
        continue;
      blocks[c] = touched_blocks(
        touched_texels(placed_triangles(charts[c], result.placements[c])), options);
      for(const Texel& t : blocks[c]) {
        if(t.first < border || t.second < border || t.first >= w - border
           || t.second >= h - border)
          return at(c, t) + " touches the border";
        owner[std::size_t(t.second * w + t.first)] = int(c);
      }
    }
    for(std::size_t c = 0; c < charts.size(); ++c)
      for(const Texel& t : blocks[c])
        for(int x = (std::max)(0, t.first - p); x <= (std::min)(w - 1, t.first + p); ++x)
          for(int y = (std::max)(0, t.second - p); y <= (std::min)(h - 1, t.second + p); ++y) {
            const int other = owner[std::size_t(y * w + x)];
            if(other != -1 && other != int(c))
              return at(c, t) + " is too near to chart " + std::to_string(other);
          }
  }
  return {};
}

// All lengths are multiplied by the same factor, and nothing is mirrored.
inline std::string similarity_error(const Charts& charts, const Packing_result& result)
{
  for(std::size_t c = 0; c < charts.size(); ++c) {
    const Chart_shape& chart = charts[c];
    double size = 0.;
    for(const Point_2& p : chart.uv)
      size = (std::max)(size, std::sqrt(CGAL::squared_distance(p, chart.uv[0])));
    const double tolerance = 1e-9 * size * result.texels_per_unit;
    for(const auto& t : chart.triangles)
      for(int k = 0; k < 3; ++k) {
        const auto e = chart.uv[t[(k + 1) % 3]] - chart.uv[t[k]];
        const auto f = result.placements[c](chart.uv[t[(k + 1) % 3]])
                       - result.placements[c](chart.uv[t[k]]);
        const double a = result.placements[c].angle, s = result.texels_per_unit;
        if(std::abs(s * (std::cos(a) * e.x() - std::sin(a) * e.y()) - f.x()) > tolerance
           || std::abs(s * (std::sin(a) * e.x() + std::cos(a) * e.y()) - f.y()) > tolerance)
          return "chart " + std::to_string(c) + " is not similar to what it was";
      }
  }
  return {};
}

inline std::string utilisation_error(const Charts& charts, const Packing_options& options,
                                     const Packing_result& result)
{
  double area = 0.;
  std::size_t texels = 0;
  for(std::size_t c = 0; c < charts.size(); ++c) {
    const auto triangles = placed_triangles(charts[c], result.placements[c]);
    for(const Triangle& t : triangles)
      area += std::abs(CGAL::area(t[0], t[1], t[2]));
    texels += touched_texels(triangles).size();
  }
  const double all = double(options.width * options.height * result.pages);
  if(std::abs(area / all - result.utilisation) > 1e-9)
    return "the utilisation is " + std::to_string(area / all);
  // Triangles that come within a thousandth of a texel may count as touching it: on a small page a
  // diagonal through the corners of texels makes almost one percent
  if(std::abs(double(texels) / all - result.texel_utilisation) > 0.01)
    return "the utilisation of texels is " + std::to_string(double(texels) / all) + ", not "
           + std::to_string(result.texel_utilisation);
  return {};
}

// What is wrong with a packing, or nothing.
inline std::string packing_error(const Charts& charts, const Packing_options& options,
                                 const Packing_result& result)
{
  if(!result.error.empty())
    return result.error;
  if(result.placements.size() != charts.size())
    return "not each chart has one place";
  std::vector<bool> is_used(result.pages, false);
  for(const Chart_placement& placement : result.placements) {
    if(placement.page >= result.pages)
      return "a page that is not there";
    is_used[placement.page] = true;
    if(placement.scale != result.texels_per_unit)
      return "a chart of another scale";
  }
  if(std::find(is_used.begin(), is_used.end(), false) != is_used.end())
    return "an empty page";
  if(options.max_pages != 0 && result.pages > options.max_pages)
    return "too many pages";
  for(const std::string& error :
      {similarity_error(charts, result), padding_error(charts, options, result),
       utilisation_error(charts, options, result)})
    if(!error.empty())
      return error;
  return {};
}

inline Charts mixed_charts()
{
  Charts charts = blob_charts(8, 0.1, seed);
  charts.push_back(l_chart(0.2));
  charts.push_back(l_chart(0.3));
  charts.push_back(ring_chart(0.7, 1.));
  charts.push_back(star_chart(5, 0.3, 0.9));
  charts.push_back(star_chart(7, 0.1, 0.5));
  charts.push_back(rectangle_chart(2.5, 0.02));
  charts.push_back(rectangle_chart(0.05, 1.2));
  return charts;
}

} // namespace packed_charts

#endif // HLSCM_TEST_SUPPORT_PACKED_CHARTS_H
