// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The map that is kept up to date: after any change it is what a solver from nothing computes.

#include <support/conformal_maps.h>

#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace live_map_test {

using namespace test_support;
using SMP::Conformal_method;
using SMP::HLSCM_options;

typedef SMP::Hierarchical_conformal_map<Surface_mesh> Live_map;
typedef std::complex<double> Complex;
typedef Surface_mesh::Vertex_index Vertex;

HLSCM_options with_many_levels(double tolerance = 1e-3)
{
  HLSCM_options options = with_method(Conformal_method::HLSCM, tolerance);
  options.coarsest_size = 300;
  return options;
}

Indexed_triangle_mesh hills(std::uint64_t seed = 1)
{
  return with_noise(with_hills(irregular_grid(70, 50, seed), 10., seed + 1), 0.1, seed + 2);
}

// The problem as it is, solved from nothing.
struct Problem
{
  Indexed_triangle_mesh mesh;
  std::map<Vertex_index, Complex> pins;
  std::vector<double> weights; // empty for 1

  CGAL::Surface_mesh_parameterization::Conformal_operator<double>
  conformal_operator(bool has_pins) const
  {
    Indexed_triangle_mesh normalized = mesh;
    CGAL::Indexed_mesh::normalize(normalized);
    std::vector<bool> is_pinned(mesh.points.size(), false);
    if(has_pins)
      for(const auto& pin : pins)
        is_pinned[pin.first] = true;
    return SMP::conformal_operator<double>(normalized, is_pinned, weights);
  }

  double energy(const Parameters& z) const { return conformal_operator(false).energy(z); }

  double least_energy() const
  {
    const auto op = conformal_operator(true);
    Parameters z(mesh.points.size()), f(z.size()), x;
    for(const auto& [v, value] : pins)
      z[v] = value;
    op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex sum) { f[i] = -sum; });
    for(const auto& pin : pins)
      f[pin.first] = 0;
    CGAL::Multigrid::Sparse_cholesky<> solver;
    EXPECT_TRUE(solver.factorize(op.matrix));
    solver.solve(f, x);
    for(std::size_t i = 0; i < z.size(); ++i)
      z[i] += x[i];
    return energy(z);
  }
};

Parameters parameters(const Surface_mesh& mesh, const Live_map& map)
{
  Parameters result;
  for(const Vertex v : vertices(mesh)) {
    const auto p = map.uv(v);
    result.push_back({p.x(), p.y()});
  }
  return result;
}

// What is wrong with the map for the problem, or an empty string.
std::string error_of(const Live_map& map, const Surface_mesh& mesh, const Problem& problem,
                     double tolerance)
{
  if(map.error() != SMP::OK || !map.report().converged)
    return "failed: " + map.report().message;
  const Parameters z = parameters(mesh, map);
  for(const auto& [v, value] : problem.pins)
    if(z[v] != value)
      return "pin " + std::to_string(v) + " is not in its place";
  const double least = problem.least_energy(), energy = problem.energy(z);
  if(!(energy - least <= tolerance * energy + 1e-12))
    return "the energy is " + std::to_string(energy) + ", not " + std::to_string(least);
  double largest = 0.; // whose square the form z^H H z rounds to
  for(const Complex& value : z)
    largest = (std::max)(largest, std::abs(value));
  if(!(std::abs(map.report().energy - energy) <= 1e-8 * energy + 1e-13 * largest * largest))
    return "the energy is " + std::to_string(energy) + ", but reported as "
         + std::to_string(map.report().energy);
  return {};
}

// A mesh, its map, and the problem that it should solve.
struct Live
{
  Problem problem;
  HLSCM_options options;
  Surface_mesh mesh;
  Live_map map;

  explicit Live(const Indexed_triangle_mesh& arrays, const HLSCM_options& o = with_many_levels())
    : problem{arrays, {}, {}}, options(o), mesh(to_surface_mesh(arrays))
    , map(mesh, border_halfedge(mesh), o)
  {}

  void solve_first()
  {
    EXPECT_EQ(map.solve(), SMP::OK) << map.report().message;
    for(const auto& pin : map.report().pins)
      problem.pins[Vertex_index(pin.vertex)] = {pin.u, pin.v};
  }
  void pin(Vertex_index v, Complex z)
  {
    problem.pins[v] = z;
    EXPECT_EQ(map.set_pin(Vertex(v), {z.real(), z.imag()}), SMP::OK);
  }
  void release(Vertex_index v)
  {
    problem.pins.erase(v);
    EXPECT_EQ(map.release_pin(Vertex(v)), SMP::OK);
  }
  Complex uv(Vertex_index v) const
  {
    const auto p = map.uv(Vertex(v));
    return {p.x(), p.y()};
  }
  std::string error() const { return error_of(map, mesh, problem, options.tolerance); }
};

TEST(Live_map, begins_as_the_parameterizer)
{
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::SPECTRAL}) {
    HLSCM_options options = with_many_levels();
    options.method = method;
    Live live(hills(), options);
    EXPECT_FALSE(live.map.has_map());
    live.solve_first();
    const Outcome run = parameterize(live.mesh, options);
    EXPECT_EQ(parameters(live.mesh, live.map), run.uv) << int(method);
    EXPECT_EQ(live.map.report().iterations, run.report.iterations);
    EXPECT_EQ(live.map.report().energy, run.report.energy);
    Uv_map uvmap = new_uv_map(live.mesh);
    live.map.get_uv(uvmap);
    EXPECT_EQ(test_support::parameters(live.mesh, uvmap), run.uv);
  }
}

// Any sequence of changes, each compared with a sparse direct solution.
TEST(Live_map, follows_every_change)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    Live live(hills(seed));
    live.solve_first();
    EXPECT_EQ(live.error(), "") << "seed " << seed;
    const std::size_t n = live.problem.mesh.points.size();
    for(int step = 0; step < 25; ++step) {
      std::string what;
      for(std::size_t changes = 1 + uniform_index(random, 3); changes > 0; --changes) {
        const auto& pins = live.problem.pins;
        const auto some = std::next(pins.begin(), long(uniform_index(random, pins.size())));
        switch(uniform_index(random, 6)) {
        case 0: case 1: {
          what += " new pin";
          const auto v = Vertex_index(uniform_index(random, n));
          live.pin(v, live.uv(v) + Complex(uniform(random, -0.02, 0.02), 0.));
          break;
        }
        case 2:
          what += " moved pin";
          live.pin(some->first, some->second + Complex(0., uniform(random, -0.05, 0.05)));
          break;
        case 3:
          if(pins.size() > 2) {
            what += " released pin";
            live.release(some->first);
          }
          break;
        case 4: {
          what += " positions";
          const double factor = uniform(random, 0.9, 1.1);
          for(std::size_t v = 0; v < n; ++v) {
            Point_3& p = live.problem.mesh.points[v];
            p = Point_3(factor * p.x(), p.y(), p.z());
            live.mesh.point(Vertex(Vertex_index(v))) = p;
          }
          EXPECT_EQ(live.map.update_positions(), SMP::OK);
          break;
        }
        default: {
          what += " weights";
          live.problem.weights.resize(live.problem.mesh.triangles.size());
          auto weights
            = live.mesh.add_property_map<Surface_mesh::Face_index, double>("f:weight", 1.).first;
          std::size_t t = 0;
          for(const auto f : faces(live.mesh))
            live.problem.weights[t++] = weights[f] = uniform(random, 0.5, 2.);
          EXPECT_EQ(live.map.set_face_weights(weights), SMP::OK);
        }
        }
      }
      EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
      EXPECT_EQ(live.error(), "") << "seed " << seed << ", step " << step << what;
    }
  }
}

TEST(Live_map, two_pins_move_it_by_a_similarity)
{
  Live live(hills());
  live.solve_first();
  const Parameters before = parameters(live.mesh, live.map);
  const auto first = live.problem.pins.begin()->first, second = live.problem.pins.rbegin()->first;
  const Complex a(0.3, -2.), b(5., 6.);
  live.pin(first, a * live.uv(first) + b);
  live.pin(second, a * live.uv(second) + b);
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(live.map.report().iterations, 0u);
  Parameters expected;
  for(const Complex& z : before)
    expected.push_back(a * z + b);
  EXPECT_LE(difference(parameters(live.mesh, live.map), expected), 1e-12);
  EXPECT_EQ(live.error(), "");
}

TEST(Live_map, a_dragged_pin_needs_no_iterations_after_the_first)
{
  Live live(hills(4));
  live.solve_first();
  const Vertex_index v = 1234, other = 2500;
  live.pin(v, live.uv(v));
  live.pin(other, live.uv(other));
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(live.map.report().iterations, 0u); // both are where they were
  std::size_t without = 0;
  for(int step = 0; step < 40; ++step) {
    live.pin(v, live.uv(v) + 0.002 * std::polar(1., 0.1 * step));
    EXPECT_EQ(live.map.solve(), SMP::OK);
    EXPECT_EQ(live.error(), "") << step;
    without += live.map.report().iterations == 0 ? 1 : 0;
  }
  EXPECT_GE(without, 30u);
}

TEST(Live_map, without_pins_is_the_spectral_one)
{
  Live live(hills(5));
  live.solve_first();
  const auto pins = live.problem.pins;
  for(const auto& pin : pins)
    live.release(pin.first);
  EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
  EXPECT_EQ(live.map.report().method, "spectral");
  SMP::Spectral_conformal_parameterizer_3<Surface_mesh> parameterizer(with_many_levels(1e-6));
  Uv_map uvmap = new_uv_map(live.mesh);
  ASSERT_EQ(parameterizer.parameterize(live.mesh, border_halfedge(live.mesh), uvmap), SMP::OK);
  const double least = parameterizer.report().energy;
  EXPECT_LE(live.map.report().energy, (1. + 1.2e-3) * least);
  // With one pin it is the same, moved.
  const Parameters before = parameters(live.mesh, live.map);
  live.pin(77, Complex(3., 4.));
  EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
  EXPECT_LE(std::abs(live.uv(77) - Complex(3., 4.)), 1e-12);
  Parameters expected;
  for(const Complex& z : before)
    expected.push_back(z - before[77] + Complex(3., 4.));
  EXPECT_LE(difference(parameters(live.mesh, live.map), expected), 1e-12);
  // And back
  for(const auto& [v, z] : pins)
    live.pin(v, z);
  live.release(77);
  EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
  EXPECT_EQ(live.error(), "");
}

TEST(Live_map, without_pins_a_plane_stays_as_it_is)
{
  for(const std::size_t coarsest_size : {300, 100000}) {
    HLSCM_options options = with_many_levels();
    options.coarsest_size = coarsest_size;
    Live live(irregular_grid(40, 30, 3), options);
    live.solve_first();
    const auto pins = live.problem.pins;
    for(const auto& pin : pins)
      live.release(pin.first);
    EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
    const auto measures = measure(live.mesh, parameters(live.mesh, live.map));
    EXPECT_NEAR(measures.quasi_conformal_max, 1., 1e-3);
    EXPECT_NEAR(measures.area_scale_range, 1., 1e-2);
  }
}

TEST(Live_map, preview_is_near_what_will_come)
{
  Live live(hills(6));
  const auto check = [&](const char* when, double distance) {
    const SMP::Level_view view = live.map.preview(1000);
    const std::vector<std::uint32_t> source = *view.vertices;
    const Parameters preview = *view.uv;
    ASSERT_EQ(source.size(), preview.size());
    EXPECT_LE(source.size(), 1000u);
    for(const auto& t : *view.faces)
      for(const auto v : t)
        ASSERT_LT(v, source.size());
    EXPECT_EQ(live.map.solve(), SMP::OK);
    Parameters expected;
    for(const auto v : source)
      expected.push_back(live.uv(v));
    EXPECT_LE(difference(preview, expected), distance) << when;
  };
  check("from nothing", 0.3);
  for(const auto& pin : live.map.report().pins)
    live.problem.pins[Vertex_index(pin.vertex)] = {pin.u, pin.v};
  const Vertex_index v = 1500;
  live.pin(v, live.uv(v));
  live.pin(2100, live.uv(2100));
  EXPECT_EQ(live.map.solve(), SMP::OK);
  live.pin(v, live.uv(v) + Complex(0.02, 0.01));
  check("after a move", 0.03);
  EXPECT_EQ(live.error(), "");
}

TEST(Live_map, small_meshes_are_solved_exactly)
{
  HLSCM_options options = with_many_levels();
  options.coarsest_size = 100000;
  Live live(with_hills(irregular_grid(20, 15, 7), 3., 8), options);
  live.options.tolerance = 1e-10;
  live.solve_first();
  live.pin(50, live.uv(50) + Complex(0.1, 0.));
  live.pin(120, live.uv(120));
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(live.error(), "");
  live.release(50);
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(live.error(), "");
}

// What is wrong is said, and the map stays usable.
TEST(Live_map, bad_changes_are_refused)
{
  Indexed_triangle_mesh arrays = hills(7);
  Live live(arrays);
  live.solve_first();
  const Parameters before = parameters(live.mesh, live.map);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(live.map.set_pin(Vertex(5), {nan, 0.}), SMP::ERROR_WRONG_PARAMETER);
  EXPECT_EQ(live.map.release_pin(Vertex(1000)), SMP::ERROR_WRONG_PARAMETER);
  EXPECT_NE(live.map.report().message, "");
  const Point_3 old = live.mesh.point(Vertex(9));
  live.mesh.point(Vertex(9)) = Point_3(nan, 0., 0.);
  EXPECT_EQ(live.map.update_positions(), SMP::ERROR_WRONG_PARAMETER);
  EXPECT_NE(live.map.report().message.find("vertex 9"), std::string::npos);
  live.mesh.point(Vertex(9)) = old;
  auto weights = live.mesh.add_property_map<Surface_mesh::Face_index, double>("f:weight", 1.).first;
  weights[Surface_mesh::Face_index(17)] = 0.;
  EXPECT_EQ(live.map.set_face_weights(weights), SMP::ERROR_WRONG_PARAMETER);
  EXPECT_NE(live.map.report().message.find("face 17"), std::string::npos);
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(parameters(live.mesh, live.map), before);
  // All pins in one point
  for(const auto& pin : live.problem.pins)
    EXPECT_EQ(live.map.set_pin(Vertex(pin.first), {1., 1.}), SMP::OK);
  EXPECT_EQ(live.map.solve(), SMP::ERROR_WRONG_PARAMETER);
  EXPECT_EQ(parameters(live.mesh, live.map), before);
  for(const auto& [v, z] : live.problem.pins)
    live.pin(v, z);
  EXPECT_EQ(live.map.solve(), SMP::OK);
  EXPECT_EQ(live.error(), "");
}

TEST(Live_map, says_what_is_wrong_with_the_mesh)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  HLSCM_options options;
  options.method = Conformal_method::DIRECT;
  Live_map direct(mesh, border_halfedge(mesh), options);
  EXPECT_EQ(direct.error(), SMP::ERROR_WRONG_PARAMETER);
  mesh.point(Vertex(3)) = Point_3(std::numeric_limits<double>::infinity(), 0., 0.);
  Live_map broken(mesh, border_halfedge(mesh));
  EXPECT_NE(broken.error(), SMP::OK);
  EXPECT_NE(broken.report().message.find("vertex 3"), std::string::npos);
  EXPECT_EQ(broken.solve(), broken.error());
  EXPECT_EQ(broken.preview().uv, nullptr);
  EXPECT_FALSE(broken.has_map());
}

TEST(Live_map, can_be_cancelled_and_goes_on)
{
  int calls = 0, last = 0;
  HLSCM_options options = with_many_levels(1e-8);
  options.progress = [&](double) { return ++calls != last; };
  Live live(hills(8), options);
  live.options.tolerance = 1e-8;
  calls = 0;
  last = 5;
  EXPECT_NE(live.map.solve(), SMP::OK);
  EXPECT_TRUE(live.map.report().cancelled);
  EXPECT_FALSE(live.map.has_map());
  last = 0;
  live.solve_first();
  EXPECT_EQ(live.error(), "");
  live.pin(900, live.uv(900) + 0.1);
  calls = 0;
  last = 3;
  EXPECT_NE(live.map.solve(), SMP::OK);
  last = 0;
  EXPECT_EQ(live.map.solve(), SMP::OK) << live.map.report().message;
  EXPECT_EQ(live.error(), "");
}

} // namespace live_map_test
