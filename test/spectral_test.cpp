// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformal maps without pins: against a dense eigensolver on small charts, by the equation that
// defines them on large ones.

#include <support/conformal_maps.h>
#include <support/dense_multigrid.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <string>

namespace spectral_test {

using namespace test_support;
using SMP::Conformal_method;
using SMP::HLSCM_options;

typedef std::complex<double> Complex;
typedef SMP::Spectral_conformal_parameterizer_3<Surface_mesh> Spectral_parameterizer;

Outcome spectral_map(Surface_mesh& mesh, HLSCM_options options)
{
  options.method = Conformal_method::DIRECT; // to be ignored
  Spectral_parameterizer parameterizer(options);
  Uv_map uvmap = new_uv_map(mesh);
  Outcome run;
  run.error = SMP::parameterize(mesh, parameterizer, border_halfedge(mesh), uvmap);
  run.report = parameterizer.report();
  run.uv = parameters(mesh, uvmap);
  mesh.remove_property_map(uvmap);
  return run;
}

HLSCM_options with_tolerance(double tolerance, std::size_t coarsest_size)
{
  HLSCM_options options;
  options.tolerance = tolerance;
  options.coarsest_size = coarsest_size;
  return options;
}

// Half the lengths of the border edges at each vertex, from the edges that one triangle has.
std::vector<double> border_masses(const Indexed_triangle_mesh& mesh)
{
  std::map<std::pair<Vertex_index, Vertex_index>, int> count;
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c)
      ++count[std::minmax(t[c], t[(c + 1) % 3])];
  std::vector<double> mass(mesh.points.size(), 0.);
  for(const auto& [edge, number] : count)
    if(number == 1) {
      const double length
        = std::sqrt(CGAL::squared_distance(mesh.points[edge.first], mesh.points[edge.second]));
      mass[edge.first] += 0.5 * length;
      mass[edge.second] += 0.5 * length;
    }
  return mass;
}

// A map z, the products H z and B z, and its Rayleigh quotient; z is moved so that its border has
// the centre of mass 0. The mesh is normalized: the operator wants edges of length 1.
struct Eigen_equation
{
  std::vector<Complex> z, hz, bz;
  double quotient = 0.;

  Eigen_equation(const Indexed_triangle_mesh& mesh, const Parameters& uv)
    : z(uv), hz(uv.size()), bz(uv.size())
  {
    const std::vector<double> mass = border_masses(mesh);
    Complex moment = 0.;
    double total = 0.;
    for(std::size_t i = 0; i < z.size(); ++i) {
      moment += mass[i] * z[i];
      total += mass[i];
    }
    for(Complex& value : z)
      value -= moment / total;
    SMP::conformal_operator<double>(mesh, std::vector<bool>(z.size(), false)).multiply(z, hz);
    double energy = 0., size = 0.;
    for(std::size_t i = 0; i < z.size(); ++i) {
      bz[i] = mass[i] * z[i];
      energy += (std::conj(z[i]) * hz[i]).real();
      size += (std::conj(z[i]) * bz[i]).real();
    }
    quotient = energy / size;
  }

  // |H z - lambda B z| to |lambda B z|
  double residual() const
  {
    double difference = 0., size = 0.;
    for(std::size_t i = 0; i < z.size(); ++i) {
      difference += std::norm(hz[i] - quotient * bz[i]);
      size += std::norm(quotient * bz[i]);
    }
    return std::sqrt(difference / size);
  }
};

struct Eigen_pair
{
  double value;
  Parameters vector;
};

// The smallest eigenvalue but 0 by a dense eigensolver: the inverse of the largest one of (B', H'),
// where B' does not see constants, and H' is made definite on them.
Eigen_pair smallest_eigenvalue(const Indexed_triangle_mesh& mesh)
{
  const auto n = Eigen::Index(mesh.points.size());
  const auto op = SMP::conformal_operator<double>(mesh, std::vector<bool>(n, false));
  Dense_matrix h = to_dense(op.matrix);
  h += Dense_matrix::Ones(n, n);
  const std::vector<double> mass = border_masses(mesh);
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(mass.data(), n);
  Eigen::MatrixXd projected = b.asDiagonal();
  projected -= b * b.transpose() / b.sum();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Dense_matrix> solver(
    projected.cast<Complex>(), h);
  const auto last = solver.eigenvectors().col(n - 1);
  return {1. / solver.eigenvalues()(n - 1), Parameters(last.begin(), last.end())};
}

std::vector<Named_mesh> small_charts()
{
  const auto hills = with_hills(irregular_grid(18, 12, 1), 4., 2);
  std::vector<Named_mesh> result = {
    {"hills", hills},
    {"noisy hills", with_noise(hills, 0.2, 3)},
    {"hills with holes", with_hills(with_holes(irregular_grid(22, 14, 4), 5, 5), 5., 6)},
    {"jagged hills", with_hills(with_jagged_border(irregular_grid(20, 12, 7), 0.5, 8), 4., 9)},
    {"slivers", with_hills(with_slivers(irregular_grid(18, 12, 10), 20.), 0.5, 11)},
    {"dome", on_sphere(round_disk(8), 2.2)},
    {"sphere with holes", with_holes(sphere(3), 7, 12)},
  };
  for(Named_mesh& chart : result)
    normalize(chart.mesh);
  return result;
}

TEST(Spectral, is_the_smallest_eigenvalue)
{
  for(const auto& [name, mesh] : small_charts()) {
    const double expected = smallest_eigenvalue(mesh).value;
    // Both lose the digits in which Dirichlet energy and area agree: five more for slivers.
    const double rounding = name == "slivers" ? 1e-4 : 1e-7;
    for(const std::size_t coarsest_size : {30, 100, 1000}) {
      Surface_mesh surface_mesh = to_surface_mesh(mesh);
      const Outcome run = spectral_map(surface_mesh, with_tolerance(0.1 * rounding, coarsest_size));
      ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
      const double quotient = Eigen_equation(mesh, run.uv).quotient;
      EXPECT_NEAR(quotient / expected, 1., rounding) << name << ", coarsest " << coarsest_size;
    }
  }
}

TEST(Spectral, reaches_its_tolerance)
{
  for(const auto& [name, mesh] : small_charts()) {
    const double expected = smallest_eigenvalue(mesh).value;
    for(const double tolerance : {1e-2, 1e-4}) {
      Surface_mesh surface_mesh = to_surface_mesh(mesh);
      const Outcome run = spectral_map(surface_mesh, with_tolerance(tolerance, 40));
      ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
      EXPECT_TRUE(run.report.converged);
      EXPECT_LE(Eigen_equation(mesh, run.uv).quotient, expected * (1. + 1.1 * tolerance)) << name;
      EXPECT_LE(run.report.energy_gap_estimate, tolerance * run.report.energy) << name;
    }
  }
}

// Where holes are all there is of a border, the map of least energy for its size goes around several
// of them, and folds in between: what the iteration finds is that map, and no worse one.
TEST(Spectral, folds_where_the_least_map_does)
{
  Indexed_triangle_mesh mesh = small_charts().back().mesh;
  const Parameters expected = smallest_eigenvalue(mesh).vector;
  Surface_mesh surface_mesh = to_surface_mesh(mesh);
  const Outcome run = spectral_map(surface_mesh, with_tolerance(1e-12, 60));
  ASSERT_EQ(run.error, SMP::OK) << run.report.message;
  const auto is_flipped = [&mesh](const Parameters& z, std::size_t t) {
    const auto& v = mesh.triangles[t];
    return (std::conj(z[v[1]] - z[v[0]]) * (z[v[2]] - z[v[0]])).imag() < 0.;
  };
  int flips = 0;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(is_flipped(run.uv, t), is_flipped(expected, t)) << t;
    flips += is_flipped(expected, t) ? 1 : 0;
  }
  EXPECT_GT(flips, 10);
}

TEST(Spectral, solves_its_equation_on_large_charts)
{
  for(auto [name, mesh] : large_charts(5)) {
    normalize(mesh);
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Outcome run = spectral_map(surface_mesh, with_tolerance(1e-12, 2000));
    ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
    EXPECT_LE(Eigen_equation(mesh, run.uv).residual(), 2e-2) << name;
    const Outcome rough = spectral_map(surface_mesh, with_tolerance(1e-2, 2000));
    EXPECT_GE(Eigen_equation(mesh, rough.uv).residual(), 0.1) << name; // it does say something
  }
}

// All maps of the plane that are similarities have no energy; the solution must be one of them.
TEST(Spectral, leaves_a_plane_as_it_is)
{
  for(const auto& [name, mesh] : planar_charts(6)) {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Outcome run = spectral_map(surface_mesh, with_tolerance(1e-6, 100));
    ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
    const auto measures = measure(surface_mesh, run.uv);
    EXPECT_EQ(measures.flipped_faces, 0u) << name;
    EXPECT_NEAR(measures.quasi_conformal_max, 1., 1e-4) << name;
    EXPECT_NEAR(measures.area_scale_range, 1., 1e-3) << name;
  }
}

// The size of the terms of the energy of a map, which cancel to it: near slivers they are much larger.
double size_of_terms(const Indexed_triangle_mesh& mesh, const std::vector<Complex>& uv)
{
  double sum = 0.;
  for(const Triangle_indices& t : mesh.triangles)
    for(int k = 0; k < 3; ++k) {
      const Vertex_index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const auto p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
      const auto n = CGAL::cross_product(p, q);
      if(n * n > 0.)
        sum += 0.5 * std::abs(p * q) / std::sqrt(n * n) * std::norm(uv[b] - uv[c]);
    }
  return sum;
}

TEST(Spectral, has_the_area_of_the_surface_and_its_place)
{
  for(const auto& [name, mesh] : curved_charts(7)) {
    Surface_mesh surface_mesh = to_surface_mesh(scaled(mesh, 17.));
    const Outcome run = spectral_map(surface_mesh, with_tolerance(1e-2, 300));
    ASSERT_EQ(run.error, SMP::OK) << name << ": " << run.report.message;
    EXPECT_TRUE(run.report.pins.empty());
    EXPECT_EQ(run.report.method, "spectral");
    double surface = 0., plane = 0.;
    for(const Triangle_indices& t : mesh.triangles) {
      surface += 17. * 17. * std::sqrt(CGAL::squared_area(mesh.points[t[0]], mesh.points[t[1]],
                                                          mesh.points[t[2]]));
      plane += 0.5 * (std::conj(run.uv[t[1]] - run.uv[t[0]]) * (run.uv[t[2]] - run.uv[t[0]])).imag();
    }
    EXPECT_NEAR(plane / surface, 1., 1e-4) << name; // triangles without area get some
    const Outcome pinned = parameterize(surface_mesh, with_method(Conformal_method::HLSCM));
    EXPECT_EQ(run.uv[pinned.report.pins[0].vertex], Complex(0.)) << name;
    EXPECT_NEAR(run.uv[pinned.report.pins[1].vertex].imag(), 0., 1e-9 * size_of(run.uv)) << name;
    EXPECT_GT(run.uv[pinned.report.pins[1].vertex].real(), 0.) << name;
    EXPECT_NEAR(run.report.energy, measure(surface_mesh, run.uv).conformal_energy,
                1e-4 * run.report.energy + 3e-13 * size_of_terms(mesh, run.uv)) << name; // rounding
  }
}

// What it is for: a cap that is nearly the whole sphere comes out as evenly as it can.
TEST(Spectral, keeps_sizes_more_even_than_pins_do)
{
  for(const char* const wanted : {"hills", "noisy hills", "nearly closed sphere"})
    for(const auto& [name, mesh] : curved_charts(8))
      if(name == wanted) {
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        const Outcome free = spectral_map(surface_mesh, with_tolerance(1e-4, 300));
        const Outcome pinned = parameterize(surface_mesh, with_method(Conformal_method::HLSCM));
        EXPECT_LT(measure(surface_mesh, free.uv).area_scale_range,
                  1.1 * measure(surface_mesh, pinned.uv).area_scale_range) << name;
      }
}

TEST(Spectral, marks_no_vertex_as_parameterized)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(irregular_grid(20, 15, 1), 5., 2));
  Uv_map uvmap = new_uv_map(mesh);
  const auto index = mesh.add_property_map<Surface_mesh::Vertex_index, int>("", 0).first;
  const auto flag = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("", false).first;
  Spectral_parameterizer parameterizer;
  ASSERT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap, index, flag), SMP::OK);
  for(const auto v : vertices(mesh))
    EXPECT_FALSE(flag[v]);
}

// All levels have the size and place of the result.
TEST(Spectral, shows_its_levels_in_one_place)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(irregular_grid(60, 40, 1), 5., 2));
  HLSCM_options options = with_tolerance(1e-2, 100);
  std::vector<double> sizes;
  options.level_observer = [&sizes](const SMP::Level_view& view) {
    sizes.push_back(size_of(*view.uv));
    return true;
  };
  const Outcome run = spectral_map(mesh, options);
  ASSERT_GE(sizes.size(), 3u);
  for(const double size : sizes)
    EXPECT_NEAR(size / size_of(run.uv), 1., 0.2);
}

TEST(Spectral, does_not_use_pins_and_says_so)
{
  Surface_mesh mesh = to_surface_mesh(with_hills(irregular_grid(20, 15, 1), 5., 2));
  const Outcome free = spectral_map(mesh, HLSCM_options());
  const Outcome run = parameterize(mesh, with_method(Conformal_method::SPECTRAL, 1e-2),
                                   {{5, Complex(0., 0.)}, {17, Complex(2., 3.)}});
  EXPECT_EQ(run.error, SMP::OK);
  EXPECT_EQ(run.uv, free.uv);
  EXPECT_TRUE(run.report.pins.empty());
  ASSERT_EQ(run.report.warnings.size(), 1u);
  EXPECT_NE(run.report.warnings[0].find("no pins"), std::string::npos);
}

TEST(Spectral, can_be_cancelled)
{
  Surface_mesh mesh = to_surface_mesh(large_charts(9)[0].mesh);
  HLSCM_options options;
  double last = 0.;
  options.progress = [&last](double part) { last = part; return part < 0.82; };
  const Outcome run = spectral_map(mesh, options);
  EXPECT_TRUE(run.report.cancelled);
  EXPECT_GE(last, 0.82);
  EXPECT_EQ(run.uv[0], Complex(untouched, untouched));
}

} // namespace spectral_test
