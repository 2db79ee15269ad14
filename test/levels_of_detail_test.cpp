// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of detail of what a parameterizer has made, from and to CGAL's meshes.

#include <support/conformal_maps.h>
#include <support/textured_mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/Seam_mesh.h>

#include <gtest/gtest.h>

#include <boost/property_map/property_map.hpp>

#include <map>
#include <string>
#include <vector>

namespace levels_of_detail_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
typedef boost::graph_traits<Surface_mesh> Graph_traits;

constexpr std::uint64_t seed = 60441;
const std::string seed_text = ", seed " + std::to_string(seed);

TEST(Levels_of_detail, share_the_map_of_the_parameterizer)
{
  for(const auto& [name, chart] : curved_charts(seed)) {
    Surface_mesh mesh = to_surface_mesh(chart);
    const Uv_map uvmap = new_uv_map(mesh);
    SMP::HLSCM_options options;
    options.keep_progressive_mesh = true;
    options.coarsest_size = 60;
    SMP::HLSCM_parameterizer_3<Surface_mesh> parameterizer(options);
    const auto border = border_halfedge(mesh);
    ASSERT_EQ(SMP::parameterize(mesh, parameterizer, border, uvmap), SMP::OK) << name;
    ASSERT_EQ(parameterizer.progressive_mesh().vertices.size(), chart.points.size()) << name;
    const auto result
      = SMP::build_textured_progressive_mesh(mesh, uvmap, parameterizer.progressive_mesh());
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_numbering(result.mesh), "") << name << seed_text;
    EXPECT_EQ(error_in_textured_levels(result.mesh), "") << name << seed_text;
    for(Vertex_index v = 0; v < result.mesh.points.size(); ++v) {
      const Surface_mesh::Vertex_index source(result.mesh.source_vertex[v]);
      ASSERT_EQ(result.mesh.points[v], mesh.point(source)) << name;
      ASSERT_EQ(result.mesh.uv[v], get(uvmap, source)) << name;
    }

    // The mesh as two arrays has the same levels.
    const SMP::Conformal_map map = SMP::conformal_map(chart, options);
    ASSERT_EQ(map.error, "") << name;
    const auto of_arrays
      = SMP::build_textured_progressive_mesh(chart.points, map.uv, map.progressive_mesh);
    ASSERT_EQ(of_arrays.error, "") << name;
    EXPECT_EQ(of_arrays.mesh.points, result.mesh.points) << name;
    EXPECT_EQ(of_arrays.mesh.uv, result.mesh.uv) << name;
    EXPECT_EQ(of_arrays.mesh.source_vertex, result.mesh.source_vertex) << name;
    EXPECT_EQ(of_arrays.mesh.number_of_collapses(), result.mesh.number_of_collapses()) << name;
  }
}

TEST(Levels_of_detail, are_kept_only_on_demand)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(grid(20, 20), 1., seed));
  SMP::HLSCM_parameterizer_3<Surface_mesh> parameterizer;
  const auto border = border_halfedge(mesh);
  ASSERT_EQ(SMP::parameterize(mesh, parameterizer, border, new_uv_map(mesh)), SMP::OK);
  EXPECT_TRUE(parameterizer.progressive_mesh().vertices.empty());
  EXPECT_TRUE(parameterizer.progressive_mesh().progressive_mesh.collapses.empty());
}

// The levels of a mesh with seams in CGAL's terms: edges marked on a closed surface.
TEST(Levels_of_detail, respect_the_seams_of_a_seam_mesh)
{
  Surface_mesh mesh = to_surface_mesh(sphere(4));
  // Seams along x = 0 in front of a quarter turn: a path that cuts the sphere to a disk
  auto is_seam_edge = mesh.add_property_map<Graph_traits::edge_descriptor, bool>("e:seam", false)
                        .first;
  auto is_seam_vertex
    = mesh.add_property_map<Graph_traits::vertex_descriptor, bool>("v:seam", false).first;
  typedef CGAL::Seam_mesh<Surface_mesh, decltype(is_seam_edge), decltype(is_seam_vertex)> Seam_mesh;
  Seam_mesh seams(mesh, is_seam_edge, is_seam_vertex);
  std::size_t number_of_seams = 0;
  Graph_traits::halfedge_descriptor seam_halfedge = Graph_traits::null_halfedge();
  for(const auto e : edges(mesh)) {
    const auto &p = mesh.point(mesh.vertex(e, 0)), &q = mesh.point(mesh.vertex(e, 1));
    if(p.x() == 0. && q.x() == 0. && p.y() >= 0. && q.y() >= 0.) {
      ASSERT_TRUE(seams.add_seam(mesh.vertex(e, 0), mesh.vertex(e, 1)));
      seam_halfedge = halfedge(e, mesh);
      ++number_of_seams;
    }
  }
  ASSERT_GT(number_of_seams, 20u);
  typedef Surface_mesh::Property_map<Graph_traits::halfedge_descriptor, Uv_map::value_type>
    Halfedge_uv_map;
  const Halfedge_uv_map uvmap
    = mesh.add_property_map<Graph_traits::halfedge_descriptor, Uv_map::value_type>("h:uv").first;
  const boost::graph_traits<Seam_mesh>::halfedge_descriptor border
    = border_halfedge(seams);
  SMP::HLSCM_parameterizer_3<Seam_mesh> parameterizer;
  ASSERT_EQ(SMP::parameterize(seams, parameterizer, border, uvmap), SMP::OK)
    << parameterizer.report().message;

  // The parameter of a vertex of the seam mesh stands at one of its halfedges
  const Textured_triangle_mesh textured = SMM::textured_triangle_mesh(mesh, [&](const auto h) {
    return get(uvmap, target(boost::graph_traits<Seam_mesh>::halfedge_descriptor(h), seams));
  });
  const Textured_triangle_mesh wedged = SMM::with_wedges(textured);
  EXPECT_EQ(wedged.uv.size(), mesh.number_of_vertices() + number_of_seams - 1);
  const auto result = SMM::build_textured_progressive_mesh(textured);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(error_in_numbering(result.mesh), "");
  EXPECT_EQ(error_in_fine_mesh(result.mesh, textured), "");
  EXPECT_EQ(error_in_textured_levels(result.mesh), "");
  const SMM::Level_extractor levels(result.mesh);
  EXPECT_LT(levels.smallest_number_of_triangles(), 200u);
}

// A level goes into any mutable mesh, with its texture coordinates at the corners.
template <class TriangleMesh>
void expect_copy(const Textured_progressive_mesh& pm, const std::vector<Triangle_indices>& level)
{
  typedef boost::graph_traits<TriangleMesh> Traits;
  typedef typename Traits::halfedge_descriptor Halfedge;
  TriangleMesh mesh;
  std::map<Halfedge, Point_2> uv;
  SMM::copy_level(pm, level, mesh, boost::associative_property_map<std::map<Halfedge, Point_2>>(uv));
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  EXPECT_EQ(num_faces(mesh), level.size());
  EXPECT_TRUE(CGAL::is_closed(mesh));
  const Textured_triangle_mesh back
    = SMM::textured_triangle_mesh(mesh, [&](const Halfedge h) { return uv[h]; });
  Textured_progressive_mesh fine; // only its arrays are looked at
  fine.progressive_mesh.triangles = level;
  fine.vertex = pm.vertex;
  fine.uv = pm.uv;
  fine.points = pm.points;
  fine.source_vertex.clear();
  Textured_triangle_mesh expected;
  expected.points = pm.points;
  expected.uv = pm.uv;
  for(const Triangle_indices& t : level) {
    expected.wedges.push_back(t);
    expected.triangles.push_back({pm.vertex[t[0]], pm.vertex[t[1]], pm.vertex[t[2]]});
  }
  ASSERT_EQ(back.triangles.size(), level.size());
  for(std::size_t t = 0; t < level.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      bool is_found = false;
      for(int d = 0; d < 3; ++d)
        is_found |= back.points[back.triangles[t][c]] == expected.points[expected.triangles[t][d]]
                 && back.uv[back.wedges[t][c]] == expected.uv[expected.wedges[t][d]];
      ASSERT_TRUE(is_found) << "triangle " << t;
    }
}

TEST(Levels_of_detail, go_into_meshes_of_cgal)
{
  const auto result = SMM::build_textured_progressive_mesh(cube_mapped(sphere(4)));
  ASSERT_EQ(result.error, "");
  const SMM::Level_extractor levels(result.mesh);
  for(const std::size_t n : {2000u, 500u}) {
    const auto level = levels.triangles(levels.position_of_triangles(n));
    expect_copy<Surface_mesh>(result.mesh, level);
    expect_copy<CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>>>(result.mesh, level);
  }
}

} // namespace levels_of_detail_test
