// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat engine: its orders, blocks, threads, and what it tells of its progress.

#include <support/decimations.h>
#include <support/progressive_models.h>

#include <CGAL/Blocked_execution/blocked_for.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace flat_collapse_engine_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace decimations;

// --- The flat engine

// A cost that no collapse changes: each vertex has a price.
struct Fixed_price
{
  std::vector<double> price;

  template <class Profile, class OptionalPoint>
  SMS::Optional_of_policies<double> operator()(const Profile& profile, const OptionalPoint&) const
  {
    return price[profile.v0()];
  }
};

// Whether topology lets v go without a ring that grows beyond 14.
bool may_go(const Vertex_rings& rings, Vertex_index v)
{
  if(rings.degree(v) <= 14)
    for(std::uint32_t k = 0; k < rings.degree(v); ++k)
      if(rings.is_collapse_valid(v, k) && !rings.needs_new_spill(v, k))
        return true;
  return false;
}

// The cheapest vertex that may go, of those that could when their ring last changed: a change two
// edges away is noticed only where it takes a possibility away.
TEST(Flat_collapse_engine, strict_order_takes_the_cheapest)
{
  for(const Named_mesh& input : generated_meshes(seed)) {
    SCOPED_TRACE(input.name + seed_text);
    const Indexed_triangle_mesh& mesh = input.mesh;
    Random random(seed);
    Fixed_price cost;
    std::set<std::pair<double, Vertex_index>> candidates;
    Vertex_rings rings(mesh);
    for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
      cost.price.push_back(std::floor(uniform(random, 0., 100.)));
      if(may_go(rings, v))
        candidates.insert({cost.price[v], v});
    }
    const Progressive_mesh pm
      = SMM::Flat_collapse_engine<Fixed_price, SMS::Accept_all_filter>(
          mesh, rings, {}, cost, SMS::Accept_all_filter())
        .run(flat_options(SMM::Collapse_order::STRICT, 0));
    EXPECT_EQ(error_in_progressive_mesh(mesh, pm), "");
    for(const auto& [removed, kept] : pm.collapses) {
      while(!candidates.empty() && !may_go(rings, candidates.begin()->second))
        candidates.erase(candidates.begin());
      ASSERT_FALSE(candidates.empty());
      ASSERT_EQ(removed, candidates.begin()->second);
      candidates.erase(candidates.begin());
      const std::vector<Vertex_index> ring(rings.ring(removed),
                                           rings.ring(removed) + rings.degree(removed));
      rings.collapse(removed, position_in_ring(rings, removed, kept));
      for(const Vertex_index w : ring) {
        candidates.erase({cost.price[w], w});
        if(may_go(rings, w))
          candidates.insert({cost.price[w], w});
      }
    }
    for(const auto& [price, v] : candidates)
      EXPECT_FALSE(may_go(rings, v)) << v << " is left";
  }
}

// A mesh that is large enough for passes of several blocks, which threads share.
TEST(Flat_collapse_engine, blocks_and_threads)
{
  Indexed_triangle_mesh mesh
    = with_holes(with_hills(irregular_grid(280, 280, seed), 20., seed), 300, seed);
  CGAL::Indexed_mesh::normalize(mesh);
  CGAL::Indexed_mesh::sort_spatially(mesh);
  const std::size_t n = mesh.points.size();
  const auto is_locked = random_locks(n, 0.001, seed);
  for(const std::size_t target : {n - 3, std::size_t(70000), std::size_t(5000)}) {
    SCOPED_TRACE("target " + std::to_string(target) + seed_text);
    Progressive_mesh pm;
    for(const unsigned int threads : {1, 2, 3}) {
      const CGAL::Blocked_execution::Thread_scope scope(threads);
      SMM::Flat_collapse_engine<> engine(mesh, Vertex_rings(mesh), is_locked);
      const Progressive_mesh next
        = engine.run(flat_options(SMM::Collapse_order::BATCHED, target));
      EXPECT_TRUE(threads == 1 || is_equal(next.collapses, pm.collapses)) << threads << " threads";
      pm = next;
    }
    EXPECT_EQ(n - pm.collapses.size(), target);
    EXPECT_EQ(error_in_collapses(pm, is_locked), "");
    EXPECT_EQ(error_in_levels(pm, 1), "");
  }
}

// The spread order: no two neighbours go in one pass, any number of threads makes the same collapses,
// and the target is reached.
TEST(Flat_collapse_engine, spread_order_takes_no_two_neighbours)
{
  Indexed_triangle_mesh mesh
    = with_holes(with_hills(irregular_grid(280, 280, seed), 20., seed), 300, seed);
  CGAL::Indexed_mesh::normalize(mesh);
  CGAL::Indexed_mesh::sort_spatially(mesh);
  const std::size_t n = mesh.points.size(), target = 5000;
  const auto is_locked = random_locks(n, 0.001, seed);
  Progressive_mesh pm;
  for(const unsigned int threads : {1, 2, 3}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    SMM::Flat_collapse_engine<> engine(mesh, Vertex_rings(mesh), is_locked);
    const Progressive_mesh next = engine.run(flat_options(SMM::Collapse_order::SPREAD, target));
    EXPECT_TRUE(threads == 1 || is_equal(next.collapses, pm.collapses)) << threads << " threads";
    pm = next;
  }
  EXPECT_EQ(n - pm.collapses.size(), target);
  EXPECT_EQ(error_in_collapses(pm, is_locked), "");
  EXPECT_EQ(error_in_levels(pm, 1), "");
  Vertex_rings rings(mesh);
  std::vector<std::size_t> touched(n, 0); // the last pass, from 1, in which a neighbour went
  std::size_t i = 0, pass = 0;
  for(const std::size_t end : pm.batch_ends) {
    ++pass;
    EXPECT_GT(end - i, pass < 4 ? (n - i) / 8 : 0u) << "pass " << pass << seed_text;
    for(; i < end; ++i) {
      const auto [removed, kept] = pm.collapses[i];
      ASSERT_NE(touched[removed], pass) << removed << seed_text;
      for(std::uint32_t k = 0; k < rings.degree(removed); ++k)
        touched[rings.ring(removed)[k]] = pass;
      rings.collapse(removed, position_in_ring(rings, removed, kept));
    }
  }
  EXPECT_EQ(i, pm.collapses.size());
}

TEST(Flat_collapse_engine, result_does_not_depend_on_size_and_place)
{
  // A power of two, so that the scaled mesh is exactly similar
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(20, 20, seed), 1., seed);
  const auto is_locked = random_locks(mesh.points.size(), 0.02, seed);
  for(const Engine engine : all_engines)
    for(const double factor : {0x1p-100, 0x1p+100}) {
      SCOPED_TRACE(name_of(engine) + seed_text);
      const auto expected = decimate(mesh, engine, 20, is_locked).collapses;
      EXPECT_GT(expected.size(), 300u);
      EXPECT_TRUE(is_equal(expected,
                           decimate(scaled(mesh, factor), engine, 20, is_locked).collapses));
    }
}

// --- Progress and cancelling

TEST(Progress, is_told_and_may_cancel)
{
  const int side = is_sanitized ? 150 : 200;
  Indexed_triangle_mesh mesh = with_hills(irregular_grid(side, side, seed), 5., seed);
  CGAL::Indexed_mesh::normalize(mesh);
  for(const Engine engine : all_engines)
    for(const double last : {0., 0.3, 2.}) {
      if(engine == Engine::CGAL && last > 1.)
        continue; // for the time it takes
      SCOPED_TRACE(name_of(engine) + ", cancelled at " + std::to_string(last) + seed_text);
      std::vector<double> told;
      const auto progress = [&](double part) {
        told.push_back(part);
        return part < last;
      };
      SMM::Progressive_mesh_options edge_options;
      edge_options.target_vertices = 2000;
      edge_options.progress = progress;
      SMM::Flat_collapse_options options
        = flat_options(engine == Engine::STRICT ? SMM::Collapse_order::STRICT
                                                : SMM::Collapse_order::BATCHED, 2000);
      options.progress = progress;
      const Progressive_mesh pm
        = engine == Engine::CGAL
        ? SMM::progressive_mesh_by_edge_collapse(mesh, edge_options)
        : SMM::Flat_collapse_engine<>(mesh, Vertex_rings(mesh), {}).run(options);
      ASSERT_FALSE(told.empty());
      EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
      EXPECT_GE(told.front(), 0.);
      EXPECT_LE(told.back(), 1.);
      const double part = double(pm.collapses.size()) / double(mesh.points.size() - 2000);
      EXPECT_NEAR(part, (std::min)(last, 1.), 0.3); // it asks from time to time only
      EXPECT_EQ(error_in_collapses(pm), "");
      EXPECT_EQ(error_in_levels(pm, 3), "");
    }
}

// --- Layers

// All that the concept CollapseLayer asks for, and no more: it notes what it is told.
class Layer_archetype
{
public:
  static constexpr bool is_active = true;

  void set_rings(const Vertex_rings& rings) { m_rings = &rings; }
  bool is_fixed(Vertex_index v) const { return v % 7 == 0; }
  void begin_pass() { ++passes; }
  bool is_target(Vertex_index, Vertex_index t) const { return t % 5 != 0; }
  float cost(Vertex_index, std::uint32_t) const { return 0.5f; }
  bool is_possible(Vertex_index v, std::uint32_t k, Vertex_index low, Vertex_index high) const
  {
    return low <= v && v < high && k < m_rings->degree(v);
  }
  void collapse(Vertex_index v, std::uint32_t k)
  {
    collapses.push_back({v, m_rings->ring(v)[k]});
  }

  std::vector<Halfedge_collapse> collapses;
  std::size_t passes = 0;

private:
  const Vertex_rings* m_rings = nullptr;
};

TEST(Collapse_layer, has_a_say_and_is_told)
{
  Indexed_triangle_mesh mesh = irregular_grid(30, 30, seed);
  CGAL::Indexed_mesh::normalize(mesh);
  for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
    SMM::Flat_collapse_engine<SMM::Hierarchy_collapse_cost<>, SMM::Hierarchy_collapse_filter,
                              Layer_archetype> engine(mesh, Vertex_rings(mesh), {});
    const Progressive_mesh pm = engine.run(flat_options(order, 0));
    EXPECT_GT(pm.collapses.size(), mesh.points.size() / 5);
    EXPECT_TRUE(is_equal(engine.layer().collapses, pm.collapses)); // by one thread
    EXPECT_GT(engine.layer().passes, 1u);
    for(const Halfedge_collapse& c : pm.collapses) {
      EXPECT_NE(c.removed % 7, 0u);
      EXPECT_NE(c.kept % 5, 0u);
    }
  }
}

} // namespace flat_collapse_engine_test
