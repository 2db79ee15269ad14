// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progressive mesh, over groups of generated and real meshes and the three ways to decimate,
// against plain replays of the collapses and against the definitions.

#include <support/decimations.h>
#include <support/indexed_mesh_files.h>
#include <support/progressive_models.h>

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace progressive_mesh_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace decimations;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Surface_mesh;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

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
  if(inputs.empty())
    GTEST_SKIP() << "no real mesh is there";
  for(const Named_mesh& input : inputs)
    for(const Engine engine : all_engines) {
      SCOPED_TRACE(input.name + ", " + name_of(engine) + seed_text);
      if((engine != Engine::BATCHED || is_sanitized) && input.mesh.points.size() > 15000)
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
                                  SMS::Accept_all_filter());
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
  mesh.add_vertex(Point_3(9, 9, 9));
  EXPECT_EQ(error_of(mesh), "vertex 25 has no face; remove it first");
  mesh = good;
  CGAL::Euler::remove_center_vertex(mesh.halfedge(Surface_mesh::Vertex_index(12)), mesh);
  EXPECT_EQ(error_of(mesh), "not all faces are triangles; triangulate the mesh first");
  mesh = good;
  const auto a = mesh.add_vertex(Point_3(-1, -1, 0)), b = mesh.add_vertex(Point_3(-1, 0, 0));
  mesh.add_face(Surface_mesh::Vertex_index(0), b, a);
  EXPECT_EQ(error_of(mesh), "the faces at vertex 0 do not form one fan; split the vertex first");
}

} // namespace progressive_mesh_test
