// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The coarsest level within a bound.

#include <support/mesh_generators.h>
#include <support/textured_levels.h>

#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <gtest/gtest.h>

#include <string>

namespace coarsest_level_test {

using namespace test_support;
using namespace textured_levels;
using SMM::Level_error;

// --- Choosing a level

TEST(Coarsest_level, predicates_are_the_bounds_of_the_measures)
{
  for(const Case& c : cases())
    for(const std::size_t k : positions(c.mesh)) {
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      const Texture_deviation d = measure_texture_deviation(c.mesh, k);
      for(const double factor : {0.5, 1. - 1e-9, 1., 2.}) {
        const double deviation = factor * d.deviation.maximum;
        const double distance = factor * d.distance.maximum;
        EXPECT_EQ(SMM::is_within_texture_deviation(c.mesh, k, deviation),
                  d.deviation.maximum <= deviation);
        EXPECT_EQ(SMM::is_within_distance(c.mesh, k, distance), d.distance.maximum <= distance);
      }
    }
}

TEST(Coarsest_level, is_within_the_bound_and_about_as_coarse_as_possible)
{
  for(const Case& c : cases())
    for(const Level_error kind : {Level_error::TEXTURE_DEVIATION, Level_error::DISTANCE}) {
      SCOPED_TRACE(c.name + (kind == Level_error::DISTANCE ? ", distance" : ", deviation"));
      const auto error_at = [&](std::size_t k) {
        const Texture_deviation d = measure_texture_deviation(c.mesh, k);
        return kind == Level_error::DISTANCE ? d.distance.maximum : d.deviation.maximum;
      };
      const std::size_t last = c.mesh.number_of_collapses();
      for(const double part : {0., 0.003, 0.03, 0.2}) {
        const double bound = part * measure_texture_deviation(c.mesh, 0).diagonal;
        const std::size_t k = SMM::coarsest_level_within(c.mesh, kind, bound);
        EXPECT_TRUE(c.mesh.is_whole(k));
        EXPECT_LE(error_at(k), bound);
        // A level with a little fewer triangles is not within the bound
        bool is_first = k == last;
        const double triangles = double(SMM::number_of_triangles_after(c.mesh, k));
        for(std::size_t j = k + 1; j <= last && !is_first; ++j)
          is_first = c.mesh.is_whole(j) && error_at(j) > bound;
        EXPECT_TRUE(is_first) << triangles;
      }
      EXPECT_EQ(SMM::coarsest_level_within(c.mesh, kind, 1e3), last);
    }
}

TEST(Coarsest_level, pixels_and_lengths)
{
  // At distance 10 with a right angle, the picture is 20 high.
  EXPECT_NEAR(SMM::pixels(1., 10., 1000., 0.5 * CGAL_PI), 50., 1e-9);
  EXPECT_NEAR(SMM::pixels(1., 20., 1000., 0.5 * CGAL_PI), 25., 1e-9);
  for(const double angle : {0.1, 0.8, 2.5})
    EXPECT_NEAR(SMM::length_of_pixels(SMM::pixels(0.3, 7., 720., angle), 7., 720., angle), 0.3,
                1e-12);
}

} // namespace coarsest_level_test
