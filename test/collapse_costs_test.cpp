// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Costs of collapses: each against its formula, in CGAL's edge_collapse() and in the flat engine.

#include <support/collapse_profiles.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace collapse_costs_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using namespace collapse_profiles;

// --- Costs

// The cost for all halfedges of all meshes is what `expected(direct)` says. Single precision knows
// the area of slivers badly, and the cube root makes 0.015 of a rounding error in a volume of zero.
template <class Cost, class Expected>
void expect_cost(const Cost& cost, const Expected& expected)
{
  std::size_t checked_closely = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, cost, [&](Vertex_index removed, Vertex_index kept,
                                         const auto& value) {
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double c = expected(direct);
      const bool is_close = direct.volume > 1e-3;
      ASSERT_TRUE(bool(value));
      if(direct.quality > 0.1) {
        EXPECT_NEAR(*value, c, (is_close ? 3e-4 : 0.015) * (1. + c)) << removed << " into " << kept;
        checked_closely += is_close ? 1 : 0;
      }
    });
  }
  EXPECT_GT(checked_closely, 1000u);
}

double volume_and_border_area(const Direct_measure& direct)
{
  return std::cbrt(direct.volume) + std::sqrt(direct.border_area);
}

TEST(Volume_and_border_area_cost, is_the_formula)
{
  expect_cost(SMS::Volume_and_border_area_cost(), volume_and_border_area);
}

TEST(Volume_and_border_area_cost, closed_forms)
{
  // A plane with one vertex lifted: its collapse sweeps the pyramid below it. A regular grid has
  // six triangles, of area 3, at a vertex.
  Indexed_triangle_mesh mesh = grid(4, 4);
  mesh.points[12] = Point_3(2, 2, 0.6);
  for_each_value(mesh, SMS::Volume_and_border_area_cost(), [](Vertex_index removed, Vertex_index,
                                                              const auto& cost) {
    if(removed == 12) {
      EXPECT_NEAR(*cost, std::cbrt(3. * 0.6 / 3.), 1e-5);
    }
    if(removed == 1) { // on a straight border
      EXPECT_NEAR(*cost, 0., 1e-5);
    }
    if(removed == 24) { // a corner
      EXPECT_NEAR(*cost, std::sqrt(0.5), 1e-5);
    }
  });
}

TEST(Triangle_shape_cost, is_the_formula)
{
  for(const double weight : {0., 0.3, 2.})
    expect_cost(SMS::Triangle_shape_cost<>(weight), [weight](const Direct_measure& direct) {
      return volume_and_border_area(direct) + weight * direct.length / std::sqrt(direct.quality);
    });
}

// Costs of any size: exactly similar ones for powers of two, as good as equal ones otherwise.
TEST(Costs, scale_with_the_mesh)
{
  const auto mesh = with_hills(irregular_grid(8, 8, seed), 1.5, seed);
  const SMS::Triangle_shape_cost<> cost;
  const SMM::Hierarchy_collapse_filter filter = SMM::hierarchy_collapse_filter();
  Edge_collapse_mesh original(mesh);
  for(const double factor : {0x1p-100, 0x1p100, 1e-30, 1e30, 1e-100, 1e100}) {
    Edge_collapse_mesh similar(scaled(mesh, factor));
    const bool is_exact = std::abs(std::log2(factor)) == 100.;
    for_each_halfedge(mesh, [&](Vertex_index removed, Vertex_index kept) {
      const Profile a = original.profile(removed, kept), b = similar.profile(removed, kept);
      const Optional_point pa = a.p1(), pb = b.p1();
      const auto ca = cost(a, pa), cb = cost(b, pb);
      ASSERT_TRUE(ca && cb) << factor;
      EXPECT_NEAR(*cb / factor, *ca, is_exact ? 0. : 0.01);
      EXPECT_TRUE(!is_exact || bool(filter(a, pa)) == bool(filter(b, pb)));
    });
  }
  Edge_collapse_mesh far(translated(mesh, 1e7, -1e7, 1e7));
  for_each_halfedge(mesh, [&](Vertex_index removed, Vertex_index kept) {
    const Profile a = original.profile(removed, kept), b = far.profile(removed, kept);
    EXPECT_NEAR(*cost(b, Optional_point(b.p1())), *cost(a, Optional_point(a.p1())), 0.02);
  });
}

// --- Accumulated_cost

// The losses after the collapses of a progressive mesh, from the definition.
std::vector<double> losses_after(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
{
  Replay replay(mesh.triangles, mesh.points.size());
  std::vector<double> loss(mesh.points.size(), 0.);
  for(const Halfedge_collapse& c : pm.collapses) {
    const double own = volume_and_border_area(
      measure_directly(mesh.points, replay, c.removed, c.kept));
    loss[c.kept] = (std::max)(loss[c.kept], loss[c.removed] + own);
    replay.collapse(c);
  }
  return loss;
}

std::set<Vertex_index> remaining_vertices(const Progressive_mesh& pm)
{
  std::set<Vertex_index> result;
  for(const Triangle_indices& t : SMM::triangles_after(pm, pm.collapses.size()))
    result.insert(t.begin(), t.end());
  return result;
}

TEST(Accumulated_cost, carries_losses_in_the_flat_engine)
{
  typedef SMS::Accumulated_cost<SMS::Volume_and_border_area_cost, SMM::Flat_vertex_cost_map> Cost;
  for(const Named_mesh& input : smooth_meshes())
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      SCOPED_TRACE(input.name + seed_text);
      SMM::Flat_vertex_cost_map losses;
      put(losses, 0, 17.f); // which initialize() must forget
      SMM::Flat_collapse_options options;
      options.target_vertices = input.mesh.points.size() / 3;
      options.order = order;
      const Progressive_mesh pm = SMM::Flat_collapse_engine<Cost, Accept_all_filter>(
        input.mesh, Vertex_rings(input.mesh), {}, Cost(losses), Accept_all_filter()).run(options);
      const std::vector<double> expected = losses_after(input.mesh, pm);
      EXPECT_GT(pm.collapses.size(), 0u);
      for(const Vertex_index v : remaining_vertices(pm))
        EXPECT_NEAR(get(losses, v), expected[v], 0.05 * (1. + expected[v])) << v;
    }
}

TEST(Accumulated_cost, carries_losses_in_edge_collapse)
{
  typedef Surface_mesh::Property_map<Descriptor, double> Losses;
  typedef SMS::Accumulated_cost<SMS::Volume_and_border_area_cost, Losses> Cost;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Surface_mesh surface = SMM::internal::surface_mesh_of(input.mesh), other = surface;
    const Stop_at stop{surface.number_of_edges() / 3};
    const Cost cost(surface.add_property_map<Descriptor, double>("v:loss", 17.).first);
    SMM::Progressive_mesh_recorder<Surface_mesh, Cost> recorder(surface, {}, cost);
    SMS::edge_collapse(surface, stop,
                       CGAL::parameters::get_cost(cost).visitor(recorder)
                         .get_placement(SMS::Halfedge_collapse_placement<Cost>(cost)));
    const Progressive_mesh& pm = recorder.progressive_mesh();
    const std::vector<double> expected = losses_after(input.mesh, pm);
    std::map<Point_3, double> expected_at;
    for(const Vertex_index v : remaining_vertices(pm))
      expected_at[input.mesh.points[v]] = expected[v];
    const Losses losses = surface.add_property_map<Descriptor, double>("v:loss").first;
    for(const Descriptor v : surface.vertices()) {
      ASSERT_EQ(expected_at.count(surface.point(v)), 1u);
      const double loss = expected_at[surface.point(v)];
      EXPECT_NEAR(losses[v], loss, 0.05 * (1. + loss)) << v;
    }
    // The visitor that only tells the cost does the same
    const Cost other_cost(other.add_property_map<Descriptor, double>("v:loss").first);
    SMS::edge_collapse(other, stop,
                       CGAL::parameters::get_cost(other_cost)
                         .visitor(SMS::Accumulated_cost_visitor<Surface_mesh, Cost>(other_cost))
                         .get_placement(SMS::Halfedge_collapse_placement<Cost>(other_cost)));
    surface.collect_garbage();
    other.collect_garbage();
    EXPECT_TRUE(std::equal(surface.points().begin(), surface.points().end(),
                           other.points().begin(), other.points().end()));
  }
}

} // namespace collapse_costs_test
