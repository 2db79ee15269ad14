// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What works in parallel takes a tag and a number of threads, and gives the same for all of them.

#include <support/bad_inputs.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/ambient_occlusion.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <vector>

namespace concurrency_tags_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr unsigned int threads = 2;

// Options with that many threads.
template <class Options>
Options with_threads(Options options)
{
  options.threads = threads;
  return options;
}

// Calls `run(tag)` for both tags, and compares what comes of it.
template <class Run>
void expect_the_same(const Run& run)
{
  const auto expected = run(CGAL::Sequential_tag());
  EXPECT_FALSE(expected.empty());
  EXPECT_TRUE(run(CGAL::Parallel_tag()) == expected);
}

TEST(Concurrency_tags, of_maps_and_charts)
{
  const Indexed_triangle_mesh mesh = good_arrays();
  expect_the_same([&mesh](auto tag) {
    return SMP::border_first_map<decltype(tag)>(mesh, threads).uv;
  });
  expect_the_same([&mesh](auto tag) {
    SMT::Surface_map_options options;
    options.solver.threads = threads;
    return SMT::map_surface<decltype(tag)>(mesh, options).mesh.uv;
  });
  expect_the_same([&mesh](auto tag) {
    return SMT::grow_charts<decltype(tag)>(mesh, with_threads(SMT::Chart_growth_options())).charts.seams;
  });
  const SMT::Segmentation_options options = with_threads(SMT::Segmentation_options());
  expect_the_same([&](auto tag) {
    return SMT::segment_into_charts<decltype(tag)>(mesh, options).charts.seams;
  });
  expect_the_same([&](auto tag) {
    return SMT::segment_coarse_to_fine<decltype(tag)>(mesh, options, [](const auto& coarse) {
             return SMT::one_disk_per_component(coarse);
           }).charts.seams;
  });
  expect_the_same([](auto tag) {
    const SMT::Chart_shape chart = {{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 1, 2}}};
    const SMT::Packing_result packing = SMT::pack_charts<SMT::Raster_packer, decltype(tag)>(
      {chart, chart}, with_threads(SMT::Packing_options()));
    return std::vector<double>{packing.texels_per_unit, packing.placements.at(1).offset.x()};
  });
}

TEST(Concurrency_tags, of_levels)
{
  const Textured_triangle_mesh mesh = with_texture(good_arrays());
  const Textured_surface surface(mesh);
  const auto options = with_threads(SMM::Textured_progressive_mesh_options());
  const auto points = [](const SMM::Textured_progressive_mesh_result& result) {
    return result.mesh.points;
  };
  expect_the_same([&](auto tag) {
    return points(SMM::build_textured_progressive_mesh<decltype(tag)>(mesh, options));
  });
  expect_the_same([&](auto tag) {
    return points(
      SMM::build_textured_progressive_mesh<decltype(tag)>(surface.mesh, surface.uv, options));
  });
  expect_the_same([&](auto tag) {
    SMM::Progressive_mesh pm = SMM::trivial_progressive_mesh(mesh.points.size());
    pm.triangles = mesh.triangles;
    return points(SMM::build_textured_progressive_mesh<decltype(tag)>(pm, mesh.points, mesh.uv, options));
  });
  const SMM::Textured_progressive_mesh pm = SMM::build_textured_progressive_mesh(mesh).mesh;
  const std::size_t k = pm.whole_position(pm.number_of_collapses() / 2);
  const SMM::Wedge_mesh fine = SMM::textured_level(pm, 0), coarse = SMM::textured_level(pm, k);
  expect_the_same([&](auto tag) {
    typedef decltype(tag) Tag;
    const double of_level
      = SMM::measure_texture_deviation<Tag>(pm, k, threads).deviation.maximum;
    const double of_meshes
      = SMM::measure_texture_deviation<Tag>(fine, coarse, threads).deviation.maximum;
    EXPECT_TRUE(SMM::is_within_texture_deviation<Tag>(pm, k, of_level, threads));
    EXPECT_TRUE(SMM::is_within_distance<Tag>(pm, k, 100., threads));
    return std::vector<double>{of_level, of_meshes,
                               double(SMM::coarsest_level_within<Tag>(
                                 pm, SMM::Level_error::TEXTURE_DEVIATION, of_level, threads))};
  });
}

TEST(Concurrency_tags, of_baking)
{
  typedef SMT::AABB_tree_ray_caster Caster;
  const Textured_triangle_mesh mesh = with_texture(good_arrays());
  const std::vector<SMT::Vector_3> normals = SMT::vertex_normals(mesh);
  const SMT::Tangent_frames frames = SMT::tangent_frames(mesh, normals);
  const SMT::Baking_by_rays_options options = with_threads(small_image());
  const SMT::Texture_image image = {1, 1, 3, {0.f, 0.f, 1.f}};
  const std::vector<float> values(mesh.points.size(), 1.f);
  expect_the_same([&](auto tag) {
    typedef decltype(tag) Tag;
    std::vector<float> texels;
    for(const SMT::Baked_map& map :
        {SMT::bake_normal_map<Tag>(mesh, mesh, options),
         SMT::bake_normal_map<Tag>(mesh, normals, mesh, frames, options),
         SMT::bake_normal_map_by_rays<Caster, Tag>(good_arrays(), mesh, options),
         SMT::bake_displacement<Tag>(mesh, mesh, options).map,
         SMT::bake_displacement<Tag>(mesh, mesh, normals, options).map,
         SMT::bake_vertex_colors<Tag>(mesh, values, 1, mesh, options),
         SMT::bake_image<Tag>(mesh, mesh, image, mesh, options)}) {
      EXPECT_EQ(map.error, "");
      texels.insert(texels.end(), map.image.texels.begin(), map.image.texels.end());
    }
    return texels;
  });
  expect_the_same([&](auto tag) {
    return SMT::ambient_occlusion<Caster, decltype(tag)>(good_arrays(), 8, threads);
  });
  expect_the_same([&](auto tag) { return SMT::vertex_normals<decltype(tag)>(mesh, threads); });
  expect_the_same([&](auto tag) {
    typedef decltype(tag) Tag;
    const SMT::Rendering_error error = SMT::rendering_error<Tag>(
      mesh, mesh, frames, image, SMT::Normal_space::TANGENT, 8, threads);
    const auto signal = SMT::normal_signal<Tag>(good_arrays(), threads);
    return std::vector<double>{error.mean_angle, signal.tensors.at(0).trace()};
  });
}

} // namespace concurrency_tags_test
