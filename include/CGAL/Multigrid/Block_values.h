// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_BLOCK_VALUES_H
#define CGAL_MULTIGRID_BLOCK_VALUES_H

#include <CGAL/Multigrid/vector_operations.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

Small real blocks, such as the 2 x 2 ones of an elastic energy in the plane: the entries of a matrix
are `Eigen::Matrix<Real, N, N>`, those of its vectors `Eigen::Matrix<Real, N, 1>`, or
`Eigen::Matrix<Real, 1, N>` if the matrix is one of `Columns`. A pin is a whole row of blocks that are
0. The members are those of the other specializations.
*/
template <class Real_, int N, int Columns, int Options>
struct Value_traits<Eigen::Matrix<Real_, N, Columns, Options, N, Columns>>
{
  static_assert(N > 0 && (Columns == N || Columns == 1 || N == 1), "a square block or a vector");

  /// \cond SKIP_IN_MANUAL
  typedef Eigen::Matrix<Real_, N, Columns, Options, N, Columns> Block;

  typedef Real_ Real;
  typedef Block Stored;
  typedef Block Diagonal;
  typedef Real Scalar;
  typedef Eigen::Matrix<Real, N, 1> Vector_value;
  typedef double Inner;
  typedef Eigen::Matrix<double, N, Columns> Double;
  static constexpr bool is_complex = false;
  static constexpr std::size_t components = N * Columns;
  static constexpr int rows = N;
  static constexpr int columns = Columns;

  template <class Other>
  static Block from(const Eigen::MatrixBase<Other>& x) { return x.template cast<Real>(); }
  static Block zero() { return Block::Zero(); }
  static bool is_zero(const Block& v) { return !(v.array() != Real(0)).any(); }
  static Eigen::Matrix<Real, Columns, N> adjoint(const Block& v) { return v.transpose(); }
  static double product(const Block& v, const Block& w)
  {
    return v.template cast<double>().cwiseProduct(w.template cast<double>()).sum();
  }
  static Real squared_norm(const Block& v) { return v.squaredNorm(); }
  static Double modulus(const Block& v)
  {
    const Double d = v.template cast<double>();
    if constexpr(N == 2 && Columns == 2) { // by the theorem of Cayley and Hamilton
      const double det = std::abs(d.determinant()), trace = std::sqrt(d.squaredNorm() + 2. * det);
      return trace > 0. ? Double((d * d.transpose() + det * Double::Identity()) / trace)
                        : Double(Double::Zero());
    } else
      return with_eigenvalues(d * d.transpose(), [](double s) { return s > 0. ? std::sqrt(s) : 0.; });
  }
  static bool is_positive(const Block& d) { return d.trace() > 0; }
  /// Of the part that is positive: a component without any entry stays 0.
  static Block inverse(const Double& d)
  {
    const double least = 1e-14 * d.diagonal().cwiseAbs().maxCoeff(); // rounding of d's entries
    if constexpr(N == 2 && Columns == 2) {
      const double det = d.determinant(), trace = d.trace();
      if(trace > 0. && det > least * trace) // both eigenvalues are larger than that
        return from((Double() << d(1, 1), -d(0, 1), -d(1, 0), d(0, 0)).finished() / det);
    }
    return from(with_eigenvalues(d, [least](double s) { return s > least ? 1. / s : 0.; }));
  }
  static Vector_value quotient(const Vector_value& x, const Block& d) { return d.ldlt().solve(x); }
  static double coefficient(const Block& v, int r, int c) { return double(v(r, c)); }
  static Block from_coefficients(const double* p) { return from(Eigen::Map<const Double>(p)); }

private:
  // The symmetric matrix d with its eigenvalues s replaced by f(s).
  template <class Function>
  static Double with_eigenvalues(const Double& d, const Function& f)
  {
    Small_matrix<double, N> a = {};
    for(int i = 0; i < N; ++i)
      for(int j = 0; j <= i; ++j)
        a[i][j] = a[j][i] = d(i, j);
    const Small_matrix<double, N> v = diagonalize(N, a);
    Double result = Double::Zero();
    for(int k = 0; k < N; ++k) {
      const double value = f(a[k][k]);
      for(int i = 0; i < N; ++i)
        for(int j = 0; j < N; ++j)
          result(i, j) += v[i][k] * value * v[j][k];
    }
    return result;
  }
  /// \endcond
};

/*!
\ingroup PkgHLSCMMultigrid

The struct `Columns` is a real number as the entry of a matrix whose vectors have N columns: N
right-hand sides, such as the coordinates of points, for which the matrix is read only once. The
entries of its vectors are `Eigen::Matrix<Real, 1, N>`.
*/
template <class Real, int N>
struct Columns
{
  Real value = Real(0); ///< the number

  Columns() {}
  /// Constructs it from a number.
  explicit Columns(const Real& v) : value(v) {}
  /// Returns the product with a row of a vector.
  Eigen::Matrix<Real, 1, N> operator*(const Eigen::Matrix<Real, 1, N>& x) const { return value * x; }
};

template <class Real_, int N>
struct Value_traits<Columns<Real_, N>>
{
  /// \cond SKIP_IN_MANUAL
  typedef Real_ Real;
  typedef Real Stored;
  typedef Real Diagonal;
  typedef Real Scalar;
  typedef Eigen::Matrix<Real, 1, N> Vector_value;
  typedef double Inner;
  typedef double Double;
  static constexpr bool is_complex = false;
  static constexpr std::size_t components = 1;
  static constexpr int rows = 1;
  static constexpr int columns = 1;

  static bool is_zero(const Columns<Real, N>& v) { return v.value == Real(0); }
  static Columns<Real, N> adjoint(const Columns<Real, N>& v) { return v; }
  static double modulus(const Columns<Real, N>& v) { return std::abs(double(v.value)); }
  static double coefficient(const Columns<Real, N>& v, int, int) { return double(v.value); }
  /// \endcond
};

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_BLOCK_VALUES_H
