// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Soups of polygons and the surfaces that they are meant to be.

#include <support/mesh_generators.h>
#include <support/polygon_soups.h>
#include <support/soup_properties.h>

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/surface_of_soup.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace soup_test {

using namespace test_support;
using CGAL::Indexed_mesh::Halfedge;
using CGAL::Indexed_mesh::Soup_diagnosis;
using CGAL::Indexed_mesh::Soup_repairs;
using CGAL::Indexed_mesh::Surface_of_soup;
using CGAL::Indexed_mesh::Triangle_adjacency;
using CGAL::Indexed_mesh::copy_soup;
using CGAL::Indexed_mesh::cut_faces;
using CGAL::Indexed_mesh::diagnose_soup;
using CGAL::Indexed_mesh::manifold_error;
using CGAL::Indexed_mesh::next_halfedge;
using CGAL::Indexed_mesh::no_halfedge;
using CGAL::Indexed_mesh::no_vertex;
using CGAL::Indexed_mesh::surface_of_soup;
using CGAL::Indexed_mesh::triangle_of;
using CGAL::Indexed_mesh::uv_corners_of_soup;
using CGAL::Indexed_mesh::vertex_of;

// --- Properties

bool has_repairs(const Soup_repairs& r)
{
  return !r.sentences().empty();
}

// The sets of vertices of the soup that triangles of the first faces join.
std::multiset<std::set<Vertex_index>> triangle_sets(const Surface_of_soup& s, std::size_t faces)
{
  std::multiset<std::set<Vertex_index>> result;
  for(std::size_t t = 0; t < s.face.size() && s.face[t] < faces; ++t) {
    const auto& v = s.mesh.triangles[t];
    result.insert({s.vertex[v[0]], s.vertex[v[1]], s.vertex[v[2]]});
  }
  return result;
}

// Pairs of triangles of the first faces that are joined, by the vertices of their edge.
std::multiset<std::set<Vertex_index>> joints(const Surface_of_soup& s, std::size_t faces)
{
  std::multiset<std::set<Vertex_index>> result;
  const Triangle_adjacency adjacency(s.mesh.triangles);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const Halfedge o = adjacency.opposite(h);
    if(o != no_halfedge && o > h && s.face[triangle_of(h)] < faces && s.face[triangle_of(o)] < faces)
      result.insert({s.vertex[vertex_of(s.mesh.triangles, h)],
                     s.vertex[vertex_of(s.mesh.triangles, next_halfedge(h))]});
  }
  return result;
}

// --- Tests

TEST(Soup, clean_surfaces_stay_as_they_are)
{
  for(const Named_mesh& named : generated_meshes(7)) {
    SCOPED_TRACE(named.name);
    const Polygon_soup soup = to_soup(named.mesh);
    const Surface_of_soup s = surface_of_soup(soup);
    ASSERT_TRUE(s.is_ok()) << s.error;
    EXPECT_FALSE(has_repairs(s.repairs));
    EXPECT_EQ(s.mesh.points, named.mesh.points);
    EXPECT_EQ(s.mesh.triangles, named.mesh.triangles);
    EXPECT_TRUE(diagnose_soup(soup).is_surface());
    const Surface_of_soup copy = surface_of_soup(soup, diagnose_soup(soup));
    EXPECT_EQ(surface_of_soup_error(soup, copy), "");
    EXPECT_EQ(copy.mesh.points, s.mesh.points);
    EXPECT_EQ(copy.mesh.triangles, s.mesh.triangles);
    EXPECT_EQ(copy.corners, s.corners);
    EXPECT_EQ(copy.vertex, s.vertex);
    EXPECT_EQ(copy.face, s.face);
    EXPECT_EQ(copy.diagonals, s.diagonals);
  }
}

TEST(Soup, any_soup_becomes_an_oriented_manifold)
{
  for(std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polygon_soup soup = any_soup(random);
    const Surface_of_soup s = surface_of_soup(soup);
    ASSERT_TRUE(s.is_ok()) << s.error;
    ASSERT_EQ(surface_of_soup_error(soup, s), "");
    ASSERT_EQ(second_repair_error(s), "");
    ASSERT_EQ(surface_of_soup(soup, diagnose_soup(soup)).mesh.triangles, s.mesh.triangles);
  }
}

TEST(Soup, what_is_added_to_a_surface_does_not_cut_it)
{
  for(std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Polygon_soup soup = random() % 2 == 0 ? to_soup(irregular_grid(6, 5, seed)) : quadrangles(6, 0.05);
    const Surface_of_soup clean = surface_of_soup(soup);
    const std::size_t faces = soup.number_of_faces();
    add_fins(soup, random, 1 + random() % 3);
    add_flags(soup, random, 1 + random() % 3);
    duplicate_faces(soup, random, 1 + random() % 3);
    turn_faces(soup, random, 4);
    repeat_corners(soup, random, 5);
    add_collapsed_faces(soup, random, 3);
    add_isolated_points(soup, random, 2);
    const Surface_of_soup s = surface_of_soup(soup);
    ASSERT_TRUE(s.is_ok()) << s.error;
    EXPECT_EQ(triangle_sets(s, faces), triangle_sets(clean, faces));
    EXPECT_EQ(joints(s, faces), joints(clean, faces));
    EXPECT_TRUE(s.repairs.duplicate && s.repairs.collapsed && s.repairs.isolated
                && s.repairs.split && s.repairs.turned);
  }
}

TEST(Soup, few_faces_are_turned)
{
  for(const std::size_t one_in : {2, 3, 20}) {
    Random random(one_in);
    Polygon_soup soup = to_soup(irregular_grid(20, 20, 3));
    const Polygon_soup clean = soup;
    turn_faces(soup, random, one_in);
    std::size_t turned = 0;
    for(std::size_t f = 0; f < soup.number_of_faces(); ++f)
      turned += !std::equal(soup.face(f).begin(), soup.face(f).end(), clean.face(f).begin());
    const Surface_of_soup s = surface_of_soup(soup);
    EXPECT_EQ(s.repairs.turned.count, (std::min)(turned, soup.number_of_faces() - turned));
  }
}

TEST(Soup, one_sided_surfaces_are_cut_open)
{
  for(int half_turns = 0; half_turns < 5; ++half_turns) {
    SCOPED_TRACE(half_turns);
    const Polygon_soup soup = twisted_band(12, half_turns);
    const Surface_of_soup s = surface_of_soup(soup);
    EXPECT_EQ(surface_of_soup_error(soup, s), "");
    EXPECT_EQ(s.repairs.cut.count, half_turns % 2 == 0 ? 0u : 1u);
    EXPECT_EQ(s.repairs.split.count, half_turns % 2 == 0 ? 0u : 2u);
  }
  const Polygon_soup bottle = klein_bottle(12, 10);
  const Surface_of_soup s = surface_of_soup(bottle);
  EXPECT_EQ(surface_of_soup_error(bottle, s), "");
  EXPECT_GE(s.repairs.cut.count, 10u);
  EXPECT_LE(s.repairs.cut.count, 24u);
  for(std::size_t t = 0; t < s.diagonals.size(); ++t)
    EXPECT_NE(s.diagonals[t], 0) << "a diagonal was cut";
}

TEST(Soup, faces_that_continue_each_other_stay_joined)
{
  Polygon_soup soup = quadrangles(6, 0.); // a wall along the row of vertices 21 to 27
  const std::size_t faces = soup.number_of_faces();
  const Surface_of_soup clean = surface_of_soup(soup);
  Vertex_index above = add_point(soup, 0., 3., 1.);
  for(Vertex_index i = 0; i < 6; ++i) {
    const Vertex_index next = add_point(soup, i + 1., 3., 1.);
    add_face(soup, {21 + i, 22 + i, next, above});
    above = next;
  }
  const Surface_of_soup s = surface_of_soup(soup);
  EXPECT_EQ(s.repairs.separated.count, 6u);
  EXPECT_EQ(joints(s, faces), joints(clean, faces));
  EXPECT_EQ(s.mesh.points.size(), 49u + 14u);
}

TEST(Soup, cubes_that_touch_along_an_edge_come_apart)
{
  const auto cube = [](double x, double y) {
    Polygon_soup soup;
    for(unsigned int i = 0; i < 8; ++i)
      add_point(soup, x + (i & 1), y + (i >> 1 & 1), i >> 2);
    add_face(soup, {0, 2, 3, 1});
    add_face(soup, {4, 5, 7, 6});
    add_face(soup, {0, 1, 5, 4});
    add_face(soup, {2, 6, 7, 3});
    add_face(soup, {0, 4, 6, 2});
    add_face(soup, {1, 3, 7, 5});
    return soup;
  };
  Polygon_soup soup = cube(0., 0.);
  append(soup, cube(1., 1.), 0.);
  std::replace(soup.corners.begin(), soup.corners.end(), Vertex_index(8), Vertex_index(3));
  std::replace(soup.corners.begin(), soup.corners.end(), Vertex_index(12), Vertex_index(7));
  const Surface_of_soup s = surface_of_soup(soup);
  EXPECT_EQ(s.repairs.separated.count, 1u);
  EXPECT_EQ(s.repairs.split.count, 2u);
  EXPECT_FALSE(s.repairs.turned);
  EXPECT_TRUE(CGAL::Indexed_mesh::border_edges(s.mesh.triangles).empty());
  EXPECT_EQ(s.mesh.points.size(), 16u);
}

// --- Faces of more than three corners

double area_of(const Surface_of_soup& s)
{
  double area = 0.;
  for(const auto& t : s.mesh.triangles) {
    const auto &p = s.mesh.points[t[0]], &q = s.mesh.points[t[1]], &r = s.mesh.points[t[2]];
    area += 0.5 * ((q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()));
    EXPECT_GE((q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()), 0.);
  }
  return area;
}

double area_of_rim(const Polygon_soup& soup)
{
  double area = 0.;
  for(std::size_t i = 0; i < soup.corners.size(); ++i) {
    const auto &p = soup.points[soup.corners[i]],
               &q = soup.points[soup.corners[(i + 1) % soup.corners.size()]];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return area;
}

// A star-shaped polygon with random radii.
Polygon_soup random_star(std::size_t n, std::uint64_t seed)
{
  Random random(seed);
  Polygon_soup soup;
  for(std::size_t i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * double(i) / double(n), r = uniform(random, 0.2, 1.);
    soup.corners.push_back(add_point(soup, r * std::cos(a), r * std::sin(a), 0.));
  }
  soup.close_face();
  return soup;
}

TEST(Soup, concave_polygons_are_cut_within)
{
  for(std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::size_t n = 4 + seed % 60;
    const Polygon_soup soup = random_star(n, seed);
    const Surface_of_soup s = surface_of_soup(soup);
    EXPECT_EQ(s.mesh.triangles.size(), n - 2);
    EXPECT_NEAR(area_of(s), area_of_rim(soup), 1e-12);
    EXPECT_EQ(surface_of_soup_error(soup, s), "");
    EXPECT_FALSE(s.repairs.turned);
  }
}

TEST(Soup, a_spiral_of_many_corners_is_cut_within)
{
  Polygon_soup soup; // out along a spiral and back
  const std::size_t n = 20000;
  for(std::size_t i = 0; i < 2 * n; ++i) {
    const double k = double(i < n ? i : 2 * n - 1 - i), a = 40. * k / double(n);
    const double r = (i < n ? 1. : 0.95) * (1. + a);
    soup.corners.push_back(add_point(soup, r * std::cos(a), r * std::sin(a), 0.));
  }
  std::reverse(soup.corners.begin(), soup.corners.end());
  soup.close_face();
  const double area = area_of_rim(soup);
  if(area < 0.)
    std::reverse(soup.corners.begin(), soup.corners.end());
  const Surface_of_soup s = surface_of_soup(soup);
  EXPECT_EQ(s.mesh.triangles.size(), 2 * n - 2);
  EXPECT_NEAR(area_of(s), std::abs(area), 1e-9 * std::abs(area));
}

TEST(Soup, a_face_may_have_a_hole)
{
  Polygon_soup soup;
  for(const double r : {3., 1.})
    for(const auto& p : {std::array<double, 2>{-r, -r}, {r, -r}, {r, r}, {-r, r}})
      add_point(soup, p[0], p[1], 0.);
  add_face(soup, {0, 1, 2, 3, 0, 4, 7, 6, 5, 4});
  const Surface_of_soup s = surface_of_soup(soup);
  EXPECT_EQ(surface_of_soup_error(soup, s), "");
  EXPECT_DOUBLE_EQ(area_of(s), 32.);
  EXPECT_EQ(s.mesh.triangles.size(), 8u);
  EXPECT_EQ(CGAL::Indexed_mesh::border_edges(s.mesh.triangles).size(), 8u);
  EXPECT_EQ(s.mesh.points.size(), 8u);
}

TEST(Soup, the_better_diagonal_of_a_quadrangle_is_taken)
{
  for(const int shift : {0, 1, 2, 3}) { // concave at vertex 0, and a thin convex one
    Polygon_soup dart, kite;
    for(const auto& p : {std::array<double, 2>{0.1, 0.}, {-1., -1.}, {1., 0.}, {-1., 1.}})
      add_point(dart, p[0], p[1], 0.);
    for(const auto& p : {std::array<double, 2>{-3., 0.}, {0., -1.}, {3., 0.}, {0., 1.}})
      add_point(kite, p[0], p[1], 0.);
    for(unsigned int i = 0; i < 4; ++i) {
      dart.corners.push_back((i + unsigned(shift)) % 4);
      kite.corners.push_back((i + unsigned(shift)) % 4);
    }
    dart.close_face();
    kite.close_face();
    const auto of_dart = triangle_sets(surface_of_soup(dart), 1);
    const auto of_kite = triangle_sets(surface_of_soup(kite), 1);
    EXPECT_EQ(of_dart.count({0, 1, 2}), 1u);
    EXPECT_EQ(of_kite.count({0, 1, 3}), 1u);
  }
}

// --- The way back

TEST(Soup, every_corner_gets_a_texture_coordinate)
{
  for(std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polygon_soup soup = any_soup(random);
    const Surface_of_soup s = surface_of_soup(soup);
    const auto uv = uv_corners_of_soup(soup, s, s.mesh.triangles); // one for each vertex
    ASSERT_EQ(uv.size(), soup.corners.size());
    const auto is_in_surface = [&](std::size_t c) {
      return std::binary_search(s.vertex.begin(), s.vertex.end(), soup.corners[c]);
    };
    for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
      bool has_any = false;
      for(std::size_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c)
        has_any = has_any || is_in_surface(c);
      for(std::size_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c) {
        ASSERT_EQ(uv[c] != no_vertex, has_any); // all corners of a face or none
        if(is_in_surface(c)) {
          ASSERT_EQ(s.vertex[uv[c]], soup.corners[c]);
        }
      }
    }
    EXPECT_LE(cut_faces(soup, s, s.mesh.triangles).size(), soup.number_of_faces());
  }
}

TEST(Soup, faces_with_a_seam_along_a_diagonal_are_found)
{
  const Polygon_soup soup = quadrangles(3);
  const Surface_of_soup s = surface_of_soup(soup);
  auto wedges = s.mesh.triangles;
  EXPECT_TRUE(cut_faces(soup, s, wedges).empty());
  for(auto& corner : wedges[9]) // the second triangle of face 4
    corner += 100;
  EXPECT_EQ(cut_faces(soup, s, wedges), std::vector<std::uint32_t>{4});
}

TEST(Soup, a_mesh_of_any_type_can_be_copied)
{
  typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Mesh;
  Mesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}),
             c = mesh.add_vertex({1, 1, 0}), d = mesh.add_vertex({0, 1, 0}),
             e = mesh.add_vertex({2, 0, 1});
  mesh.add_face(a, b, c, d);
  mesh.add_face(b, e, c);
  const Polygon_soup soup = copy_soup(mesh);
  EXPECT_EQ(soup.number_of_faces(), 2u);
  EXPECT_EQ(soup.face(0).size(), 4u);
  EXPECT_EQ(surface_of_soup(soup).mesh.triangles.size(), 3u);
}

// --- What is no surface

TEST(Soup, what_has_no_surface_is_refused)
{
  Polygon_soup soup;
  EXPECT_EQ(surface_of_soup(soup).error, "no face has three different vertices");
  add_point(soup, 0., 0., 0.);
  add_face(soup, {0, 0, 0});
  EXPECT_EQ(surface_of_soup(soup).error, "no face has three different vertices");
  add_face(soup, {0, 1, 2});
  EXPECT_EQ(surface_of_soup(soup).error, "face 1 has a vertex that does not exist");
  soup.corners = {0, 0, 0};
  EXPECT_EQ(surface_of_soup(soup).error, "the faces do not follow one after the other");
  soup = quadrangles(1);
  soup.points[3] = Point_3(0., std::numeric_limits<double>::infinity(), 0.);
  EXPECT_EQ(surface_of_soup(soup).error, "vertex 3 has a coordinate that is not a finite number");
}

TEST(Soup, sentences_say_what_was_done)
{
  Polygon_soup soup = quadrangles(2);
  duplicate_faces(soup, *std::make_unique<Random>(1), 1);
  add_point(soup, 9., 9., 9.);
  const auto sentences = surface_of_soup(soup).repairs.sentences();
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_EQ(sentences[0], "4 faces have more than three corners: they are cut into triangles for "
                          "the computation (0 and others)");
  EXPECT_EQ(sentences[1], "1 face has the same vertices as another one: it is left out (4)");
  EXPECT_EQ(sentences[2], "1 vertex is in no face: it is left out (9)");
}

} // namespace soup_test
