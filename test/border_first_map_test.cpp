// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// border_first_map(): surfaces whose map is known, what it promises about the border, and borders
// that would cross themselves.

#include <support/chart_generators.h>
#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace border_first_map_test {

using namespace test_support;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;

typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
typedef std::vector<Point_2> Uv;

double length(const Indexed_triangle_mesh& mesh, Vertex_index p, Vertex_index q)
{
  return std::sqrt(squared_distance(mesh.points[p], mesh.points[q]));
}

double length(const Uv& uv, Vertex_index p, Vertex_index q)
{
  return std::sqrt(squared_distance(uv[p], uv[q]));
}

// The least and the largest ratio of an edge's length in the plane to that on the surface.
std::array<double, 2> length_ratios(const Indexed_triangle_mesh& mesh, const Uv& uv,
                                    bool only_border)
{
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  std::array<double, 2> result = {std::numeric_limits<double>::infinity(), 0.};
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      if(only_border && adjacency.opposite(t, c) != CGAL::Indexed_mesh::no_halfedge)
        continue;
      const Vertex_index p = mesh.triangles[t][c], q = mesh.triangles[t][(c + 1) % 3];
      const double ratio = length(uv, p, q) / length(mesh, p, q);
      result = {(std::min)(result[0], ratio), (std::max)(result[1], ratio)};
    }
  return result;
}

void expect_isometric(const Indexed_triangle_mesh& mesh, const std::string& name, double error)
{
  const SMP::Border_first_map map = SMP::border_first_map(mesh);
  ASSERT_EQ(map.error, "") << name;
  const auto [least, largest] = length_ratios(mesh, map.uv, false);
  EXPECT_NEAR(largest / least, 1., error) << name;
  EXPECT_EQ(SMT::measure_chart_distortion(mesh, map.uv).flipped_faces, 0u) << name;
}

TEST(Border_first_map, of_a_planar_chart_is_a_copy)
{
  constexpr std::uint64_t seed = 20261122;
  int disks = 0;
  for(const Named_mesh& chart : planar_charts(seed))
    if(SMP::border_first_map(chart.mesh).error.empty()) { // without holes
      expect_isometric(chart.mesh, chart.name, 1e-6);
      ++disks;
    }
  EXPECT_GE(disks, 2);
}

TEST(Border_first_map, unrolls_a_cylinder)
{
  const Indexed_triangle_mesh flat = irregular_grid(24, 16, 7);
  expect_isometric(rolled_up(flat, 40., 0.), "rolled up", 2e-2); // chords for arcs
}

// A cap of the unit sphere, up to `angle` from its pole. The map is the stereographic projection
// r = 2 tan(theta / 2), scaled such that the border keeps its length 2 pi sin(angle); so at the
// pole, where the projection has scale 1, the scale is sin(angle) / (2 tan(angle / 2)).
TEST(Border_first_map, of_a_spherical_cap_is_the_stereographic_projection)
{
  for(const double angle : {0.5, 1.0, 1.5}) {
    const Indexed_triangle_mesh cap = on_sphere(round_disk(24), angle);
    const SMP::Border_first_map map = SMP::border_first_map(cap);
    ASSERT_EQ(map.error, "");
    const auto [least, largest] = length_ratios(cap, map.uv, true);
    EXPECT_NEAR(largest / least, 1., 1e-3) << angle;
    const double expected = largest * std::sin(angle) / (2. * std::tan(0.5 * angle));
    double at_pole = 0.;
    for(const auto& t : cap.triangles)
      for(int c = 0; c < 3; ++c)
        if(t[c] == 0) // the centre of the disk
          at_pole = length(map.uv, t[c], t[(c + 1) % 3]) / length(cap, t[c], t[(c + 1) % 3]);
    EXPECT_NEAR(at_pole, expected, 5e-3 * expected) << angle;
  }
}

TEST(Border_first_map, does_not_depend_on_the_unit_of_length)
{
  const Indexed_triangle_mesh chart = with_hills(irregular_grid(20, 20, 3), 3., 5);
  const Uv uv = SMP::border_first_map(chart).uv;
  ASSERT_FALSE(uv.empty());
  for(const double factor : {1e-6, 1e6}) {
    const Uv other = SMP::border_first_map(scaled(chart, factor)).uv;
    ASSERT_EQ(other.size(), uv.size());
    const double scale = length(other, 0, 399) / length(uv, 0, 399);
    for(const auto& t : chart.triangles)
      for(int c = 0; c < 3; ++c)
        EXPECT_NEAR(length(other, t[c], t[(c + 1) % 3]) / scale, length(uv, t[c], t[(c + 1) % 3]),
                    1e-6);
  }
}

// A cone with the angle 2 pi + `excess` at its apex, cut open from the apex (vertex 0) to the
// border along a ray of vertices that are there twice. It is flat: laid out without changing any
// length it overlaps itself in a sector of angle `excess`.
Indexed_triangle_mesh slit_saddle(double excess, Vertex_index rings, Vertex_index sectors)
{
  // The cone z = a r cos(2 phi) has the angle that the length of the curve in which it meets the
  // unit sphere says; a by bisection.
  const auto direction = [](double a, double phi) {
    const double z = a * std::cos(2. * phi), norm = std::sqrt(1. + z * z);
    return Point_3(std::cos(phi) / norm, std::sin(phi) / norm, z / norm);
  };
  const auto angle = [&](double a) {
    double sum = 0.;
    for(Vertex_index i = 0; i < sectors; ++i) {
      const double step = 2. * CGAL_PI / sectors;
      sum += 2. * std::asin(0.5 * std::sqrt(squared_distance(direction(a, step * i),
                                                            direction(a, step * (i + 1)))));
    }
    return sum;
  };
  double low = 0., high = 10.;
  for(int i = 0; i < 60; ++i)
    (angle(0.5 * (low + high)) < 2. * CGAL_PI + excess ? low : high) = 0.5 * (low + high);
  Indexed_triangle_mesh mesh;
  mesh.points.push_back(Point_3(0., 0., 0.));
  for(Vertex_index r = 1; r <= rings; ++r)
    for(Vertex_index i = 0; i <= sectors; ++i)
      mesh.points.push_back(CGAL::ORIGIN
                            + double(r) * (direction(low, 2. * CGAL_PI * i / sectors)
                                           - CGAL::ORIGIN));
  const auto vertex = [&](Vertex_index r, Vertex_index i) {
    return r == 0 ? 0 : 1 + (r - 1) * (sectors + 1) + i;
  };
  for(Vertex_index r = 0; r < rings; ++r)
    for(Vertex_index i = 0; i < sectors; ++i) {
      if(r > 0)
        mesh.triangles.push_back({vertex(r, i), vertex(r + 1, i + 1), vertex(r, i + 1)});
      mesh.triangles.push_back({vertex(r, i), vertex(r + 1, i), vertex(r + 1, i + 1)});
    }
  return mesh;
}

TEST(Border_first_map, opens_seams_that_end_in_saddles)
{
  for(const double excess : {0.01, 0.1, 0.3})
    for(const Vertex_index rings : {6u, 20u, 60u}) {
      const Indexed_triangle_mesh chart = slit_saddle(excess, rings, 40);
      const SMP::Border_first_map map = SMP::border_first_map(chart);
      ASSERT_EQ(map.error, "");
      const auto border = CGAL::Indexed_mesh::border_edges(chart.triangles);
      EXPECT_TRUE(SMP::is_simple_border(border, map.uv))
        << excess << ' ' << rings;
      const SMT::Chart_distortion distortion = SMT::measure_chart_distortion(chart, map.uv);
      EXPECT_EQ(distortion.flipped_faces, 0u) << excess << ' ' << rings;
      EXPECT_LT(distortion.quasi_conformal, 1.3) << excess << ' ' << rings;
      EXPECT_LT(distortion.area_scale, 4.) << excess << ' ' << rings;
    }
}

// What is far from the tip keeps its lengths.
TEST(Border_first_map, opens_seams_near_their_tips_only)
{
  constexpr Vertex_index rings = 30, sectors = 120;
  const Indexed_triangle_mesh chart = slit_saddle(0.02, rings, sectors);
  const SMP::Border_first_map map = SMP::border_first_map(chart);
  ASSERT_EQ(map.error, "");
  const Vertex_index first = 1 + (rings - 1) * (sectors + 1);
  const auto ratio = [&](Vertex_index v) {
    return length(map.uv, v, v + 1) / length(chart, v, v + 1);
  };
  for(Vertex_index i = 0; i < sectors; ++i)
    EXPECT_NEAR(ratio(first + i) / ratio(first + sectors / 2), 1., 0.05) << i;
}

TEST(Border_first_map, refuses_what_is_no_disk)
{
  Indexed_triangle_mesh bad = grid(4, 4);
  bad.points[5] = Point_3(std::nan(""), 0., 0.);
  for(const Indexed_triangle_mesh& mesh : {bad, sphere(1), cylinder(8, 4), Indexed_triangle_mesh()}) {
    const SMP::Border_first_map map = SMP::border_first_map(mesh);
    EXPECT_NE(map.error, "");
    EXPECT_EQ(map.status, CGAL::Indexed_mesh::Mesh_status::BAD_MESH);
    EXPECT_TRUE(map.uv.empty());
  }
}

TEST(Crossing_edges, are_those_of_all_pairs)
{
  Random random(20261122);
  for(int trial = 0; trial < 50; ++trial) {
    Uv points;
    for(int i = 0; i < 30; ++i)
      points.emplace_back(uniform(random, 0., 1.), uniform(random, 0., trial % 2 == 0 ? 1. : 0.1));
    typedef std::array<std::uint32_t, 2> Edge;
    std::vector<Edge> edges;
    for(std::uint32_t i = 0; i < 30; ++i)
      edges.push_back({i, (i + 1) % 30});
    std::vector<std::array<Edge, 2>> found, expected;
    SMP::visit_crossing_edges(edges, points, [&](const Edge& e, const Edge& f) {
      found.push_back({(std::min)(e, f), (std::max)(e, f)});
      return true;
    });
    for(std::size_t i = 0; i < 30; ++i)
      for(std::size_t j = i + 2; j < (i == 0 ? 29u : 30u); ++j)
        if(SMP::rounded_segments_meet(points[edges[i][0]], points[edges[i][1]],
                                                points[edges[j][0]], points[edges[j][1]]))
          expected.push_back({(std::min)(edges[i], edges[j]), (std::max)(edges[i], edges[j])});
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected) << trial;
  }
}

} // namespace border_first_map_test
