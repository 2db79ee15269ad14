// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
#define CGAL_MULTIGRID_CONJUGATE_GRADIENT_H

#include <CGAL/Multigrid/Hermitian_matrix.h>
#include <CGAL/Multigrid/Iteration_control.h>

#include <cmath>
#include <complex>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

Minimizes the energy \f$ E(x) = \frac12 x^H H x \f$ over the free unknowns by the flexible
preconditioned conjugate gradient method, from the given `x`. Rows of the fixed unknowns (pins) are
zero in `h`, their values in `x` are kept.

\param h the matrix
\param x the unknowns
\param energy \f$ E(x) \f$ on entry, where the whole energy counts, that of the pins' rows too
\param precondition `precondition(r, z)` sets z to an approximation of \f$ H^{-1} r \f$; it may
       change from step to step, but must keep the pins at 0
\param stop when to stop
\param observe `observe(part)` is told after each step how far the iteration has come, in [0, 1];
       returning false stops it

Four vectors beside `x`; one product with the matrix, one preconditioning a step.
*/
template <class Real, class Precondition, class Observe>
Iteration_report minimize_energy(const Hermitian_matrix<Real>& h, Complex_vector<Real>& x,
                                 double energy, const Precondition& precondition,
                                 const Energy_stop& stop, const Observe& observe)
{
  typedef std::complex<Real> Complex;
  const std::size_t n = x.size();
  Complex_vector<Real> r, p, q, z;
  for(Complex_vector<Real>* vector : {&r, &p, &q, &z})
    Blocked_execution::resize_blocked(*vector, n);
  h.for_each_row_sum(x, [&](std::size_t i, Complex s) { r[i] = -(h.diagonal()[i] * x[i] + s); });
  Iteration_control control(stop, energy);
  double curvature = 0.;
  while(control.goes_on()) {
    precondition(r, z);
    if(curvature > 0.) // make the direction H-orthogonal to the last one
      add_scaled(Complex(-inner_product(q, z) / curvature), p, z);
    p.swap(z);
    h.multiply(p, q);
    curvature = inner_product(p, q).real();
    const std::complex<double> slope = inner_product(p, r);
    if(!(curvature > 0.)) { // r is 0, or no longer above rounding
      control.end(std::norm(slope) == 0. || !(curvature < 0.));
      break;
    }
    const Complex alpha(slope / curvature);
    add_scaled(alpha, p, x);
    add_scaled(-alpha, q, r);
    const double decrease = 0.5 * std::norm(slope) / curvature;
    const double change = control.watches_changes() ? std::abs(alpha) * largest_entry(p) : 0.;
    control.step(control.report().energy - decrease, decrease, change, observe);
  }
  return control.report();
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
