// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ambient occlusion, seams that rather lie where the surface hides them, and an atlas that is finished early.

#include <support/chart_generators.h>
#include <support/mesh_generators.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/ambient_occlusion.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

namespace hidden_seams_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
typedef Indexed_triangle_mesh::Point_3 Point;

constexpr std::uint64_t seed = 86200;
const std::string seed_text = ", seed " + std::to_string(seed);

std::vector<float> occlusion_of(const Indexed_triangle_mesh& mesh, std::size_t directions = 64)
{
  return SMT::ambient_occlusion<SMT::AABB_tree_ray_caster>(mesh, directions);
}

// The inside of a cup; vertex 0 is the middle of its bottom.
Indexed_triangle_mesh cup(double radius, double height)
{
  constexpr Vertex_index n = 60;
  Indexed_triangle_mesh mesh;
  mesh.points.push_back(Point(0., 0., 0.));
  for(const double z : {0., height})
    for(Vertex_index i = 0; i < n; ++i)
      mesh.points.push_back(Point(radius * std::cos(2. * CGAL_PI * i / n),
                                  radius * std::sin(2. * CGAL_PI * i / n), z));
  for(Vertex_index i = 0; i < n; ++i) {
    const Vertex_index a = 1 + i, b = 1 + (i + 1) % n;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({b, a, b + n});
    mesh.triangles.push_back({b + n, a, a + n});
  }
  return mesh;
}

TEST(Ambient_occlusion, is_none_on_convex_surfaces)
{
  for(const float occlusion : occlusion_of(sphere(3)))
    EXPECT_EQ(occlusion, 0.f);
}

// From the middle of the bottom the sky is a disk in directions up to the angle whose tangent is the radius
// over the height: weighted by the cosine it has the part of the square of the sine.
TEST(Ambient_occlusion, in_a_cup_is_that_of_the_formula)
{
  for(const double height : {0.5, 1., 2., 4.}) {
    const std::vector<float> occlusion = occlusion_of(cup(1., height), 1000);
    EXPECT_NEAR(occlusion[0], height * height / (1. + height * height), 0.02) << height;
  }
}

TEST(Ambient_occlusion, does_not_depend_on_threads_nor_on_the_unit_of_length)
{
  Indexed_triangle_mesh mesh = torus(40, 20);
  const std::vector<float> occlusion = occlusion_of(mesh);
  EXPECT_LT(*std::min_element(occlusion.begin(), occlusion.end()), 0.01f);
  EXPECT_GT(*std::max_element(occlusion.begin(), occlusion.end()), 0.1f);
  {
    const CGAL::Blocked_execution::Thread_scope one(1);
    EXPECT_EQ(occlusion_of(mesh), occlusion);
  }
  for(auto& p : mesh.points)
    p = Point(1024. * p.x(), 1024. * p.y(), 1024. * p.z());
  EXPECT_EQ(occlusion_of(mesh), occlusion);
  EXPECT_EQ(occlusion_of(Indexed_triangle_mesh()), std::vector<float>());
}

// The mean ambient occlusion along the seams, on the mesh itself.
double occlusion_of_seams(const Indexed_triangle_mesh& mesh, const SMT::Texture_atlas& atlas,
                          const std::vector<float>& occlusion)
{
  double sum = 0., length = 0.;
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = mesh.triangles[t][c], w = mesh.triangles[t][(c + 1) % 3];
      const bool is_inner
        = adjacency.opposite(std::uint32_t(3 * t) + std::uint32_t(c)) != CGAL::Indexed_mesh::no_halfedge;
      if(!atlas.charts.is_seam(t, c) || !is_inner)
        continue;
      const double edge = std::sqrt(CGAL::squared_distance(mesh.points[v], mesh.points[w]));
      length += edge;
      sum += edge * 0.5 * (double(occlusion[v]) + double(occlusion[w]));
    }
  return length > 0. ? sum / length : 0.;
}

TEST(Hidden_seams, lie_where_the_surface_hides_them)
{
  double with = 0., without = 0., length_with = 0., length_without = 0.;
  std::vector<Named_mesh> meshes = generated_meshes(seed);
  meshes.push_back({"large torus", torus(80, 40)}); // a level is made of it
  for(const auto& [name, mesh] : meshes) {
    SMT::Texture_atlas_options options = small_texture();
    options.seam_price = std::numeric_limits<double>::infinity();
    options.may_stretch = false; // of so few charts a single one more or less would hide the rest
    const SMT::Texture_atlas_result plain = SMT::build_texture_atlas(mesh, options);
    EXPECT_TRUE(std::isnan(plain.report.seams.occlusion)) << name;
    options.occlusion = [](const Indexed_triangle_mesh& m) { return occlusion_of(m); };
    const SMT::Texture_atlas_result hidden = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(hidden.error, "") << name;
    EXPECT_EQ(error_in_atlas(mesh, hidden.atlas), "") << name << seed_text;
    const std::vector<float> occlusion = occlusion_of(mesh);
    const double mean = occlusion_of_seams(mesh, hidden.atlas, occlusion);
    EXPECT_NEAR(hidden.report.seams.occlusion, mean, 0.1) << name; // that is of the level
    with += mean;
    without += occlusion_of_seams(mesh, plain.atlas, occlusion);
    length_with += hidden.report.seams.relative_length;
    length_without += plain.report.seams.relative_length;
  }
  EXPECT_GT(with, 1.1 * without) << seed_text;
  EXPECT_LT(length_with, 1.1 * length_without) << seed_text;
}

// Where the mesh is another one than that of the search: cut into, or cut open.
TEST(Hidden_seams, go_with_other_options)
{
  const Indexed_triangle_mesh mesh = torus(40, 20);
  SMT::Texture_atlas_options options = small_texture();
  options.occlusion = [](const Indexed_triangle_mesh& m) { return occlusion_of(m); };
  options.has_smooth_seams = true;
  const SMT::Texture_atlas_result smooth = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(smooth.error, "");
  EXPECT_GT(smooth.atlas.new_vertices.size(), 0u);
  EXPECT_TRUE(smooth.report.seams.occlusion >= 0. && smooth.report.seams.occlusion <= 1.);
  options.has_smooth_seams = false;
  std::vector<std::uint32_t> half(mesh.triangles.size(), 0);
  std::fill(half.begin() + half.size() / 2, half.end(), 1);
  const std::vector<std::uint8_t> limits = SMT::charts_of_labels(mesh.triangles, half).seams;
  const SMT::Texture_atlas_result limited
    = SMT::build_texture_atlas(mesh, options, SMT::Constrained_segmenter<>(limits));
  ASSERT_EQ(limited.error, "");
  EXPECT_EQ(error_in_atlas(mesh, limited.atlas), "");
  EXPECT_TRUE(std::isnan(limited.report.seams.occlusion));
}

TEST(Hidden_seams, need_an_occlusion_of_each_vertex)
{
  SMT::Texture_atlas_options options = small_texture();
  options.occlusion = [](const Indexed_triangle_mesh&) { return std::vector<float>(7); };
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(sphere(2), options);
  EXPECT_NE(result.error.find("ambient occlusions of 7 vertices"), std::string::npos) << result.error;
}

// Whenever it is said to be enough there is a valid atlas.
TEST(Texture_atlas_that_is_enough, is_valid_at_any_time)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(60, 30), 0.01, seed);
  SMT::Texture_atlas_options options = small_texture();
  const SMT::Texture_atlas_result whole = SMT::build_texture_atlas(mesh, options);
  EXPECT_FALSE(whole.report.stopped_early);
  std::atomic<int> calls{0};
  for(const int most : {0, 1, 20, 300}) {
    calls = 0;
    options.is_enough = [&] { return calls++ >= most; };
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(result.error, "") << most;
    EXPECT_TRUE(result.report.stopped_early) << most;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << most << seed_text;
  }
  options.is_enough = [] { return true; }; // a segmenter that does not ask
  const SMT::Texture_atlas_result quick
    = SMT::build_texture_atlas(grid(20, 10), options, SMT::Component_segmenter());
  EXPECT_TRUE(quick.report.stopped_early);
  EXPECT_EQ(error_in_atlas(grid(20, 10), quick.atlas), "");
  options.is_enough = [] { return false; };
  const SMT::Texture_atlas_result same = SMT::build_texture_atlas(mesh, options);
  EXPECT_FALSE(same.report.stopped_early);
  EXPECT_EQ(same.atlas.charts.chart, whole.atlas.charts.chart);
  EXPECT_EQ(same.report.texels_per_unit, whole.report.texels_per_unit);
}

} // namespace hidden_seams_test
