// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rings of neighbours under collapses, against plain replays, and what finds wrong ones.

#include <support/decimations.h>
#include <support/progressive_models.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vertex_rings_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using namespace decimations;
using CGAL::Indexed_mesh::Ring_defect;

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

TEST(Vertex_rings, follow_random_collapses_and_back)
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
    while(!done.empty()) { // and back
      rings.split(done.back().removed, done.back().kept);
      done.pop_back();
      if(done.size() % 16 == 0) {
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
  // Each end of an edge of four triangles has one fan around the other end
  EXPECT_EQ(defect_of(6, {{3, 5, 4}, {2, 3, 4}, {2, 4, 0}, {2, 0, 1}, {2, 1, 4}, {2, 4, 5}}),
            Defect(Ring_defect::REPEATED_HALFEDGE, 2));
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

// Any few triangles of six vertices, no two of which have the same ones.
std::vector<Triangle_indices> any_triangles(Random& random, std::size_t number)
{
  std::vector<Triangle_indices> all;
  for(Vertex_index a = 0; a < 6; ++a)
    for(Vertex_index b = a + 1; b < 6; ++b)
      for(Vertex_index c = b + 1; c < 6; ++c)
        all.push_back({a, b, c});
  std::vector<Triangle_indices> result;
  for(; result.size() < number; all.pop_back()) {
    std::swap(all[uniform_index(random, all.size())], all.back());
    result.push_back(all.back());
    if(random() % 2 == 0)
      std::swap(result.back()[1], result.back()[2]);
  }
  return result;
}

// Whether the triangles at v are one fan: from each neighbour one of them at most leads on, to another
// one, and that way goes by all.
bool is_one_fan(const std::vector<Triangle_indices>& triangles, Vertex_index v)
{
  std::map<Vertex_index, Vertex_index> next, previous;
  std::size_t number = 0;
  for(const Triangle_indices& t : triangles)
    for(int c = 0; c < 3; ++c)
      if(t[c] == v) {
        next[t[(c + 1) % 3]] = t[(c + 2) % 3];
        previous[t[(c + 2) % 3]] = t[(c + 1) % 3];
        ++number;
      }
  if(number == 0 || next.size() < number || previous.size() < number)
    return false;
  Vertex_index begin = next.begin()->first;
  for(std::size_t i = 0; i < number && previous.count(begin) > 0; ++i)
    begin = previous[begin];
  std::size_t length = 0;
  Vertex_index a = begin;
  do {
    a = next[a];
    ++length;
  } while(a != begin && next.count(a) > 0);
  return length == number;
}

TEST(Vertex_rings, the_first_vertex_without_one_fan_is_found)
{
  Random random(seed);
  std::size_t manifolds = 0;
  for(int i = 0; i < 100000; ++i) {
    const std::vector<Triangle_indices> triangles = any_triangles(random, 1 + random() % 8);
    const Vertex_rings rings(
      Indexed_triangle_mesh{std::vector<Point_3>(6, Point_3(0, 0, 0)), triangles});
    Vertex_index v = 0;
    while(v < 6 && is_one_fan(triangles, v))
      ++v;
    ASSERT_EQ(rings.defective_vertex(), v < 6 ? v : CGAL::Indexed_mesh::no_vertex) << "case " << i;
    manifolds += v == 6;
  }
  EXPECT_GE(manifolds, 100u);
}

} // namespace vertex_rings_test
