// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The repair of flipped faces as part of the parameterizer.

#include <support/conformal_maps.h>
#include <support/repaired_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>


#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace flip_repair_in_runs_test {

using namespace test_support;
using namespace repaired_maps;
using SMP::Conformal_method;

// --- As part of the parameterizer

// A rough surface: its least squares conformal map has flips.
Indexed_triangle_mesh rough_chart(std::uint64_t seed)
{
  return with_noise(with_hills(irregular_grid(40, 30, seed), 8., seed + 1), 0.45, seed + 2);
}

// Angles at inner vertices with sums of far more than 2 pi, around which a conformal map winds
// twice
TEST(Repair, makes_no_branch_points)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto mesh = with_noise(irregular_grid(30, 30, seed), 5., seed + 1);
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.repair_flips = SMP::Flip_repairer();
    const Outcome run = parameterize(surface_mesh, options);
    const Flip_repair_report& r = *run.report.flip_repair;
    std::cout << "seed " << seed << ": " << r.flipped_before << " -> " << r.flipped_after
              << ", energy +" << 100. * (r.energy_after / r.energy_before - 1.) << " %\n";
    EXPECT_GT(r.flipped_before, 20u); // or this test would not test anything
    EXPECT_TRUE(r.unmended_faces.empty());
    EXPECT_EQ(r.branch_vertices, 0u);
  }
}

// The border of the patch runs around twice: without flips the map must branch in it.
TEST(Repair, branches_where_it_must)
{
  const auto mesh = disk(6, 24);
  Parameters uv = map_of(mesh, [](Complex w) { return w * w / (1. + std::abs(w)); });
  const std::size_t inner = 24 + 1;
  std::vector<std::size_t> pins; // all but the innermost circles
  for(std::size_t v = 2 * inner; v < uv.size(); ++v)
    pins.push_back(v);
  std::swap(uv[3], uv[7]);
  ASSERT_GT(bad_faces(mesh, uv).size(), 0u);
  uv[0] += Complex(0.5, 0.);
  const Repaired repaired = repair(mesh, uv, pins);
  EXPECT_EQ(error_in_repair(mesh, uv, pins, repaired), "");
  EXPECT_TRUE(repaired.report.unmended_faces.empty());
  EXPECT_TRUE(certify(mesh, repaired.uv).certificate.overlaps);
  EXPECT_LE(repaired.report.branch_vertices, 1u);
}

// Against the limit that the mended map costs at most 5 % more energy than the least one.
TEST(Repair, mends_the_maps_of_all_methods)
{
  std::size_t mended = 0;
  for(const Conformal_method method :
      {Conformal_method::HLSCM, Conformal_method::SPECTRAL, Conformal_method::DIRECT})
    for(const Conformal_weights weights :
        {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      if(method == Conformal_method::SPECTRAL && weights == Conformal_weights::CGAL_LSCM)
        continue;
      for(std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto mesh = rough_chart(seed);
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        SMP::HLSCM_options options = with_method(method, 1e-4);
        options.weights = weights;
        options.coarsest_size = 200;
        const Outcome plain = parameterize(surface_mesh, options);
        options.repair_flips = SMP::Flip_repairer();
        const Outcome run = parameterize(surface_mesh, options);
        ASSERT_EQ(run.error, SMP::OK);
        ASSERT_TRUE(run.report.flip_repair.has_value());
        const Flip_repair_report& r = *run.report.flip_repair;
        const std::string where = run.report.method + " seed " + std::to_string(seed);
        EXPECT_EQ(r.flipped_before + r.degenerate_before, bad_faces(mesh, plain.uv).size()) << where;
        EXPECT_EQ(bad_faces(mesh, run.uv).size(), 0u) << where;
        EXPECT_LE(r.energy_after, 1.05 * r.energy_before) << where;
        EXPECT_EQ(r.energy_after, run.report.energy) << where;
        const double energy = energy_of(surface_mesh, run.uv, weights);
        EXPECT_NEAR(run.report.energy, energy, 1e-6 * energy) << where;
        for(const auto& pin : run.report.pins)
          EXPECT_EQ(run.uv[pin.vertex], Complex(pin.u, pin.v)) << where;
        mended += r.flipped_before;
        // The same of arrays, whose edges are added up in another order
        const SMP::Conformal_map map = SMP::conformal_map(mesh, options);
        ASSERT_EQ(map.error, "");
        ASSERT_TRUE(map.report.flip_repair.has_value());
        EXPECT_EQ(map.report.flip_repair->flipped_before, r.flipped_before) << where;
        EXPECT_TRUE(map.report.flip_repair->unmended_faces.empty()) << where;
        EXPECT_NEAR(map.report.energy, run.report.energy, 1e-9 * energy) << where;
        for(std::size_t v = 0; v < map.uv.size(); ++v)
          EXPECT_NEAR(std::abs(Complex(map.uv[v].x(), map.uv[v].y()) - run.uv[v]), 0., 1e-9) << where;
      }
    }
  EXPECT_GT(mended, 10u); // or this test would not test anything
}

// What is mended by then stays so, and everything else as it was.
TEST(Repair, can_be_stopped_between_patches)
{
  const auto mesh = rough_chart(1);
  Surface_mesh surface_mesh = to_surface_mesh(mesh);
  const Outcome plain = parameterize(surface_mesh, with_method(Conformal_method::DIRECT));
  const std::size_t before = bad_faces(mesh, plain.uv).size();
  for(const int calls : {0, 1, 2}) {
    std::vector<double> parts;
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.repair_flips = [&](SMP::Map_to_repair& map, const auto& progress) {
      const std::vector<Complex> old = map.z;
      const Flip_repair_report report = SMP::Flip_repairer()(map, [&](double part) {
        parts.push_back(part);
        return progress(part) && int(parts.size()) <= calls;
      });
      EXPECT_EQ(old != map.z, report.moved_vertices > 0);
      return report;
    };
    const Outcome run = parameterize(surface_mesh, options);
    ASSERT_EQ(run.error, SMP::OK);
    const Flip_repair_report& r = *run.report.flip_repair;
    EXPECT_EQ(r.stopped_early, int(parts.size()) == calls + 1);
    EXPECT_EQ(bad_faces(mesh, run.uv), r.unmended_faces);
    for(const double part : parts)
      EXPECT_TRUE(part >= 0. && part <= 1.);
    if(calls == 0) {
      EXPECT_EQ(r.moved_vertices, 0u);
      EXPECT_EQ(run.uv, plain.uv);
      EXPECT_EQ(r.unmended_faces.size(), before);
      EXPECT_FALSE(run.report.warnings.empty());
    } else
      EXPECT_LT(r.unmended_faces.size(), before);
  }
}

// A model of `FlipRepairFunction` that has nothing but what the concept asks for: it may be copied.
class Idle_repairer
{
public:
  explicit Idle_repairer(int* calls) : m_calls(calls) {}
  Flip_repair_report operator()(SMP::Map_to_repair&, const std::function<bool(double)>& progress) const
  {
    ++*m_calls;
    Flip_repair_report report;
    report.stopped_early = !progress(1.);
    return report;
  }

private:
  int* m_calls;
};

TEST(Repair, needs_nothing_of_the_function_but_the_concept)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  const Outcome plain = parameterize(mesh, with_method(Conformal_method::DIRECT));
  int calls = 0;
  SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
  options.repair_flips = Idle_repairer(&calls);
  const Outcome run = parameterize(mesh, options);
  ASSERT_EQ(run.error, SMP::OK);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(run.uv, plain.uv);
}

TEST(Repair, obeys_the_progress_function)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
  options.repair_flips = SMP::Flip_repairer();
  std::vector<double> parts;
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  ASSERT_EQ(parameterize(mesh, options).error, SMP::OK);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.back(), 1.);
  const auto in_repair = [](double part) { return part >= 0.9; };
  EXPECT_GT(std::count_if(parts.begin(), parts.end(), in_repair), 2);
  parts.clear();
  options.progress = [&](double part) {
    parts.push_back(part);
    return std::count_if(parts.begin(), parts.end(), in_repair) < 2;
  };
  const Outcome run = parameterize(mesh, options);
  EXPECT_NE(run.error, SMP::OK);
  EXPECT_TRUE(run.report.cancelled);
  EXPECT_EQ(run.report.message, "cancelled");
}

TEST(Repair, obeys_the_time_limit)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  for(const double limit : {0., 1e-9, 1e6}) {
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.time_limit = limit;
    bool goes_on = false;
    options.repair_flips = [&](SMP::Map_to_repair&, const auto& progress) {
      goes_on = progress(0.5);
      return Flip_repair_report();
    };
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::OK);
    EXPECT_EQ(goes_on, limit != 1e-9);
    EXPECT_EQ(run.report.stopped_early, limit == 1e-9);
  }
}

TEST(Repair, is_off_by_default)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  const Outcome run = parameterize(mesh, with_method(Conformal_method::DIRECT));
  EXPECT_FALSE(run.report.flip_repair.has_value());
}

// Slivers, and faces without area in space
TEST(Repair, mends_the_maps_of_bad_meshes)
{
  std::size_t mended = 0;
  for(const std::uint64_t seed : {3, 4})
    for(const auto& [name, mesh] : curved_charts(seed))
      for(const Conformal_weights weights :
          {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
        options.weights = weights;
        options.repair_flips = SMP::Flip_repairer();
        const Outcome run = parameterize(surface_mesh, options);
        ASSERT_TRUE(run.report.flip_repair.has_value()) << name;
        const Flip_repair_report& r = *run.report.flip_repair;
        const std::size_t bad = r.flipped_before + r.degenerate_before;
        if(bad > 0)
          std::cout << name << " " << seed << ": " << bad << " -> " << r.unmended_faces.size()
                    << ", energy +" << 100. * (r.energy_after / r.energy_before - 1.) << " %\n";
        EXPECT_EQ(bad_faces(mesh, run.uv), r.unmended_faces) << name << " " << seed;
        EXPECT_TRUE(r.unmended_faces.empty()) << name << " " << seed;
        // CGAL's weights hardly see the triangles without area, the barrier does
        const double limit = weights == Conformal_weights::EXACT ? 1.05 : 1.1;
        EXPECT_LE(r.energy_after, limit * r.energy_before) << name << " " << seed;
        mended += bad - r.unmended_faces.size();
      }
  EXPECT_GT(mended, 10u); // or this test would not test anything
}

} // namespace flip_repair_in_runs_test
