// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parameterizer computes: planar meshes come out exact, the hierarchical method reaches
// the energy of the sparse direct one, and CGAL's own parameterizer agrees.

#include <support/conformal_maps.h>
#include <support/mesh_properties.h>
#include <support/parameterizer_options.h>

#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace parameterizer_test {

using namespace test_support;
using namespace parameterizer_options;
using CGAL::Multigrid::Acceleration;
using CGAL::Multigrid::Schedule;
using SMP::Monogrid_preconditioner;
using SMP::Prolongation_rule;

const std::vector<std::uint64_t> seeds = {1, 2, 3};

// --- The charts themselves

TEST(Charts, are_what_they_should_be)
{
  for(const std::uint64_t seed : seeds)
    for(const auto& group : {planar_charts(seed), curved_charts(seed), large_charts(seed)})
      for(const auto& [name, mesh] : group) {
        const Topology topology = topology_of(mesh.triangles);
        EXPECT_EQ(topology.defect, "") << name;
        EXPECT_EQ(topology.components, 1u) << name;
        EXPECT_GE(topology.border_loops, 1u) << name;
        EXPECT_EQ(topology.euler_characteristic(), 2 - (long long)(topology.border_loops)) << name;
      }
}

// --- Planar meshes

// A similarity, and two pins that tell it.
struct Similarity
{
  Parameters expected;
  Pins pins;

  Similarity(const Indexed_triangle_mesh& mesh, Random& random)
  {
    const Complex a = std::polar(uniform(random, 0.1, 10.), uniform(random, 0., 2. * CGAL_PI));
    const Complex b(uniform(random, -5., 5.), uniform(random, -5., 5.));
    for(const Point_3& p : mesh.points)
      expected.push_back(a * Complex(p.x(), p.y()) + b);
    // A random vertex and the one farthest from it
    const std::size_t first = uniform_index(random, mesh.points.size());
    std::size_t second = first;
    for(std::size_t v = 0; v < expected.size(); ++v)
      if(std::abs(expected[v] - expected[first]) > std::abs(expected[second] - expected[first]))
        second = v;
    pins = {{first, expected[first]}, {second, expected[second]}};
  }
};

std::vector<HLSCM_options> all_exact_methods()
{
  std::vector<HLSCM_options> result;
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::LSCM,
                           Conformal_method::DIRECT})
    for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      result.push_back(with_method(method));
      result.back().weights = weights;
      result.back().coarsest_size = 300;
    }
  return result;
}

TEST(Planar_meshes, come_out_exact_up_to_similarity)
{
  Random random(1);
  for(const auto& [name, mesh] : planar_charts(1)) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    for(const HLSCM_options& options : all_exact_methods()) {
      const Similarity similarity(mesh, random);
      const Outcome run = parameterize(surface_mesh, options, similarity.pins);
      ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
      EXPECT_LE(difference(run.uv, similarity.expected), 1e-6)
        << name << " " << run.report.method;
      EXPECT_TRUE(run.report.converged) << name << " " << run.report.method;
    }
  }
}

// The cascade takes a fixed number of steps and does not reach the minimum, but comes near.
TEST(Planar_meshes, come_out_nearly_exact_by_the_cascade)
{
  Random random(2);
  for(const auto& [name, mesh] : planar_charts(1)) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    HLSCM_options options = with_method(Conformal_method::CASCADIC);
    options.coarsest_size = 300;
    const Similarity similarity(mesh, random);
    const Outcome run = parameterize(surface_mesh, options, similarity.pins);
    ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
    EXPECT_LE(difference(run.uv, similarity.expected), 0.02) << name;
  }
}

TEST(Planar_meshes, come_out_exact_from_random_pins)
{
  Random random(3);
  const auto mesh = irregular_grid(60, 40, 1);
  Surface_mesh surface_mesh = to_surface_mesh(mesh);
  for(std::size_t number : {2, 3, 10, 500}) {
    const Similarity similarity(mesh, random);
    Pins pins;
    for(const auto v : random_permutation(mesh.points.size(), random))
      if(pins.size() < number)
        pins.push_back({v, similarity.expected[v]});
    for(const auto method : {Conformal_method::HLSCM, Conformal_method::DIRECT}) {
      HLSCM_options options = with_many_levels(1e-8);
      options.method = method;
      const Outcome run = parameterize(surface_mesh, options, pins);
      ASSERT_EQ(run.error, SMP::OK) << run.report.message;
      EXPECT_LE(difference(run.uv, similarity.expected), 1e-6) << number;
    }
  }
}

// --- Against the direct method

TEST(Hierarchical_method, reaches_the_energy_of_the_direct_one)
{
  for(const std::uint64_t seed : seeds)
    for(const auto& [name, mesh] : curved_charts(seed)) {
      Surface_mesh surface_mesh = to_surface_mesh(mesh);
      const auto c = compare_with_direct(surface_mesh, with_method(Conformal_method::HLSCM, 1e-4));
      EXPECT_EQ(error_in_comparison(c, 1e-4), "") << row_of(name, c, 1e-4) << " seed " << seed;
    }
}

TEST(Hierarchical_method, reaches_it_on_large_charts)
{
  for(const auto& [name, mesh] : large_charts(1)) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Comparison direct = direct_half(surface_mesh, Conformal_weights::EXACT);
    for(const double tolerance : {1e-2, 1e-4}) {
      const auto c = compare(surface_mesh, with_method(Conformal_method::HLSCM, tolerance), direct);
      EXPECT_EQ(error_in_comparison(c, tolerance), "") << row_of(name, c, tolerance);
      EXPECT_GE(c.hierarchical.report.levels.size(), 3u);
    }
  }
}

// Charts on which every option should work
std::vector<Named_mesh> ordinary_charts()
{
  std::vector<Named_mesh> result;
  for(const Named_mesh& m : curved_charts(4))
    for(const char* name : {"hills", "hills with holes", "jagged hills", "dome"})
      if(m.name == name && !(is_sanitized && result.size() == 2))
        result.push_back(m);
  return result;
}

// Runs the ordinary charts with each of the options.
template <class Options, class Describe>
void expect_agreement(const std::vector<Options>& all_options, const Describe& describe)
{
  for(const auto& [name, mesh] : ordinary_charts()) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    std::map<Conformal_weights, Comparison> direct;
    for(const HLSCM_options& options : all_options) {
      if(direct.count(options.weights) == 0)
        direct[options.weights] = direct_half(surface_mesh, options.weights);
      const auto c = compare(surface_mesh, options, direct[options.weights]);
      EXPECT_EQ(error_in_comparison(c, options.tolerance), "")
        << describe(options) << " on " << row_of(name, c, options.tolerance);
    }
  }
}

TEST(Hierarchical_method, works_with_every_engine_and_prolongation_and_both_weights)
{
  std::vector<HLSCM_options> all_options;
  for(const auto engine : all_engines)
    for(const auto rule : {Prolongation_rule::WALK, Prolongation_rule::VSPLIT})
      for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
        all_options.push_back(with_many_levels());
        set_engine(engine, all_options.back());
        all_options.back().prolongation = rule;
        all_options.back().weights = weights;
      }
  expect_agreement(all_options, [](const HLSCM_options& o) {
    return "engine " + std::to_string(int(o.engine)) + (o.decimate ? " of CGAL rule " : " rule ")
         + std::to_string(int(o.prolongation)) + " weights " + std::to_string(int(o.weights));
  });
}

TEST(Hierarchical_method, works_with_every_schedule)
{
  std::vector<HLSCM_options> all_options;
  for(const Schedule& schedule :
      {Schedule::v_cycle(1, 1), Schedule::v_cycle(3, 3), Schedule::w_cycle(2, 2),
       Schedule::k_cycle(1, 1), Schedule::k_cycle(2, 2), Schedule::k_cycle(1, 2),
       Schedule{2, 2, 3, Acceleration::KRYLOV}, Schedule{2, 2, 1, Acceleration::KRYLOV}}) {
    all_options.push_back(with_many_levels());
    all_options.back().schedule = schedule;
  }
  expect_agreement(all_options, [](const HLSCM_options& o) {
    return "schedule " + std::to_string(o.schedule->pre_smoothing) + " "
         + std::to_string(o.schedule->post_smoothing) + " "
         + std::to_string(o.schedule->coarse_visits) + " "
         + std::to_string(int(o.schedule->acceleration));
  });
}

// The gap is an estimate, made after three steps and more: it must not be too hopeful where a cycle
// is a poor preconditioner.
TEST(Hierarchical_method, meets_the_tolerance_with_every_schedule)
{
  const Schedule schedules[] = {Schedule::v_cycle(0, 2), Schedule::v_cycle(1, 1),
                                Schedule::v_cycle(2, 2), Schedule::v_cycle(4, 4),
                                Schedule::w_cycle(1, 1), Schedule::w_cycle(2, 2),
                                Schedule::k_cycle(0, 2), Schedule::k_cycle(1, 1), Schedule()};
  for(const std::uint64_t seed : {1, 2})
    for(const auto& [name, mesh] : curved_charts(seed)) {
      if(is_sanitized && seed == 2)
        continue;
      // Where some of them converge fast at first, and slowly then. (With slivers a V-cycle that does
      // not smooth before it stands still for hundreds of steps: no estimate sees through that.)
      const std::string title = name;
      if(title.find("hills") == std::string::npos || title.find("sliver") != std::string::npos)
        continue;
      Surface_mesh surface_mesh = to_surface_mesh(mesh);
      const double least
        = parameterize(surface_mesh, with_method(Conformal_method::DIRECT)).report.energy;
      for(const double tolerance : {1e-2, 1e-3})
        for(std::size_t s = 0; s < std::size(schedules); ++s) {
          HLSCM_options options = with_many_levels(tolerance);
          options.schedule = schedules[s];
          const auto run = parameterize(surface_mesh, options);
          ASSERT_EQ(run.error, SMP::OK) << run.report.message;
          EXPECT_LE(run.report.energy - least, tolerance * run.report.energy)
            << name << " " << seed << ", schedule " << s << ", " << run.report.iterations << " steps";
        }
    }
}

TEST(Hierarchical_method, works_with_every_ratio_and_coarsest_size)
{
  std::vector<HLSCM_options> all_options;
  for(const double ratio : {1.5, 2., 4., 10., 100.})
    for(const std::size_t size : {200, 1000, 100000}) {
      all_options.push_back(with_many_levels());
      all_options.back().level_ratio = ratio;
      all_options.back().coarsest_size = size;
    }
  expect_agreement(all_options, [](const HLSCM_options& o) {
    return "ratio " + std::to_string(o.level_ratio) + " size " + std::to_string(o.coarsest_size);
  });
}

// A mesh smaller than the coarsest level may be is solved directly, at once.
TEST(Hierarchical_method, needs_no_levels_for_small_charts)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(irregular_grid(20, 20, 1), 5., 2));
  const auto c = compare_with_direct(mesh, HLSCM_options());
  EXPECT_EQ(c.hierarchical.report.levels.size(), 1u);
  EXPECT_EQ(c.hierarchical.report.iterations, 0u);
  EXPECT_LE(difference(c.hierarchical.uv, c.direct.uv), 1e-10);
}

// The result of a low tolerance is that of a high one, carried on.
TEST(Hierarchical_method, comes_nearer_with_lower_tolerances)
{
  for(const auto& [name, mesh] : ordinary_charts()) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    double last_gap = std::numeric_limits<double>::infinity();
    std::size_t last_iterations = 0;
    const Comparison direct = direct_half(surface_mesh, Conformal_weights::EXACT);
    for(const double tolerance : {1e-1, 1e-3, 1e-5, 1e-7}) {
      const auto c = compare(surface_mesh, with_many_levels(tolerance), direct);
      EXPECT_LE(c.gap(), last_gap * (1. + 1e-6)) << name << " " << tolerance;
      EXPECT_GE(c.hierarchical.report.iterations, last_iterations) << name << " " << tolerance;
      if(tolerance <= 1e-3) { // two or three steps are too few for an estimate
        EXPECT_LE(c.gap(), tolerance) << name;
      }
      last_gap = c.gap();
      last_iterations = c.hierarchical.report.iterations;
    }
    EXPECT_LE(last_gap, 1e-7) << name;
  }
}

// --- The other methods

TEST(Monogrid_method, reaches_the_energy_of_the_direct_one)
{
  for(const auto preconditioner : {Monogrid_preconditioner::JACOBI,
                                   Monogrid_preconditioner::SYMMETRIC_GAUSS_SEIDEL})
    for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM})
      for(const auto& [name, mesh] : ordinary_charts()) {
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        HLSCM_options options = with_method(Conformal_method::LSCM, 1e-4);
        options.preconditioner = preconditioner;
        options.weights = weights;
        const auto c = compare_with_direct(surface_mesh, options);
        EXPECT_EQ(c.hierarchical.report.method, "lscm");
        EXPECT_EQ(error_in_comparison(c, 1e-4), "") << row_of(name, c, 1e-4);
      }
}

TEST(Cascade, comes_near_in_a_fixed_number_of_steps)
{
  for(const auto engine : {Engine::FLAT, Engine::CGAL})
    for(const auto& [name, mesh] : ordinary_charts()) {
      Surface_mesh surface_mesh = to_surface_mesh(mesh);
      HLSCM_options options = with_many_levels();
      options.method = Conformal_method::CASCADIC;
      set_engine(engine, options);
      const auto c = compare_with_direct(surface_mesh, options);
      const SMP::HLSCM_report& report = c.hierarchical.report;
      EXPECT_EQ(c.hierarchical.error, SMP::OK) << report.message;
      EXPECT_EQ(report.method, "cascadic");
      EXPECT_FALSE(report.converged); // to no tolerance that it knows of
      EXPECT_EQ(report.iterations, 10u);
      EXPECT_GE(c.gap(), -1e-9) << name;
      EXPECT_LE(difference(c.hierarchical.uv, c.direct.uv), 0.1) << name;
      EXPECT_LE(measure(surface_mesh, c.hierarchical.uv).quasi_conformal_mean,
                1.1 * measure(surface_mesh, c.direct.uv).quasi_conformal_mean) << name;
    }
}

TEST(Cascade, takes_the_steps_of_its_schedule)
{
  Surface_mesh mesh = to_surface_mesh(ordinary_charts()[0].mesh);
  double last = std::numeric_limits<double>::infinity();
  for(const unsigned int steps : {1u, 5u, 25u}) {
    HLSCM_options options = with_many_levels();
    options.method = Conformal_method::CASCADIC;
    options.schedule = Schedule::cascade(steps);
    const auto c = compare_with_direct(mesh, options);
    EXPECT_EQ(c.hierarchical.report.iterations, steps);
    EXPECT_LT(c.hierarchical_energy, last);
    last = c.hierarchical_energy;
  }
}

// --- CGAL's own parameterizer

// Pins the given vertices: a border parameterizer for LSCM_parameterizer_3.
struct Given_pins
{
  typedef Surface_mesh TriangleMesh;
  typedef Surface_mesh Triangle_mesh;

  Pins pins;

  template <class Uv, class Index, class Parameterized>
  SMP::Error_code parameterize(const Surface_mesh&, Surface_mesh::Halfedge_index, Uv uvmap, Index,
                               Parameterized vpmap)
  {
    for(const auto& [position, z] : pins) {
      const Surface_mesh::Vertex_index v{Vertex_index(position)};
      put(uvmap, v, Point_2(z.real(), z.imag()));
      put(vpmap, v, true);
    }
    return SMP::OK;
  }

  template <class Uv, class Index, class Parameterized>
  SMP::Error_code parameterize(const Surface_mesh& mesh,
                               const std::vector<Surface_mesh::Vertex_index>&,
                               Surface_mesh::Halfedge_index bhd, Uv uvmap, Index vimap,
                               Parameterized vpmap)
  {
    return parameterize(mesh, bhd, uvmap, vimap, vpmap);
  }

  bool is_border_convex() const { return false; }
};

Parameters parameterize_by_cgal(Surface_mesh& mesh, const Pins& pins)
{
  Given_pins border_parameterizer;
  border_parameterizer.pins = pins;
  SMP::LSCM_parameterizer_3<Surface_mesh, Given_pins> parameterizer(border_parameterizer);
  Uv_map uvmap = new_uv_map(mesh);
  auto vimap = get(CGAL::dynamic_vertex_property_t<int>(), mesh);
  int index = 0;
  for(const auto v : vertices(mesh))
    put(vimap, v, index++);
  const auto is_parameterized
    = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("", false).first;
  EXPECT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap, vimap, is_parameterized),
            SMP::OK);
  return parameters(mesh, uvmap);
}

TEST(Weights_of_cgal, give_the_map_of_LSCM_parameterizer_3)
{
  for(const auto& [name, mesh] : ordinary_charts()) {
    Surface_mesh surface_mesh = to_surface_mesh(scaled(mesh, 0.37)); // their energy has a unit
    const std::size_t last = surface_mesh.number_of_vertices() - 1;
    const Pins pins = {{0, Complex(0., 0.)}, {last, Complex(1., 2.)}};
    const Parameters expected = parameterize_by_cgal(surface_mesh, pins);
    for(const auto method : {Conformal_method::DIRECT, Conformal_method::HLSCM,
                             Conformal_method::LSCM}) {
      HLSCM_options options = with_many_levels(1e-14);
      options.method = method;
      options.weights = Conformal_weights::CGAL_LSCM;
      const Outcome run = parameterize(surface_mesh, options, pins);
      ASSERT_EQ(run.error, SMP::OK) << run.report.message;
      EXPECT_LE(difference(run.uv, expected), 1e-6) << name << " " << run.report.method;
    }
    // The exact energy has another minimiser.
    const Outcome exact = parameterize(surface_mesh, with_method(Conformal_method::DIRECT), pins);
    EXPECT_GE(difference(exact.uv, expected), 1e-4) << name;
  }
}

} // namespace parameterizer_test
