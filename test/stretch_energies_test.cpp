// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stretch of a triangle: energies by the singular values of a matrix decomposition, derivatives
// by differences in extended precision, and what must not change them.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace stretch_energies_test {

using namespace CGAL::Surface_mesh_parameterization;
using test_support::Random;
using test_support::uniform;

typedef long double Long;
typedef Plane_vector<Long> Vector;
typedef std::array<Vector, 3> Corners;
typedef Eigen::Matrix<Long, 6, 6> Matrix6;
typedef Eigen::Matrix<Long, 6, 1> Vector6;

constexpr std::uint64_t seed = 20261123;

// A model of StretchEnergy in double precision alone, with nothing but what the concept asks for.
class Stretch_energy_archetype
{
public:
  double value(double i, double d) const { return i + 1. / d; }
  Stretch_jet<double> operator()(double i, double d) const
  {
    return {i + 1. / d, 1., -1. / (d * d), 0., 0., 2. / (d * d * d)};
  }
};

// A reference triangle and its image, which has not turned over.
struct Mapped_triangle
{
  Reference_triangle<Long> reference;
  std::array<Vector, 3> corners; // of the reference triangle, in its plane
  Corners image;
};

Mapped_triangle random_triangle(Random& random, Long height)
{
  const auto vector = [&](Long y) { return Vector{Long(uniform(random, -1., 1.)), y}; };
  Mapped_triangle result;
  result.corners = {Vector{0., 0.}, Vector{Long(uniform(random, 0.5, 2.)), 0.},
                    vector(height * Long(uniform(random, 0.5, 2.)))};
  const auto &p = result.corners[1], &q = result.corners[2];
  result.reference = Reference_triangle<Long>::of_metric(p.dot(p), p.dot(q), q.dot(q));
  do
    for(Vector& z : result.image)
      z = vector(Long(uniform(random, -1., 1.)));
  while(!((result.image[1] - result.image[0]).cross(result.image[2] - result.image[0]) > 0.05L));
  return result;
}

std::vector<Mapped_triangle> triangles()
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::vector<Mapped_triangle> result;
  for(int i = 0; i < 100; ++i)
    for(const Long height : {1.L, 0.01L})
      result.push_back(random_triangle(random, height));
  return result;
}

template <class Energy>
Long energy_of(const Reference_triangle<Long>& t, const Corners& z, const Energy& energy)
{
  return Stretch_element<Long>(t, Plane_jacobian<Long>(t, z), energy, Curvature::EXACT).value();
}

template <class Energy>
Stretch_element<Long> element_of(const Mapped_triangle& m, const Energy& energy, Curvature curvature)
{
  return Stretch_element<Long>(m.reference, Plane_jacobian<Long>(m.reference, m.image), energy,
                               curvature);
}

Vector6 gradient_of(const Stretch_element<Long>& element, const Reference_triangle<Long>& t)
{
  Vector6 result;
  for(int j = 0; j < 3; ++j) {
    const Vector g = element.gradient(t, j);
    result.segment<2>(2 * j) << g.x, g.y;
  }
  return result;
}

Matrix6 hessian_of(const Stretch_element<Long>& element, const Reference_triangle<Long>& t)
{
  Matrix6 result;
  for(int j = 0; j < 3; ++j)
    for(int k = 0; k < 3; ++k) {
      const Plane_matrix<Long> b = element.block(t, j, k);
      result.block<2, 2>(2 * j, 2 * k) << b.xx, b.xy, b.yx, b.yy;
    }
  return result;
}

// By what the derivatives differ from differences, relative to their size.
template <class Energy>
Long error_of_derivatives(const Mapped_triangle& m, const Energy& energy)
{
  const auto moved = [&m](int i, Long h) {
    Mapped_triangle result = m;
    (i % 2 == 0 ? result.image[i / 2].x : result.image[i / 2].y) += h;
    return result;
  };
  const Stretch_element<Long> element = element_of(m, energy, Curvature::EXACT);
  const Vector6 gradient = gradient_of(element, m.reference);
  const Matrix6 hessian = hessian_of(element, m.reference);
  constexpr Long h = 1e-6L;
  Vector6 slope;
  Matrix6 curvature;
  for(int i = 0; i < 6; ++i) {
    const Mapped_triangle a = moved(i, h), b = moved(i, -h);
    slope[i] = (energy_of(m.reference, a.image, energy) - energy_of(m.reference, b.image, energy))
             / (2.L * h);
    curvature.col(i) = (gradient_of(element_of(a, energy, Curvature::EXACT), m.reference)
                        - gradient_of(element_of(b, energy, Curvature::EXACT), m.reference))
                     / (2.L * h);
  }
  return std::max((slope - gradient).norm() / gradient.norm(),
                  (curvature - hessian).norm() / hessian.norm());
}

// The Jacobian by its definition, from the coordinates of the reference triangle.
Eigen::Matrix<Long, 2, 2> jacobian_by_definition(const Mapped_triangle& m)
{
  Eigen::Matrix<Long, 2, 2> p, z;
  for(int j = 0; j < 2; ++j) {
    const Vector a = m.corners[j + 1] - m.corners[0], b = m.image[j + 1] - m.image[0];
    p.col(j) << a.x, a.y;
    z.col(j) << b.x, b.y;
  }
  return z * p.inverse();
}

template <class Use>
void for_each_energy(const Use& use)
{
  use("symmetric Dirichlet", Symmetric_dirichlet_energy());
  use("MIPS", Mips_energy());
  use("area-weighted MIPS", Area_weighted_mips_energy());
  use("area-weighted MIPS, 0.5", Area_weighted_mips_energy{0.5});
  use("ARAP", Arap_energy());
  use("MIPS to the fourth", Powered_energy<Mips_energy>());
  use("ARAP with a barrier", Barrier_energy<Arap_energy>());
  use("symmetric Dirichlet squared", Powered_energy<Symmetric_dirichlet_energy>{{}, 2.});
}

TEST(Stretch_energies, derivatives_are_those_of_differences)
{
  for_each_energy([](const std::string& name, const auto& energy) {
    for(const Mapped_triangle& m : triangles())
      EXPECT_LT(error_of_derivatives(m, energy), 1e-6L) << name;
  });
}

TEST(Stretch_energies, values_are_those_of_singular_values)
{
  for(const Mapped_triangle& m : triangles()) {
    const Eigen::Matrix<Long, 2, 2> jacobian = jacobian_by_definition(m);
    const Eigen::Matrix<Long, 2, 1> s
      = Eigen::JacobiSVD<Eigen::Matrix<Long, 2, 2>>(jacobian).singularValues();
    const Long area = m.reference.area(), r = s[0] / s[1] + s[1] / s[0];
    const Long rounding = 1e-12L;
    const auto expect = [&](Long expected, Long value) {
      EXPECT_NEAR(double(value / expected), 1., double(rounding));
    };
    const auto value = [&](const auto& energy) { return energy_of(m.reference, m.image, energy) / area; };
    expect(s[0] * s[0] + s[1] * s[1] + 1.L / (s[0] * s[0]) + 1.L / (s[1] * s[1]),
           value(Symmetric_dirichlet_energy()));
    expect(r, value(Mips_energy()));
    expect((s[0] - 1.L) * (s[0] - 1.L) + (s[1] - 1.L) * (s[1] - 1.L), value(Arap_energy()));
    expect(r * std::pow(s[0] * s[1] + 1.L / (s[0] * s[1]), 2.L), value(Area_weighted_mips_energy()));
    expect(r * r * r * r, value(Powered_energy<Mips_energy>()));
    expect(value(Mips_energy()), value(Area_weighted_mips_energy{0.}));
    expect(value(Symmetric_dirichlet_energy()), value(Area_weighted_mips_energy{1.}));
  }
}

TEST(Stretch_energies, value_is_that_of_the_jet)
{
  for_each_energy([](const std::string& name, const auto& energy) {
    for(const double d : {0.01, 0.7, 30.})
      for(const double i : {2. * d, 2.5 * d, 100. * d})
        EXPECT_NEAR(energy.value(i, d) / energy(i, d).value, 1., 1e-9) << name;
  });
}

// The projected second derivative has no negative eigenvalue, and is the nearest such matrix: the
// rest has no positive one, and they have no direction in common.
TEST(Stretch_energies, projected_curvature_is_the_positive_part)
{
  for_each_energy([](const std::string& name, const auto& energy) {
    std::size_t changed = 0;
    for(const Mapped_triangle& m : triangles()) {
      const Matrix6 exact = hessian_of(element_of(m, energy, Curvature::EXACT), m.reference);
      const Matrix6 projected = hessian_of(element_of(m, energy, Curvature::PROJECTED), m.reference);
      const Long size = exact.norm(), rounding = 1e-12L;
      EXPECT_LT((projected - projected.transpose()).norm(), rounding * size) << name;
      EXPECT_LT((exact - exact.transpose()).norm(), rounding * size) << name;
      const Eigen::SelfAdjointEigenSolver<Matrix6> positive(projected);
      EXPECT_GT(positive.eigenvalues().minCoeff(), -rounding * size) << name;
      changed += (projected - exact).norm() > 1e-6L * size ? 1 : 0;
    }
    EXPECT_GT(changed, 20u) << name << ": the projection was not tested";
  });
}

// In the space of Jacobians, where the modes are orthogonal, the projection is exact.
TEST(Stretch_energies, projection_removes_negative_eigenvalues_only)
{
  // For the triangle 0, 1, i the places of the corners 1 and 2 are the columns of the Jacobian.
  const auto reference = Reference_triangle<Long>::of_metric(1.L, 0.L, 1.L);
  for_each_energy([&](const std::string& name, const auto& energy) {
    for(Mapped_triangle m : triangles()) {
      m.reference = reference;
      const auto inner = [&](Curvature curvature) -> Eigen::Matrix<Long, 4, 4> {
        return hessian_of(element_of(m, energy, curvature), reference).template block<4, 4>(2, 2);
      };
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Long, 4, 4>> exact(inner(Curvature::EXACT));
      const Eigen::Matrix<Long, 4, 1> positive = exact.eigenvalues().cwiseMax(0.L);
      const Eigen::Matrix<Long, 4, 4> expected
        = exact.eigenvectors() * positive.asDiagonal() * exact.eigenvectors().transpose();
      EXPECT_LT((inner(Curvature::PROJECTED) - expected).norm(), 1e-10L * exact.eigenvalues().norm())
        << name;
    }
  });
}

TEST(Stretch_energies, motions_of_the_image_change_nothing)
{
  const Long c = std::cos(1.L), s = std::sin(1.L);
  for_each_energy([&](const std::string& name, const auto& energy) {
    for(const Mapped_triangle& m : triangles()) {
      Corners moved = m.image;
      for(Vector& z : moved)
        z = z.times({c, s}) + Vector{3.L, -7.L};
      const Long before = energy_of(m.reference, m.image, energy);
      EXPECT_NEAR(double(energy_of(m.reference, moved, energy) / before), 1., 1e-12) << name;
      const Stretch_element<Long> element = element_of(m, energy, Curvature::EXACT);
      const Vector6 gradient = gradient_of(element, m.reference);
      const Vector sum = {gradient[0] + gradient[2] + gradient[4], gradient[1] + gradient[3] + gradient[5]};
      Long turn = 0.L;
      for(int j = 0; j < 3; ++j)
        turn += m.image[j].cross({gradient[2 * j], gradient[2 * j + 1]});
      EXPECT_LT(sum.squared_length(), 1e-24L * gradient.squaredNorm()) << name;
      EXPECT_LT(std::abs(turn), 1e-12L * gradient.norm()) << name;
    }
  });
}

TEST(Stretch_energies, corners_in_another_order_change_nothing)
{
  for(const Mapped_triangle& m : triangles()) {
    const auto &p = m.corners[2] - m.corners[1], &q = m.corners[0] - m.corners[1];
    const auto turned = Reference_triangle<Long>::of_metric(p.dot(p), p.dot(q), q.dot(q));
    const Symmetric_dirichlet_energy energy;
    const Long value = energy_of(turned, {m.image[1], m.image[2], m.image[0]}, energy);
    EXPECT_NEAR(double(value / energy_of(m.reference, m.image, energy)), 1., 1e-12);
  }
}

TEST(Stretch_energies, isometries_have_the_least_energy)
{
  for(const Mapped_triangle& m : triangles()) {
    const auto value = [&](const auto& energy) {
      return double(energy_of(m.reference, m.corners, energy) / m.reference.area());
    };
    EXPECT_NEAR(value(Symmetric_dirichlet_energy()), 4., 1e-12);
    EXPECT_NEAR(value(Mips_energy()), 2., 1e-12);
    EXPECT_NEAR(value(Area_weighted_mips_energy()), 8., 1e-12);
    EXPECT_NEAR(value(Arap_energy()), 0., 1e-12);
    const Mapped_triangle still = {m.reference, m.corners, m.corners};
    for_each_energy([&](const std::string& name, const auto& energy) {
      if(name == "ARAP with a barrier") // its least energy is that of a larger triangle
        return;
      const auto element = element_of(still, energy, Curvature::EXACT);
      EXPECT_LT(gradient_of(element, m.reference).norm(),
                1e-12L * hessian_of(element, m.reference).norm()) << name;
    });
  }
}

// The three ways to a reference triangle agree, also for needles.
TEST(Reference_triangles, lengths_points_and_metrics_agree)
{
  typedef Reference_triangle<Long>::Point_3 Point_3;
  for(const Mapped_triangle& m : triangles()) {
    std::array<Point_3, 3> p;
    for(int j = 0; j < 3; ++j) // turned in space
      p[j] = Point_3(double(0.6L * m.corners[j].x), double(m.corners[j].y), double(0.8L * m.corners[j].x));
    std::array<Long, 3> length;
    for(int j = 0; j < 3; ++j)
      length[j] = std::sqrt((m.corners[(j + 2) % 3] - m.corners[(j + 1) % 3]).squared_length());
    const Symmetric_dirichlet_energy energy;
    const Long value = energy_of(m.reference, m.image, energy);
    const auto of_points = Reference_triangle<Long>::of_points(p[0], p[1], p[2]);
    const auto of_lengths = Reference_triangle<Long>::of_lengths(length);
    EXPECT_NEAR(double(energy_of(of_points, m.image, energy) / value), 1., 1e-9);
    EXPECT_NEAR(double(energy_of(of_lengths, m.image, energy) / value), 1., 1e-9);
  }
}

TEST(Reference_triangles, area_has_a_floor)
{
  typedef Reference_triangle<double>::Point_3 Point_3;
  for(const auto& t : {Reference_triangle<double>::of_points(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(2, 0, 0)),
                       Reference_triangle<double>::of_lengths({1., 2., 1.}),
                       Reference_triangle<double>::of_metric(1., 2., 4.)}) {
    EXPECT_NEAR(t.area(), 6. * Reference_triangle<double>::least_area, 1e-12);
    for(int j = 0; j < 3; ++j)
      EXPECT_TRUE(std::isfinite(t.half_gradient(j).squared_length()));
  }
}

TEST(Stretch_energies, a_users_own_energy_is_enough)
{
  const auto t = Reference_triangle<double>::of_metric(1., 0., 1.);
  const std::array<Plane_vector<double>, 3> z = {{{0., 0.}, {2., 0.}, {0., 3.}}};
  const Stretch_element<double> element(t, Plane_jacobian<double>(t, z), Stretch_energy_archetype(),
                                        Curvature::PROJECTED);
  EXPECT_NEAR(element.value(), 0.5 * (13. + 1. / 6.), 1e-12);
}

} // namespace stretch_energies_test
