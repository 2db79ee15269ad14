// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What packing the true shapes of charts is good for, and the parts of it.

#include <support/chart_shapes.h>
#include <support/packed_charts.h>

#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Density_search.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace raster_packer_test {

using namespace test_support;
using namespace CGAL::Surface_mesh_texturing;
using namespace packed_charts;

const std::string seed_text = "seed " + std::to_string(seed);

// --- What true shapes are good for

TEST(Raster_packer_test, fills_a_page_with_squares)
{
  const Packing_options options = small_page(256, 256);
  const Charts charts(4, rectangle_chart(1., 1.));
  const Packing_result result = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, result), "");
  EXPECT_GT(result.utilisation, 0.9);
}

// The box around a square on a corner has the diagonal of a page long before the square does.
TEST(Raster_packer_test, fills_a_page_with_a_square_however_it_is_turned)
{
  const Packing_options options = small_page(256, 256);
  for(const double angle : {0., 0.3, 0.25 * CGAL_PI}) {
    Charts charts(1, rectangle_chart(1., 1.));
    for(Point_2& p : charts[0].uv)
      p = Point_2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                  std::sin(angle) * p.x() + std::cos(angle) * p.y());
    const Packing_result result = pack_charts(charts, options);
    EXPECT_EQ(packing_error(charts, options, result), "");
    EXPECT_GT(result.utilisation, 0.9) << angle;
  }
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

// A draft is a packing that is a little looser; it is searched for within the budget only.
TEST(Raster_packer_test, drafts_take_the_time_of_the_budget_only)
{
  const Charts charts = mixed_charts();
  Packing_options options = small_page(1024, 1024);
  const double usual = pack_charts(charts, options).utilisation;
  options.is_draft = true;
  const Packing_result draft = pack_charts(charts, options);
  EXPECT_EQ(packing_error(charts, options, draft), "");
  EXPECT_LT(draft.utilisation, usual);
  options.time_budget = 0.2;
  EXPECT_GE(pack_charts(charts, options).utilisation, usual);
}

// On a raster of several texels a cell gaps are no narrower than on that of the texels.
TEST(Raster_packer_test, drafts_are_packings)
{
  const Charts charts = blob_charts(3, 0.1, seed);
  for(const std::size_t padding : {1, 5}) {
    Packing_options options = small_page(1001 + 100 * padding, 800);
    options.padding = padding;
    options.is_draft = true;
    const Packing_result draft = pack_charts(charts, options);
    EXPECT_EQ(packing_error(charts, options, draft), "") << padding;
    EXPECT_GT(draft.utilisation, 0.4);
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

// --- What is done for many cells at a time, cell by cell

using namespace CGAL::Surface_mesh_texturing::internal;

Texel_mask random_mask(int width, int height, double part, std::mt19937& random)
{
  std::bernoulli_distribution is_in(part);
  Texel_mask result(width, height);
  for(int y = 0; y < height; ++y)
    for(int x = 0; x < width; ++x)
      if(is_in(random))
        result.add({y, x, x + 1});
  return result;
}

TEST(Texel_mask_test, sweeps_each_cell)
{
  std::mt19937 random(1);
  for(const int width : {1, 5, 63, 64, 65, 150})
    for(const int n : {0, 1, 2, 3, 6, 7, 70}) {
      const Texel_mask mask = random_mask(width, 9, 0.02, random), result = swept(mask, n);
      ASSERT_EQ(result.width(), width + n);
      ASSERT_EQ(result.height(), 9 + n);
      Texel_mask expected(width + n, 9 + n);
      for(const Cell_run& run : mask.runs())
        for(int y = run.y; y <= run.y + n; ++y)
          expected.add({y, run.begin, run.end + n});
      for(int y = 0; y < result.height(); ++y)
        ASSERT_TRUE(std::equal(result.row(y), result.row(y) + result.words(), expected.row(y)))
          << width << ", " << n << ", row " << y;
    }
}

TEST(Texel_mask_test, becomes_blocks_of_which_half_is_in_it)
{
  std::mt19937 random(2);
  for(const int width : {1, 4, 7, 62, 64, 66, 130})
    for(const double part : {0.02, 0.3, 0.5, 0.7, 1.}) {
      Rasterized_chart fine;
      fine.mask = random_mask(width, 10, part, random);
      fine.mask.add({5, width / 2, width / 2 + 1}); // at least one
      fine.centre = {0.3 * width, 5.};
      const Rasterized_chart coarse = halftone(fine);
      // the corner of the blocks, in cells of the mask
      const int left = int(std::lround(fine.centre[0] - 4. * coarse.centre[0]));
      const int bottom = int(std::lround(fine.centre[1] - 4. * coarse.centre[1]));
      const auto cells = [&](int x, int y) {
        int n = 0;
        for(int j = std::max(0, bottom + 4 * y); j < std::min(10, bottom + 4 * y + 4); ++j)
          for(int i = std::max(0, left + 4 * x); i < std::min(width, left + 4 * x + 4); ++i)
            n += fine.mask.has(i, j);
        return n;
      };
      const int w = coarse.mask.width(), h = coarse.mask.height();
      ASSERT_TRUE(w > 0 && h > 0);
      int most = 0;
      for(int y = -3; y < 6; ++y) // beyond the blocks, too
        for(int x = -40; x < w + 40; ++x)
          most = std::max(most, cells(x, y));
      std::vector<int> of_column(w, 0), of_row(h, 0);
      for(int y = -3; y < 6; ++y)
        for(int x = -40; x < w + 40; ++x) {
          const bool is_inside = x >= 0 && x < w && y >= 0 && y < h;
          const bool is_in = is_inside && coarse.mask.has(x, y);
          ASSERT_EQ(is_in, cells(x, y) >= (most >= 8 ? 8 : 1)) << width << ", " << part;
          if(is_in)
            of_column[x] = of_row[y] = 1;
        }
      EXPECT_TRUE(of_column.front() && of_column.back() && of_row.front() && of_row.back());
    }
}

TEST(Page_raster_test, many_rows_have_the_free_places_of_each)
{
  std::mt19937 random(3);
  for(const int width : {40, 64, 96, 200})
    for(const double part : {0.001, 0.01, 0.1}) {
      Page_raster page(width, 50);
      page.take(random_mask(width, 50, part, random).runs(), 0, 0);
      const std::vector<Probe> probes = probes_of(random_mask(30, 11, 0.3, random).runs());
      const int words = page.words(), top = 50 - 11 + 1;
      Texel_mask many(width, top), one = many;
      for(Texel_mask* mask : {&many, &one})
        for(int y = 0; y < top; ++y)
          mask->add({y, 0, width - 30 + 1});
      const bool are_any = page.restrict_to_free(probes, 0, top, many.row(0));
      bool is_any = false;
      for(int y = 0; y < top; ++y) {
        int begin = 0, end = words;
        is_any = page.restrict_to_free(probes, y, one.row(y), begin, end) || is_any;
      }
      EXPECT_EQ(are_any, is_any);
      for(int y = 0; y < top && are_any; ++y)
        ASSERT_TRUE(std::equal(many.row(y), many.row(y) + words, one.row(y))) << width << ", row " << y;
    }
}

// The definition of the overlap of charts with their padding, cell by cell.
TEST(Silhouette_test, overlaps_where_charts_are_too_near)
{
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
    std::size_t runs = 0;
    const int least
      = field.overlaps(s, 5, y, n, (std::numeric_limits<int>::max)(), row.data(), runs);
    EXPECT_EQ(runs, s.runs.size());
    EXPECT_EQ(least, *std::min_element(row.begin(), row.end()));
    for(int k = 0; k < n; ++k)
      ASSERT_EQ(row[std::size_t(k)],
                7 * overlap(s, t, 3 - 5 - k, 20 - y) + 11 * overlap(s, u, 30 - 5 - k, 1 - y));
    for(const int most : {least - 1, least}) { // what is given up is not better
      std::vector<int> bounded(row.size(), 0);
      const int found = field.overlaps(s, 5, y, n, most, bounded.data(), runs);
      ASSERT_EQ(found > most, most < least);
      if(found <= most) {
        ASSERT_EQ(bounded, row);
      }
    }
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

} // namespace raster_packer_test
