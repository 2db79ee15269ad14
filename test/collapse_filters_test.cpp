// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Filters and the placement of collapses: each against its definition, in both engines.

#include <support/collapse_profiles.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace collapse_filters_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace collapse_profiles;

// --- Filters

// The filter accepts what `expected(direct)` says, which returns by how much the collapse is within
// the bounds; collapses within `margin` of a bound are left out. Both answers must occur.
template <class Filter, class Expected>
void expect_filter(const Filter& filter, double margin, const Expected& expected)
{
  std::size_t accepted = 0, rejected = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, filter, [&](Vertex_index removed, Vertex_index kept,
                                           const auto& value) {
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double slack = expected(direct);
      if(std::abs(slack) < margin || direct.quality < 0.01 || direct.old_quality < 0.01)
        return;
      EXPECT_EQ(bool(value), slack > 0.) << removed << " into " << kept << ", slack " << slack;
      (slack > 0. ? accepted : rejected) += 1;
    });
  }
  EXPECT_GT(accepted, 50u);
  EXPECT_GT(rejected, 50u);
}

TEST(Collapse_shape_filter, bounds_the_turn_of_normals)
{
  for(const double cosine : {-0.3, 0.2, 0.9}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.minimal_normal_cosine = cosine;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0.01,
                  [&](const Direct_measure& direct) { return direct.cosine - cosine; });
  }
}

TEST(Collapse_shape_filter, bounds_the_quality_unless_it_is_bad_already)
{
  for(const double quality : {0.1, 0.3, 0.5}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.minimal_quality = quality;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0.001, [&](const Direct_measure& direct) {
      return direct.quality - (std::min)(quality, direct.old_quality);
    });
  }
}

TEST(Collapse_shape_filter, bounds_the_degree_unless_it_is_high_already)
{
  for(const int degree : {5, 6, 8}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.maximal_degree = degree;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0., [&](const Direct_measure& direct) {
      const int lost = direct.is_border ? 2 : 4;
      return (std::max)(degree, direct.kept_degree) + 0.5
           - (direct.kept_degree + direct.removed_degree - lost);
    });
  }
}

TEST(Angular_defect_filter, bounds_the_defect_inside)
{
  for(const double degrees : {3., 10., 30.})
    expect_filter(SMS::Angular_defect_filter<>(degrees), 2e-4, [&](const Direct_measure& direct) {
      return direct.is_border
           ? 1. : degrees * CGAL_PI / 180. - std::abs(2. * CGAL_PI - direct.angle_sum);
    });
}

template <class Filter>
bool is_apex_removable(const Indexed_triangle_mesh& mesh, const Filter& filter)
{
  bool result = true, is_first = true;
  for_each_value(mesh, filter, [&](Vertex_index removed, Vertex_index, const auto& value) {
    if(removed != 0)
      return;
    EXPECT_TRUE(is_first || result == bool(value)); // the same for all neighbours and profiles
    result = bool(value);
    is_first = false;
  });
  EXPECT_FALSE(is_first);
  return result;
}

TEST(Angular_defect_filter, cones_and_saddles_of_known_angle)
{
  const double degree = CGAL_PI / 180.;
  for(const double bound : {10., 70., 120.})
    for(const double sign : {-1., 1.})
      for(const double beyond : {-1., -0.01, 0.01, 1.}) {
        const double sum = 2. * CGAL_PI + sign * (bound + beyond) * degree;
        const Indexed_triangle_mesh mesh = cone(sum, 12);
        EXPECT_EQ(is_apex_removable(mesh, SMS::Angular_defect_filter<>(bound)), beyond < 0.)
          << bound << " degrees and " << sign * beyond;
      }
}

TEST(Angular_defect_filter, bound_is_kept_in_both_engines)
{
  Indexed_triangle_mesh mesh = with_noise(irregular_grid(20, 20, seed), 0.4, seed);
  CGAL::Indexed_mesh::normalize(mesh);
  for(const double bound : {20., 45., 70.}) {
    SMM::Progressive_mesh_options edge_options;
    edge_options.target_vertices = 100;
    edge_options.angular_defect_bound = bound;
    std::vector<Progressive_mesh> results
      = {SMM::progressive_mesh_by_edge_collapse(mesh, edge_options)};
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      SMM::Flat_collapse_options options;
      options.target_vertices = 100;
      options.order = order;
      results.push_back(SMM::Flat_collapse_engine<>(
        mesh, Vertex_rings(mesh), {}, SMM::hierarchy_collapse_cost(),
        SMM::hierarchy_collapse_filter(bound)).run(options));
    }
    for(const Progressive_mesh& pm : results) {
      EXPECT_GT(pm.collapses.size(), 50u);
      EXPECT_LT(largest_removed_defect(mesh, pm), bound + 0.01);
      EXPECT_GT(largest_removed_defect(mesh, pm), 0.8 * bound); // it matters
    }
  }
}

// --- Halfedge_collapse_placement

// Locks one vertex.
struct One_locked
{
  Descriptor locked;
  friend bool get(const One_locked& map, const Descriptor v) { return v == map.locked; }
};

TEST(Halfedge_collapse_placement, takes_the_cheaper_direction_that_is_allowed)
{
  typedef SMS::Volume_and_border_area_cost Cost;
  typedef SMS::Halfedge_collapse_placement<Cost, SMS::Collapse_shape_filter<>> Placement;
  const Cost cost;
  const SMS::Collapse_shape_filter<> filter;
  std::size_t forward = 0, backward = 0, none = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Edge_collapse_mesh cgal(input.mesh);
    for(const auto e : cgal.surface.edges()) {
      const auto h = cgal.surface.halfedge(e);
      const Profile profile = cgal.profile(cgal.surface.source(h), cgal.surface.target(h));
      const Optional_point p1 = profile.p1(), p0 = profile.p0();
      const auto c1 = filter(profile, p1) ? cost(profile, p1) : decltype(cost(profile, p1))();
      const auto c0 = filter(profile, p0) ? cost(profile, p0) : decltype(cost(profile, p0))();
      const Optional_point expected = c1 && (!c0 || *c1 <= *c0) ? p1 : c0 ? p0 : Optional_point();
      EXPECT_TRUE(Placement()(profile) == expected);
      (expected == p1 ? forward : expected ? backward : none) += 1;
      // A locked vertex is not removed
      typedef SMS::Halfedge_collapse_placement<Cost, Accept_all_filter, One_locked> Locked;
      const Locked locked(cost, Accept_all_filter(), One_locked{profile.v0()});
      EXPECT_TRUE(locked(profile) != p1);
    }
  }
  EXPECT_GT(forward, 50u);
  EXPECT_GT(backward, 50u);
  EXPECT_GT(none, 50u);
}

TEST(Halfedge_collapse_placement, keeps_the_border_with_any_cost)
{
  typedef SMS::Halfedge_collapse_placement<SMS::Edge_length_cost<Surface_mesh>> Placement;
  Indexed_triangle_mesh mesh = grid(4, 4);
  Edge_collapse_mesh cgal(mesh);
  const Profile across = cgal.profile(2, 8), inward = cgal.profile(8, 2);
  EXPECT_TRUE(Placement()(across) == Optional_point(across.p0()));
  EXPECT_TRUE(Placement()(inward) == Optional_point(inward.p1()));
  const Profile corner = cgal.profile(3, 9); // from border to border through the inside
  EXPECT_TRUE(Placement()(corner) == Optional_point());
  mesh.points[8] = mesh.points[2]; // an edge without length
  Edge_collapse_mesh flat(mesh);
  EXPECT_TRUE(Placement()(flat.profile(2, 8)) == Optional_point());
  EXPECT_TRUE(Placement()(flat.profile(8, 2)) == Optional_point(mesh.points[2]));
}

} // namespace collapse_filters_test
