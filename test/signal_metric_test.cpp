// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics of surfaces blended with those of signals, and maps in them: what defines the tensors, what
// is known of the maps, that no unit counts, and what is said of bad input.

#include <support/chart_generators.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
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

constexpr std::uint64_t seed = 20261123;
constexpr double infinity = std::numeric_limits<double>::infinity();
typedef std::vector<Space_tensor> Tensors;
typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;

Indexed_triangle_mesh hills() { return with_hills(irregular_grid(40, 30, seed), 6., seed + 1); }

Tensors normals_metric(const Indexed_triangle_mesh& mesh, double weight = 4.)
{
  return signal_metric(mesh, normal_signal(mesh), weight).tensors;
}

template <class F>
std::vector<double> values_of(const Indexed_triangle_mesh& mesh, const F& f)
{
  std::vector<double> values;
  for(const Point_3& p : mesh.points)
    values.push_back(f(p));
  return values;
}

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

// By how much two maps differ when the first is brought onto the second by a motion, or a similarity,
// in parts of the size of the second.
double difference_up_to(const Uv& a, const Uv& b, bool may_scale)
{
  typedef std::complex<double> Complex;
  const double n = double(a.size());
  Complex mean_a = 0., mean_b = 0., product = 0.;
  const auto z = [](const auto& p) { return Complex(p.x(), p.y()); };
  for(std::size_t v = 0; v < a.size(); ++v) {
    mean_a += z(a[v]) / n;
    mean_b += z(b[v]) / n;
  }
  double aa = 0., bb = 0., largest = 0.;
  for(std::size_t v = 0; v < a.size(); ++v) {
    product += std::conj(z(a[v]) - mean_a) * (z(b[v]) - mean_b);
    aa += std::norm(z(a[v]) - mean_a);
    bb += std::norm(z(b[v]) - mean_b);
  }
  const Complex factor = may_scale ? product / aa : product / std::abs(product);
  for(std::size_t v = 0; v < a.size(); ++v)
    largest = std::max(largest, std::abs(factor * (z(a[v]) - mean_a) - (z(b[v]) - mean_b)));
  return largest / std::sqrt(bb / n);
}

// --- Tensors

// What defines T: along each edge the signal changes by the square root of e T e.
TEST(Signal_metric, tensors_measure_the_change_along_edges)
{
  const Indexed_triangle_mesh mesh = with_noise(hills(), 0.2, seed);
  Random random(seed);
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
  const Indexed_triangle_mesh mesh = irregular_grid(40, 40, seed);
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
  const Indexed_triangle_mesh mesh = hills();
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
  const Indexed_triangle_mesh mesh = hills();
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
  const Indexed_triangle_mesh mesh = hills();
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
    tensors.undo(pm.collapses[i]);
  for(std::size_t v = 0; v < is_gone.size(); ++v)
    ASSERT_EQ(tensors[v].xy, before[v].xy) << v;
}

// --- Maps

// The square with the signal u = k x becomes the rectangle that is analytically known.
TEST(Signal_metric, a_ramp_stretches_the_square)
{
  const Indexed_triangle_mesh mesh = irregular_grid(30, 30, seed);
  for(const double weight : {0.5, 4., 50.}) {
    const Face_tensors signal
      = vertex_signal(mesh, values_of(mesh, [](const Point_3& p) { return 17. * p.x(); }), 1);
    const Tensors metric = signal_metric(mesh, signal, weight).tensors;
    const double stretch = std::pow(1. + 2. * weight, 0.25);
    Uv rectangle;
    for(const Point_3& p : mesh.points)
      rectangle.emplace_back(p.x() * stretch, p.y() / stretch);
    Low_stretch_options low;
    low.metric = metric;
    low.tolerance = 1e-10;
    const Low_stretch_map isometric = low_stretch_map(mesh, low);
    ASSERT_TRUE(isometric.is_ok()) << isometric.error;
    EXPECT_LT(difference_up_to(isometric.uv, rectangle, false), 1e-5) << weight;
    EXPECT_NEAR(isometric.report.energy, Symmetric_dirichlet_energy().value(2., 1.), 1e-8);
    for(const Conformal_method method : {Conformal_method::HLSCM, Conformal_method::DIRECT,
                                         Conformal_method::SPECTRAL}) {
      HLSCM_options options;
      options.metric = metric;
      options.method = method;
      options.coarsest_size = 100;
      options.tolerance = 1e-6;
      const Conformal_map conformal = conformal_map(mesh, options);
      ASSERT_EQ(conformal.error, "");
      EXPECT_LT(difference_up_to(conformal.uv, rectangle, true), 1e-4) << weight << ' ' << int(method);
    }
  }
}

// The minimiser by a factorization of the matrix that lengths in the metric give.
Uv map_by_factorization(const Indexed_triangle_mesh& mesh, const Tensors& metric,
                        const std::vector<HLSCM_pin>& pins)
{
  typedef std::complex<double> Complex;
  std::vector<Eigen::Triplet<Complex>> entries;
  const int n = int(mesh.points.size());
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    double ll[3];
    for(int c = 0; c < 3; ++c) {
      const auto e = mesh.points[v[(c + 2) % 3]] - mesh.points[v[(c + 1) % 3]];
      ll[c] = metric[t].product(e, e);
    }
    const double sum = ll[0] + ll[1] + ll[2];
    const double squares = ll[0] * ll[0] + ll[1] * ll[1] + ll[2] * ll[2];
    const double area = 0.25 * std::sqrt(sum * sum - 2. * squares);
    for(int c = 0; c < 3; ++c) {
      const int i = int(v[(c + 1) % 3]), j = int(v[(c + 2) % 3]);
      const double w = (sum - 2. * ll[c]) / (8. * area); // half the cotangent at c
      entries.emplace_back(i, i, w);
      entries.emplace_back(j, j, w);
      entries.emplace_back(i, j, Complex(-w, 0.5));
      entries.emplace_back(j, i, Complex(-w, -0.5));
    }
  }
  std::vector<int> rank(n, -1);
  Eigen::VectorXcd held = Eigen::VectorXcd::Zero(n);
  for(const HLSCM_pin& pin : pins) {
    rank[pin.vertex] = -2;
    held[int(pin.vertex)] = Complex(pin.u, pin.v);
  }
  int free = 0;
  for(int& r : rank)
    r = r == -2 ? -2 : free++;
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(free);
  std::vector<Eigen::Triplet<Complex>> inner;
  for(const auto& e : entries) {
    if(rank[e.row()] >= 0 && rank[e.col()] >= 0)
      inner.emplace_back(rank[e.row()], rank[e.col()], e.value());
    else if(rank[e.row()] >= 0)
      right[rank[e.row()]] -= e.value() * held[e.col()];
  }
  Eigen::SparseMatrix<Complex> matrix(free, free);
  matrix.setFromTriplets(inner.begin(), inner.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> factorization(matrix);
  const Eigen::VectorXcd z = factorization.solve(right);
  Uv uv;
  for(int v = 0; v < n; ++v) {
    const Complex value = rank[v] >= 0 ? z[rank[v]] : held[v];
    uv.emplace_back(value.real(), value.imag());
  }
  return uv;
}

TEST(Signal_metric, conformal_map_is_the_global_minimum)
{
  for(const Indexed_triangle_mesh& mesh :
      {hills(), with_noise(with_hills(irregular_grid(80, 60, seed), 9., seed + 2), 0.15, seed + 3)}) {
    const Tensors metric = normals_metric(mesh);
    const std::vector<HLSCM_pin> pins = {{0, 0., 0.}, {mesh.points.size() - 1, 1., 0.5}};
    const Uv exact = map_by_factorization(mesh, metric, pins);
    const Uv other = map_by_factorization(mesh, Tensors(metric.size(), Space_tensor::identity()), pins);
    EXPECT_GT(difference_up_to(other, exact, false), 1e-2); // the metric counts
    for(const Conformal_method method : {Conformal_method::HLSCM, Conformal_method::DIRECT}) {
      HLSCM_options options;
      options.method = method;
      options.metric = metric;
      options.coarsest_size = 100;
      options.tolerance = 1e-13;
      const Conformal_map map = conformal_map(mesh, pins, options);
      ASSERT_EQ(map.error, "");
      EXPECT_LT(map.report.iterations, 60u);
      double largest = 0.;
      for(std::size_t v = 0; v < exact.size(); ++v)
        largest = std::max(largest, std::sqrt(squared_distance(map.uv[v], exact[v])));
      EXPECT_LT(largest, 1e-5) << int(method);
    }
  }
}

// Without a flip, and of the energy that is reported.
TEST(Signal_metric, low_stretch_maps_have_no_flip)
{
  for(const Named_mesh& chart : curved_charts(seed)) {
    Low_stretch_options options;
    options.metric = normals_metric(chart.mesh, 16.);
    const Low_stretch_map map = low_stretch_map(chart.mesh, options);
    ASSERT_TRUE(map.is_ok()) << chart.name << ": " << map.error;
    double sum = 0., area = 0.;
    for(std::size_t t = 0; t < chart.mesh.triangles.size(); ++t) {
      const auto& v = chart.mesh.triangles[t];
      const auto reference = Reference_triangle<double>::of_points(
        chart.mesh.points[v[0]], chart.mesh.points[v[1]], chart.mesh.points[v[2]], options.metric[t]);
      const auto place = [&](int c) { return Plane_vector<double>{map.uv[v[c]].x(), map.uv[v[c]].y()}; };
      const Plane_jacobian<double> j(reference, {place(0), place(1), place(2)});
      ASSERT_GT(j.determinant(), 0.) << chart.name;
      sum += reference.area() * Symmetric_dirichlet_energy().value(j.squared_norm(), j.determinant());
      area += reference.area();
    }
    EXPECT_NEAR(sum / area, map.report.energy, 1e-6 * map.report.energy) << chart.name;
  }
}

// What low-stretch maps in the metric of a signal are for: the signal stretch of Sander et al. for the
// texture that is used is less than that of the map in the surface's own metric.
double signal_stretch(const Indexed_triangle_mesh& mesh, const Tensors& signal, const Uv& uv)
{
  double stretch = 0., texture = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto a = mesh.points[v[1]] - mesh.points[v[0]], b = mesh.points[v[2]] - mesh.points[v[0]];
    const auto p = uv[v[1]] - uv[v[0]], q = uv[v[2]] - uv[v[0]];
    const double d = p.x() * q.y() - p.y() * q.x(), n = std::sqrt(cross_product(a, b).squared_length());
    const auto du = (q.y() * a - p.y() * b) / d, dv = (p.x() * b - q.x() * a) / d; // of the surface
    stretch += 0.5 * n * (signal[t].product(du, du) + signal[t].product(dv, dv));
    texture += 0.5 * d;
  }
  return stretch * texture;
}

TEST(Signal_metric, lowers_the_signal_stretch)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(60, 50, seed), 12., seed + 1);
  const auto bump = [](const Point_3& p) {
    return std::exp(-0.05 * (std::pow(p.x() - 20., 2) + std::pow(p.y() - 20., 2)));
  };
  const Face_tensors signal = vertex_signal(mesh, values_of(mesh, bump), 1);
  Low_stretch_options options;
  const double without = signal_stretch(mesh, signal.tensors, low_stretch_map(mesh, options).uv);
  double last = without;
  for(const double weight : {1., 4., 16.}) {
    options.metric = signal_metric(mesh, signal, weight).tensors;
    const double with = signal_stretch(mesh, signal.tensors, low_stretch_map(mesh, options).uv);
    EXPECT_LT(with, last) << weight;
    last = with;
  }
  EXPECT_LT(last, 0.5 * without);
}

TEST(Signal_metric, importance_is_density)
{
  const Indexed_triangle_mesh mesh = irregular_grid(40, 40, seed);
  std::vector<double> importance(mesh.triangles.size(), 0.);
  for(std::size_t t = 0; t < importance.size(); ++t)
    importance[t] = mesh.points[mesh.triangles[t][0]].x() < 20. ? 1. : 0.;
  Low_stretch_options options;
  options.metric = importance_metric(mesh, importance, 4.).tensors;
  const Low_stretch_map map = low_stretch_map(mesh, options);
  ASSERT_TRUE(map.is_ok()) << map.error;
  double areas[2] = {0., 0.};
  for(std::size_t t = 0; t < importance.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto p = map.uv[v[1]] - map.uv[v[0]], q = map.uv[v[2]] - map.uv[v[0]];
    areas[int(importance[t])] += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  EXPECT_GT(areas[1] / areas[0], 2.); // 9 without what keeps neighbours together
  EXPECT_LT(areas[1] / areas[0], 9.);
}

// A metric of identities is that of the surface, up to rounding.
TEST(Signal_metric, the_identity_is_the_surface)
{
  const Indexed_triangle_mesh mesh = hills();
  Low_stretch_options low;
  const Low_stretch_map without = low_stretch_map(mesh, low);
  low.metric.assign(mesh.triangles.size(), Space_tensor::identity());
  const Low_stretch_map with = low_stretch_map(mesh, low);
  EXPECT_LT(difference_up_to(with.uv, without.uv, false), 1e-3);
  EXPECT_NEAR(with.report.energy, without.report.energy, 1e-3 * without.report.energy);
  HLSCM_options options;
  options.coarsest_size = 100;
  const Conformal_map plain = conformal_map(mesh, options);
  options.metric = low.metric;
  const Conformal_map same = conformal_map(mesh, options);
  for(std::size_t v = 0; v < plain.uv.size(); ++v)
    ASSERT_LT(squared_distance(plain.uv[v], same.uv[v]), 1e-16);
}

bool is_equal(const Uv& a, const Uv& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

TEST(Signal_metric, equal_bits_for_any_threads)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(200, 150, seed), 12., seed + 1);
  Low_stretch_options low;
  HLSCM_options options;
  options.metric = low.metric = normals_metric(mesh);
  Uv first_low, first_conformal;
  for(const unsigned int threads : {1u, 2u, 3u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    const Uv of_low = low_stretch_map(mesh, low).uv, conformal = conformal_map(mesh, options).uv;
    if(threads == 1) {
      first_low = of_low;
      first_conformal = conformal;
    }
    EXPECT_TRUE(is_equal(of_low, first_low)) << threads;
    EXPECT_TRUE(is_equal(conformal, first_conformal)) << threads;
  }
}

// The tensors find their faces in meshes of graphs, and of several components.
TEST(Signal_metric, graphs_and_components)
{
  const Indexed_triangle_mesh mesh = hills();
  const Tensors metric = normals_metric(mesh);
  Surface_mesh graph = to_surface_mesh(mesh);
  const auto uv = graph.add_property_map<Surface_mesh::Vertex_index,
                                         CGAL::Simple_cartesian<double>::Point_2>("v:uv").first;
  HLSCM_options options;
  options.metric = metric;
  HLSCM_parameterizer_3<Surface_mesh> parameterizer(options);
  const auto bhd = border_halfedge(graph);
  ASSERT_EQ(CGAL::Surface_mesh_parameterization::parameterize(graph, parameterizer, bhd, uv), OK);
  const Uv expected = conformal_map(mesh, options).uv;
  Low_stretch_options low;
  low.metric = metric;
  for(const auto v : graph.vertices())
    ASSERT_EQ(uv[v], expected[v]);
  Low_stretch_parameterizer_3<Surface_mesh> stretch(low);
  ASSERT_EQ(CGAL::Surface_mesh_parameterization::parameterize(graph, stretch, bhd, uv), OK);
  const Uv expected_low = low_stretch_map(mesh, low).uv;
  for(const auto v : graph.vertices())
    ASSERT_EQ(uv[v], expected_low[v]);

  Indexed_triangle_mesh two = mesh; // the second is a mirror image in the order of its faces
  const Vertex_index n = Vertex_index(mesh.points.size());
  for(const Point_3& p : mesh.points)
    two.points.emplace_back(p.x() + 100., p.y(), p.z());
  Tensors of_two = metric;
  for(std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& v = mesh.triangles[t];
    two.triangles.push_back({v[0] + n, v[1] + n, v[2] + n});
    of_two.push_back(metric[t]);
  }
  CGAL::Surface_mesh_texturing::Surface_map_options surface;
  surface.solver = options;
  surface.solver.metric = of_two;
  const auto map = CGAL::Surface_mesh_texturing::map_surface(two, surface);
  ASSERT_TRUE(map.is_ok()) << map.error;
  Uv sorted(n, CGAL::Simple_cartesian<double>::Point_2(0., 0.));
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      sorted[two.triangles[mesh.triangles.size() + t][c] - n]
        = map.mesh.uv[map.mesh.wedges[mesh.triangles.size() + t][c]];
  EXPECT_LT(difference_up_to(sorted, expected, true), 0.05);
  surface.solver.metric.pop_back();
  EXPECT_NE(CGAL::Surface_mesh_texturing::map_surface(two, surface).error.find("tensors"),
            std::string::npos);
}

// Charts of an atlas get the texture that the metric gives them, without a flip.
TEST(Signal_metric, charts_of_an_atlas_are_adapted)
{
  namespace SMT = CGAL::Surface_mesh_texturing;
  const Indexed_triangle_mesh mesh = with_noise(sphere(4), 0.01, seed);
  std::vector<double> importance(mesh.triangles.size(), 0.);
  const auto is_above = [&](std::size_t t) { return mesh.points[mesh.triangles[t][0]].z() > 0.; };
  for(std::size_t t = 0; t < importance.size(); ++t)
    importance[t] = is_above(t) ? 1. : 0.;
  SMT::Texture_atlas_options options;
  const auto ratio = [&](const SMT::Texture_atlas& atlas) { // of the texture above to that below
    double areas[2] = {0., 0.};
    for(std::size_t t = 0; t < importance.size(); ++t) {
      const auto& w = atlas.mesh.wedges[t];
      const auto& uv = atlas.mesh.uv;
      const auto p = uv[w[1]] - uv[w[0]], q = uv[w[2]] - uv[w[0]];
      const double area = p.x() * q.y() - p.y() * q.x();
      EXPECT_GT(area, 0.);
      areas[is_above(t) ? 1 : 0] += area;
    }
    return areas[1] / areas[0];
  };
  const SMT::Texture_atlas_result even = SMT::build_texture_atlas(mesh, options);
  ASSERT_TRUE(even.is_ok()) << even.error;
  EXPECT_NEAR(ratio(even.atlas), 1., 0.2);
  options.metric = importance_metric(mesh, importance, 4.).tensors;
  const SMT::Texture_atlas_result adapted = SMT::build_texture_atlas(mesh, options);
  ASSERT_TRUE(adapted.is_ok()) << adapted.error;
  EXPECT_GT(ratio(adapted.atlas), 2.);
  for(const auto& chart : adapted.report.charts)
    EXPECT_TRUE(chart.is_one_to_one);
  options.metric[3] = Space_tensor();
  EXPECT_NE(SMT::build_texture_atlas(mesh, options).error.find("the metric of triangle 3"),
            std::string::npos);
  options.metric.pop_back();
  EXPECT_NE(SMT::build_texture_atlas(mesh, options).error.find("tensors"), std::string::npos);
}

// A chart with two borders, one far in the other, which no map from nothing finds: the adapted one is
// one-to-one, and no worse than the chart was.
TEST(Signal_metric, adapted_charts_are_not_worse)
{
  namespace SMT = CGAL::Surface_mesh_texturing;
  const std::size_t around = 24, rows = 200;
  const Indexed_triangle_mesh tube = cylinder(around, rows);
  Tensors metric;
  for(const auto& t : tube.triangles)
    metric.push_back(Space_tensor::identity(t[0] < around * rows / 2 ? 4. : 1.));
  SMT::internal::Mapped_chart chart;
  chart.chart.mesh = tube;
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(tube.triangles);
  for(std::uint32_t t = 0; t < tube.triangles.size(); ++t) {
    chart.chart.triangles.push_back(t);
    for(std::uint32_t c = 0; c < 3; ++c)
      if(adjacency.opposite(t, c) == CGAL::Indexed_mesh::no_halfedge)
        chart.chart.border.push_back(3 * t + c);
  }
  for(std::size_t v = 0; v < tube.points.size(); ++v) {
    const double r = 1. + 0.2 * double(rows - v / around);
    chart.uv.emplace_back(r * tube.points[v].x(), r * tube.points[v].y());
  }
  const auto energy_of = [&](const Uv& uv) {
    double sum = 0.;
    for(std::size_t t = 0; t < tube.triangles.size(); ++t) {
      const auto& v = tube.triangles[t];
      const auto r = Reference_triangle<double>::of_points(tube.points[v[0]], tube.points[v[1]],
                                                           tube.points[v[2]], metric[t]);
      const auto p = [&](int c) { return Plane_vector<double>{uv[v[c]].x(), uv[v[c]].y()}; };
      const Plane_jacobian<double> j(r, {p(0), p(1), p(2)});
      sum += j.determinant() > 0. ? r.area() * Symmetric_dirichlet_energy().value(j.squared_norm(),
                                                                                  j.determinant())
                                  : infinity;
    }
    return sum;
  };
  const double before = energy_of(chart.uv);
  SMT::internal::adapt_chart(metric, chart);
  EXPECT_LT(energy_of(chart.uv), 0.9 * before);
  EXPECT_TRUE(is_simple_border(chart.chart.border_edges(), chart.uv));
}

// --- Bad input

TEST(Signal_metric, says_what_is_wrong)
{
  const Indexed_triangle_mesh mesh = hills();
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
