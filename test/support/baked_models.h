// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BAKED_MODELS_H
#define HLSCM_TEST_SUPPORT_BAKED_MODELS_H

// Surfaces in their textures, and what a renderer makes of baked images.

#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace baked_models {

namespace SMT = CGAL::Surface_mesh_texturing;

using namespace test_support;
using SMT::Baked_map;
using SMT::Baking_options;
using SMT::Normal_space;
using SMT::Texture_image;
using SMT::Vector_3;
using SMT::bake_normal_map;
using SMT::bake_vertex_colors;
using SMT::tangent_frames;
using SMT::vertex_normals;

constexpr std::uint64_t seed = 88200;

inline const std::string seed_text = ", seed " + std::to_string(seed);

// Floats in images, and the interpolation of numbers of the order of 1.
constexpr double rounding = 1e-5;

// The texture coordinates in the middle of the unit square, both by the same factor.
inline Textured_triangle_mesh in_unit_square(Textured_triangle_mesh mesh, double margin = 0.03)
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
inline Textured_triangle_mesh over_square(Vertex_index n, double (*height)(double, double))
{
  Indexed_triangle_mesh mesh = grid(n, n);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x() / n, p.y() / n, height(p.x() / n, p.y() / n));
  return seen_from_above(mesh);
}

inline double flat(double, double) { return 0.; }

inline double bump(double x, double y)
{
  const double s = std::sin(CGAL_PI * x) * std::sin(CGAL_PI * y);
  return 0.05 * s * s;
}

inline Textured_triangle_mesh ball_in_cube(int subdivisions)
{
  return in_unit_square(cube_mapped(sphere(subdivisions)), 0.02);
}

inline Baking_options options_of(std::size_t size, std::size_t samples = 1,
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
inline double normal_error(int subdivisions) { return 90. / 8. * std::ldexp(1., -subdivisions); }

inline double degrees(const Vector_3& a, const Vector_3& b)
{
  const Vector_3 c = cross_product(a, b);
  return std::atan2(std::sqrt(c * c), a * b) * 180. / CGAL_PI;
}

inline Vector_3 vector_of(const Texture_image& image, std::size_t x, std::size_t y)
{
  const float* v = image.texel(x, y);
  return Vector_3(v[0], v[1], v[2]);
}

struct Gltf_vertex
{
  Point_2 uv;
  Vector_3 normal, tangent;
  double w;
};

inline std::vector<std::array<Gltf_vertex, 3>> gltf_triangles(const Textured_triangle_mesh& mesh,
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
inline std::array<double, 3> weights_in(const std::array<Gltf_vertex, 3>& t, const Point_2& p)
{
  const auto area = [](const Point_2& a, const Point_2& b, const Point_2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  const double all = area(t[0].uv, t[1].uv, t[2].uv);
  return {area(p, t[1].uv, t[2].uv) / all, area(t[0].uv, p, t[2].uv) / all,
          area(t[0].uv, t[1].uv, p) / all};
}

inline Point_2 centre_of(std::size_t x, std::size_t y, const Texture_image& image)
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

inline std::vector<Texel_in_triangle> texels_in(const std::vector<std::array<Gltf_vertex, 3>>& triangles,
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

} // namespace baked_models

#endif // HLSCM_TEST_SUPPORT_BAKED_MODELS_H
