// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Low-stretch maps from a given map, with pins that are dragged, and with weights of faces.

#include <support/chart_generators.h>
#include <support/low_stretch_checks.h>

#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace low_stretch_options_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

constexpr std::uint64_t seed = 20261124;

// Tutte's map to a circle.
Uv circle_map(const Indexed_triangle_mesh& mesh)
{
  Uv uv;
  for(const auto& z : CGAL::Surface_mesh_parameterization::internal::Circle_map(mesh).run())
    uv.emplace_back(z.x, z.y);
  return uv;
}

// --- From a given map

// From a conformal map, from one to a circle and from its own result the iteration ends at the energy
// at which it ends without one.
TEST(Low_stretch_start, ends_where_other_starts_end)
{
  std::size_t conformal_starts = 0;
  for(const Named_mesh& chart : low_stretch_charts(seed)) {
    Low_stretch_options options;
    const Low_stretch_map own = low_stretch_map(chart.mesh, options);
    std::vector<std::pair<std::string, Uv>> starts
      = {{"own", own.uv}, {"circle", circle_map(chart.mesh)}};
    const Conformal_map conformal = conformal_map(chart.mesh);
    if(error_in_orientation(chart.mesh, conformal.uv).empty()) {
      starts.push_back({"conformal", conformal.uv});
      ++conformal_starts;
    }
    for(const auto& [name, start] : starts) {
      options.start = start;
      const Low_stretch_map map = low_stretch_map(chart.mesh, options);
      ASSERT_EQ(error_in_map(chart.mesh, map), "") << chart.name << " from " << name;
      EXPECT_TRUE(map.report.converged) << chart.name << " from " << name;
      EXPECT_LT(map.report.energy, 1.003 * own.report.energy) << chart.name << " from " << name;
      if(chart.name != "sphere with holes") { // any hole may be the outer one, with a minimum for each
        EXPECT_GT(map.report.energy, 0.997 * own.report.energy) << chart.name << " from " << name;
      }
      if(name == "own") {
        EXPECT_LE(map.report.energy, own.report.energy) << chart.name;
      }
    }
  }
  EXPECT_GT(conformal_starts, 0u);
}

TEST(Low_stretch_start, unit_and_place_of_the_start_do_not_matter)
{
  const Indexed_triangle_mesh mesh = low_stretch_charts(seed)[0].mesh;
  Low_stretch_options options;
  options.start = circle_map(mesh);
  const double energy = low_stretch_map(mesh, options).report.energy;
  for(Point_2& p : options.start)
    p = Point_2(7. - 1e-9 * p.y(), 1e-9 * p.x());
  EXPECT_NEAR(low_stretch_map(mesh, options).report.energy, energy, 1e-3 * energy);
}

// The pins of a start need not be where they are wanted.
TEST(Low_stretch_start, pins_are_reached)
{
  Random random(seed);
  for(const Named_mesh& chart : low_stretch_charts(seed)) {
    Low_stretch_options options;
    options.start = circle_map(chart.mesh);
    const Low_stretch_map free = low_stretch_map(chart.mesh, options);
    for(std::size_t v = 0; v < chart.mesh.points.size(); v += chart.mesh.points.size() / 6) {
      const double shift = 0.05 * std::sqrt(free.report.area);
      options.pins.push_back({v, free.uv[v].x() + uniform(random, -shift, shift),
                              free.uv[v].y() + uniform(random, -shift, shift)});
    }
    const Low_stretch_map map = low_stretch_map(chart.mesh, options);
    ASSERT_EQ(error_in_map(chart.mesh, map), "") << chart.name;
    EXPECT_EQ(error_in_pins(options.pins, map.uv), "") << chart.name;
    options.start.clear();
    const Low_stretch_map other = low_stretch_map(chart.mesh, options);
    EXPECT_NEAR(map.report.energy, other.report.energy, 0.01 * other.report.energy) << chart.name;
  }
}

// Told to stop while they are still on their way it says so, and soon.
TEST(Low_stretch_start, pins_on_their_way_can_be_stopped)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(30, 25, seed), 8., seed);
  Low_stretch_options options;
  options.start = low_stretch_map(mesh).uv;
  for(const std::size_t v : {std::size_t(0), mesh.points.size() / 2, mesh.points.size() - 1})
    options.pins.push_back({v, options.start[v].y() * (v == 0 ? 3. : -2.), options.start[v].x()});
  std::size_t calls = 0;
  options.progress = [&calls](double) { return ++calls < 3; };
  const Low_stretch_map map = low_stretch_map(mesh, options);
  EXPECT_NE(map.error.find("pins were not at their places yet"), std::string::npos) << map.error;
  EXPECT_TRUE(map.uv.empty());
  EXPECT_LE(calls, 10u);
  options.progress = nullptr;
  EXPECT_EQ(low_stretch_map(mesh, options).error, "");
}

TEST(Low_stretch_start, bad_starts_are_named)
{
  const Indexed_triangle_mesh mesh = shuffled(with_hills(irregular_grid(12, 10, seed), 3., seed), seed);
  Low_stretch_options options;
  options.start = circle_map(mesh);
  const auto error = [&] {
    const Low_stretch_map map = low_stretch_map(mesh, options);
    EXPECT_EQ(map.status, Mesh_status::BAD_OPTIONS);
    EXPECT_TRUE(map.uv.empty());
    return map.error;
  };
  const Uv good = options.start;
  for(const std::size_t t : {100, 17, 3}) { // the first one counts
    const Triangle_indices& v = mesh.triangles[t];
    options.start[v[0]] = options.start[v[1]];
    std::size_t first = 0;
    while([&] {
      const Triangle_indices& w = mesh.triangles[first];
      return CGAL::orientation(options.start[w[0]], options.start[w[1]], options.start[w[2]])
          == CGAL::LEFT_TURN;
    }())
      ++first;
    EXPECT_NE(error().find("face " + std::to_string(first) + " "), std::string::npos) << error();
  }
  options.start = good;
  options.start.pop_back();
  EXPECT_NE(error().find("parameters"), std::string::npos);
  options.start = good;
  options.start[5] = Point_2(std::nan(""), 0.);
  EXPECT_NE(error().find("face"), std::string::npos);
}

// --- Pins that are dragged

TEST(Live_low_stretch_map, pins_are_followed)
{
  for(const Named_mesh& chart : low_stretch_charts(seed)) {
    Low_stretch_options options;
    const Low_stretch_map free = low_stretch_map(chart.mesh, options);
    const std::size_t n = chart.mesh.points.size();
    for(const std::size_t v : {std::size_t(0), n / 3, 2 * n / 3})
      options.pins.push_back({v, free.uv[v].x(), free.uv[v].y()});
    Live_low_stretch_map<> live(chart.mesh, options);
    ASSERT_TRUE(live.has_map()) << live.outcome().error;
    const double step = 0.04 * std::sqrt(free.report.area);
    for(int i = 0; i < 5; ++i) {
      options.pins[1].u += step;
      options.pins[1].v -= 0.5 * step;
      live.set_pin(options.pins[1].vertex, Point_2(options.pins[1].u, options.pins[1].v));
      ASSERT_TRUE(live.solve()) << chart.name << ": " << live.outcome().error;
      EXPECT_EQ(error_in_orientation(chart.mesh, live.uv()), "") << chart.name << ", step " << i;
      EXPECT_EQ(error_in_pins(options.pins, live.uv()), "") << chart.name << ", step " << i;
    }
    // What a run from nothing finds
    const Low_stretch_map map = low_stretch_map(chart.mesh, options);
    ASSERT_EQ(error_in_map(chart.mesh, map), "") << chart.name;
    const bool has_one_minimum = free.report.borders == 1; // or hardly others
    if(has_one_minimum) {
      EXPECT_LT(live.report().energy, 1.01 * map.report.energy) << chart.name;
    }
    // A pin that was not there at first, and none at all
    const std::size_t v = n / 2;
    options.pins.push_back({v, live.uv()[v].x(), live.uv()[v].y() + step});
    live.set_pin(v, Point_2(options.pins[3].u, options.pins[3].v));
    ASSERT_TRUE(live.solve()) << chart.name << ": " << live.outcome().error;
    EXPECT_EQ(error_in_orientation(chart.mesh, live.uv()), "") << chart.name;
    EXPECT_EQ(error_in_pins(options.pins, live.uv()), "") << chart.name;
    for(const HLSCM_pin& pin : options.pins)
      EXPECT_TRUE(live.release_pin(pin.vertex));
    EXPECT_FALSE(live.release_pin(v));
    ASSERT_TRUE(live.solve()) << chart.name << ": " << live.outcome().error;
    if(has_one_minimum) {
      EXPECT_LT(live.report().energy, 1.003 * free.report.energy) << chart.name;
    }
  }
}

// Where no way is found the last map stays.
TEST(Live_low_stretch_map, the_map_stays_if_there_is_no_other)
{
  const Indexed_triangle_mesh mesh = grid(8, 8);
  Live_low_stretch_map<> live(mesh);
  ASSERT_TRUE(live.has_map());
  const Uv before = live.uv();
  for(int c = 0; c < 3; ++c)
    live.set_pin(mesh.triangles[0][c], Point_2(c == 1 ? 1. : 0., c == 0 ? 1. : 0.));
  EXPECT_FALSE(live.solve());
  EXPECT_NE(live.outcome().error.find("turns over"), std::string::npos);
  EXPECT_EQ(live.uv(), before);
  live.set_pin(999, Point_2(1., 0.));
  EXPECT_FALSE(live.solve());
  EXPECT_NE(live.outcome().error.find("999"), std::string::npos);
  for(const std::size_t v : mesh.triangles[0])
    live.release_pin(v);
  live.release_pin(999);
  EXPECT_TRUE(live.solve());
  EXPECT_EQ(error_in_orientation(mesh, live.uv()), "");
}

// --- Weights

TEST(Low_stretch_weights, equal_ones_change_nothing)
{
  const Indexed_triangle_mesh mesh = low_stretch_charts(seed)[1].mesh;
  const Low_stretch_map map = low_stretch_map(mesh);
  Low_stretch_options options;
  for(const double weight : {1., 2., 0.7}) {
    options.face_weights.assign(mesh.triangles.size(), weight);
    const Low_stretch_map again = low_stretch_map(mesh, options);
    ASSERT_EQ(error_in_map(mesh, again), "");
    EXPECT_NEAR(again.report.energy, map.report.energy, 1e-9 * map.report.energy) << weight;
    EXPECT_NEAR(again.report.area, map.report.area, 1e-9 * map.report.area) << weight;
  }
}

// The mean with weights, by its definition.
double weighted_energy(const Indexed_triangle_mesh& mesh, const Uv& uv,
                       const std::vector<double>& weights)
{
  double sum = 0., area = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Indexed_triangle_mesh one = {mesh.points, {mesh.triangles[t]}};
    const Triangle_indices& v = mesh.triangles[t];
    const auto reference
      = Reference_triangle<double>::of_points(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    sum += weights[t] * reference.area() * energy_of(one, uv, Symmetric_dirichlet_energy());
    area += weights[t] * reference.area();
  }
  return sum / area;
}

// Each of two maps is better by its own weights, and the energy of the report is that of the weights.
// A face with the weight 2 counts as two of them would.
TEST(Low_stretch_weights, count_as_copies_of_faces)
{
  for(const Named_mesh& chart : low_stretch_charts(seed)) {
    Low_stretch_options options;
    options.tolerance = 1e-8; // with 1e-5 some of 480 runs on such charts end beside a saddle, too high
    const Low_stretch_map plain = low_stretch_map(chart.mesh, options);
    const std::vector<double> ones(chart.mesh.triangles.size(), 1.);
    std::vector<double>& weights = options.face_weights;
    const CGAL::Bbox_3 box = CGAL::bbox_3(chart.mesh.points.begin(), chart.mesh.points.end());
    for(const Triangle_indices& t : chart.mesh.triangles)
      weights.push_back(chart.mesh.points[t[0]].x() > 0.5 * (box.xmin() + box.xmax()) ? 20. : 1.);
    const Low_stretch_map map = low_stretch_map(chart.mesh, options);
    ASSERT_EQ(error_in_orientation(chart.mesh, map.uv), "") << chart.name;
    EXPECT_NEAR(map.report.energy, weighted_energy(chart.mesh, map.uv, weights),
                1e-9 * map.report.energy);
    EXPECT_LT(map.report.energy, weighted_energy(chart.mesh, plain.uv, weights)) << chart.name;
    EXPECT_LT(plain.report.energy, weighted_energy(chart.mesh, map.uv, ones)) << chart.name;
    // The same from the other map, and with faces in another order
    options.start = plain.uv;
    const Low_stretch_map from = low_stretch_map(chart.mesh, options);
    EXPECT_NEAR(from.report.energy, map.report.energy, 1e-3 * map.report.energy) << chart.name;
    Indexed_triangle_mesh reversed = chart.mesh;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    std::reverse(weights.begin(), weights.end());
    options.start.clear();
    const Low_stretch_map other = low_stretch_map(reversed, options);
    EXPECT_NEAR(other.report.energy, map.report.energy, 1e-4 * map.report.energy) << chart.name;
  }
}

TEST(Low_stretch_weights, bad_ones_are_named)
{
  const Indexed_triangle_mesh mesh = grid(4, 4);
  Low_stretch_options options;
  const auto error = [&] {
    const Low_stretch_map map = low_stretch_map(mesh, options);
    EXPECT_EQ(map.status, Mesh_status::BAD_OPTIONS);
    return map.error;
  };
  options.face_weights.assign(31, 1.);
  EXPECT_NE(error().find("31 weights"), std::string::npos);
  options.face_weights.assign(32, 1.);
  options.face_weights[7] = 0.;
  EXPECT_NE(error().find("face 7"), std::string::npos);
}

} // namespace low_stretch_options_test
