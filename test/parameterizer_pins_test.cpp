// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pins, border parameterizers and solver traits of the parameterizer.

#include <support/conformal_maps.h>
#include <support/method_runs.h>

#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>

#include <CGAL/Eigen_solver_traits.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace parameterizer_pins_test {

using namespace test_support;
using namespace method_runs;
typedef Surface_mesh::Property_map<Vertex, bool> Flag_map;

// --- Pins

TEST(Pins, keep_their_values_exactly)
{
  Random random(1);
  Surface_mesh mesh = to_surface_mesh(hills());
  for(std::size_t number : {2, 3, 20, 400}) {
    Pins pins;
    for(const auto v : random_permutation(mesh.number_of_vertices(), random))
      if(pins.size() < number)
        pins.push_back({v, {uniform(random, -1., 1.) / 3., uniform(random, -1., 1.) / 3.}});
    for(const auto method : all_methods) {
      const Outcome run = parameterize(mesh, with_many_levels(method), pins);
      ASSERT_EQ(run.error, SMP::OK) << run.report.message;
      for(const auto& [v, z] : pins)
        EXPECT_EQ(run.uv[v], z) << run.report.method << " " << number;
      ASSERT_EQ(run.report.pins.size(), number);
    }
  }
}

TEST(Pins, many_give_the_minimum_too)
{
  Random random(2);
  Surface_mesh mesh = to_surface_mesh(hills());
  for(std::size_t number : {3, 20, 400}) {
    Pins pins;
    for(const auto v : random_permutation(mesh.number_of_vertices(), random))
      if(pins.size() < number) {
        const auto& p = mesh.point(Vertex(v));
        pins.push_back({v, {p.x() + uniform(random, -1., 1.), p.y() + uniform(random, -1., 1.)}});
      }
    for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      HLSCM_options options = with_many_levels();
      options.weights = weights;
      const auto c = compare_with_direct(mesh, options, pins);
      EXPECT_EQ(c.hierarchical.error, SMP::OK) << c.hierarchical.report.message;
      EXPECT_LE(c.gap(), 1e-4) << row_of(std::to_string(number), c, 1e-4);
      EXPECT_GE(c.gap(), -1e-9);
    }
  }
}

// Two far vertices of the longest border at (0, 0) and (1, 0)
TEST(Pins, are_far_on_the_border_by_default)
{
  const auto arrays = hills();
  Surface_mesh mesh = to_surface_mesh(arrays);
  const Outcome run = parameterize(mesh, HLSCM_options());
  ASSERT_EQ(run.report.pins.size(), 2u);
  EXPECT_EQ(run.uv[run.report.pins[0].vertex], Complex(0., 0.));
  EXPECT_EQ(run.uv[run.report.pins[1].vertex], Complex(1., 0.));
  const std::vector<bool> is_border = border_vertices_of(arrays);
  double farthest = 0.;
  for(const auto& p : arrays.points)
    for(const auto& pin : run.report.pins) {
      EXPECT_TRUE(is_border[pin.vertex]);
      farthest = (std::max)(farthest, CGAL::squared_distance(p, arrays.points[pin.vertex]));
    }
  EXPECT_GE(CGAL::squared_distance(arrays.points[run.report.pins[0].vertex],
                                   arrays.points[run.report.pins[1].vertex]), 0.5 * farthest);
  EXPECT_TRUE(run.report.warnings.empty());
}

TEST(Pins, next_to_each_other_are_allowed_and_warned_of)
{
  const auto arrays = hills();
  Surface_mesh mesh = to_surface_mesh(arrays);
  const auto [a, b, c] = arrays.triangles[100];
  const Outcome run = parameterize(mesh, HLSCM_options(), {{a, 0.}, {c, 1.}});
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  ASSERT_EQ(run.report.warnings.size(), 1u);
  EXPECT_EQ(run.report.warnings[0], "the pins vertex " + std::to_string(a) + " and vertex "
            + std::to_string(c) + " are neighbours; the map will be large far from them");
  const Outcome three
    = parameterize(mesh, HLSCM_options(), {{a, 0.}, {c, 1.}, {b, Complex(0., 1.)}});
  EXPECT_TRUE(three.report.warnings.empty());
}

// Runs a parameterizer of any kind with all of its maps.
template <class Any_parameterizer>
Outcome run_with_maps(Any_parameterizer parameterizer, Surface_mesh& mesh, Flag_map& vpmap)
{
  Uv_map uvmap = new_uv_map(mesh);
  const auto vimap = mesh.add_property_map<Vertex, int>("", -1).first;
  int index = 0;
  for(const Vertex v : vertices(mesh))
    put(vimap, v, index++);
  vpmap = mesh.add_property_map<Vertex, bool>("", false).first;
  Outcome run;
  run.error = parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap, vimap, vpmap);
  run.report = parameterizer.report();
  run.uv = parameters(mesh, uvmap);
  return run;
}

TEST(Pins, and_nothing_else_are_marked_as_parameterized)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  Flag_map vpmap;
  const Outcome run = run_with_maps(Parameterizer(HLSCM_options()), mesh, vpmap);
  std::set<std::size_t> marked;
  for(const Vertex v : vertices(mesh))
    if(get(vpmap, v))
      marked.insert(v);
  EXPECT_EQ(marked, (std::set<std::size_t>{run.report.pins[0].vertex, run.report.pins[1].vertex}));
}

// --- Border parameterizers of CGAL

// What a border parameterizer pins by itself.
template <class BorderParameterizer>
Pins pins_of(Surface_mesh& mesh)
{
  struct Reporting : BorderParameterizer
  {
    HLSCM_report report() const { return HLSCM_report(); }
  };
  Flag_map vpmap;
  const Outcome border = run_with_maps(Reporting(), mesh, vpmap);
  EXPECT_EQ(border.error, SMP::OK);
  Pins pins;
  for(const Vertex v : vertices(mesh))
    if(get(vpmap, v))
      pins.push_back({v, border.uv[v]});
  return pins;
}

template <class BorderParameterizer>
void expect_border_parameterizer_works(std::size_t fewest_pins)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(irregular_grid(60, 40, 1), 10., 3));
  const Pins pins = pins_of<BorderParameterizer>(mesh);
  EXPECT_GE(pins.size(), fewest_pins);
  typedef SMP::HLSCM_parameterizer_3<Surface_mesh, BorderParameterizer> Parameterizer;
  Flag_map vpmap;
  const Outcome run = run_with_maps(Parameterizer(with_many_levels()), mesh, vpmap);
  ASSERT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_EQ(run.report.pins.size(), pins.size());
  for(const auto& [v, z] : pins)
    EXPECT_EQ(run.uv[v], z);
  const Outcome direct = parameterize(mesh, with_method(Conformal_method::DIRECT), pins);
  const double energy = energy_of(mesh, run.uv, Conformal_weights::EXACT);
  EXPECT_LE(energy - energy_of(mesh, direct.uv, Conformal_weights::EXACT), 1e-4 * energy);
}

TEST(Border_parameterizers, two_vertices)
{
  expect_border_parameterizer_works<SMP::Two_vertices_parameterizer_3<Surface_mesh>>(2);
}

TEST(Border_parameterizers, circle)
{
  expect_border_parameterizer_works<
    SMP::Circular_border_arc_length_parameterizer_3<Surface_mesh>>(200);
}

TEST(Border_parameterizers, square)
{
  expect_border_parameterizer_works<SMP::Square_border_uniform_parameterizer_3<Surface_mesh>>(200);
}

// --- Solver traits

TEST(Solver_traits, of_cgal_solve_the_coarsest_level)
{
  typedef CGAL::Eigen_solver_traits<
    Eigen::SimplicialLDLT<CGAL::Eigen_sparse_matrix<double>::EigenType>> Solver_traits;
  typedef SMP::HLSCM_parameterizer_3<Surface_mesh, CGAL::Default, Solver_traits> Other;
  Surface_mesh mesh = to_surface_mesh(hills());
  for(const std::size_t size : {300, 100000}) {
    HLSCM_options options = with_many_levels(Conformal_method::HLSCM, 1e-8);
    options.coarsest_size = size;
    Flag_map vpmap;
    const Outcome run = run_with_maps(Other(options), mesh, vpmap);
    ASSERT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_LE(difference(run.uv, parameterize(mesh, options).uv), 1e-5);
  }
}

} // namespace parameterizer_pins_test
