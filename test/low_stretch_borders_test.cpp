// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Low-stretch maps with prescribed borders, on a circle, a square or any polygon.

#include <support/chart_generators.h>
#include <support/low_stretch_checks.h>

#include <CGAL/Surface_mesh_parameterization/Low_stretch_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Polygonal_border_parameterizer_3.h>

#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/determinant.h>

#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace low_stretch_borders_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

constexpr std::uint64_t seed = 20261124;

typedef Surface_mesh::Vertex_index Vertex;
typedef CGAL::Kernel_traits<Surface_mesh::Point>::Kernel::Point_2 Mesh_point_2;

// The border stays where CGAL's parameterizer puts it, and no face is flipped.
template <class Border>
void map_with_border(const std::string& name, const Indexed_triangle_mesh& arrays, const Border& given = Border())
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  auto uv = mesh.add_property_map<Vertex, Mesh_point_2>("v:uv").first;
  auto border_uv = mesh.add_property_map<Vertex, Mesh_point_2>("v:border").first;
  auto index = mesh.add_property_map<Vertex, int>("v:index").first;
  auto is_set = mesh.add_property_map<Vertex, bool>("v:set", false).first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  Border own = given;
  ASSERT_EQ(own.parameterize(mesh, border, border_uv, index, is_set), OK) << name;
  Low_stretch_parameterizer_3<Surface_mesh, CGAL::Default, CGAL::Sequential_tag, Border>
    parameterizer(given);
  ASSERT_EQ(parameterizer.parameterize(mesh, border, uv), OK) << name << parameterizer.outcome().error;
  double area = 0.; // CGAL's squares run the wrong way round
  for(const auto h : halfedges_around_face(border, mesh))
    area += CGAL::determinant(border_uv[target(h, mesh)] - CGAL::ORIGIN,
                              border_uv[source(h, mesh)] - CGAL::ORIGIN);
  const double sign = area > 0. ? 1. : -1.;
  Uv result;
  for(const Vertex v : mesh.vertices()) {
    result.emplace_back(sign * uv[v].x(), uv[v].y());
    if(is_set[v]) {
      EXPECT_EQ(uv[v], border_uv[v]) << name << ", vertex " << v;
    }
  }
  EXPECT_EQ(error_in_orientation(arrays, result) + error_in_turns(arrays, result), "") << name;
  EXPECT_TRUE(parameterizer.report().converged) << name;
  EXPECT_GE(parameterizer.report().energy, 4.) << name;
  EXPECT_NEAR(parameterizer.report().area, CGAL::Polygon_mesh_processing::area(mesh),
              1e-6 * parameterizer.report().area) << name;
}

TEST(Low_stretch_border, stays_where_it_is_put)
{
  std::vector<Named_mesh> all = low_stretch_charts(seed);
  const Indexed_triangle_mesh jagged = with_jagged_border(irregular_grid(30, 24, seed), 0.5, seed);
  all.push_back({"jagged", with_hills(jagged, 5., seed)});
  all.push_back({"tall", moved(all[0].mesh, [](const Point_3& p) {
    return Point_3(p.x(), p.y(), 8. * p.z());
  })});
  all.push_back({"strip", with_noise(irregular_grid(90, 4, seed), 0.1, seed)});
  for(const Named_mesh& chart : all)
    map_with_border<Circular_border_arc_length_parameterizer_3<Surface_mesh>>(chart.name, chart.mesh);
  for(const Named_mesh& chart : {all[2], all[3]}) // no face has three corners on a side
    map_with_border<Square_border_arc_length_parameterizer_3<Surface_mesh>>(chart.name, chart.mesh);
}

typedef Polygonal_border_parameterizer_3<Surface_mesh> Polygonal_border;
typedef std::vector<Mesh_point_2> Corners;

// An L, and a star with five points.
std::vector<Corners> polygons()
{
  Corners star;
  for(int i = 0; i < 10; ++i) {
    const double angle = CGAL_PI * i / 5., radius = i % 2 == 0 ? 3. : 2.;
    star.emplace_back(7. + radius * std::cos(angle), radius * std::sin(angle));
  }
  return {{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, star};
}

// All corners are hit, on each side lengths are kept up to a factor, and the border runs the right way
// round, in whichever direction the corners are given.
TEST(Polygonal_border_parameterizer_3, goes_along_the_polygon)
{
  const Surface_mesh mesh
    = to_surface_mesh(with_hills(irregular_grid(24, 24, seed), 3., seed));
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  for(Corners corners : polygons())
    for(int direction = 0; direction < 2; ++direction) {
      std::map<Vertex, Mesh_point_2> uv;
      std::map<Vertex, bool> is_set;
      const Polygonal_border parameterizer(corners);
      EXPECT_FALSE(parameterizer.is_border_convex());
      ASSERT_EQ(parameterizer.parameterize(mesh, border, boost::make_assoc_property_map(uv), 0,
                                           boost::make_assoc_property_map(is_set)), OK);
      std::size_t hits = 0;
      double area = 0., perimeter = 0., length = 0.;
      std::map<std::size_t, std::vector<double>> factors; // of each side
      for(const auto h : halfedges_around_face(border, mesh)) {
        const Mesh_point_2 p = uv.at(source(h, mesh)), q = uv.at(target(h, mesh));
        EXPECT_TRUE(is_set.at(source(h, mesh)));
        hits += std::count(corners.begin(), corners.end(), p);
        area += CGAL::determinant(q - corners[0], p - corners[0]) / 2.;
        const double here = std::sqrt(squared_distance(p, q));
        perimeter += here;
        length += std::sqrt(squared_distance(mesh.point(source(h, mesh)), mesh.point(target(h, mesh))));
        std::size_t side = corners.size();
        for(std::size_t i = 0; i < corners.size(); ++i) {
          const CGAL::Segment_2<CGAL::Kernel_traits<Mesh_point_2>::Kernel> s(
            corners[i], corners[(i + 1) % corners.size()]);
          if(squared_distance(p, s) < 1e-20 && squared_distance(q, s) < 1e-20)
            side = i;
        }
        ASSERT_LT(side, corners.size());
        factors[side].push_back(
          here / std::sqrt(squared_distance(mesh.point(source(h, mesh)), mesh.point(target(h, mesh)))));
      }
      EXPECT_EQ(hits, corners.size());
      EXPECT_NEAR(area, std::abs(CGAL::Polygon_2<CGAL::Kernel_traits<Mesh_point_2>::Kernel>(
                          corners.begin(), corners.end()).area()), 1e-12 * area);
      EXPECT_EQ(factors.size(), corners.size());
      for(const auto& [side, of_side] : factors)
        for(const double factor : of_side) {
          EXPECT_NEAR(factor, of_side[0], 1e-9 * factor) << "side " << side;
          EXPECT_NEAR(factor, perimeter / length, 0.25 * perimeter / length) << "side " << side; // half an edge of four
        }
      std::reverse(corners.begin(), corners.end());
    }
}

TEST(Polygonal_border_parameterizer_3, is_a_border_of_low_stretch_maps)
{
  const Named_mesh chart = low_stretch_charts(seed)[2]; // no face has three corners on a side
  for(const Corners& corners : polygons())
    map_with_border(chart.name, chart.mesh, Polygonal_border(corners));
}

// To a convex polygon, by CGAL's mean values, no face is flipped either.
TEST(Polygonal_border_parameterizer_3, is_a_border_of_maps_of_cgal)
{
  const Named_mesh chart = low_stretch_charts(seed)[2];
  Surface_mesh mesh = to_surface_mesh(chart.mesh);
  auto uv = mesh.add_property_map<Vertex, Mesh_point_2>("v:uv").first;
  const Corners corners = {{0, 0}, {2, 0}, {3, 1}, {1, 3}, {0, 2}};
  Mean_value_coordinates_parameterizer_3<Surface_mesh, Polygonal_border> parameterizer(
    (Polygonal_border(corners)));
  ASSERT_EQ(CGAL::Surface_mesh_parameterization::parameterize(
              mesh, parameterizer, CGAL::Polygon_mesh_processing::longest_border(mesh).first, uv), OK);
  Uv result;
  for(const Vertex v : mesh.vertices())
    result.emplace_back(uv[v].x(), uv[v].y());
  EXPECT_EQ(error_in_orientation(chart.mesh, result), "");
  for(const Mesh_point_2& corner : corners)
    EXPECT_EQ(std::count(uv.begin(), uv.end(), corner), 1);
}

TEST(Polygonal_border_parameterizer_3, says_what_is_wrong)
{
  Surface_mesh mesh = to_surface_mesh(grid(2, 2)), closed = to_surface_mesh(sphere(1));
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  std::map<Vertex, Mesh_point_2> uv;
  std::map<Vertex, bool> is_set;
  const auto error = [&](const Corners& corners, const Surface_mesh& of, const auto h) {
    return Polygonal_border(corners).parameterize(of, h, boost::make_assoc_property_map(uv), 0,
                                                  boost::make_assoc_property_map(is_set));
  };
  const Corners square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(Polygonal_border(square).is_border_convex());
  for(const Corners& bad : {Corners(), Corners{{0, 0}, {1, 1}}, Corners{{0, 0}, {1, 1}, {1, 0}, {0, 1}},
                            Corners{{0, 0}, {1, 0}, {1, std::nan("")}}, Corners{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}) {
    EXPECT_EQ(error(bad, mesh, border), ERROR_WRONG_PARAMETER) << bad.size();
    EXPECT_FALSE(Polygonal_border(bad).is_border_convex());
  }
  EXPECT_EQ(error(square, mesh, Surface_mesh::null_halfedge()), ERROR_BORDER_TOO_SHORT);
  EXPECT_EQ(error(square, mesh, opposite(border, mesh)), ERROR_BORDER_TOO_SHORT);
  EXPECT_EQ(error(square, closed, *halfedges(closed).first), ERROR_BORDER_TOO_SHORT);
  EXPECT_EQ(error(polygons()[1], mesh, border), ERROR_BORDER_TOO_SHORT); // ten corners, eight vertices
  EXPECT_TRUE(uv.empty());
  for(auto& p : mesh.points())
    p = Surface_mesh::Point(1, 1, 1);
  EXPECT_EQ(error(square, mesh, border), ERROR_BORDER_TOO_SHORT);
}

// The border of a grid, counterclockwise.
std::vector<Vertex_index> border_of(const Indexed_triangle_mesh& mesh)
{
  const auto loops = CGAL::Indexed_mesh::border_loops(CGAL::Indexed_mesh::Vertex_rings(mesh));
  return loops.at(0);
}

// An L, of which the map is not convex.
TEST(Low_stretch_border, need_not_be_convex)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(24, 24, seed), 3., seed);
  Low_stretch_options options;
  for(const Vertex_index v : border_of(mesh)) {
    const Point_3& p = mesh.points[v];
    // The corner at (24, 24) goes in
    const double fold = 10. * std::max(0., (p.x() + p.y() - 24.) / 24.);
    options.pins.push_back({v, p.x() - fold, p.y() - fold});
  }
  const Low_stretch_map map = low_stretch_map(mesh, options);
  ASSERT_EQ(error_in_map(mesh, map), "");
  EXPECT_EQ(error_in_pins(options.pins, map.uv), "");
}

TEST(Low_stretch_border, without_a_map_is_named)
{
  const Indexed_triangle_mesh mesh = irregular_grid(16, 16, seed);
  const std::vector<Vertex_index> border = border_of(mesh);
  const auto error = [&](const auto& place) {
    Low_stretch_options options;
    for(std::size_t i = 0; i < border.size(); ++i) {
      const Point_2 p = place(2. * CGAL_PI * double(i) / double(border.size()));
      options.pins.push_back({border[i], p.x(), p.y()});
    }
    const Low_stretch_map map = low_stretch_map(mesh, options);
    EXPECT_TRUE(map.uv.empty());
    EXPECT_EQ(map.status, Mesh_status::FAILED);
    return map.error;
  };
  // The wrong way round, an eight, twice around
  const auto is_named = [&](double x_turns, double y_turns, const std::string& word) {
    return error([=](double a) {
      return Point_2(8. * std::cos(x_turns * a), 8. * std::sin(y_turns * a));
    }).find(word) != std::string::npos;
  };
  EXPECT_TRUE(is_named(1., -1., "border"));
  EXPECT_TRUE(is_named(1., 2., "turns over"));
  EXPECT_TRUE(is_named(2., 2., "turns over"));
}

} // namespace low_stretch_borders_test
