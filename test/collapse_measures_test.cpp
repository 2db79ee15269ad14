// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What policies know of a collapse, against a second derivation.

#include <support/collapse_profiles.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace collapse_measures_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace collapse_profiles;

// --- Measures

// A policy that returns what all others are made of.
struct Whole_measure
{
  template <class AnyProfile, class Placement>
  Measured_collapse operator()(const AnyProfile& profile, const Placement& placement) const
  {
    return SMS::internal::measured(profile, placement).collapse();
  }
};

TEST(Halfedge_collapse, measures_are_the_definitions)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, Whole_measure(), [&](Vertex_index removed, Vertex_index kept,
                                                    const Measured_collapse& seen) {
      SCOPED_TRACE(std::to_string(removed) + " into " + std::to_string(kept));
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double u = seen.unit;
      EXPECT_TRUE(seen.is_valid);
      EXPECT_EQ(seen.is_border, direct.is_border);
      EXPECT_EQ(seen.removed_degree, direct.removed_degree);
      EXPECT_EQ(seen.kept_degree, direct.kept_degree);
      // Single precision of coordinates of the order of 1, and a dozen operations on them
      EXPECT_NEAR(seen.measure.volume * u * u * u, direct.volume, 3e-6 * u * u * u);
      EXPECT_NEAR(seen.measure.border_area * u * u, direct.border_area, 3e-6 * u * u);
      EXPECT_NEAR(seen.measure.length * u, direct.length, 1e-6 * u);
      EXPECT_NEAR(seen.measure.min_squared_quality, direct.quality * direct.quality, 1e-5);
      EXPECT_NEAR(seen.min_squared_quality, direct.old_quality * direct.old_quality, 1e-5);
      EXPECT_NEAR(seen.angle_sum, direct.angle_sum, 1.5e-5 * seen.removed_degree); // Vertex_star
      if(direct.quality > 0.01 && direct.old_quality > 0.01) { // otherwise normals are uncertain
        EXPECT_NEAR(seen.measure.min_signed_squared_cosine,
                    direct.cosine * std::abs(direct.cosine), 1e-3);
      }
    });
  }
}

// A star around vertex 0 whose ring is vertices 1 to d: open at the border, closed otherwise.
Indexed_triangle_mesh star_mesh(const std::vector<Point_3>& ring, bool is_border)
{
  Indexed_triangle_mesh mesh;
  mesh.points = {Point_3(0., 0., 0.)};
  mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  const Vertex_index d = Vertex_index(ring.size());
  for(Vertex_index i = 0; i < (is_border ? d - 1 : d); ++i)
    mesh.triangles.push_back({0, i + 1, (i + 1) % d + 1});
  return mesh;
}

// Fills the star with the ring of a `star_mesh()`.
void measure_star(const Indexed_triangle_mesh& mesh, bool is_border,
                  SMS::Vertex_star& star)
{
  star.reset(int(mesh.points.size()) - 1, is_border);
  for(int i = 0; i < star.degree(); ++i) {
    const Point_3& p = mesh.points[i + 1];
    star.set_ring_point(i, float(p.x()), float(p.y()), float(p.z()));
  }
  star.prepare();
}

// All targets of a star against the definition, with the bounds of `measures_are_the_definitions`.
void expect_star_measures(const Indexed_triangle_mesh& mesh, bool is_border,
                          const SMS::Vertex_star& star)
{
  const Replay replay(mesh.triangles, mesh.points.size());
  for(int k = 0; k < star.degree(); k += is_border ? star.degree() - 1 : 1) {
    SCOPED_TRACE("target " + std::to_string(k));
    const Direct_measure direct = measure_directly(mesh.points, replay, 0, Vertex_index(k + 1));
    const SMS::Collapse_measure seen = star.measure(k);
    EXPECT_EQ(is_border, direct.is_border);
    EXPECT_NEAR(seen.volume, direct.volume, 3e-6);
    EXPECT_NEAR(seen.border_area, direct.border_area, 3e-6);
    EXPECT_NEAR(seen.length, direct.length, 1e-6);
    EXPECT_NEAR(seen.min_squared_quality, direct.quality * direct.quality, 1e-5);
    EXPECT_NEAR(star.min_squared_quality(), direct.old_quality * direct.old_quality, 1e-5);
    EXPECT_NEAR(star.angle_sum(), direct.angle_sum, 1.5e-5 * star.number_of_triangles());
    if(direct.quality > 0.01 && direct.old_quality > 0.01) {
      EXPECT_NEAR(seen.min_signed_squared_cosine, direct.cosine * std::abs(direct.cosine), 1e-3);
    }
  }
}

// One star object for all, as in the flat engine: nothing of an earlier star may be left over.
TEST(Vertex_star, measures_of_all_targets_are_the_definitions)
{
  Random random(seed);
  SMS::Vertex_star star;
  for(int round = 0; round < 100; ++round)
    for(const double noise : {0.1, 0.5}) // a fan that is nearly flat, and one that is no longer one
      for(const bool is_border : {false, true})
        for(int d = is_border ? 2 : 3; d <= SMS::Vertex_star::max_degree; ++d) {
          SCOPED_TRACE((is_border ? "border, degree " : "inside, degree ") + std::to_string(d)
                       + ", noise " + std::to_string(noise) + ", round " + std::to_string(round)
                       + seed_text);
          std::vector<Point_3> ring;
          for(int i = 0; i < d; ++i) {
            const double angle = (is_border ? 1. : 2.) * CGAL_PI * i / d;
            ring.emplace_back(std::cos(angle) + uniform(random, -noise, noise),
                              std::sin(angle) + uniform(random, -noise, noise),
                              uniform(random, -noise, noise));
          }
          const Indexed_triangle_mesh mesh = star_mesh(ring, is_border);
          measure_star(mesh, is_border, star);
          expect_star_measures(mesh, is_border, star);
          if(testing::Test::HasFailure())
            return;
        }
}

TEST(Vertex_star, triangle_without_area_has_no_turn)
{
  // The triangle of the first two ring vertices has no area, and would look down after the collapse
  // into the last one; the others stay in the plane.
  const Indexed_triangle_mesh mesh = star_mesh(
    {Point_3(1, 0, 0), Point_3(2, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0)},
    false);
  SMS::Vertex_star star;
  measure_star(mesh, false, star);
  EXPECT_NEAR(star.measure(4).min_signed_squared_cosine, 1., 1e-6);
  EXPECT_EQ(star.min_squared_quality(), 0.f);
  EXPECT_NEAR(star.angle_sum(), 2. * CGAL_PI, 1.5e-5 * 5);
}

TEST(Halfedge_collapse, other_placements_are_none)
{
  const auto mesh = with_hills(grid(4, 4), 1., seed);
  Edge_collapse_mesh cgal(mesh);
  const Profile inside = cgal.profile(12, 6), across = cgal.profile(2, 8);
  const auto middle = CGAL::midpoint(inside.p0(), inside.p1());
  using SMS::internal::measure_halfedge_collapse;
  EXPECT_TRUE(measure_halfedge_collapse(inside, Optional_point(inside.p0())).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(inside, Optional_point(middle)).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(inside, Optional_point()).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(across, Optional_point(across.p1())).is_valid);
  EXPECT_TRUE(measure_halfedge_collapse(across, Optional_point(across.p0())).is_valid);
  Edge_collapse_mesh wheel(fan(15)); // a star that is too large to be measured
  const Profile spoke = wheel.profile(0, 1);
  EXPECT_FALSE(measure_halfedge_collapse(spoke, Optional_point(spoke.p1())).is_valid);
}

TEST(Float_lanes, fast_cbrt_is_the_cube_root)
{
  for(double a = 1e-35; a < 1e37; a *= 1.037) {
    const double root = std::cbrt(double(float(a)));
    EXPECT_NEAR(double(SMS::internal::fast_cbrt(float(a))), root, 5e-5 * root) << a;
  }
  EXPECT_EQ(SMS::internal::fast_cbrt(0.f), 0.f);
}

} // namespace collapse_measures_test
