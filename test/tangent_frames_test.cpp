// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of vertices, and tangent frames as a renderer uses them.

#include <support/baked_models.h>
#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tangent_frames_test {

using namespace test_support;
using namespace baked_models;

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

} // namespace tangent_frames_test
