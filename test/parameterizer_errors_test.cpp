// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parameterizer makes of several components, and what it says about bad input.

#include <support/conformal_maps.h>
#include <support/mesh_properties.h>
#include <support/method_runs.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace parameterizer_errors_test {

using namespace test_support;
using namespace method_runs;

// --- Several components

Indexed_triangle_mesh together(const Indexed_triangle_mesh& a, const Indexed_triangle_mesh& b)
{
  Indexed_triangle_mesh result = a;
  const auto shift = Vertex_index(a.points.size());
  result.points.insert(result.points.end(), b.points.begin(), b.points.end());
  for(const auto& t : b.triangles)
    result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return result;
}

TEST(Components, only_the_one_of_the_halfedge_is_mapped)
{
  const auto first = hills(), second = with_hills(irregular_grid(30, 30, 5), 5., 6);
  const auto both = together(first, second);
  Surface_mesh mesh = to_surface_mesh(both), first_alone = to_surface_mesh(first),
               second_alone = to_surface_mesh(second);
  const auto size = first.points.size();
  for(const bool is_first : {true, false}) {
    auto bhd = Surface_mesh::null_halfedge();
    for(const auto h : halfedges(mesh))
      if(is_border(h, mesh) && (std::size_t(target(h, mesh)) < size) == is_first)
        bhd = h;
    const Outcome run = parameterize(mesh, with_many_levels(), Pins(), bhd);
    const Outcome alone = parameterize(is_first ? first_alone : second_alone, with_many_levels());
    ASSERT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_EQ(run.report.vertices, alone.report.vertices);
    Parameters mapped(run.uv.begin(), run.uv.begin() + size),
               other(run.uv.begin() + size, run.uv.end());
    if(!is_first)
      mapped.swap(other);
    EXPECT_LE(difference(mapped, alone.uv), 0.02);
    for(const Complex& z : other)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

TEST(Components, isolated_vertices_stay_untouched)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const auto lonely = mesh.add_vertex({1e9, 2., 3.});
  const Outcome run = parameterize(mesh, HLSCM_options());
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_EQ(run.uv[lonely], Complex(untouched, untouched));
  EXPECT_EQ(run.report.vertices, mesh.number_of_vertices() - 1);
}

// Positions in vertices(mesh) are counted without removed vertices.
TEST(Removed_vertices, do_not_disturb_the_numbering)
{
  const auto arrays = hills();
  Surface_mesh gaps, plain = to_surface_mesh(arrays);
  std::vector<Vertex> descriptor;
  for(const auto& p : arrays.points) {
    gaps.remove_vertex(gaps.add_vertex());
    gaps.set_recycle_garbage(false);
    descriptor.push_back(gaps.add_vertex(p));
  }
  for(const auto& t : arrays.triangles)
    gaps.add_face(descriptor[t[0]], descriptor[t[1]], descriptor[t[2]]);
  ASSERT_TRUE(gaps.has_garbage());
  const Outcome a = parameterize(gaps, with_many_levels()),
                b = parameterize(plain, with_many_levels());
  ASSERT_EQ(a.error, SMP::OK) << a.report.message;
  EXPECT_EQ(a.uv, b.uv);
  EXPECT_EQ(a.report.pins[0].vertex, b.report.pins[0].vertex);
}

// --- What is wrong

// All methods fail with the same sentence, and leave the parameters alone.
void expect_failure(Surface_mesh& mesh, SMP::Error_code error, const std::string& message,
                    const Pins& pins = Pins(),
                    Surface_mesh::Halfedge_index bhd = Surface_mesh::null_halfedge())
{
  for(const auto method : all_methods) {
    const Outcome run = parameterize(mesh, with_method(method), pins, bhd);
    EXPECT_EQ(run.error, error);
    EXPECT_EQ(run.report.message, message);
    EXPECT_FALSE(run.report.converged);
    for(const Complex& z : run.uv)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

TEST(Errors, coordinate_that_is_not_finite)
{
  for(const double bad : {std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity()})
    for(int c = 0; c < 3; ++c) {
      auto arrays = hills();
      std::array<double, 3> p = {1., 2., 3.};
      p[c] = bad;
      arrays.points[17] = Point_3(p[0], p[1], p[2]);
      Surface_mesh mesh = to_surface_mesh(arrays);
      expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, "vertex 17 has a coordinate that is not a "
                     "finite number");
    }
}

TEST(Errors, closed_surface)
{
  Surface_mesh mesh = to_surface_mesh(sphere(2));
  const std::string message
    = "the given halfedge is not on a border; a closed surface must be cut open first";
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC, message); // no border halfedge at all
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC, message, Pins(), *halfedges(mesh).begin());
}

TEST(Errors, handles)
{
  Surface_mesh mesh = to_surface_mesh(with_holes(torus(20, 10), 2, 1));
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC,
                 "the surface has genus 1; cut its handles first");
}

TEST(Errors, vertex_with_two_fans)
{
  // Two squares that share the vertex 3
  auto arrays = together(grid(1, 1), translated(grid(1, 1), 1., 1., 0.));
  for(auto& t : arrays.triangles)
    for(auto& v : t)
      v = v == 4 ? 3 : v;
  Surface_mesh mesh = to_surface_mesh(arrays);
  expect_failure(mesh, SMP::ERROR_NO_TOPOLOGICAL_DISC,
                 "the faces at vertex 3 do not form one fan; split the vertex first");
}

TEST(Errors, face_that_is_not_a_triangle)
{
  Surface_mesh mesh;
  const auto v = [&](double x, double y) { return mesh.add_vertex({x, y, 0.}); };
  const auto a = v(0, 0), b = v(1, 0), c = v(1, 1), d = v(0, 1), e = v(2, 0);
  mesh.add_face(b, e, c);
  mesh.add_face(a, b, c, d);
  expect_failure(mesh, SMP::ERROR_NON_TRIANGULAR_MESH,
                 "face 1 is not a triangle; triangulate the mesh first");
}

TEST(Errors, all_in_one_point)
{
  Surface_mesh mesh
    = to_surface_mesh(moved(grid(3, 3), [](const Point_3&) { return Point_3(1., 2., 3.); }));
  expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, "all edges are without length");
}

TEST(Errors, pins)
{
  const auto first = hills();
  Surface_mesh mesh = to_surface_mesh(together(first, grid(2, 2)));
  const auto other = first.points.size() + 4;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [&](const Pins& pins, const std::string& message) {
    expect_failure(mesh, SMP::ERROR_WRONG_PARAMETER, message, pins);
  };
  expect({{5, 0.}}, "fewer than two vertices are pinned; pin two or more");
  expect({{5, 0.}, {5, 1.}}, "vertex 5 is pinned twice; pin it once");
  expect({{5, Complex(1., 2.)}, {6, Complex(1., 2.)}},
         "the pins of vertex 5 and vertex 6 lie in one point of the parameter plane; move one of "
         "them");
  expect({{5, 0.}, {6, Complex(0., nan)}},
         "the pin of vertex 6 has a coordinate that is not a finite number");
  expect({{5, 0.}, {other, 1.}}, "the pinned vertex " + std::to_string(other)
         + " does not belong to the chart; pin vertices of the chart");
  expect({{5, 0.}, {1000000, 1.}}, "the pinned vertex " + std::to_string(mesh.number_of_vertices())
         + " does not belong to the chart; pin vertices of the chart");
}

TEST(Errors, options)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  const auto message_of = [&](const HLSCM_options& options) {
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::ERROR_WRONG_PARAMETER);
    for(const Complex& z : run.uv)
      EXPECT_EQ(z, Complex(untouched, untouched));
    return run.report.message;
  };
  HLSCM_options options;
  for(const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN()}) {
    options = HLSCM_options();
    options.tolerance = bad;
    EXPECT_EQ(message_of(options), "the tolerance must be positive");
  }
  for(const double bad : {1., 0.5, -2., std::numeric_limits<double>::quiet_NaN()}) {
    options = HLSCM_options();
    options.level_ratio = bad;
    EXPECT_EQ(message_of(options), "the ratio of levels must be greater than 1");
  }
  options = HLSCM_options();
  options.angular_defect_bound = 0.;
  EXPECT_EQ(message_of(options), "the bound of the angular defect must be positive");
  options = HLSCM_options();
  options.schedule = CGAL::Multigrid::Schedule{1, 1, 0, CGAL::Multigrid::Acceleration::NONE};
  EXPECT_EQ(message_of(options), "the schedule must visit the coarse level at least once");
}

TEST(Errors, too_few_iterations)
{
  Surface_mesh mesh = to_surface_mesh(hills());
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::LSCM}) {
    HLSCM_options options = with_many_levels(method, 1e-6);
    options.maximal_iterations = 3;
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
    EXPECT_FALSE(run.report.converged);
    EXPECT_EQ(run.report.iterations, 3u);
    EXPECT_EQ(run.report.message.substr(0, 48), "the tolerance was not met after 3 iterations; ra");
    for(const Complex& z : run.uv)
      ASSERT_EQ(z, Complex(untouched, untouched));
  }
}

} // namespace parameterizer_errors_test
