// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components that are equal share their place in a texture; those that are not, do not.

#include <support/mesh_generators.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/equal_parts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace equal_parts_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::uint64_t seed = 77300;
const std::string seed_text = ", seed " + std::to_string(seed);

// Turned about two axes, moved, and mirrored if so wanted, with its triangles then the other way
// round; its vertices and triangles in another order.
Indexed_triangle_mesh copy_of(Indexed_triangle_mesh mesh, Random& random, bool is_mirrored)
{
  const double a = uniform(random, 0., 6.), b = uniform(random, 0., 6.);
  const double dx = uniform(random, -9., 9.), dy = uniform(random, -9., 9.);
  for(auto& p : mesh.points) {
    const double x = is_mirrored ? -p.x() : p.x();
    const double u = std::cos(a) * x - std::sin(a) * p.y(), v = std::sin(a) * x + std::cos(a) * p.y();
    p = Point_3(u + dx, std::cos(b) * v - std::sin(b) * p.z() + dy,
                std::sin(b) * v + std::cos(b) * p.z());
  }
  for(Triangle_indices& t : mesh.triangles)
    if(is_mirrored)
      std::swap(t[0], t[2]);
  return shuffled(mesh, random());
}

void add(const Indexed_triangle_mesh& part, Indexed_triangle_mesh& mesh)
{
  const Vertex_index first = Vertex_index(mesh.points.size());
  mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
  for(const Triangle_indices& t : part.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

// A part without symmetries, and two others of as many triangles.
Indexed_triangle_mesh model(std::uint64_t s)
{
  return with_hills(irregular_grid(9, 7, seed + s), 1.5, seed + s + 1);
}

// What is wrong with triangles that stand for others, by the definition: lengths, and neighbours.
std::string error_in_parts(const Indexed_triangle_mesh& mesh, const SMT::Equal_parts& parts,
                           double tolerance)
{
  const Indexed_triangle_mesh& other = parts.representatives;
  std::map<std::pair<std::uint32_t, Vertex_index>, Vertex_index> image; // of part and vertex
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const Triangle_indices& w = other.triangles[parts.stand_in[t]];
    for(int c = 0; c < 3; ++c) {
      const Vertex_index there = w[parts.corner[t][c]];
      if(image.insert({{parts.part[t], v[c]}, there}).first->second != there)
        return "a vertex of triangle " + std::to_string(t) + " stands for two";
      const double length = std::sqrt(CGAL::squared_distance(mesh.points[v[c]],
                                                             mesh.points[v[(c + 1) % 3]]));
      const double same = std::sqrt(CGAL::squared_distance(
        other.points[there], other.points[w[parts.corner[t][(c + 1) % 3]]]));
      if(std::abs(length - same) > tolerance)
        return "an edge of triangle " + std::to_string(t) + " has another length";
    }
  }
  return {};
}

TEST(Equal_parts, are_found_wherever_they_are)
{
  Random random(seed);
  const Indexed_triangle_mesh first = model(0), second = model(10);
  Indexed_triangle_mesh mesh;
  add(first, mesh);
  for(const bool is_mirrored : {false, true, true, false, false}) {
    add(copy_of(first, random, is_mirrored), mesh);
    add(copy_of(second, random, is_mirrored), mesh);
  }
  mesh = shuffled(mesh, seed);
  const SMT::Equal_parts parts = SMT::find_equal_parts(mesh);
  ASSERT_EQ(parts.error, "");
  EXPECT_EQ(parts.number_of_parts, 11u) << seed_text;
  EXPECT_EQ(parts.copies, 9u) << seed_text;
  EXPECT_GE(parts.mirrored_copies, 3u); // the first ones may be mirrored themselves
  EXPECT_LE(parts.mirrored_copies, 6u);
  EXPECT_EQ(parts.representatives.triangles.size(),
            first.triangles.size() + second.triangles.size());
  EXPECT_EQ(error_in_parts(mesh, parts, 1e-9), "") << seed_text;
}

TEST(Equal_parts, may_be_symmetric)
{
  Random random(seed + 1);
  for(const Indexed_triangle_mesh& part : {sphere(2), torus(24, 12), cylinder(30, 4), grid(1, 1)}) {
    Indexed_triangle_mesh mesh = part;
    add(copy_of(part, random, true), mesh);
    add(copy_of(part, random, false), mesh);
    const SMT::Equal_parts parts = SMT::find_equal_parts(mesh);
    EXPECT_EQ(parts.copies, 2u) << part.triangles.size() << seed_text;
    EXPECT_EQ(error_in_parts(mesh, parts, 1e-4), "");
  }
}

TEST(Equal_parts, are_not_those_that_differ_at_all)
{
  Random random(seed + 2);
  const Indexed_triangle_mesh part = model(0);
  const auto copies_of_changed = [&](Indexed_triangle_mesh other) {
    Indexed_triangle_mesh mesh = part;
    add(copy_of(std::move(other), random, false), mesh);
    return SMT::find_equal_parts(mesh).copies;
  };
  EXPECT_EQ(copies_of_changed(part), 1u);
  Indexed_triangle_mesh moved = part; // by a hundredth of its extent
  moved.points[40] = moved.points[40] + CGAL::Simple_cartesian<double>::Vector_3(0., 0., 0.1);
  EXPECT_EQ(copies_of_changed(moved), 0u);
  EXPECT_EQ(copies_of_changed(scaled(part, 1.01)), 0u);
  EXPECT_EQ(copies_of_changed(with_holes(part, 1, seed)), 0u);
  Indexed_triangle_mesh flipped = grid(6, 6), other = grid(6, 6); // one diagonal is another
  other.triangles[40] = {flipped.triangles[40][0], flipped.triangles[40][1],
                         flipped.triangles[41][2]};
  other.triangles[41] = {flipped.triangles[40][1], flipped.triangles[40][2],
                         flipped.triangles[41][2]};
  add(translated(other, 20., 0., 0.), flipped);
  EXPECT_EQ(SMT::find_equal_parts(flipped).copies, 0u);
  EXPECT_NE(SMT::find_equal_parts({part.points, {{0, 1, 999}}}).error, "");
}

TEST(Equal_parts, share_their_place_in_an_atlas)
{
  Random random(seed + 3);
  Indexed_triangle_mesh mesh;
  for(const bool is_mirrored : {false, true, false}) {
    add(copy_of(torus(24, 12), random, is_mirrored), mesh);
    add(copy_of(model(0), random, is_mirrored), mesh);
  }
  add(sphere(2), mesh);
  const SMT::Equal_parts parts = SMT::find_equal_parts(mesh);
  ASSERT_EQ(parts.copies, 4u) << seed_text;
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 256;
  const SMT::Texture_atlas_result one = SMT::build_texture_atlas(parts.representatives, options);
  ASSERT_EQ(one.error, "");
  EXPECT_EQ(error_in_atlas(parts.representatives, one.atlas), "") << seed_text;
  const SMT::Texture_atlas_result all = SMT::stacked_atlas(mesh, parts, one);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(error_in_charts(mesh, all.atlas.charts), "") << seed_text;
  EXPECT_EQ(all.report.charts.size(), all.atlas.charts.number_of_charts);
  EXPECT_EQ(all.atlas.page.size(), all.atlas.charts.number_of_charts);
  std::map<Vertex_index, Vertex_index> vertex; // of wedges
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index w = all.atlas.mesh.wedges[t][c];
      EXPECT_EQ(vertex.insert({w, mesh.triangles[t][c]}).first->second, mesh.triangles[t][c]);
      EXPECT_EQ(all.atlas.mesh.uv[w],
                one.atlas.mesh.uv[one.atlas.mesh.wedges[parts.stand_in[t]][parts.corner[t][c]]]);
    }
  EXPECT_EQ(vertex.size(), all.atlas.mesh.uv.size());
  // Seams are where the texture coordinates differ, and nowhere else.
  EXPECT_EQ(SMT::charts_of_texture(all.atlas.mesh).seams, all.atlas.charts.seams);
  EXPECT_GT(all.report.seam_length, one.report.seam_length);
}

TEST(Equal_parts, without_any_the_atlas_is_what_it_was)
{
  const Indexed_triangle_mesh mesh = torus(24, 12);
  const SMT::Equal_parts parts = SMT::find_equal_parts(mesh);
  EXPECT_EQ(parts.copies, 0u);
  EXPECT_EQ(parts.representatives.triangles, mesh.triangles);
  const SMT::Texture_atlas_result one = SMT::build_texture_atlas(parts.representatives);
  EXPECT_EQ(SMT::stacked_atlas(mesh, parts, one).atlas.mesh.wedges, one.atlas.mesh.wedges);
}

} // namespace equal_parts_test
