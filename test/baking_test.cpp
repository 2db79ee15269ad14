// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Baking: which samples lie in which triangle, tangent frames as a renderer uses them, normals,
// distances and colours of a fine surface in the texture of a light model, by equal texture
// coordinates and by rays, and what renderers see of it.

#include <support/textured_meshes.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#if __has_include(<embree3/rtcore.h>) && !defined(HLSCM_WITHOUT_EMBREE)
#define HLSCM_BAKING_TEST_EMBREE
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace baking_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using SMT::Baked_map;
using SMT::Baking_options;
using SMT::Normal_space;
using SMT::Texture_image;
using SMT::Vector_3;
using SMT::bake_displacement;
using SMT::bake_image;
using SMT::bake_normal_map;
using SMT::bake_vertex_colors;
using SMT::sample_bilinear;
using SMT::tangent_frames;
using SMT::vertex_normals;

constexpr std::uint64_t seed = 88200;
const std::string seed_text = ", seed " + std::to_string(seed);

// Floats in images, and the interpolation of numbers of the order of 1.
constexpr double rounding = 1e-5;

// Of a component of a vector with 8 bits: half a step of 2 / 255. An angle: sqrt(3) of it, and as
// much again where the frame of tangent space is far from orthonormal.
constexpr double half_step = 1. / 255.;

// --- Meshes

// The texture coordinates in the middle of the unit square, both by the same factor.
Textured_triangle_mesh in_unit_square(Textured_triangle_mesh mesh, double margin = 0.03)
{
  double lo[2] = {1e300, 1e300}, hi[2] = {-1e300, -1e300};
  for(const Point_2& p : mesh.uv)
    for(int c = 0; c < 2; ++c) {
      lo[c] = (std::min)(lo[c], p[c]);
      hi[c] = (std::max)(hi[c], p[c]);
    }
  const double scale = (1. - 2. * margin) / (std::max)(hi[0] - lo[0], hi[1] - lo[1]);
  for(Point_2& p : mesh.uv)
    p = Point_2(margin + scale * (p.x() - lo[0]), margin + scale * (p.y() - lo[1]));
  return mesh;
}

// Over the unit square, whose points are the texture coordinates too.
Textured_triangle_mesh over_square(Vertex_index n, double (*height)(double, double))
{
  Indexed_triangle_mesh mesh = grid(n, n);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x() / n, p.y() / n, height(p.x() / n, p.y() / n));
  return seen_from_above(mesh);
}

double flat(double, double) { return 0.; }

double bump(double x, double y)
{
  const double s = std::sin(CGAL_PI * x) * std::sin(CGAL_PI * y);
  return 0.05 * s * s;
}

Textured_triangle_mesh ball_in_cube(int subdivisions)
{
  return in_unit_square(cube_mapped(sphere(subdivisions)), 0.02);
}

Baking_options options_of(std::size_t size, std::size_t samples = 1,
                          Normal_space space = Normal_space::TANGENT)
{
  Baking_options options;
  options.width = options.height = size;
  options.samples = samples;
  options.space = space;
  return options;
}

// By how many degrees normals of vertices of sphere(n) may be off: an eighth of an edge. Those of
// the triangles, whose mean they are, are off by half of one.
double normal_error(int subdivisions) { return 90. / 8. * std::ldexp(1., -subdivisions); }

double degrees(const Vector_3& a, const Vector_3& b)
{
  const Vector_3 c = cross_product(a, b);
  return std::atan2(std::sqrt(c * c), a * b) * 180. / CGAL_PI;
}

Vector_3 vector_of(const Texture_image& image, std::size_t x, std::size_t y)
{
  const float* v = image.texel(x, y);
  return Vector_3(v[0], v[1], v[2]);
}

// --- A renderer's view of a mesh: attributes of vertices, no more

struct Gltf_vertex
{
  Point_2 uv;
  Vector_3 normal, tangent;
  double w;
};

std::vector<std::array<Gltf_vertex, 3>> gltf_triangles(const Textured_triangle_mesh& mesh,
                                                       const SMT::Tangent_frames& frames)
{
  std::vector<std::array<Gltf_vertex, 3>> result;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Gltf_vertex, 3> triangle;
    for(int c = 0; c < 3; ++c) {
      const SMT::Tangent_frame& frame = frames.frames[frames.corners[t][c]];
      EXPECT_EQ(frame.vertex, mesh.triangles[t][c]);
      triangle[c] = {mesh.uv[frame.wedge], frames.normals[frame.vertex], frame.tangent, frame.sign};
    }
    result.push_back(triangle);
  }
  return result;
}

// The barycentric coordinates of a place in the texture, in any triangle.
std::array<double, 3> weights_in(const std::array<Gltf_vertex, 3>& t, const Point_2& p)
{
  const auto area = [](const Point_2& a, const Point_2& b, const Point_2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  const double all = area(t[0].uv, t[1].uv, t[2].uv);
  return {area(p, t[1].uv, t[2].uv) / all, area(t[0].uv, p, t[2].uv) / all,
          area(t[0].uv, t[1].uv, p) / all};
}

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

Point_2 centre_of(std::size_t x, std::size_t y, const Texture_image& image)
{
  return Point_2((double(x) + 0.5) / double(image.width),
                 1. - (double(y) + 0.5) / double(image.height));
}

// The triangle that has the centres of texels well inside, by trial of all.
struct Texel_in_triangle
{
  std::size_t x, y, triangle;
  std::array<double, 3> weights;
};

std::vector<Texel_in_triangle> texels_in(const std::vector<std::array<Gltf_vertex, 3>>& triangles,
                                         const Texture_image& image)
{
  std::vector<Texel_in_triangle> result;
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    double lo[2] = {2., 2.}, hi[2] = {-1., -1.};
    for(const Gltf_vertex& v : triangles[t])
      for(int c = 0; c < 2; ++c) {
        lo[c] = (std::min)(lo[c], v.uv[c]);
        hi[c] = (std::max)(hi[c], v.uv[c]);
      }
    const double w = double(image.width), h = double(image.height);
    for(double x = (std::max)(0., std::floor(lo[0] * w)); x <= hi[0] * w && x < w; ++x)
      for(double y = (std::max)(0., std::floor((1. - hi[1]) * h));
          y <= (1. - lo[1]) * h && y < h; ++y) {
        const std::size_t i = std::size_t(x), j = std::size_t(y);
        const auto weights = weights_in(triangles[t], centre_of(i, j, image));
        if(*std::min_element(weights.begin(), weights.end()) > 1e-6)
          result.push_back({i, j, t, weights});
      }
  }
  return result;
}

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

// --- Frames

TEST(Vertex_normals, are_those_of_the_surface)
{
  for(const Vector_3& n : vertex_normals(over_square(5, flat)))
    EXPECT_EQ(n, Vector_3(0., 0., 1.));
  const Indexed_triangle_mesh ball = sphere(4);
  const std::vector<Vector_3> normals = vertex_normals(ball.points, ball.triangles);
  for(std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v] * normals[v], 1., 1e-12);
    EXPECT_LT(degrees(normals[v], ball.points[v] - Point_3(0., 0., 0.)),
              normal_error(4));
  }
  // A corner of a cube: whatever the triangulation, the angles of all three sides are the same
  const std::vector<Point_3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const std::vector<Triangle_indices> triangles
    = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 5, 4}, {0, 4, 6}, {0, 6, 3}};
  const Vector_3 n = vertex_normals(points, triangles)[0];
  for(int c = 0; c < 3; ++c)
    EXPECT_NEAR(n[c], -1. / std::sqrt(3.), 1e-12);
  // Of nothing but triangles without area
  EXPECT_EQ(vertex_normals({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})[1],
            Vector_3(0., 0., 1.));
}

TEST(Tangent_frames, are_orthonormal_and_follow_the_texture)
{
  for(const auto& [name, input] : textured_meshes(seed)) {
    const Textured_triangle_mesh mesh = in_unit_square(input);
    const SMT::Tangent_frames frames = tangent_frames(mesh, vertex_normals(mesh));
    for(const SMT::Tangent_frame& frame : frames.frames) {
      ASSERT_NEAR(frame.tangent * frame.tangent, 1., 1e-12) << name << seed_text;
      ASSERT_NEAR(frame.tangent * frames.normals[frame.vertex], 0., 1e-12) << name << seed_text;
    }
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      // How u and v change along the two edges from the first corner
      const auto& w = mesh.wedges[t];
      const auto p = mesh.uv[w[1]] - mesh.uv[w[0]], q = mesh.uv[w[2]] - mesh.uv[w[0]];
      const double sign = p.x() * q.y() - p.y() * q.x() > 0. ? 1. : -1.;
      for(int c = 0; c < 3; ++c) {
        const SMT::Tangent_frame& frame = frames.frames[frames.corners[t][c]];
        ASSERT_EQ(frame.sign, sign) << name;
        ASSERT_EQ(frame.vertex, mesh.triangles[t][c]) << name;
        ASSERT_EQ(mesh.uv[frame.wedge], mesh.uv[w[c]]) << name;
      }
    }
  }
}

TEST(Tangent_frames, are_means_weighted_with_angles)
{
  // The direction of growing u on a triangle leads from one point to that whose u is larger by 1.
  // At a corner it counts with the angle, both seen in the plane that is orthogonal to the normal.
  const Indexed_triangle_mesh hills = with_hills(irregular_grid(12, 9, seed), 2., seed + 1);
  const Textured_triangle_mesh mesh = textured(hills, [&](std::size_t, Vertex_index v) {
    const Point_3& p = hills.points[v];
    return Point_2(p.x() + 0.4 * std::sin(0.8 * (p.x() + p.y())), p.y() + 0.3 * std::sin(p.x()));
  });
  const std::vector<Vector_3> normals = vertex_normals(mesh);
  const SMT::Tangent_frames frames = tangent_frames(mesh, normals);
  ASSERT_EQ(frames.frames.size(), mesh.points.size()); // no triangle is turned over
  std::vector<Vector_3> sums(mesh.points.size(), Vector_3(0., 0., 0.));
  for(const Triangle_indices& t : mesh.triangles) {
    std::array<Gltf_vertex, 3> corners;
    Point_2 place(0., 0.);
    for(int c = 0; c < 3; ++c) {
      corners[c].uv = mesh.uv[mesh.wedges[std::size_t(&t - mesh.triangles.data())][c]];
      place = Point_2(place.x() + corners[c].uv.x() / 3., place.y() + corners[c].uv.y() / 3.);
    }
    const auto from = weights_in(corners, place);
    const auto to = weights_in(corners, Point_2(place.x() + 1., place.y()));
    Vector_3 along_u(0., 0., 0.);
    for(int c = 0; c < 3; ++c)
      along_u = along_u + (to[c] - from[c]) * (mesh.points[t[c]] - Point_3(0., 0., 0.));
    for(int c = 0; c < 3; ++c) {
      const Vector_3& n = normals[t[c]];
      const auto flattened = [&n](const Vector_3& v) { return v - (v * n) * n; };
      const Vector_3 a = flattened(mesh.points[t[(c + 1) % 3]] - mesh.points[t[c]]);
      const Vector_3 b = flattened(mesh.points[t[(c + 2) % 3]] - mesh.points[t[c]]);
      const Vector_3 u = flattened(along_u / std::sqrt(along_u * along_u));
      const double angle = std::acos(a * b / std::sqrt((a * a) * (b * b)));
      sums[t[c]] = sums[t[c]] + (angle / std::sqrt(u * u)) * u;
    }
  }
  for(const SMT::Tangent_frame& frame : frames.frames) {
    const Vector_3& sum = sums[frame.vertex];
    const Vector_3 expected = sum / std::sqrt(sum * sum);
    for(int c = 0; c < 3; ++c)
      ASSERT_NEAR(frame.tangent[c], expected[c], 1e-9) << frame.vertex << seed_text;
  }
}

TEST(Tangent_frames, are_not_shared_across_seams_nor_mirrors)
{
  // The right half of the texture is the left one, mirrored: no seam, but two orientations.
  Textured_triangle_mesh mesh = over_square(4, flat);
  for(Point_2& p : mesh.uv)
    p = Point_2((std::min)(p.x(), 1. - p.x()), p.y());
  SMT::Tangent_frames frames = tangent_frames(mesh, vertex_normals(mesh));
  EXPECT_EQ(frames.frames.size(), 25u + 5u);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool is_left = t % 8 < 4;
    for(const Vertex_index f : frames.corners[t]) {
      EXPECT_EQ(frames.frames[f].sign, is_left ? 1. : -1.);
      EXPECT_EQ(frames.frames[f].tangent, Vector_3(is_left ? 1. : -1., 0., 0.));
    }
  }
  // The torus in 12 rectangles of 9 x 6 squares
  mesh = cut_torus(36, 18, 4, 3);
  frames = tangent_frames(mesh, vertex_normals(mesh));
  EXPECT_EQ(frames.frames.size(), 12u * 10u * 7u);
}

TEST(Tangent_frames, of_triangles_without_area_in_the_texture_are_those_of_neighbours)
{
  // The last column of squares lies on a line in the texture.
  Textured_triangle_mesh mesh = over_square(4, bump);
  for(Point_2& p : mesh.uv)
    p = Point_2(-(std::min)(p.x(), 0.75), p.y());
  const SMT::Tangent_frames frames = tangent_frames(mesh, vertex_normals(mesh));
  EXPECT_EQ(frames.frames.size(), 25u);
  for(const SMT::Tangent_frame& frame : frames.frames) {
    EXPECT_EQ(frame.sign, -1.);
    EXPECT_NEAR(frame.tangent * frame.tangent, 1., 1e-12);
  }
  // No triangle with an area at all
  for(Point_2& p : mesh.uv)
    p = Point_2(0., 0.);
  for(const SMT::Tangent_frame& frame : tangent_frames(mesh, vertex_normals(mesh)).frames) {
    EXPECT_EQ(frame.sign, 1.);
    EXPECT_NEAR(frame.tangent * frame.tangent, 1., 1e-12);
  }
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

// --- Rays

template <class RayCaster>
Texture_image baked_by_rays(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                            std::size_t size)
{
  SMT::Baking_by_rays_options options;
  options.width = options.height = size;
  options.max_distance = 0.3;
  const Baked_map map = SMT::bake_normal_map_by_rays<RayCaster>(
    Indexed_triangle_mesh{fine.points, fine.triangles}, light, options);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_samples_without, 0u);
  return map.image;
}

double largest_difference(const Texture_image& a, const Texture_image& b)
{
  EXPECT_EQ(a.texels.size(), b.texels.size());
  double result = 0.;
  for(std::size_t i = 0; i < a.texels.size(); ++i)
    result = (std::max)(result, std::abs(double(a.texels[i]) - double(b.texels[i])));
  return result;
}

template <class RayCaster>
class Rays : public testing::Test
{};

#ifdef HLSCM_BAKING_TEST_EMBREE
typedef testing::Types<SMT::AABB_tree_ray_caster, SMT::Embree_ray_caster> Ray_casters;
#else
typedef testing::Types<SMT::AABB_tree_ray_caster> Ray_casters;
#endif
TYPED_TEST_SUITE(Rays, Ray_casters);

TYPED_TEST(Rays, find_what_equal_texture_coordinates_find)
{
  // Along the normals of a plane lies what has the same coordinates in the plane.
  const Textured_triangle_mesh fine = over_square(40, bump), light = over_square(3, flat);
  const Texture_image image = bake_normal_map(fine, light, options_of(64, 2)).image;
  EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(fine, light, 64), image), 1e-4);
  // The same surface on both sides: rays begin where they hit
  const Textured_triangle_mesh ball = ball_in_cube(3);
  const Texture_image own = baked_by_rays<TypeParam>(ball, ball, 64);
  EXPECT_LT(largest_difference(own, bake_normal_map(ball, ball, options_of(64, 2)).image), 1e-4);
}

TYPED_TEST(Rays, do_not_depend_on_unit_and_place)
{
  const Textured_triangle_mesh fine = over_square(40, bump), light = over_square(3, flat);
  const Texture_image image = baked_by_rays<TypeParam>(fine, light, 32);
  for(const double unit : {1e-6, 1e6}) {
    const auto moved = [unit](Textured_triangle_mesh mesh) {
      for(Point_3& p : mesh.points)
        p = Point_3(unit * (p.x() + 100.), unit * p.y(), unit * (p.z() - 100.));
      return mesh;
    };
    EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(moved(fine), moved(light), 32), image),
              1e-4);
  }
}

TYPED_TEST(Rays, see_no_surface_from_behind)
{
  // A slab: its lower side is nearer, but looks the other way.
  const auto height = [](double x, double y) { return 0.05 + bump(x, y); };
  Textured_triangle_mesh slab = over_square(20, height);
  const Texture_image image
    = bake_normal_map(slab, over_square(3, flat), options_of(32, 2)).image;
  const Vertex_index n = Vertex_index(slab.points.size());
  const std::size_t triangles = slab.triangles.size();
  for(const double level : {-0.01, 0.02, 0.03}) {
    const Vertex_index first = Vertex_index(slab.points.size());
    for(Vertex_index v = 0; v < n; ++v)
      slab.points.push_back(Point_3(slab.points[v].x(), slab.points[v].y(), level));
    for(std::size_t t = 0; t < triangles; ++t) {
      const Triangle_indices s = slab.triangles[t];
      slab.triangles.push_back({first + s[0], first + s[2], first + s[1]});
    }
  }
  EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(slab, over_square(3, flat), 32), image),
            1e-4);
}

TYPED_TEST(Rays, that_find_nothing_leave_the_texel_to_the_dilation)
{
  const Textured_triangle_mesh light = over_square(3, flat);
  Textured_triangle_mesh half = over_square(20, bump); // x < 0.5
  half.triangles.erase(std::remove_if(half.triangles.begin(), half.triangles.end(),
                                      [&](const Triangle_indices& t) {
                                        return half.points[t[0]].x() + half.points[t[1]].x()
                                               + half.points[t[2]].x() > 1.5;
                                      }),
                       half.triangles.end());
  SMT::Baking_by_rays_options options;
  options.width = options.height = 40;
  const Baked_map map = SMT::bake_normal_map_by_rays<TypeParam>(
    Indexed_triangle_mesh{half.points, half.triangles}, light, options);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_covered_texels, 800u);
  EXPECT_EQ(map.number_of_samples_without, 3200u);
  for(std::size_t x = 20; x < 40; ++x)
    for(int c = 0; c < 3; ++c)
      EXPECT_EQ(map.image.texel(x, 7)[c], map.image.texel(19, 7)[c]);
}

TYPED_TEST(Rays, have_errors_for_bad_data)
{
  const Textured_triangle_mesh light = over_square(3, flat);
  const auto error = [&](const Indexed_triangle_mesh& fine) {
    return SMT::bake_normal_map_by_rays<TypeParam>(fine, light).error;
  };
  EXPECT_NE(error({}), "");
  EXPECT_NE(error({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}), "");
  EXPECT_NE(error({{{1, 1, 1}, {0, std::nan(""), 0}, {0, 1, 0}}, {{0, 1, 2}}}), "");
}

#ifdef HLSCM_BAKING_TEST_EMBREE
TEST(Ray_casters, agree)
{
  // A light ball under a wavy one, whose charts are others
  Textured_triangle_mesh wavy = cut_torus(60, 30, 1, 1);
  for(Point_3& p : wavy.points)
    p = p + 0.02 * std::sin(11. * p.x() + 5. * p.z()) * (p - Point_3(0., 0., 0.));
  const Textured_triangle_mesh light = in_unit_square(cut_torus(24, 12, 4, 3));
  const Texture_image a = baked_by_rays<SMT::AABB_tree_ray_caster>(wavy, light, 80);
  const Texture_image b = baked_by_rays<SMT::Embree_ray_caster>(wavy, light, 80);
  EXPECT_LT(largest_difference(a, b), 1e-3); // floats find the triangle
  EXPECT_GT(largest_difference(a, bake_normal_map(light, light, options_of(80, 2)).image), 0.1);
}
#endif

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
