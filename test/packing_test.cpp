// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packings of charts, against the definition of the padding: the texels that triangles touch, found
// by comparing each triangle with each texel, and distances between segments.

#include <support/chart_shapes.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace packing_test {

using namespace test_support;
using namespace CGAL::Surface_mesh_texturing;
typedef Chart_shape::Point_2 Point_2;
typedef std::vector<Chart_shape> Charts;
typedef std::array<Point_2, 3> Triangle;
typedef std::pair<int, int> Texel;

constexpr std::uint64_t seed = 4711;
const std::string seed_text = "seed " + std::to_string(seed);

Packing_options small_page(std::size_t width = 80, std::size_t height = 80)
{
  Packing_options options;
  options.width = width;
  options.height = height;
  return options;
}

// --- Definitions

std::vector<Triangle> placed_triangles(const Chart_shape& chart, const Chart_placement& placement)
{
  std::vector<Triangle> result;
  for(const auto& t : chart.triangles)
    result.push_back({placement(chart.uv[t[0]]), placement(chart.uv[t[1]]),
                      placement(chart.uv[t[2]])});
  return result;
}

// Whether a line with the given normal separates the triangle from the texel
// [x, x + 1] x [y, y + 1].
bool separates(double nx, double ny, const Triangle& t, int x, int y)
{
  double lo = std::numeric_limits<double>::infinity(), hi = -lo, low = lo, high = hi;
  for(const Point_2& p : t) {
    lo = (std::min)(lo, nx * p.x() + ny * p.y());
    hi = (std::max)(hi, nx * p.x() + ny * p.y());
  }
  for(int i = 0; i < 4; ++i) {
    const double d = nx * (x + i % 2) + ny * (y + i / 2);
    low = (std::min)(low, d);
    high = (std::max)(high, d);
  }
  return hi < low || high < lo;
}

std::set<Texel> touched_texels(const std::vector<Triangle>& triangles)
{
  std::set<Texel> result;
  for(const Triangle& t : triangles) {
    const auto x = std::minmax({t[0].x(), t[1].x(), t[2].x()});
    const auto y = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    for(int i = int(std::floor(x.first)); i <= x.second; ++i)
      for(int j = int(std::floor(y.first)); j <= y.second; ++j) {
        bool is_touched = true;
        for(int k = 0; k < 3; ++k) {
          const auto edge = t[(k + 1) % 3] - t[k];
          is_touched = is_touched && !separates(edge.y(), -edge.x(), t, i, j);
        }
        if(is_touched)
          result.insert({i, j});
      }
  }
  return result;
}

// The texels of the coarsest mip level, counted from the upper left corner.
std::set<Texel> touched_blocks(const std::set<Texel>& texels, const Packing_options& options)
{
  const int size = 1 << options.mip_levels;
  const auto divided = [size](int x) { return x >= 0 ? x / size : -1; };
  std::set<Texel> result;
  for(const Texel& t : texels)
    result.insert({divided(t.first), divided(int(options.height) - 1 - t.second)});
  return result;
}

std::string at(std::size_t chart, const Texel& t)
{
  return "chart " + std::to_string(chart) + " at " + std::to_string(t.first) + ", "
         + std::to_string(t.second);
}

// The padding between charts and at the border, by definition.
std::string padding_error(const Charts& charts, const Packing_options& options,
                          const Packing_result& result)
{
  const int p = int(options.padding), border = (p + 1) / 2;
  const int w = int(options.width >> options.mip_levels);
  const int h = int(options.height >> options.mip_levels);
  for(std::size_t page = 0; page < result.pages; ++page) {
    std::vector<int> owner(std::size_t(w * h), -1);
    std::vector<std::set<Texel>> blocks(charts.size());
    for(std::size_t c = 0; c < charts.size(); ++c) {
      if(result.placements[c].page != page)
        continue;
      blocks[c] = touched_blocks(
        touched_texels(placed_triangles(charts[c], result.placements[c])), options);
      for(const Texel& t : blocks[c]) {
        if(t.first < border || t.second < border || t.first >= w - border
           || t.second >= h - border)
          return at(c, t) + " touches the border";
        owner[std::size_t(t.second * w + t.first)] = int(c);
      }
    }
    for(std::size_t c = 0; c < charts.size(); ++c)
      for(const Texel& t : blocks[c])
        for(int x = (std::max)(0, t.first - p); x <= (std::min)(w - 1, t.first + p); ++x)
          for(int y = (std::max)(0, t.second - p); y <= (std::min)(h - 1, t.second + p); ++y) {
            const int other = owner[std::size_t(y * w + x)];
            if(other != -1 && other != int(c))
              return at(c, t) + " is too near to chart " + std::to_string(other);
          }
  }
  return {};
}

// All lengths are multiplied by the same factor, and nothing is mirrored.
std::string similarity_error(const Charts& charts, const Packing_result& result)
{
  for(std::size_t c = 0; c < charts.size(); ++c) {
    const Chart_shape& chart = charts[c];
    double size = 0.;
    for(const Point_2& p : chart.uv)
      size = (std::max)(size, std::sqrt(CGAL::squared_distance(p, chart.uv[0])));
    const double tolerance = 1e-9 * size * result.texels_per_unit;
    for(const auto& t : chart.triangles)
      for(int k = 0; k < 3; ++k) {
        const auto e = chart.uv[t[(k + 1) % 3]] - chart.uv[t[k]];
        const auto f = result.placements[c](chart.uv[t[(k + 1) % 3]])
                       - result.placements[c](chart.uv[t[k]]);
        const double a = result.placements[c].angle, s = result.texels_per_unit;
        if(std::abs(s * (std::cos(a) * e.x() - std::sin(a) * e.y()) - f.x()) > tolerance
           || std::abs(s * (std::sin(a) * e.x() + std::cos(a) * e.y()) - f.y()) > tolerance)
          return "chart " + std::to_string(c) + " is not similar to what it was";
      }
  }
  return {};
}

std::string utilisation_error(const Charts& charts, const Packing_options& options,
                              const Packing_result& result)
{
  double area = 0.;
  std::size_t texels = 0;
  for(std::size_t c = 0; c < charts.size(); ++c) {
    const auto triangles = placed_triangles(charts[c], result.placements[c]);
    for(const Triangle& t : triangles)
      area += std::abs(CGAL::area(t[0], t[1], t[2]));
    texels += touched_texels(triangles).size();
  }
  const double all = double(options.width * options.height * result.pages);
  if(std::abs(area / all - result.utilisation) > 1e-9)
    return "the utilisation is " + std::to_string(area / all);
  // Triangles that come within a thousandth of a texel may count as touching it: on a small page a
  // diagonal through the corners of texels makes almost one percent
  if(std::abs(double(texels) / all - result.texel_utilisation) > 0.01)
    return "the utilisation of texels is " + std::to_string(double(texels) / all) + ", not "
           + std::to_string(result.texel_utilisation);
  return {};
}

// What is wrong with a packing, or nothing.
std::string packing_error(const Charts& charts, const Packing_options& options,
                          const Packing_result& result)
{
  if(!result.error.empty())
    return result.error;
  if(result.placements.size() != charts.size())
    return "not each chart has one place";
  std::vector<bool> is_used(result.pages, false);
  for(const Chart_placement& placement : result.placements) {
    if(placement.page >= result.pages)
      return "a page that is not there";
    is_used[placement.page] = true;
    if(placement.scale != result.texels_per_unit)
      return "a chart of another scale";
  }
  if(std::find(is_used.begin(), is_used.end(), false) != is_used.end())
    return "an empty page";
  if(options.max_pages != 0 && result.pages > options.max_pages)
    return "too many pages";
  for(const std::string& error :
      {similarity_error(charts, result), padding_error(charts, options, result),
       utilisation_error(charts, options, result)})
    if(!error.empty())
      return error;
  return {};
}

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

Charts mixed_charts()
{
  Charts charts = blob_charts(8, 0.1, seed);
  charts.push_back(l_chart(0.2));
  charts.push_back(l_chart(0.3));
  charts.push_back(ring_chart(0.7, 1.));
  charts.push_back(star_chart(5, 0.3, 0.9));
  charts.push_back(star_chart(7, 0.1, 0.5));
  charts.push_back(rectangle_chart(2.5, 0.02));
  charts.push_back(rectangle_chart(0.05, 1.2));
  return charts;
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

// --- What true shapes are good for

TEST(Raster_packer_test, fills_a_page_with_squares)
{
  const Packing_options options = small_page(256, 256);
  const Charts charts(4, rectangle_chart(1., 1.));
  const Packing_result result = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_GT(result.utilisation, 0.9);
}

TEST(Raster_packer_test, puts_a_chart_into_the_hole_of_another)
{
  const Charts charts = {ring_chart(0.8, 1.), fan_chart(40, [](double) { return 0.7; })};
  const Packing_options options = small_page(256, 256);
  const Packing_result result = pack_charts(charts, options);
  ASSERT_EQ(packing_error(charts, options, result), "");
  const Point_2 p = result.placements[0](Point_2(0., 0.));
  const Point_2 q = result.placements[1](Point_2(0., 0.));
  EXPECT_LT(std::sqrt(CGAL::squared_distance(p, q)), 0.1 * result.texels_per_unit);
}

TEST(Raster_packer_test, interlocks_notches)
{
  // Side by side they fill 0.36 of a page, one in the other up to 1.44 / 1.6^2
  const Charts charts = {l_chart(0.2), l_chart(0.2), l_chart(0.2), l_chart(0.2)};
  const Packing_options options = small_page(256, 256);
  const Packing_result result = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_GT(result.utilisation, 0.45);
}

TEST(Raster_packer_test, fills_most_of_a_page_with_blobs)
{
  for(const std::size_t number : {14, 40}) {
    Packing_options options = small_page(256, 256);
    options.padding = 1;
    const Charts charts = blob_charts(number, 0.1, seed + number);
    const Packing_result result = pack_charts(charts, options);
    EXPECT_EQ(packing_error(charts, options, result), "") << seed_text;
    EXPECT_GT(result.utilisation, 0.7) << number << " blobs, " << seed_text;
    EXPECT_GT(result.utilisation, pack_charts<Horizon_packer>(charts, options).utilisation);
  }
}

TEST(Raster_packer_test, is_not_worse_with_more_time)
{
  const Charts charts = blob_charts(12, 0.1, seed);
  Packing_options options = small_page();
  double last = 0.;
  for(const double budget : {0., 0.02, 0.1}) {
    options.time_budget = budget;
    const Packing_result result = pack_charts(charts, options);
    EXPECT_EQ(packing_error(charts, options, result), "");
    EXPECT_GE(result.utilisation, last) << "budget " << budget;
    last = result.utilisation;
  }
}

TEST(Raster_packer_test, uses_the_time_it_is_given)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page(128, 128);
  const Packing_result fast = pack_charts(charts, options);
  options.time_budget = 0.3;
  const Packing_result slow = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, slow), "");
  EXPECT_GT(slow.texels_per_unit, fast.texels_per_unit);
}

TEST(Raster_packer_test, stops_while_it_raises_the_density)
{
  Packing_options options = small_page();
  options.time_budget = 100.;
  int n = 0;
  options.progress = [&](double) { return ++n < 200; };
  EXPECT_EQ(pack_charts(mixed_charts(), options).error, "cancelled");
  EXPECT_EQ(n, 200);
}

// The definition of the overlap of charts with their padding, cell by cell.
TEST(Silhouette_test, overlaps_where_charts_are_too_near)
{
  using namespace CGAL::Surface_mesh_texturing::internal;
  double unit = 1.;
  const std::vector<Chart_outline> outlines = chart_outlines(mixed_charts(), unit);
  for(const std::size_t padding : {0, 1, 2, 3}) {
    Packing_options options = small_page();
    options.padding = padding;
    const Packing_raster exact = exact_raster(options);
    const Silhouette_raster raster(exact, 1);
    for(std::size_t i = 0; i + 1 < outlines.size(); i += 2) {
      const Texel_mask a = rasterize(outlines[i], 0.3, 20., 80, 80).mask;
      const Texel_mask b = rasterize(outlines[i + 1], 1.1, 20., 80, 80).mask;
      const Silhouette s = silhouette(outlines[i], 0.3, 20., raster);
      const Silhouette t = silhouette(outlines[i + 1], 1.1, 20., raster);
      ASSERT_GT(s.width, 0);
      ASSERT_GT(t.width, 0);
      for(int k = 0; k < 100; ++k) {
        const int x = k % 10 * 6 - 30, y = k / 10 * 6 - 30;
        bool are_near = false;
        for(const Cell_run& r : a.runs())
          for(const Cell_run& q : b.runs())
            are_near = are_near || (std::abs(q.y + y - r.y) <= int(padding)
                                    && q.begin + x < r.end + int(padding)
                                    && r.begin < q.end + x + int(padding));
        ASSERT_EQ(overlap(s, t, x, y) > 0, are_near) << padding << ": " << x << ", " << y;
      }
    }
  }
}

// The overlaps of a field are sums of those of pairs.
TEST(Overlap_field_test, is_the_weighted_sum_of_overlaps)
{
  using namespace CGAL::Surface_mesh_texturing::internal;
  double unit = 1.;
  const std::vector<Chart_outline> outlines = chart_outlines(mixed_charts(), unit);
  const Silhouette_raster raster(exact_raster(small_page()), 1);
  const Silhouette s = silhouette(outlines[0], 0.3, 20., raster);
  const Silhouette t = silhouette(outlines[9], 0., 20., raster);
  const Silhouette u = silhouette(outlines[10], 1., 20., raster);
  Overlap_field field;
  field.reset(5, 6, 60, 50);
  field.add(t, 3, 20, 7);
  field.add(u, 30, 1, 11);
  field.integrate();
  const int n = 60 - s.width;
  std::vector<int> row(std::size_t(n), 0);
  for(int y = 6; y + s.height <= 56; ++y) {
    field.overlaps(s, 5, y, n, (std::numeric_limits<int>::max)(), row.data());
    for(int k = 0; k < n; ++k)
      ASSERT_EQ(row[std::size_t(k)],
                7 * overlap(s, t, 3 - 5 - k, 20 - y) + 11 * overlap(s, u, 30 - 5 - k, 1 - y));
  }
}

TEST(Raster_packer_test, packs_many_charts)
{
  const Charts charts = blob_charts(150, 0.2, seed);
  const Packing_options options = small_page(256, 256);
  const Packing_result result = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_GT(result.utilisation, 0.5);
}

TEST(Raster_packer_test, turns_charts_in_as_many_directions_as_asked)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page();
  for(const int rotations : {1, 3, 16}) {
    options.rotations = rotations;
    EXPECT_EQ(packing_error(charts, options, pack_charts(charts, options)), "") << rotations;
  }
}

} // namespace packing_test
