// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_FLAT_TRIANGLE_H
#define CGAL_SURFACE_MESH_MULTIGRID_FLAT_TRIANGLE_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Space_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace CGAL {
namespace Surface_mesh_multigrid {

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The class `Flat_triangle` is a triangle laid out in its own plane, taken as the complex plane: with
corners \f$ P_0, P_1, P_2 \f$ it has the edge vectors \f$ W_j = P_{j+2} - P_{j+1} \f$ and the area
\f$ A \f$. It is the one place with the formulas of lengths, area and cotangents.

A triangle without area (height below 1e-9 of the longest edge) gets edge lengths that are longer by
1e-6 of the mean edge: intrinsic mollification (Sharp and Crane 2020), which keeps energies
non-negative.
*/
class Flat_triangle
{
public:
  typedef std::complex<double> Complex; ///< a vector in the plane of the triangle
  /// The point type.
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;

  /// By how much the edges of a triangle without area are longer, in mean edges.
  static constexpr double mollification = 1e-6;

  /// Constructs the triangle.
  ///
  /// \param mean_edge the mean edge length of the mesh, the measure of mollification
  Flat_triangle(const Point_3& p0, const Point_3& p1, const Point_3& p2, double mean_edge = 1.);

  /// Constructs the triangle with the metric `metric` instead of that of space.
  Flat_triangle(const Point_3& p0, const Point_3& p1, const Point_3& p2,
                const Indexed_mesh::Space_tensor& metric, double mean_edge = 1.);

  /// Returns the area, after mollification.
  double area() const { return m_area; }

  /// Returns whether the triangle had no area of its own.
  bool is_mollified() const { return m_is_mollified; }

  /// Returns the edge vector \f$ W_j \f$, opposite to corner `j`.
  const Complex& edge(int j) const { return m_edge[j]; }

  /// Returns the cotangent at corner `j`.
  double cotangent(int j) const
  {
    const Complex &a = m_edge[(j + 1) % 3], &b = m_edge[(j + 2) % 3];
    return -(a.real() * b.real() + a.imag() * b.imag()) / (2. * m_area);
  }

private:
  void lay_out(const std::array<double, 3>& ll, double dot, double twice_area, double mean_edge);
  void lay_out(double a, double b, double c);

  std::array<Complex, 3> m_edge; // W_j
  double m_area;
  bool m_is_mollified = false;
};

inline Flat_triangle::Flat_triangle(const Point_3& p0, const Point_3& p1, const Point_3& p2,
                                    double mean_edge)
{
  const std::array<std::array<double, 3>, 3> e = {{
    {p2.x() - p1.x(), p2.y() - p1.y(), p2.z() - p1.z()},
    {p0.x() - p2.x(), p0.y() - p2.y(), p0.z() - p2.z()},
    {p1.x() - p0.x(), p1.y() - p0.y(), p1.z() - p0.z()}}};
  const auto dot = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const std::array<double, 3> n = {e[1][1] * e[2][2] - e[1][2] * e[2][1],
                                   e[1][2] * e[2][0] - e[1][0] * e[2][2],
                                   e[1][0] * e[2][1] - e[1][1] * e[2][0]};
  lay_out({dot(e[0], e[0]), dot(e[1], e[1]), dot(e[2], e[2])}, dot(e[1], e[2]),
          std::sqrt(dot(n, n)), mean_edge);
}

inline Flat_triangle::Flat_triangle(const Point_3& p0, const Point_3& p1, const Point_3& p2,
                                    const Indexed_mesh::Space_tensor& metric, double mean_edge)
{
  const auto e0 = p2 - p1, e1 = p0 - p2, e2 = p1 - p0;
  lay_out({metric.product(e0, e0), metric.product(e1, e1), metric.product(e2, e2)},
          metric.product(e1, e2), std::sqrt(metric.plane_determinant(cross_product(e1, e2))),
          mean_edge);
}

// Lays a triangle out with the squared lengths of W_0, W_1, W_2, the product of W_1 and W_2, and twice
// the area.
inline void Flat_triangle::lay_out(const std::array<double, 3>& ll, double dot, double twice_area,
                                   double mean_edge)
{
  const double longest = (std::max)({ll[0], ll[1], ll[2]});
  if(!(twice_area > 1e-9 * longest)) {
    const double extra = mollification * mean_edge;
    m_is_mollified = true;
    lay_out(std::sqrt(ll[0]) + extra, std::sqrt(ll[1]) + extra, std::sqrt(ll[2]) + extra);
    return;
  }
  // The plane's axes: along W_2 = P_1 - P_0, and to its left
  const double length = std::sqrt(ll[2]);
  m_area = 0.5 * twice_area;
  m_edge[2] = Complex(length, 0.);
  m_edge[1] = Complex(dot / length, -twice_area / length);
  m_edge[0] = -(m_edge[1] + m_edge[2]);
}

// Lays a triangle with the given lengths of W_0, W_1, W_2 out in the plane. Heron's formula in the
// form of Kahan, stable for needles; the triangle inequality holds by the mollification.
inline void Flat_triangle::lay_out(double a, double b, double c)
{
  double l[3] = {a, b, c};
  std::sort(l, l + 3);
  const double product = (l[2] + (l[1] + l[0])) * (l[0] - (l[2] - l[1]))
                       * (l[0] + (l[2] - l[1])) * (l[2] + (l[1] - l[0]));
  m_area = 0.25 * std::sqrt((std::max)(product, 0.));
  m_edge[2] = Complex(c, 0.);
  m_edge[1] = Complex((a * a - b * b - c * c) / (2. * c), -2. * m_area / c);
  m_edge[0] = -(m_edge[1] + m_edge[2]);
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_FLAT_TRIANGLE_H
