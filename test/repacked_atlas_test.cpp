// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts of a texture that are packed anew: each stays what it is but for its place, its direction
// and its size.

#include <support/chart_shapes.h>
#include <support/mesh_generators.h>
#include <support/packed_charts.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <string>
#include <vector>

namespace repacked_atlas_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using SMT::Textured_triangle_mesh;
typedef Textured_triangle_mesh::Point_2 Uv;

constexpr std::uint64_t seed = 98100;
const std::string seed_text = ", seed " + std::to_string(seed);

// The texture of an atlas, each chart turned, scaled and moved at random, some of them mirrored:
// they may lie on each other.
Textured_triangle_mesh scattered(const SMT::Texture_atlas& atlas, Random& random,
                                 std::size_t mirrored = 0)
{
  Textured_triangle_mesh result = atlas.mesh;
  const std::size_t n = atlas.charts.number_of_charts;
  std::vector<std::complex<double>> factor, shift;
  for(std::size_t i = 0; i < n; ++i) {
    factor.push_back(std::polar(uniform(random, 0.2, 3.), uniform(random, 0., 6.)));
    shift.emplace_back(uniform(random, -2., 2.), uniform(random, -2., 2.));
  }
  std::vector<bool> is_done(result.uv.size(), false);
  for(std::size_t t = 0; t < result.wedges.size(); ++t)
    for(const auto w : result.wedges[t])
      if(!is_done[w]) {
        const std::size_t i = atlas.charts.chart[t];
        std::complex<double> z(result.uv[w].x(), result.uv[w].y());
        z = factor[i] * (i < mirrored ? std::conj(z) : z) + shift[i];
        result.uv[w] = Uv(z.real(), z.imag());
        is_done[w] = true;
      }
  return result;
}

// The factor by which lengths of each chart have become texels; empty if one of the maps is not
// similar to what it was.
std::vector<double> scales(const Textured_triangle_mesh& given, const SMT::Texture_atlas& atlas)
{
  typedef std::complex<double> Number;
  const auto point = [](const Uv& p) { return Number(p.x(), p.y()); };
  std::vector<Number> factor(atlas.charts.number_of_charts, 0.);
  std::vector<double> longest(factor.size(), 0.);
  for(const bool is_check : {false, true})
    for(std::size_t t = 0; t < given.wedges.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        const std::size_t i = atlas.charts.chart[t], d = (c + 1) % 3;
        const Number p = point(given.uv[given.wedges[t][d]]) - point(given.uv[given.wedges[t][c]]);
        const Number q = (point(atlas.mesh.uv[atlas.mesh.wedges[t][d]])
                          - point(atlas.mesh.uv[atlas.mesh.wedges[t][c]])) * double(atlas.width);
        if(is_check && std::abs(factor[i] * p - q) > 1e-7 * std::abs(factor[i]) * longest[i])
          return {};
        if(!is_check && std::abs(p) > longest[i]) {
          longest[i] = std::abs(p);
          factor[i] = q / p;
        }
      }
  std::vector<double> result;
  for(const Number& f : factor)
    result.push_back(std::abs(f));
  return result;
}

// Texels along a unit of length of each chart, by areas.
std::vector<double> densities(const SMT::Texture_atlas& atlas)
{
  std::vector<double> area(atlas.charts.number_of_charts), texels(area.size());
  for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const auto& v = atlas.mesh.triangles[t];
    const Exact_triangle p = uv_triangle(atlas, t);
    area[atlas.charts.chart[t]] += std::sqrt(CGAL::squared_area(
      atlas.mesh.points[v[0]], atlas.mesh.points[v[1]], atlas.mesh.points[v[2]]));
    texels[atlas.charts.chart[t]]
      += std::abs(CGAL::area(p[0], p[1], p[2])) * double(atlas.width * atlas.height);
  }
  for(std::size_t i = 0; i < area.size(); ++i)
    texels[i] = std::sqrt(texels[i] / area[i]);
  return texels;
}

// The surfaces with atlases of several charts, and these.
struct Named_atlas
{
  std::string name;
  Indexed_triangle_mesh mesh;
  SMT::Texture_atlas atlas;
};

std::vector<Named_atlas> atlases()
{
  std::vector<Named_atlas> result;
  for(const Named_mesh& m : generated_meshes(seed)) {
    SMT::Texture_atlas_result atlas = SMT::build_texture_atlas(m.mesh, small_texture());
    EXPECT_EQ(atlas.error, "") << m.name;
    result.push_back({m.name, m.mesh, std::move(atlas.atlas)});
  }
  return result;
}

TEST(Repacked_atlas, keeps_the_charts_and_gives_them_equal_density)
{
  Random random(seed);
  for(const auto& [name, mesh, atlas] : atlases()) {
    const Textured_triangle_mesh given = scattered(atlas, random);
    const SMT::Repacked_atlas_result result = SMT::repack_texture_atlas(given, small_texture());
    ASSERT_EQ(result.error, "") << name << seed_text;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << seed_text;
    EXPECT_EQ(result.atlas.charts.seams, SMT::charts_of_texture(given).seams) << name;
    EXPECT_EQ(scales(given, result.atlas).size(), result.atlas.charts.number_of_charts) << name;
    EXPECT_EQ(result.mirrored_charts, 0u) << name;
    EXPECT_EQ(result.report.charts.size(), result.atlas.charts.number_of_charts) << name;
    for(const double density : densities(result.atlas))
      EXPECT_NEAR(density, result.report.texels_per_unit, 1e-6 * density) << name << seed_text;
  }
}

TEST(Repacked_atlas, keeps_relative_sizes_if_that_is_asked_for)
{
  Random random(seed + 1);
  for(const auto& [name, mesh, atlas] : atlases()) {
    const Textured_triangle_mesh given = scattered(atlas, random);
    SMT::Repacking_options as_given;
    as_given.scale = SMT::Chart_scale::AS_GIVEN;
    const SMT::Repacked_atlas_result result
      = SMT::repack_texture_atlas(given, small_texture(), as_given);
    ASSERT_EQ(result.error, "") << name << seed_text;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << seed_text;
    const std::vector<double> all = scales(given, result.atlas);
    ASSERT_FALSE(all.empty()) << name << seed_text;
    for(const double scale : all)
      EXPECT_NEAR(scale, all[0], 1e-6 * all[0]) << name << seed_text;
  }
}

TEST(Repacked_atlas, keeps_mirrored_charts_mirrored)
{
  Random random(seed + 2);
  const Indexed_triangle_mesh mesh = torus(30, 15);
  const SMT::Texture_atlas_result built = SMT::build_texture_atlas(mesh, small_texture());
  ASSERT_GT(built.atlas.charts.number_of_charts, 2u);
  const auto upright = SMT::repack_texture_atlas(built.atlas.mesh, small_texture());
  const auto result
    = SMT::repack_texture_atlas(scattered(built.atlas, random, 2), small_texture());
  ASSERT_EQ(result.error, "") << seed_text;
  EXPECT_EQ(result.mirrored_charts, 2u);
  for(std::size_t i = 0; i < result.report.charts.size(); ++i)
    EXPECT_EQ(result.report.charts[i].is_mirrored, i < 2) << i;
  EXPECT_FALSE(scales(scattered(built.atlas, random = Random(seed + 2), 2), result.atlas).empty());
  EXPECT_EQ(error_in_texels(result.atlas), "") << seed_text; // which counts upright charts only
  EXPECT_EQ(error_in_overlaps(SMT::internal::with_all_upright(result.atlas, result.report.charts))
              .find("flipped"), std::string::npos);
  EXPECT_EQ(result.report.distortion.flipped_faces, 0u); // as the mirror image
  EXPECT_NEAR(result.report.distortion.stretch_L2, upright.report.distortion.stretch_L2, 1e-6);
}

// A flat ring of quads, the k-th at the place that the map gives it.
template <class Map>
Textured_triangle_mesh ring(Vertex_index sectors, const Map& map)
{
  Textured_triangle_mesh mesh;
  for(Vertex_index i = 0; i < sectors; ++i)
    for(const double r : {1., 2.}) {
      const double a = 2. * CGAL_PI * i / sectors;
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.);
      mesh.uv.push_back(map(a, r));
    }
  for(Vertex_index i = 0; i < sectors; ++i) {
    const Vertex_index a = 2 * i, b = 2 * ((i + 1) % sectors);
    mesh.triangles.push_back({a, a + 1, b + 1});
    mesh.triangles.push_back({a, b + 1, b});
  }
  mesh.wedges = mesh.triangles;
  return mesh;
}

TEST(Repacked_atlas, takes_charts_that_are_no_disks)
{
  const auto flat = [](double a, double r) { return Uv(r * std::cos(a), r * std::sin(a)); };
  const auto result = SMT::repack_texture_atlas(ring(20, flat), small_texture());
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.atlas.charts.number_of_charts, 1u);
  EXPECT_EQ(error_in_overlaps(result.atlas), "");
}

TEST(Repacked_atlas, names_what_it_cannot_keep)
{
  const auto error = [](const Textured_triangle_mesh& mesh) {
    return SMT::repack_texture_atlas(mesh, small_texture());
  };
  // Twice around: no triangle is flipped, and the two borders do not cross themselves alone
  const auto twice = [](double a, double r) {
    return Uv(r * std::cos(2. * a), r * std::sin(2. * a));
  };
  auto result = error(ring(20, twice));
  EXPECT_EQ(result.defects.at(0).kind, SMT::Texture_defect::OVERLAP);
  EXPECT_EQ(result.defects.at(0).triangles[1] % 20, result.defects.at(0).triangles[0] % 20)
    << result.error; // the one that lies on it
  EXPECT_TRUE(result.atlas.mesh.triangles.empty());
  // A triangle turned over
  Indexed_triangle_mesh plane = grid(6, 6);
  Textured_triangle_mesh mesh = {plane.points, plane.triangles, {}, plane.triangles};
  for(const auto& p : plane.points)
    mesh.uv.emplace_back(p.x(), p.y());
  const Uv corner = mesh.uv[0];
  mesh.uv[0] = Uv(3. * mesh.uv[8].x() - 2. * corner.x(), 3. * mesh.uv[8].y() - 2. * corner.y());
  result = error(mesh);
  EXPECT_EQ(result.defects.at(0).kind, SMT::Texture_defect::FLIPPED_TRIANGLE) << result.error;
  EXPECT_EQ(result.defects.at(0).chart, 0u);
  const auto& flipped = mesh.triangles[result.defects.at(0).triangles[0]];
  EXPECT_NE(std::find(flipped.begin(), flipped.end(), 0u), flipped.end());
  EXPECT_NE(result.error.find("triangle "), std::string::npos) << result.error;
  EXPECT_EQ(result.defects.at(0).size, mesh.triangles.size());
  EXPECT_GE(result.defects.at(0).flipped, 1u);
  // The same kept, with a second chart beside it
  const Vertex_index first = Vertex_index(mesh.points.size());
  for(const Triangle_indices& t : plane.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  for(const auto& p : plane.points) {
    mesh.points.emplace_back(p.x(), p.y(), 9.);
    mesh.uv.emplace_back(p.x(), p.y());
  }
  mesh.wedges = mesh.triangles;
  SMT::Repacking_options keep;
  keep.defects = SMT::Defective_charts::KEEP;
  result = SMT::repack_texture_atlas(mesh, small_texture(), keep);
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_FALSE(result.report.charts.at(0).is_one_to_one);
  EXPECT_TRUE(result.report.charts.at(1).is_one_to_one);
  EXPECT_EQ(scales(mesh, result.atlas).size(), 2u);
  EXPECT_EQ(result.report.distortion.flipped_faces, result.defects[0].flipped);
  EXPECT_NEAR(densities(result.atlas)[0], densities(result.atlas)[1], 1e-6);
  // Nothing but a line
  for(Uv& p : mesh.uv)
    p = Uv(p.x(), 0.);
  result = error(mesh);
  EXPECT_EQ(result.defects.at(0).kind, SMT::Texture_defect::NO_AREA) << result.error;
  result = SMT::repack_texture_atlas(mesh, small_texture(), keep); // then there is nothing to keep
  EXPECT_NE(result.error.find("has no area"), std::string::npos) << result.error;
  // No coordinates
  mesh.uv.pop_back();
  EXPECT_EQ(error(mesh).status, CGAL::Indexed_mesh::Mesh_status::BAD_MESH);
  SMT::Texture_atlas_options none = small_texture();
  none.packing.width = 0;
  EXPECT_NE(SMT::repack_texture_atlas(ring(20, twice), none).error, "");
}

// Two rings on pages of their own; a ring in two sets cannot be.
TEST(Repacked_atlas, lies_on_the_pages_of_its_set)
{
  const auto flat = [](double a, double r) { return Uv(r * std::cos(a), r * std::sin(a)); };
  Textured_triangle_mesh mesh = ring(20, flat);
  const std::size_t faces = mesh.triangles.size();
  const auto first = Vertex_index(mesh.points.size());
  for(std::size_t t = 0; t < faces; ++t) {
    const Triangle_indices f = mesh.triangles[t];
    mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
  }
  for(std::size_t v = 0; v < first; ++v) {
    mesh.points.push_back(mesh.points[v]);
    mesh.uv.push_back(mesh.uv[v]);
  }
  mesh.wedges = mesh.triangles;
  SMT::Texture_atlas_options options = small_texture();
  options.page_set.assign(2 * faces, 0);
  std::fill(options.page_set.begin() + std::ptrdiff_t(faces), options.page_set.end(), 7);
  SMT::Repacked_atlas_result result = SMT::repack_texture_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  EXPECT_FALSE(result.chart_between_sets);
  EXPECT_EQ(result.atlas.number_of_pages, 2u);
  options.page_set[3] = 7;
  result = SMT::repack_texture_atlas(mesh, options);
  EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::BAD_OPTIONS);
  EXPECT_EQ(result.error, "triangle 0 and triangle 3 are in one chart, but in different sets of pages");
  ASSERT_TRUE(result.chart_between_sets);
  EXPECT_EQ(*result.chart_between_sets, std::make_pair(std::size_t(0), std::size_t(3)));
  options.page_set.pop_back();
  EXPECT_NE(SMT::repack_texture_atlas(mesh, options).error, "");
}

TEST(Repacked_atlas, does_not_depend_on_the_number_of_threads)
{
  Random random(seed + 3);
  const SMT::Texture_atlas_result built
    = SMT::build_texture_atlas(with_noise(torus(30, 15), 0.02, seed), small_texture());
  const Textured_triangle_mesh given = scattered(built.atlas, random);
  SMT::Texture_atlas_options options = small_texture();
  options.is_aligned = true;
  const auto one = SMT::repack_texture_atlas<CGAL::Sequential_tag>(given, options);
  options.threads = 3;
  const auto three = SMT::repack_texture_atlas<CGAL::Parallel_tag>(given, options);
  ASSERT_EQ(one.error, "");
  ASSERT_EQ(one.atlas.mesh.uv.size(), three.atlas.mesh.uv.size());
  EXPECT_EQ(std::memcmp(one.atlas.mesh.uv.data(), three.atlas.mesh.uv.data(),
                        one.atlas.mesh.uv.size() * sizeof(Uv)), 0) << seed_text;
  options.progress = [](double) { return false; };
  EXPECT_EQ(SMT::repack_texture_atlas(given, options).error, "cancelled");
}

} // namespace repacked_atlas_test
