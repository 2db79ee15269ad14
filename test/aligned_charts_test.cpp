// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts that are aligned: turned so that much of their borders runs along the axes, straightened, and
// made rectangles if they have four sides.

#include <support/mesh_generators.h>
#include <support/packed_charts.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/axis_parallel_part.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace aligned_charts_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using SMT::Textured_triangle_mesh;
typedef Textured_triangle_mesh::Point_2 Uv;

constexpr std::uint64_t seed = 98100;
const std::string seed_text = ", seed " + std::to_string(seed);

// A flat rectangle of quads with a notch, turned in the texture.
Textured_triangle_mesh turned_notch(double angle)
{
  const Indexed_triangle_mesh plane = grid(12, 5);
  std::vector<bool> is_kept(plane.points.size());
  for(std::size_t v = 0; v < is_kept.size(); ++v)
    is_kept[v] = plane.points[v].x() < 7.5 || plane.points[v].y() < 2.5;
  const Indexed_triangle_mesh notched = without_vertices(plane, is_kept);
  Textured_triangle_mesh mesh = {notched.points, notched.triangles, {}, notched.triangles};
  const double c = std::cos(angle), s = std::sin(angle);
  for(const auto& p : mesh.points)
    mesh.uv.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  return mesh;
}

TEST(Aligned_charts, have_straight_borders_along_the_axes)
{
  Random random(seed + 4);
  SMT::Texture_atlas_options options = small_texture();
  options.is_aligned = true;
  for(int i = 0; i < 20; ++i) {
    const double angle = uniform(random, 0., 7.);
    const auto result = SMT::repack_texture_atlas(turned_notch(angle), options);
    ASSERT_EQ(result.error, "");
    EXPECT_NEAR(SMT::axis_parallel_part(result.atlas), 1., 1e-9) << angle << seed_text;
    for(std::size_t t = 0; t < result.atlas.mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        const auto &p = result.atlas.mesh.uv[result.atlas.mesh.wedges[t][c]],
                   &q = result.atlas.mesh.uv[result.atlas.mesh.wedges[t][(c + 1) % 3]];
        if(result.atlas.charts.is_seam(t, c)) {
          EXPECT_LT((std::min)(std::abs(p.x() - q.x()), std::abs(p.y() - q.y())), 1e-12) << angle;
        }
      }
  }
}

// The border of a diamond of quads runs across them: both directions are asked for, the other one by the
// diagonals of the quads, which shall not be seams.
TEST(Aligned_charts, of_a_texture_lie_along_the_edges_of_quads)
{
  Indexed_triangle_mesh square = grid(16, 16);
  square.triangles.clear();
  for(Vertex_index y = 0; y < 16; ++y) // diagonals run as the side of the diamond that is near
    for(Vertex_index x = 0; x < 16; ++x) {
      const Vertex_index a = 17 * y + x, b = a + 1, c = a + 18, d = a + 17;
      const bool is_falling = (x < 8) == (y < 8);
      square.triangles.push_back({a, b, is_falling ? d : c});
      square.triangles.push_back({is_falling ? b : a, c, d});
    }
  std::vector<bool> is_kept(square.points.size());
  for(std::size_t v = 0; v < is_kept.size(); ++v)
    is_kept[v] = std::abs(square.points[v].x() - 8.) + std::abs(square.points[v].y() - 8.) < 8.5;
  const Indexed_triangle_mesh diamond = without_vertices(square, is_kept);
  Textured_triangle_mesh mesh = {diamond.points, diamond.triangles, {}, diamond.triangles};
  const double angle = 0.3;
  for(const auto& p : mesh.points)
    mesh.uv.emplace_back(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                         std::sin(angle) * p.x() + std::cos(angle) * p.y());
  const auto is_diagonal = [&](Vertex_index a, Vertex_index b) {
    return mesh.points[a].x() != mesh.points[b].x() && mesh.points[a].y() != mesh.points[b].y();
  };
  std::vector<std::uint8_t> diagonals(mesh.triangles.size(), 0);
  std::map<std::pair<Vertex_index, Vertex_index>, int> count;
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c)
      ++count[std::minmax(t[c], t[(c + 1) % 3])];
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index a = mesh.triangles[t][c], b = mesh.triangles[t][(c + 1) % 3];
      if(is_diagonal(a, b) && count[std::minmax(a, b)] == 2)
        diagonals[t] = std::uint8_t(diagonals[t] | 1u << c);
    }
  SMT::Texture_atlas_options options = small_texture();
  options.is_aligned = true;
  for(const bool are_quads : {false, true}) {
    options.no_seams = are_quads ? diagonals : std::vector<std::uint8_t>();
    const auto result = SMT::repack_texture_atlas(mesh, options);
    ASSERT_EQ(result.error, "");
    const auto& uv = result.atlas.mesh.uv;
    const auto& w = result.atlas.mesh.wedges;
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        if(is_diagonal(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]))
          continue;
        const auto d = uv[w[t][(c + 1) % 3]] - uv[w[t][c]];
        const double part = (std::min)(std::abs(d.x()), std::abs(d.y()))
                          / (std::max)(std::abs(d.x()), std::abs(d.y()));
        EXPECT_NEAR(part, are_quads ? 0. : 1., 1e-9) << are_quads;
      }
  }
}

// Of a surface without creases; of all directions a dense set is tried.
TEST(Aligned_charts, have_as_much_of_their_borders_along_the_axes_as_possible)
{
  SMT::Texture_atlas_options options = small_texture();
  options.is_aligned = true;
  options.seam_price = std::numeric_limits<double>::infinity(); // parts of charts keep their direction
  const Indexed_triangle_mesh mesh = with_noise(torus(60, 40), 0.003, seed);
  const SMT::Texture_atlas_result built = SMT::build_texture_atlas(mesh, options);
  const SMT::Texture_atlas& atlas = built.atlas;
  ASSERT_EQ(error_in_atlas(mesh, atlas), "") << seed_text;
  const auto parallel = [&](std::size_t chart, double angle, double tolerance) {
    double sum = 0.;
    for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t)
      for(int c = 0; c < 3 && atlas.charts.chart[t] == chart; ++c)
        if(atlas.charts.is_seam(t, c)) {
          const auto d = atlas.mesh.uv[atlas.mesh.wedges[t][(c + 1) % 3]]
                         - atlas.mesh.uv[atlas.mesh.wedges[t][c]];
          const double turned = std::atan2(d.y(), d.x()) + angle, quarter = CGAL_PI / 2.;
          const double off = std::abs(turned - quarter * std::round(turned / quarter));
          sum += off <= tolerance ? std::sqrt(d * d) : 0.;
        }
    return sum;
  };
  for(std::size_t chart = 0; chart < atlas.charts.number_of_charts; ++chart) {
    const double degree = CGAL_PI / 180., there = parallel(chart, 0., degree);
    for(int i = 0; i < 180; ++i)
      EXPECT_LE(parallel(chart, 0.5 * i * degree, 0.5 * degree), 1.0001 * there)
        << chart << ", " << 0.5 * i << seed_text;
  }
}

// Of a torus, patches of so many columns and rows of its quads: what is mapped has four curved sides.
SMT::Face_charts patches(const Indexed_triangle_mesh& mesh, std::size_t minor, std::size_t columns,
                         std::size_t rows)
{
  std::vector<std::uint32_t> label;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    label.push_back(std::uint32_t(t / 2 / minor / columns * minor + t / 2 % minor / rows));
  return SMT::charts_of_labels(mesh.triangles, label);
}

// The part of the seams' length that is parallel to an axis to the last bit.
double exactly_parallel_part(const SMT::Texture_atlas& atlas)
{
  double parallel = 0., all = 0.;
  for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(atlas.charts.is_seam(t, c)) {
        const Uv &p = atlas.mesh.uv[atlas.mesh.wedges[t][c]],
                 &q = atlas.mesh.uv[atlas.mesh.wedges[t][(c + 1) % 3]];
        const double length = std::sqrt(CGAL::squared_distance(p, q));
        all += length;
        parallel += p.x() == q.x() || p.y() == q.y() ? length : 0.;
      }
  return parallel / all;
}

SMT::Texture_atlas_result patches_atlas(const Indexed_triangle_mesh& mesh,
                                        const SMT::Texture_atlas_options& options)
{
  return SMT::build_texture_atlas(mesh, options,
                                  SMT::Given_charts_segmenter(patches(mesh, 40, 10, 10)));
}

TEST(Aligned_charts, that_have_four_sides_become_rectangles)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(60, 40), 0.002, seed);
  SMT::Texture_atlas_options options = small_texture();
  options.bound.quasi_conformal = 3.5; // the sides of a patch are bent by some 30 degrees
  const SMT::Texture_atlas_result as_mapped = patches_atlas(mesh, options);
  options.is_aligned = true;
  const SMT::Texture_atlas_result result = patches_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << seed_text;
  EXPECT_EQ(result.atlas.charts.number_of_charts, 24u);
  EXPECT_LT(exactly_parallel_part(as_mapped.atlas), 0.01); // the test sees what is not
  EXPECT_EQ(exactly_parallel_part(result.atlas), 1.) << seed_text;
  for(const SMT::Chart_report& chart : result.report.charts)
    EXPECT_TRUE(chart.distortion.is_within(options.bound) && chart.is_one_to_one);
  // Equal densities as before
  for(const auto& chart : result.report.charts)
    EXPECT_NEAR(chart.distortion.uv_area / chart.distortion.area, 1., 1e-9);
}

TEST(Aligned_charts, stay_within_the_bound_or_as_they_are)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(60, 40), 0.002, seed);
  SMT::Texture_atlas_options options = small_texture();
  options.bound = {1., 1.}; // all charts are beyond it already
  const SMT::Texture_atlas_result as_mapped = patches_atlas(mesh, options);
  options.is_aligned = true;
  const SMT::Texture_atlas_result result = patches_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  for(std::size_t i = 0; i < result.report.charts.size(); ++i) {
    const SMT::Chart_distortion &before = as_mapped.report.charts[i].distortion,
                                &after = result.report.charts[i].distortion;
    EXPECT_LE(after.quasi_conformal, before.quasi_conformal);
    EXPECT_LE(after.area_scale, before.area_scale);
  }
}

TEST(Aligned_charts, have_straight_borders_whatever_the_surface)
{
  Random random(seed + 5);
  SMT::Texture_atlas_options options = small_texture();
  std::vector<Indexed_triangle_mesh> surfaces = {with_noise(sphere(is_sanitized ? 2 : 4), 0.02, seed)};
  if(!is_sanitized)
    surfaces.insert(surfaces.end(), {with_noise(torus(40, 20), 0.01, seed),
                                     with_hills(irregular_grid(30, 30, seed), 3., seed), cylinder(60, 20),
                                     with_holes(with_noise(torus(40, 20), 0.01, seed), 3, seed)});
  for(const Indexed_triangle_mesh& mesh : surfaces) {
    options.is_aligned = true;
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << seed_text;
    for(const SMT::Chart_report& chart : result.report.charts)
      EXPECT_TRUE(chart.distortion.is_within(options.bound) && chart.is_one_to_one);
    EXPECT_GT(exactly_parallel_part(result.atlas), 0.) << seed_text;
    // Threads and the unit of length do not count
    SMT::Texture_atlas_options threads = options;
    threads.threads = 3;
    const auto of_three = SMT::build_texture_atlas<CGAL::Parallel_tag>(mesh, threads);
    ASSERT_EQ(of_three.atlas.mesh.uv.size(), result.atlas.mesh.uv.size());
    EXPECT_EQ(std::memcmp(of_three.atlas.mesh.uv.data(), result.atlas.mesh.uv.data(),
                          result.atlas.mesh.uv.size() * sizeof(Uv)), 0) << seed_text;
    const auto large = SMT::build_texture_atlas(scaled(mesh, 1024.), options);
    EXPECT_NEAR(exactly_parallel_part(large.atlas), exactly_parallel_part(result.atlas), 1e-6);
  }
}

// A disk has no straight border: it stays round.
TEST(Aligned_charts, that_are_round_stay_round)
{
  const Indexed_triangle_mesh mesh = disk(10, 120);
  SMT::Texture_atlas_options options = small_texture();
  options.is_aligned = true;
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(mesh, options, SMT::Component_segmenter());
  ASSERT_EQ(result.error, "");
  EXPECT_LT(exactly_parallel_part(result.atlas), 0.05);
  EXPECT_LT(result.report.charts.at(0).distortion.quasi_conformal, 1.01);
}

TEST(Aligned_charts, are_turned_by_quarters_only)
{
  packed_charts::Charts charts = packed_charts::mixed_charts();
  packed_charts::Packing_options options = packed_charts::small_page(160, 160);
  options.quarter_turns_only = true;
  const auto check = [&](const auto& packer) {
    const auto result = SMT::pack_charts(charts, options, packer);
    EXPECT_EQ(packed_charts::packing_error(charts, options, result), "");
    for(const auto& placement : result.placements) {
      const double quarters = placement.angle / (CGAL_PI / 2.);
      EXPECT_NEAR(quarters, std::round(quarters), 1e-9);
    }
  };
  check(SMT::Raster_packer());
  check(SMT::Horizon_packer());
}

TEST(Aligned_charts, that_are_rectangles_are_packed_in_rows)
{
  const packed_charts::Charts squares(9, rectangle_chart(1., 1.));
  packed_charts::Packing_options options = packed_charts::small_page(256, 256);
  options.quarter_turns_only = true;
  const auto result = SMT::pack_charts(squares, options);
  EXPECT_GT(result.utilisation, 0.85);
}

} // namespace aligned_charts_test
