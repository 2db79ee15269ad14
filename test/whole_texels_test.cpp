// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts whose boxes consist of whole texels, as light maps want them.

#include <support/chart_generators.h>
#include <support/mesh_generators.h>
#include <support/packed_charts.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/whole_texels.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace whole_texels_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using packed_charts::Texel;
typedef SMT::Chart_shape::Point_2 Point_2;

constexpr std::uint64_t seed = 57300;
const std::string seed_text = ", seed " + std::to_string(seed);

std::vector<std::vector<packed_charts::Triangle>> triangles_of_charts(const SMT::Texture_atlas& atlas)
{
  std::vector<std::vector<packed_charts::Triangle>> result(atlas.charts.number_of_charts);
  const auto corner = [&](std::size_t t, int c) {
    const auto& p = atlas.mesh.uv[atlas.mesh.wedges[t][c]];
    return Point_2(p.x() * double(atlas.width), p.y() * double(atlas.height));
  };
  for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t)
    result[atlas.charts.chart[t]].push_back({corner(t, 0), corner(t, 1), corner(t, 2)});
  return result;
}

double largest_distance_of_boxes(const SMT::Texture_atlas& atlas)
{
  double result = 0.;
  for(const auto& triangles : triangles_of_charts(atlas)) {
    CGAL::Bbox_2 box;
    for(const auto& t : triangles)
      for(const Point_2& p : t)
        box += p.bbox();
    for(const double side : {box.xmin(), box.xmax(), box.ymin(), box.ymax()})
      result = (std::max)(result, std::abs(side - std::round(side)));
    EXPECT_GE(box.xmax() - box.xmin(), 0.5);
    EXPECT_GE(box.ymax() - box.ymin(), 0.5);
  }
  return result;
}

// The gap between the texels that charts touch, without those whose sides alone they touch.
std::string error_in_gaps(const SMT::Texture_atlas& atlas, int gap)
{
  const auto charts = triangles_of_charts(atlas);
  std::vector<int> owner(atlas.width * atlas.height * atlas.number_of_pages, -1);
  const int w = int(atlas.width), h = int(atlas.height);
  std::vector<std::set<Texel>> texels;
  for(std::size_t c = 0; c < charts.size(); ++c) {
    std::set<Texel> inner;
    for(packed_charts::Triangle t : charts[c]) {
      const Point_2 middle = CGAL::centroid(t[0], t[1], t[2]);
      for(Point_2& p : t)
        p = p + 1e-6 * (middle - p);
      const auto some = packed_charts::touched_texels({t});
      inner.insert(some.begin(), some.end());
    }
    for(const Texel& t : inner) {
      if(t.first < 0 || t.second < 0 || t.first >= w || t.second >= h)
        return "chart " + std::to_string(c) + " leaves the page";
      owner[(atlas.page[c] * atlas.height + std::size_t(t.second)) * atlas.width
            + std::size_t(t.first)] = int(c);
    }
    texels.push_back(std::move(inner));
  }
  for(std::size_t c = 0; c < charts.size(); ++c)
    for(const Texel& t : texels[c])
      for(int x = (std::max)(0, t.first - gap); x <= (std::min)(w - 1, t.first + gap); ++x)
        for(int y = (std::max)(0, t.second - gap); y <= (std::min)(h - 1, t.second + gap); ++y) {
          const int o = owner[(atlas.page[c] * atlas.height + std::size_t(y)) * atlas.width
                              + std::size_t(x)];
          if(o != -1 && o != int(c))
            return packed_charts::at(c, t) + " is too near to chart " + std::to_string(o);
        }
  return {};
}

TEST(Whole_texels, are_boxes_of_charts_with_the_gap_as_asked)
{
  std::vector<Named_mesh> meshes = generated_meshes(seed);
  meshes.push_back({"triangles", grid(1, 1)});
  for(const auto& [name, mesh] : meshes)
    for(const unsigned int levels : {0u, 2u}) {
      SMT::Texture_atlas_options options = small_texture(128);
      options.has_whole_texels = true;
      options.packing.mip_levels = levels;
      options.packing.padding = 1 + levels % 2;
      const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
      ASSERT_EQ(result.error, "") << name;
      EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << seed_text;
      EXPECT_LT(largest_distance_of_boxes(result.atlas), 1e-9) << name << seed_text;
      EXPECT_EQ(error_in_gaps(result.atlas, int(options.packing.padding << levels)), "")
        << name << ", " << levels << seed_text;
    }
}

TEST(Whole_texels, are_those_nearest_to_points)
{
  Random random(seed + 1);
  for(int i = 0; i < 2000; ++i) {
    std::vector<Point_2> points;
    const double size = std::exp(uniform(random, -5., 4.));
    const double x = uniform(random, 5., 50.), y = uniform(random, 5., 50.);
    for(int k = 0; k < 5; ++k)
      points.push_back(Point_2(x + size * uniform(random, -1., 1.), y + size * uniform(random, -1., 1.)));
    std::vector<Point_2> whole = points;
    SMT::internal::take_to_whole_texels(whole);
    const CGAL::Bbox_2 box = CGAL::bbox_2(whole.begin(), whole.end());
    for(const double side : {box.xmin(), box.xmax(), box.ymin(), box.ymax()})
      EXPECT_EQ(side, std::round(side)) << seed_text;
    EXPECT_GT((box.xmax() - box.xmin()) * (box.ymax() - box.ymin()), 0.) << seed_text;
    for(int k = 0; k < 5; ++k) {
      EXPECT_LE(std::abs(whole[k].x() - points[k].x()), 1.) << seed_text;
      EXPECT_LE(std::abs(whole[k].y() - points[k].y()), 1.) << seed_text;
    }
  }
}

} // namespace whole_texels_test
