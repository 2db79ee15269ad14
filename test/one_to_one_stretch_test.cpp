// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Low-stretch maps that are one-to-one: that no two parts overlap, by the exact certificate, whatever
// the surface, the options and the moment at which they are ended.

#include <support/chart_generators.h>
#include <support/low_stretch_charts.h>
#include <support/low_stretch_checks.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_state.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace one_to_one_stretch_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
namespace SMP_internal = CGAL::Surface_mesh_parameterization::internal;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

constexpr std::uint64_t seed = 20261125;

Map_certificate certificate_of(const Indexed_triangle_mesh& arrays, const Uv& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  auto uvmap = mesh.add_property_map<Surface_mesh::Vertex_index, Point_2>("v:uv").first;
  for(const auto v : mesh.vertices())
    uvmap[v] = uv[v];
  return certify_map(mesh, uvmap);
}

Low_stretch_options one_to_one()
{
  Low_stretch_options options;
  options.is_one_to_one = true;
  return options;
}

std::string error_in_one_to_one_map(const Indexed_triangle_mesh& mesh, const Low_stretch_map& map)
{
  const std::string error = error_in_map(mesh, map);
  if(!error.empty())
    return error;
  return certificate_of(mesh, map.uv).is_one_to_one() ? "" : "the map is not one-to-one";
}

// Stairs around a column: flat rings one above the other.
Indexed_triangle_mesh stairs(Vertex_index length)
{
  return moved(grid(length, 6), [](const Point_3& p) {
    const double a = 0.05 * p.x(), r = 3. + p.y();
    return Point_3(r * std::cos(a), r * std::sin(a), 0.2 * a);
  });
}

// Charts whose maps mostly overlap if nothing keeps them from it.
std::vector<Named_mesh> overlapping_charts()
{
  return {{"stairs", stairs(400)},
          {"sphere with holes", with_holes(sphere(3), 5, 14)},
          {"cylinder", with_noise(cylinder(60, 15), 0.01, seed)}};
}

TEST(One_to_one_stretch, no_two_parts_overlap)
{
  for(std::uint64_t s = seed; s < seed + number_of_seeds(); ++s)
    for(const auto& charts : {small_ones_of(planar_charts(s)), nasty_charts(s), overlapping_charts()})
      for(const Named_mesh& chart : charts) {
        const Low_stretch_map map = low_stretch_map(chart.mesh, one_to_one());
        EXPECT_EQ(error_in_one_to_one_map(chart.mesh, map), "") << chart.name << ", seed " << s;
      }
}

// Whatever is hard about a chart; each has a map.
TEST(One_to_one_stretch, random_charts_have_maps)
{
  for(std::uint64_t s = seed; s < seed + 150 * number_of_seeds(); ++s) {
    const Indexed_triangle_mesh mesh = random_chart(s);
    EXPECT_EQ(error_in_one_to_one_map(mesh, low_stretch_map(mesh, one_to_one())), "") << "seed " << s;
  }
}

// A hole with the surface around it, in a square.
struct Square_with_hole
{
  std::vector<SMP_internal::Plane_point> places = {{0., 0.}, {9., 0.}, {9., 9.}, {0., 9.},
                                                   {4., 4.}, {4., 5.}, {5., 5.}, {5., 4.}};
  SMP_internal::Border_loops loops = {{0, 1, 2, 3}, {4, 5, 6, 7}};
};

// No segment of the border meets another one where a vertex goes across a hole with all its others: the hole
// would be turned over.
TEST(Border_guard, keeps_holes_from_turning_over)
{
  const Square_with_hole square;
  const SMP_internal::Border_guard guard(square.loops, square.places, 0.);
  EXPECT_TRUE(guard.allows({4.2, 4.5}, 4, 5, 0.)); // between the ends of an edge: into the hole
  EXPECT_TRUE(guard.allows({3.5, 4.5}, 4, 5, 0.)); // into the surface
  EXPECT_FALSE(guard.allows({5.2, 4.5}, 4, 5, 0.)); // across an edge
  EXPECT_TRUE(guard.allows_move({4.4, 4.3}, 4));
  EXPECT_FALSE(guard.allows_move({5.5, 5.5}, 4)); // across two edges
  SMP_internal::Border_loops triangle = {{0, 1, 2, 3}, {4, 5, 6}};
  std::vector<SMP_internal::Plane_point> places = square.places;
  places[6] = {4.1, 4.5};
  const SMP_internal::Border_guard of_triangle(triangle, places, 0.);
  EXPECT_TRUE(of_triangle.allows({4.05, 4.5}, 4, 5, 0.));
  EXPECT_FALSE(of_triangle.allows({8., 4.5}, 4, 5, 0.)); // around vertex 6
  triangle[1] = {4, 5, 6, 7};
  places[7] = {4.1, 4.4};
  const SMP_internal::Border_guard of_thin_one(triangle, places, 0.);
  EXPECT_TRUE(of_thin_one.allows_move({4.04, 5.}, 5));
  EXPECT_FALSE(of_thin_one.allows_move({8., 4.45}, 5)); // vertex 6 lies between, and no edge is met
}

// What is too near may go away, but not nearer.
TEST(Border_guard, lets_borders_go_apart)
{
  Square_with_hole square;
  square.places[6] = {4.02, 4.6};
  const SMP_internal::Border_guard guard(square.loops, square.places, 0.25);
  EXPECT_TRUE(guard.allows_move({4.03, 4.6}, 6));
  EXPECT_FALSE(guard.allows_move({4.01, 4.6}, 6));
}

// It costs little stretch, and none where the map is one-to-one without it.
TEST(One_to_one_stretch, costs_little)
{
  const Indexed_triangle_mesh column = stairs(400);
  const Low_stretch_map free = low_stretch_map(column);
  ASSERT_TRUE(free.is_ok());
  EXPECT_TRUE(certificate_of(column, free.uv).overlaps);
  const Low_stretch_map apart = low_stretch_map(column, one_to_one());
  ASSERT_EQ(error_in_one_to_one_map(column, apart), "");
  EXPECT_LT(apart.report.energy, 1.05 * free.report.energy);
  for(const Named_mesh& chart : {Named_mesh{"hills", with_hills(irregular_grid(30, 25, seed), 8., seed)},
                                 Named_mesh{"dome", on_sphere(round_disk(18), 2.2)}}) {
    const double energy = low_stretch_map(chart.mesh).report.energy;
    const Low_stretch_map map = low_stretch_map(chart.mesh, one_to_one());
    EXPECT_NEAR(map.report.energy, energy, 1e-3 * energy) << chart.name;
  }
}

// The circles of a tube of length L and radius 1 may become those of a ring, of radii from 1 to 1 + c L: its
// energy is at most c^2 + 1 / c^2 + (1 + c L + c^2 L^2 / 3) + 1. No minimum is above that of the best c,
// c^2 = 1 / r. From nested triangles as small as Tutte's map makes them the energy once fell no further
// than 1e7.
TEST(One_to_one_stretch, one_end_of_a_long_tube_surrounds_the_other)
{
  for(const double length : {10., 30., 60.}) {
    const Indexed_triangle_mesh tube = cylinder(16, Vertex_index(length / 0.3));
    const Low_stretch_map map = low_stretch_map(tube, one_to_one());
    EXPECT_EQ(error_in_one_to_one_map(tube, map), "") << length;
    const double r = std::sqrt(1. + length * length / 3.);
    EXPECT_LT(map.report.energy, 2. + 2. * r + length / std::sqrt(r)) << length;
  }
}

TEST(One_to_one_stretch, can_be_ended_at_any_moment)
{
  const Indexed_triangle_mesh mesh = overlapping_charts()[1].mesh;
  for(std::size_t calls = 0; calls < 40; calls += calls / 4 + 1) {
    Low_stretch_options options = one_to_one();
    std::size_t count = 0;
    options.progress = [&](double) { return ++count <= calls; };
    EXPECT_EQ(error_in_one_to_one_map(mesh, low_stretch_map(mesh, options)), "") << calls << " calls";
  }
}

// Neither threads nor powers of 2 change a bit.
TEST(One_to_one_stretch, threads_and_units_do_not_matter)
{
  const Indexed_triangle_mesh mesh = with_noise(stairs(500), 0.05, seed);
  const Low_stretch_map map = low_stretch_map(mesh, one_to_one());
  ASSERT_EQ(error_in_one_to_one_map(mesh, map), "");
  {
    const CGAL::Blocked_execution::Thread_scope scope(3);
    EXPECT_EQ(low_stretch_map(mesh, one_to_one()).uv, map.uv);
  }
  Uv uv = low_stretch_map(scaled(mesh, 1024.), one_to_one()).uv;
  for(Point_2& p : uv)
    p = Point_2(p.x() / 1024., p.y() / 1024.);
  EXPECT_EQ(uv, map.uv);
}

// With the other options.
TEST(One_to_one_stretch, goes_with_pins_starts_and_borders)
{
  const Indexed_triangle_mesh mesh = stairs(200);
  Low_stretch_options options = one_to_one();
  const Low_stretch_map map = low_stretch_map(mesh, options);
  ASSERT_EQ(error_in_one_to_one_map(mesh, map), "");
  // A start that overlaps, and one that does not
  options.start = low_stretch_map(mesh).uv;
  EXPECT_NE(low_stretch_map(mesh, options).error.find("one-to-one"), std::string::npos);
  options.start = map.uv;
  const Low_stretch_map again = low_stretch_map(mesh, options);
  ASSERT_EQ(error_in_one_to_one_map(mesh, again), "");
  EXPECT_LE(again.report.energy, 1.001 * map.report.energy);
  // Two ends of the stairs are pulled towards each other, and then past each other
  options.start.clear();
  Live_low_stretch_map<> live(mesh, options);
  const std::size_t first = 0, last = 200;
  const Point_2 from = live.uv()[first], to = live.uv()[last];
  for(const double part : {0.1, 0.2, 0.3}) {
    live.set_pin(first, from + part * (to - from));
    live.set_pin(last, to - part * (to - from));
    ASSERT_TRUE(live.solve()) << live.outcome().error;
    EXPECT_TRUE(certificate_of(mesh, live.uv()).is_one_to_one()) << part;
  }
  // A border that crosses itself is refused although there is a map without a flip
  const Indexed_triangle_mesh strip = grid(60, 3);
  const auto loop = CGAL::Indexed_mesh::border_loops(CGAL::Indexed_mesh::Vertex_rings(strip))[0];
  options = Low_stretch_options();
  for(const auto v : loop) {
    const double a = strip.points[v].x() / 6., r = 6. - strip.points[v].y();
    options.pins.push_back({v, r * std::cos(a), r * std::sin(a)});
  }
  const Low_stretch_map spiral = low_stretch_map(strip, options);
  EXPECT_EQ(error_in_map(strip, spiral), "");
  options.is_one_to_one = true;
  const Low_stretch_map none = low_stretch_map(strip, options);
  EXPECT_TRUE(none.uv.empty());
  EXPECT_NE(none.error.find("meets"), std::string::npos) << none.error;
}

// If they would be taken otherwise: to keep parts apart takes longer.
TEST(One_to_one_stretch, charts_of_atlases_are_so_within_the_bound)
{
  namespace SMT = CGAL::Surface_mesh_texturing;
  const Indexed_triangle_mesh mesh = stairs(140);
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<CGAL::Indexed_mesh::Triangle_index> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const SMT::Chart_mesh chart
    = SMT::internal::Chart_cutter<CGAL::Indexed_mesh::Triangle_adjacency>(mesh, adjacency)(all);
  const auto is_one_to_one = [&chart](const SMT::Distortion_bound& bound) {
    const auto uv = SMT::internal::stretch_map(chart.mesh, chart.border_edges(), bound);
    return certificate_of(chart.mesh, uv).is_one_to_one();
  };
  EXPECT_TRUE(is_one_to_one({4., 2.}));
  EXPECT_FALSE(is_one_to_one({1., 1.}));
}

} // namespace one_to_one_stretch_test
