// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What comes out of the parameterizer beside the map: the report, progress, observers, and early
// ends.

#include <support/conformal_maps.h>
#include <support/mesh_properties.h>
#include <support/method_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace parameterizer_interface_test {

using namespace test_support;
using namespace method_runs;

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

} // namespace parameterizer_interface_test
