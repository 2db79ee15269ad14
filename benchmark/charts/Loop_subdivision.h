// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_LOOP_SUBDIVISION_H
#define HLSCM_BENCHMARK_CHARTS_LOOP_SUBDIVISION_H

#include "Chart.h"

namespace charts {
namespace internal {

// Loop's masks for the old vertices: the neighbourhood inside, the cubic B-spline on the border.
inline std::vector<Point> smoothed_vertices(const Chart& chart, const std::vector<Index>& opposite)
{
  const std::vector<char> is_border = border_vertices(chart, opposite);
  std::vector<Point> sum(chart.points.size(), Point{0, 0, 0});
  std::vector<Index> degree(chart.points.size(), 0);
  for(Index h = 0; h < chart.number_of_halfedges(); ++h) {
    const Index v = chart.source(h), w = chart.target(h);
    if(opposite[h] == none) {
      sum[v] = sum[v] + chart.points[w];
      sum[w] = sum[w] + chart.points[v];
    } else if(!is_border[v]) {
      sum[v] = sum[v] + chart.points[w];
      ++degree[v];
    }
  }
  for(std::size_t v = 0; v < sum.size(); ++v) {
    const double n = degree[v], c = 0.375 + 0.25 * std::cos(2 * 3.14159265358979323846 / n);
    const double beta = is_border[v] ? 0.125 : (0.625 - c * c) / n; // weight of each neighbour
    sum[v] = (1 - beta * (is_border[v] ? 2 : n)) * chart.points[v] + beta * sum[v];
  }
  return sum;
}

} // namespace internal

// One step of Loop's subdivision: four triangles for each, the old vertices first.
inline Chart Loop_subdivision(const Chart& chart)
{
  const std::vector<Index> opposite = opposite_halfedges(chart);
  Chart fine;
  fine.points = internal::smoothed_vertices(chart, opposite);
  std::vector<Index> midpoint(chart.number_of_halfedges());
  for(Index h = 0; h < chart.number_of_halfedges(); ++h) {
    const Index o = opposite[h];
    if(o < h) {
      midpoint[h] = midpoint[o];
      continue;
    }
    const Point ends = chart.points[chart.source(h)] + chart.points[chart.target(h)];
    midpoint[h] = Index(fine.points.size());
    if(o == none)
      fine.points.push_back(0.5 * ends);
    else
      fine.points.push_back(0.375 * ends
                            + 0.125
                                  * (chart.points[chart.source(previous(h))]
                                     + chart.points[chart.source(previous(o))]));
  }
  fine.triangles.reserve(4 * chart.triangles.size());
  for(std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const auto [a, b, c] = chart.triangles[t];
    const Index ab = midpoint[3 * t], bc = midpoint[3 * t + 1], ca = midpoint[3 * t + 2];
    for(const Triangle& child :
        {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}})
      fine.triangles.push_back(child);
  }
  return fine;
}

} // namespace charts
#endif
