// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What packing the true shapes of charts is good for, and the parts of it.

#include <support/chart_shapes.h>
#include <support/packed_charts.h>

#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

} // namespace raster_packer_test
