// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>

#include <support/mesh_generators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace indexed_mesh_test {

namespace IM = CGAL::Indexed_mesh;

typedef IM::Indexed_triangle_mesh Indexed_triangle_mesh;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;

TEST(Indexed_mesh, halfedges_go_around_their_triangle)
{
  const std::vector<IM::Triangle_indices> triangles = {{0, 1, 2}, {7, 5, 3}};
  for(IM::Halfedge h = 0; h < 6; ++h) {
    EXPECT_EQ(IM::triangle_of(IM::next_halfedge(h)), IM::triangle_of(h));
    EXPECT_EQ(IM::previous_halfedge(IM::next_halfedge(h)), h);
    EXPECT_EQ(IM::next_halfedge(IM::next_halfedge(IM::next_halfedge(h))), h);
    EXPECT_EQ(3 * IM::triangle_of(h) + IM::corner_of(h), h);
    EXPECT_EQ(IM::vertex_of(triangles, h), triangles[h / 3][h % 3]);
    const IM::Triangle_corner corner(h);
    EXPECT_EQ(3 * corner.triangle + corner.next, IM::next_halfedge(h));
    EXPECT_EQ(3 * corner.triangle + corner.last, IM::previous_halfedge(h));
  }
}

TEST(Indexed_mesh, disjoint_sets_are_known_by_their_smallest_members)
{
  constexpr std::uint32_t n = 200;
  std::mt19937 random(3);
  IM::Disjoint_sets sets(n);
  std::vector<std::uint32_t> smallest(n); // by relabelling everything
  for(std::uint32_t i = 0; i < n; ++i)
    smallest[i] = i;
  for(int step = 0; step < 150; ++step) {
    const std::uint32_t i = random() % n, j = random() % n;
    const std::uint32_t a = smallest[i], b = smallest[j];
    EXPECT_EQ(sets.join(i, j), a != b);
    for(std::uint32_t& s : smallest)
      s = s == a || s == b ? (std::min)(a, b) : s;
  }
  for(std::uint32_t i = 0; i < n; ++i)
    EXPECT_EQ(sets.find(i), smallest[i]);
}

// Beside the sets of corners that each open edge joins.
TEST(Indexed_mesh, wedges_are_what_open_edges_connect)
{
  for(const std::uint64_t seed : {1, 2, 3})
    for(const Indexed_triangle_mesh& form : {test_support::sphere(2), test_support::grid(9, 4)}) {
      const Indexed_triangle_mesh mesh = test_support::shuffled(form, seed);
      const IM::Triangle_adjacency adjacency(mesh.triangles);
      const auto n = IM::Halfedge(adjacency.number_of_halfedges());
      std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
      std::vector<bool> is_closed(n, false);
      for(IM::Halfedge h = 0; h < n; ++h)
        if(random() % 3 == 0 || adjacency.opposite(h) == IM::no_halfedge) {
          is_closed[h] = true;
          if(adjacency.opposite(h) != IM::no_halfedge)
            is_closed[adjacency.opposite(h)] = true;
        }
      IM::Disjoint_sets corners(n);
      for(IM::Halfedge h = 0; h < n; ++h)
        if(!is_closed[h]) {
          corners.join(h, IM::next_halfedge(adjacency.opposite(h)));
          corners.join(IM::next_halfedge(h), adjacency.opposite(h));
        }
      const std::vector<IM::Halfedge> first = IM::first_corners_of_wedges(
        n, [&](IM::Halfedge h) { return is_closed[h] ? IM::no_halfedge : adjacency.opposite(h); });
      ASSERT_EQ(first.size(), n);
      for(IM::Halfedge h = 0; h < n; ++h)
        EXPECT_EQ(first[h], corners.find(h)) << "seed " << seed << ", corner " << h;
    }
}

TEST(Indexed_mesh, prepared_meshes_are_the_input_at_another_place_and_in_another_order)
{
  const std::uint64_t seed = 5;
  for(const Indexed_triangle_mesh& form : {test_support::sphere(2), test_support::grid(9, 4)}) {
    Indexed_triangle_mesh mesh = test_support::shuffled(form, seed);
    mesh.points.insert(mesh.points.begin(), Point_3(1e5, 0., 0.)); // belongs to no triangle
    for(auto& t : mesh.triangles)
      for(IM::Vertex_index& v : t)
        ++v;
    EXPECT_EQ(IM::prepare_mesh(mesh).error, "vertex 0 has no face; remove it first");
    IM::Preparation steps;
    steps.drops_unused_vertices = true;
    const IM::Prepared_mesh prepared = IM::prepare_mesh(mesh, steps);
    ASSERT_EQ(prepared.error, "");
    ASSERT_EQ(prepared.source.size(), form.points.size());
    // The same triangles, as sets of the input's vertices in cyclic order
    const auto canonical = [](std::vector<IM::Triangle_indices> triangles) {
      for(auto& t : triangles)
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      std::sort(triangles.begin(), triangles.end());
      return triangles;
    };
    std::vector<IM::Triangle_indices> triangles = prepared.mesh.triangles;
    for(auto& t : triangles)
      for(IM::Vertex_index& v : t)
        v = prepared.source[v];
    EXPECT_EQ(canonical(triangles), canonical(mesh.triangles));
    // Lengths are multiplied by the scale; their mean is 1
    double sum = 0.;
    for(const auto& t : prepared.mesh.triangles)
      for(int c = 0; c < 3; ++c) {
        const IM::Vertex_index v = t[c], w = t[(c + 1) % 3];
        const double length
          = std::sqrt(squared_distance(prepared.mesh.points[v], prepared.mesh.points[w]));
        EXPECT_NEAR(length, prepared.scale * std::sqrt(squared_distance(
                              mesh.points[prepared.source[v]], mesh.points[prepared.source[w]])),
                    1e-9);
        sum += length;
      }
    EXPECT_NEAR(sum / double(3 * prepared.mesh.triangles.size()), 1., 1e-9);
    std::vector<bool> flags(mesh.points.size());
    for(std::size_t v = 0; v < flags.size(); ++v)
      flags[v] = v % 3 == 0;
    const std::vector<bool> moved = prepared.flags(flags);
    for(std::size_t v = 0; v < moved.size(); ++v)
      EXPECT_EQ(moved[v], prepared.source[v] % 3 == 0);
    EXPECT_TRUE(prepared.flags({}).empty());
  }
}

TEST(Indexed_mesh, errors_are_sentences_in_terms_of_the_input)
{
  EXPECT_EQ(IM::mesh_error(Indexed_triangle_mesh()), "the mesh has no triangles");
  EXPECT_EQ(IM::mesh_error(Indexed_triangle_mesh(), "the fine mesh"),
            "the fine mesh has no triangles");
  const Indexed_triangle_mesh good = test_support::sphere(1);
  EXPECT_EQ(IM::mesh_error(good), "");
  EXPECT_EQ(IM::prepare_mesh(good).error, "");
  Indexed_triangle_mesh bad = good;
  bad.triangles[5][2] = 1000;
  EXPECT_EQ(IM::mesh_error(bad), "triangle 5 has a vertex that does not exist");
  EXPECT_EQ(IM::mesh_error(bad, "the model"),
            "triangle 5 of the model has a vertex that does not exist");
  bad = good;
  bad.points[3] = Point_3(0., std::numeric_limits<double>::infinity(), 0.);
  EXPECT_EQ(IM::mesh_error(bad), "vertex 3 has a coordinate that is not a finite number");
  bad = good;
  bad.triangles[4][0] = bad.triangles[4][1];
  EXPECT_EQ(IM::repeated_vertex_error(bad.triangles), "triangle 4 has a vertex twice");
  EXPECT_EQ(IM::repeated_vertex_error(good.triangles), "");
  EXPECT_EQ(IM::prepare_mesh(test_support::scaled(good, 0.)).error,
            "all edges are without length");
  bad = good;
  bad.triangles.push_back(bad.triangles[0]); // an edge of three triangles
  EXPECT_NE(IM::prepare_mesh(bad).error.find("more than two faces"), std::string::npos);
}

// Flipped means the same, exactly, in all measures: not "without area", and not up to rounding.
TEST(Indexed_mesh, flipped_triangles_of_a_chart_are_those_with_negative_area)
{
  const Indexed_triangle_mesh mesh = test_support::grid(1, 1); // a square of two triangles
  std::vector<Point_2> uv;
  for(const Point_3& p : mesh.points)
    uv.emplace_back(p.x(), p.y());
  const auto measure = [&] {
    return CGAL::Surface_mesh_texturing::measure_chart_distortion(mesh, uv);
  };
  EXPECT_EQ(measure().flipped_faces, 0u);
  EXPECT_EQ(measure().degenerate_faces, 0u);
  for(Point_2& p : uv)
    p = Point_2(-p.x(), p.y());
  EXPECT_EQ(measure().flipped_faces, 2u);
  for(Point_2& p : uv)
    p = Point_2(p.x(), 0.);
  EXPECT_EQ(measure().flipped_faces, 0u);
  EXPECT_EQ(measure().degenerate_faces, 2u);
}

} // namespace indexed_mesh_test
