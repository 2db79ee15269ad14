// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progressive mesh and what is made of it, over groups of generated and real meshes and the
// three ways to decimate, against plain replays of the collapses and against the definitions.

#include <support/indexed_mesh_files.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>
#include <support/progressive_models.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/squared_distance_3.h>

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
using CGAL::Indexed_mesh::Ring_defect;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Surface_mesh;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

constexpr std::uint64_t seed = 20260;
const std::string seed_text = ", seed " + std::to_string(seed);

// --- Ways to decimate

enum class Engine { BATCHED, STRICT, CGAL };
constexpr std::array<Engine, 3> all_engines = {Engine::BATCHED, Engine::STRICT, Engine::CGAL};

std::string name_of(Engine engine)
{
  return engine == Engine::BATCHED ? "batched" : engine == Engine::STRICT ? "strict" : "CGAL";
}

SMM::Flat_collapse_options flat_options(SMM::Collapse_order order, std::size_t target_vertices)
{
  SMM::Flat_collapse_options options;
  options.order = order;
  options.target_vertices = target_vertices;
  return options;
}

Progressive_mesh decimate(Indexed_triangle_mesh mesh, Engine engine, std::size_t target_vertices,
                          const std::vector<bool>& is_locked = {})
{
  CGAL::Indexed_mesh::normalize(mesh);
  if(engine == Engine::CGAL) {
    SMM::Progressive_mesh_options options;
    options.target_vertices = target_vertices;
    options.is_locked = is_locked;
    return SMM::progressive_mesh_by_edge_collapse(mesh, options);
  }
  return SMM::Flat_collapse_engine<>(mesh, Vertex_rings(mesh), is_locked)
    .run(flat_options(engine == Engine::STRICT ? SMM::Collapse_order::STRICT
                                               : SMM::Collapse_order::BATCHED, target_vertices));
}

std::vector<bool> random_locks(std::size_t size, double part, std::uint64_t lock_seed)
{
  Random random(lock_seed);
  std::vector<bool> result(size);
  for(std::size_t v = 0; v < size; ++v)
    result[v] = uniform(random, 0., 1.) < part;
  return result;
}

// A decimation to the end.
struct Decimation
{
  Engine engine;
  const Indexed_triangle_mesh& mesh;
  std::vector<bool> is_locked;
  Progressive_mesh pm;
};

// Calls use(run) for all generated meshes and all engines.
template <class Use>
void for_each_run(double locked_part, const Use& use)
{
  for(const Named_mesh& input : generated_meshes(seed))
    for(const Engine engine : all_engines) {
      SCOPED_TRACE(input.name + ", " + name_of(engine) + seed_text);
      const auto is_locked = random_locks(input.mesh.points.size(), locked_part, seed);
      use(Decimation{engine, input.mesh, is_locked, decimate(input.mesh, engine, 0, is_locked)});
    }
}

bool is_equal(const std::vector<Halfedge_collapse>& a, const std::vector<Halfedge_collapse>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Halfedge_collapse& x, const Halfedge_collapse& y) {
                      return x.removed == y.removed && x.kept == y.kept;
                    });
}

// --- The properties find what they should

TEST(Mesh_properties, topology_counts_and_finds_defects)
{
  const Topology topology = topology_of(with_holes(torus(12, 8), 2, seed).triangles);
  EXPECT_EQ(topology.euler_characteristic(), -2);
  EXPECT_EQ(topology.border_loops, 2u);
  EXPECT_EQ(topology.defect, "");
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
  const auto error = [&pm](const std::vector<Halfedge_collapse>& collapses,
                           const std::vector<bool>& is_locked = {}) {
    pm.collapses = collapses;
    return error_in_collapses(pm, is_locked);
  };
  EXPECT_EQ(error({{12, 6}, {7, 6}}), "");
  EXPECT_EQ(error_in_levels(pm), "");
  EXPECT_NE(error({{12, 6}, {12, 13}}), "");                    // removed twice
  EXPECT_NE(error({{12, 6}, {7, 12}}), "");                     // into a removed one
  EXPECT_NE(error({{12, 9}}), "");                              // no edge
  EXPECT_NE(error({{2, 8}}), "");                               // off the border
  EXPECT_NE(error({{12, 6}}, std::vector<bool>(25, true)), ""); // locked
  pm.batch_ends = {2, 1};
  EXPECT_NE(error({{12, 6}, {7, 6}}), "");
  pm = SMM::trivial_progressive_mesh(10);
  pm.triangles = grid(4, 1).triangles;
  pm.collapses = {{2, 8}}; // across the strip
  EXPECT_NE(error_in_levels(pm), "");
  pm.collapses = {{0, 1}, {1, 6}, {5, 6}}; // folds a triangle, which takes a vertex with it
  EXPECT_NE(error_in_levels(pm), "");
}

// --- Vertex_rings

// The ring of v, its smallest vertex first if it is closed.
std::vector<Vertex_index> canonical_ring(const Vertex_rings& rings, Vertex_index v)
{
  std::vector<Vertex_index> result(rings.ring(v), rings.ring(v) + rings.degree(v));
  if(!rings.is_border(v))
    std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

std::uint32_t position_in_ring(const Vertex_rings& rings, Vertex_index v, Vertex_index neighbor)
{
  const Vertex_index* r = rings.ring(v);
  return std::uint32_t(std::find(r, r + rings.degree(v), neighbor) - r);
}

std::string error_in_rings(const Vertex_rings& rings, const Indexed_triangle_mesh& mesh,
                           const std::vector<Halfedge_collapse>& collapses)
{
  Replay replay(mesh.triangles, mesh.points.size());
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(const Halfedge_collapse& c : collapses) {
    replay.collapse(c);
    is_gone[c.removed] = true;
  }
  const Vertex_rings rebuilt(Indexed_triangle_mesh{mesh.points, replay.triangles()});
  for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
    const std::string which = "vertex " + std::to_string(v) + " after "
                            + std::to_string(collapses.size()) + " collapses";
    if(is_gone[v])
      continue;
    if(rings.is_border(v) != rebuilt.is_border(v) || rings.is_border(v) != replay.is_border(v))
      return "wrong border flag of " + which;
    if(canonical_ring(rings, v) != canonical_ring(rebuilt, v))
      return "wrong ring of " + which;
    if(rings.small_degree(v) != int((std::min)(rings.degree(v), std::uint32_t(255))))
      return "wrong small degree of " + which;
  }
  return {};
}

TEST(Vertex_rings, follow_random_collapses)
{
  std::vector<Named_mesh> inputs = generated_meshes(seed);
  inputs.push_back({"wheel of 300", fan(300)});
  for(const Named_mesh& input : inputs) {
    SCOPED_TRACE(input.name + seed_text);
    const Progressive_mesh pm = random_collapses(input.mesh, 0, seed);
    EXPECT_EQ(error_in_progressive_mesh(input.mesh, pm), "");
    Vertex_rings rings(input.mesh);
    ASSERT_EQ(rings.defect(), Ring_defect::NONE);
    std::vector<Halfedge_collapse> done;
    EXPECT_EQ(error_in_rings(rings, input.mesh, done), "");
    for(const Halfedge_collapse& c : pm.collapses) {
      rings.collapse(c.removed, position_in_ring(rings, c.removed, c.kept));
      done.push_back(c);
      if(done.size() % 16 == 0 || done.size() == pm.collapses.size()) {
        ASSERT_EQ(error_in_rings(rings, input.mesh, done), "");
      }
    }
  }
}

// The definition: the collapse leaves a manifold of the same topology with one vertex less, and a
// border vertex does not leave the border.
bool is_collapse_valid_by_definition(const std::vector<Triangle_indices>& triangles,
                                     std::size_t number_of_vertices, Halfedge_collapse collapse)
{
  Replay replay(triangles, number_of_vertices);
  if(replay.is_border(collapse.removed)
     && replay.number_of_triangles_at_edge(collapse.removed, collapse.kept) != 1)
    return false;
  replay.collapse(collapse);
  const Topology before = topology_of(triangles), after = topology_of(replay.triangles());
  return after.defect.empty() && after.vertices + 1 == before.vertices
      && after.euler_characteristic() == before.euler_characteristic()
      && after.border_loops == before.border_loops && after.components == before.components;
}

TEST(Vertex_rings, validity_is_the_definition)
{
  const std::vector<Named_mesh> inputs = {
    {"triangle", without_vertices(grid(1, 1), {true, true, false, true})},
    {"square", grid(1, 1)},
    {"grid", irregular_grid(5, 4, seed)},
    {"holes", with_holes(irregular_grid(8, 7, seed), 4, seed)},
    {"sphere", sphere(1)},
    {"octahedron", sphere(0)},
    {"torus", torus(4, 4)},
    {"torus with a hole", with_holes(torus(5, 4), 1, seed)},
    {"cylinder", cylinder(4, 3)},
    {"wheel", fan(7)},
  };
  std::size_t valid = 0, invalid = 0;
  for(const Named_mesh& input : inputs)
    for(std::uint64_t run = 0; run < 6; ++run) {
      SCOPED_TRACE(input.name + seed_text + " + " + std::to_string(run));
      const std::size_t n = input.mesh.points.size();
      const Progressive_mesh pm = random_collapses(input.mesh, n / 6 * (6 - run), seed + run);
      const auto triangles = SMM::triangles_after(pm, pm.collapses.size());
      const Vertex_rings rings(Indexed_triangle_mesh{input.mesh.points, triangles});
      for(Vertex_index v = 0; v < n; ++v)
        for(std::uint32_t k = 0; k < rings.degree(v); ++k) {
          const bool is_valid = rings.is_collapse_valid(v, k);
          EXPECT_EQ(is_valid, is_collapse_valid_by_definition(triangles, n, {v, rings.ring(v)[k]}))
            << v << " into " << rings.ring(v)[k];
          (is_valid ? valid : invalid) += 1;
        }
    }
  EXPECT_GT(valid, 1000u);
  EXPECT_GT(invalid, 1000u);
}

TEST(Vertex_rings, smallest_surfaces_stay)
{
  const auto number_of_valid_collapses = [](const Indexed_triangle_mesh& mesh) {
    const Vertex_rings rings(mesh);
    std::size_t number = 0;
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      for(std::uint32_t k = 0; k < rings.degree(v); ++k)
        number += rings.is_collapse_valid(v, k) ? 1 : 0;
    return number;
  };
  const std::vector<Point_3> points(6, Point_3(0, 0, 0));
  EXPECT_EQ(number_of_valid_collapses({points, {{0, 1, 2}, {3, 4, 5}}}), 0u); // two triangles
  EXPECT_EQ(number_of_valid_collapses({{points.begin(), points.begin() + 4},
                                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}), 0u);
  // A triangle with a triangular hole
  EXPECT_EQ(number_of_valid_collapses({points, {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4},
                                                {2, 0, 5}, {0, 3, 5}}}), 0u);
}

TEST(Vertex_rings, defects_are_named)
{
  const auto defect_of = [](Vertex_index vertices, std::vector<Triangle_indices> triangles) {
    const Vertex_rings rings(
      Indexed_triangle_mesh{std::vector<Point_3>(vertices, Point_3(0, 0, 0)), triangles});
    return std::make_pair(rings.defect(), rings.defective_vertex());
  };
  typedef std::pair<Ring_defect, Vertex_index> Defect;
  EXPECT_EQ(defect_of(3, {{0, 1, 2}}), Defect(Ring_defect::NONE, CGAL::Indexed_mesh::no_vertex));
  EXPECT_EQ(defect_of(4, {{0, 1, 2}}), Defect(Ring_defect::ISOLATED, 3));
  EXPECT_EQ(defect_of(5, {{1, 2, 0}, {3, 4, 0}}), Defect(Ring_defect::SEVERAL_FANS, 0));
  EXPECT_EQ(defect_of(4, {{0, 1, 2}, {0, 1, 3}}), Defect(Ring_defect::REPEATED_HALFEDGE, 0));
  EXPECT_EQ(defect_of(4, {{2, 0, 1}, {3, 0, 1}}).first, Ring_defect::REPEATED_HALFEDGE);
  // The same at a hub with more triangles than a line holds
  std::vector<Triangle_indices> wheel = fan(40).triangles;
  EXPECT_EQ(defect_of(41, wheel).first, Ring_defect::NONE);
  wheel.push_back({0, 41, 42});
  EXPECT_EQ(defect_of(43, wheel), Defect(Ring_defect::SEVERAL_FANS, 0));
  wheel.back() = {0, 1, 41};
  EXPECT_EQ(defect_of(42, wheel), Defect(Ring_defect::REPEATED_HALFEDGE, 0));
  wheel.erase(wheel.begin() + 10);
  wheel.back() = wheel[20];
  EXPECT_EQ(defect_of(41, wheel), Defect(Ring_defect::REPEATED_HALFEDGE, 0));
}

// --- All engines

TEST(Progressive_mesh, keeps_topology_and_border_and_restores_exactly)
{
  for_each_run(0., [](const Decimation& run) {
    EXPECT_EQ(error_in_progressive_mesh(run.mesh, run.pm, run.is_locked, seed), "");
  });
}

TEST(Progressive_mesh, locked_vertices_stay)
{
  for_each_run(0.2, [](const Decimation& run) {
    EXPECT_EQ(error_in_progressive_mesh(run.mesh, run.pm, run.is_locked, seed), "");
  });
  for_each_run(1., [](const Decimation& run) { EXPECT_EQ(run.pm.collapses.size(), 0u); });
}

TEST(Progressive_mesh, is_the_same_in_every_run)
{
  for_each_run(0.1, [](const Decimation& run) {
    const Progressive_mesh again = decimate(run.mesh, run.engine, 0, run.is_locked);
    EXPECT_TRUE(is_equal(run.pm.collapses, again.collapses));
    EXPECT_EQ(run.pm.batch_ends, again.batch_ends);
  });
}

TEST(Progressive_mesh, ends_at_the_target)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(30, 30, seed), 1., seed);
  for(const Engine engine : all_engines)
    for(const std::size_t target : {961, 960, 700, 300, 150, 100}) {
      SCOPED_TRACE(name_of(engine) + seed_text + ", target " + std::to_string(target));
      const Progressive_mesh pm = decimate(mesh, engine, target);
      EXPECT_EQ(pm.number_of_vertices_after(pm.collapses.size()), target);
      EXPECT_EQ(pm.batch_ends.empty(), engine != Engine::BATCHED || pm.collapses.empty());
    }
}

TEST(Progressive_mesh, real_meshes)
{
  const std::vector<Named_mesh> inputs = real_meshes_if_any(
    {"lion-head.off", "mannequin-devil.off", "three_peaks.off", "refined_elephant.off",
     "mech-holes-shark.off", "bunny.ply"});
  for(const Named_mesh& input : inputs)
    for(const Engine engine : all_engines) {
      SCOPED_TRACE(input.name + ", " + name_of(engine) + seed_text);
      if(engine != Engine::BATCHED && input.mesh.points.size() > 15000)
        continue; // for the time it takes
      const auto is_locked = random_locks(input.mesh.points.size(), 0.001, seed);
      const Progressive_mesh pm = decimate(input.mesh, engine, 500, is_locked);
      EXPECT_GT(pm.collapses.size(), input.mesh.points.size() / 2);
      EXPECT_EQ(error_in_collapses(pm, is_locked), "");
      EXPECT_EQ(error_in_levels(pm, 8), "");
      EXPECT_EQ(error_in_walks(pm, seed, 1), "");
    }
}

TEST(Progressive_mesh, hub_of_degree_10000)
{
  const Indexed_triangle_mesh mesh = fan(10000);
  for(const Engine engine : {Engine::BATCHED, Engine::STRICT}) {
    SCOPED_TRACE(name_of(engine));
    const Progressive_mesh pm = decimate(mesh, engine, 100);
    EXPECT_EQ(pm.number_of_vertices_after(pm.collapses.size()), 100u);
    for(const Halfedge_collapse& c : pm.collapses)
      ASSERT_NE(c.removed, 0u);
    EXPECT_EQ(error_in_levels(pm, 5), "");
    EXPECT_EQ(error_in_walks(pm, seed, 3), "");
  }
}

// --- What a progressive mesh says about its levels

TEST(Progressive_mesh, ancestors_and_removal_times)
{
  for(const Named_mesh& input : generated_meshes(seed)) {
    SCOPED_TRACE(input.name + seed_text);
    const Progressive_mesh pm = random_collapses(input.mesh, 0, seed);
    std::vector<Vertex_index> ancestor(pm.number_of_vertices), time(pm.number_of_vertices);
    for(Vertex_index v = 0; v < ancestor.size(); ++v)
      ancestor[v] = v;
    time.assign(time.size(), Vertex_index(pm.collapses.size() + 1));
    for(std::size_t k = 0; k <= pm.collapses.size(); ++k) {
      if(k > 0) { // forwards, vertex by vertex
        std::replace(ancestor.begin(), ancestor.end(), pm.collapses[k - 1].removed,
                     pm.collapses[k - 1].kept);
        time[pm.collapses[k - 1].removed] = Vertex_index(k);
      }
      ASSERT_EQ(SMM::ancestors_after(pm, k), ancestor) << "after " << k << " collapses";
    }
    EXPECT_EQ(SMM::removal_times(pm), time);
  }
}

TEST(Progressive_mesh_cursor, names_the_triangles_that_a_collapse_changed)
{
  for(const Named_mesh& input : generated_meshes(seed)) {
    SCOPED_TRACE(input.name + seed_text);
    const Progressive_mesh pm = random_collapses(input.mesh, 0, seed);
    Progressive_mesh_cursor cursor(pm);
    EXPECT_TRUE(cursor.last_changed_triangles().empty());
    while(cursor.position() < pm.collapses.size()) {
      const auto before = cursor.triangles();
      cursor.collapse();
      std::vector<std::uint32_t> changed = cursor.last_changed_triangles(), expected;
      for(std::uint32_t t = 0; t < before.size(); ++t)
        if(cursor.is_alive(t) && cursor.triangles()[t] != before[t])
          expected.push_back(t);
      std::sort(changed.begin(), changed.end());
      ASSERT_EQ(changed, expected) << "at position " << cursor.position();
    }
  }
}

// --- Hierarchies

TEST(Mesh_hierarchy, cuts_are_about_the_ratio_apart)
{
  Progressive_mesh pm = SMM::trivial_progressive_mesh(100000);
  pm.collapses.resize(99000);
  SMM::Hierarchy_options options;
  for(const double ratio : {2., 4., 10.})
    for(const bool has_batches : {false, true}) {
      options.ratio = ratio;
      pm.batch_ends.clear();
      for(double left = 1e5 / 1.3; has_batches && left > 1000.; left /= 1.3)
        pm.batch_ends.push_back(100000 - std::size_t(left));
      if(has_batches)
        pm.batch_ends.push_back(pm.collapses.size());
      const std::vector<std::size_t> cuts = SMM::level_cuts(pm, options);
      ASSERT_GT(cuts.size(), 1u);
      EXPECT_EQ(cuts.front(), 0u);
      // Down to 2000 vertices the number of steps is log 50 / log ratio, rounded.
      EXPECT_EQ(cuts.size() - 1, std::size_t(std::lround(std::log(50.) / std::log(ratio))));
      for(std::size_t i = 1; i < cuts.size(); ++i) {
        ASSERT_GT(cuts[i], cuts[i - 1]);
        const double seen = double(100000 - cuts[i - 1]) / double(100000 - cuts[i]);
        // Rounding the number of steps and cutting at the ends of batches change the ratio
        EXPECT_LT(std::abs(std::log(seen / ratio)), std::log(1.3) + std::log(ratio) / 4.);
        EXPECT_TRUE(!has_batches || std::binary_search(pm.batch_ends.begin(), pm.batch_ends.end(),
                                                       cuts[i]));
      }
    }
  options.coarsest_size = 200000; // nothing to do
  EXPECT_EQ(SMM::level_cuts(pm, options), std::vector<std::size_t>(1, 0));
  options.coarsest_size = 10; // not reached
  EXPECT_EQ(SMM::level_cuts(pm, options).back(), pm.collapses.size());
}

SMM::Hierarchy_options small_hierarchy(SMM::Prolongation_rule rule)
{
  SMM::Hierarchy_options options;
  options.ratio = 3.;
  options.coarsest_size = 12;
  options.rule = rule;
  return options;
}

constexpr std::array<SMM::Prolongation_rule, 2> all_rules
  = {SMM::Prolongation_rule::WALK, SMM::Prolongation_rule::VSPLIT};

// The triangles of a level with the vertices of the fine mesh.
std::vector<Triangle_indices> fine_triangles(const SMM::Mesh_level& level)
{
  std::vector<Triangle_indices> result;
  for(const auto& [a, b, c] : level.mesh.triangles)
    result.push_back({level.vertices[a], level.vertices[b], level.vertices[c]});
  return result;
}

TEST(Mesh_hierarchy, levels_are_those_of_the_progressive_mesh)
{
  for_each_run(0., [](const Decimation& run) {
    const auto options = small_hierarchy(SMM::Prolongation_rule::WALK);
    const std::vector<std::size_t> cuts = SMM::level_cuts(run.pm, options);
    const auto levels = SMM::build_hierarchy(run.mesh, run.pm, options);
    ASSERT_EQ(levels.size(), cuts.size());
    EXPECT_EQ(levels.back().mesh.triangles, run.mesh.triangles);
    EXPECT_EQ(levels.back().mesh.points, run.mesh.points);
    for(std::size_t l = 0; l < levels.size(); ++l) {
      const SMM::Mesh_level& level = levels[l];
      const std::size_t k = cuts[cuts.size() - 1 - l];
      EXPECT_EQ(fine_triangles(level), SMM::triangles_after(run.pm, k));
      ASSERT_EQ(level.vertices.size(), run.pm.number_of_vertices_after(k));
      for(std::size_t v = 0; v < level.vertices.size(); ++v) {
        EXPECT_EQ(level.mesh.points[v], run.mesh.points[level.vertices[v]]);
        EXPECT_EQ(level.position(level.vertices[v]), v);
      }
    }
  });
}

// What holds for any rule: coarse vertices keep their value; the others get weights in [0, 1] with
// the sum 1, of vertices that are known by then.
std::string error_in_stencils(const SMM::Mesh_level& coarse, const SMM::Mesh_level& fine)
{
  const SMM::Prolongation& p = fine.from_coarser;
  std::vector<bool> is_known(fine.vertices.size(), false);
  if(p.kept().size() != coarse.vertices.size() || p.number_of_fine_vertices() != is_known.size())
    return "a wrong number of vertices";
  for(std::size_t j = 0; j < p.kept().size(); ++j) {
    if(fine.vertices[p.kept()[j]] != coarse.vertices[j])
      return "a wrong kept vertex";
    is_known[p.kept()[j]] = true;
  }
  for(const auto& s : p.stencils()) {
    double sum = 0.;
    for(int c = 0; c < 3; ++c) {
      if(!is_known[s.source[c]])
        return "vertex " + std::to_string(s.vertex) + " comes before what it needs";
      if(!(s.weight[c] >= 0.f && s.weight[c] <= 1.f))
        return "the weight " + std::to_string(s.weight[c]);
      sum += double(s.weight[c]);
    }
    if(is_known[s.vertex])
      return "two values for vertex " + std::to_string(s.vertex);
    if(!(std::abs(sum - 1.) < 4. * std::numeric_limits<float>::epsilon()))
      return "weights with the sum " + std::to_string(sum);
    is_known[s.vertex] = true;
  }
  return {};
}

// The weights are those of the point of the triangle that is nearest to the vertex.
std::string error_in_positions(const SMM::Mesh_level& fine)
{
  const auto& x = fine.mesh.points;
  for(const auto& s : fine.from_coarser.stencils()) {
    CGAL::Vector_3<Kernel> offset(0., 0., 0.);
    double size = 0.;
    for(int c = 0; c < 3; ++c) {
      offset = offset + double(s.weight[c]) * (x[s.source[c]] - x[s.vertex]);
      size = (std::max)(size, std::sqrt(CGAL::squared_distance(x[s.source[c]], x[s.vertex])));
    }
    const Kernel::Triangle_3 triangle(x[s.source[0]], x[s.source[1]], x[s.source[2]]);
    // CGAL's distance needs a triangle with an area
    if(triangle.squared_area() < 1e-8 * size * size * size * size)
      continue;
    const double excess = std::sqrt(offset.squared_length())
                        - std::sqrt(CGAL::squared_distance(x[s.vertex], triangle));
    if(!(excess < 1e-4 * size)) // single precision, in triangles with angles down to 1e-2
      return "vertex " + std::to_string(s.vertex) + " is " + std::to_string(excess / size)
           + " of the size of its triangle off the nearest point";
  }
  return {};
}

// VSPLIT: no triangle that fills the place of a vertex right after its collapse is nearer.
std::string error_in_vsplit_choice(const SMM::Mesh_level& fine, const Progressive_mesh& pm,
                                   std::size_t first)
{
  const auto& x = fine.mesh.points;
  Progressive_mesh_cursor cursor(pm);
  cursor.move_to(first);
  const auto& stencils = fine.from_coarser.stencils();
  for(auto s = stencils.rbegin(); s != stencils.rend(); ++s) {
    if(pm.collapses[cursor.position()].removed != fine.vertices[s->vertex])
      return "stencils are not in the order of the vertex splits";
    cursor.collapse();
    double size = 0.;
    for(const Vertex_index v : s->source)
      size = (std::max)(size, CGAL::squared_distance(x[v], x[s->vertex]));
    const auto squared_distance_of = [&](const Triangle_indices& t) {
      return double(SMM::internal::nearest_in_triangle(x, t, x[s->vertex]).squared_distance);
    };
    const double chosen = squared_distance_of(s->source);
    for(const std::uint32_t t : cursor.last_changed_triangles()) {
      Triangle_indices local = cursor.triangles()[t];
      for(Vertex_index& v : local)
        v = Vertex_index(fine.position(v));
      if(squared_distance_of(local) < chosen - 1e-5 * size) // single precision
        return "vertex " + std::to_string(s->vertex) + " has a nearer triangle";
    }
  }
  return {};
}

TEST(Prolongation, stencils_are_nearest_points)
{
  for_each_run(0., [](const Decimation& run) {
    for(const SMM::Prolongation_rule rule : all_rules) {
      const auto options = small_hierarchy(rule);
      const std::vector<std::size_t> cuts = SMM::level_cuts(run.pm, options);
      const auto levels = SMM::build_hierarchy(run.mesh, run.pm, options);
      for(std::size_t l = 1; l < levels.size(); ++l) {
        SCOPED_TRACE((rule == SMM::Prolongation_rule::WALK ? "walk, level " : "vsplit, level ")
                     + std::to_string(l));
        EXPECT_EQ(error_in_stencils(levels[l - 1], levels[l]), "");
        EXPECT_EQ(error_in_positions(levels[l]), "");
        if(rule == SMM::Prolongation_rule::VSPLIT) {
          EXPECT_EQ(error_in_vsplit_choice(levels[l], run.pm, cuts[cuts.size() - 1 - l]), "");
        }
      }
    }
  });
}

typedef std::vector<std::complex<double>> Vector;

Vector random_vector(std::size_t size, Random& random)
{
  Vector result(size);
  for(auto& x : result)
    x = {uniform(random, -1., 1.), uniform(random, -1., 1.)};
  return result;
}

std::complex<double> bilinear(const Vector& a, const Vector& b)
{
  std::complex<double> sum = 0.;
  for(std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

TEST(Prolongation, restriction_is_its_transpose_and_constants_stay)
{
  Random random(seed);
  for_each_run(0., [&](const Decimation& run) {
    for(const SMM::Prolongation_rule rule : all_rules) {
      const auto levels = SMM::build_hierarchy(run.mesh, run.pm, small_hierarchy(rule));
      for(std::size_t l = 1; l < levels.size(); ++l) {
        const SMM::Prolongation& p = levels[l].from_coarser;
        const Vector x = random_vector(levels[l - 1].vertices.size(), random);
        const Vector y = random_vector(levels[l].vertices.size(), random);
        Vector px, work = y, ty, ones;
        p.prolongate(x, px);
        p.restrict_in_place(work, ty);
        EXPECT_LT(std::abs(bilinear(px, y) - bilinear(x, ty)), 1e-12 * double(y.size()));
        p.prolongate(Vector(x.size(), {1., -2.}), ones);
        // Every stencil may be off by four roundings, and stands on others: up to 100 in a chain
        for(const auto& one : ones)
          ASSERT_LT(std::abs(one - std::complex<double>(1., -2.)), 1e-4);
      }
    }
  });
}

TEST(Prolongation, reproduces_linear_functions_on_a_plane)
{
  const Indexed_triangle_mesh mesh = irregular_grid(20, 20, seed);
  std::vector<bool> is_corner(mesh.points.size(), false);
  for(const Vertex_index v : grid_corners(20, 20))
    is_corner[v] = true; // so that all levels cover the same square
  const auto linear = [](const Point_3& p) {
    return std::complex<double>(0.3 + 2. * p.x() - p.y(), p.x() + 0.5 * p.y());
  };
  for(const Engine engine : all_engines)
    for(const SMM::Prolongation_rule rule : all_rules) {
      SCOPED_TRACE(name_of(engine) + seed_text);
      const Progressive_mesh pm = decimate(mesh, engine, 0, is_corner);
      const auto levels = SMM::build_hierarchy(mesh, pm, small_hierarchy(rule));
      ASSERT_GT(levels.size(), 3u);
      for(std::size_t l = 1; l < levels.size(); ++l) {
        Vector coarse, fine;
        for(const Point_3& p : levels[l - 1].mesh.points)
          coarse.push_back(linear(p));
        levels[l].from_coarser.prolongate(coarse, fine);
        for(std::size_t v = 0; v < fine.size(); ++v)
          ASSERT_LT(std::abs(fine[v] - linear(levels[l].mesh.points[v])), 1e-4)
            << "level " << l << ", vertex " << v;
      }
    }
}

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
      = SMM::Flat_collapse_engine<Fixed_price, SMS::internal::Accept_all_filter>(
          mesh, rings, {}, cost, SMS::internal::Accept_all_filter())
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
  Indexed_triangle_mesh mesh = with_hills(irregular_grid(200, 200, seed), 5., seed);
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

// --- The recorder

// The triangles as triples of points, each beginning with its smallest.
template <class TriangleMesh>
std::vector<std::array<Point_3, 3>> triangles_as_points(const TriangleMesh& mesh)
{
  std::vector<std::array<Point_3, 3>> result;
  const auto vpm = get(CGAL::vertex_point, mesh);
  for(const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    result.push_back({get(vpm, source(h, mesh)), get(vpm, target(h, mesh)),
                      get(vpm, target(next(h, mesh), mesh))});
  }
  return result;
}

std::vector<std::array<Point_3, 3>> sorted(std::vector<std::array<Point_3, 3>> triangles)
{
  for(auto& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Stop_at
{
  std::size_t edges;
  template <class FT, class Profile, class Size>
  bool operator()(const FT&, const Profile&, Size, Size current) const { return current <= edges; }
};

// Decimates with policies of this package and says how what was recorded differs from the mesh
// that edge_collapse() left.
template <class TriangleMesh, class Cost>
std::string error_in_recording(TriangleMesh& mesh, const Cost& cost,
                               const std::vector<bool>& is_locked)
{
  typedef SMM::Progressive_mesh_recorder<TriangleMesh, Cost> Recorder;
  typedef SMS::Halfedge_collapse_placement<Cost, SMS::internal::Accept_all_filter,
                                           typename Recorder::Vertex_is_locked_map> Placement;
  const auto points = CGAL::Indexed_mesh::copy_points(mesh);
  Recorder recorder(mesh, is_locked, cost);
  SMS::edge_collapse(mesh, Stop_at{40},
                     CGAL::parameters::get_cost(cost).visitor(recorder)
                       .get_placement(Placement(cost, SMS::internal::Accept_all_filter(),
                                                recorder.vertex_is_locked_map()))
                       .edge_is_constrained_map(recorder.edge_is_constrained_map()));
  const Progressive_mesh& pm = recorder.progressive_mesh();
  if(pm.collapses.size() != recorder.number_of_collapses() || pm.collapses.empty())
    return "no collapses";
  const std::string error = error_in_progressive_mesh({points, pm.triangles}, pm, is_locked);
  if(!error.empty())
    return error;
  std::vector<std::array<Point_3, 3>> recorded;
  for(const auto& [a, b, c] : SMM::triangles_after(pm, pm.collapses.size()))
    recorded.push_back({points[a], points[b], points[c]});
  return sorted(recorded) == sorted(triangles_as_points(mesh)) ? "" : "not the mesh that is left";
}

TEST(Progressive_mesh_recorder, records_what_edge_collapse_does)
{
  for(const Named_mesh& input : generated_meshes(seed)) {
    if(input.mesh.points.size() < 60)
      continue;
    SCOPED_TRACE(input.name + seed_text);
    const auto is_locked = random_locks(input.mesh.points.size(), 0.05, seed);
    Surface_mesh surface = SMM::internal::surface_mesh_of(input.mesh), copy = surface;
    Polyhedron polyhedron;
    CGAL::copy_face_graph(surface, polyhedron);
    const SMS::Volume_and_border_area_cost cost;
    EXPECT_EQ(error_in_recording(surface, cost, is_locked), "");
    EXPECT_EQ(error_in_recording(copy, SMS::Edge_length_cost<Surface_mesh>(), is_locked), "");
    // Ids of vertices and halfedges, which a Polyhedron_3 of this kind does not have
    EXPECT_EQ(error_in_recording(polyhedron, cost, is_locked), "");
  }
}

TEST(Progressive_mesh_recorder, edges_without_length)
{
  // A column of the grid lies on the next one; ends of edges without length may be on the border,
  // locked, or both.
  Indexed_triangle_mesh mesh = grid(6, 8);
  for(std::size_t j = 0; j <= 8; ++j)
    for(const std::size_t i : {0, 3})
      mesh.points[7 * j + i] = mesh.points[7 * j + i + 1];
  for(std::uint64_t run = 0; run < 40; ++run) {
    SCOPED_TRACE(seed_text + " + " + std::to_string(run));
    const auto is_locked = random_locks(mesh.points.size(), 0.4, seed + run);
    const Progressive_mesh pm = decimate(mesh, Engine::CGAL, 0, is_locked);
    EXPECT_EQ(error_in_progressive_mesh(mesh, pm, is_locked), "");
  }
}

// --- build_progressive_mesh()

TEST(Build_progressive_mesh, numbers_as_the_mesh_does)
{
  Surface_mesh mesh = SMM::internal::surface_mesh_of(
    shuffled(with_hills(irregular_grid(20, 20, seed), 1., seed), seed));
  // A hole, and numbers that vertices(mesh) and faces(mesh) leave out
  for(const Surface_mesh::Vertex_index v : mesh.vertices())
    if(!mesh.is_border(v) && v.idx() > 100) {
      CGAL::Euler::remove_face(CGAL::Euler::remove_center_vertex(mesh.halfedge(v), mesh), mesh);
      break;
    }
  const std::size_t n = mesh.number_of_vertices();
  ASSERT_EQ(n, 440u);
  SMM::Progressive_mesh_options options;
  options.is_locked = random_locks(n, 0.1, seed);
  options.target_vertices = 100;
  for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
    options.order = order;
    const SMM::Progressive_surface surface = SMM::build_progressive_mesh(mesh, options);
    const Progressive_mesh& pm = surface.progressive_mesh;
    EXPECT_EQ(surface.error, "");
    ASSERT_EQ(pm.collapses.size(), 340u);
    std::size_t i = 0;
    for(const Surface_mesh::Vertex_index v : mesh.vertices())
      EXPECT_EQ(surface.points[i++], mesh.point(v));
    std::vector<std::array<Point_3, 3>> triangles;
    for(const auto& [a, b, c] : pm.triangles)
      triangles.push_back({surface.points[a], surface.points[b], surface.points[c]});
    const auto expected = triangles_as_points(mesh);
    ASSERT_EQ(triangles.size(), expected.size());
    for(std::size_t t = 0; t < triangles.size(); ++t)
      EXPECT_EQ(sorted({triangles[t]}), sorted({expected[t]}));
    EXPECT_EQ(error_in_progressive_mesh({surface.points, pm.triangles}, pm, options.is_locked), "");
  }
  Polyhedron polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  const SMM::Progressive_surface surface = SMM::build_progressive_mesh(polyhedron);
  EXPECT_EQ(surface.error, "");
  EXPECT_EQ(error_in_progressive_mesh({surface.points, surface.progressive_mesh.triangles},
                                      surface.progressive_mesh), "");
}

// A price that depends on the place of the vertex alone.
struct Price_of_place
{
  template <class Profile, class Placement>
  SMS::Optional_of_policies<double> operator()(const Profile& profile, const Placement&) const
  {
    return std::abs(profile.p0().x() - 1000.);
  }
};

TEST(Build_progressive_mesh, policies_of_users_see_the_coordinates_of_the_mesh)
{
  const Surface_mesh mesh
    = SMM::internal::surface_mesh_of(translated(shuffled(grid(12, 12), seed), 1000., 0., 0.));
  SMM::Progressive_mesh_options options;
  options.order = SMM::Collapse_order::STRICT;
  options.target_vertices = 169 - 20;
  const SMM::Progressive_surface surface
    = SMM::build_progressive_mesh(mesh, options, Price_of_place(),
                                  SMS::internal::Accept_all_filter());
  EXPECT_EQ(surface.error, "");
  ASSERT_EQ(surface.progressive_mesh.collapses.size(), 20u);
  for(const Halfedge_collapse& c : surface.progressive_mesh.collapses)
    EXPECT_LE(surface.points[c.removed].x(), 1001.); // the first two of 13 columns
}

TEST(Build_progressive_mesh, refuses_bad_data_in_a_sentence)
{
  const auto error_of = [](const Surface_mesh& mesh) {
    const SMM::Progressive_surface surface = SMM::build_progressive_mesh(mesh);
    EXPECT_TRUE(surface.progressive_mesh.collapses.empty());
    return surface.error;
  };
  const Surface_mesh good = SMM::internal::surface_mesh_of(grid(4, 4));
  Surface_mesh mesh = good;
  EXPECT_NE(error_of(Surface_mesh()), "");
  mesh.add_vertex(Point_3(9, 9, 9));
  EXPECT_EQ(error_of(mesh), "vertex 25 has no face; remove it first");
  mesh = good;
  mesh.point(Surface_mesh::Vertex_index(7)) = Point_3(0, std::nan(""), 0);
  EXPECT_EQ(error_of(mesh), "vertex 7 has a coordinate that is not a finite number");
  mesh = good;
  CGAL::Euler::remove_center_vertex(mesh.halfedge(Surface_mesh::Vertex_index(12)), mesh);
  EXPECT_EQ(error_of(mesh), "not all faces are triangles; triangulate the mesh first");
  mesh = good;
  const auto a = mesh.add_vertex(Point_3(-1, -1, 0)), b = mesh.add_vertex(Point_3(-1, 0, 0));
  mesh.add_face(Surface_mesh::Vertex_index(0), b, a);
  EXPECT_EQ(error_of(mesh), "the faces at vertex 0 do not form one fan; split the vertex first");
  mesh = good;
  for(const auto v : mesh.vertices())
    mesh.point(v) = Point_3(1, 2, 3);
  EXPECT_EQ(error_of(mesh), "all edges are without length");
}

} // namespace progressive_mesh_test
