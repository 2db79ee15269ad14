// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps in the metric of a signal: what is known of them.

#include <support/signal_metrics.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/adapt_chart.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <vector>

namespace signal_maps_test {

using namespace CGAL::Surface_mesh_parameterization;
using namespace test_support;
using CGAL::Indexed_mesh::Space_tensor;
using CGAL::Surface_mesh_texturing::normal_signal;

constexpr double infinity = std::numeric_limits<double>::infinity();
typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;

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

// The square with the signal u = k x becomes the rectangle that is analytically known.
TEST(Signal_maps, a_ramp_stretches_the_square)
{
  const Indexed_triangle_mesh mesh = irregular_grid(30, 30, signal_seed);
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

TEST(Signal_maps, conformal_map_is_the_global_minimum)
{
  for(const Indexed_triangle_mesh& mesh :
      {signal_hills(), with_noise(with_hills(irregular_grid(80, 60, signal_seed), 9., signal_seed + 2), 0.15, signal_seed + 3)}) {
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
TEST(Signal_maps, low_stretch_maps_have_no_flip)
{
  for(const Named_mesh& chart : curved_charts(signal_seed)) {
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

TEST(Signal_maps, lowers_the_signal_stretch)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(60, 50, signal_seed), 12., signal_seed + 1);
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

TEST(Signal_maps, importance_is_density)
{
  const Indexed_triangle_mesh mesh = irregular_grid(40, 40, signal_seed);
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
TEST(Signal_maps, the_identity_is_the_surface)
{
  const Indexed_triangle_mesh mesh = signal_hills();
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

TEST(Signal_maps, equal_bits_for_any_threads)
{
  const Indexed_triangle_mesh mesh = with_hills(irregular_grid(200, 150, signal_seed), 12., signal_seed + 1);
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
TEST(Signal_maps, graphs_and_components)
{
  const Indexed_triangle_mesh mesh = signal_hills();
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
TEST(Signal_maps, charts_of_an_atlas_are_adapted)
{
  namespace SMT = CGAL::Surface_mesh_texturing;
  const Indexed_triangle_mesh mesh = with_noise(sphere(4), 0.01, signal_seed);
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
TEST(Signal_maps, adapted_charts_are_not_worse)
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

} // namespace signal_maps_test
