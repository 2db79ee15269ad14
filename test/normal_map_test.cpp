// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of a fine surface in the texture of a light model, by equal texture coordinates, and what
// renderers see of them.

#include <support/baked_models.h>
#include <support/textured_meshes.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace normal_map_test {

using namespace test_support;
using namespace baked_models;

// Of a component of a vector with 8 bits: half a step of 2 / 255. An angle: sqrt(3) of it, and as
// much again where the frame of tangent space is far from orthonormal.
constexpr double half_step = 1. / 255.;

// --- A renderer's view of a mesh: attributes of vertices, no more

// What a fragment shader does at a place of a triangle: vertex attributes interpolated, the
// bitangent from them, no normalization before the end.
Vector_3 shaded_normal(const std::array<Gltf_vertex, 3>& t, const std::array<double, 3>& weights,
                       const Vector_3& texel)
{
  Vector_3 n(0., 0., 0.), tangent(0., 0., 0.);
  for(int c = 0; c < 3; ++c) {
    n = n + weights[c] * t[c].normal;
    tangent = tangent + weights[c] * t[c].tangent;
  }
  const Vector_3 bitangent = t[0].w * cross_product(n, tangent);
  const Vector_3 v = texel.x() * tangent + texel.y() * bitangent + texel.z() * n;
  return v / std::sqrt(v * v);
}

// --- Normal maps

TEST(Normal_map, of_a_plane_is_constant)
{
  for(const std::size_t samples : {1, 2, 3}) {
    const Baked_map map
      = bake_normal_map(over_square(8, flat), over_square(3, flat), options_of(40, samples));
    ASSERT_EQ(map.error, "");
    EXPECT_EQ(map.number_of_covered_texels, 1600u);
    EXPECT_EQ(map.number_of_samples, 1600u * samples * samples);
    EXPECT_EQ(map.number_of_samples_beside, 0u);
    for(std::size_t i = 0; i < 1600; ++i)
      for(int c = 0; c < 3; ++c)
        ASSERT_EQ(map.image.texels[3 * i + c], c == 2 ? 1.f : 0.f);
    const auto bytes = SMT::encode_unit_vectors<std::uint8_t>(map.image);
    EXPECT_EQ(bytes[0], 128);
    EXPECT_EQ(bytes[2], 255);
  }
}

TEST(Normal_map, of_a_surface_on_itself_is_constant)
{
  for(const auto& [name, input] : textured_meshes(seed)) {
    const Textured_triangle_mesh mesh = in_unit_square(input);
    const Baked_map map = bake_normal_map(mesh, mesh, options_of(100, 2));
    ASSERT_EQ(map.error, "") << name;
    for(std::size_t i = 0; i < map.image.texels.size(); ++i)
      ASSERT_NEAR(map.image.texels[i], i % 3 == 2 ? 1. : 0., rounding) << name << seed_text;
  }
}

TEST(Normal_map, of_a_sphere_in_object_space_is_that_of_the_sphere)
{
  const Textured_triangle_mesh fine = ball_in_cube(5), light = ball_in_cube(3);
  const Baked_map map
    = bake_normal_map(fine, fine, options_of(128, 1, Normal_space::OBJECT));
  std::vector<float> places;
  for(const Point_3& p : fine.points)
    for(int c = 0; c < 3; ++c)
      places.push_back(float(p[c]));
  const Baked_map positions = bake_vertex_colors(fine, places, 3, fine, options_of(128));
  ASSERT_EQ(positions.is_covered, map.is_covered);
  const Texture_image decoded = SMT::decode_values(
    SMT::encode_unit_vectors<std::uint8_t>(map.image), map.image, -1., 1.);
  const double of_vertices = normal_error(5), of_bytes = std::sqrt(3.) * half_step * 180. / CGAL_PI;
  for(std::size_t y = 0; y < 128; ++y)
    for(std::size_t x = 0; x < 128; ++x) {
      const Vector_3 expected = vector_of(positions.image, x, y);
      ASSERT_LT(degrees(vector_of(map.image, x, y), expected), of_vertices);
      ASSERT_LT(degrees(vector_of(decoded, x, y), expected), of_vertices + of_bytes);
    }
}

TEST(Normal_map, is_decoded_by_a_renderer_to_the_normals_of_the_fine_surface)
{
  const Textured_triangle_mesh fine_ball = ball_in_cube(5);
  const auto with_other_heights = [](Textured_triangle_mesh mesh) {
    for(Point_3& p : mesh.points)
      p = p + 0.03 * std::sin(5. * p.x() + 3. * p.y()) * Vector_3(0.3, -0.2, 1.);
    return mesh;
  };
  std::vector<Named_textured_mesh> lights = textured_meshes(seed);
  lights.push_back({"ball", cube_mapped(sphere(3))});
  for(const auto& [name, input] : lights) {
    const Textured_triangle_mesh light = in_unit_square(input);
    const Textured_triangle_mesh fine = with_other_heights(light);
    const SMT::Tangent_frames frames = tangent_frames(light, vertex_normals(light));
    const Baked_map map = bake_normal_map(fine, light, options_of(96));
    const Baked_map expected
      = bake_normal_map(fine, light, options_of(96, 1, Normal_space::OBJECT));
    const auto bytes = SMT::encode_unit_vectors<std::uint8_t>(map.image);
    const auto words = SMT::encode_unit_vectors<std::uint16_t>(map.image);
    const Texture_image image_8 = SMT::decode_values(bytes, map.image, -1., 1.);
    const Texture_image image_16 = SMT::decode_values(words, map.image, -1., 1.);
    const auto triangles = gltf_triangles(light, frames);
    std::vector<int> owners(96 * 96, 0); // charts that overlap show the first triangle only
    const auto texels = texels_in(triangles, map.image);
    for(const Texel_in_triangle& p : texels)
      ++owners[p.y * 96 + p.x];
    std::size_t tried = 0;
    const double of_bytes = 2. * std::sqrt(3.) * half_step * 180. / CGAL_PI;
    for(const Texel_in_triangle& p : texels) {
      if(owners[p.y * 96 + p.x] != 1)
        continue;
      ++tried;
      const Vector_3 n = vector_of(expected.image, p.x, p.y);
      const auto decode = [&](const Texture_image& image) {
        return shaded_normal(triangles[p.triangle], p.weights, vector_of(image, p.x, p.y));
      };
      ASSERT_LT(degrees(decode(map.image), n), 0.01) << name << seed_text;
      ASSERT_LT(degrees(decode(image_8), n), of_bytes) << name << seed_text;
      ASSERT_LT(degrees(decode(image_16), n), 0.01 + of_bytes / 257.) << name << seed_text;
    }
    EXPECT_GT(tried, name == "charts of single triangles" ? 0u : 100u) << name;
  }
}

TEST(Normal_map, is_green_where_a_bump_faces_up_and_red_where_it_faces_right)
{
  // glTF: +X to the right, +Y up in the image, +Z to the viewer.
  const Baked_map map = bake_normal_map(over_square(64, bump), over_square(4, flat),
                                        options_of(64, 1));
  const auto bytes = SMT::encode_unit_vectors<std::uint8_t>(map.image);
  const auto at = [&](std::size_t x, std::size_t y, int c) { return bytes[3 * (64 * y + x) + c]; };
  EXPECT_GT(at(32, 16, 1), 130); // above the middle of the image, which is towards growing v
  EXPECT_LT(at(32, 48, 1), 125);
  EXPECT_GT(at(48, 32, 0), 130); // to the right
  EXPECT_LT(at(16, 32, 0), 125);
  for(std::size_t y = 0; y < 64; ++y)
    for(std::size_t x = 0; x < 64; ++x)
      ASSERT_GT(at(x, y, 2), 200);
}

TEST(Normal_map, of_a_mirrored_chart_is_the_mirror_image)
{
  const auto mirrored = [](Textured_triangle_mesh mesh) {
    for(Point_2& p : mesh.uv)
      p = Point_2(1. - p.x(), p.y());
    return mesh;
  };
  const Textured_triangle_mesh fine = over_square(32, [](double x, double y) {
    return bump(x, y) + 0.02 * std::sin(4. * x + 7. * y);
  });
  const Textured_triangle_mesh light = over_square(4, flat);
  const Texture_image image = bake_normal_map(fine, light, options_of(48)).image;
  const Texture_image other
    = bake_normal_map(mirrored(fine), mirrored(light), options_of(48)).image;
  for(std::size_t y = 0; y < 48; ++y)
    for(std::size_t x = 0; x < 48; ++x) {
      const Vector_3 n = vector_of(image, x, y), m = vector_of(other, 47 - x, y);
      ASSERT_NEAR(m.x(), -n.x(), rounding);
      ASSERT_NEAR(m.y(), n.y(), rounding);
      ASSERT_NEAR(m.z(), n.z(), rounding);
    }
}

TEST(Normal_map, does_not_depend_on_unit_and_place_of_the_meshes)
{
  const Textured_triangle_mesh fine = ball_in_cube(4);
  Textured_triangle_mesh light = fine;
  for(Point_3& p : light.points)
    p = Point_3(0.8 * p.x(), p.y(), p.z() + 0.1 * std::sin(9. * p.x()));
  const Texture_image image = bake_normal_map(fine, light, options_of(64)).image;
  for(const double unit : {1e-6, 1e6})
    for(const double place : {0., 1000.}) {
      const auto moved = [=](Textured_triangle_mesh mesh) {
        for(Point_3& p : mesh.points)
          p = Point_3(unit * (p.x() + place), unit * (p.y() - place), unit * p.z());
        return mesh;
      };
      const Texture_image other
        = bake_normal_map(moved(fine), moved(light), options_of(64)).image;
      for(std::size_t i = 0; i < image.texels.size(); ++i)
        ASSERT_NEAR(image.texels[i], other.texels[i], rounding) << unit << ", " << place;
    }
}

TEST(Normal_map, has_the_same_bytes_with_any_number_of_threads)
{
  const Textured_triangle_mesh fine = ball_in_cube(5);
  Textured_triangle_mesh light = fine;
  for(Point_3& p : light.points)
    p = Point_3(0.8 * p.x(), p.y(), p.z() + 0.1 * std::sin(9. * p.x()));
  const Baked_map map = bake_normal_map(fine, light, options_of(200, 2));
  for(const unsigned int threads : {2, 5}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    const Baked_map other = bake_normal_map(fine, light, options_of(200, 2));
    EXPECT_EQ(map.image.texels, other.image.texels);
    EXPECT_EQ(map.is_covered, other.is_covered);
    EXPECT_EQ(map.number_of_samples, other.number_of_samples);
  }
}

// --- What renderers see

TEST(Rendering_error, of_a_model_with_itself_is_none)
{
  const Textured_triangle_mesh ball = ball_in_cube(4);
  const SMT::Tangent_frames frames = tangent_frames(ball, vertex_normals(ball));
  const Baked_map map = bake_normal_map(ball, ball, options_of(64, 2));
  const auto error
    = SMT::rendering_error(ball, ball, frames, map.image, Normal_space::TANGENT, 100);
  EXPECT_LT(error.mean_angle, 0.01);
  EXPECT_LT(error.angle_95, 0.01);
  EXPECT_NEAR(error.mean_angle_without_map, 0., 1e-9); // compilers may round the two differently
  EXPECT_EQ(error.silhouette_difference, 0.);
  // Twelve disks whose diameter is that of the image
  EXPECT_NEAR(double(error.number_of_pixels), 12. * CGAL_PI / 4. * 1e4, 0.02 * 12e4);
}

TEST(Rendering_error, is_the_angle_between_what_is_seen)
{
  // A normal map that leans by 30 degrees everywhere
  const Textured_triangle_mesh ball = ball_in_cube(4);
  const SMT::Tangent_frames frames = tangent_frames(ball, vertex_normals(ball));
  Texture_image map = {4, 4, 3, {}};
  for(int i = 0; i < 16; ++i)
    map.texels.insert(map.texels.end(), {0.5f, 0.f, float(std::sqrt(0.75))});
  const auto error
    = SMT::rendering_error(ball, ball, frames, map, Normal_space::TANGENT, 100);
  EXPECT_NEAR(error.mean_angle, 30., 0.2); // interpolated frames are not quite orthonormal
  EXPECT_NEAR(error.angle_95, 30., 0.5);
}

TEST(Rendering_error, is_smaller_with_a_map_in_either_space_at_any_scale)
{
  const Textured_triangle_mesh light = ball_in_cube(3);
  Textured_triangle_mesh fine = light;
  for(Point_3& p : fine.points)
    p = p + 0.02 * std::sin(9. * p.x()) * (p - Point_3(0., 0., 0.));
  for(const Normal_space space : {Normal_space::TANGENT, Normal_space::OBJECT}) {
    SMT::Rendering_error first;
    for(const double unit : {1., 1e-6, 1e6}) {
      const auto moved = [unit](Textured_triangle_mesh mesh) {
        for(Point_3& p : mesh.points)
          p = Point_3(unit * p.x(), unit * p.y(), unit * p.z());
        return mesh;
      };
      const Textured_triangle_mesh f = moved(fine), l = moved(light);
      const SMT::Tangent_frames frames = tangent_frames(l, vertex_normals(l));
      const Baked_map map = bake_normal_map(f, l, options_of(256, 2, space));
      const auto error = SMT::rendering_error(f, l, frames, map.image, space, 128);
      EXPECT_LT(error.mean_angle, 0.5 * error.mean_angle_without_map);
      EXPECT_GE(error.angle_95, error.mean_angle);
      EXPECT_GT(error.silhouette_difference, 0.);
      EXPECT_LT(error.silhouette_difference, 0.05);
      if(first.number_of_pixels == 0)
        first = error;
      EXPECT_NEAR(error.mean_angle, first.mean_angle, 1e-3);
      EXPECT_NEAR(error.mean_angle_without_map, first.mean_angle_without_map, 1e-3);
    }
  }
}

} // namespace normal_map_test
