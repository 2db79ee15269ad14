// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages as the tiles of one plane.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/udim.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace udim_test {

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
  options.packing.max_pages = 0;
  options.packing.texels_per_unit = 20.;
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

} // namespace udim_test
