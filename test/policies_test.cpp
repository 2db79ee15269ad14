// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Policies of CGAL and of users in the flat engine.

#include <support/collapse_profiles.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace policies_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace collapse_profiles;

// --- Policies of others

// A quadric-like cost as users write it: the squared distances of the new point from the planes of
// the triangles that move, plus a term of the link.
struct Plane_distance_cost
{
  template <class AnyProfile, class Placement>
  SMS::Optional_of_policies<typename AnyProfile::FT>
  operator()(const AnyProfile& profile, const Placement& placement) const
  {
    if(!placement)
      return {};
    const auto& gt = profile.geom_traits();
    const auto vpm = profile.vertex_point_map();
    typename AnyProfile::FT sum = 0.;
    for(const auto& t : profile.triangles()) {
      const auto &a = get(vpm, t.v0), &b = get(vpm, t.v1), &c = get(vpm, t.v2);
      const auto n = gt.construct_cross_product_vector_3_object()(b - a, c - a);
      const auto distance = (*placement - a) * n;
      sum += distance * distance / (n * n);
    }
    for(const auto v : profile.link())
      sum += 1e-3 * CGAL::squared_distance(get(vpm, v), *placement);
    return sum;
  }
};

TEST(Flat_collapse_profile, says_what_the_edge_profile_says)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Edge_collapse_mesh cgal(input.mesh);
    typedef std::array<std::size_t, 3> Triple;
    const auto sorted_triangles_of = [](const auto& profile) {
      std::multiset<Triple> result; // the vertex that moves is the second
      for(const auto& t : profile.triangles())
        result.insert({t.v0, t.v1, t.v2});
      return result;
    };
    const auto link_of = [](const auto& profile) {
      std::set<std::size_t> result;
      for(const auto v : profile.link())
        result.insert(v);
      return result;
    };
    for_each_flat_profile(input.mesh, [&](const auto& flat, const auto& placement) {
      const Profile edge = cgal.profile(flat.v0(), flat.v1());
      EXPECT_EQ(flat.p0(), edge.p0());
      EXPECT_EQ(flat.p1(), edge.p1());
      EXPECT_EQ(*placement, edge.p1());
      EXPECT_EQ(flat.left_face_exists(), edge.left_face_exists());
      EXPECT_EQ(flat.right_face_exists(), edge.right_face_exists());
      EXPECT_EQ(flat.is_v0_v1_a_border(), edge.is_v0_v1_a_border());
      EXPECT_EQ(flat.is_v1_v0_a_border(), edge.is_v1_v0_a_border());
      if(edge.left_face_exists()) {
        EXPECT_EQ(flat.vL(), std::size_t(edge.vL()));
      }
      if(edge.right_face_exists()) {
        EXPECT_EQ(flat.vR(), std::size_t(edge.vR()));
      }
      EXPECT_EQ(sorted_triangles_of(flat), sorted_triangles_of(edge));
      EXPECT_EQ(link_of(flat), link_of(edge));
      const double cost = *Plane_distance_cost()(edge, Optional_point(edge.p1()));
      EXPECT_NEAR(*Plane_distance_cost()(flat, placement), cost, 1e-9 * (1. + cost));
    });
  }
}

template <class Cost, class Filter>
Progressive_mesh decimate_flat(const Indexed_triangle_mesh& mesh, const Cost& cost,
                               const Filter& filter)
{
  SMM::Flat_collapse_options options;
  options.target_vertices = mesh.points.size() / 3;
  options.order = SMM::Collapse_order::STRICT;
  return SMM::Flat_collapse_engine<Cost, Filter>(mesh, Vertex_rings(mesh), {}, cost, filter)
    .run(options);
}

TEST(Policies_of_others, run_in_the_flat_engine)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const SMS::Edge_length_cost<SMM::Flat_surface> edge_length;
    const Progressive_mesh shortest = decimate_flat(input.mesh, edge_length, Accept_all_filter());
    EXPECT_EQ(error_in_progressive_mesh(input.mesh, shortest), "");
    ASSERT_FALSE(shortest.collapses.empty());
    // The first collapse is that of the shortest edge that may be collapsed
    const Vertex_rings rings(input.mesh);
    const auto squared_length = [&](Vertex_index v, Vertex_index t) {
      return float(CGAL::squared_distance(input.mesh.points[v], input.mesh.points[t]));
    };
    const auto [removed, kept] = shortest.collapses[0];
    for_each_halfedge(input.mesh, [&, removed = removed, kept = kept](Vertex_index v,
                                                                      Vertex_index t) {
      const auto k = std::find(rings.ring(v), rings.ring(v) + rings.degree(v), t) - rings.ring(v);
      if(rings.is_collapse_valid(v, std::uint32_t(k))) {
        EXPECT_LE(squared_length(removed, kept), squared_length(v, t));
      }
    });
    EXPECT_EQ(error_in_progressive_mesh(
      input.mesh, decimate_flat(input.mesh, Plane_distance_cost(), Accept_all_filter())), "");
    const SMS::Triangle_shape_cost<SMS::Edge_length_cost<SMM::Flat_surface>> decorated;
    EXPECT_EQ(error_in_progressive_mesh(
      input.mesh, decimate_flat(input.mesh, decorated, Accept_all_filter())), "");
  }
}

// The number of collapses after which a triangle looks the other way.
std::size_t number_of_flips(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
{
  Replay replay(mesh.triangles, mesh.points.size());
  std::size_t result = 0;
  for(const Halfedge_collapse& c : pm.collapses) {
    result += measure_directly(mesh.points, replay, c.removed, c.kept).cosine < -1e-6 ? 1 : 0;
    replay.collapse(c);
  }
  return result;
}

TEST(Policies_of_others, filters_of_cgal_alone_and_decorated)
{
  const Indexed_triangle_mesh mesh = smooth_meshes()[1].mesh;
  const SMS::Edge_length_cost<SMM::Flat_surface> cost;
  typedef SMS::Bounded_normal_change_filter<> Normals;
  EXPECT_GT(number_of_flips(mesh, decimate_flat(mesh, cost, Accept_all_filter())), 0u);
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, Normals())), 0u);
  const SMS::Angular_defect_filter<Normals> decorated(30.);
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, decorated)), 0u);
  EXPECT_LT(largest_removed_defect(mesh, decimate_flat(mesh, cost, decorated)), 30.01);
  const SMS::Collapse_shape_filter<Normals> shaped(no_shape_bounds());
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, shaped)), 0u);
  // And in edge_collapse()
  typedef SMS::Angular_defect_filter<Normals> Filter;
  typedef SMS::Edge_length_cost<Surface_mesh> Cost;
  Surface_mesh surface = SMM::internal::surface_mesh_of(mesh);
  SMM::Progressive_mesh_recorder<Surface_mesh> recorder(surface);
  SMS::edge_collapse(surface, Stop_at{100},
                     CGAL::parameters::get_cost(Cost()).visitor(recorder).get_placement(
                       SMS::Halfedge_collapse_placement<Cost, Filter>(Cost(), Filter(30.))));
  EXPECT_GT(recorder.number_of_collapses(), 10u);
  EXPECT_EQ(number_of_flips(mesh, recorder.progressive_mesh()), 0u);
  EXPECT_LT(largest_removed_defect(mesh, recorder.progressive_mesh()), 30.01);
}

} // namespace policies_test
