// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components that are equal share their place in a texture; those that are not, do not.

#include <support/mesh_generators.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/equal_parts.h>
#include <CGAL/Surface_mesh_texturing/unstacked_atlas.h>

#include <gtest/gtest.h>

#include <array>
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

// --- Mirrored halves

// A plane with hills, and its mirror image at its side: nothing else of it is symmetric.
Indexed_triangle_mesh symmetric_hills(std::uint64_t s)
{
  const Indexed_triangle_mesh half = with_hills(irregular_grid(9, 14, seed + s), 1.5, seed + s + 1);
  Indexed_triangle_mesh mesh = half;
  std::vector<Vertex_index> image(half.points.size());
  for(Vertex_index v = 0; v < half.points.size(); ++v) {
    const Point_3& p = half.points[v];
    image[v] = v;
    if(p.x() > 0.) {
      image[v] = Vertex_index(mesh.points.size());
      mesh.points.emplace_back(-p.x(), p.y(), p.z());
    }
  }
  for(const Triangle_indices& t : half.triangles)
    mesh.triangles.push_back({image[t[0]], image[t[2]], image[t[1]]});
  return mesh;
}

TEST(Mirror_halves, are_found_wherever_the_plane_is)
{
  Random random(seed + 7);
  for(int i = 0; i < 8; ++i) {
    const Indexed_triangle_mesh mesh = copy_of(symmetric_hills(std::uint64_t(i)), random, i % 2 == 1);
    const SMT::Equal_parts parts
      = SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART);
    ASSERT_EQ(parts.error, "");
    EXPECT_EQ(parts.halved_components, 1u) << i << seed_text;
    EXPECT_EQ(parts.mirrored_copies, 1u);
    EXPECT_EQ(parts.number_of_parts, 2u);
    EXPECT_EQ(2 * parts.representatives.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(error_in_parts(mesh, parts, 1e-9), "") << i << seed_text;
    EXPECT_EQ(SMT::find_equal_parts(mesh).copies, 0u); // only if asked for
  }
}

TEST(Mirror_halves, of_copies_are_copies)
{
  Random random(seed + 8);
  Indexed_triangle_mesh mesh;
  for(const bool is_mirrored : {false, true, false})
    add(copy_of(symmetric_hills(0), random, is_mirrored), mesh);
  mesh = shuffled(mesh, seed);
  const SMT::Equal_parts parts = SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART);
  EXPECT_EQ(parts.halved_components, 3u) << seed_text;
  EXPECT_EQ(parts.copies, 5u) << seed_text;
  EXPECT_EQ(6 * parts.representatives.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(error_in_parts(mesh, parts, 1e-9), "") << seed_text;
}

// A sphere that is bent so that only one plane is left, across which triangles lie.
Indexed_triangle_mesh bent_sphere()
{
  Indexed_triangle_mesh mesh = sphere(3);
  for(Point_3& p : mesh.points)
    p = Point_3((1. + 0.3 * p.y() + 0.2 * p.z()) * p.x(), p.y() + 0.3 * p.z() * p.z(), p.z());
  return mesh;
}

TEST(Mirror_halves, may_have_triangles_between_them)
{
  const Indexed_triangle_mesh mesh = bent_sphere();
  const SMT::Equal_parts parts = SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART);
  EXPECT_EQ(parts.halved_components, 1u);
  EXPECT_EQ(error_in_parts(mesh, parts, 1e-9), "");
}

TEST(Mirror_halves, are_not_found_where_there_are_none)
{
  for(const Indexed_triangle_mesh& mesh :
      {model(0), with_noise(sphere(3), 0.01, seed), with_noise(torus(30, 15), 0.01, seed),
       grid(1, 1)}) // which is not worth a seam
    EXPECT_EQ(SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART).halved_components, 0u);
  Indexed_triangle_mesh mesh = symmetric_hills(0); // but for one point
  mesh.points.back() = mesh.points.back() + CGAL::Simple_cartesian<double>::Vector_3(0., 0., 0.1);
  EXPECT_EQ(SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART).halved_components, 0u);
}

// The length of each side of a triangle in the texture, in texels, in the order of its stand-in's corners.
std::array<double, 3> sides_in_texels(const SMT::Texture_atlas& atlas, const SMT::Equal_parts& parts,
                                      std::size_t t)
{
  std::array<double, 3> result;
  for(int c = 0; c < 3; ++c) {
    const auto& w = atlas.mesh.wedges[t];
    const auto d = atlas.mesh.uv[w[(c + 1) % 3]] - atlas.mesh.uv[w[c]];
    const int a = parts.corner[t][c], b = parts.corner[t][(c + 1) % 3];
    result[(a + 1) % 3 == b ? a : b]
      = std::hypot(d.x() * double(atlas.width), d.y() * double(atlas.height));
  }
  return result;
}

TEST(Mirror_halves, have_charts_that_are_mirror_images)
{
  Random random(seed + 9);
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 256;
  options.coarse_faces = 500;
  for(const Indexed_triangle_mesh& mesh :
      {symmetric_hills(3), copy_of(symmetric_hills(4), random, false), bent_sphere()}) {
    const SMT::Equal_parts parts = SMT::find_equal_parts(mesh, 1e-4, SMT::Mirror_halves::APART);
    ASSERT_EQ(parts.halved_components, 1u) << seed_text;
    const SMT::Texture_atlas_result half = SMT::build_texture_atlas(parts.representatives, options);
    ASSERT_EQ(half.error, "");
    const SMT::Texture_atlas_result all = SMT::unstacked_atlas(mesh, parts, half, options);
    ASSERT_EQ(all.error, "");
    EXPECT_EQ(error_in_atlas(mesh, all.atlas), "") << seed_text; // no flip, no overlap, disks
    const std::size_t charts = all.atlas.charts.number_of_charts;
    const bool are_all_in_pairs = 2 * parts.representatives.triangles.size() == mesh.triangles.size();
    if(are_all_in_pairs) {
      EXPECT_EQ(charts, 2 * half.atlas.charts.number_of_charts);
      EXPECT_EQ(SMT::number_of_charts_with_equals(parts, all.atlas.charts), charts) << seed_text;
    }
    EXPECT_EQ(all.report.charts.size(), charts);
    std::vector<std::array<double, 3>> of_model(parts.representatives.triangles.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if(parts.triangle[parts.stand_in[t]] == t)
        of_model[parts.stand_in[t]] = sides_in_texels(all.atlas, parts, t);
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        EXPECT_NEAR(sides_in_texels(all.atlas, parts, t)[c], of_model[parts.stand_in[t]][c], 1e-6);
    // On each other: twice the texels
    const SMT::Texture_atlas_result stacked = SMT::stacked_atlas(mesh, parts, half);
    if(are_all_in_pairs) {
      EXPECT_EQ(stacked.atlas.mesh.uv.size(), 2 * half.atlas.mesh.uv.size());
      EXPECT_EQ(SMT::number_of_charts_with_equals(parts, stacked.atlas.charts), charts);
    }
    EXPECT_GT(stacked.report.texels_per_unit, 1.2 * all.report.texels_per_unit);
    // The number of threads does not matter
    SMT::Texture_atlas_options threads = options;
    threads.threads = 3;
    const auto of_three = SMT::unstacked_atlas<CGAL::Parallel_tag>(mesh, parts, half, threads);
    EXPECT_TRUE(of_three.atlas.mesh.uv == all.atlas.mesh.uv);
  }
}

} // namespace equal_parts_test
