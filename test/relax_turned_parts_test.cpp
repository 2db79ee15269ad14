// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of a map with little stretch that a step turned, which are relaxed alone: what moves, that the
// energy falls, and that threads change nothing.

#include <support/chart_generators.h>
#include <support/stretch_levels.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/relax_turned_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace relax_turned_parts_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
namespace SMP_internal = CGAL::Surface_mesh_parameterization::internal;
using SMP_internal::Plane_point;
typedef Dirichlet_level Level;

constexpr std::uint64_t seed = 20261201;
constexpr Vertex_index side = 61;

// Low hills on a square and their projection, but for two places, where it is turned around their middles.
struct Turned_map
{
  explicit Turned_map(double angle, std::vector<bool> is_fixed = {})
    : mesh(with_hills(irregular_grid(side - 1, side - 1, seed), 0.5, seed))
  {
    std::vector<Plane_point> places = projection(mesh);
    for(const std::size_t middle : {15 * side + 15, 45 * side + 45})
      turn(places, places[middle], angle);
    level.emplace(level_of(mesh, std::move(places), std::move(is_fixed)));
  }

  // By less the further away.
  static void turn(std::vector<Plane_point>& places, const Plane_point middle, double angle)
  {
    const double radius = 2.5;
    for(Plane_point& p : places) {
      const Plane_point way = p - middle;
      const double part = 1. - way.squared_length() / (radius * radius);
      const double a = part > 0. ? angle * part * part : 0.;
      p = middle + way.times({std::cos(a), std::sin(a)});
    }
  }

  Indexed_triangle_mesh mesh;
  std::optional<Level> level;
};

SMP_internal::Newton_steps one_step(Level& level)
{
  SMP_internal::Newton_steps newton;
  newton.add_level(nullptr);
  newton(level, 2);
  return newton;
}

// The vertices of these triangles, and some rings around them.
std::set<Vertex_index> with_rings(const Level& level, const std::vector<std::uint32_t>& triangles, int rings)
{
  std::set<Vertex_index> result;
  for(const std::uint32_t t : triangles)
    result.insert(level.triangles()[t].begin(), level.triangles()[t].end());
  for(int i = 0; i < rings; ++i) {
    const std::set<Vertex_index> before = result;
    for(const Vertex_index v : before)
      level.for_each_corner_around(v, [&](Vertex_index w) { result.insert(w); });
  }
  return result;
}

bool are_equal(const Plane_point& p, const Plane_point& q) { return p.x == q.x && p.y == q.y; }

// --- Tests

// All that moves is near a triangle whose conformal part, by differences of its edges, has changed.
TEST(Turned_parts, only_what_is_near_them_moves)
{
  Turned_map map(0.4);
  Level& level = *map.level;
  const SMP_internal::Newton_steps newton = one_step(level);
  const std::vector<Plane_point> before = level.places();
  const std::vector<std::uint32_t> triangles = SMP_internal::turned_triangles(level, newton.last_step(), 0.1);
  ASSERT_GT(triangles.size(), 10u);
  ASSERT_LT(triangles.size(), level.triangles().size() / 4);
  const std::set<std::uint32_t> chosen(triangles.begin(), triangles.end());
  for(std::uint32_t t = 0; t < level.triangles().size(); ++t) {
    const auto& v = level.triangles()[t];
    const auto alpha = [&](const std::vector<Plane_point>& z) {
      return Plane_jacobian<double>(level.reference(t), {z[v[0]], z[v[1]], z[v[2]]}).alpha;
    };
    std::vector<Plane_point> start = before;
    for(const Vertex_index w : v)
      start[w] = before[w] - newton.last_step()[w];
    const double change = std::sqrt((alpha(before) - alpha(start)).squared_length()
                                    / alpha(before).squared_length());
    if(std::abs(change - 0.1) > 1e-9) {
      EXPECT_EQ(change > 0.1, chosen.count(t) > 0) << "triangle " << t;
    }
  }
  const std::set<Vertex_index> near = with_rings(level, triangles, 2);
  SMP_internal::relax_turned_parts(level, newton, 1e-3);
  std::size_t moved = 0;
  for(Vertex_index v = 0; v < level.size(); ++v)
    if(!are_equal(level.places()[v], before[v])) {
      ++moved;
      EXPECT_EQ(near.count(v), 1u) << "vertex " << v;
    }
  EXPECT_GT(moved, 40u);
}

// As by Newton's method on these parts until nothing moves any more, but for what is left on purpose.
TEST(Turned_parts, the_energy_falls_to_the_least_of_the_parts)
{
  Turned_map map(1.);
  Level& level = *map.level;
  const SMP_internal::Newton_steps newton = one_step(level);
  const double before = level.value();
  std::vector<bool> is_fixed(level.size(), true);
  const auto parts = SMP_internal::parts_around(
    level, SMP_internal::turned_triangles(level, newton.last_step(), 0.1), level.size() / 20);
  for(const auto& part : parts)
    for(std::size_t i = 0; i < part.vertices.size(); ++i)
      if(!part.is_fixed[i])
        is_fixed[part.vertices[i]] = false;
  Level best(map.mesh.triangles, [&](std::size_t t) { return level.reference(t); }, level.places(), is_fixed,
             level.energy());
  SMP_internal::Newton_steps steps;
  steps.add_level(nullptr);
  for(int i = 0; i < 30; ++i)
    steps(best, 20);
  const double gain = SMP_internal::relax_turned_parts(level, newton, 1e-3);
  EXPECT_NEAR(gain, before - level.value(), 1e-12 * before);
  EXPECT_GT(gain, 0.98 * (before - best.value()));
  EXPECT_GT(before - best.value(), 1e-4 * before);
  EXPECT_GE(level.value(), (1. - 1e-12) * best.value());
  EXPECT_EQ(level.energy_at(level.places()), level.value()); // and not infinity
}

TEST(Turned_parts, parts_are_apart_and_have_all_triangles_at_what_moves)
{
  Turned_map map(1.);
  Level& level = *map.level;
  const SMP_internal::Newton_steps newton = one_step(level);
  for(const std::size_t most : {std::size_t(40), level.size() / 20, level.size()}) {
    const auto parts = SMP_internal::parts_around(
      level, SMP_internal::turned_triangles(level, newton.last_step(), 0.1), most);
    ASSERT_GE(parts.size(), 2u);
    std::vector<int> number(level.size(), 0); // of the parts in which it moves
    for(const auto& part : parts) {
      std::set<std::uint32_t> at_moving;
      for(std::size_t i = 0; i < part.vertices.size(); ++i) {
        const Vertex_index v = part.vertices[i];
        if(part.is_fixed[i])
          continue;
        ++number[v];
        for(const auto* c = level.corners().begin(v); c != level.corners().end(v); ++c)
          at_moving.insert(std::uint32_t(CGAL::Indexed_mesh::triangle_of(*c)));
      }
      EXPECT_EQ(std::vector<std::uint32_t>(at_moving.begin(), at_moving.end()), part.faces);
      ASSERT_EQ(part.triangles.size(), part.faces.size());
      for(std::size_t t = 0; t < part.faces.size(); ++t)
        for(int k = 0; k < 3; ++k)
          EXPECT_EQ(part.vertices[part.triangles[t][k]], level.triangles()[part.faces[t]][k]);
    }
    EXPECT_LE(*std::max_element(number.begin(), number.end()), 1);
    const std::size_t moving = std::size_t(std::count(number.begin(), number.end(), 1));
    EXPECT_GE(moving, 40u);
    if(most == 40) { // there are more in turned triangles alone, the last of which may have two more
      EXPECT_LE(moving, most + 2);
    }
  }
}

TEST(Turned_parts, held_vertices_stay)
{
  std::vector<bool> is_fixed(side * side, false);
  for(std::size_t v = 0; v < is_fixed.size(); v += 3)
    is_fixed[v] = true;
  Turned_map map(0.5, is_fixed);
  Level& level = *map.level;
  const std::vector<Plane_point> before = level.places();
  const SMP_internal::Newton_steps newton = one_step(level);
  EXPECT_GT(SMP_internal::relax_turned_parts(level, newton, 1e-3), 0.);
  for(std::size_t v = 0; v < is_fixed.size(); v += 3)
    EXPECT_TRUE(are_equal(level.places()[v], before[v])) << "vertex " << v;
}

TEST(Turned_parts, the_result_does_not_depend_on_threads)
{
  std::vector<std::vector<Plane_point>> places;
  for(const unsigned int threads : {1u, 2u, 5u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    Turned_map map(1.);
    SMP_internal::relax_turned_parts(*map.level, one_step(*map.level), 1e-3);
    places.push_back(map.level->places());
    EXPECT_TRUE(std::equal(places[0].begin(), places[0].end(), places.back().begin(), are_equal))
      << threads << " threads";
  }
}

// Steps that went nowhere turned nothing.
TEST(Turned_parts, without_a_step_nothing_moves)
{
  Turned_map map(1.);
  const std::vector<Plane_point> before = map.level->places();
  EXPECT_EQ(SMP_internal::relax_turned_parts(*map.level, SMP_internal::Newton_steps(), 1e-3), 0.);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), map.level->places().begin(), are_equal));
}

} // namespace relax_turned_parts_test
