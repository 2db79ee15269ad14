// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_VECTOR_OPERATIONS_H
#define CGAL_MULTIGRID_VECTOR_OPERATIONS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/memory.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Multigrid {

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
template <class Real>
void set_zero(std::size_t n, Complex_vector<Real>& x)
{
  Blocked_execution::resize_blocked(x, n);
  for_each_index(n, [&x](std::size_t i) { x[i] = 0; });
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ a^H b \f$.
template <class Real, class Other>
std::complex<double> inner_product(const Complex_vector<Real>& a, const Complex_vector<Other>& b)
{
  const Real* p = reinterpret_cast<const Real*>(a.data());
  const Other* q = reinterpret_cast<const Other*>(b.data());
  return internal::sum_in_blocks<Real>(a.size(), [p, q](std::size_t i, Real& x, Real& y) {
    x += p[2 * i] * Real(q[2 * i]) + p[2 * i + 1] * Real(q[2 * i + 1]);
    y += p[2 * i] * Real(q[2 * i + 1]) - p[2 * i + 1] * Real(q[2 * i]);
  });
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ \|a\|^2 \f$.
template <class Real>
double squared_norm(const Complex_vector<Real>& a)
{
  const Real* p = reinterpret_cast<const Real*>(a.data());
  const std::complex<double> sum
    = internal::sum_in_blocks<Real>(a.size(), [p](std::size_t i, Real& x, Real& y) {
        x += p[2 * i] * p[2 * i];
        y += p[2 * i + 1] * p[2 * i + 1];
      });
  return sum.real() + sum.imag();
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ \max_i |a_i| \f$.
template <class Real>
double largest_entry(const Complex_vector<Real>& a)
{
  std::vector<Real> part(Blocked_execution::number_of_blocks(a.size(), internal::block_size), 0);
  Blocked_execution::blocked_for(a.size(), internal::block_size,
                                 [&](std::size_t begin, std::size_t end) {
    Real largest = 0;
    for(std::size_t i = begin; i < end; ++i)
      largest = (std::max)(largest, std::norm(a[i]));
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
template <class Real>
void add_scaled(std::complex<Real> s, const Complex_vector<Real>& x, Complex_vector<Real>& y)
{
  const Real* p = reinterpret_cast<const Real*>(x.data());
  Real* q = reinterpret_cast<Real*>(y.data());
  const Real a = s.real(), b = s.imag();
  for_each_index(x.size(), [=](std::size_t i) {
    const Real re = p[2 * i], im = p[2 * i + 1];
    q[2 * i] += a * re - b * im;
    q[2 * i + 1] += a * im + b * re;
  });
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_VECTOR_OPERATIONS_H
