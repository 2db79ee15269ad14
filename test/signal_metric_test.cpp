// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics of surfaces blended with those of signals: what defines the tensors, that no unit counts, and
// what is said of bad input.

#include <support/signal_metrics.h>

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace signal_metric_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
using CGAL::Indexed_mesh::Space_tensor;
using CGAL::Surface_mesh_texturing::image_signal;
using CGAL::Surface_mesh_texturing::normal_signal;

constexpr double infinity = std::numeric_limits<double>::infinity();

double area_in(const Indexed_triangle_mesh& mesh, const Tensors& metric)
{
  double area = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    area += Reference_triangle<double>::of_points(mesh.points[v[0]], mesh.points[v[1]],
                                                  mesh.points[v[2]], metric[t]).area();
  }
  return area;
}

double largest_difference(const Tensors& a, const Tensors& b)
{
  double largest = a.size() == b.size() ? 0. : infinity;
  for(std::size_t t = 0; t < a.size() && t < b.size(); ++t) {
    const Space_tensor d = a[t] + b[t] * -1.;
    for(const double x : {d.xx, d.xy, d.xz, d.yy, d.yz, d.zz})
      largest = std::max(largest, std::abs(x));
  }
  return largest;
}

// --- Tensors

// What defines T: along each edge the signal changes by the square root of e T e.
TEST(Signal_metric, tensors_measure_the_change_along_edges)
{
  const Indexed_triangle_mesh mesh = with_noise(signal_hills(), 0.2, signal_seed);
  Random random(signal_seed);
  std::vector<double> values;
  for(std::size_t i = 0; i < 4 * mesh.points.size(); ++i)
    values.push_back(uniform(random, -1., 1.));
  const Face_tensors signal = vertex_signal(mesh, values, 4);
  ASSERT_TRUE(signal.is_ok()) << signal.error;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const auto v = mesh.triangles[t][c], w = mesh.triangles[t][(c + 1) % 3];
      double change = 0.;
      for(int k = 0; k < 4; ++k)
        change += std::pow(values[4 * v + k] - values[4 * w + k], 2);
      const auto e = mesh.points[w] - mesh.points[v];
      ASSERT_NEAR(signal.tensors[t].product(e, e), change, 1e-9 * (1. + change));
    }
}

// Of a plane the normals do not change, on a cylinder only across, by one over the radius.
TEST(Signal_metric, normals_of_a_cylinder_change_across)
{
  const double radius = 15.;
  const Indexed_triangle_mesh mesh = rolled_up(grid(200, 20), radius, 0.);
  const Face_tensors signal = normal_signal(mesh);
  ASSERT_TRUE(signal.is_ok());
  std::size_t inside = 0;
  const std::vector<bool> is_border = border_vertices_of(mesh);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if(is_border[v[0]] || is_border[v[1]] || is_border[v[2]])
      continue;
    ++inside;
    EXPECT_NEAR(signal.tensors[t].trace() * radius * radius, 1., 0.01);
  }
  EXPECT_GT(inside, 1000u);
  const Face_tensors flat = normal_signal(grid(5, 5));
  for(const Space_tensor& t : flat.tensors)
    EXPECT_EQ(t.trace(), 0.);
}

// An image on texture coordinates is the signal that has its values at the vertices.
TEST(Signal_metric, an_image_is_a_signal)
{
  const Indexed_triangle_mesh mesh = irregular_grid(40, 40, signal_seed);
  CGAL::Surface_mesh_texturing::Textured_triangle_mesh textured;
  textured.points = mesh.points;
  textured.triangles = textured.wedges = mesh.triangles;
  const auto wave = [](double u, double v) { return std::sin(3. * u + 1.) * std::cos(2. * v); };
  std::vector<double> values;
  for(const Point_3& p : mesh.points) {
    textured.uv.emplace_back(0.1 + p.x() / 60., 0.1 + p.y() / 55.);
    values.push_back(wave(textured.uv.back().x(), textured.uv.back().y()));
  }
  CGAL::Surface_mesh_texturing::Texture_image image = {512, 384, 1, {}};
  for(std::size_t y = 0; y < image.height; ++y)
    for(std::size_t x = 0; x < image.width; ++x)
      image.texels.push_back(float(wave((double(x) + 0.5) / 512., 1. - (double(y) + 0.5) / 384.)));
  const Face_tensors of_image = image_signal(textured, image);
  const Face_tensors of_values = vertex_signal(mesh, values, 1);
  ASSERT_TRUE(of_image.is_ok()) << of_image.error;
  double largest = 0.;
  for(const Space_tensor& t : of_values.tensors)
    largest = std::max(largest, t.trace());
  EXPECT_LT(largest_difference(of_image.tensors, of_values.tensors), 0.1 * largest);
  image.width = image.height = 1; // a single texel shows nothing
  image.texels.resize(1);
  for(const Space_tensor& t : image_signal(textured, image).tensors)
    EXPECT_EQ(t.trace(), 0.);
}

// --- Metrics

TEST(Signal_metric, metric_keeps_the_area_and_blends)
{
  const Indexed_triangle_mesh mesh = signal_hills();
  const double area = area_in(mesh, Tensors(mesh.triangles.size(), Space_tensor::identity()));
  for(const double weight : {0.1, 1., 10., 1000.}) {
    const Tensors metric = normals_metric(mesh, weight);
    ASSERT_EQ(metric.size(), mesh.triangles.size());
    EXPECT_NEAR(area_in(mesh, metric), area, 1e-9 * area);
  }
  EXPECT_TRUE(normals_metric(mesh, 0.).empty());
  EXPECT_TRUE(normals_metric(grid(7, 6)).empty());
  std::vector<double> importance(mesh.triangles.size(), 3.);
  const Tensors even = importance_metric(mesh, importance).tensors;
  EXPECT_LT(largest_difference(even, Tensors(even.size(), Space_tensor::identity())), 1e-12);
  importance.assign(importance.size(), 0.);
  EXPECT_TRUE(importance_metric(mesh, importance).tensors.empty());
  importance[0] = 1.;
  EXPECT_GT(importance_metric(mesh, importance).tensors[0].xx, 100.);
}

TEST(Signal_metric, no_unit_counts)
{
  const Indexed_triangle_mesh mesh = signal_hills();
  const auto wave = [](const Point_3& p) { return std::sin(0.3 * p.x()) + 0.2 * p.z(); };
  const std::vector<double> values = values_of(mesh, wave);
  const Tensors metric = signal_metric(mesh, vertex_signal(mesh, values, 1)).tensors;
  Low_stretch_options options;
  options.metric = metric;
  const Low_stretch_map here = low_stretch_map(mesh, options);
  ASSERT_TRUE(here.is_ok()) << here.error;
  for(const double unit : {1e-30, std::ldexp(1., -60), 7., std::ldexp(1., 90)}) {
    const Indexed_triangle_mesh other = scaled(mesh, unit);
    for(const double gain : {1e-20, 1., 1e20}) {
      std::vector<double> louder = values;
      for(double& x : louder)
        x *= gain;
      const Tensors same = signal_metric(other, vertex_signal(other, louder, 1)).tensors;
      EXPECT_LT(largest_difference(metric, same), 1e-9) << unit << ' ' << gain;
    }
    const Low_stretch_map there = low_stretch_map(other, options);
    ASSERT_TRUE(there.is_ok()) << there.error;
    EXPECT_NEAR(here.report.energy, there.report.energy, 1e-3 * here.report.energy);
    int exponent;
    const bool is_exact = std::frexp(unit, &exponent) == 0.5; // a power of 2 rounds nothing
    for(std::size_t v = 0; is_exact && v < here.uv.size(); ++v)
      ASSERT_EQ(here.uv[v].x() * unit, there.uv[v].x());
  }
}

// On coarser meshes a vertex has the mean over what it stands for, and its own again afterwards.
TEST(Signal_metric, collapses_take_means_and_give_them_back)
{
  const Indexed_triangle_mesh mesh = signal_hills();
  const Tensors metric = normals_metric(mesh);
  CGAL::Indexed_mesh::Vertex_rings left;
  const auto pm = CGAL::Surface_mesh_parameterization::internal::collapse_to_few(
    mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), {}, 40,
    CGAL::Surface_mesh_parameterization::internal::Border_rule::ANY, [](double) { return true; }, left);
  typedef CGAL::Surface_mesh_parameterization::internal::Vertex_tensors Vertex_tensors;
  const Vertex_tensors before(mesh, metric);
  Vertex_tensors tensors = before;
  tensors.collapse(pm.collapses);
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(const auto& c : pm.collapses)
    is_gone[c.removed] = true;
  double lowest = infinity, highest = 0., least = infinity, greatest = 0.;
  for(std::size_t v = 0; v < is_gone.size(); ++v) {
    least = std::min(least, before[v].trace());
    greatest = std::max(greatest, before[v].trace());
    if(!is_gone[v]) {
      lowest = std::min(lowest, tensors[v].trace());
      highest = std::max(highest, tensors[v].trace());
    }
  }
  EXPECT_GE(lowest, least);
  EXPECT_LT(highest, 0.9 * greatest); // of means
  for(std::size_t i = pm.collapses.size(); i-- > 0;)
    tensors.undo(i, pm.collapses[i]);
  for(std::size_t v = 0; v < is_gone.size(); ++v)
    ASSERT_EQ(tensors[v].xy, before[v].xy) << v;
}

// --- Bad input

TEST(Signal_metric, says_what_is_wrong)
{
  const Indexed_triangle_mesh mesh = signal_hills();
  const std::size_t n = mesh.points.size(), faces = mesh.triangles.size();
  const auto expect = [](const CGAL::Indexed_mesh::Mesh_outcome& outcome, Mesh_status status,
                         const std::string& text) {
    EXPECT_EQ(outcome.status, status);
    EXPECT_NE(outcome.error.find(text), std::string::npos) << outcome.error;
  };
  std::vector<double> values(n, 1.);
  expect(vertex_signal(mesh, values, 2), Mesh_status::BAD_OPTIONS, "values of the signal instead of");
  values[7] = infinity;
  const Face_tensors bad = vertex_signal(mesh, values, 1);
  expect(bad, Mesh_status::BAD_OPTIONS, "vertex 7 has a value of the signal that is not a finite");
  expect(signal_metric(mesh, bad), Mesh_status::BAD_OPTIONS, "vertex 7");
  Indexed_triangle_mesh broken = mesh;
  broken.triangles[3][1] = Vertex_index(n);
  expect(normal_signal(broken), Mesh_status::BAD_MESH, "triangle 3");
  Face_tensors signal = normal_signal(mesh);
  expect(signal_metric(mesh, signal, -1.), Mesh_status::BAD_OPTIONS, "the weight of the signal");
  signal.tensors[5].xx = -infinity;
  expect(signal_metric(mesh, signal), Mesh_status::BAD_OPTIONS, "the signal of triangle 5");
  signal.tensors.pop_back();
  expect(signal_metric(mesh, signal), Mesh_status::BAD_OPTIONS, "tensors, but there are");
  std::vector<double> importance(faces, 1.);
  importance[2] = -1.;
  expect(importance_metric(mesh, importance), Mesh_status::BAD_OPTIONS, "the importance of triangle 2");
  importance.pop_back();
  expect(importance_metric(mesh, importance), Mesh_status::BAD_OPTIONS, "numbers of importance");

  Low_stretch_options low;
  HLSCM_options options;
  low.metric = options.metric = normals_metric(mesh);
  low.metric[11] = options.metric[11] = Space_tensor::identity(-1.);
  expect(low_stretch_map(mesh, low), Mesh_status::BAD_OPTIONS, "the metric of triangle 11 is not pos");
  expect(conformal_map(mesh, options), Mesh_status::BAD_OPTIONS, "the metric of triangle 11");
  low.metric[11].xy = options.metric[11].xy = std::nan("");
  expect(low_stretch_map(mesh, low), Mesh_status::BAD_OPTIONS, "the metric of triangle 11 is not pos");
  low.metric.pop_back();
  expect(low_stretch_map(mesh, low), Mesh_status::BAD_OPTIONS, "the metric has");
  options.metric = normals_metric(mesh);
  options.weights = Conformal_weights::CGAL_LSCM;
  expect(conformal_map(mesh, options), Mesh_status::BAD_OPTIONS, "weights of CGAL");

  CGAL::Surface_mesh_texturing::Textured_triangle_mesh textured;
  textured.points = mesh.points;
  textured.triangles = textured.wedges = mesh.triangles;
  CGAL::Surface_mesh_texturing::Texture_image image = {2, 2, 1, {0.f, 0.f, 0.f, 1.f}};
  EXPECT_FALSE(image_signal(textured, image).is_ok()); // no texture coordinates
  textured.uv.assign(n, CGAL::Simple_cartesian<double>::Point_2(0.5, 0.5));
  EXPECT_TRUE(image_signal(textured, image).is_ok());
  image.texels[1] = float(infinity);
  expect(image_signal(textured, image), Mesh_status::BAD_OPTIONS, "the image has a value");
  image.texels.pop_back();
  expect(image_signal(textured, image), Mesh_status::BAD_OPTIONS, "the image");
}

} // namespace signal_metric_test
