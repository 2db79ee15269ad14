// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_REFERENCE_TRIANGLE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_REFERENCE_TRIANGLE_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Space_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

The struct `Plane_vector` is a vector in the plane, or a complex number. Its products are those of
complex numbers without the special cases of `std::complex`, which cost more than the products.
*/
template <class FT>
struct Plane_vector
{
  FT x = FT(0); ///< the first coordinate, or the real part
  FT y = FT(0); ///< the second coordinate, or the imaginary part

  /// Returns the sum.
  Plane_vector operator+(const Plane_vector& b) const { return {x + b.x, y + b.y}; }
  /// Returns the difference.
  Plane_vector operator-(const Plane_vector& b) const { return {x - b.x, y - b.y}; }
  /// Returns a multiple.
  Plane_vector operator*(const FT& s) const { return {x * s, y * s}; }
  /// Returns the product of complex numbers.
  Plane_vector times(const Plane_vector& b) const { return {x * b.x - y * b.y, x * b.y + y * b.x}; }
  /// Returns the complex conjugate.
  Plane_vector conjugate() const { return {x, -y}; }
  /// Returns the scalar product.
  FT dot(const Plane_vector& b) const { return x * b.x + y * b.y; }
  /// Returns the determinant of the two vectors.
  FT cross(const Plane_vector& b) const { return x * b.y - y * b.x; }
  /// Returns the squared length.
  FT squared_length() const { return x * x + y * y; }
};

/*!
\ingroup PkgHLSCMStretch

The class `Reference_triangle` is a triangle laid out in a plane by its metric, from which the
stretch of its image is measured: that of the surface, or any other.

With corners \f$ P_0, P_1, P_2 \f$ a map that takes them to the complex numbers \f$ z_j \f$ is
\f$ w \mapsto \alpha w + \beta \bar w + c \f$ with \f$ \alpha = \sum_j \bar g_j z_j \f$ and
\f$ \beta = \sum_j g_j z_j \f$, where \f$ 2 g_j \f$ is the gradient of the hat function of corner
\f$ j \f$.

The area is at least `least_area` of the sum of the squared lengths; a triangle that has less is
laid out with that much, so that its cotangents exist. Where all corners coincide it has sides of
`least_length`.
*/
template <class FT = double>
class Reference_triangle
{
public:
  typedef Plane_vector<FT> Vector;                             ///< a vector
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3; ///< a point of a surface

  /// The least area, in squared lengths of the edges.
  static constexpr double least_area = 1e-7;
  /// The length of the sides of a triangle without extent.
  static constexpr double least_length = 1e-12;

  /// Constructs the triangle of two edge vectors with the scalar products
  /// \f$ e = |P_1 - P_0|^2 \f$, \f$ f = (P_1 - P_0) \cdot (P_2 - P_0) \f$ and
  /// \f$ g = |P_2 - P_0|^2 \f$: of a metric tensor in the basis of these edges.
  static Reference_triangle of_metric(const FT& e, const FT& f, const FT& g)
  {
    using std::sqrt;
    return Reference_triangle(e, f, g, sqrt((std::max)(FT(0), e * g - f * f)));
  }

  /// Constructs the triangle of three lengths, each that of the edge opposite to a corner.
  static Reference_triangle of_lengths(const std::array<FT, 3>& length)
  {
    using std::sqrt;
    std::array<FT, 3> l = length;
    std::sort(l.begin(), l.end());
    // Heron's formula in the form of Kahan, stable for needles
    const FT product = (l[2] + (l[1] + l[0])) * (l[0] - (l[2] - l[1])) * (l[0] + (l[2] - l[1]))
                     * (l[2] + (l[1] - l[0]));
    const FT e = length[2] * length[2], g = length[1] * length[1];
    return Reference_triangle(e, (e + g - length[0] * length[0]) / FT(2), g,
                              sqrt((std::max)(FT(0), product)) / FT(2));
  }

  /// Constructs the triangle of three points of space.
  static Reference_triangle of_points(const Point_3& p0, const Point_3& p1, const Point_3& p2)
  {
    using std::sqrt;
    const FT a[3] = {FT(p1.x()) - p0.x(), FT(p1.y()) - p0.y(), FT(p1.z()) - p0.z()};
    const FT b[3] = {FT(p2.x()) - p0.x(), FT(p2.y()) - p0.y(), FT(p2.z()) - p0.z()};
    const FT n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return Reference_triangle(a[0] * a[0] + a[1] * a[1] + a[2] * a[2],
                              a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
                              b[0] * b[0] + b[1] * b[1] + b[2] * b[2],
                              sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
  }

  /// Constructs the triangle of three points of space with the metric `metric`.
  static Reference_triangle of_points(const Point_3& p0, const Point_3& p1, const Point_3& p2,
                                      const Indexed_mesh::Space_tensor& metric)
  {
    using std::sqrt;
    const auto a = p1 - p0, b = p2 - p0;
    return Reference_triangle(FT(metric.product(a, a)), FT(metric.product(a, b)),
                              FT(metric.product(b, b)),
                              sqrt(FT(metric.plane_determinant(cross_product(a, b)))));
  }

  /// Constructs a triangle without extent.
  Reference_triangle() {}

  /// Returns the triangle with `w` times its area, by which it counts; its shape and size stay.
  Reference_triangle weighted(const FT& w) const
  {
    Reference_triangle result = *this;
    result.m_area = w * m_area;
    return result;
  }

  /// Returns the area, or that times a weight.
  const FT& area() const { return m_area; }
  /// Returns \f$ g_j \f$.
  Vector half_gradient(int j) const
  {
    const Vector along = {FT(0), m_along};
    return j == 0 ? Vector() - m_other - along : (j == 1) == (m_along > FT(0)) ? m_other : along;
  }

private:
  Reference_triangle(FT e, FT f, FT g, FT twice_area)
  {
    using std::sqrt;
    if(!(e > FT(0)) && !(g > FT(0))) {
      e = g = FT(least_length * least_length);
      f = e / FT(2);
      twice_area = e * sqrt(FT(3)) / FT(2);
    }
    const FT squared_lengths = FT(2) * (e + g - f);
    twice_area = (std::max)(twice_area, FT(2 * least_area) * squared_lengths);
    m_area = twice_area / FT(2);
    // The longer of the two edges along the first axis; grad_j = i W_j / (2A), W_j opposite to j
    const bool is_first = e >= g;
    const FT length = sqrt(is_first ? e : g), s = FT(1) / (FT(2) * twice_area);
    m_along = is_first ? length * s : -length * s;
    m_other = Vector{twice_area / length, is_first ? -f / length : f / length} * s;
  }

  Vector m_other;        // g_1, if m_along > 0, or g_2: of the edge that is not along the axis
  FT m_along = FT(0);    // the second coordinate of the other of them, whose first one is 0
  FT m_area = FT(0);
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_REFERENCE_TRIANGLE_H
