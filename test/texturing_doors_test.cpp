// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The doors of texturing for meshes of any type.

#include <support/texture_atlas_properties.h>
#include <support/textured_meshes.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace texturing_doors_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

Mesh surface_mesh(const Indexed_triangle_mesh& arrays)
{
  Mesh mesh;
  for(const Point_3& p : arrays.points)
    mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  for(const Triangle_indices& t : arrays.triangles)
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  return mesh;
}

// A sphere with constrained edges around its equator, as charts of a mesh of any type.
TEST(Texturing_doors, constrained_edges_are_seams)
{
  const Indexed_triangle_mesh arrays = sphere(4);
  Mesh mesh = surface_mesh(arrays);
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto wanted = mesh.add_property_map<Mesh::Edge_index, bool>("e:wanted", false).first;
  const auto edge_seam = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
  const auto half_seam = mesh.add_property_map<Mesh::Halfedge_index, bool>("h:seam", false).first;
  const auto is_above = [&mesh](Mesh::Face_index f) {
    double z = 0.;
    for(const auto v : vertices_around_face(halfedge(f, mesh), mesh))
      z += mesh.point(v).z();
    return z > 1e-9;
  };
  std::size_t number = 0;
  for(const auto e : edges(mesh)) {
    wanted[e] = is_above(mesh.face(mesh.halfedge(e, 0))) != is_above(mesh.face(mesh.halfedge(e, 1)));
    number += wanted[e] ? 1 : 0;
  }
  ASSERT_GT(number, 10u);
  const auto np = CGAL::parameters::edge_is_constrained_map(wanted);
  const auto expect_seams = [&](const SMT::Face_charts& charts) {
    ASSERT_TRUE(SMT::mark_seams(mesh, charts, edge_seam));
    ASSERT_TRUE(SMT::mark_seams(mesh, charts, half_seam));
    for(const auto e : edges(mesh)) {
      const auto h = mesh.halfedge(e, 0);
      EXPECT_TRUE(edge_seam[e] || !wanted[e]);
      EXPECT_EQ(half_seam[h], edge_seam[e]);
      EXPECT_EQ(half_seam[mesh.opposite(h)], edge_seam[e]);
      EXPECT_TRUE(edge_seam[e] || chart[mesh.face(h)] == chart[mesh.face(mesh.opposite(h))]);
    }
    EXPECT_EQ(SMT::error_of_charts(arrays.triangles, charts), "");
  };
  const SMT::Segmentation_result segmentation
    = SMT::segment_into_charts(mesh, chart, SMT::Segmentation_options(),
                               SMT::Chart_growth_options(), np);
  ASSERT_EQ(segmentation.error, "");
  expect_seams(segmentation.charts);
  const SMT::Texture_atlas_result atlas
    = SMT::build_texture_atlas(mesh, uv, chart, small_texture(), np);
  ASSERT_EQ(atlas.error, "");
  EXPECT_EQ(error_in_atlas(arrays, atlas.atlas), "");
  expect_seams(atlas.atlas.charts);
}

TEST(Texturing_doors, meshes_of_any_type_take_the_points_of_a_map)
{
  const Indexed_triangle_mesh arrays = torus(24, 12);
  Mesh mesh = surface_mesh(arrays);
  const auto place = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:place").first;
  for(const auto v : vertices(mesh)) {
    place[v] = mesh.point(v);
    mesh.point(v) = Kernel::Point_3(0., 0., 0.); // so that they would be found to be without extent
  }
  const auto np = CGAL::parameters::vertex_point_map(place);
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  EXPECT_NE(SMT::segment_into_charts(mesh, chart).error, "");
  const SMT::Segmentation_result segmentation = SMT::segment_into_charts<CGAL::Sequential_tag>(
    mesh, chart, SMT::Segmentation_options(), SMT::Chart_growth_options(), np);
  ASSERT_EQ(segmentation.error, "");
  EXPECT_EQ(segmentation.charts.chart, SMT::segment_into_charts(arrays).charts.chart);
  for(const auto f : faces(mesh))
    EXPECT_EQ(chart[f], segmentation.charts.chart[std::size_t(f)]);
  const SMT::Texture_atlas_result atlas
    = SMT::build_texture_atlas(mesh, uv, chart, small_texture(), np);
  ASSERT_EQ(atlas.error, "");
  EXPECT_EQ(error_in_atlas(arrays, atlas.atlas), "");
}

// Seams keep off the edges of a part of a torus, and off one edge in three. They cross a ring around
// its tube once, as they must, and there are few of them on a sphere that is to have none.
TEST(Texturing_doors, edges_that_shall_not_be_seams_are_none)
{
  const Indexed_triangle_mesh arrays = torus(60, 30);
  Mesh mesh = surface_mesh(arrays);
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto free = mesh.add_property_map<Mesh::Edge_index, bool>("e:free", false).first;
  enum class Kind { PART, THIRD, RING };
  for(const Kind kind : {Kind::PART, Kind::THIRD, Kind::RING}) {
    SCOPED_TRACE(int(kind));
    std::size_t i = 0;
    for(const auto e : edges(mesh)) {
      const auto p = mesh.point(source(e, mesh)), q = mesh.point(target(e, mesh));
      const bool is_near = p.x() > 0. && q.x() > 0. && std::abs(p.y()) < 0.5 && std::abs(q.y()) < 0.5;
      free[e] = kind == Kind::THIRD ? i++ % 3 == 0
                                    : is_near && (kind == Kind::RING || (p.z() > 0. && q.z() > 0.));
    }
    SMT::Texture_atlas_options options = small_texture();
    const auto without = SMT::mark_sides(mesh, free);
    const SMT::Texture_atlas_result before
      = SMT::build_texture_atlas(mesh, uv, chart, options);
    ASSERT_EQ(before.error, "");
    EXPECT_EQ(before.report.unwanted_seams, 0u); // nobody asked
    EXPECT_GT(SMT::number_of_seams_on(arrays.triangles, before.atlas.charts, without), 0u);
    options.no_seams = without;
    if(kind == Kind::RING) // a chart that were cut again would have to be cut through the ring once more
      options.bound.area_scale = 100.;
    const SMT::Texture_atlas_result atlas = SMT::build_texture_atlas(mesh, uv, chart, options);
    ASSERT_EQ(atlas.error, "");
    EXPECT_EQ(error_in_atlas(arrays, atlas.atlas), "");
    std::size_t unwanted = 0;
    const auto seam = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
    ASSERT_TRUE(SMT::mark_seams(mesh, atlas.atlas.charts, seam));
    for(const auto e : edges(mesh))
      unwanted += free[e] && seam[e] ? 1 : 0;
    if(kind == Kind::RING)
      EXPECT_TRUE(unwanted > 0 && unwanted < 20) << unwanted;
    else
      EXPECT_EQ(unwanted, 0u);
    EXPECT_EQ(atlas.report.unwanted_seams, unwanted);
    SMT::Segmentation_options segmentation;
    segmentation.no_seams = without;
    const SMT::Segmentation_result charts = SMT::segment_into_charts(mesh, chart, segmentation);
    ASSERT_EQ(charts.error, "");
    EXPECT_EQ(charts.unwanted_seams > 0, kind == Kind::RING);
    EXPECT_LT(charts.unwanted_seams, 10u); // along the outer side, where the ring is the narrowest
    EXPECT_EQ(SMT::number_of_seams_on(arrays.triangles, charts.charts, without),
              charts.unwanted_seams);
    EXPECT_EQ(SMT::error_of_charts(arrays.triangles, charts.charts), "");
  }
  SMT::Segmentation_options all;
  const Indexed_triangle_mesh closed = sphere(3);
  all.no_seams.assign(closed.triangles.size(), 7);
  const SMT::Segmentation_result forced = SMT::segment_into_charts(closed, all);
  ASSERT_EQ(forced.error, "");
  EXPECT_EQ(forced.charts.number_of_charts, 1u);
  EXPECT_EQ(SMT::error_of_charts(closed.triangles, forced.charts), "");
  EXPECT_GT(forced.unwanted_seams, 0u);
  all.no_seams.pop_back();
  EXPECT_EQ(SMT::segment_into_charts(closed, all).status,
            CGAL::Indexed_mesh::Mesh_status::BAD_OPTIONS);
}

// Points that only their traits can read, in thousandths.
struct Opaque_point
{
  std::array<long, 3> thousandths;
};

struct Opaque_traits
{
  typedef double FT;

  template <int I>
  struct Compute
  {
    FT operator()(const Opaque_point& p) const { return FT(p.thousandths[I]) / 1000.; }
  };

  struct Construct
  {
    Opaque_point operator()(FT x, FT y, FT z) const
    {
      return {{std::lround(1000. * x), std::lround(1000. * y), std::lround(1000. * z)}};
    }
  };

  Compute<0> compute_x_3_object() const { return {}; }
  Compute<1> compute_y_3_object() const { return {}; }
  Compute<2> compute_z_3_object() const { return {}; }
  Construct construct_point_3_object() const { return {}; }
};

TEST(Texturing_doors, meshes_of_any_type_take_points_that_their_traits_read)
{
  const Opaque_traits traits;
  Indexed_triangle_mesh arrays = torus(24, 12);
  Mesh mesh = surface_mesh(arrays);
  const auto place = mesh.add_property_map<Mesh::Vertex_index, Opaque_point>("v:place").first;
  for(const auto v : vertices(mesh)) {
    const auto p = mesh.point(v);
    place[v] = traits.construct_point_3_object()(p.x(), p.y(), p.z());
    arrays.points[std::size_t(v)] = Point_3(traits.compute_x_3_object()(place[v]),
                                            traits.compute_y_3_object()(place[v]),
                                            traits.compute_z_3_object()(place[v]));
  }
  const auto np = CGAL::parameters::vertex_point_map(place).geom_traits(traits);
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  const SMT::Segmentation_result segmentation = SMT::segment_into_charts(
    mesh, chart, SMT::Segmentation_options(), SMT::Chart_growth_options(), np);
  ASSERT_EQ(segmentation.error, "");
  EXPECT_EQ(segmentation.charts.chart, SMT::segment_into_charts(arrays).charts.chart);
  // Levels, too, and back
  const SMM::Progressive_surface surface
    = SMM::build_progressive_mesh(mesh, SMM::Progressive_mesh_options(), np);
  ASSERT_EQ(surface.error, "");
  EXPECT_EQ(surface.points, arrays.points);
  EXPECT_EQ(surface.progressive_mesh.collapses.size(),
            SMM::build_progressive_mesh(arrays).progressive_mesh.collapses.size());
  Mesh copy;
  const auto to = copy.add_property_map<Mesh::Vertex_index, Opaque_point>("v:place").first;
  SMM::copy_level(surface, 0, copy, CGAL::parameters::vertex_point_map(to).geom_traits(traits));
  ASSERT_EQ(num_vertices(copy), num_vertices(mesh));
  for(const auto v : vertices(copy))
    EXPECT_EQ(to[v].thousandths, place[v].thousandths);
}


// A mesh of any type is baked as its arrays, with texture coordinates of vertices or of halfedges.
TEST(Texturing_doors, meshes_of_any_type_are_baked)
{
  const Indexed_triangle_mesh arrays = with_hills(grid(8, 8), 0.5, 7);
  const Textured_triangle_mesh fine = textured(arrays, [&](std::size_t, Vertex_index v) {
    return Point_2(arrays.points[v].x() / 8., arrays.points[v].y() / 8.);
  });
  const Indexed_triangle_mesh flat = grid(1, 1);
  const Textured_triangle_mesh light = textured(flat, [&](std::size_t, Vertex_index v) {
    return Point_2(flat.points[v].x(), flat.points[v].y());
  });
  Mesh fine_mesh = surface_mesh(arrays), light_mesh = surface_mesh(flat);
  const auto of_vertices
    = fine_mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto of_halfedges
    = fine_mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto light_uv
    = light_mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto color
    = fine_mesh.add_property_map<Mesh::Vertex_index, std::array<float, 2>>("v:color").first;
  std::vector<float> values;
  for(const auto v : vertices(fine_mesh)) {
    const Kernel::Point_3& p = fine_mesh.point(v);
    of_vertices[v] = Kernel::Point_2(p.x() / 8., p.y() / 8.);
    color[v] = {float(p.x()), float(p.z())};
    values.insert(values.end(), color[v].begin(), color[v].end());
  }
  for(const auto h : halfedges(fine_mesh))
    of_halfedges[h] = of_vertices[target(h, fine_mesh)];
  for(const auto v : vertices(light_mesh))
    light_uv[v] = Kernel::Point_2(light_mesh.point(v).x(), light_mesh.point(v).y());
  const SMT::Baking_by_rays_options options = small_image();
  const auto expect_equal = [](const SMT::Baked_map& map, const SMT::Baked_map& expected) {
    EXPECT_EQ(map.error, "");
    EXPECT_GT(map.number_of_covered_texels, 0u);
    EXPECT_EQ(map.image.texels, expected.image.texels);
  };
  const SMT::Baked_map normals = SMT::bake_normal_map(fine, light, options);
  expect_equal(SMT::bake_normal_map(fine_mesh, of_vertices, light_mesh, light_uv, options), normals);
  expect_equal(SMT::bake_normal_map(fine_mesh, of_halfedges, light_mesh, light_uv, options),
               normals);
  expect_equal(
    SMT::bake_displacement(fine_mesh, of_halfedges, light_mesh, light_uv, options).map,
    SMT::bake_displacement(fine, light, options).map);
  expect_equal(SMT::bake_vertex_colors(fine_mesh, of_halfedges, color, 2, light_mesh, light_uv,
                                       options),
               SMT::bake_vertex_colors(fine, values, 2, light, options));
  // An image in which the fine mesh lies turned
  Textured_triangle_mesh former = fine;
  const auto former_uv
    = fine_mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:former").first;
  for(auto& p : former.uv)
    p = Point_2(p.y(), 1. - p.x());
  for(const auto v : vertices(fine_mesh))
    former_uv[v] = Kernel::Point_2(of_vertices[v].y(), 1. - of_vertices[v].x());
  SMT::Texture_image image = {5, 3, 2, {}};
  for(int i = 0; i < 30; ++i)
    image.texels.push_back(float(i % 7));
  expect_equal(SMT::bake_image<CGAL::Sequential_tag>(fine_mesh, of_halfedges, former_uv, image,
                                                     light_mesh, light_uv, options),
               SMT::bake_image(fine, former, image, light, options));
}

} // namespace texturing_doors_test
