// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages as the tiles of one plane, and densities from images.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/image_importance.h>
#include <CGAL/Surface_mesh_texturing/udim.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace texture_layout_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

TEST(Udim, tiles_are_numbered_in_rows_of_ten)
{
  for(std::size_t page = 0; page < 1000; ++page) {
    const auto corner = SMT::udim_corner(page);
    EXPECT_EQ(double(SMT::udim_tile(page)), 1001. + corner.x() + 10. * corner.y());
    EXPECT_LT(corner.x(), 10.);
  }
  EXPECT_EQ(SMT::udim_file_name("color", 0), "color.1001.png");
  EXPECT_EQ(SMT::udim_file_name("color", 12), "color.1013.png");
  EXPECT_EQ(SMT::udim_file_name("color"), "color.<UDIM>.png");
}

TEST(Udim, coordinates_lie_in_the_tiles_of_their_pages)
{
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 64;
  options.packing.max_pages = 12;
  options.seam_price = 0.02; // with more cuts a single page is full
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(with_noise(torus(40, 20), 0.05, 3), options);
  ASSERT_EQ(result.error, "");
  ASSERT_GT(result.atlas.number_of_pages, 1u);
  const auto page = SMT::pages_of_triangles(result.atlas);
  const SMT::Textured_triangle_mesh& before = result.atlas.mesh;
  const SMT::Textured_triangle_mesh after = SMT::with_udim_coordinates(before, page);
  EXPECT_EQ(after.wedges, before.wedges);
  for(std::size_t t = 0; t < page.size(); ++t)
    for(const auto w : after.wedges[t]) {
      EXPECT_EQ(std::floor(after.uv[w].x()), double(page[t] % 10));
      EXPECT_EQ(std::floor(after.uv[w].y()), double(page[t] / 10));
      EXPECT_NEAR(after.uv[w].x() - double(page[t] % 10), before.uv[w].x(), 1e-12);
      EXPECT_NEAR(after.uv[w].y() - double(page[t] / 10), before.uv[w].y(), 1e-12);
    }
}

// The unit square as a grid, which the texture covers.
SMT::Textured_triangle_mesh textured_grid(Vertex_index n)
{
  const Indexed_triangle_mesh plane = grid(n, n);
  SMT::Textured_triangle_mesh mesh = {plane.points, plane.triangles, {}, plane.triangles};
  for(const auto& p : plane.points)
    mesh.uv.emplace_back(p.x() / n, p.y() / n);
  return mesh;
}

TEST(Image_importance, is_the_mean_over_a_triangle)
{
  // A ramp along u, whose mean over a triangle is its value at the middle, on fine and coarse grids
  SMT::Texture_image image = {256, 64, 2, std::vector<float>(256 * 64 * 2)};
  for(std::size_t y = 0; y < image.height; ++y)
    for(std::size_t x = 0; x < image.width; ++x)
      for(std::size_t c = 0; c < 2; ++c)
        image.texel(x, y)[c] = float((double(x) + 0.5) / 256.) * (c == 0 ? 0.5f : 1.5f);
  for(const Vertex_index n : {1u, 7u, 300u}) {
    const SMT::Textured_triangle_mesh mesh = textured_grid(n);
    SMT::Texture_image ramp = image;
    for(float& x : ramp.texels)
      x *= 0.5f; // so that nothing is cut off
    const SMT::Image_importance result = SMT::image_importance(mesh, ramp);
    ASSERT_EQ(result.error, "") << n;
    ASSERT_EQ(result.of_triangles.size(), mesh.triangles.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      double u = 0.;
      for(const auto w : mesh.wedges[t])
        u += mesh.uv[w].x() / 3.;
      EXPECT_NEAR(result.of_triangles[t], 1. / 16. + 15. / 16. * 0.5 * u, 0.01) << n;
    }
  }
}

TEST(Image_importance, is_between_a_sixteenth_and_one)
{
  const SMT::Textured_triangle_mesh mesh = textured_grid(5);
  for(const float value : {-3.f, 0.f, 1.f, 7.f}) {
    const SMT::Image_importance result
      = SMT::image_importance(mesh, {4, 4, 1, std::vector<float>(16, value)});
    for(const float x : result.of_triangles)
      EXPECT_EQ(x, value <= 0.f ? 0.0625f : 1.f);
  }
  SMT::Texture_image bad = {2, 1, 1, {0.f, std::numeric_limits<float>::quiet_NaN()}};
  EXPECT_NE(SMT::image_importance(mesh, bad).error, "");
  EXPECT_NE(SMT::image_importance(mesh, SMT::Texture_image()).error, "");
  SMT::Textured_triangle_mesh without = mesh;
  without.wedges.clear();
  EXPECT_NE(SMT::image_importance(without, {1, 1, 1, {1.f}}).error, "");
}

} // namespace texture_layout_test
