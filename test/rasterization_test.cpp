// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which samples lie in which triangle of a texture, and the nearest of them.

#include <support/baked_models.h>
#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rasterization_test {

using namespace test_support;
using namespace baked_models;

// --- Which samples lie in which triangle

std::vector<int> visits(const Textured_triangle_mesh& mesh, std::size_t columns, std::size_t rows)
{
  const SMT::internal::Uv_rasterizer raster(mesh.uv, mesh.wedges, columns, rows, 5);
  std::vector<int> result(columns * rows, 0);
  for(std::size_t band = 0; band < raster.number_of_bands(); ++band)
    raster.visit(band, [&](std::uint32_t, std::int64_t x, std::int64_t y) {
      ++result[std::size_t(y) * columns + std::size_t(x)];
    });
  return result;
}

TEST(Rasterization, gives_each_sample_of_a_triangulated_square_to_one_triangle)
{
  // Edges of the grid go through samples along all three directions if the sides divide.
  for(const Vertex_index n : {1, 2, 7, 8, 16})
    for(const std::size_t size : {1, 3, 7, 8, 24, 56})
      for(const bool is_mirrored : {false, true}) {
        Textured_triangle_mesh mesh = over_square(n, flat);
        if(is_mirrored)
          for(Point_2& p : mesh.uv)
            p = Point_2(1. - p.x(), p.y());
        for(const int number : visits(mesh, size, 2 * size))
          ASSERT_EQ(number, 1) << n << ", " << size << ", " << is_mirrored;
      }
}

TEST(Rasterization, gives_a_sample_at_a_vertex_to_one_triangle)
{
  Textured_triangle_mesh mesh = seen_from_above(fan(24)); // the hub in the middle
  for(Point_2& p : mesh.uv)
    p = Point_2(0.5 + 0.49 * p.x(), 0.5 + 0.49 * p.y());
  const std::vector<int> number = visits(mesh, 101, 101); // the middle sample lies at the hub
  EXPECT_EQ(number[50 * 101 + 50], 1);
  EXPECT_LE(*std::max_element(number.begin(), number.end()), 1);
}

TEST(Rasterization, finds_what_trial_of_all_triangles_finds)
{
  for(const auto& [name, input] : textured_meshes(seed)) {
    const Textured_triangle_mesh mesh = in_unit_square(input, -0.05); // some of it beyond
    const std::size_t size = 90;
    const SMT::internal::Uv_rasterizer raster(mesh.uv, mesh.wedges, size, size, 7);
    std::vector<std::vector<std::uint32_t>> found(size * size);
    for(std::size_t band = 0; band < raster.number_of_bands(); ++band)
      raster.visit(band, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
        found[std::size_t(y) * size + std::size_t(x)].push_back(t);
      });
    Texture_image image;
    image.width = image.height = size;
    const SMT::Tangent_frames frames = tangent_frames(mesh, vertex_normals(mesh));
    for(const Texel_in_triangle& texel : texels_in(gltf_triangles(mesh, frames), image)) {
      const auto& triangles = found[texel.y * size + texel.x];
      ASSERT_EQ(std::count(triangles.begin(), triangles.end(), texel.triangle), 1)
        << name << seed_text;
      const auto point = raster.point(std::uint32_t(texel.triangle), texel.x, texel.y);
      for(int c = 0; c < 3; ++c)
        ASSERT_NEAR(point.weights[c], texel.weights[c], 1e-5) << name << seed_text;
    }
  }
}

TEST(Nearest_covered, is_the_nearest)
{
  Random random(seed);
  for(const double density : {0., 0.002, 0.05, 0.5, 1.}) {
    const std::size_t columns = 41, rows = 37;
    std::vector<bool> is_covered(columns * rows);
    for(std::size_t i = 0; i < is_covered.size(); ++i)
      is_covered[i] = uniform(random, 0., 1.) < density || (density == 0.002 && i == 700);
    const SMT::internal::Nearest_covered nearest(columns, rows,
                                                 [&](std::size_t i) { return is_covered[i]; });
    for(std::size_t y = 0; y < rows; ++y) {
      std::vector<std::size_t> cells;
      nearest.row(y, cells);
      for(std::size_t x = 0; x < columns; ++x) {
        const auto squared_distance = [&](std::size_t i) {
          const double dx = double(i % columns) - double(x), dy = double(i / columns) - double(y);
          return dx * dx + dy * dy;
        };
        double least = std::numeric_limits<double>::infinity();
        for(std::size_t i = 0; i < is_covered.size(); ++i)
          if(is_covered[i])
            least = (std::min)(least, squared_distance(i));
        if(std::isinf(least)) {
          ASSERT_EQ(cells[x], SMT::internal::Nearest_covered::no_cell);
        } else {
          ASSERT_TRUE(is_covered[cells[x]]);
          ASSERT_EQ(squared_distance(cells[x]), least) << x << ", " << y << seed_text;
        }
      }
    }
  }
}

} // namespace rasterization_test
