// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_CHART_SHAPES_H
#define HLSCM_TEST_SUPPORT_CHART_SHAPES_H

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_texturing/Chart_packing.h>

#include <cmath>
#include <vector>

// Charts in the plane, to be packed. Triangles are counterclockwise.

namespace test_support {

using CGAL::Surface_mesh_texturing::Chart_shape;

// The quads between two polylines of the same number of points; closed: the last meets the first.
inline Chart_shape band(const std::vector<Chart_shape::Point_2>& inner,
                        const std::vector<Chart_shape::Point_2>& outer, bool is_closed)
{
  Chart_shape chart;
  const Vertex_index n = Vertex_index(inner.size());
  for(Vertex_index i = 0; i < n; ++i) {
    chart.uv.push_back(inner[i]);
    chart.uv.push_back(outer[i]);
  }
  for(Vertex_index i = 0; i + (is_closed ? 0 : 1) < n; ++i) {
    const Vertex_index a = 2 * i, b = 2 * ((i + 1) % n);
    chart.triangles.push_back({a, a + 1, b + 1});
    chart.triangles.push_back({a, b + 1, b});
  }
  return chart;
}

inline Chart_shape rectangle_chart(double width, double height)
{
  return {{{0., 0.}, {width, 0.}, {width, height}, {0., height}}, {{0, 1, 2}, {0, 2, 3}}};
}

// A square of side 1 without that of side 1 - thickness in its upper right corner.
inline Chart_shape l_chart(double thickness)
{
  const double t = thickness;
  return {{{0., 0.}, {1., 0.}, {1., t}, {t, t}, {t, 1.}, {0., 1.}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
}

inline Chart_shape ring_chart(double inner_radius, double outer_radius, int segments = 48)
{
  std::vector<Chart_shape::Point_2> inner, outer;
  for(int i = 0; i < segments; ++i) {
    const double a = 2. * CGAL_PI * i / segments;
    inner.emplace_back(inner_radius * std::cos(a), inner_radius * std::sin(a));
    outer.emplace_back(outer_radius * std::cos(a), outer_radius * std::sin(a));
  }
  return band(inner, outer, true);
}

// A fan around the origin, `radius(angle)` wide.
template <class Radius>
Chart_shape fan_chart(int segments, const Radius& radius)
{
  Chart_shape chart;
  chart.uv.emplace_back(0., 0.);
  for(int i = 0; i < segments; ++i) {
    const double a = 2. * CGAL_PI * i / segments, r = radius(a);
    chart.uv.emplace_back(r * std::cos(a), r * std::sin(a));
    chart.triangles.push_back(
      {0, Vertex_index(1 + i), Vertex_index(1 + (i + 1) % segments)});
  }
  return chart;
}

inline Chart_shape star_chart(int tips, double inner_radius, double outer_radius)
{
  int i = 0;
  return fan_chart(2 * tips, [&](double) { return i++ % 2 == 0 ? outer_radius : inner_radius; });
}

// A blob with some lobes.
inline Chart_shape blob_chart(Random& random, double size)
{
  std::vector<double> amplitude, phase;
  for(int k = 2; k < 7; ++k) {
    amplitude.push_back(uniform(random, 0., 0.45 / k));
    phase.push_back(uniform(random, 0., 2. * CGAL_PI));
  }
  const double stretch = uniform(random, 0.6, 1.);
  Chart_shape chart = fan_chart(60, [&](double a) {
    double r = 1.;
    for(std::size_t k = 0; k < amplitude.size(); ++k)
      r += amplitude[k] * std::cos(double(k + 2) * a + phase[k]);
    return size * r;
  });
  const double c = std::cos(phase[0]), s = std::sin(phase[0]);
  for(auto& p : chart.uv)
    p = Chart_shape::Point_2(c * p.x() - s * stretch * p.y() + 100.,
                             s * p.x() + c * stretch * p.y());
  return chart;
}

// Blobs of sizes from 1 down to `smallest`, most of them small.
inline std::vector<Chart_shape> blob_charts(std::size_t number, double smallest, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Chart_shape> charts;
  for(std::size_t i = 0; i < number; ++i)
    charts.push_back(blob_chart(random, std::pow(smallest, uniform(random, 0., 1.))));
  return charts;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_CHART_SHAPES_H
