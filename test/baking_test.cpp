// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Baking: what is covered, distances, colours and images in the texture of a light model, and what is
// wrong with bad data.

#include <support/baked_models.h>
#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace baking_test {

using namespace test_support;
using namespace baked_models;
using SMT::bake_displacement;
using SMT::bake_image;
using SMT::sample_bilinear;

// --- What is covered

// A ring around the middle; the hole of one with few sectors is smaller.
Textured_triangle_mesh ring(Vertex_index sectors)
{
  Indexed_triangle_mesh mesh;
  for(Vertex_index i = 0; i < sectors; ++i) {
    const double a = 2. * CGAL_PI * i / sectors;
    mesh.points.emplace_back(0.5 + 0.2 * std::cos(a), 0.5 + 0.2 * std::sin(a), 0.);
    mesh.points.emplace_back(0.5 + 0.4 * std::cos(a), 0.5 + 0.4 * std::sin(a), 0.1);
    const Vertex_index j = (i + 1) % sectors;
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * j});
    mesh.triangles.push_back({2 * j, 2 * i + 1, 2 * j + 1});
  }
  return seen_from_above(mesh);
}

TEST(Baked_map, covers_the_charts_of_the_light_model)
{
  // Chords of the hole lie beyond the fine ring, which has no value of its own there.
  const Textured_triangle_mesh fine = ring(96), light = ring(6);
  const Baked_map map = bake_normal_map(fine, light, options_of(150));
  EXPECT_GT(map.number_of_samples_beside, 100u);
  EXPECT_EQ(map.number_of_samples_without, 0u);
  EXPECT_EQ(map.number_of_samples, map.number_of_covered_texels);
  const SMT::Tangent_frames frames = tangent_frames(light, vertex_normals(light));
  const auto texels = texels_in(gltf_triangles(light, frames), map.image);
  EXPECT_NEAR(double(texels.size()), double(map.number_of_covered_texels), 20.); // on edges
  for(const Texel_in_triangle& p : texels)
    ASSERT_TRUE(map.is_covered[p.y * 150 + p.x]);
  for(std::size_t i = 0; i < 150 * 150; ++i) { // all is filled with unit vectors
    const Vector_3 n = vector_of(map.image, i % 150, i / 150);
    ASSERT_NEAR(n * n, 1., rounding);
  }
}

TEST(Baked_map, beside_the_fine_surface_has_the_value_of_the_nearest_point)
{
  const Textured_triangle_mesh fine = ring(96), light = ring(6);
  std::vector<float> places;
  for(const Point_3& p : fine.points)
    places.insert(places.end(), {float(p.x()), float(p.y())});
  const Baked_map map = bake_vertex_colors(fine, places, 2, light, options_of(150));
  std::size_t beside = 0;
  for(std::size_t i = 0; i < 150 * 150; ++i) {
    const std::size_t x = i % 150, y = i / 150;
    const Point_2 p = centre_of(x, y, map.image);
    const double r = std::hypot(p.x() - 0.5, p.y() - 0.5);
    if(!map.is_covered[i] || r > 0.198 || r < 0.01)
      continue;
    ++beside;
    const float* q = map.image.texel(x, y);
    const double distance = std::hypot(q[0] - p.x(), q[1] - p.y());
    ASSERT_NEAR(distance, 0.2 - r, 0.012); // texels of 1 / 150: the nearest centre of one
  }
  EXPECT_GT(beside, 100u);
}

TEST(Baked_map, has_nothing_of_the_chart_next_to_it)
{
  // The hole of the light ring is smaller than the fine one: the ring reaches into the disk in it.
  const auto with_disk = [](Vertex_index sectors) {
    Textured_triangle_mesh mesh = ring(sectors);
    const Vertex_index first = Vertex_index(mesh.points.size());
    const Indexed_triangle_mesh disk = fan(60);
    for(const Point_3& p : disk.points) {
      mesh.points.emplace_back(0.5 + 0.19 * p.x(), 0.5 + 0.19 * p.y(), 0.);
      mesh.uv.emplace_back(mesh.points.back().x(), mesh.points.back().y());
    }
    const Vertex_index shift = Vertex_index(mesh.uv.size() - mesh.points.size());
    for(const Triangle_indices& t : disk.triangles) {
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      mesh.wedges.push_back({shift + first + t[0], shift + first + t[1], shift + first + t[2]});
    }
    return mesh;
  };
  const Textured_triangle_mesh fine = with_disk(96), light = with_disk(6);
  std::vector<float> values(fine.points.size(), 1.f); // of the disk
  std::fill_n(values.begin(), 2 * 96, 0.f);
  const Baked_map map = bake_vertex_colors(fine, values, 1, light, options_of(200));
  const SMT::Tangent_frames frames = tangent_frames(light, vertex_normals(light));
  std::size_t beside = 0;
  for(const Texel_in_triangle& p : texels_in(gltf_triangles(light, frames), map.image)) {
    const Point_2 q = centre_of(p.x, p.y, map.image);
    const bool is_ring = p.triangle < 2 * 6; // which comes first where both are
    beside += is_ring && std::hypot(q.x() - 0.5, q.y() - 0.5) < 0.189 ? 1 : 0;
    if(is_ring || std::hypot(q.x() - 0.5, q.y() - 0.5) < 0.17) {
      ASSERT_EQ(*map.image.texel(p.x, p.y), is_ring ? 0.f : 1.f) << p.x << ", " << p.y;
    }
  }
  EXPECT_GT(beside, 100u);
}

TEST(Baked_map, is_filled_as_far_as_wanted_from_the_nearest_texel)
{
  const Textured_triangle_mesh mesh = ring(24);
  const std::vector<float> values = [&] {
    std::vector<float> result;
    for(const Point_3& p : mesh.points)
      result.push_back(float(1. + p.x() + 3. * p.y()));
    return result;
  }();
  const std::size_t size = 60;
  for(const std::size_t dilation : {std::size_t(0), std::size_t(1), std::size_t(4),
                                    SMT::unlimited_dilation}) {
    Baking_options options = options_of(size);
    options.dilation = dilation;
    const Baked_map map = bake_vertex_colors(mesh, values, 1, mesh, options);
    for(std::size_t i = 0; i < size * size; ++i) {
      double least = 1e300;
      std::vector<float> nearest;
      for(std::size_t j = 0; j < size * size; ++j) {
        const double dx = double(i % size) - double(j % size),
                     dy = double(i / size) - double(j / size), d = dx * dx + dy * dy;
        if(!map.is_covered[j] || d > least)
          continue;
        if(d < least)
          nearest.clear();
        least = d;
        nearest.push_back(map.image.texels[j]);
      }
      const float value = map.image.texels[i];
      if(std::sqrt(least) <= double(dilation))
        ASSERT_GE(std::count(nearest.begin(), nearest.end(), value), 1) << i;
      else
        ASSERT_EQ(value, map.is_covered[i] ? value : 0.f);
    }
  }
}

// --- Other images

TEST(Displacement_map, has_distances_in_units_of_length)
{
  const Textured_triangle_mesh light = ball_in_cube(4);
  for(const double unit : {1., 1e-6, 1e6}) {
    Textured_triangle_mesh inner = light, outer = light;
    for(Point_3& p : inner.points)
      p = Point_3(unit * p.x(), unit * p.y(), unit * p.z());
    for(Point_3& p : outer.points)
      p = Point_3(1.1 * unit * p.x(), 1.1 * unit * p.y(), 1.1 * unit * p.z());
    const auto above = bake_displacement(outer, inner, options_of(100, 2));
    const auto below = bake_displacement(inner, outer, options_of(100, 2));
    ASSERT_EQ(above.map.error, "");
    EXPECT_NEAR(above.lowest / unit, 0.1, 0.001); // triangles lie within 0.2 % of the sphere
    EXPECT_NEAR(above.highest / unit, 0.1, 0.001);
    EXPECT_NEAR(below.lowest / unit, -0.1, 0.001);
    EXPECT_NEAR(below.highest / unit, -0.1, 0.001);
    EXPECT_LE(above.lowest, above.highest);
    for(const float value : above.map.image.texels) {
      ASSERT_GE(value, above.lowest);
      ASSERT_LE(value, above.highest);
    }
  }
}

TEST(Color_map, interpolates_what_vertices_have)
{
  const Textured_triangle_mesh fine = over_square(16, bump), light = over_square(3, flat);
  std::vector<float> colors;
  for(const Point_3& p : fine.points)
    colors.insert(colors.end(), {float(p.x()), float(p.y()), float(2. - p.x() + p.y()), 1.f});
  for(const std::size_t samples : {1, 4}) {
    const Baked_map map = bake_vertex_colors(fine, colors, 4, light, options_of(50, samples));
    ASSERT_EQ(map.image.channels, 4u);
    for(std::size_t y = 0; y < 50; ++y)
      for(std::size_t x = 0; x < 50; ++x) {
        const Point_2 p = centre_of(x, y, map.image);
        const double expected[] = {p.x(), p.y(), 2. - p.x() + p.y(), 1.};
        for(int c = 0; c < 4; ++c)
          ASSERT_NEAR(map.image.texel(x, y)[c], expected[c], rounding);
      }
  }
}

TEST(Color_map, carries_an_image_over_from_former_texture_coordinates)
{
  const Textured_triangle_mesh fine = over_square(16, bump), light = over_square(3, flat);
  Textured_triangle_mesh former = fine; // the middle of the image, by a quarter turn
  for(Point_2& p : former.uv)
    p = Point_2(0.25 + 0.5 * p.y(), 0.75 - 0.5 * p.x());
  Texture_image image = {32, 16, 1, std::vector<float>(512)};
  for(std::size_t y = 0; y < 16; ++y)
    for(std::size_t x = 0; x < 32; ++x) {
      const Point_2 p = centre_of(x, y, image);
      *image.texel(x, y) = float(p.x() + 10. * p.y());
    }
  const Baked_map map = bake_image(fine, former, image, light, options_of(40));
  ASSERT_EQ(map.error, "");
  for(std::size_t y = 0; y < 40; ++y)
    for(std::size_t x = 0; x < 40; ++x) {
      const Point_2 p = centre_of(x, y, map.image);
      const double u = 0.25 + 0.5 * p.y(), v = 0.75 - 0.5 * p.x();
      ASSERT_NEAR(*map.image.texel(x, y), u + 10. * v, 1e-4);
    }
}

TEST(Image, is_repeated_beyond_the_unit_square)
{
  const Texture_image image = {2, 2, 1, {0.f, 1.f, 2.f, 3.f}};
  double value, other;
  sample_bilinear(image, 0.25, 0.75, &value); // the centre of the first texel
  EXPECT_EQ(value, 0.);
  sample_bilinear(image, 0.75, 0.25, &value);
  EXPECT_EQ(value, 3.);
  sample_bilinear(image, 0.5, 0.5, &value);
  EXPECT_EQ(value, 1.5);
  sample_bilinear(image, 0., 0.75, &value); // between the last and the first
  EXPECT_EQ(value, 0.5);
  for(const double u : {0.1, 0.6, 0.999})
    for(const double v : {0., 0.3, 0.8}) {
      sample_bilinear(image, u, v, &value);
      sample_bilinear(image, u - 3., v + 2., &other);
      EXPECT_NEAR(value, other, 1e-12);
    }
}

TEST(Image, is_encoded_to_the_nearest_integer)
{
  const Texture_image image
    = {6, 1, 1, {-1.f, 0.f, 1.f, -1.5f, 2.f, std::numeric_limits<float>::quiet_NaN()}};
  EXPECT_EQ(SMT::encode_unit_vectors<std::uint8_t>(image),
            (std::vector<std::uint8_t>{0, 128, 255, 0, 255, 0}));
  EXPECT_EQ(SMT::encode_unit_vectors<std::uint16_t>(image),
            (std::vector<std::uint16_t>{0, 32768, 65535, 0, 65535, 0}));
  EXPECT_EQ(SMT::encode_values<std::uint8_t>(image, 0., 0.)[4], 0); // a constant image
  for(int i = 0; i < 256; ++i) { // a decoder's x = i / 127.5 - 1 comes back
    const Texture_image one = {1, 1, 1, {float(i / 127.5 - 1.)}};
    EXPECT_EQ(SMT::encode_unit_vectors<std::uint8_t>(one)[0], i);
  }
}

// --- Errors

TEST(Baking, has_errors_for_bad_data)
{
  const Textured_triangle_mesh good = over_square(3, flat);
  const auto error = [&](const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                         const Baking_options& options = options_of(8)) {
    const Baked_map map = bake_normal_map(fine, light, options);
    EXPECT_EQ(map.error.empty(), !map.image.texels.empty());
    EXPECT_EQ(bake_displacement(fine, light, options).map.error, map.error);
    return map.error;
  };
  EXPECT_EQ(error(good, good), "");
  EXPECT_NE(error({}, good), "");
  EXPECT_NE(error(good, {}), "");
  const double bad_numbers[] = {std::nan(""), std::numeric_limits<double>::infinity(), 1e300};
  for(const double bad : bad_numbers) {
    Textured_triangle_mesh mesh = good;
    mesh.uv[4] = Point_2(0.5, bad);
    EXPECT_NE(error(mesh, good), "");
    EXPECT_NE(error(good, mesh), "");
    mesh = good;
    mesh.points[2] = Point_3(0., bad, 0.);
    if(bad != 1e300) {
      EXPECT_NE(error(mesh, good), "");
    }
  }
  Textured_triangle_mesh mesh = good;
  mesh.wedges.pop_back();
  EXPECT_NE(error(mesh, good), "");
  mesh = good;
  mesh.wedges[1][2] = Vertex_index(good.uv.size());
  EXPECT_NE(error(good, mesh), "");
  mesh = good;
  mesh.triangles[1][2] = Vertex_index(good.points.size());
  EXPECT_NE(error(mesh, good), "");
  EXPECT_NE(error(good, good, options_of(0)), "");
  EXPECT_NE(error(good, good, options_of(8, 0)), "");
  EXPECT_NE(error(good, good, options_of(std::size_t(-1), 2)), "");
  EXPECT_NE(error(good, good, options_of(8, std::size_t(-1))), "");
  EXPECT_NE(bake_image(good, good, Texture_image(), good, options_of(8)).error, "");
}

TEST(Baking, survives_what_has_no_area)
{
  Textured_triangle_mesh mesh = over_square(3, flat);
  for(Point_2& p : mesh.uv)
    p = Point_2(0.5, p.y());
  const Textured_triangle_mesh good = over_square(3, flat);
  Baked_map map = bake_normal_map(good, mesh, options_of(8)); // nothing of the light model
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_covered_texels, 0u);
  map = bake_normal_map(mesh, good, options_of(8)); // nothing of the fine one
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_samples_without, 64u);
  EXPECT_EQ(map.number_of_covered_texels, 0u);
  mesh = good;
  for(Point_3& p : mesh.points)
    p = Point_3(1., 1., 1.);
  map = bake_normal_map(mesh, mesh, options_of(8));
  for(const float value : map.image.texels)
    EXPECT_TRUE(std::isfinite(value));
}

TEST(Baking, can_be_stopped)
{
  Baking_options options = options_of(512);
  std::vector<double> told;
  options.progress = [&](double part) {
    told.push_back(part);
    return told.size() < 3;
  };
  const Textured_triangle_mesh mesh = over_square(3, flat);
  EXPECT_EQ(bake_normal_map(mesh, mesh, options).status,
            CGAL::Indexed_mesh::Mesh_status::CANCELLED);
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[0], 0.);
  EXPECT_LT(told[1], told[2]);
  EXPECT_LT(told[2], 1.);
}

} // namespace baking_test
