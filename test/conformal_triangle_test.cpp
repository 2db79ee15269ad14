// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The conformal energy of a triangle, by derivations that share no formula with the library:
// gradients from the metric, angles from the law of cosines, singular values by a matrix
// decomposition.

#include <support/chart_generators.h>
#include <support/dense_multigrid.h>
#include <support/mesh_properties.h>
#include <support/operator_meshes.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace conformal_triangle_test {

using namespace test_support;
using namespace operator_meshes;

Point_3 random_point(Random_numbers& random)
{
  const double x = random.real(), y = random.real();
  return Point_3(x, y, random.real());
}

// Random ones, obtuse ones and needles of height 1e-5, in three dimensions
std::vector<Spatial_triangle> triangles()
{
  Random_numbers random(1);
  std::vector<Spatial_triangle> result;
  for(int i = 0; i < 50; ++i) {
    const Point_3 a = random_point(random), b = random_point(random), c = random_point(random);
    result.push_back({"random", {a, b, c}});
    const Point_3 middle = CGAL::barycenter(a, 0.45, b, 0.55);
    result.push_back({"obtuse", {a, middle + 0.02 * (c - a), b}});
    result.push_back({"cap", {middle + 1e-5 * (c - a), b, a}});
    result.push_back({"needle", {a, a + 1e-5 * (c - a), b}});
  }
  return result;
}

Corner_values random_values(Random_numbers& random)
{
  const Complex a = random.complex(), b = random.complex();
  return {a, b, random.complex()};
}

double signed_area(const Corner_values& z)
{
  return 0.5 * std::imag(std::conj(z[1] - z[0]) * (z[2] - z[0]));
}

// The Jacobian of the map from the plane of the triangle, in an orthonormal frame.
Eigen::Matrix2d jacobian(const Spatial_triangle& t, const Corner_values& z)
{
  const Eigen::Matrix2d frame = metric(t).llt().matrixU(); // columns: the edges
  Eigen::Matrix2d images;
  images << (z[1] - z[0]).real(), (z[2] - z[0]).real(), (z[1] - z[0]).imag(), (z[2] - z[0]).imag();
  return images * frame.inverse();
}

Conformal_triangle conformal(const Spatial_triangle& t)
{
  return Conformal_triangle(t.p[0], t.p[1], t.p[2]);
}

// How far formulas with differences of squares may be off: needles of aspect 1e5 lose 10 to 12
// digits of the metric's determinant.
double tolerance_of(const Spatial_triangle& t)
{
  return t.kind == "needle" || t.kind == "cap" ? 2e-4 : 1e-10;
}

TEST(Conformal_triangle, energy_is_dirichlet_minus_area)
{
  Random_numbers random(2);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const double dirichlet = dirichlet_energy(t, z);
    EXPECT_NEAR(conformal(t).energy(z), dirichlet - signed_area(z), tolerance_of(t) * dirichlet)
      << t.kind;
  }
}

TEST(Conformal_triangle, energy_is_that_of_the_singular_values)
{
  Random_numbers random(3);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const Eigen::Matrix2d j = jacobian(t, z);
    const Eigen::Vector2d sigma = j.jacobiSvd().singularValues();
    const double difference = sigma(0) - (j.determinant() < 0. ? -sigma(1) : sigma(1));
    const double area = 0.5 * std::sqrt(metric(t).determinant());
    EXPECT_NEAR(conformal(t).energy(z), 0.5 * difference * difference * area,
                tolerance_of(t) * sigma(0) * sigma(0) * area) << t.kind;
  }
}

// |sum W_j z_j|^2 / 8A with edge vectors that are laid out by lengths and angles
TEST(Conformal_triangle, energy_is_the_formula_of_ray_and_levy)
{
  Random_numbers random(4);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const double a = std::sqrt(CGAL::squared_distance(t.p[0], t.p[1])),
                 b = std::sqrt(CGAL::squared_distance(t.p[0], t.p[2]));
    const double angle = angle_at_first({t.p[0], t.p[1], t.p[2]}, {0, 1, 2});
    const Complex q[3] = {0., a, std::polar(b, angle)};
    const double area = 0.5 * a * b * std::sin(angle);
    Complex sum = 0.;
    for(int j = 0; j < 3; ++j)
      sum += (q[(j + 2) % 3] - q[(j + 1) % 3]) * z[j];
    const double expected = std::norm(sum) / (8. * area);
    EXPECT_NEAR(conformal(t).energy(z), expected,
                tolerance_of(t) * (expected + std::abs(signed_area(z)))) << t.kind;
    EXPECT_NEAR(conformal(t).area(), area, 1e-9 * area) << t.kind;
  }
}

// For z = alpha w + beta conj(w) the derivatives are 2 |alpha| and 2 |beta|.
TEST(Conformal_triangle, derivatives)
{
  Random_numbers random(5);
  for(const Spatial_triangle& t : triangles()) {
    const Eigen::Matrix2d frame = metric(t).llt().matrixU();
    const Complex alpha = random.complex(), beta = random.complex(), shift = 10. * random.complex();
    Corner_values z = {shift, 0., 0.};
    for(int j : {0, 1}) {
      const Complex w(frame(0, j), frame(1, j));
      z[j + 1] = shift + alpha * w + beta * std::conj(w);
    }
    const double scale = std::abs(alpha) + std::abs(beta);
    const double tolerance = t.kind == "needle" || t.kind == "cap" ? 1e-3 : 1e-8;
    EXPECT_NEAR(std::abs(conformal(t).holomorphic_derivative(z)), 2. * std::abs(alpha),
                tolerance * scale) << t.kind;
    EXPECT_NEAR(std::abs(conformal(t).antiholomorphic_derivative(z)), 2. * std::abs(beta),
                tolerance * scale) << t.kind;
  }
}

TEST(Conformal_triangle, cotangents)
{
  for(const Spatial_triangle& t : triangles())
    for(int j = 0; j < 3; ++j) {
      const double angle = angle_at_first({t.p[j], t.p[(j + 1) % 3], t.p[(j + 2) % 3]}, {0, 1, 2});
      EXPECT_NEAR(conformal(t).cotangent(j) * std::tan(angle), 1., 1e-7) << t.kind;
    }
}

TEST(Conformal_triangle, energy_of_a_similarity_is_0)
{
  Random_numbers random(6);
  for(int trial = 0; trial < 50; ++trial) {
    const Complex a = random.complex(), b = random.complex();
    Corner_values z;
    Spatial_triangle t{"planar", {}};
    for(int j = 0; j < 3; ++j) {
      const Complex w = random.complex();
      t.p[j] = Point_3(w.real(), w.imag(), 0.);
      z[j] = a * w + b;
    }
    if(CGAL::cross_product(t.p[1] - t.p[0], t.p[2] - t.p[0]).z() < 0.) {
      std::swap(t.p[1], t.p[2]);
      std::swap(z[1], z[2]);
    }
    EXPECT_LE(conformal(t).energy(z), 1e-24 * std::norm(a)) << trial;
  }
}

TEST(Conformal_triangle, without_area_is_mollified)
{
  const Point_3 a(0, 0, 0), b(1, 0, 0), middle(0.4, 0, 0);
  for(const auto& t : {Conformal_triangle(a, b, middle), Conformal_triangle(a, a, b),
                       Conformal_triangle(b, a, a), Conformal_triangle(a, a, a)}) {
    EXPECT_TRUE(t.is_mollified());
    EXPECT_GT(t.area(), 0.);
    for(int j = 0; j < 3; ++j)
      EXPECT_TRUE(std::isfinite(t.cotangent(j)));
    // cot A cot B + cot B cot C + cot C cot A = 1 holds for every triangle and no other numbers.
    const double x = t.cotangent(0), y = t.cotangent(1), z = t.cotangent(2);
    const double largest = (std::max)({std::abs(x * y), std::abs(y * z), std::abs(z * x), 1.});
    EXPECT_NEAR((x * y + y * z + z * x) / largest, 1. / largest, 1e-9);
  }
  EXPECT_FALSE(Conformal_triangle(a, b, Point_3(0.4, 1e-8, 0)).is_mollified());
}

} // namespace conformal_triangle_test
