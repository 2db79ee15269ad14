// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_LOW_STRETCH_CHARTS_H
#define HLSCM_TEST_SUPPORT_LOW_STRETCH_CHARTS_H

// Charts that are hard to map without a flip.

#include <support/chart_generators.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace test_support {

// A tube of the given length and radius 1, closed at its far end.
inline Indexed_triangle_mesh finger(double length, Vertex_index circles)
{
  return moved(round_disk(circles), [=](const Point_3& p) {
    const double r = std::hypot(p.x(), p.y()), z = (length + 1.) * r;
    const double radius = z < 1. ? std::sqrt(1. - (1. - z) * (1. - z)) : 1.;
    return r > 0. ? Point_3(radius * p.x() / r, radius * p.y() / r, z) : Point_3(0., 0., 0.);
  });
}

// A plane with high thin spikes.
inline Indexed_triangle_mesh spikes(std::size_t number, double height, std::uint64_t s)
{
  Indexed_triangle_mesh mesh = irregular_grid(30, 30, s);
  Random random(s);
  std::vector<Point_3> tips;
  for(std::size_t i = 0; i < number; ++i)
    tips.emplace_back(uniform(random, 3., 27.), uniform(random, 3., 27.), 0.);
  return moved(mesh, [&](const Point_3& p) {
    double z = 0.;
    for(const Point_3& tip : tips)
      z = std::max(z, height * (1. - std::sqrt(squared_distance(p, tip)) / 3.));
    return Point_3(p.x(), p.y(), z);
  });
}

// A share of the triangles is split near an edge: heights of 1e-5.
inline Indexed_triangle_mesh with_caps(Indexed_triangle_mesh mesh, double share, std::uint64_t s)
{
  Random random(s);
  for(std::size_t t = 0, n = mesh.triangles.size(); t < n; ++t)
    if(uniform(random, 0., 1.) < share) {
      const Triangle_indices v = mesh.triangles[t];
      const Vertex_index m = Vertex_index(mesh.points.size());
      const Point_3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
      mesh.points.push_back(CGAL::ORIGIN + 0.5 * ((a - CGAL::ORIGIN) + (b - CGAL::ORIGIN)) + 1e-5 * (c - a));
      mesh.triangles[t] = {v[0], v[1], m};
      mesh.triangles.push_back({v[1], v[2], m});
      mesh.triangles.push_back({v[2], v[0], m});
    }
  return mesh;
}

// Charts of up to some 2,000 faces.
inline std::vector<Named_mesh> nasty_charts(std::uint64_t s)
{
  const Indexed_triangle_mesh plane = irregular_grid(32, 26, s), hills = with_hills(plane, 8., s + 1);
  return {
    {"noise of an edge length", with_noise(hills, 1., s + 2)},
    {"noise alone", with_noise(plane, 5., s + 4)},
    {"caps", with_caps(hills, 0.2, s + 5)},
    {"squeezed by 50", moved(hills, [](const Point_3& p) { return Point_3(p.x(), p.y() / 50., p.z()); })},
    {"stretched by 50", moved(hills, [](const Point_3& p) { return Point_3(p.x(), p.y(), 50. * p.z()); })},
    {"finger", finger(20., 20)},
    {"spikes", spikes(10, 20., s + 6)},
    {"spiral", rolled_up(irregular_grid(150, 5, s + 7), 4., 3.)},
    {"noisy holes", with_noise(with_holes(hills, 15, s + 8), 0.5, s + 9)},
    {"jagged holes", with_hills(with_jagged_border(with_holes(plane, 12, s + 11), 0.6, s + 12), 10., s + 13)},
    {"nearly closed sphere", on_sphere(round_disk(18), 3.1)},
    {"sphere with holes", with_holes(sphere(3), 5, s + 14)},
    {"long cylinder", with_noise(cylinder(14, 60), 0.02, s + 15)},
    {"zero-area triangles", with_zero_area_triangles(hills, 15, s + 16)},
    {"duplicate points", with_duplicate_points(hills, 15, s + 17)},
    {"shuffled", shuffled(with_noise(hills, 0.4, s + 18), s + 19)},
  };
}

// A chart of a few to some 400 faces, with any of what is hard about others.
inline Indexed_triangle_mesh random_chart(std::uint64_t s)
{
  Random random(s);
  const auto number = [&random](double lo, double hi) { return Vertex_index(uniform(random, lo, hi)); };
  const auto perhaps = [&random] { return uniform(random, 0., 1.) < 0.3; };
  // One after the other: compilers evaluate arguments in any order
  const Vertex_index kind = number(0., 6.), columns = number(4., 15.), rows = number(1., 12.),
                     holes = number(1., 6.);
  Indexed_triangle_mesh mesh;
  switch(kind) {
  case 0: mesh = irregular_grid(columns, rows, s); break;
  case 1: mesh = round_disk(2 + columns / 2); break;
  case 2: mesh = with_holes(irregular_grid(columns, rows + 3, s), holes, s); break;
  case 3: mesh = with_jagged_border(irregular_grid(columns, rows + 3, s), 0.5, s); break;
  case 4: mesh = cylinder(columns, rows); break;
  default: mesh = with_holes(sphere(2), holes, s); break;
  }
  if(perhaps())
    mesh = with_hills(mesh, uniform(random, 0., 10.), s);
  if(perhaps())
    mesh = with_noise(mesh, uniform(random, 0., 1.5), s);
  if(perhaps())
    mesh = with_slivers(mesh, uniform(random, 1., 50.));
  if(perhaps())
    mesh = moved(mesh, [f = uniform(random, 1., 50.)](const Point_3& p) { return Point_3(p.x(), p.y(), f * p.z()); });
  if(perhaps())
    mesh = with_caps(mesh, 0.2, s);
  if(perhaps())
    mesh = with_zero_area_triangles(mesh, number(1., 4.), s);
  if(perhaps())
    mesh = with_duplicate_points(mesh, number(1., 4.), s);
  return perhaps() ? shuffled(mesh, s) : mesh;
}

// Those of up to 1,500 faces.
inline std::vector<Named_mesh> small_ones_of(std::vector<Named_mesh> charts)
{
  charts.erase(std::remove_if(charts.begin(), charts.end(), [](const Named_mesh& chart) {
    return chart.mesh.triangles.size() > 1500;
  }), charts.end());
  return charts;
}

// How many seeds are tried: the variable HLSCM_STRETCH_SEEDS, or 1.
inline std::uint64_t number_of_seeds()
{
  const char* text = std::getenv("HLSCM_STRETCH_SEEDS");
  return text == nullptr ? 1 : std::strtoull(text, nullptr, 10);
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_LOW_STRETCH_CHARTS_H
