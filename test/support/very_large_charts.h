// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_VERY_LARGE_CHARTS_H
#define HLSCM_TEST_SUPPORT_VERY_LARGE_CHARTS_H

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

// A chart that is mapped beyond the memory and in it, and how near each other the maps are.
struct Very_large_chart_case
{
  std::string name;
  Indexed_triangle_mesh mesh;
  double tolerance = 1e-11;
  double largest_difference = 1e-6; // of maps in the unit square
  bool is_doubtful = false;         // another map is as good: flips may differ
  // Its borders are alike, and so are the two smallest eigenvalues: many iterations
  bool has_near_eigenvalues = false;
  // Vertices of a block at most, and of what is in memory
  std::vector<std::pair<std::size_t, std::size_t>> sizes;
};

// Blocks of so many vertices; levels of no more than `gathered` are taken into memory.
inline CGAL::Surface_mesh_parameterization::Very_large_chart_options
very_large_options(std::size_t block, std::size_t gathered, double tolerance)
{
  CGAL::Surface_mesh_parameterization::Very_large_chart_options result;
  result.block_vertices = block;
  result.gathered_vertices = gathered;
  result.solver.tolerance = tolerance;
  result.solver.coarsest_size = 200;
  result.solver.threads = 1;
  return result;
}

// A strip of so many squares on a spiral with three turns.
inline Indexed_triangle_mesh spiral(Vertex_index n, Vertex_index width)
{
  Indexed_triangle_mesh mesh = grid(n, width);
  for(auto& p : mesh.points) {
    const double turns = 3. * p.x() / n, angle = 2. * 3.14159265358979 * turns;
    const double radius = 2. * width * (1. + turns) + p.y();
    p = Point_3(radius * std::cos(angle), radius * std::sin(angle), 0.1 * std::sin(5. * p.x()));
  }
  return mesh;
}

// Disks, several borders, long and thin charts and spirals; in 1 to 17 blocks, large ones in 64.
inline std::vector<Very_large_chart_case>
very_large_chart_cases(CGAL::Surface_mesh_parameterization::Conformal_method method)
{
  const bool is_free = method == CGAL::Surface_mesh_parameterization::Conformal_method::SPECTRAL;
  std::vector<Named_mesh> charts = curved_charts(1);
  if(is_sanitized)
    charts = {charts[1], charts[3], charts[9]};
  charts.push_back({"spiral", spiral(is_sanitized ? 300 : 900, 4)});
  charts.push_back({"long strip", with_noise(irregular_grid(600, 5, 4), 0.2, 5)});
  if(!is_sanitized) {
    charts.push_back(large_charts(1)[1]);
    charts.push_back({"wide spiral", spiral(650, 20)});
  }
  std::vector<Very_large_chart_case> result;
  for(const Named_mesh& chart : charts) {
    Very_large_chart_case one;
    one.name = chart.name;
    one.mesh = shuffled(chart.mesh, 3);
    // Of points twice the energy is that of slivers, and a spiral can be unrolled: there so small a
    // tolerance is out of reach, or by chance of rounding near.
    if(chart.name == "duplicate points" || (is_free && chart.name.find("spiral") != std::string::npos)) {
      one.tolerance = 1e-6;
      one.largest_difference = std::sqrt(0.1 * one.tolerance);
    }
    if(is_free && chart.name == "slivers on hills") { // rounding lets 1e-11 be met or not
      one.tolerance = 1e-10;
      one.largest_difference = std::sqrt(0.1 * one.tolerance);
    }
    // Its energy is that of rounding, and bending it costs less than the other deformations do by the
    // square of its length over its width.
    if(!is_free && chart.name == "wide spiral")
      one.largest_difference *= 650. / 20.;
    if(is_free && (chart.name == "sphere with holes" || chart.name == "cylinder")) {
      one.has_near_eigenvalues = true;
      one.is_doubtful = chart.name == "cylinder";
      one.largest_difference = one.is_doubtful ? 1e-4 : 1e-5;
    }
    const std::size_t n = one.mesh.points.size();
    one.sizes = {{n, n}, {n, n / 2}, {n / 3, n / 2}, {n / 17, n / 5}};
    if(n / 64 >= 200)
      one.sizes = {{n / 64, n / 5}};
    result.push_back(one);
  }
  return result;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_VERY_LARGE_CHARTS_H
