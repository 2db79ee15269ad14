// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all packers promise: the padding, pages, errors, and the same result whatever the unit.

#include <support/chart_shapes.h>
#include <support/packed_charts.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace packing_test {

using namespace test_support;
using namespace CGAL::Surface_mesh_texturing;
using namespace packed_charts;

// --- Definitions

// The least distance between segments of different charts on a page.
double least_distance(const Charts& charts, const Packing_result& result)
{
  typedef CGAL::Simple_cartesian<double>::Segment_2 Segment_2;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::pair<std::size_t, Segment_2>> segments;
  for(std::size_t c = 0; c < charts.size(); ++c)
    for(const Triangle& t : placed_triangles(charts[c], result.placements[c]))
      for(int k = 0; k < 3; ++k)
        segments.push_back({c, Segment_2(t[k], t[(k + 1) % 3])});
  for(const auto& a : segments)
    for(const auto& b : segments)
      if(a.first < b.first && result.placements[a.first].page == result.placements[b.first].page)
        least = (std::min)(least, CGAL::squared_distance(a.second, b.second));
  return std::sqrt(least);
}

bool are_equal(const Packing_result& a, const Packing_result& b)
{
  if(a.placements.size() != b.placements.size() || a.pages != b.pages
     || a.texels_per_unit != b.texels_per_unit)
    return false;
  for(std::size_t c = 0; c < a.placements.size(); ++c) {
    const Chart_placement &p = a.placements[c], &q = b.placements[c];
    if(p.page != q.page || p.angle != q.angle || p.scale != q.scale || p.offset != q.offset)
      return false;
  }
  return true;
}

// --- The packers

template <class Packer>
class Packer_test : public ::testing::Test
{
};

typedef ::testing::Types<Raster_packer, Horizon_packer> Packers;
TYPED_TEST_SUITE(Packer_test, Packers);

TYPED_TEST(Packer_test, keeps_the_padding)
{
  for(const std::size_t padding : {0, 2, 5}) {
    Packing_options options = small_page();
    options.padding = padding;
    const Charts charts = mixed_charts();
    const Packing_result result = pack_charts<TypeParam>(charts, options);
    EXPECT_EQ(packing_error(charts, options, result), "") << "padding " << padding;
    EXPECT_GE(least_distance(charts, result), double(padding)) << "padding " << padding;
    EXPECT_GT(result.utilisation, 0.15);
  }
}

TYPED_TEST(Packer_test, keeps_the_padding_on_mip_levels)
{
  for(const unsigned int level : {1u, 3u})
    for(const std::size_t side : {96, 99}) { // not a multiple of the block, either
      Packing_options options = small_page(side, side);
      options.mip_levels = level;
      options.padding = 1;
      const Charts charts = mixed_charts();
      const Packing_result result = pack_charts<TypeParam>(charts, options);
      EXPECT_EQ(packing_error(charts, options, result), "") << "level " << level;
      EXPECT_GE(least_distance(charts, result), double(1u << level));
    }
}

TYPED_TEST(Packer_test, packs_pages_of_any_aspect)
{
  const Charts charts = mixed_charts();
  for(const auto& size : {std::make_pair(300, 70), std::make_pair(64, 200)}) {
    const Packing_options options = small_page(std::size_t(size.first), std::size_t(size.second));
    const Packing_result result = pack_charts<TypeParam>(charts, options);
    EXPECT_EQ(packing_error(charts, options, result), "") << size.first;
  }
}

TYPED_TEST(Packer_test, packs_several_pages)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page(64, 64);
  const double one_page = pack_charts<TypeParam>(charts, options).texels_per_unit;
  options.max_pages = 3;
  const Packing_result result = pack_charts<TypeParam>(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_EQ(result.pages, 3u);
  EXPECT_GT(result.texels_per_unit, 1.2 * one_page);
}

TYPED_TEST(Packer_test, keeps_a_given_density)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page(96, 96);
  options.texels_per_unit = 30.;
  options.max_pages = 0;
  const Packing_result result = pack_charts<TypeParam>(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_EQ(result.texels_per_unit, 30.);
  EXPECT_GT(result.pages, 1u);
  options.max_pages = result.pages - 1;
  EXPECT_EQ(pack_charts<TypeParam>(charts, options).error,
            "the charts do not fit on " + std::to_string(options.max_pages) + " page"
              + (options.max_pages == 1 ? "" : "s") + " with this density");
}

TYPED_TEST(Packer_test, names_the_chart_that_is_larger_than_a_page)
{
  Charts charts = mixed_charts();
  charts.insert(charts.begin() + 4, rectangle_chart(10., 10.));
  Packing_options options = small_page(96, 96);
  options.texels_per_unit = 10.;
  options.max_pages = 0;
  const Packing_result result = pack_charts<TypeParam>(charts, options);
  EXPECT_EQ(result.error, "chart 4 is larger than a page");
  EXPECT_TRUE(result.placements.empty());
}

TYPED_TEST(Packer_test, does_not_depend_on_the_unit_or_the_position)
{
  const Charts charts = mixed_charts();
  const Packing_options options = small_page();
  const Packing_result result = pack_charts<TypeParam>(charts, options);
  for(const double unit : {1e-6, 1e6, 1e150}) {
    Charts others = charts;
    for(Chart_shape& chart : others)
      for(Point_2& p : chart.uv)
        p = Point_2(unit * (p.x() - 7.), unit * (p.y() + 3.));
    const Packing_result other = pack_charts<TypeParam>(others, options);
    ASSERT_EQ(other.error, "");
    EXPECT_NEAR(other.texels_per_unit * unit / result.texels_per_unit, 1., 1e-9);
    EXPECT_NEAR(other.utilisation, result.utilisation, 1e-9);
    for(std::size_t c = 0; c < charts.size(); ++c)
      for(std::size_t v = 0; v < charts[c].uv.size(); ++v) {
        const Point_2 p = result.placements[c](charts[c].uv[v]);
        const Point_2 q = other.placements[c](others[c].uv[v]);
        ASSERT_LT(std::sqrt(CGAL::squared_distance(p, q)), 1e-6) << "unit " << unit;
      }
  }
}

TYPED_TEST(Packer_test, is_the_same_for_any_number_of_threads)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page();
  options.time_budget = 0.02;
  const Packing_result one = pack_charts<TypeParam>(charts, options);
  const CGAL::Blocked_execution::Thread_scope threads(3);
  EXPECT_TRUE(are_equal(one, pack_charts<TypeParam>(charts, options)));
}

TYPED_TEST(Packer_test, places_degenerate_charts)
{
  Charts charts = blob_charts(3, 0.3, seed);
  charts.push_back({{{0., 0.}, {1., 0.}, {2., 0.}}, {{0, 1, 2}}});            // no area
  charts.push_back({{{3., 3.}, {3., 3.}, {3., 3.}}, {{0, 1, 2}}});            // a point
  charts.push_back({{{0., 0.}, {1., 1.}, {0., 0.}}, {{0, 1, 1}, {0, 2, 2}}}); // not triangles
  charts.push_back({{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 1, 2}}});            // one triangle
  charts.push_back({{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 2, 1}}});            // mirrored
  charts.push_back(rectangle_chart(3., 1e-7));
  charts.push_back({{{5., 5.}}, {}}); // no triangle
  charts.push_back({});               // nothing
  const Packing_options options = small_page(64, 64);
  const Packing_result result = pack_charts<TypeParam>(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
}

TYPED_TEST(Packer_test, places_nothing_but_degenerate_charts)
{
  const Packing_options options = small_page(64, 64);
  const Chart_shape point = {{{3., 3.}, {3., 3.}, {3., 3.}}, {{0, 1, 2}}};
  const Chart_shape line = {{{0., 0.}, {1., 2.}, {2., 4.}}, {{0, 1, 2}}};
  for(const Charts& charts : {Charts{point}, Charts(20, point), Charts{line}, Charts(7, line)})
    EXPECT_EQ(packing_error(charts, options, pack_charts<TypeParam>(charts, options)), "");
}

TYPED_TEST(Packer_test, places_charts_with_flipped_triangles)
{
  Charts charts = mixed_charts();
  for(std::size_t c = 0; c < 8; ++c) {
    charts[c].uv[10 + c] = Point_2(99., -0.4); // far over on the other side of the fan
    std::swap(charts[c].triangles[30][0], charts[c].triangles[30][1]);
  }
  charts.push_back({{{0., 0.}, {1., 0.}, {1., 1.}, {1., -1.}}, // folded over
                    {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}}});
  const Packing_options options = small_page();
  EXPECT_EQ(packing_error(charts, options, pack_charts<TypeParam>(charts, options)), "");
}

TYPED_TEST(Packer_test, reports_bad_input)
{
  Charts charts = mixed_charts();
  charts[2].uv[5] = Point_2(0., std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(pack_charts<TypeParam>(charts, small_page()).error,
            "chart 2 has a coordinate that is not finite");
  charts = mixed_charts();
  charts[3].triangles[0][1] = 1000;
  EXPECT_EQ(pack_charts<TypeParam>(charts, small_page()).error,
            "chart 3 has a triangle with a vertex that does not exist");
  charts = mixed_charts();
  charts[1].uv[0] = Point_2(1.7e308, 0.);
  charts[1].uv[1] = Point_2(-1.7e308, 0.);
  EXPECT_EQ(pack_charts<TypeParam>(charts, small_page()).error,
            "chart 1 has a size that is not finite");
  EXPECT_EQ(pack_charts<TypeParam>(Charts(100, charts[0]), small_page(16, 16)).error,
            "the charts do not fit on 1 page, however small they are");
  Packing_options options = small_page(4, 4);
  options.padding = 4;
  EXPECT_NE(pack_charts<TypeParam>(charts, options).error, "");
  options = small_page();
  options.max_pages = 0;
  EXPECT_NE(pack_charts<TypeParam>(charts, options).error, "");
}

TYPED_TEST(Packer_test, packs_no_charts)
{
  const Packing_result result = pack_charts<TypeParam>(Charts());
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.pages, 0u);
  EXPECT_TRUE(result.placements.empty());
}

TYPED_TEST(Packer_test, stops_when_asked_to)
{
  for(const int calls : {1, 2, 5}) {
    Packing_options options = small_page();
    double last = 0.;
    int n = 0;
    options.progress = [&](double part) {
      EXPECT_GE(part, last);
      EXPECT_LE(part, 1.);
      last = part;
      return ++n < calls;
    };
    const Packing_result result = pack_charts<TypeParam>(mixed_charts(), options);
    EXPECT_EQ(result.error, "cancelled");
    EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::CANCELLED);
    EXPECT_TRUE(result.placements.empty());
    EXPECT_EQ(n, calls);
  }
}

} // namespace packing_test
