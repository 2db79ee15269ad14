// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texture atlases: charts that are disks, maps that are one-to-one in each chart and between charts,
// whatever the surface.

#include <support/bad_surfaces.h>
#include <support/chart_generators.h>
#include <support/texture_atlas_properties.h>
#include <support/texturing_options.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace texture_atlas_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::uint64_t seed = 51200;
const std::string seed_text = ", seed " + std::to_string(seed);

bool are_equal(const SMT::Texture_atlas& a, const SMT::Texture_atlas& b)
{
  return a.mesh.wedges == b.mesh.wedges && a.charts.chart == b.charts.chart && a.page == b.page
      && a.mesh.uv.size() == b.mesh.uv.size()
      && std::memcmp(a.mesh.uv.data(), b.mesh.uv.data(), a.mesh.uv.size() * sizeof(a.mesh.uv[0]))
           == 0;
}

Indexed_triangle_mesh joined(const Indexed_triangle_mesh& a, const Indexed_triangle_mesh& b)
{
  Indexed_triangle_mesh mesh = a;
  const Vertex_index first = Vertex_index(a.points.size());
  mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
  for(const Triangle_indices& t : b.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

TEST(Texture_atlas, is_one_to_one_on_every_surface)
{
  std::vector<Named_mesh> meshes = generated_meshes(seed);
  meshes.push_back({"sphere and torus", joined(sphere(3), torus(30, 15))});
  meshes.push_back({"large torus", torus(60, 30)});
  for(const auto& [name, mesh] : meshes) {
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, small_texture());
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << seed_text;
    EXPECT_EQ(result.report.charts.size(), result.atlas.charts.number_of_charts) << name;
    EXPECT_EQ(result.report.distortion.flipped_faces, 0u) << name;
    for(const SMT::Chart_report& chart : result.report.charts) {
      EXPECT_TRUE(chart.is_one_to_one) << name;
      EXPECT_TRUE(chart.faces == 1 || chart.distortion.is_within(SMT::Distortion_bound()))
        << name << ": " << chart.distortion.area_scale << ", " << chart.distortion.quasi_conformal;
    }
  }
}

// Noise of more than an edge's length: no chart of many triangles is within the bound, and the atlas is not
// dust for that.
TEST(Texture_atlas, has_few_charts_where_the_surface_is_rough)
{
  constexpr int n = 70;
  Indexed_triangle_mesh mesh = grid(n, n);
  EXPECT_EQ(SMT::build_texture_atlas(mesh, small_texture()).report.rough_charts, 0u);
  const double edge = std::sqrt(squared_distance(mesh.points[0], mesh.points[1]));
  Random random(seed);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x(), p.y(), uniform(random, -2. * edge, 2. * edge));
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, small_texture());
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << seed_text;
  EXPECT_LT(result.report.charts.size(), 20u) << seed_text;
  EXPECT_GT(result.report.rough_charts, 0u);
  std::size_t beyond = 0;
  for(const SMT::Chart_report& chart : result.report.charts) {
    EXPECT_TRUE(chart.is_one_to_one);
    beyond += chart.faces > 1 && !chart.distortion.is_within(SMT::Distortion_bound()) ? 1 : 0;
  }
  EXPECT_EQ(beyond, result.report.rough_charts);
}

// 14,400 triangles that go through a level of 1,500
TEST(Texture_atlas, is_one_to_one_by_least_squares_too)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(40, 20), 0.02, seed);
  SMT::Texture_atlas_options options = small_texture();
  SMT::Conformal_chart_parameterizer parameterizer;
  parameterizer.solver.method = CGAL::Surface_mesh_parameterization::Conformal_method::HLSCM;
  for(const std::size_t direct_faces : {std::size_t(0), parameterizer.direct_faces}) {
    parameterizer.direct_faces = direct_faces;
    const SMT::Texture_atlas_result result
      = SMT::build_texture_atlas(mesh, options, CGAL::Default(), parameterizer);
    ASSERT_EQ(result.error, "") << direct_faces;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << direct_faces << seed_text;
    for(const SMT::Chart_report& chart : result.report.charts)
      EXPECT_TRUE(chart.is_one_to_one && chart.distortion.is_within(options.bound))
        << direct_faces << ": " << chart.distortion.area_scale << ", "
        << chart.distortion.quasi_conformal;
  }
}

TEST(Texture_atlas, is_valid_when_charts_are_tried_on_a_level_first)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(120, 60), 0.02, seed);
  SMT::Texture_atlas_options options = small_texture();
  options.trial_faces = 1500;
  double last = 0.;
  options.progress = [&last](double part) {
    EXPECT_GE(part, last);
    last = part;
    return true;
  };
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(last, 1.);
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << seed_text;
  for(const SMT::Chart_report& chart : result.report.charts) {
    EXPECT_TRUE(chart.faces == 1 || chart.distortion.is_within(SMT::Distortion_bound()));
    EXPECT_NEAR(chart.distortion.uv_area, chart.distortion.area, 1e-6 * chart.distortion.area);
  }
  for(const double stop : {0.05, 0.22, 0.3}) { // within the level's part
    options.progress = [stop](double part) { return part < stop; };
    EXPECT_EQ(SMT::build_texture_atlas(mesh, options).error, "cancelled") << stop;
  }
}

TEST(Texture_atlas, has_charts_of_the_size_that_they_have_on_the_surface)
{
  const Indexed_triangle_mesh mesh = torus(60, 30);
  SMT::Texture_atlas_options options = small_texture();
  options.bending = 0.;
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  ASSERT_GT(result.atlas.charts.number_of_charts, 1u);
  std::vector<double> area(result.atlas.charts.number_of_charts), uv_area(area.size());
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const std::uint32_t chart = result.atlas.charts.chart[t];
    area[chart] += std::sqrt(
      CGAL::squared_area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
    const Exact_triangle p = uv_triangle(result.atlas, t);
    uv_area[chart] += 256. * 256. * CGAL::area(p[0], p[1], p[2]);
  }
  const double scale = result.report.texels_per_unit;
  double all = 0.;
  for(std::size_t i = 0; i < area.size(); ++i) {
    EXPECT_NEAR(uv_area[i], scale * scale * area[i], 1e-6 * uv_area[i]);
    all += uv_area[i];
  }
  EXPECT_NEAR(result.report.utilisation, all / (256. * 256.), 1e-6);
}

TEST(Texture_atlas, does_not_depend_on_the_unit_of_length)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(40, 20), 0.02, seed);
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, small_texture());
  for(const double factor : {0x1p-20, 0x1p20}) { // exact
    const SMT::Texture_atlas_result other
      = SMT::build_texture_atlas(scaled(mesh, factor), small_texture());
    EXPECT_TRUE(are_equal(result.atlas, other.atlas)) << factor << seed_text;
    EXPECT_NEAR(other.report.texels_per_unit * factor, result.report.texels_per_unit,
                1e-9 * result.report.texels_per_unit);
  }
  for(const double factor : {1e-6, 100.}) {
    const SMT::Texture_atlas_result other
      = SMT::build_texture_atlas(scaled(mesh, factor), small_texture());
    EXPECT_EQ(result.atlas.charts.chart, other.atlas.charts.chart) << factor << seed_text;
  }
}

// Surfaces without symmetry, with a mirror, and with as much of them in all directions
std::vector<Named_mesh> surfaces_to_be_turned()
{
  Indexed_triangle_mesh long_torus = with_noise(torus(40, 20), 0.02, seed), bumpy_sphere = sphere(3);
  for(auto& p : long_torus.points)
    p = Point_3(2. * p.x(), p.y(), p.z());
  for(auto& p : bumpy_sphere.points) {
    const double r = 1. + 0.3 * std::cos(5. * p.x()) * std::cos(5. * p.y()) * std::cos(5. * p.z());
    p = Point_3(r * p.x(), r * p.y(), r * p.z());
  }
  return {{"torus with noise", long_torus}, {"torus", torus(40, 20)}, {"sphere", sphere(3)},
          {"bumpy sphere", bumpy_sphere}};
}

TEST(Texture_atlas, does_not_depend_on_how_the_surface_is_turned)
{
  SMT::Segmentation_options options;
  options.coarse_faces = 800;
  Random random(seed);
  for(const auto& [name, mesh] : surfaces_to_be_turned()) {
    const SMT::Segmentation_result charts = SMT::segment_into_charts(mesh, options);
    ASSERT_EQ(charts.error, "") << name;
    for(int turn = 0; turn < 10; ++turn)
      EXPECT_EQ(SMT::segment_into_charts(turned(mesh, random), options).charts.chart, charts.charts.chart)
        << name << ", turn " << turn << seed_text;
  }
}

TEST(Texture_atlas, does_not_depend_on_the_number_of_threads)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(60, 30), 0.02, seed);
  const SMT::Texture_atlas_result one = SMT::build_texture_atlas(mesh, small_texture());
  for(const unsigned int threads : {2u, 3u, 8u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    EXPECT_TRUE(are_equal(one.atlas, SMT::build_texture_atlas(mesh, small_texture()).atlas))
      << threads;
  }
}

TEST(Texture_atlas, keeps_the_charts_of_the_user)
{
  const Indexed_triangle_mesh mesh = grid(20, 20);
  std::vector<std::uint32_t> label(mesh.triangles.size());
  for(std::size_t t = 0; t < label.size(); ++t)
    label[t] = mesh.points[mesh.triangles[t][0]].x() < 10. ? 7 : 3;
  const SMT::Face_charts charts = SMT::charts_of_labels(mesh.triangles, label);
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(mesh, small_texture(), SMT::Given_charts_segmenter(charts));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.atlas.charts.chart, charts.chart);
  EXPECT_EQ(result.atlas.charts.seams, charts.seams);
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "");
}

TEST(Texture_atlas, cuts_charts_of_the_user_that_are_no_disks)
{
  for(const auto& [name, mesh] : {Named_mesh{"cylinder", cylinder(24, 12)},
                                  Named_mesh{"sphere", sphere(3)},
                                  Named_mesh{"torus", torus(24, 12)}}) {
    const SMT::Given_charts_segmenter one_chart(
      SMT::charts_of_labels(mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0)));
    const SMT::Texture_atlas_result result
      = SMT::build_texture_atlas(mesh, small_texture(), one_chart);
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name;
  }
}

TEST(Texture_atlas, gives_charts_the_density_that_is_asked_for)
{
  const Indexed_triangle_mesh mesh = joined(grid(10, 10), translated(grid(10, 10), 0., 0., 5.));
  SMT::Texture_atlas_options options = small_texture();
  options.bending = 0.;
  options.density.assign(mesh.triangles.size(), 1.f);
  std::fill(options.density.begin() + 200, options.density.end(), 3.f);
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(result.error, "");
  double area[2] = {0., 0.};
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Exact_triangle p = uv_triangle(result.atlas, t);
    area[t / 200] += CGAL::area(p[0], p[1], p[2]);
  }
  EXPECT_NEAR(area[1] / area[0], 9., 1e-6);
}

// The texture coordinates of the corners and the charts of the faces, in the order of faces(mesh),
// each face from its first halfedge.
template <class Mesh>
std::pair<std::vector<double>, std::vector<std::size_t>> atlas_of(const Mesh& mesh)
{
  typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
  const auto uv = get(CGAL::dynamic_halfedge_property_t<Point_2>(), mesh);
  const auto chart = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  EXPECT_EQ(SMT::build_texture_atlas(mesh, uv, chart, small_texture()).error, "");
  std::pair<std::vector<double>, std::vector<std::size_t>> result;
  for(const auto f : faces(mesh)) {
    result.second.push_back(get(chart, f));
    for(const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      result.first.push_back(get(uv, h).x());
      result.first.push_back(get(uv, h).y());
    }
  }
  return result;
}

TEST(Texture_atlas, is_the_same_for_every_type_of_mesh)
{
  const Indexed_triangle_mesh arrays = torus(30, 15);
  const Surface_mesh mesh = to_surface_mesh(arrays);
  const auto expected = SMT::build_texture_atlas(arrays, small_texture()).atlas;
  const auto [uv, chart] = atlas_of(mesh);
  ASSERT_EQ(chart, std::vector<std::size_t>(expected.charts.chart.begin(),
                                            expected.charts.chart.end()));
  // The first halfedge of a face may point to any of its corners
  for(std::size_t t = 0; t < arrays.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const auto& p = expected.mesh.uv[expected.mesh.wedges[t][c]];
      bool is_found = false;
      for(std::size_t i = 6 * t; i < 6 * t + 6; i += 2)
        is_found = is_found || (uv[i] == p.x() && uv[i + 1] == p.y());
      ASSERT_TRUE(is_found) << t;
    }
  CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  EXPECT_EQ(atlas_of(polyhedron).second.size(), chart.size()); // of other first corners
}

TEST(Texture_atlas, has_no_more_charts_if_there_is_time_for_fewer)
{
  SMT::Texture_atlas_options options = small_texture();
  options.bound.area_scale = 1.6;
  options.seam_price = 0.02; // few cuts that only fill the page
  std::size_t usual_charts = 0, charts = 0;
  for(const Indexed_triangle_mesh& mesh : {sphere(4), with_noise(torus(60, 30), 0.02, seed)}) {
    options.cutting_time = 0.;
    const std::size_t usual = SMT::build_texture_atlas(mesh, options).report.charts.size();
    options.cutting_time = 0.1;
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << seed_text;
    EXPECT_LE(result.report.charts.size(), usual) << seed_text;
    usual_charts += usual;
    charts += result.report.charts.size();
  }
  EXPECT_LT(charts, usual_charts) << seed_text;
  for(const double bad : {-1., std::numeric_limits<double>::infinity(), std::nan("")}) {
    options.cutting_time = bad;
    EXPECT_NE(SMT::build_texture_atlas(grid(3, 3), options).error.find("time for cutting"),
              std::string::npos);
  }
}

TEST(Texture_atlas, max_charts_has_precedence_over_the_bound)
{
  SMT::Texture_atlas_options options = small_texture();
  options.bound.area_scale = 1.3;
  for(const Indexed_triangle_mesh& mesh : {torus(30, 15), sphere(3)}) {
    options.max_charts = 0;
    const std::size_t needed = SMT::build_texture_atlas(mesh, options).report.charts.size();
    for(const std::size_t most : {std::size_t(4), needed - 1, needed + 10}) {
      options.max_charts = most;
      const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
      ASSERT_EQ(result.error, "");
      EXPECT_EQ(error_in_atlas(mesh, result.atlas), "");
      EXPECT_LE(result.report.charts.size(), most);
      bool is_within = true;
      for(const SMT::Chart_report& chart : result.report.charts)
        is_within = is_within && chart.distortion.is_within(options.bound);
      EXPECT_TRUE(is_within || most < needed);
      EXPECT_FALSE(is_within && most == 4);
    }
  }
}

TEST(Texture_atlas, says_what_is_wrong_with_a_mesh)
{
  const auto expect_error = [](const Indexed_triangle_mesh& mesh, const std::string& words) {
    const SMT::Texture_atlas_options options = small_texture();
    EXPECT_NE(SMT::build_texture_atlas(mesh, options).error.find(words), std::string::npos);
    SMT::Face_charts one; // which is looked at only if the mesh is well
    one.chart.assign(mesh.triangles.size(), 0);
    one.seams.assign(mesh.triangles.size(), 0);
    EXPECT_NE(SMT::build_texture_atlas(mesh, options, SMT::Given_charts_segmenter(one))
                .error.find(words), std::string::npos);
  };
  expect_error({}, "no triangles");
  Indexed_triangle_mesh isolated = grid(3, 3);
  isolated.points.emplace_back(0., 0., 1.);
  expect_error(isolated, "vertex 16");
  Indexed_triangle_mesh infinite = grid(3, 3);
  infinite.points[5] = Point_3(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  expect_error(infinite, "vertex 5");
  Indexed_triangle_mesh fin = grid(1, 1);
  fin.points.emplace_back(0.5, 0.5, 1.);
  fin.triangles.push_back({0, 3, 4});
  expect_error(fin, "vertex");
  Indexed_triangle_mesh beyond = grid(3, 3);
  beyond.triangles[7][2] = 16;
  expect_error(beyond, "triangle 7");
  Indexed_triangle_mesh folded = grid(3, 3);
  folded.triangles[8][1] = folded.triangles[8][0];
  expect_error(folded, "triangle 8");
}

TEST(Texture_atlas, can_be_cancelled)
{
  for(const double limit : {0., 0.3, 0.5, 0.9}) {
    SMT::Texture_atlas_options options = small_texture();
    options.progress = [limit](double part) { return part < limit; };
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(sphere(3), options);
    EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::CANCELLED);
    EXPECT_EQ(result.error, "cancelled");
    EXPECT_TRUE(result.atlas.mesh.uv.empty());
  }
}

// --- Limits

// Hubs, needles, slivers and dust; the check of overlaps is quadratic at a hub
TEST(Texture_atlas, is_valid_on_bad_surfaces)
{
  for(const auto& [name, mesh] : bad_surfaces(1200, seed)) {
    SMT::Texture_atlas_options options = small_texture();
    options.packing.width = options.packing.height = 512;
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << seed_text;
    EXPECT_FALSE(result.report.stopped_early) << name;
  }
}

// The distances of its triangles from the seeds differ in their last bits only
TEST(Texture_atlas, is_found_on_a_grid_that_is_nearly_a_line)
{
  for(const Vertex_index side : {29u, 42u}) {
    const Indexed_triangle_mesh mesh = flattened_grid(side, 1e-8);
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh);
    ASSERT_EQ(result.error, "") << side;
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << side;
  }
}

TEST(Texture_atlas, is_valid_when_the_time_is_over)
{
  const std::vector<Named_mesh> meshes
    = {{"torus", with_noise(torus(30, 15), 0.02, seed)},
       {"sphere and torus", joined(sphere(3), torus(16, 8))},
       {"grid", with_hills(irregular_grid(20, 20, seed), 8., seed)},
       {"triangles", single_triangles(300, seed)}};
  for(const auto& [name, mesh] : meshes) {
    SMT::Texture_atlas_options options = small_texture();
    options.packing.width = options.packing.height = 512;
    const SMT::Texture_atlas_result best = SMT::build_texture_atlas(mesh, options);
    EXPECT_FALSE(best.report.stopped_early) << name;
    for(const double limit : {1e-9, 0.05, 1e6}) {
      options.seconds = limit;
      const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
      ASSERT_EQ(result.error, "") << name << ", " << limit;
      EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name << ", " << limit << seed_text;
      if(limit < 1e-3) {
        EXPECT_TRUE(result.report.stopped_early) << name;
      }
      if(limit > 1e3) {
        EXPECT_TRUE(are_equal(result.atlas, best.atlas)) << name;
        EXPECT_FALSE(result.report.stopped_early) << name;
      }
    }
  }
  for(const double bad : {-1., std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity()}) {
    SMT::Texture_atlas_options options;
    options.seconds = bad;
    EXPECT_EQ(SMT::build_texture_atlas(sphere(1), options).status,
              CGAL::Indexed_mesh::Mesh_status::BAD_OPTIONS);
  }
}

TEST(Texture_atlas, does_not_depend_on_very_small_or_large_units)
{
  const Indexed_triangle_mesh mesh = with_noise(torus(40, 20), 0.02, seed);
  SMT::Texture_atlas_options options = small_texture();
  const SMT::Texture_atlas_result usual = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(usual.error, "");
  for(const int power : {-498, -300, -80, -45, 45, 80, 300, 498}) {
    const double unit = std::ldexp(1., power);
    const Indexed_triangle_mesh other = scaled(mesh, unit);
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(other, options);
    ASSERT_EQ(result.error, "") << power;
    EXPECT_TRUE(are_equal(result.atlas, usual.atlas)) << power;
    EXPECT_EQ(result.atlas.mesh.points, other.points) << power;
    EXPECT_NEAR(result.report.seam_length / unit, usual.report.seam_length,
                1e-9 * usual.report.seam_length);
    EXPECT_NEAR(result.report.texels_per_unit * unit, usual.report.texels_per_unit,
                1e-9 * usual.report.texels_per_unit);
    EXPECT_NEAR(result.report.charts[0].border_length / unit,
                usual.report.charts[0].border_length, 1e-9 * usual.report.seam_length);
  }
}

} // namespace texture_atlas_test
