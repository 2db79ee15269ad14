// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_VECTOR_OPERATIONS_H
#define CGAL_MULTIGRID_VECTOR_OPERATIONS_H

#include <algorithm>
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
constexpr std::size_t block_size = 4096;
constexpr std::size_t lane_count = 8;

// Sums value(i), a pair of reals, over a block, in lanes.
template <class Real, class Pair>
inline void sum_block(std::size_t begin, std::size_t end, const Pair& pair, double& re, double& im)
{
  Real lane_re[lane_count] = {}, lane_im[lane_count] = {};
  std::size_t i = begin;
  for(; i + lane_count <= end; i += lane_count)
    for(std::size_t l = 0; l < lane_count; ++l)
      pair(i + l, lane_re[l], lane_im[l]);
  for(std::size_t l = 0; i < end; ++i, ++l)
    pair(i, lane_re[l], lane_im[l]);
  for(std::size_t l = 0; l < lane_count; ++l) {
    re += double(lane_re[l]);
    im += double(lane_im[l]);
  }
}

} // namespace internal

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ a^H b \f$.
template <class Real, class Other>
std::complex<double> inner_product(const Complex_vector<Real>& a, const Complex_vector<Other>& b)
{
  const Real* p = reinterpret_cast<const Real*>(a.data());
  const Other* q = reinterpret_cast<const Other*>(b.data());
  double re = 0., im = 0.;
  for(std::size_t begin = 0; begin < a.size(); begin += internal::block_size)
    internal::sum_block<Real>(begin, (std::min)(begin + internal::block_size, a.size()),
                              [p, q](std::size_t i, Real& x, Real& y) {
                                x += p[2 * i] * Real(q[2 * i]) + p[2 * i + 1] * Real(q[2 * i + 1]);
                                y += p[2 * i] * Real(q[2 * i + 1]) - p[2 * i + 1] * Real(q[2 * i]);
                              }, re, im);
  return {re, im};
}

/// \ingroup PkgHLSCMMultigrid
/// Returns \f$ \|a\|^2 \f$.
template <class Real>
double squared_norm(const Complex_vector<Real>& a)
{
  const Real* p = reinterpret_cast<const Real*>(a.data());
  double re = 0., im = 0.;
  for(std::size_t begin = 0; begin < a.size(); begin += internal::block_size)
    internal::sum_block<Real>(begin, (std::min)(begin + internal::block_size, a.size()),
                              [p](std::size_t i, Real& x, Real& y) {
                                x += p[2 * i] * p[2 * i];
                                y += p[2 * i + 1] * p[2 * i + 1];
                              }, re, im);
  return re + im;
}

/// \ingroup PkgHLSCMMultigrid
/// Adds \f$ s\, x \f$ to `y`.
template <class Real>
void add_scaled(std::complex<Real> s, const Complex_vector<Real>& x, Complex_vector<Real>& y)
{
  const Real* p = reinterpret_cast<const Real*>(x.data());
  Real* q = reinterpret_cast<Real*>(y.data());
  const Real a = s.real(), b = s.imag();
  for(std::size_t i = 0; i < x.size(); ++i) {
    const Real re = p[2 * i], im = p[2 * i + 1];
    q[2 * i] += a * re - b * im;
    q[2 * i + 1] += a * im + b * re;
  }
}

/// \ingroup PkgHLSCMMultigrid
/// Sets `y` to \f$ s\, y \f$.
template <class Real>
void scale(std::complex<Real> s, Complex_vector<Real>& y)
{
  Real* q = reinterpret_cast<Real*>(y.data());
  const Real a = s.real(), b = s.imag();
  for(std::size_t i = 0; i < y.size(); ++i) {
    const Real re = q[2 * i], im = q[2 * i + 1];
    q[2 * i] = a * re - b * im;
    q[2 * i + 1] = a * im + b * re;
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_VECTOR_OPERATIONS_H
