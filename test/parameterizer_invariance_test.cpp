// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What does not matter to the parameterizer: size, position and order of a mesh; and hard cases.

#include <support/conformal_maps.h>
#include <support/parameterizer_options.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace parameterizer_invariance_test {

using namespace test_support;
using namespace parameterizer_options;

// --- Invariance

TEST(Size_and_position, do_not_matter)
{
  const auto mesh = with_hills(with_holes(irregular_grid(60, 40, 1), 5, 2), 10., 3);
  Surface_mesh ordinary = to_surface_mesh(mesh);
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::CASCADIC,
                           Conformal_method::LSCM, Conformal_method::DIRECT}) {
    HLSCM_options options = with_many_levels(1e-12);
    options.method = method;
    const Outcome expected = parameterize(ordinary, options);
    ASSERT_EQ(expected.error, SMP::OK) << expected.report.message;
    for(const double scale : {1e-30, 1e30})
      for(const double shift : {0., 1e5}) {
        Surface_mesh other = to_surface_mesh(scaled(translated(mesh, shift, -shift, shift), scale));
        const Outcome run = parameterize(other, options);
        ASSERT_EQ(run.error, SMP::OK) << run.report.message;
        EXPECT_LE(difference(run.uv, expected.uv), 1e-6)
          << run.report.method << " scale " << scale << " shift " << shift;
      }
  }
}

TEST(Weights_of_cgal, do_not_depend_on_the_unit)
{
  const auto mesh = with_hills(irregular_grid(40, 30, 1), 10., 3);
  Surface_mesh ordinary = to_surface_mesh(mesh);
  HLSCM_options options = with_many_levels(1e-10);
  options.weights = Conformal_weights::CGAL_LSCM;
  const Outcome expected = parameterize(ordinary, options);
  for(const double scale : {1e-30, 1e-3, 1e30}) {
    Surface_mesh other = to_surface_mesh(scaled(mesh, scale));
    const Outcome run = parameterize(other, options);
    ASSERT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_LE(difference(run.uv, expected.uv), 1e-6) << scale;
  }
}

TEST(Order_of_vertices_and_faces, does_not_matter)
{
  const auto mesh = with_hills(with_holes(irregular_grid(60, 40, 1), 5, 2), 10., 3);
  Random random(4);
  const auto rank = random_permutation(mesh.points.size(), random);
  Indexed_triangle_mesh other = mesh;
  for(std::size_t v = 0; v < rank.size(); ++v)
    other.points[rank[v]] = mesh.points[v];
  for(Triangle_indices& t : other.triangles)
    t = {rank[t[2]], rank[t[0]], rank[t[1]]};
  std::reverse(other.triangles.begin(), other.triangles.end());
  Surface_mesh first = to_surface_mesh(mesh), second = to_surface_mesh(other);
  const std::size_t last = mesh.points.size() - 1;
  const auto options = with_many_levels(1e-12);
  const Outcome a = parameterize(first, options, {{0, 0.}, {last, 1.}});
  const Outcome b = parameterize(second, options, {{rank[0], 0.}, {rank[last], 1.}});
  Parameters sorted;
  for(const auto r : rank)
    sorted.push_back(b.uv[r]);
  EXPECT_LE(difference(sorted, a.uv), 1e-6);
}

TEST(Results, are_the_same_bytes_in_every_run)
{
  const auto mesh = curved_charts(5)[4].mesh;
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::CASCADIC,
                           Conformal_method::LSCM, Conformal_method::DIRECT})
    for(const auto engine : all_engines) {
      if(engine != Engine::FLAT && method != Conformal_method::HLSCM)
        continue;
      HLSCM_options options = with_many_levels();
      options.method = method;
      set_engine(engine, options);
      Surface_mesh first_mesh = to_surface_mesh(mesh), second_mesh = to_surface_mesh(mesh);
      const Outcome first = parameterize(first_mesh, options);
      // Watching changes nothing.
      options.progress = [](double) { return true; };
      options.level_observer = [](const SMP::Level_view&) { return true; };
      const Outcome second = parameterize(second_mesh, options);
      const Outcome again = parameterize(first_mesh, options);
      EXPECT_EQ(first.uv, second.uv) << first.report.method;
      EXPECT_EQ(first.uv, again.uv) << first.report.method;
      EXPECT_EQ(first.report.energy, second.report.energy);
    }
}

// --- Hard cases

// A hub of degree 10,000 in the middle of a mesh of several levels
Indexed_triangle_mesh wheel_with_rim(Vertex_index degree)
{
  Indexed_triangle_mesh mesh = disk(3, degree);
  return moved(mesh, [](const Point_3& p) {
    return Point_3(p.x(), p.y(), 0.3 * p.x() * p.x() - 0.2 * p.y());
  });
}

TEST(Hard_meshes, hub_of_degree_10000)
{
  for(const auto& mesh : {fan(10000), wheel_with_rim(10000)}) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      HLSCM_options options = with_method(Conformal_method::HLSCM, 1e-4);
      options.weights = weights;
      const auto c = compare_with_direct(surface_mesh, options);
      EXPECT_EQ(c.hierarchical.error, SMP::OK) << c.hierarchical.report.message;
      EXPECT_LE(difference(c.hierarchical.uv, c.direct.uv), 1e-2);
    }
  }
}

TEST(Hard_meshes, one_and_two_triangles)
{
  for(const auto method : {Conformal_method::HLSCM, Conformal_method::CASCADIC,
                           Conformal_method::LSCM, Conformal_method::DIRECT}) {
    Surface_mesh one = to_surface_mesh(without_vertices(grid(1, 1), {true, true, false, true}));
    const Outcome run = parameterize(one, with_method(method));
    EXPECT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_EQ(measure(one, run.uv).flipped_faces, 0u);
    EXPECT_NEAR(measure(one, run.uv).quasi_conformal_max, 1., 1e-9);
    Surface_mesh two = to_surface_mesh(grid(1, 1));
    two.point(Surface_mesh::Vertex_index(3)) = {1., 1., 0.7};
    const Outcome bent = parameterize(two, with_method(method));
    EXPECT_EQ(bent.error, SMP::OK) << bent.report.message;
    EXPECT_NEAR(measure(two, bent.uv).quasi_conformal_max, 1., 1e-6);
  }
}

TEST(Hard_meshes, without_area_anywhere)
{
  // All vertices on one line: every triangle is mollified.
  Surface_mesh line = to_surface_mesh(moved(grid(12, 9), [](const Point_3& p) {
    return Point_3(p.x() + 0.1 * p.y(), 0., 0.);
  }));
  const Outcome run = parameterize(line, HLSCM_options());
  EXPECT_EQ(run.error, SMP::OK) << run.report.message;
  EXPECT_EQ(run.report.mollified_faces, line.number_of_faces());
  for(const Complex& z : run.uv)
    EXPECT_TRUE(std::isfinite(z.real()) && std::isfinite(z.imag()));
}

TEST(Hard_meshes, with_triangles_of_no_area_are_solved_and_it_is_said)
{
  const auto hills = with_hills(irregular_grid(40, 30, 1), 8., 2);
  for(const auto& mesh : {with_zero_area_triangles(hills, 10, 3),
                          with_duplicate_points(hills, 10, 4)}) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Outcome run = parameterize(surface_mesh, HLSCM_options());
    EXPECT_EQ(run.error, SMP::OK) << run.report.message;
    EXPECT_GT(run.report.mollified_faces, 0u);
    ASSERT_EQ(run.report.warnings.size(), 1u);
    EXPECT_EQ(run.report.warnings[0], std::to_string(run.report.mollified_faces)
              + " faces have no area; they were given some by mollification");
  }
}

} // namespace parameterizer_invariance_test
