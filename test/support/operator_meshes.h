// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_OPERATOR_MESHES_H
#define HLSCM_TEST_SUPPORT_OPERATOR_MESHES_H

// Small meshes of all kinds whose matrices fit into dense ones.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace operator_meshes {

using namespace test_support;
using CGAL::Indexed_mesh::normalize;
using CGAL::Surface_mesh_parameterization::conformal_operator;
using CGAL::Surface_mesh_parameterization::Conformal_triangle;

typedef std::complex<double> Complex;
typedef std::array<Complex, 3> Corner_values;

struct Spatial_triangle
{
  std::string kind;
  Point_3 p[3];
};

// The metric of the triangle in the coordinates of its edges from corner 0.
inline Eigen::Matrix2d metric(const Spatial_triangle& t)
{
  const auto e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0];
  return (Eigen::Matrix2d() << e1 * e1, e1 * e2, e1 * e2, e2 * e2).finished();
}

// 1/2 of the integral of |grad u|^2 + |grad v|^2
inline double dirichlet_energy(const Spatial_triangle& t, const Corner_values& z)
{
  const Eigen::Matrix2d g = metric(t);
  const Eigen::Vector2cd d(z[1] - z[0], z[2] - z[0]);
  const Eigen::Matrix2d adjugate
    = (Eigen::Matrix2d() << g(1, 1), -g(0, 1), -g(1, 0), g(0, 0)).finished();
  return 0.25 * (d.adjoint() * adjugate * d).value().real() / std::sqrt(g.determinant());
}

inline std::vector<bool> no_pins(const Indexed_triangle_mesh& mesh)
{
  return std::vector<bool>(mesh.points.size(), false);
}

} // namespace operator_meshes

#endif // HLSCM_TEST_SUPPORT_OPERATOR_MESHES_H
