// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps with thousands of pins.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_system.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/map_chart_conformally.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace many_pins_test {

using namespace test_support;
namespace SMP = CGAL::Surface_mesh_parameterization;
typedef SMP::internal::Conformal_hierarchy Conformal_hierarchy;
typedef std::vector<SMP::HLSCM_pin> Pins;

constexpr std::uint64_t seed = 20261122;

const Indexed_triangle_mesh& surface()
{
  static const Indexed_triangle_mesh mesh
    = with_hills(irregular_grid(150, 150, seed), 8., seed + 1);
  return mesh;
}

double extent(const std::vector<CGAL::Simple_cartesian<double>::Point_2>& uv)
{
  double largest = 0.;
  for(const auto& p : uv)
    largest = (std::max)({largest, std::abs(p.x()), std::abs(p.y())});
  return largest;
}

// Every `step`-th vertex, where a bent copy of the map under two pins has it.
Pins bent_pins(const SMP::Conformal_map& map, std::size_t step)
{
  const double size = extent(map.uv);
  Pins pins;
  for(std::size_t v = 0; v < map.uv.size(); v += step) {
    const double u = map.uv[v].x() / size, w = map.uv[v].y() / size;
    pins.push_back({v, size * (u + 0.02 * std::sin(5. * w)), size * (w + 0.02 * std::sin(4. * u))});
  }
  return pins;
}

void expect_pins_met(const SMP::Conformal_map& map, const Pins& pins)
{
  ASSERT_EQ(map.error, "");
  std::size_t elsewhere = 0;
  for(const SMP::HLSCM_pin& pin : pins)
    if(map.uv[pin.vertex].x() != pin.u || map.uv[pin.vertex].y() != pin.v)
      ++elsewhere;
  EXPECT_EQ(elsewhere, 0u);
}

// From a few to half of the vertices. What is pinned on all levels is no unknown of any, so that
// the number of iterations does not grow.
TEST(Many_pins, are_met_exactly_by_the_map_of_least_energy)
{
  const SMP::Conformal_map free = SMP::conformal_map(surface());
  for(const std::size_t step : {1000, 100, 13, 2}) {
    const Pins pins = bent_pins(free, step);
    const SMP::Conformal_map map = SMP::conformal_map(surface(), pins);
    expect_pins_met(map, pins);
    EXPECT_TRUE(map.report.converged) << pins.size();
    EXPECT_LE(map.report.iterations, free.report.iterations + 3) << pins.size();
    SMP::HLSCM_options options;
    options.method = SMP::Conformal_method::DIRECT;
    const SMP::Conformal_map exact = SMP::conformal_map(surface(), pins, options);
    expect_pins_met(exact, pins);
    EXPECT_LE(map.report.energy, (1. + SMP::HLSCM_options().tolerance) * exact.report.energy);
    EXPECT_GE(map.report.energy, (1. - 1e-9) * exact.report.energy);
  }
}

TEST(Many_pins, are_on_the_coarsest_level_and_add_no_unknowns_to_it)
{
  const SMP::Conformal_map free = SMP::conformal_map(surface());
  SMP::HLSCM_options options;
  options.coarsest_size = 500;
  const std::size_t without = SMP::conformal_map(surface(), options).report.levels[0].vertices;
  for(const std::size_t step : {100, 13}) { // with more pins there is one level
    const Pins pins = bent_pins(free, step);
    const std::size_t coarsest
      = SMP::conformal_map(surface(), pins, options).report.levels[0].vertices;
    EXPECT_GE(coarsest, pins.size());
    EXPECT_LE(coarsest, pins.size() + without);
  }
}

TEST(Many_pins, may_come_in_any_order)
{
  Pins pins = bent_pins(SMP::conformal_map(surface()), 13);
  const SMP::Conformal_map ascending = SMP::conformal_map(surface(), pins);
  std::mt19937_64 random(seed);
  std::shuffle(pins.begin(), pins.end(), random);
  const SMP::Conformal_map shuffled_pins = SMP::conformal_map(surface(), pins);
  ASSERT_EQ(ascending.error, "");
  EXPECT_TRUE(ascending.uv == shuffled_pins.uv);
}

// A hierarchy of a surface without pins, the cycle ready.
struct Hierarchy_of_surface
{
  Hierarchy_of_surface()
  {
    namespace SMM = CGAL::Surface_mesh_multiresolution;
    SMP::internal::Prepared_chart prepared = SMP::internal::chart_of_arrays(surface());
    SMP::HLSCM_options options;
    options.coarsest_size = 300;
    SMM::Hierarchy_options levels;
    levels.coarsest_size = options.coarsest_size;
    const auto pm
      = SMP::internal::decimate(prepared.chart, {}, options, [](double) { return true; });
    hierarchy.set_levels(SMM::build_hierarchy(std::move(prepared.chart.mesh), pm, levels));
    hierarchy.build_operators({}, [](std::size_t) { return true; });
    hierarchy.build_cycle();
  }

  // A few iterations on the finest level from a map that is wrinkled everywhere but at the pins.
  Conformal_hierarchy::Vector relaxed()
  {
    const std::size_t finest = hierarchy.number_of_levels() - 1;
    Random random(seed);
    Conformal_hierarchy::Vector z(hierarchy.levels()[finest].vertices.size());
    for(auto& value : z)
      value = {uniform(random, -1., 1.), uniform(random, -1., 1.)};
    CGAL::Multigrid::Energy_stop stop;
    stop.tolerance = 0.;
    stop.maximal_iterations = 3;
    EXPECT_TRUE(hierarchy.factorize_coarsest());
    hierarchy.minimize(finest, CGAL::Multigrid::Schedule(), stop, [](double) { return true; }, z);
    return z;
  }

  Conformal_hierarchy hierarchy;
};

// Here the coarse levels do not have the pins: several may have one vertex that stands for them.
TEST(Many_pins, that_come_and_go_leave_no_trace)
{
  Hierarchy_of_surface changed, made_at_once;
  const std::size_t n = surface().points.size();
  std::vector<Vertex_index> kept, passing;
  for(Vertex_index v = 0; v < n; v += 5)
    (v % 3 == 0 ? kept : passing).push_back(v);
  std::vector<Vertex_index> all = passing;
  all.insert(all.end(), kept.begin(), kept.end());
  std::mt19937_64 random(seed);
  std::shuffle(all.begin(), all.end(), random);
  std::shuffle(passing.begin(), passing.end(), random);
  for(const Vertex_index v : all)
    changed.hierarchy.pin(v);
  for(const Vertex_index v : passing)
    changed.hierarchy.release(v);
  const auto changes = made_at_once.hierarchy.pin_only(kept);
  EXPECT_EQ(changes.pinned, kept.size());
  EXPECT_EQ(changes.released, 0u);
  EXPECT_EQ(changed.hierarchy.pin_only(kept).pinned, 0u);
  const auto z = changed.relaxed();
  EXPECT_TRUE(z == made_at_once.relaxed());
  changed.hierarchy.pin_only({kept[0]});
  EXPECT_FALSE(z == changed.relaxed());
}

} // namespace many_pins_test
