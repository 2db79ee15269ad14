// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Maps of whole surfaces, whatever they are.

#include <support/mesh_generators.h>
#include <support/polygon_soups.h>

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace map_surface_test {

using namespace test_support;
using CGAL::Indexed_mesh::Surface_of_soup;
using CGAL::Indexed_mesh::cut_faces;
using CGAL::Indexed_mesh::surface_of_soup;
using CGAL::Surface_mesh_texturing::Chart_topology;
using CGAL::Surface_mesh_texturing::Surface_map;
using CGAL::Surface_mesh_texturing::Surface_map_options;
using CGAL::Surface_mesh_texturing::chart_topologies;
using CGAL::Surface_mesh_texturing::map_surface;
using CGAL::Surface_mesh_parameterization::conformal_map;
using CGAL::Surface_mesh_parameterization::measure_distortion;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

// What is wrong with a map of a mesh.
std::string map_error(const Indexed_triangle_mesh& mesh, const Surface_map& map)
{
  if(!map.is_ok())
    return map.error;
  if(map.mesh.points != mesh.points || map.mesh.triangles != mesh.triangles)
    return "the mesh has changed";
  if(!texture_error(map.mesh).empty())
    return texture_error(map.mesh);
  for(const Chart_topology& topology : chart_topologies(mesh.triangles, map.charts))
    if(topology.borders == 0 || topology.genus() != 0)
      return "a component is closed, or has a handle";
  return {};
}

CGAL::Bbox_2 box_of(const Surface_map& map, std::uint32_t component)
{
  CGAL::Bbox_2 box;
  for(std::size_t t = 0; t < map.mesh.triangles.size(); ++t)
    for(const auto w : map.mesh.wedges[t])
      if(map.charts.chart[t] == component)
        box += map.mesh.uv[w].bbox();
  return box;
}

// Area of a component in the map to that on the surface.
double density_of(const Surface_map& map, std::uint32_t component)
{
  double flat = 0., curved = 0.;
  for(std::size_t t = 0; t < map.mesh.triangles.size(); ++t) {
    if(map.charts.chart[t] != component)
      continue;
    const auto& w = map.mesh.wedges[t];
    const auto& v = map.mesh.triangles[t];
    const auto &a = map.mesh.uv[w[0]], &b = map.mesh.uv[w[1]], &c = map.mesh.uv[w[2]];
    flat += std::abs((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
    const auto &p = map.mesh.points[v[0]], &q = map.mesh.points[v[1]], &r = map.mesh.points[v[2]];
    curved += std::sqrt(CGAL::cross_product(q - p, r - p).squared_length());
  }
  return flat / curved;
}

TEST(Map_surface, a_chart_is_mapped_as_it_is)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(20, 15, 3), 2., 4);
  const Surface_map map = map_surface(mesh);
  ASSERT_EQ(map_error(mesh, map), "");
  EXPECT_EQ(map.mesh.uv, conformal_map(mesh).uv);
  EXPECT_EQ(map.mesh.wedges, mesh.triangles);
  ASSERT_EQ(map.components.size(), 1u);
  EXPECT_FALSE(map.components[0].is_cut);
}

TEST(Map_surface, closed_surfaces_and_handles_are_cut)
{
  for(const auto& [name, mesh, genus] :
      {std::make_tuple("sphere", sphere(3), 0u), std::make_tuple("torus", torus(24, 12), 1u),
       std::make_tuple("torus with holes", with_holes(torus(24, 12), 3, 5), 1u)})
  {
    SCOPED_TRACE(name);
    const Surface_map map = map_surface(mesh);
    ASSERT_EQ(map_error(mesh, map), "");
    ASSERT_EQ(map.components.size(), 1u);
    EXPECT_TRUE(map.components[0].is_cut);
    EXPECT_EQ(map.components[0].genus, genus);
    EXPECT_GT(map.mesh.uv.size(), mesh.points.size());
    const auto measures = measure_distortion(map.mesh);
    EXPECT_EQ(measures.flipped_faces, 0u);
    EXPECT_LT(measures.quasi_conformal_mean, 1.3);
  }
}

// A torus, with a limb that is pulled out of it.
Indexed_triangle_mesh torus_with_limb(Vertex_index n, Vertex_index m, double length)
{
  constexpr double radius = 0.35;
  Indexed_triangle_mesh mesh = torus(n, m);
  for(Point_3& p : mesh.points) {
    const double r = std::hypot(p.y(), p.z()); // from the x axis
    if(p.x() > 1. && r < radius)
      p = Point_3(p.x() + length * (1. - r / radius), p.y(), p.z());
  }
  return mesh;
}

double length_of_seams(const Surface_map& map)
{
  double sum = 0.;
  for(std::size_t t = 0; t < map.mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(map.charts.is_seam(t, c))
        sum += std::sqrt(squared_distance(map.mesh.points[map.mesh.triangles[t][c]],
                                          map.mesh.points[map.mesh.triangles[t][(c + 1) % 3]]));
  return sum / 2.;
}

// What two loops cut well needs no more; limbs do.
TEST(Map_surface, handles_are_cut_to_extremities_only_where_that_helps)
{
  Surface_map_options always;
  always.least_gain = 0.;
  Surface_map_options never;
  never.cut.extremities = 0;
  for(const Vertex_index n : {60, 290}) { // the latter has more than 80,000 triangles
    SCOPED_TRACE(n);
    const Indexed_triangle_mesh mesh = torus_with_limb(n, n / 2, 0.);
    const Surface_map map = map_surface(mesh), with = map_surface(mesh, always);
    ASSERT_EQ(map_error(mesh, map), "");
    ASSERT_EQ(map_error(mesh, with), "");
    EXPECT_LT(length_of_seams(map), 0.6 * length_of_seams(with));
    EXPECT_LT(measure_distortion(map.mesh).stretch_L2, 1.25);
  }
  const Indexed_triangle_mesh mesh = torus_with_limb(60, 30, 3.);
  const Surface_map map = map_surface(mesh);
  ASSERT_EQ(map_error(mesh, map), "");
  EXPECT_EQ(map.mesh.uv, map_surface(mesh, always).mesh.uv);
  EXPECT_GT(measure_distortion(map_surface(mesh, never).mesh).stretch_L2,
            1.25 * measure_distortion(map.mesh).stretch_L2);
}

// On a coarser mesh first; faces of four corners stay whole.
TEST(Map_surface, a_large_closed_surface_is_cut)
{
  Polygon_soup soup; // a torus of 45,000 quadrangles
  const Vertex_index n = 300, m = 150;
  for(Vertex_index i = 0; i < n; ++i)
    for(Vertex_index j = 0; j < m; ++j) {
      const double a = 6.283185307179586 * i / n, b = 6.283185307179586 * j / m;
      const double r = 1. + 0.1 * std::sin(7. * a) * std::cos(5. * b);
      add_point(soup, (3. + r * std::cos(b)) * std::cos(a), (3. + r * std::cos(b)) * std::sin(a),
                r * std::sin(b));
      const Vertex_index i1 = (i + 1) % n, j1 = (j + 1) % m;
      add_face(soup, {i * m + j, i1 * m + j, i1 * m + j1, i * m + j1});
    }
  const Surface_of_soup surface = surface_of_soup(soup);
  Surface_map_options options;
  options.no_seams = surface.diagonals;
  const Surface_map map = map_surface(surface.mesh, options);
  ASSERT_EQ(map_error(surface.mesh, map), "");
  EXPECT_TRUE(map.components[0].is_cut);
  EXPECT_TRUE(cut_faces(soup, surface, map.mesh.wedges).empty());
  EXPECT_EQ(measure_distortion(map.mesh).flipped_faces, 0u);
}

TEST(Map_surface, components_lie_side_by_side_at_equal_density)
{
  Polygon_soup soup = to_soup(with_hills(irregular_grid(12, 9, 3), 2., 4));
  append(soup, to_soup(sphere(2)), 30.);
  append(soup, to_soup(scaled(grid(3, 5), 0.1)), 60.);
  append(soup, to_soup(torus(12, 8)), 90.);
  const Surface_of_soup surface = surface_of_soup(soup);
  const Surface_map map = map_surface(surface.mesh);
  ASSERT_EQ(map_error(surface.mesh, map), "");
  ASSERT_EQ(map.components.size(), 4u);
  for(std::uint32_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(density_of(map, a), 1., 1e-9);
    for(std::uint32_t b = 0; b < a; ++b)
      EXPECT_FALSE(CGAL::do_overlap(box_of(map, a), box_of(map, b)));
  }
}

TEST(Map_surface, pins_stay_and_the_others_lie_beside)
{
  Polygon_soup soup = to_soup(grid(4, 4));
  append(soup, to_soup(grid(2, 3)), 30.);
  append(soup, to_soup(sphere(1)), 60.);
  const Surface_of_soup surface = surface_of_soup(soup);
  Surface_map_options options;
  options.pins = {{0, 5., 5.}, {4, 13., 5.}}; // twice the size
  const Surface_map map = map_surface(surface.mesh, options);
  ASSERT_EQ(map_error(surface.mesh, map), "");
  EXPECT_NEAR(box_of(map, 0).xmin(), 5., 1e-9);
  EXPECT_NEAR(box_of(map, 0).ymax(), 13., 1e-9);
  EXPECT_GT(box_of(map, 1).xmin(), 13.);
  EXPECT_GT(box_of(map, 2).xmin(), 13.);
  EXPECT_NEAR(density_of(map, 1), 4., 1e-9);
  EXPECT_EQ(map.components[0].report.pins.size(), 2u);
  options.pins = {{0, 5., 5.}, {1000, 13., 5.}};
  EXPECT_EQ(map_surface(surface.mesh, options).error,
            "there is no vertex 1000 that could be pinned");
}

// What is added to a surface, and mended, does not change its map.
TEST(Map_surface, a_mesh_that_was_mended_has_the_map_of_the_clean_one)
{
  for(std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Indexed_triangle_mesh clean = with_hills(irregular_grid(12, 10, seed), 2., seed);
    const auto expected = conformal_map(clean);
    const double expected_density = [&] {
      Surface_map map;
      map.mesh = {clean.points, clean.triangles, expected.uv, clean.triangles};
      map.charts.chart.assign(clean.triangles.size(), 0);
      return density_of(map, 0);
    }();
    Polygon_soup soup = to_soup(clean);
    add_fins(soup, random, 3);
    add_flags(soup, random, 3);
    duplicate_faces(soup, random, 3);
    turn_faces(soup, random, 4);
    repeat_corners(soup, random, 5);
    add_collapsed_faces(soup, random, 3);
    add_isolated_points(soup, random, 2);
    const Surface_of_soup surface = surface_of_soup(soup);
    const Surface_map map = map_surface(surface.mesh);
    ASSERT_EQ(map_error(surface.mesh, map), "");
    const auto largest = std::max_element(
      map.components.begin(), map.components.end(),
      [](const auto& a, const auto& b) { return a.faces < b.faces; });
    ASSERT_EQ(largest->faces, clean.triangles.size());
    EXPECT_NEAR(largest->report.energy, expected.report.energy / expected_density,
                1e-6 * expected.report.energy / expected_density);
  }
}

TEST(Map_surface, any_soup_gets_a_map)
{
  for(std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Surface_of_soup surface = surface_of_soup(any_soup(random));
    const Surface_map map = map_surface(surface.mesh);
    ASSERT_EQ(map_error(surface.mesh, map), "");
  }
}

TEST(Map_surface, components_without_extent_get_one_point)
{
  Polygon_soup soup = to_soup(grid(4, 4));
  for(int i = 0; i < 3; ++i)
    add_point(soup, 7., 7., 7.);
  add_face(soup, {25, 26, 27});
  const Surface_of_soup surface = surface_of_soup(soup);
  const Surface_map map = map_surface(surface.mesh);
  ASSERT_EQ(map_error(surface.mesh, map), "");
  ASSERT_EQ(map.components.size(), 2u);
  EXPECT_TRUE(map.components[0].is_mapped);
  EXPECT_FALSE(map.components[1].is_mapped);
  const auto& w = map.mesh.wedges.back();
  EXPECT_EQ(map.mesh.uv[w[0]], map.mesh.uv[w[1]]);
}

typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Mesh;

TEST(Map_surface, faces_of_four_corners_are_not_cut)
{
  // A torus of quadrangles
  const Vertex_index n = 18, m = 10;
  Mesh mesh;
  for(Vertex_index i = 0; i < n; ++i)
    for(Vertex_index j = 0; j < m; ++j) {
      const double a = 6.283185307179586 * i / n, b = 6.283185307179586 * j / m;
      mesh.add_vertex({(2. + std::cos(b)) * std::cos(a), (2. + std::cos(b)) * std::sin(a), std::sin(b)});
    }
  const auto at = [](Vertex_index i, Vertex_index j) {
    return Mesh::Vertex_index((i % n) * m + j % m);
  };
  for(Vertex_index i = 0; i < n; ++i)
    for(Vertex_index j = 0; j < m; ++j)
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv", Point_2(-9., -9.)).first;
  const Surface_map map = map_surface(mesh, uv);
  ASSERT_TRUE(map.is_ok()) << map.error;
  const Polygon_soup soup = CGAL::Indexed_mesh::copy_soup(mesh);
  EXPECT_TRUE(cut_faces(soup, surface_of_soup(soup), map.mesh.wedges).empty());
  for(const auto f : mesh.faces()) // convex and counterclockwise in the plane
    for(const auto h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh))
      EXPECT_EQ(CGAL::orientation(uv[h], uv[mesh.next(h)], uv[mesh.next(mesh.next(h))]),
                CGAL::LEFT_TURN);
}

TEST(Map_surface, what_is_wrong_is_said)
{
  const Indexed_triangle_mesh mesh = grid(2, 2);
  Surface_map_options options;
  options.no_seams.resize(3);
  EXPECT_FALSE(map_surface(mesh, options).is_ok());
  options = {};
  options.solver.progress = [](double) { return false; };
  options.solver.method = CGAL::Surface_mesh_parameterization::Conformal_method::HLSCM;
  EXPECT_EQ(map_surface(mesh, options).error, "cancelled");
}

} // namespace map_surface_test
