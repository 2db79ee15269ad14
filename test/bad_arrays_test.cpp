// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Arrays, pins and levels that do not belong to the mesh they are given with: a sentence, and nothing
// is read.

#include <support/bad_arrays.h>
#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>
#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/face_distortion.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <complex>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace bad_arrays_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_outcome;
using CGAL::Indexed_mesh::Mesh_status;

// Arrays that belong to no mesh of this size: a sentence, or nothing.
TEST(Bad_arrays, of_another_length_are_not_read)
{
  const Indexed_triangle_mesh mesh = good_arrays();
  const std::size_t n = mesh.points.size();
  typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;
  const Uv good(n, Point_2(0., 0.));
  for(const std::size_t size : {std::size_t(0), n - 1, n + 1}) {
    SCOPED_TRACE(size);
    Uv uv(size, Point_2(0., 0.)), fitting = good;
    for(const Mesh_outcome& outcome :
        {Mesh_outcome(SMP::certify_map(mesh, uv)), Mesh_outcome(SMP::repair_flipped_faces(mesh, uv)),
         Mesh_outcome(SMP::repair_flipped_faces(mesh, fitting, std::vector<bool>(size)))}) {
      EXPECT_EQ(outcome.status, Mesh_status::BAD_OPTIONS);
      EXPECT_NE(outcome.error.find(std::to_string(size) + " entries"), std::string::npos);
    }
    EXPECT_EQ(num_faces(SMP::Uv_arrays(mesh, uv)), size < n ? 0u : mesh.triangles.size());
    EXPECT_EQ(SMP::measure_face_distortion(mesh, uv).empty(), size < n);
    EXPECT_EQ(SMT::measure_chart_distortion(mesh, uv).area, 0.);
    EXPECT_TRUE(
      CGAL::Surface_mesh_multigrid::surface_gradients(mesh, std::vector<double>(size)).empty());
    EXPECT_TRUE(CGAL::Surface_mesh_multigrid::weak_divergences(
                  mesh, std::vector<CGAL::Surface_mesh_multigrid::Surface_vector>(size)).empty());
  }
  for(const auto& [name, bad] : bad_arrays(mesh)) {
    if(name == "NaN" || name == "infinite" || bad.triangles.empty())
      continue;
    EXPECT_EQ(SMT::measure_chart_distortion(bad, good).area, 0.) << name;
    EXPECT_TRUE(
      CGAL::Surface_mesh_multigrid::surface_gradients(bad, std::vector<double>(n)).empty()) << name;
    EXPECT_TRUE(CGAL::Surface_mesh_multigrid::weak_divergences(
                  bad, std::vector<CGAL::Surface_mesh_multigrid::Surface_vector>(
                         bad.triangles.size())).empty()) << name;
  }
  Uv uv = good;
  uv[5] = Point_2(0., std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(SMP::repair_flipped_faces(mesh, uv).unmended_faces.empty());
  EXPECT_GT(SMP::certify_map(mesh, uv).degenerate_faces, 0u);
  CGAL::Surface_mesh_multigrid::Surface_multigrid_solver<> solver(mesh);
  std::vector<double> distance;
  EXPECT_EQ(CGAL::Surface_mesh_multigrid::heat_distances(solver, grid(3, 3), 0, distance).status,
            Mesh_status::BAD_OPTIONS);
  EXPECT_TRUE(distance.empty());
}

TEST(Bad_pins, of_arrays)
{
  const auto message = [](const std::vector<SMP::HLSCM_pin>& pins) {
    const SMP::Conformal_map map = SMP::conformal_map(good_arrays(), pins);
    EXPECT_EQ(map.code, SMP::ERROR_WRONG_PARAMETER);
    EXPECT_EQ(map.status, Mesh_status::BAD_OPTIONS);
    EXPECT_TRUE(map.uv.empty());
    return map.report.message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message({}).find("fewer than two"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}}).find("fewer than two"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {std::size_t(-1), 1., 0.}}).find("does not belong"),
            std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {0, 1., 0.}}).find("twice"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {3, nan, 0.}}).find("not a finite number"), std::string::npos);
}

// The pins of arrays do what those of a mesh do.
TEST(Pins_of_arrays, are_met_and_give_the_map_of_the_parameterizer)
{
  const std::vector<SMP::HLSCM_pin> pins = {{3, 0., 0.}, {40, 2., 1.}, {77, -1., 3.}};
  const SMP::Conformal_map map = SMP::conformal_map(good_arrays(), pins);
  ASSERT_EQ(map.error, "");
  Surface_mesh mesh = to_surface_mesh(good_arrays());
  Pins same;
  for(const SMP::HLSCM_pin& pin : pins) {
    same.push_back({pin.vertex, {pin.u, pin.v}});
    EXPECT_EQ(map.uv[pin.vertex], Point_2(pin.u, pin.v));
  }
  const Outcome run = parameterize(mesh, SMP::HLSCM_options(), same);
  ASSERT_EQ(run.uv.size(), map.uv.size());
  for(std::size_t v = 0; v < map.uv.size(); ++v)
    EXPECT_EQ(run.uv[v], std::complex<double>(map.uv[v].x(), map.uv[v].y()));
}

TEST(Chart_of_another_mesh, gives_no_levels)
{
  SMP::HLSCM_options options;
  options.keep_progressive_mesh = true;
  Parameterizer parameterizer(options);
  Surface_mesh mesh = to_surface_mesh(good_arrays()), other = to_surface_mesh(grid(2, 2));
  const Uv_map uvmap = new_uv_map(mesh);
  ASSERT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK);
  const SMP::Chart_progressive_mesh& chart = parameterizer.progressive_mesh();
  EXPECT_EQ(SMP::build_textured_progressive_mesh(mesh, uvmap, chart).error, "");
  for(const auto& result :
      {SMP::build_textured_progressive_mesh(other, new_uv_map(other), chart),
       SMP::build_textured_progressive_mesh(mesh, uvmap, SMP::Chart_progressive_mesh())}) {
    EXPECT_NE(result.error, "");
    EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::BAD_OPTIONS);
  }
}

TEST(Chart_of_other_arrays, gives_no_levels)
{
  const Indexed_triangle_mesh mesh = good_arrays();
  SMP::HLSCM_options options;
  EXPECT_TRUE(SMP::conformal_map(mesh, options).progressive_mesh.vertices.empty()); // not asked for
  options.keep_progressive_mesh = true;
  options.method = SMP::Conformal_method::DIRECT; // which has no collapses
  EXPECT_TRUE(SMP::conformal_map(mesh, options).progressive_mesh.vertices.empty());
  options.method = SMP::Conformal_method::HLSCM;
  const SMP::Conformal_map map = SMP::conformal_map(mesh, options);
  const SMP::Chart_progressive_mesh& chart = map.progressive_mesh;
  EXPECT_EQ(SMP::build_textured_progressive_mesh(mesh.points, map.uv, chart).error, "");
  std::vector<Indexed_triangle_mesh::Point_3> fewer = mesh.points;
  fewer.pop_back();
  std::vector<Point_2> fewer_uv = map.uv;
  fewer_uv.pop_back();
  CGAL::Surface_mesh_multiresolution::Textured_progressive_mesh_options locked;
  locked.is_locked.assign(mesh.points.size() + 1, true);
  for(const Mesh_outcome& outcome : std::initializer_list<Mesh_outcome>{
        SMP::build_textured_progressive_mesh(fewer, fewer_uv, chart),
        SMP::build_textured_progressive_mesh(mesh.points, fewer_uv, chart),
        SMP::build_textured_progressive_mesh(mesh.points, map.uv, chart, locked),
        SMP::build_textured_progressive_mesh(mesh.points, map.uv, SMP::Chart_progressive_mesh())}) {
    EXPECT_NE(outcome.error, "");
    EXPECT_EQ(outcome.status, Mesh_status::BAD_OPTIONS);
  }
  std::vector<Indexed_triangle_mesh::Point_3> points = mesh.points;
  points[2] = Indexed_triangle_mesh::Point_3(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  const Mesh_outcome bad = SMP::build_textured_progressive_mesh(points, map.uv, chart);
  EXPECT_EQ(bad.status, Mesh_status::BAD_MESH);
  EXPECT_NE(bad.error.find("vertex 2"), std::string::npos) << bad.error;
}

// CGAL's table of texts has one too few.
TEST(Error_texts, are_there_for_all_codes)
{
  for(int error = SMP::OK; error <= SMP::ERROR_WRONG_PARAMETER; ++error) {
    ASSERT_NE(SMP::internal::text_of(SMP::Error_code(error)), nullptr);
    EXPECT_NE(std::string(SMP::internal::text_of(SMP::Error_code(error))), "unknown error");
  }
}

} // namespace bad_arrays_test
