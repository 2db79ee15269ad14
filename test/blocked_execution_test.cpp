// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <support/mesh_generators.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Batched_collapses.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <vector>

namespace blocked_execution_test {

namespace BE = CGAL::Blocked_execution;
namespace SMM = CGAL::Surface_mesh_multiresolution;

constexpr std::uint32_t none = std::uint32_t(-1);
constexpr unsigned int numbers_of_threads[] = {1, 2, 3, 8};

std::vector<std::uint32_t> random_keys(std::size_t count, std::uint32_t below, unsigned int seed)
{
  std::mt19937 random(seed);
  std::vector<std::uint32_t> keys(count);
  for(std::uint32_t& key : keys)
    key = std::uint32_t(random() % below);
  return keys;
}

// The order by a stable sort.
std::vector<std::uint32_t> stable_order(const std::vector<std::uint32_t>& keys)
{
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

TEST(Blocked_execution, a_scope_says_how_many_threads_there_are)
{
  EXPECT_EQ(BE::Thread_scope::concurrency(), 1u);
  {
    const BE::Thread_scope one(1);
    EXPECT_EQ(BE::Thread_scope::concurrency(), 1u);
    const BE::Thread_scope three(3);
    EXPECT_LE(BE::Thread_scope::concurrency(), 3u);
    EXPECT_GE(BE::Thread_scope::concurrency(), 1u);
  }
  EXPECT_EQ(BE::Thread_scope::concurrency(), 1u);
}

TEST(Blocked_execution, sort_by_key_is_the_stable_sort_without_the_things_that_have_no_key)
{
  for(const std::uint32_t below : {1u, 5u, 20000u, 90000u}) {
    std::vector<std::uint32_t> keys = random_keys(200000, below, below);
    for(std::size_t i = 0; i < keys.size(); i += 7)
      keys[i] = none;
    std::vector<std::uint32_t> expected = stable_order(keys);
    while(keys[expected.back()] == none)
      expected.pop_back();
    for(const unsigned int threads : numbers_of_threads) {
      const BE::Thread_scope scope(threads);
      std::vector<std::uint32_t> order;
      const auto begin = BE::sort_by_key(
        below,
        [&keys](const auto& use) {
          for(std::uint32_t i = 0; i < keys.size(); ++i)
            use(keys[i], i);
        },
        [&order](std::size_t n) { order.resize(n); },
        [&order](std::uint32_t place, std::uint32_t i) { order[place] = i; });
      ASSERT_EQ(order, expected) << below << " keys, " << threads << " threads";
      ASSERT_EQ(begin.size(), below + 1u);
      EXPECT_EQ(begin.front(), 0u);
      EXPECT_EQ(begin.back(), order.size());
      for(std::uint32_t key = 0; key < below; ++key)
        for(std::uint32_t i = begin[key]; i < begin[key + 1]; ++i)
          ASSERT_EQ(keys[order[i]], key);
    }
  }
}

TEST(Blocked_execution, nothing_can_be_sorted_and_selected)
{
  const BE::Thread_scope scope(2);
  const auto begin = BE::sort_by_key(
    0, [](const auto&) {}, [](std::size_t n) { EXPECT_EQ(n, 0u); },
    [](std::uint32_t, std::uint32_t) {});
  EXPECT_EQ(begin.size(), 1u);
  EXPECT_TRUE(BE::select(0, [](std::uint32_t) { return true; }).empty());
  EXPECT_TRUE(BE::select(9, [](std::uint32_t) { return false; }).empty());
  EXPECT_TRUE(CGAL::Indexed_mesh::sorted_order({}).empty());
}

TEST(Blocked_execution, select_keeps_the_order)
{
  const std::vector<std::uint32_t> keys = random_keys(150001, 3, 11);
  std::vector<std::uint32_t> expected;
  for(std::uint32_t i = 0; i < keys.size(); ++i)
    if(keys[i] == 1)
      expected.push_back(i);
  for(const unsigned int threads : numbers_of_threads) {
    const BE::Thread_scope scope(threads);
    EXPECT_EQ(BE::select(keys.size(), [&](std::uint32_t i) { return keys[i] == 1; }),
              expected);
  }
}

TEST(Blocked_execution, resize_blocked_makes_zeros_and_keeps_what_is_there)
{
  for(const unsigned int threads : numbers_of_threads) {
    const BE::Thread_scope scope(threads);
    std::vector<double> v;
    BE::resize_blocked(v, 700001);
    EXPECT_EQ(v, std::vector<double>(700001, 0.));
    v[5] = 1.;
    BE::resize_blocked(v, 900001);
    EXPECT_EQ(v.size(), 900001u);
    EXPECT_EQ(std::accumulate(v.begin(), v.end(), 0.), 1.);
  }
}

TEST(Blocked_execution, the_spatial_order_is_the_stable_order_of_the_codes)
{
  for(const std::uint32_t below : {3u, 4000u, 0xFFFFFFFFu}) {
    const std::vector<std::uint32_t> keys = random_keys(150000, below, 5);
    const std::vector<std::uint32_t> expected = stable_order(keys);
    for(const unsigned int threads : numbers_of_threads) {
      const BE::Thread_scope scope(threads);
      EXPECT_EQ(CGAL::Indexed_mesh::sorted_order(keys), expected);
    }
  }
}

TEST(Blocked_execution, corners_are_at_their_vertices_in_the_order_of_the_triangles)
{
  const std::size_t n = 40000;
  const std::vector<std::uint32_t> vertices = random_keys(90000, n, 17);
  std::vector<CGAL::Indexed_mesh::Triangle_indices> triangles;
  for(std::size_t i = 0; i < vertices.size(); i += 3)
    triangles.push_back({vertices[i], vertices[i + 1], vertices[i + 2]});
  for(const unsigned int threads : numbers_of_threads) {
    const BE::Thread_scope scope(threads);
    const CGAL::Indexed_mesh::Triangles_at_vertices at(triangles, n);
    ASSERT_EQ(at.number_of_vertices(), n);
    std::size_t sum = 0;
    for(std::uint32_t v = 0; v < n; ++v) {
      sum += at.number(v);
      EXPECT_TRUE(std::is_sorted(at.begin(v), at.end(v)));
      for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner)
        ASSERT_EQ(vertices[*corner], v);
    }
    EXPECT_EQ(sum, vertices.size());
  }
}

// Manifold meshes; a fan has a vertex of more edges than are searched one by one.
TEST(Blocked_execution, what_is_across_an_edge_has_its_ends_the_other_way_round)
{
  const std::vector<CGAL::Indexed_mesh::Triangle_indices> meshes[] = {
    test_support::fan(300).triangles, test_support::shuffled(test_support::grid(90, 90), 19).triangles};
  for(const auto& triangles : meshes) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> halfedge_of;
    for(std::uint32_t h = 0; h < 3 * triangles.size(); ++h)
      halfedge_of[{triangles[h / 3][h % 3], triangles[h / 3][(h + 1) % 3]}] = h;
    for(const unsigned int threads : numbers_of_threads) {
      const BE::Thread_scope scope(threads);
      const CGAL::Indexed_mesh::Triangle_adjacency adjacency(triangles);
      for(const auto& [ends, h] : halfedge_of) {
        const auto across = halfedge_of.find({ends[1], ends[0]});
        ASSERT_EQ(adjacency.opposite(h), across == halfedge_of.end() ? none : across->second);
      }
    }
  }
}

TEST(Blocked_execution, the_nth_cost_is_that_of_the_sorted_ones)
{
  constexpr float infinity = (std::numeric_limits<float>::infinity)();
  std::mt19937 random(23);
  std::normal_distribution<float> normal(0.1f, 1.f);
  std::vector<float> cost(200000);
  for(float& c : cost)
    c = random() % 5 == 0 ? infinity : (random() % 9 == 0 ? 0.f : normal(random));
  const auto members
    = BE::select(cost.size(), [](std::uint32_t i) { return i % 3 != 0; });
  std::vector<float> finite;
  for(const std::uint32_t i : members)
    if(cost[i] < infinity)
      finite.push_back(cost[i]);
  std::sort(finite.begin(), finite.end());
  for(const unsigned int threads : numbers_of_threads) {
    const BE::Thread_scope scope(threads);
    for(const std::size_t place : {std::size_t(0), std::size_t(1), finite.size() / 3,
                                   finite.size() / 2, finite.size() - 1})
      EXPECT_EQ(SMM::internal::nth_cost(members, cost, [&](std::size_t n) {
                  EXPECT_EQ(n, finite.size());
                  return place;
                }),
                finite[place]);
  }
  const std::vector<float> no_cost(cost.size(), infinity);
  EXPECT_EQ(SMM::internal::nth_cost(members, no_cost, [](std::size_t n) { return n - 1; }),
            infinity);
}

} // namespace blocked_execution_test
