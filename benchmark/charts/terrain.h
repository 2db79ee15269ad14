// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_TERRAIN_H
#define HLSCM_BENCHMARK_CHARTS_TERRAIN_H

#include "Chart.h"

namespace charts {

// A grid of columns x rows cells over a mountainous height field on the unit square: what a
// range image becomes, with cells as anisotropic as rows / columns.
inline Chart make_terrain(Index columns, Index rows)
{
  const auto height = [](double x, double y) {
    double sum = 0, amplitude = 0.08, frequency = 5;
    for(int octave = 0; octave < 5; ++octave, amplitude *= 0.45, frequency *= 2.1)
      sum += amplitude * std::sin(frequency * x + 1.3 * octave)
                 * std::cos(frequency * 0.9 * y + octave)
             + 0.5 * amplitude * std::sin(frequency * (0.6 * x - 1.1 * y));
    return sum;
  };
  Chart chart;
  for(Index j = 0; j <= rows; ++j)
    for(Index i = 0; i <= columns; ++i) {
      const double x = double(i) / columns, y = double(j) / rows;
      chart.points.push_back({x, y, height(x, y)});
    }
  for(Index j = 0; j < rows; ++j)
    for(Index i = 0; i < columns; ++i) {
      const Index v = j * (columns + 1) + i, above = v + columns + 1;
      chart.triangles.push_back({v, v + 1, above + 1});
      chart.triangles.push_back({v, above + 1, above});
    }
  return chart;
}

} // namespace charts
#endif
