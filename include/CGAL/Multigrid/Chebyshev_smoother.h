// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_CHEBYSHEV_SMOOTHER_H
#define CGAL_MULTIGRID_CHEBYSHEV_SMOOTHER_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <cmath>

namespace CGAL {
namespace Multigrid {

namespace internal {

// The entry of `l1_inverse_diagonal()` for the row in `slot`.
template <class Real>
Real l1_inverse(const Hermitian_matrix<Real>& h, std::size_t slot)
{
  double sum = 0.;
  h.for_each_entry(slot, [&](std::uint32_t, std::complex<Real> value) {
    sum += std::sqrt(double(std::norm(value)));
  });
  const Real diagonal = h.diagonal()[h.pattern().row_of_slot[slot]];
  sum = 0.5 * (double(diagonal) + sum);
  return diagonal > 0 && sum > 0. ? Real(1. / sum) : Real(0);
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

Returns the inverses of \f$ D_i = \frac12 ( H_{ii} + \sum_{j \ne i} |H_{ij}| ) \f$, with which no
eigenvalue of \f$ D^{-1} H \f$ exceeds 2 whatever the signs of the entries (for a matrix of
cotangents of acute triangles \f$ D \f$ is the diagonal). Rows of zeros, those of pins, get 0.
*/
template <class Real>
std::vector<Real> l1_inverse_diagonal(const Hermitian_matrix<Real>& h)
{
  std::vector<Real> inverse(h.size());
  for_each_index(h.size(), [&](std::size_t slot) {
    inverse[h.pattern().row_of_slot[slot]] = internal::l1_inverse(h, slot);
  });
  return inverse;
}

/*!
\ingroup PkgHLSCMMultigrid

Takes `steps` steps of the Chebyshev method of the fourth kind (Lottes 2022) on \f$ H u = f \f$ for
the spectrum (0, 2] of \f$ D^{-1} H \f$: a smoother that is symmetric, needs no estimate of an
eigenvalue and no order of the unknowns.

\param h the matrix
\param inverse_diagonal \f$ D^{-1} \f$ of `l1_inverse_diagonal()`
\param steps their number, > 0
\param u the unknowns, updated
\param r on entry the residual \f$ f - H u \f$; on exit that of the last but one step
\param z on exit the last step, so that the residual is now \f$ r - H z \f$

Costs `steps` - 1 products with the matrix.
*/
template <class Real>
void chebyshev_steps(const Hermitian_matrix<Real>& h, const std::vector<Real>& inverse_diagonal,
                     unsigned int steps, Complex_vector<Real>& u, Complex_vector<Real>& r,
                     Complex_vector<Real>& z)
{
  const std::size_t n = u.size();
  z.resize(n);
  constexpr Real bound = Real(2);
  Real old_weight = 0, new_weight = Real(4) / (3 * bound);
  for_each_index(n, [&](std::size_t i) {
    z[i] = new_weight * inverse_diagonal[i] * r[i];
    u[i] += z[i];
  });
  for(unsigned int k = 2; k <= steps; ++k) {
    h.for_each_row_sum(z, [&](std::size_t i, std::complex<Real> s) {
      r[i] -= h.diagonal()[i] * z[i] + s;
    });
    old_weight = Real(2 * k - 3) / Real(2 * k + 1);
    new_weight = Real(8 * k - 4) / (Real(2 * k + 1) * bound);
    for_each_index(n, [&](std::size_t i) {
      z[i] = old_weight * z[i] + new_weight * inverse_diagonal[i] * r[i];
      u[i] += z[i];
    });
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_CHEBYSHEV_SMOOTHER_H
