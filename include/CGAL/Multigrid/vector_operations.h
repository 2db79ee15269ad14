// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_VECTOR_OPERATIONS_H
#define CGAL_MULTIGRID_VECTOR_OPERATIONS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/Uninitialized_vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The struct `Value_traits` says what the multigrid layer has to know of the entries of matrices and
vectors. There are specializations for `float`, `double`, `std::complex<float>`,
`std::complex<double>`, and in `Block_values.h` for small square matrices of Eigen, with vectors of as
many numbers, and for `Columns`.

Members, for an entry \f$ v \f$ of a matrix or vector:
- `Real`: the numbers that it consists of, `components` of them one after the other in memory
- `Scalar`: what vectors are multiplied by; `Inner`: inner products, in double precision
- `Vector_value`: an entry of the vectors that a matrix of `Value` multiplies
- `Diagonal`: an entry on the diagonal of a self-adjoint matrix; `Stored`: one beside it, where it
  has no imaginary part
- `Double`: the same in double precision
- `from(x)`: \f$ x \f$ of another precision; `zero()`, `is_zero(v)`, `adjoint(v)`
- `product(v, w)`: \f$ v^H w \f$; `squared_norm(v)`: \f$ \|v\|^2 \f$
- `modulus(v)`: \f$ (v v^H)^{1/2} \f$ in double precision
- `is_positive(d)`: whether a diagonal entry is; `inverse(d)`: the inverse of one in double precision,
  0 if it is not positive; `quotient(x, d)`: \f$ d^{-1} x \f$ for an entry of a vector
- `rows`, `columns`, `coefficient(v, r, c)`: the numbers of an entry as a dense matrix or vector;
  `from_coefficients(p)`: the entry with the numbers `p[0]`, `p[1]`..., column by column
*/
template <class Value>
struct Value_traits;

namespace internal {

// What real and complex numbers have in common.
template <class Number, class Real_>
struct Number_traits
{
  typedef Real_ Real;
  typedef Real_ Stored;
  typedef Real_ Diagonal;
  typedef Number Scalar;
  typedef Number Vector_value;
  typedef std::conditional_t<std::is_same_v<Number, Real>, double, std::complex<double>> Inner;
  typedef Inner Double;
  static constexpr bool is_complex = !std::is_same_v<Number, Real>;
  static constexpr std::size_t components = is_complex ? 2 : 1;
  static constexpr int rows = 1;
  static constexpr int columns = 1;

  template <class Other>
  static Number from(const Other& x) { return Number(x); }
  static Number zero() { return Number(0); }
  static bool is_zero(const Number& v) { return v == Number(0); }
  static Number quotient(const Number& x, const Real& d) { return x / d; }
  static Double coefficient(const Number& v, int, int) { return Double(v); }
  template <class Other>
  static Number from_coefficients(const Other* p) { return Number(*p); }
};

template <class Real>
struct Real_traits
  : Number_traits<Real, Real>
{
  static Real adjoint(Real v) { return v; }
  static double product(Real v, Real w) { return double(v) * double(w); }
  static Real squared_norm(Real v) { return v * v; }
  static double modulus(Real v) { return std::abs(double(v)); }
  static bool is_positive(Real d) { return d > 0; }
  static Real inverse(double d) { return d > 0. ? Real(1. / d) : Real(0); }
};

} // namespace internal

template <>
struct Value_traits<float> : internal::Real_traits<float> {};
template <>
struct Value_traits<double> : internal::Real_traits<double> {};

template <class Real>
struct Value_traits<std::complex<Real>>
  : internal::Number_traits<std::complex<Real>, Real>
{
  typedef std::complex<Real> Complex;
  static Complex adjoint(const Complex& v) { return std::conj(v); }
  static std::complex<double> product(const Complex& v, const Complex& w)
  {
    return std::conj(std::complex<double>(v)) * std::complex<double>(w);
  }
  static Real squared_norm(const Complex& v) { return std::norm(v); }
  static double modulus(const Complex& v) { return std::sqrt(double(std::norm(v))); }
};

/// \ingroup PkgHLSCMMultigrid
/// The vector that a matrix of `Value` multiplies.
template <class Value>
using Value_vector = std::vector<typename Value_traits<Value>::Vector_value>;

/// \ingroup PkgHLSCMMultigrid
/// A vector of complex numbers.
template <class Real>
using Complex_vector = std::vector<std::complex<Real>>;

namespace internal {

// Sums are formed in blocks of this many entries, whose order of addition is fixed: the result
// does not depend on who computes which block.
constexpr std::size_t block_size = 8192;
constexpr std::size_t lane_count = 8;

// Sums over a stretch in lanes; `pair(i, re, im)` adds the i-th term.
template <class Real, class Pair>
inline std::complex<double> sum_in_lanes(std::size_t begin, std::size_t end, const Pair& pair)
{
  Real lane_re[lane_count] = {}, lane_im[lane_count] = {};
  std::size_t i = begin;
  for(; i + lane_count <= end; i += lane_count)
    for(std::size_t l = 0; l < lane_count; ++l)
      pair(i + l, lane_re[l], lane_im[l]);
  for(std::size_t l = 0; i < end; ++i, ++l)
    pair(i, lane_re[l], lane_im[l]);
  std::complex<double> sum = 0.;
  for(std::size_t l = 0; l < lane_count; ++l)
    sum += std::complex<double>(lane_re[l], lane_im[l]);
  return sum;
}

template <class Real, class Pair>
inline std::complex<double> sum_in_blocks(std::size_t n, const Pair& pair)
{
  return Blocked_execution::blocked_sum<std::complex<double>>(
    n, block_size, [&](std::size_t begin, std::size_t end) {
      return sum_in_lanes<Real>(begin, end, pair);
    });
}

// The numbers that the entries of a vector consist of.
template <class V>
const typename Value_traits<V>::Real* numbers(const std::vector<V>& x)
{
  typedef typename Value_traits<V>::Real Real;
  static_assert(sizeof(V) == Value_traits<V>::components * sizeof(Real), "no gaps");
  return reinterpret_cast<const Real*>(x.data());
}

template <class V>
typename Value_traits<V>::Real* numbers(std::vector<V>& x)
{
  return const_cast<typename Value_traits<V>::Real*>(numbers(std::as_const(x)));
}

} // namespace internal

/// \ingroup PkgHLSCMMultigrid
/// Calls `body(i)` for each i in [0, n), possibly at the same time.
template <class Body>
void for_each_index(std::size_t n, const Body& body)
{
  Blocked_execution::blocked_for(n, internal::block_size, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      body(i);
  });
}

/// \ingroup PkgHLSCMMultigrid
/// Makes `x` a vector of `n` zeros.
template <class V>
void set_zero(std::size_t n, std::vector<V>& x)
{
  Blocked_execution::resize_blocked(x, n);
  for_each_index(n, [&x](std::size_t i) { x[i] = Value_traits<V>::zero(); });
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ a^H b \f$, where `b` may be of another precision.
template <class V, class W>
typename Value_traits<V>::Inner inner_product(const std::vector<V>& a, const std::vector<W>& b)
{
  typedef typename Value_traits<V>::Real Real;
  const Real* p = internal::numbers(a);
  const auto* q = internal::numbers(b);
  if constexpr(Value_traits<V>::is_complex)
    return internal::sum_in_blocks<Real>(a.size(), [p, q](std::size_t i, Real& x, Real& y) {
      x += p[2 * i] * Real(q[2 * i]) + p[2 * i + 1] * Real(q[2 * i + 1]);
      y += p[2 * i] * Real(q[2 * i + 1]) - p[2 * i + 1] * Real(q[2 * i]);
    });
  else
    return internal::sum_in_blocks<Real>(a.size() * Value_traits<V>::components,
                                         [p, q](std::size_t i, Real& x, Real&) {
      x += p[i] * Real(q[i]);
    }).real();
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ \|a\|^2 \f$.
template <class V>
double squared_norm(const std::vector<V>& a)
{
  typedef typename Value_traits<V>::Real Real;
  if constexpr(Value_traits<V>::is_complex) {
    const Real* p = internal::numbers(a);
    const std::complex<double> sum
      = internal::sum_in_blocks<Real>(a.size(), [p](std::size_t i, Real& x, Real& y) {
          x += p[2 * i] * p[2 * i];
          y += p[2 * i + 1] * p[2 * i + 1];
        });
    return sum.real() + sum.imag();
  } else
    return inner_product(a, a);
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ \max_i |a_i| \f$.
template <class V>
double largest_entry(const std::vector<V>& a)
{
  typedef typename Value_traits<V>::Real Real;
  std::vector<Real> part(Blocked_execution::number_of_blocks(a.size(), internal::block_size), 0);
  Blocked_execution::blocked_for(a.size(), internal::block_size,
                                 [&](std::size_t begin, std::size_t end) {
    Real largest = 0;
    for(std::size_t i = begin; i < end; ++i)
      largest = (std::max)(largest, Value_traits<V>::squared_norm(a[i]));
    part[begin / internal::block_size] = largest;
  });
  return part.empty() ? 0. : std::sqrt(double(*std::max_element(part.begin(), part.end())));
}

/// \ingroup PkgHLSCMMultigrid
/// Returns the longer side of the bounding box of the numbers; 0 if there are none.
template <class Real>
double extent(const Complex_vector<Real>& a)
{
  if(a.empty())
    return 0.;
  std::complex<Real> lo = a[0], hi = a[0];
  for(const std::complex<Real>& z : a) {
    lo = {(std::min)(lo.real(), z.real()), (std::min)(lo.imag(), z.imag())};
    hi = {(std::max)(hi.real(), z.real()), (std::max)(hi.imag(), z.imag())};
  }
  return double((std::max)(hi.real() - lo.real(), hi.imag() - lo.imag()));
}

/// \ingroup PkgHLSCMMultigrid
/// Adds \f$ s\, x \f$ to `y`.
template <class V>
void add_scaled(typename Value_traits<V>::Scalar s, const std::vector<V>& x, std::vector<V>& y)
{
  typedef typename Value_traits<V>::Real Real;
  const Real* p = internal::numbers(x);
  Real* q = internal::numbers(y);
  if constexpr(Value_traits<V>::is_complex) {
    const Real a = s.real(), b = s.imag();
    for_each_index(x.size(), [=](std::size_t i) {
      const Real re = p[2 * i], im = p[2 * i + 1];
      q[2 * i] += a * re - b * im;
      q[2 * i + 1] += a * im + b * re;
    });
  } else
    for_each_index(x.size() * Value_traits<V>::components,
                   [=](std::size_t i) { q[i] += s * p[i]; });
}

/// \ingroup PkgHLSCMMultigrid
/// A matrix of a few rows and columns.
template <class Inner, std::size_t N>
using Small_matrix = std::array<std::array<Inner, N>, N>;

/*!
\ingroup PkgHLSCMMultigrid

Diagonalizes the first `n` rows and columns of a Hermitian matrix `a`, of real or complex numbers of
double precision, by Jacobi's rotations: they become the eigenvalues, in no order. Returns the
eigenvectors as columns. Eigen's solvers for such small problems would take a fifth of the time in which
a program with the parameterizer is compiled.
*/
template <class Inner, std::size_t N>
Small_matrix<Inner, N> diagonalize(int n, Small_matrix<Inner, N>& a)
{
  constexpr int most_sweeps = 30; // quadratic convergence makes four or five of it
  constexpr double negligible = 1e-17;
  Small_matrix<Inner, N> v = {};
  for(int i = 0; i < n; ++i)
    v[i][i] = 1.;
  bool is_diagonal = false;
  for(int sweep = 0; sweep < most_sweeps && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for(int p = 0; p < n; ++p)
      for(int q = p + 1; q < n; ++q) {
        const double r = std::abs(a[p][q]), app = std::real(a[p][p]), aqq = std::real(a[q][q]);
        if(!(r > negligible * (std::abs(app) + std::abs(aqq))))
          continue;
        is_diagonal = false;
        // The rotation that makes of the columns x and y: c x - s z y and s x + c z y
        const Inner z = Value_traits<Inner>::adjoint(a[p][q]) / r;
        const double theta = (aqq - app) / (2. * r);
        const double t = (theta < 0. ? -1. : 1.) / (std::abs(theta) + std::hypot(theta, 1.));
        const double c = 1. / std::hypot(t, 1.), s = t * c;
        for(Small_matrix<Inner, N>* m : {&a, &v})
          for(int i = 0; i < n; ++i) {
            const Inner x = (*m)[i][p], y = z * (*m)[i][q];
            (*m)[i][p] = c * x - s * y;
            (*m)[i][q] = s * x + c * y;
          }
        for(int j = 0; j < n; ++j) {
          const Inner x = a[p][j], y = Value_traits<Inner>::adjoint(z) * a[q][j];
          a[p][j] = c * x - s * y;
          a[q][j] = s * x + c * y;
        }
        a[p][q] = a[q][p] = 0.;
      }
  }
  return v;
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_VECTOR_OPERATIONS_H
