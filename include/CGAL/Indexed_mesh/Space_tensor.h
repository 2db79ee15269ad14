// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_SPACE_TENSOR_H
#define CGAL_INDEXED_MESH_SPACE_TENSOR_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Indexed_mesh {

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Space_tensor` is a symmetric tensor of space. Of that of a triangle only its part in the
plane of the triangle counts: as a metric it says how long the triangle's edges are.
*/
struct Space_tensor
{
  typedef Simple_cartesian<double>::Vector_3 Vector_3; ///< a vector of space

  /// \name Entries
  /// @{
  double xx = 0., xy = 0., xz = 0., yy = 0., yz = 0., zz = 0.;
  /// @}

  /// Returns a multiple of the identity.
  static Space_tensor identity(double s = 1.) { return {s, 0., 0., s, 0., s}; }

  /// Returns the product of a vector with itself.
  static Space_tensor square(const Vector_3& v)
  {
    return {v.x() * v.x(), v.x() * v.y(), v.x() * v.z(), v.y() * v.y(), v.y() * v.z(), v.z() * v.z()};
  }

  /// Returns the sum.
  Space_tensor operator+(const Space_tensor& t) const
  {
    return {xx + t.xx, xy + t.xy, xz + t.xz, yy + t.yy, yz + t.yz, zz + t.zz};
  }
  /// Returns a multiple.
  Space_tensor operator*(double s) const
  {
    return {xx * s, xy * s, xz * s, yy * s, yz * s, zz * s};
  }
  /// Returns the image of a vector.
  Vector_3 operator*(const Vector_3& v) const
  {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }

  /// Returns the product \f$ a \cdot T b \f$ of two vectors.
  double product(const Vector_3& a, const Vector_3& b) const { return a * (*this * b); }

  /// Returns the trace.
  double trace() const { return xx + yy + zz; }

  /// Returns the determinant of the part in the plane with the normal `n`, times \f$ |n|^2 \f$: for
  /// \f$ n = a \times b \f$ it is
  /// \f$ (a \cdot T a)(b \cdot T b) - (a \cdot T b)^2 = n \cdot \mathrm{cof}(T) n \f$, the square of
  /// twice the area of the triangle of \f$ a \f$ and \f$ b \f$, without cancellation in needles.
  double plane_determinant(const Vector_3& n) const
  {
    const Space_tensor cofactor = {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
                                   xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
    return (std::max)(0., cofactor.product(n, n));
  }
};

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_SPACE_TENSOR_H
