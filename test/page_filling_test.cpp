// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts that are cut to fill the pages, and the measures of atlases.

#include <support/bad_surfaces.h>
#include <support/chart_generators.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Page_filler.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace page_filling_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::uint64_t seed = 71700;
const std::string seed_text = ", seed " + std::to_string(seed);
constexpr double infinity = std::numeric_limits<double>::infinity();

SMT::Texture_atlas_options with_price(double price)
{
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 256;
  options.coarse_faces = 500;
  options.seam_price = price;
  options.bending = 0.;
  return options;
}

// Shapes that fill a square badly: long, bent, in the form of a star, curved.
std::vector<Named_mesh> bad_shapes()
{
  const Indexed_triangle_mesh strip = with_noise(grid(160, 8), 0.1, seed);
  std::vector<Named_mesh> result = {{"strip", strip}};
  if(is_sanitized)
    return result;
  result.push_back({"hills", with_hills(grid(120, 10), 1.5, seed)});
  result.push_back({"ring", moved(strip, [](const Point_3& p) {
    const double angle = 0.035 * p.x(), radius = 24. + p.y();
    return Point_3(radius * std::cos(angle), radius * std::sin(angle), 0.);
  })});
  result.push_back({"star", moved(round_disk(24), [](const Point_3& p) {
    const double scale = 1. + 0.7 * std::cos(5. * std::atan2(p.y(), p.x()));
    return Point_3(scale * p.x(), scale * p.y(), 0.);
  })});
  result.push_back({"torus", torus(60, 20)});
  return result;
}

bool are_equal(const SMT::Texture_atlas& a, const SMT::Texture_atlas& b)
{
  return a.mesh.wedges == b.mesh.wedges && a.charts.chart == b.charts.chart
      && a.mesh.uv.size() == b.mesh.uv.size()
      && std::memcmp(a.mesh.uv.data(), b.mesh.uv.data(), a.mesh.uv.size() * sizeof(a.mesh.uv[0]))
           == 0;
}

TEST(Page_filling, cuts_give_a_valid_atlas_that_is_used_more)
{
  for(const Named_mesh& shape : bad_shapes()) {
    const auto whole = SMT::build_texture_atlas(shape.mesh, with_price(infinity));
    const auto filled = SMT::build_texture_atlas(shape.mesh, with_price(0.02));
    ASSERT_EQ(whole.error + filled.error, "") << shape.name << seed_text;
    EXPECT_EQ(error_in_atlas(shape.mesh, filled.atlas), "") << shape.name << seed_text;
    EXPECT_EQ(whole.report.page_cuts, 0u) << shape.name << seed_text;
    EXPECT_GE(filled.report.charts.size(), whole.report.charts.size() + filled.report.page_cuts);
    // Never less; and much more where a chart is long
    EXPECT_GE(filled.report.utilisation, whole.report.utilisation - 1e-9) << shape.name << seed_text;
    EXPECT_GT(filled.report.utilisation, 0.6) << shape.name << seed_text;
    EXPECT_EQ(filled.report.page_cuts == 0, are_equal(whole.atlas, filled.atlas))
      << shape.name << seed_text;
    if(shape.name == "strip") {
      EXPECT_GT(filled.report.utilisation, whole.report.utilisation + 0.4) << seed_text;
    }
    for(const SMT::Chart_report& chart : filled.report.charts) {
      EXPECT_TRUE(chart.is_one_to_one) << shape.name << seed_text;
      EXPECT_TRUE(chart.distortion.is_within(SMT::Distortion_bound())) << shape.name << seed_text;
    }
  }
}

// The sides of triangles in the texture are to those without cuts as those of the chart's first one.
TEST(Page_filling, parts_keep_the_map_of_their_chart)
{
  const Indexed_triangle_mesh mesh = with_noise(grid(160, 8), 0.1, seed);
  const auto whole = SMT::build_texture_atlas(mesh, with_price(infinity));
  const auto filled = SMT::build_texture_atlas(mesh, with_price(0.02));
  ASSERT_EQ(whole.error + filled.error, "");
  ASSERT_GT(filled.report.page_cuts, 0u);
  std::vector<double> scale(filled.report.charts.size(), 0.);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const auto side = [&](const SMT::Texture_atlas& atlas) {
        const auto& w = atlas.mesh.wedges[t];
        return std::sqrt(
          CGAL::squared_distance(atlas.mesh.uv[w[c]], atlas.mesh.uv[w[(c + 1) % 3]]));
      };
      const double ratio = side(filled.atlas) / side(whole.atlas);
      double& of_chart = scale[filled.atlas.charts.chart[t]];
      of_chart = of_chart == 0. ? ratio : of_chart;
      EXPECT_GT(ratio, 1.) << t << seed_text;
      EXPECT_NEAR(ratio, of_chart, 1e-9 * of_chart) << t << seed_text;
    }
}

// A small part of a rectangle, laid along the rest, makes a square of both.
TEST(Page_filling, rectangles_become_squares)
{
  for(const std::size_t length : {56u, 64u, 72u}) {
    const Indexed_triangle_mesh mesh = with_noise(grid(length, 40), 0.02, seed);
    const auto whole = SMT::build_texture_atlas(mesh, with_price(infinity));
    const auto filled = SMT::build_texture_atlas(mesh, with_price(0.02));
    ASSERT_EQ(whole.error + filled.error, "") << length << seed_text;
    EXPECT_EQ(error_in_atlas(mesh, filled.atlas), "") << length << seed_text;
    EXPECT_EQ(whole.report.charts.size(), 1u) << length << seed_text;
    EXPECT_LE(filled.report.page_cuts, 3u) << length << seed_text;
    EXPECT_GT(filled.report.utilisation, whole.report.utilisation + 0.1) << length << seed_text;
  }
}

// Beyond the work that is allowed no more cuts are looked for, which only the one that is found by then may
// follow.
TEST(Page_filling, work_for_cuts_is_bounded)
{
  namespace internal = SMT::internal;
  const Indexed_triangle_mesh strip = grid(160, 8);
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(strip.triangles);
  const std::vector<std::uint32_t> one_chart(strip.triangles.size(), 0);
  const auto number_of_cuts = [&](double work) {
    std::vector<internal::Mapped_chart> charts(1);
    charts[0].chart = SMT::chart_meshes(strip, SMT::charts_of_labels(adjacency, one_chart))[0];
    for(const Point_3& p : charts[0].chart.mesh.points)
      charts[0].uv.emplace_back(p.x(), p.y());
    charts[0].report.distortion = SMT::measure_chart_distortion(charts[0].chart.mesh, charts[0].uv);
    const internal::Chart_mapping mapping = {};
    internal::Page_filler filler(charts, with_price(0.).packing, mapping);
    const std::size_t cuts = filler.run({0.005, 0.005, 1., 16, 0, work});
    EXPECT_EQ(charts.size(), cuts + 1);
    return cuts;
  };
  EXPECT_EQ(number_of_cuts(0.), 0u);
  EXPECT_LE(number_of_cuts(1.), 1u);
  EXPECT_GT(number_of_cuts(infinity), 1u);
}

TEST(Page_filling, cheaper_seams_give_no_fewer_cuts_and_a_limit_of_charts_holds)
{
  for(const Named_mesh& shape : bad_shapes()) {
    const auto dear = SMT::build_texture_atlas(shape.mesh, with_price(0.5));
    const auto cheap = SMT::build_texture_atlas(shape.mesh, with_price(0.));
    EXPECT_LE(dear.report.page_cuts, cheap.report.page_cuts) << shape.name << seed_text;
    const auto whole = SMT::build_texture_atlas(shape.mesh, with_price(infinity));
    SMT::Texture_atlas_options limited = with_price(0.);
    limited.max_charts = whole.report.charts.size() + 1;
    const auto few = SMT::build_texture_atlas(shape.mesh, limited);
    EXPECT_LE(few.report.charts.size(), limited.max_charts) << shape.name << seed_text;
  }
}

TEST(Page_filling, pages_have_the_shape_of_which_most_is_used)
{
  const Indexed_triangle_mesh strip = with_noise(grid(160, 20), 0.1, seed), square = grid(40, 40);
  SMT::Texture_atlas_options options = with_price(infinity);
  options.largest_aspect = 16.;
  const auto wide = SMT::build_texture_atlas(strip, options);
  ASSERT_EQ(wide.error, "") << seed_text;
  EXPECT_EQ(error_in_atlas(strip, wide.atlas), "") << seed_text;
  EXPECT_EQ(wide.report.charts.size(), 1u);
  EXPECT_EQ(wide.atlas.width, 256u);
  EXPECT_EQ(wide.atlas.height, 32u); // as 8 to 1, the strip
  EXPECT_GT(wide.report.utilisation, 0.8) << seed_text;
  EXPECT_EQ(SMT::build_texture_atlas(square, options).atlas.height, 256u);
  options.largest_aspect = 4.;
  EXPECT_EQ(SMT::build_texture_atlas(strip, options).atlas.height, 64u) << seed_text;
  for(const double bad : {0.5, std::nan("")}) {
    options.largest_aspect = bad;
    EXPECT_NE(SMT::build_texture_atlas(square, options).error.find("aspect"), std::string::npos);
  }
}

TEST(Page_filling, charts_of_the_user_are_not_cut)
{
  const Indexed_triangle_mesh mesh = grid(160, 8);
  const auto result = SMT::build_texture_atlas(
    mesh, with_price(0.),
    SMT::Given_charts_segmenter(
      SMT::charts_of_labels(mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0))));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.report.charts.size(), 1u);
  EXPECT_EQ(result.report.page_cuts, 0u);
}

// The diagonals of quads stay within charts.
TEST(Page_filling, no_cut_runs_along_edges_that_shall_not_be_seams)
{
  const Indexed_triangle_mesh mesh = grid(160, 8);
  SMT::Texture_atlas_options options = with_price(0.02);
  options.no_seams.assign(mesh.triangles.size(), 0);
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const auto &p = mesh.points[mesh.triangles[t][c]], &q = mesh.points[mesh.triangles[t][(c + 1) % 3]];
      if(p.x() != q.x() && p.y() != q.y())
        options.no_seams[t] |= std::uint8_t(1 << c);
    }
  const auto result = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  EXPECT_GT(result.report.page_cuts, 0u);
  EXPECT_EQ(result.report.unwanted_seams, 0u);
}

TEST(Page_filling, as_much_is_used_as_is_asked_for_or_less_for_want_of_cuts)
{
  const Indexed_triangle_mesh mesh = with_noise(grid(160, 8), 0.1, seed);
  const double used = SMT::build_texture_atlas(mesh, with_price(0.5)).report.utilisation;
  for(const double wanted : {0.5 * used, used + 0.05, 0.99}) {
    SMT::Texture_atlas_options options = with_price(0.5);
    options.min_used = wanted;
    const auto result = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << wanted << seed_text;
    EXPECT_GE(result.report.utilisation, used - 1e-9) << wanted << seed_text;
    if(wanted < 0.9) {
      EXPECT_GE(result.report.utilisation, wanted) << seed_text;
    }
    EXPECT_EQ(result.report.why_not_used.empty(), result.report.utilisation >= wanted) << seed_text;
  }
}

TEST(Page_filling, says_why_no_more_is_used)
{
  const Indexed_triangle_mesh mesh = grid(80, 4);
  SMT::Texture_atlas_options options = with_price(std::numeric_limits<double>::infinity());
  options.min_used = 0.97;
  const auto reason = [&] { return SMT::build_texture_atlas(mesh, options).report.why_not_used; };
  EXPECT_EQ(reason(), "no further cut of a chart that is tried lets them be packed more densely");
  EXPECT_EQ(SMT::build_texture_atlas(mesh, options, SMT::Component_segmenter()).report.why_not_used,
            "charts that are given are not cut");
  options.max_charts = 1;
  EXPECT_EQ(reason(), "there are as many charts as there may be");
  options.max_charts = 0;
  options.is_enough = [] { return true; };
  EXPECT_EQ(reason(), "the time was up");
  options.is_enough = nullptr;
  options.packing.texels_per_unit = 1.;
  options.packing.max_pages = 0;
  EXPECT_EQ(reason(), "the density of texels is given");
}

// Also where the charts stay as they were without that, since the cuts turned out to be no good.
TEST(Page_filling, is_valid_and_used_no_less_if_more_is_asked_for)
{
  for(const Named_mesh& shape : bad_shapes()) {
    if(shape.name != "strip" && shape.name != "star")
      continue; // that takes seconds
    SMT::Texture_atlas_options options = with_price(0.02);
    const auto usual = SMT::build_texture_atlas(shape.mesh, options);
    options.min_used = 0.85;
    const auto more = SMT::build_texture_atlas(shape.mesh, options);
    ASSERT_EQ(more.error, "") << shape.name << seed_text;
    EXPECT_EQ(error_in_atlas(shape.mesh, more.atlas), "") << shape.name << seed_text;
    EXPECT_GE(more.report.utilisation, usual.report.utilisation - 1e-9) << shape.name << seed_text;
    EXPECT_GE(more.report.page_cuts, usual.report.page_cuts) << shape.name << seed_text;
  }
}

TEST(Page_filling, does_not_depend_on_threads_nor_on_the_unit_of_length)
{
  for(const Named_mesh& shape : bad_shapes()) {
    const auto one = SMT::build_texture_atlas(shape.mesh, with_price(0.02));
    for(const unsigned int threads : {2u, 5u}) {
      const CGAL::Blocked_execution::Thread_scope scope(threads);
      const auto other = SMT::build_texture_atlas(shape.mesh, with_price(0.02));
      EXPECT_TRUE(are_equal(one.atlas, other.atlas)) << shape.name << threads << seed_text;
    }
    const auto small
      = SMT::build_texture_atlas(scaled(shape.mesh, 0x1p-20), with_price(0.02));
    EXPECT_TRUE(are_equal(one.atlas, small.atlas)) << shape.name << seed_text;
  }
}

TEST(Page_filling, tells_the_part_done_and_can_be_cancelled)
{
  for(const Named_mesh& shape : bad_shapes()) {
    SMT::Texture_atlas_options options = with_price(0.02);
    options.min_used = shape.name == "star" ? 0.8 : 0.;
    std::vector<double> told;
    options.progress = [&told](double part) {
      told.push_back(part);
      return true;
    };
    ASSERT_EQ(SMT::build_texture_atlas(shape.mesh, options).error, "") << shape.name << seed_text;
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end())) << shape.name << seed_text;
    EXPECT_EQ(told.back(), 1.) << shape.name << seed_text;
    options.progress = [](double part) { return part < 0.85; };
    EXPECT_EQ(SMT::build_texture_atlas(shape.mesh, options).error, "cancelled") << shape.name;
  }
}

TEST(Page_filling, says_what_is_wrong_with_options)
{
  const Indexed_triangle_mesh mesh = grid(4, 4);
  for(const double price : {-1., std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(SMT::build_texture_atlas(mesh, with_price(price)).error,
              "the price of seams is not a number from 0 on");
  for(const double used : {-0.1, 1., std::numeric_limits<double>::quiet_NaN()}) {
    SMT::Texture_atlas_options options;
    options.min_used = used;
    EXPECT_EQ(SMT::build_texture_atlas(mesh, options).error,
              "the part of the pages to use is not in [0, 1)");
  }
}

TEST(Page_filling, is_valid_on_bad_surfaces)
{
  for(const Named_mesh& surface : bad_surfaces(200, seed)) {
    SMT::Texture_atlas_options options = with_price(0.);
    options.min_used = 0.9;
    const auto result = SMT::build_texture_atlas(surface.mesh, options);
    if(result.is_ok()) {
      EXPECT_EQ(error_in_atlas(surface.mesh, result.atlas), "") << surface.name << seed_text;
    } else {
      EXPECT_NE(result.error, "");
    }
  }
}

// --- Measures

// The surface of a cube, n x n quads a side, each side a chart.
TEST(Atlas_measures, seams_of_the_sides_of_a_cube)
{
  const Indexed_triangle_mesh flat = grid(8, 8);
  const double side = flat.points.back().x();
  // A roof: half of the grid is turned up by 90 degrees
  for(const double sign : {1., -1.}) {
    const Indexed_triangle_mesh roof = moved(flat, [&](const Point_3& p) {
      return p.x() <= 0.5 * side ? p
                                 : Point_3(0.5 * side, p.y(), sign * (p.x() - 0.5 * side));
    });
    std::vector<std::uint32_t> label;
    for(const auto& t : flat.triangles) {
      double x = 0.;
      for(const Vertex_index v : t)
        x += flat.points[v].x() / 3.;
      label.push_back(x > 0.5 * side ? 1 : 0);
    }
    const CGAL::Indexed_mesh::Triangle_adjacency adjacency(roof.triangles);
    const auto charts = SMT::charts_of_labels(adjacency, label);
    const SMT::Seam_measures seams = SMT::measure_seams(roof, adjacency, charts);
    EXPECT_NEAR(seams.relative_length, 1., 1e-12); // a side of the square
    EXPECT_NEAR(seams.on_creases, 1., 1e-12);
    EXPECT_NEAR(seams.in_concavities, sign > 0. ? 1. : 0., 1e-12);
    EXPECT_NEAR(seams.jaggedness, 1., 1e-12); // straight
  }
}

// Each second quad along the seam belongs to the other side: the seam goes along x and y in turn.
TEST(Atlas_measures, jagged_seams)
{
  const Indexed_triangle_mesh mesh = grid(20, 20);
  std::vector<std::uint32_t> label;
  for(const auto& t : mesh.triangles) {
    double x = 0., y = 0.;
    for(const Vertex_index v : t) {
      x += mesh.points[v].x() / 3.;
      y += mesh.points[v].y() / 3.;
    }
    label.push_back(std::floor(y) > std::floor(x) ? 1 : 0); // stairs
  }
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  const auto seams
    = SMT::measure_seams(mesh, adjacency, SMT::charts_of_labels(adjacency, label));
  EXPECT_NEAR(seams.jaggedness, std::sqrt(2.), 1e-9);
  EXPECT_EQ(seams.on_creases, 0.);
}

TEST(Atlas_measures, texels_of_a_map_that_is_known)
{
  const Indexed_triangle_mesh mesh = grid(10, 10);
  const double side = mesh.points.back().x();
  SMT::Textured_triangle_mesh textured;
  textured.points = mesh.points;
  textured.triangles = mesh.triangles;
  textured.wedges = mesh.triangles;
  for(const Point_3& p : mesh.points)
    textured.uv.emplace_back(p.x() / side, 0.5 * p.y() / side);
  const auto charts
    = SMT::charts_of_labels(mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0));
  // Twice as wide as high: on a page of 100 x 200 texels an isometry
  const SMT::Texel_measures even = SMT::measure_texels(textured, charts, 100, 200);
  const SMT::Texel_measures stretched = SMT::measure_texels(textured, charts, 100, 100);
  for(std::size_t i = 0; i < even.parts.size(); ++i) {
    EXPECT_NEAR(even.quasi_conformal[i], 1., 1e-3); // the root of a rounding error
    EXPECT_NEAR(stretched.quasi_conformal[i], 2., 1e-5);
    EXPECT_NEAR(even.area_scale[i], 1., 1e-5);
    EXPECT_NEAR(stretched.area_scale[i], 1., 1e-5);
  }
  EXPECT_NEAR(even.compactness, CGAL_PI / 4., 1e-9);           // a square
  EXPECT_NEAR(stretched.compactness, CGAL_PI * 2. / 9., 1e-9); // 2 : 1
  EXPECT_NEAR(even.density_range, 1., 1e-9);
}

TEST(Atlas_measures, density_of_two_charts)
{
  Indexed_triangle_mesh mesh = grid(4, 4);
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size();
  append(mesh, grid(4, 4));
  SMT::Textured_triangle_mesh textured;
  textured.points = mesh.points;
  textured.triangles = mesh.triangles;
  textured.wedges = mesh.triangles;
  std::vector<std::uint32_t> label(mesh.triangles.size(), 0);
  std::fill(label.begin() + triangles, label.end(), 1);
  for(std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double scale = v < points ? 0.01 : 0.03;
    textured.uv.emplace_back(scale * mesh.points[v].x(), scale * mesh.points[v].y());
  }
  const auto texels
    = SMT::measure_texels(textured, SMT::charts_of_labels(mesh.triangles, label), 64, 64);
  EXPECT_NEAR(texels.density_range, 3., 1e-9);
  EXPECT_NEAR(texels.area_scale[0], 1. / 5., 1e-6); // 1 and 9, mean 5
  EXPECT_NEAR(texels.area_scale[3], 9. / 5., 1e-6);
}

} // namespace page_filling_test
