// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's method for maps with little stretch: what it foretells of the next step, and what may be left.

#include <support/chart_generators.h>
#include <support/stretch_levels.h>

#include <CGAL/Surface_mesh_parameterization/internal/descent/Remaining_gain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace newton_steps_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
namespace SMP_internal = CGAL::Surface_mesh_parameterization::internal;
using SMP_internal::Newton_steps;
using SMP_internal::Plane_point;
using SMP_internal::Remaining_gain;
typedef Dirichlet_level Level;

constexpr std::uint64_t seed = 20261202;

Level projected(const Indexed_triangle_mesh& mesh) { return level_of(mesh, projection(mesh)); }

Newton_steps steps_on_one_level()
{
  Newton_steps newton;
  newton.add_level(nullptr);
  return newton;
}

// What an iteration with the second derivative 1/c times too large gains of an energy of which `left` is left
// along directions with such c.
struct Known_steps
{
  double last_gain = 0., last_decrement = 0.;
  std::vector<double> c, left;

  double all_left() const
  {
    double sum = 0.;
    for(const double e : left)
      sum += e;
    return sum;
  }
  double next_decrement() const
  {
    double sum = 0.;
    for(std::size_t i = 0; i < c.size(); ++i)
      sum += c[i] * left[i];
    return sum;
  }
  void step()
  {
    const double before = all_left();
    last_decrement = next_decrement();
    for(std::size_t i = 0; i < c.size(); ++i)
      left[i] *= (1. - c[i]) * (1. - c[i]);
    last_gain = before - all_left();
  }

  double gain() const { return last_gain; }
  double decrement() const { return last_decrement; }
  double surprise() const { return std::abs(last_gain - last_decrement) / last_decrement; }
  bool is_full() const { return true; }
};

// --- Tests

// By the matrix of the last step, and three iterations, nearly as by its own one, and five.
TEST(Newton_steps, foretell_the_next_one)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(14, 14, seed), 2., seed);
  Level level = projected(mesh);
  Newton_steps newton = steps_on_one_level();
  std::size_t foretold = 0;
  newton(level, 5);
  for(int i = 0; i < 6; ++i) {
    const double next = newton.next_decrement(level);
    const bool was_full = newton.is_full();
    newton(level, 5);
    if(std::isinf(next)) {
      EXPECT_FALSE(was_full && i > 3) << "step " << i;
      continue;
    }
    ++foretold;
    EXPECT_LT(next, 3. * newton.decrement()) << "step " << i;
    EXPECT_GT(3. * next, newton.decrement()) << "step " << i;
  }
  EXPECT_GE(foretold, 4u);
}

// Near the minimum it is what is left, but for what the projection of the second derivative takes.
TEST(Newton_steps, foretell_what_is_left_near_the_minimum)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(14, 14, seed), 2., seed);
  Level level = projected(mesh);
  Newton_steps newton = steps_on_one_level();
  std::vector<double> energies, foretold;
  for(int i = 0; i < 12; ++i) {
    newton(level, 20);
    energies.push_back(level.value());
    foretold.push_back(newton.next_decrement(level));
  }
  for(int i = 3; i < 12; ++i) {
    const double left = energies[i] - energies.back();
    if(left > 1e-9 * energies.back()) {
      EXPECT_GT(left, 0.8 * foretold[i]) << "after step " << i;
      EXPECT_LT(left, 7. * foretold[i]) << "after step " << i;
    }
  }
}

TEST(Newton_steps, to_ask_for_the_next_one_changes_nothing)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(12, 12, seed), 2., seed);
  Level asked = projected(mesh), silent = projected(mesh);
  Newton_steps a = steps_on_one_level(), b = steps_on_one_level();
  for(int i = 0; i < 6; ++i) {
    a(asked, 5);
    b(silent, 5);
    a.next_decrement(asked);
    for(std::size_t v = 0; v < asked.size(); ++v) {
      ASSERT_EQ(asked.places()[v].x, silent.places()[v].x) << "step " << i << ", vertex " << v;
      ASSERT_EQ(asked.places()[v].y, silent.places()[v].y) << "step " << i << ", vertex " << v;
    }
  }
}

// Where the middle is turned far enough, triangles that would turn over make the first step short.
TEST(Newton_steps, foretell_nothing_after_a_short_one)
{
  std::size_t full = 0, is_short = 0;
  for(double angle = 0.; angle < 3.; angle += 0.3) {
    Indexed_triangle_mesh mesh = irregular_grid(14, 14, seed);
    Level level = projected(mesh);
    std::vector<Plane_point> places = level.places();
    for(Plane_point& p : places) {
      const Plane_point way = p - Plane_point{7., 7.};
      const double turn = angle * std::exp(-0.1 * way.squared_length());
      p = Plane_point{7., 7.} + way.times({std::cos(turn), std::sin(turn)});
    }
    level.put(std::move(places));
    Newton_steps newton = steps_on_one_level();
    newton(level, 5);
    EXPECT_EQ(std::isinf(newton.next_decrement(level)), !newton.is_full()) << "angle " << angle;
    ++(newton.is_full() ? full : is_short);
  }
  EXPECT_GT(full, 0u);
  EXPECT_GT(is_short, 0u);
}

// Along one direction, and with faster ones beside it, which may hide a part of it after the first step.
TEST(Remaining_gain, is_at_least_what_is_left)
{
  for(const double c : {1., 0.9, 0.7, 0.5, 0.3, 0.2, 0.15})
    for(const double faster : {0., 0.5, 0.8}) {
      Known_steps steps{0., 0., {c, (std::max)(c, faster)}, {1., 1.}};
      Remaining_gain gains;
      for(int i = 0; i < 8; ++i) {
        steps.step();
        gains.add(steps, 0.);
        EXPECT_GE(gains.value(steps.next_decrement()), (i == 0 ? 0.7 : 1. - 1e-9) * steps.all_left())
          << c << ", " << faster << ", step " << i;
      }
    }
}

} // namespace newton_steps_test
