// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad meshes at the doors of texturing; see support/bad_inputs.h.

#include <support/bad_inputs.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/ambient_occlusion.h>
#include <CGAL/Surface_mesh_texturing/atlas_measures.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/image_importance.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/smooth_seams.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>
#include <CGAL/Surface_mesh_texturing/unstacked_atlas.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bad_texturing_meshes_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

typedef SMT::AABB_tree_ray_caster Caster;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

const SMT::Texture_image white = {1, 1, 3, {1.f, 1.f, 1.f}};

struct Surface_map_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::map_surface(mesh);
  }
};

struct Mesh_map_door : Door<Needs::SURFACE, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    return SMT::map_surface(
      mesh, mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first);
  }
};

struct Atlas_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::build_texture_atlas(mesh, small_texture());
  }
};

struct Mesh_atlas_door : Door<Needs::SURFACE, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    const auto uv = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;
    const auto chart
      = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:chart").first;
    return SMT::build_texture_atlas(mesh, uv, chart, small_texture());
  }
};

struct Growth_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::grow_charts(mesh);
  }
};

struct Segmentation_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMT::Segmentation_result result = SMT::segment_into_charts(mesh);
    EXPECT_EQ(result.is_ok(), result.charts.number_of_charts > 0);
    return result;
  }
};

struct Mesh_segmentation_door : Door<Needs::SURFACE, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    return SMT::segment_into_charts(
      mesh, mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:chart").first);
  }
};

// Of the good mesh.
SMT::Face_charts one_chart()
{
  const std::vector<Triangle_indices> triangles = good_arrays().triangles;
  return SMT::charts_between(triangles, std::vector<std::uint8_t>(triangles.size()));
}

// Functions of charts have no place for a sentence: they return none, and `charts_error()` has it.
struct Charts_door : Door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const std::size_t n = mesh.triangles.size();
    const std::vector<std::uint8_t> none(n);
    SMT::Face_charts charts = one_chart();
    charts.seams.resize(n);
    charts.chart.resize(n);
    Mesh_outcome outcome = SMT::charts_error(mesh, charts);
    for(const std::size_t number :
        {SMT::cut_to_disks(mesh, charts).number_of_charts,
         SMT::disks_between(mesh, none).number_of_charts,
         SMT::one_disk_per_component(mesh).number_of_charts, SMT::chart_meshes(mesh, charts).size(),
         SMT::straighten_charts(mesh, charts).number_of_charts,
         SMT::keep_seams_off(mesh, charts, none).number_of_charts})
      EXPECT_EQ(number, outcome.is_ok() ? 1u : 0u);
    EXPECT_EQ(SMT::measure_seams(mesh, charts).edges, 0u);
    SMT::charts_between(mesh.triangles, none); // no signal
    SMT::charts_of_labels(mesh.triangles, charts.chart);
    SMT::chart_topologies(mesh.triangles, charts);
    SMT::number_of_seams_on(mesh.triangles, charts, none);
    SMT::measure_seams(mesh, CGAL::Indexed_mesh::Triangle_adjacency(good_arrays().triangles),
                       one_chart());
    return outcome;
  }
};

struct Smooth_seams_door : Door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::smooth_seams(mesh, one_chart());
  }
};

struct Equal_parts_door : Door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::find_equal_parts(mesh);
  }
};

// Parts of a mesh that is another one now.
struct Unstacked_door : Door<Needs::TRIANGLES>
{
  static Indexed_triangle_mesh twice(const Indexed_triangle_mesh& mesh)
  {
    Indexed_triangle_mesh result = mesh;
    const Indexed_triangle_mesh good = good_arrays();
    for(Triangle_indices& t : result.triangles)
      for(Vertex_index& v : t)
        v = v < mesh.points.size() ? v : Vertex_index(-1); // not one of the other half
    for(const Triangle_indices& t : good.triangles) {
      const Vertex_index n = Vertex_index(mesh.points.size());
      result.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
    }
    for(const Point_3& p : good.points)
      result.points.emplace_back(p.x() + 100., p.y(), p.z());
    return result;
  }
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    static const SMT::Equal_parts parts = SMT::find_equal_parts(twice(good_arrays()));
    EXPECT_EQ(parts.copies, 1u);
    static const SMT::Texture_atlas_result atlas
      = SMT::build_texture_atlas(parts.representatives, small_texture());
    EXPECT_EQ(atlas.error, "");
    const Indexed_triangle_mesh bad = mesh.triangles.empty() ? mesh : twice(mesh);
    const Mesh_outcome result = SMT::stacked_atlas(bad, parts, atlas);
    EXPECT_EQ(SMT::unstacked_atlas(bad, parts, atlas, small_texture()).error, result.error);
    return result;
  }
};

struct Repacking_door : Textured_door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const Mesh_outcome result = SMT::repack_texture_atlas(mesh, small_texture());
    const SMT::Face_charts charts = SMT::charts_of_texture(mesh);
    EXPECT_TRUE(charts.number_of_charts > 0 || !result.is_ok());
    SMT::Face_charts foreign = SMT::charts_of_texture(good()); // no signal
    SMT::measure_texels(mesh, foreign, 64, 64);
    foreign.chart.assign(mesh.triangles.size(), 7);
    foreign.seams.resize(mesh.triangles.size());
    SMT::measure_texels(mesh, foreign, 64, 64);
    return result;
  }
};

struct Fine_and_light_door : Textured_door<Needs::ARRAYS>
{
  // A mesh as the one that is said, and a good one as the other.
  static std::pair<Textured_triangle_mesh, Textured_triangle_mesh>
  fine_and_light(Which bad, const Textured_triangle_mesh& mesh)
  {
    if(bad == Which::FINE)
      return {mesh, good()};
    return {good(), mesh};
  }
};

// Bakes at equal texture coordinates.
template <Which Bad>
struct Baking_door : Fine_and_light_door
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const auto [fine, light] = fine_and_light(Bad, mesh);
    const Mesh_outcome result = SMT::bake_normal_map(fine, light, small_image());
    const std::vector<float> values(fine.points.size(), 1.f);
    for(const Mesh_outcome& other :
        {Mesh_outcome(SMT::bake_displacement(fine, light, small_image()).map),
         Mesh_outcome(SMT::bake_vertex_colors(fine, values, 1, light, small_image())),
         Mesh_outcome(SMT::bake_image(fine, fine, white, light, small_image()))})
      EXPECT_EQ(other.error, result.error);
    return result;
  }
};

template <Which Bad>
struct Mesh_baking_door : Textured_door<Needs::ARRAYS, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    Textured_surface fine(Bad == Which::FINE ? mesh : good());
    const Textured_surface light(Bad == Which::FINE ? good() : mesh);
    const auto bake = [&](const auto& function) {
      return function(fine.mesh, fine.uv, light.mesh, light.uv, small_image());
    };
    const Mesh_outcome result
      = bake([](const auto&... input) { return SMT::bake_normal_map(input...); });
    const auto color
      = fine.mesh.add_property_map<Surface_mesh::Vertex_index, std::array<float, 1>>("v:color").first;
    for(const Mesh_outcome& other :
        {Mesh_outcome(bake([](const auto&... i) { return SMT::bake_displacement(i...).map; })),
         Mesh_outcome(SMT::bake_vertex_colors(fine.mesh, fine.uv, color, 1, light.mesh, light.uv,
                                              small_image())),
         Mesh_outcome(SMT::bake_image(fine.mesh, fine.uv, fine.uv, white, light.mesh, light.uv,
                                      small_image()))})
      EXPECT_EQ(other.error, result.error);
    return result;
  }
};

// Finds no point of a fine surface.
struct No_correspondence
{
  void find(std::size_t, const std::vector<SMT::Baking_sample>&) const {}
};

struct Light_door : Textured_door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const std::vector<float> values;
    return SMT::bake(mesh, No_correspondence(),
                     SMT::Vertex_value_shader(mesh.triangles, values, 1), small_image());
  }
};

template <Which Bad>
struct Ray_baking_door : Textured_door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const Textured_triangle_mesh& light = Bad == Which::FINE ? good() : mesh;
    const Indexed_triangle_mesh fine = Bad == Which::FINE
      ? Indexed_triangle_mesh{mesh.points, mesh.triangles} : good_arrays();
    return SMT::bake_normal_map_by_rays<Caster>(fine, light, small_image());
  }
};

// A fine surface needs no texture.
template <class Door>
struct Of_fine_surface : Of_mesh<Door>
{
  static bool concerns(const Input& input)
  {
    return input.texture == Texture::GOOD && Of_mesh<Door>::concerns(input);
  }
};

struct Occlusion_door : Door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    Mesh_outcome result;
    result.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::mesh_error(mesh));
    EXPECT_EQ(SMT::ambient_occlusion<Caster>(mesh, 8).empty(), !result.is_ok());
    EXPECT_EQ(SMT::normal_signal(mesh).error, result.error);
    EXPECT_EQ(SMT::vertex_normals(mesh.points, mesh.triangles).empty(),
              mesh.points.empty()
                || !CGAL::Indexed_mesh::index_error(mesh.triangles, mesh.points.size()).empty());
    return result;
  }
};

template <Which Bad>
struct Rendering_door : Fine_and_light_door
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const auto [fine, light] = fine_and_light(Bad, mesh);
    const SMT::Tangent_frames frames
      = SMT::tangent_frames(light, SMT::vertex_normals(light)); // no signal
    return SMT::rendering_error(fine, light, frames, white, SMT::Normal_space::TANGENT, 8);
  }
};

struct Image_door : Textured_door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    const Mesh_outcome result = SMT::image_signal(mesh, white);
    EXPECT_EQ(SMT::image_importance(mesh, white).error, result.error);
    return result;
  }
};

template <class Door>
class Bad_texturing_mesh
  : public testing::Test
{};

typedef testing::Types<Of_mesh<Surface_map_door>, Of_mesh<Mesh_map_door>, Of_mesh<Atlas_door>,
                       Of_mesh<Mesh_atlas_door>, Of_mesh<Growth_door>, Of_mesh<Segmentation_door>,
                       Of_mesh<Mesh_segmentation_door>, Of_mesh<Charts_door>,
                       Of_mesh<Smooth_seams_door>, Of_mesh<Equal_parts_door>,
                       Of_mesh<Unstacked_door>, Of_mesh<Repacking_door>,
                       Of_mesh<Baking_door<Which::FINE>>, Of_mesh<Baking_door<Which::LIGHT>>,
                       Of_mesh<Mesh_baking_door<Which::FINE>>,
                       Of_mesh<Mesh_baking_door<Which::LIGHT>>, Of_mesh<Light_door>,
                       Of_fine_surface<Ray_baking_door<Which::FINE>>,
                       Of_mesh<Ray_baking_door<Which::LIGHT>>, Of_mesh<Occlusion_door>,
                       Of_fine_surface<Rendering_door<Which::FINE>>,
                       Of_mesh<Rendering_door<Which::LIGHT>>, Of_mesh<Image_door>>
  Doors;
TYPED_TEST_SUITE(Bad_texturing_mesh, Doors);

TYPED_TEST(Bad_texturing_mesh, gives_an_error_and_a_sentence)
{
  expect_an_error_and_a_sentence<TypeParam>();
}

TYPED_TEST(Bad_texturing_mesh, is_not_seen_in_a_good_one)
{
  EXPECT_EQ(TypeParam::what_is_wrong(good_input()), "");
}

} // namespace bad_texturing_meshes_test
