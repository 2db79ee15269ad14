// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stop predicates of decimate().

#include <support/decimated_hills.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/decimate.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/boost/graph/internal/helpers.h>

#include <gtest/gtest.h>

#include <cmath>

namespace decimate_stop_test {

using namespace test_support;
using namespace decimated_hills;

// --- Stop predicates

struct Counts
{
  std::size_t vertices, edges, faces;
};

Counts counts_of(const Indexed_triangle_mesh& mesh)
{
  const Topology topology = topology_of(mesh.triangles);
  EXPECT_EQ(topology.defect, "");
  EXPECT_EQ(topology.vertices, mesh.points.size());
  return {topology.vertices, topology.edges, topology.triangles};
}

// As CGAL 6 has it.
struct Face_count_stop_predicate
{
  std::size_t threshold;
  template <class FT, class Profile>
  bool operator()(const FT&, const Profile& profile, std::size_t, std::size_t) const
  {
    return CGAL::internal::exact_num_faces(profile.surface_mesh()) < threshold;
  }
};

template <class Stop>
Counts decimated(const Stop& stop, SMM::Collapse_order order)
{
  // Stop predicates of others in both orders
  struct Ordered : SMM::Decimation_options
  {
    const Stop* stop;
    bool operator()(const double& cost, const SMM::Flat_collapse_profile& profile,
                    std::size_t initial, std::size_t current) const
    {
      return (*stop)(cost, profile, initial, current);
    }
  } ordered;
  ordered.order = order;
  ordered.stop = &stop;
  Indexed_triangle_mesh mesh = hills();
  const SMM::Decimation_result result = SMM::decimate(mesh, ordered);
  EXPECT_TRUE(result.is_ok() && !result.is_exhausted) << result.error;
  if(order == SMM::Collapse_order::BATCHED) { // what there is without options
    Indexed_triangle_mesh other = hills();
    SMM::decimate(other, stop);
    EXPECT_EQ(other.triangles, mesh.triangles);
  }
  return counts_of(mesh);
}

class Stop_predicates : public testing::TestWithParam<SMM::Collapse_order> {};

// The last collapse, and no earlier one, takes the number below the threshold.
TEST_P(Stop_predicates, of_cgal_count_edges)
{
  for(const std::size_t threshold : {300u, 2001u, 5000u}) {
    const Counts left = decimated(SMS::Count_stop_predicate<Surface_mesh>(threshold), GetParam());
    EXPECT_LT(left.edges, threshold);
    EXPECT_GE(left.edges + 3, threshold);
  }
  const std::size_t all = counts_of(hills()).edges;
  for(const double ratio : {0.07, 0.5, 0.99}) {
    const Counts left
      = decimated(SMS::Count_ratio_stop_predicate<Surface_mesh>(ratio), GetParam());
    EXPECT_LT(double(left.edges), ratio * double(all));
    EXPECT_GE(double(left.edges + 3), ratio * double(all));
  }
}

TEST_P(Stop_predicates, of_cgal_6_count_faces)
{
  for(const std::size_t threshold : {200u, 1001u, 4000u}) {
    const Counts left = decimated(Face_count_stop_predicate{threshold}, GetParam());
    EXPECT_LT(left.faces, threshold);
    EXPECT_GE(left.faces + 2, threshold);
  }
}

TEST_P(Stop_predicates, options_are_one)
{
  SMM::Decimation_options options;
  options.order = GetParam();
  const auto left = [&options] {
    Indexed_triangle_mesh mesh = hills();
    const SMM::Decimation_result result = SMM::decimate(mesh, options);
    EXPECT_TRUE(result.is_ok() && !result.is_exhausted) << result.error;
    return counts_of(mesh);
  };
  options.target_vertices = 400;
  EXPECT_EQ(left().vertices, 400u);
  options.target_edges = 3000;
  EXPECT_LE(left().edges, 3000u);
  EXPECT_GT(left().edges, 2997u);
  options.target_faces = 2400;
  EXPECT_LE(left().faces, 2400u);
  EXPECT_GT(left().faces, 2398u);
}

// The length of the collapsed edge, noted.
struct Length_cost
{
  template <class Profile, class OptionalPoint>
  SMS::Optional_of_policies<typename Profile::FT>
  operator()(const Profile& profile, const OptionalPoint&) const
  {
    return std::sqrt(CGAL::squared_distance(profile.p0(), profile.p1()));
  }
};

// All collapses that cost no more take place, and none that costs more.
TEST_P(Stop_predicates, bounds_the_cost)
{
  SMM::Decimation_options options;
  options.order = GetParam();
  options.max_cost = 1.2;
  const auto length_of = [](const SMM::Progressive_surface& surface, std::size_t i) {
    const auto [removed, kept] = surface.progressive_mesh.collapses[i];
    return std::sqrt(CGAL::squared_distance(surface.points[removed], surface.points[kept]));
  };
  Indexed_triangle_mesh mesh = hills();
  SMM::Progressive_surface surface;
  surface.points = mesh.points;
  const auto np = CGAL::parameters::get_cost(Length_cost()).filter(SMS::Accept_all_filter());
  surface.progressive_mesh.number_of_vertices = mesh.points.size();
  surface.progressive_mesh.triangles = mesh.triangles;
  EXPECT_FALSE(SMM::internal::decimate_by<CGAL::Default>(options, np, {}, surface)); // not exhausted
  EXPECT_EQ(surface.error, "");
  ASSERT_GT(surface.progressive_mesh.collapses.size(), mesh.points.size() / 10);
  for(std::size_t i = 0; i < surface.progressive_mesh.collapses.size(); ++i)
    EXPECT_LE(length_of(surface, i), options.max_cost * (1. + 1e-6));
  const SMM::Decimation_result result = SMM::decimate(mesh, options, np);
  EXPECT_EQ(result.number_of_collapses, surface.progressive_mesh.collapses.size());
  // What is left and short is not possible, for its topology
  Indexed_triangle_mesh again = mesh;
  EXPECT_LE(SMM::decimate(again, options, np).number_of_collapses, mesh.points.size() / 100);
}

// The default cost is a length: a mesh of another size gives the same with a bound of that size.
TEST_P(Stop_predicates, costs_have_the_unit_of_the_mesh)
{
  SMM::Decimation_options options;
  options.order = GetParam();
  options.max_cost = 0.5;
  Indexed_triangle_mesh mesh = hills(), large = scaled(hills(), 1024.);
  const std::size_t collapses = SMM::decimate(mesh, options).number_of_collapses;
  EXPECT_GT(collapses, 100u);
  EXPECT_LT(collapses, hills().points.size() - 100);
  options.max_cost *= 1024.;
  EXPECT_EQ(SMM::decimate(large, options).number_of_collapses, collapses);
  EXPECT_EQ(large.triangles, mesh.triangles);
}

INSTANTIATE_TEST_SUITE_P(Orders, Stop_predicates,
                         testing::Values(SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT));

TEST(Decimate_stop, by_edge_length_sees_the_points_of_the_mesh)
{
  Indexed_triangle_mesh mesh = scaled(hills(), 1000.);
  const std::size_t n = mesh.points.size();
  const auto np = CGAL::parameters::get_cost(SMS::Edge_length_cost<Surface_mesh>());
  const auto stop = SMS::Edge_length_stop_predicate<double>(1200.);
  EXPECT_GT(SMM::decimate(mesh, stop, np).number_of_collapses, n / 10);
  EXPECT_GT(mesh.points.size(), n / 10);
}

} // namespace decimate_stop_test
