// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What goes into the parameterizer and what comes out beside the map: pins, border parameterizers,
// solver traits, the report, progress, observers, and what is wrong with bad input.

#include <support/conformal_maps.h>
#include <support/mesh_properties.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace parameterizer_interface_test {

using namespace test_support;
using SMP::Conformal_method;
using SMP::Conformal_weights;
using SMP::HLSCM_options;
using SMP::HLSCM_report;

typedef std::complex<double> Complex;
typedef Surface_mesh::Vertex_index Vertex;
typedef Surface_mesh::Property_map<Vertex, bool> Flag_map;

const std::vector<Conformal_method> all_methods
  = {Conformal_method::HLSCM, Conformal_method::CASCADIC, Conformal_method::LSCM,
     Conformal_method::DIRECT};

HLSCM_options with_many_levels(Conformal_method method = Conformal_method::HLSCM,
                               double tolerance = 1e-4)
{
  HLSCM_options options = with_method(method, tolerance);
  options.coarsest_size = 300;
  return options;
}

// Hills of 4800 faces, several borders
Indexed_triangle_mesh hills()
{
  return with_hills(with_holes(irregular_grid(60, 40, 1), 6, 2), 10., 3);
}

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

// --- The report

TEST(Report, says_what_was_done)
{
  const auto arrays = hills();
  Surface_mesh mesh = to_surface_mesh(arrays);
  const char* const names[] = {"hlscm", "spectral", "cascadic", "lscm", "direct"};
  for(const auto method : all_methods)
    for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      HLSCM_options options = with_many_levels(method);
      options.weights = weights;
      const Outcome run = parameterize(mesh, options);
      const HLSCM_report& report = run.report;
      EXPECT_EQ(run.error, SMP::OK);
      EXPECT_EQ(report.method, names[int(method)]);
      EXPECT_EQ(report.converged, method != Conformal_method::CASCADIC);
      EXPECT_FALSE(report.cancelled);
      EXPECT_EQ(report.message, "");
      EXPECT_EQ(report.vertices, arrays.points.size());
      EXPECT_EQ(report.faces, arrays.triangles.size());
      EXPECT_EQ(report.borders, topology_of(arrays.triangles).border_loops);
      EXPECT_EQ(report.mollified_faces, 0u);
      const double energy = energy_of(mesh, run.uv, weights);
      EXPECT_NEAR(report.energy, energy, 1e-8 * energy) << report.method;
      EXPECT_GE(report.energy_gap_estimate, 0.);
      const bool is_hierarchical
        = method == Conformal_method::HLSCM || method == Conformal_method::CASCADIC;
      EXPECT_EQ(report.levels.size() > 1, is_hierarchical);
      EXPECT_EQ(report.levels.back().vertices, report.vertices);
      EXPECT_EQ(report.levels.back().faces, report.faces);
      EXPECT_EQ(report.iterations == 0, method == Conformal_method::DIRECT);
      if(is_hierarchical) {
        EXPECT_EQ(report.levels.back().iterations, report.iterations);
        EXPECT_EQ(report.levels.front().iterations, 0u);
        EXPECT_LE(report.levels.front().vertices, 600u);
      }
      for(std::size_t l = 1; l < report.levels.size(); ++l)
        EXPECT_LT(report.levels[l - 1].vertices, report.levels[l].vertices);
      EXPECT_NEAR(report.seconds_total, report.seconds_hierarchy + report.seconds_operators
                                          + report.seconds_solve, 1e-12);
    }
}

TEST(Report, belongs_to_copies_too)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  Uv_map uvmap = new_uv_map(mesh);
  Parameterizer original;
  Parameterizer copy = original;
  EXPECT_EQ(copy.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK);
  EXPECT_EQ(original.report().vertices, mesh.number_of_vertices());
}

TEST(Report, is_that_of_the_last_run)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  Uv_map uvmap = new_uv_map(mesh);
  Parameterizer parameterizer;
  parameterizer.options().tolerance = -1.;
  EXPECT_NE(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK);
  parameterizer.options().tolerance = 1e-2;
  EXPECT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK);
  EXPECT_EQ(parameterizer.report().message, "");
  EXPECT_EQ(parameterizer.report().pins.size(), 2u);
}

// --- Progress and observers

TEST(Progress, ascends_from_0_to_1)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  for(const auto method : all_methods)
    for(const std::size_t coarsest_size : {300, 100000}) {
      HLSCM_options options = with_many_levels(method);
      options.coarsest_size = coarsest_size;
      std::vector<double> parts;
      options.progress = [&](double part) {
        parts.push_back(part);
        return true;
      };
      EXPECT_EQ(parameterize(mesh, options).error, SMP::OK);
      ASSERT_FALSE(parts.empty()) << int(method);
      EXPECT_GE(parts.front(), 0.);
      EXPECT_EQ(parts.back(), 1.);
      for(std::size_t i = 1; i < parts.size(); ++i)
        EXPECT_LE(parts[i - 1], parts[i]) << int(method) << " call " << i;
    }
}

TEST(Progress, cancels_at_every_stage)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  for(const auto method : all_methods) {
    std::size_t calls = 0;
    HLSCM_options options = with_many_levels(method);
    options.progress = [&](double) {
      ++calls;
      return true;
    };
    parameterize(mesh, options);
    const std::size_t all_calls = calls, stride = all_calls / 25 + 1;
    for(std::size_t last = 1; last <= all_calls; last += stride) {
      calls = 0;
      options.progress = [&](double) { return ++calls < last; };
      const Outcome run = parameterize(mesh, options);
      EXPECT_EQ(run.error, SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM)
        << int(method) << " call " << last;
      EXPECT_TRUE(run.report.cancelled);
      EXPECT_FALSE(run.report.converged) << int(method) << " call " << last;
      EXPECT_EQ(run.report.message, "cancelled");
      EXPECT_EQ(calls, last); // it is not asked again
      for(const Complex& z : run.uv)
        ASSERT_EQ(z, Complex(untouched, untouched));
    }
  }
}

TEST(Level_observer, sees_every_level)
{
  const auto arrays = hills();
  Surface_mesh mesh = to_surface_mesh(arrays);
  const Topology topology = topology_of(arrays.triangles);
  const std::size_t last_vertex = arrays.points.size() - 1;
  const Pins pins = {{7, Complex(1. / 3., 0.1)}, {last_vertex, Complex(2., 1. / 7.)}};
  for(const auto method : all_methods) {
    HLSCM_options options = with_many_levels(method);
    std::size_t next = 0, number = 0;
    Parameters last;
    const auto check = [&](const SMP::Level_view& view) {
      EXPECT_EQ(view.level, next++);
      number = view.number_of_levels;
      const auto& source = *view.vertices;
      ASSERT_EQ(source.size(), view.uv->size());
      EXPECT_EQ(std::set<std::uint32_t>(source.begin(), source.end()).size(), source.size());
      const Topology level = topology_of(*view.faces);
      EXPECT_EQ(level.defect, "");
      EXPECT_EQ(level.vertices, source.size());
      EXPECT_EQ(level.euler_characteristic(), topology.euler_characteristic());
      EXPECT_EQ(level.border_loops, topology.border_loops);
      for(const auto& [v, z] : pins) {
        const auto it = std::find(source.begin(), source.end(), v);
        ASSERT_NE(it, source.end());
        EXPECT_EQ((*view.uv)[it - source.begin()], z);
      }
      last.assign(arrays.points.size(), untouched);
      for(std::size_t i = 0; i < source.size(); ++i)
        last[source[i]] = (*view.uv)[i];
      if(view.level + 1 != view.number_of_levels)
        return;
      std::vector<Triangle_indices> faces;
      for(const auto& t : *view.faces)
        faces.push_back({source[t[0]], source[t[1]], source[t[2]]});
      EXPECT_EQ(sorted_triangles(faces), sorted_triangles(arrays.triangles));
    };
    options.level_observer = [&check](const SMP::Level_view& view) {
      check(view);
      return true;
    };
    const Outcome run = parameterize(mesh, options, pins);
    EXPECT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_EQ(next, run.report.levels.size()) << run.report.method;
    EXPECT_EQ(number, next) << run.report.method;
    EXPECT_EQ(last, run.uv) << run.report.method;
  }
}

// --- Ending early

TEST(Ending_early, observer_takes_the_map_that_there_is)
{
  const auto arrays = hills();
  Surface_mesh mesh = to_surface_mesh(arrays);
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::SPECTRAL,
                           Conformal_method::CASCADIC}) {
    const std::size_t levels = parameterize(mesh, with_many_levels(method)).report.levels.size();
    EXPECT_GE(levels, 2u);
    for(std::size_t last = 0; last + 1 < levels; ++last) {
      HLSCM_options options = with_many_levels(method);
      Parameters level_uv;
      std::vector<std::uint32_t> source;
      options.level_observer = [&](const SMP::Level_view& view) {
        EXPECT_LE(view.level, last);
        level_uv = *view.uv;
        source = *view.vertices;
        return view.level < last;
      };
      const Outcome run = parameterize(mesh, options);
      EXPECT_EQ(run.error, SMP::OK) << run.report.message;
      EXPECT_TRUE(run.report.stopped_early);
      EXPECT_FALSE(run.report.converged);
      EXPECT_GT(run.report.energy, 0.);
      ASSERT_FALSE(source.empty());
      for(const Complex& z : run.uv)
        ASSERT_NE(z, Complex(untouched, untouched));
      if(method != Conformal_method::SPECTRAL) { // whose map is fitted to each level anew
        for(std::size_t i = 0; i < source.size(); ++i)
          ASSERT_EQ(run.uv[source[i]], level_uv[i]) << int(method) << " level " << last;
      }
    }
  }
}

TEST(Ending_early, time_limit_takes_the_map_that_there_is)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  HLSCM_options options = with_many_levels(Conformal_method::HLSCM);
  options.time_limit = 1e-9;
  const Outcome run = parameterize(mesh, options);
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_TRUE(run.report.stopped_early);
  EXPECT_FALSE(run.report.cancelled);
  EXPECT_LE(run.report.iterations, 1u);
  options.time_limit = 1e9;
  const Outcome unlimited = parameterize(mesh, options);
  EXPECT_FALSE(unlimited.report.stopped_early);
  EXPECT_TRUE(unlimited.report.converged);
}

// The iteration that ends by its uv tolerance is that near to the exact map.
TEST(Ending_early, uv_tolerance_bounds_the_distance_from_the_minimiser)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  HLSCM_options options = with_many_levels(Conformal_method::DIRECT);
  const Outcome exact = parameterize(mesh, options);
  std::size_t before = 0;
  for(const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    options.method = Conformal_method::HLSCM;
    options.tolerance = 1e-30;
    options.uv_tolerance = tolerance;
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_TRUE(run.report.converged);
    EXPECT_LE(difference(run.uv, exact.uv), tolerance);
    EXPECT_GE(run.report.iterations, before);
    before = run.report.iterations;
  }
  options.uv_tolerance = -1.;
  EXPECT_EQ(parameterize(mesh, options).error, SMP::ERROR_WRONG_PARAMETER);
}

// --- Several components

Indexed_triangle_mesh together(const Indexed_triangle_mesh& a, const Indexed_triangle_mesh& b)
{
  Indexed_triangle_mesh result = a;
  const auto shift = Vertex_index(a.points.size());
  result.points.insert(result.points.end(), b.points.begin(), b.points.end());
  for(const auto& t : b.triangles)
    result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return result;
}

TEST(Components, only_the_one_of_the_halfedge_is_mapped)
{
  const auto first = hills(), second = with_hills(irregular_grid(30, 30, 5), 5., 6);
  const auto both = together(first, second);
  Surface_mesh mesh = to_surface_mesh(both), first_alone = to_surface_mesh(first),
               second_alone = to_surface_mesh(second);
  const auto size = first.points.size();
  for(const bool is_first : {true, false}) {
    auto bhd = Surface_mesh::null_halfedge();
    for(const auto h : halfedges(mesh))
      if(is_border(h, mesh) && (std::size_t(target(h, mesh)) < size) == is_first)
        bhd = h;
    const Outcome run = parameterize(mesh, with_many_levels(), Pins(), bhd);
    const Outcome alone = parameterize(is_first ? first_alone : second_alone, with_many_levels());
    ASSERT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_EQ(run.report.vertices, alone.report.vertices);
    Parameters mapped(run.uv.begin(), run.uv.begin() + size),
               other(run.uv.begin() + size, run.uv.end());
    if(!is_first)
      mapped.swap(other);
    EXPECT_LE(difference(mapped, alone.uv), 0.02);
    for(const Complex& z : other)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

TEST(Components, isolated_vertices_stay_untouched)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const auto lonely = mesh.add_vertex({1e9, 2., 3.});
  const Outcome run = parameterize(mesh, HLSCM_options());
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_EQ(run.uv[lonely], Complex(untouched, untouched));
  EXPECT_EQ(run.report.vertices, mesh.number_of_vertices() - 1);
}

// Positions in vertices(mesh) are counted without removed vertices.
TEST(Removed_vertices, do_not_disturb_the_numbering)
{
  const auto arrays = hills();
  Surface_mesh gaps, plain = to_surface_mesh(arrays);
  std::vector<Vertex> descriptor;
  for(const auto& p : arrays.points) {
    gaps.remove_vertex(gaps.add_vertex());
    gaps.set_recycle_garbage(false);
    descriptor.push_back(gaps.add_vertex(p));
  }
  for(const auto& t : arrays.triangles)
    gaps.add_face(descriptor[t[0]], descriptor[t[1]], descriptor[t[2]]);
  ASSERT_TRUE(gaps.has_garbage());
  const Outcome a = parameterize(gaps, with_many_levels()),
                b = parameterize(plain, with_many_levels());
  ASSERT_EQ(a.error, SMP::OK) << a.report.message;
  EXPECT_EQ(a.uv, b.uv);
  EXPECT_EQ(a.report.pins[0].vertex, b.report.pins[0].vertex);
}

// --- What is wrong

// All methods fail with the same sentence, and leave the parameters alone.
void expect_failure(Surface_mesh& mesh, SMP::Error_code error, const std::string& message,
                    const Pins& pins = Pins(),
                    Surface_mesh::Halfedge_index bhd = Surface_mesh::null_halfedge())
{
  for(const auto method : all_methods) {
    const Outcome run = parameterize(mesh, with_method(method), pins, bhd);
    EXPECT_EQ(run.error, error);
    EXPECT_EQ(run.report.message, message);
    EXPECT_FALSE(run.report.converged);
    for(const Complex& z : run.uv)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

TEST(Errors, coordinate_that_is_not_finite)
{
  for(const double bad : {std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity()})
    for(int c = 0; c < 3; ++c) {
      auto arrays = hills();
      std::array<double, 3> p = {1., 2., 3.};
      p[c] = bad;
      arrays.points[17] = Point_3(p[0], p[1], p[2]);
      Surface_mesh mesh = to_surface_mesh(arrays);
      expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, "vertex 17 has a coordinate that is not a "
                     "finite number; correct or remove it");
    }
}

TEST(Errors, closed_surface)
{
  Surface_mesh mesh = to_surface_mesh(sphere(2));
  const std::string message
    = "the given halfedge is not on a border; a closed surface must be cut open first";
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC, message); // no border halfedge at all
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC, message, Pins(), *halfedges(mesh).begin());
}

TEST(Errors, handles)
{
  Surface_mesh mesh = to_surface_mesh(with_holes(torus(20, 10), 2, 1));
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC,
                 "the surface has genus 1; cut its handles first");
}

TEST(Errors, vertex_with_two_fans)
{
  // Two squares that share the vertex 3
  auto arrays = together(grid(1, 1), translated(grid(1, 1), 1., 1., 0.));
  for(auto& t : arrays.triangles)
    for(auto& v : t)
      v = v == 4 ? 3 : v;
  Surface_mesh mesh = to_surface_mesh(arrays);
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC,
                 "the faces at vertex 3 do not form one fan; split the vertex first");
}

TEST(Errors, face_that_is_not_a_triangle)
{
  Surface_mesh mesh;
  const auto v = [&](double x, double y) { return mesh.add_vertex({x, y, 0.}); };
  const auto a = v(0, 0), b = v(1, 0), c = v(1, 1), d = v(0, 1), e = v(2, 0);
  mesh.add_face(b, e, c);
  mesh.add_face(a, b, c, d);
  expect_failure(mesh, SMP::ERROR_NON_TRIANGULAR_MESH,
                 "face 1 is not a triangle; triangulate the mesh first");
}

TEST(Errors, all_in_one_point)
{
  Surface_mesh mesh
    = to_surface_mesh(moved(grid(3, 3), [](const Point_3&) { return Point_3(1., 2., 3.); }));
  expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, "all vertices lie in one point");
}

TEST(Errors, pins)
{
  const auto first = hills();
  Surface_mesh mesh = to_surface_mesh(together(first, grid(2, 2)));
  const auto other = first.points.size() + 4;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [&](const Pins& pins, const std::string& message) {
    expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, message, pins);
  };
  expect({{5, 0.}}, "fewer than two vertices are pinned; pin two or more");
  expect({{5, 0.}, {5, 1.}}, "vertex 5 is pinned twice; pin it once");
  expect({{5, Complex(1., 2.)}, {6, Complex(1., 2.)}},
         "the pins of vertex 5 and vertex 6 lie in one point of the parameter plane; move one of "
         "them");
  expect({{5, 0.}, {6, Complex(0., nan)}},
         "the pin of vertex 6 has a coordinate that is not a finite number");
  expect({{5, 0.}, {other, 1.}}, "the pinned vertex " + std::to_string(other)
         + " does not belong to the chart; pin vertices of the chart");
  expect({{5, 0.}, {1000000, 1.}}, "the pinned vertex " + std::to_string(mesh.number_of_vertices())
         + " does not belong to the chart; pin vertices of the chart");
}

TEST(Errors, options)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const auto message_of = [&](const HLSCM_options& options) {
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::ERROR_WRONG_PARAMETER);
    for(const Complex& z : run.uv)
      EXPECT_EQ(z, Complex(untouched, untouched));
    return run.report.message;
  };
  HLSCM_options options;
  for(const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN()}) {
    options = HLSCM_options();
    options.tolerance = bad;
    EXPECT_EQ(message_of(options), "the tolerance must be positive");
  }
  for(const double bad : {1., 0.5, -2., std::numeric_limits<double>::quiet_NaN()}) {
    options = HLSCM_options();
    options.level_ratio = bad;
    EXPECT_EQ(message_of(options), "the ratio of levels must be greater than 1");
  }
  options = HLSCM_options();
  options.angular_defect_bound = 0.;
  EXPECT_EQ(message_of(options), "the bound of the angular defect must be positive");
  options = HLSCM_options();
  options.schedule = CGAL::Multigrid::Schedule{1, 1, 0, CGAL::Multigrid::Acceleration::NONE};
  EXPECT_EQ(message_of(options), "the schedule must visit the coarse level at least once");
}

// One line for each level, which says what its row of the report does.
TEST(Report, prints_the_levels_as_a_table)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const HLSCM_options options = with_many_levels(Conformal_method::HLSCM, 1e-2);
  const SMP::HLSCM_report report = parameterize(mesh, options).report;
  ASSERT_GT(report.levels.size(), 1u);
  std::ostringstream out;
  out << report;
  std::istringstream in(out.str());
  std::string line;
  std::getline(in, line);
  for(std::size_t l = report.levels.size(); l-- > 0;) {
    const SMP::HLSCM_level_report& level = report.levels[l];
    EXPECT_GT(level.entries, 3 * level.vertices); // a vertex has three neighbours or more, mostly
    EXPECT_GT(level.bytes, 8 * level.entries);    // an index and a number each
    std::size_t number, vertices, faces, entries, iterations;
    double megabytes, ratio = 1.;
    std::getline(in, line);
    std::istringstream row(line);
    row >> number >> vertices >> faces >> entries >> megabytes;
    if(l > 0)
      row >> ratio;
    row >> iterations;
    ASSERT_FALSE(row.fail()) << line;
    EXPECT_EQ(number, l);
    EXPECT_EQ(vertices, level.vertices);
    EXPECT_EQ(faces, level.faces);
    EXPECT_EQ(entries, level.entries);
    EXPECT_NEAR(megabytes, 1e-6 * double(level.bytes), 0.006);
    if(l > 0) {
      EXPECT_NEAR(ratio, double(level.vertices) / double(report.levels[l - 1].vertices), 0.006);
    }
  }
  std::getline(in, line);
  EXPECT_EQ(line.substr(0, 16), "hlscm: converged");
}

TEST(Errors, too_few_iterations)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::LSCM}) {
    HLSCM_options options = with_many_levels(method, 1e-6);
    options.maximal_iterations = 3;
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
    EXPECT_FALSE(run.report.converged);
    EXPECT_EQ(run.report.iterations, 3u);
    EXPECT_EQ(run.report.message.substr(0, 48), "the tolerance was not met after 3 iterations; ra");
    for(const Complex& z : run.uv)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

} // namespace parameterizer_interface_test
