// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
#define CGAL_MULTIGRID_CONJUGATE_GRADIENT_H

#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Multigrid/vector_operations.h>

#include <cmath>
#include <complex>
#include <vector>

namespace CGAL {
namespace Multigrid {

namespace internal {

// The steps from x, where the residual is r and the energy `energy`; r is lost.
template <class V>
Iteration_report conjugate_gradients(const Iteration_parts<V>& parts, std::vector<V>& x,
                                     std::vector<V>& r, double energy, const Energy_stop& stop)
{
  typedef typename Value_traits<V>::Scalar Scalar;
  std::vector<V> p, q, z;
  for(std::vector<V>* vector : {&p, &q, &z})
    Blocked_execution::resize_blocked(*vector, x.size());
  Iteration_control control(stop, energy);
  double curvature = 0.;
  while(control.goes_on()) {
    if(control.watches_residual() && control.take_residual(std::sqrt(squared_norm(r))))
      break;
    parts.precondition(r, z);
    if(curvature > 0.) // make the direction H-orthogonal to the last one
      add_scaled(Scalar(-inner_product(q, z) / curvature), p, z);
    p.swap(z);
    parts.apply(p, q);
    curvature = std::real(inner_product(p, q));
    const auto slope = inner_product(p, r);
    if(!(curvature > 0.)) { // r is 0, or no longer above rounding
      control.end(std::norm(slope) == 0. || !(curvature < 0.));
      break;
    }
    const Scalar alpha(slope / curvature);
    add_scaled(alpha, p, x);
    add_scaled(-alpha, q, r);
    const double decrease = 0.5 * std::norm(slope) / curvature;
    const double change = control.watches_changes() ? std::abs(alpha) * largest_entry(p) : 0.;
    control.step(control.report().energy - decrease, decrease, change, parts.observe);
  }
  return control.report();
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

Minimizes the energy \f$ E(x) = \frac12 x^H H x \f$ over the free unknowns by the flexible
preconditioned conjugate gradient method, from the given `x`. Rows of the fixed unknowns (pins) are
zero in \f$ H \f$, their values in `x` are kept.

\param apply \f$ H \f$, a model of `MultigridOperator`: `apply(x, y)` sets y, of the same size, to
       \f$ H x \f$; a `Self_adjoint_matrix` does
\param x the unknowns, of any type that `Value_traits` knows
\param energy \f$ E(x) \f$ on entry, where the whole energy counts, that of the pins' rows too
\param precondition a model of `MultigridPreconditioner`: `precondition(r, z)` sets z to an
       approximation of \f$ H^{-1} r \f$; it may change from step to step, but must keep the pins at
       0
\param stop when to stop
\param observe `observe(part)` is told after each step how far the iteration has come, in [0, 1];
       returning false stops it

Four vectors beside `x`; one product with the matrix, one preconditioning a step.
*/
template <class Apply, class V, class Precondition, class Observe>
Iteration_report minimize_energy(const Apply& apply, std::vector<V>& x, double energy,
                                 const Precondition& precondition, const Energy_stop& stop,
                                 const Observe& observe)
{
  std::vector<V> r;
  Blocked_execution::resize_blocked(r, x.size());
  apply(x, r);
  for_each_index(r.size(), [&r](std::size_t i) { r[i] = -r[i]; });
  return internal::conjugate_gradients<V>({apply, precondition, observe}, x, r, energy, stop);
}

/*!
\ingroup PkgHLSCMMultigrid

Minimizes \f$ E(x) = \frac12 x^H H x - \mathrm{Re}\, f^H x \f$ in the same way: solves \f$ H x = f
\f$. Where rows are zero (pins), `f` must be, too. It is not kept: who still wants it gives a copy.
*/
template <class Apply, class V, class Precondition, class Observe>
Iteration_report minimize_energy(const Apply& apply, std::vector<V> f, std::vector<V>& x,
                                 const Precondition& precondition, const Energy_stop& stop,
                                 const Observe& observe)
{
  const auto linear = inner_product(x, f);
  std::vector<V> product;
  Blocked_execution::resize_blocked(product, x.size());
  apply(x, product);
  for_each_index(f.size(), [&](std::size_t i) { f[i] -= product[i]; });
  std::vector<V>().swap(product);
  const double energy = -0.5 * std::real(inner_product(x, f) + linear);
  return internal::conjugate_gradients<V>({apply, precondition, observe}, x, f, energy, stop);
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
