// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_SCAN_NOISE_H
#define HLSCM_BENCHMARK_CHARTS_SCAN_NOISE_H

#include "Chart.h"

namespace charts {

// The i-th number of a stream of random numbers, by splitmix64 (Steele, Lea, Flood 2014): the same
// on every machine and for any order of calls.
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t i)
{
  std::uint64_t z = (seed * 0x632be59bd9b4e019u) + (i + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// uniform in [0, 1)
inline double random_uniform(std::uint64_t seed, std::uint64_t i)
{
  return double(random_bits(seed, i) >> 11) * 0x1p-53;
}

// Mean 0, variance 1, nearly normal: a sum of four uniform numbers, no library functions involved.
inline double random_normal(std::uint64_t seed, std::uint64_t i)
{
  double sum = -2;
  for(std::uint64_t k = 0; k < 4; ++k)
    sum += random_uniform(seed, 4 * i + k);
  return sum * std::sqrt(3.0);
}

namespace internal {

// Replaces a value at each vertex by the mean of itself and its neighbours.
inline void average_with_neighbors(const Chart& chart, std::vector<double>& value)
{
  std::vector<double> sum(value);
  std::vector<Index> count(value.size(), 1);
  // inside, both directions are halfedges; on the border the one direction is enough
  for(Index h = 0; h < chart.number_of_halfedges(); ++h) {
    sum[chart.source(h)] += value[chart.target(h)];
    ++count[chart.source(h)];
  }
  for(std::size_t v = 0; v < value.size(); ++v)
    value[v] = sum[v] / count[v];
}

inline void normalize_variance(std::vector<double>& value)
{
  double squares = 0;
  for(double x : value)
    squares += x * x;
  const double scale = 1 / std::sqrt(squares / double(value.size()));
  for(double& x : value)
    x *= scale;
}

} // namespace internal

// Moves the vertices along their normals as a scanner's error does: half of the variance white,
// half correlated over a few rings. `amplitude` is the standard deviation in local edge lengths
// (mean length of the edges of the vertex).
inline void add_scan_noise(Chart& chart, double amplitude, std::uint64_t seed)
{
  const std::size_t n = chart.points.size();
  std::vector<double> correlated(n);
  for(std::size_t v = 0; v < n; ++v)
    correlated[v] = random_normal(seed, n + v);
  for(int i = 0; i < 3; ++i)
    internal::average_with_neighbors(chart, correlated);
  internal::normalize_variance(correlated);

  std::vector<Point> normal(n, Point{0, 0, 0});
  std::vector<double> length(n, 0);
  std::vector<Index> degree(n, 0);
  for(const Triangle& t : chart.triangles) {
    const Point twice_area =
        cross(chart.points[t[1]] - chart.points[t[0]], chart.points[t[2]] - chart.points[t[0]]);
    for(int c = 0; c < 3; ++c) {
      normal[t[c]] = normal[t[c]] + twice_area;
      length[t[c]] += norm(chart.points[t[c]] - chart.points[t[(c + 1) % 3]]);
      ++degree[t[c]];
    }
  }
  for(std::size_t v = 0; v < n; ++v) {
    const double size = norm(normal[v]);
    if(size == 0)
      continue;
    const double noise = (random_normal(seed, v) + correlated[v]) / std::sqrt(2.0);
    chart.points[v] =
        chart.points[v] + (amplitude * noise * length[v] / degree[v] / size) * normal[v];
  }
}

} // namespace charts
#endif
