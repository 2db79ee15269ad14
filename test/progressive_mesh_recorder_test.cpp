// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recorder of the collapses of CGAL's edge_collapse(), against the mesh that this leaves.

#include <support/decimations.h>

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_recorder.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace progressive_mesh_recorder_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace decimations;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Surface_mesh;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

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
  typedef SMS::Halfedge_collapse_placement<Cost, SMS::Accept_all_filter,
                                           typename Recorder::Vertex_is_locked_map> Placement;
  const auto points = CGAL::Indexed_mesh::copy_points(mesh);
  Recorder recorder(mesh, is_locked, cost);
  SMS::edge_collapse(mesh, Stop_at{40},
                     CGAL::parameters::get_cost(cost).visitor(recorder)
                       .get_placement(Placement(cost, SMS::Accept_all_filter(),
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

} // namespace progressive_mesh_recorder_test
