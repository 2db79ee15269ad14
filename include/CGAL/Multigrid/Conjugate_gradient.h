// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
#define CGAL_MULTIGRID_CONJUGATE_GRADIENT_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// When `Conjugate_gradient` stops.
struct Energy_stop
{
  double tolerance = 1e-2;         ///< of \f$ (E - E_{\min}) / E \f$
  std::size_t minimal_iterations = 0;  ///< at least so many
  std::size_t maximal_iterations = 100; ///< at most so many
};

/// \ingroup PkgHLSCMMultigrid
/// What became of a solution.
struct Iteration_report
{
  std::size_t iterations = 0;    ///< those that were made
  bool converged = false;        ///< whether the tolerance is met, as far as can be estimated
  bool cancelled = false;        ///< whether the observer stopped it
  double energy = 0.;            ///< \f$ E \f$ at the end
  double energy_gap = 0.;        ///< estimate of \f$ E - E_{\min} \f$
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Energy_gap_estimator` predicts how much a conjugate gradient iteration has still to gain.
The energy falls by a known amount \f$ d_k \f$ in each step; the sum of the steps to come is
extrapolated from the last ones as a geometric series.
*/
class Energy_gap_estimator
{
public:
  /// Tells by how much the last step lowered the energy.
  void add(double decrease) { m_decreases.push_back(decrease); }

  /// Returns the estimate of what remains after the last step; infinity before the third.
  double remaining() const
  {
    const std::size_t n = m_decreases.size();
    if(n < 3)
      return (std::numeric_limits<double>::infinity)();
    // The slowest rate of the last steps: mean rates over one, two, four ... steps
    const double last = larger_of_two(n - 1);
    double rate = 0.;
    for(std::size_t span = 1; span < n && span <= long_iteration; span *= 2) {
      const double before = larger_of_two(n - 1 - span);
      if(before > 0.)
        rate = (std::max)(rate, std::pow(last / before, 1. / double(span)));
    }
    if(rate >= 1.)
      return (std::numeric_limits<double>::infinity)();
    const double extrapolated = safety(n) * last * rate / (1. - rate);
    return n > long_iteration ? (std::max)(extrapolated, gain_of_second_half()) : extrapolated;
  }

private:
  // Single steps are often small by chance: of two, the larger counts.
  double larger_of_two(std::size_t k) const
  {
    return k == 0 ? m_decreases[0] : (std::max)(m_decreases[k], m_decreases[k - 1]);
  }

  // On 17 charts of 17K to 1.1M faces, each with two hierarchies, a factor of 2 was enough for the
  // true gap to stay below the tolerance for 1e-2, 1e-3 and 1e-4; it costs half a step on average.
  // Short histories say less about the rate: other schedules were 2.7 times off after four steps.
  static double safety(std::size_t n) { return 2. + 4. / double(n); }

  // Without a good preconditioner the energy falls in steps with plateaus between them, which look
  // like the end. Each is about as long as all before it: what the second half of the iteration has
  // gained is a warning.
  static constexpr std::size_t long_iteration = 64;

  double gain_of_second_half() const
  {
    double sum = 0.;
    for(std::size_t k = m_decreases.size() / 2; k < m_decreases.size(); ++k)
      sum += m_decreases[k];
    return sum;
  }

  std::vector<double> m_decreases;
};

namespace internal {

// The part of an iteration that is done, in [0, 1], as far as its estimates tell: on a logarithmic
// scale from the first one to the tolerance.
class Iteration_progress
{
public:
  explicit Iteration_progress(const Energy_stop& stop) : m_tolerance(stop.tolerance) {}

  double operator()(const Iteration_report& report)
  {
    if(!(m_first_gap < (std::numeric_limits<double>::infinity)()))
      m_first_gap = report.energy_gap;
    const double goal = m_tolerance * std::abs(report.energy);
    if(!(goal > 0. && goal < m_first_gap && report.energy_gap < m_first_gap))
      return 0.;
    const double part = std::log(m_first_gap / report.energy_gap) / std::log(m_first_gap / goal);
    return (std::max)(0., (std::min)(part, 1.));
  }

private:
  double m_tolerance, m_first_gap = (std::numeric_limits<double>::infinity)();
};

} // namespace internal

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
  Complex_vector<Real> r(n), p(n), q(n), z(n);
  h.for_each_row_sum(x, [&](std::size_t i, Complex s) { r[i] = -(h.diagonal()[i] * x[i] + s); });
  Iteration_report report;
  report.energy = energy;
  report.energy_gap = (std::numeric_limits<double>::infinity)();
  Energy_gap_estimator estimator;
  internal::Iteration_progress progress(stop);
  double curvature = 0.;
  while(report.iterations < stop.maximal_iterations) {
    precondition(r, z);
    if(curvature > 0.) // make the direction H-orthogonal to the last one
      add_scaled(Complex(-inner_product(q, z) / curvature), p, z);
    p.swap(z);
    h.multiply(p, q);
    curvature = inner_product(p, q).real();
    const std::complex<double> slope = inner_product(p, r);
    if(!(curvature > 0.)) { // no direction is left: r is 0, or no longer above rounding
      report.converged = std::norm(slope) == 0. || !(curvature < 0.);
      report.energy_gap = 0.;
      break;
    }
    const Complex alpha(slope / curvature);
    add_scaled(alpha, p, x);
    add_scaled(-alpha, q, r);
    ++report.iterations;
    const double decrease = 0.5 * std::norm(slope) / curvature;
    report.energy -= decrease;
    estimator.add(decrease);
    report.energy_gap = estimator.remaining();
    if(report.iterations >= stop.minimal_iterations
       && report.energy_gap <= stop.tolerance * std::abs(report.energy)) {
      report.converged = true;
      break;
    }
    if(!observe(progress(report))) {
      report.cancelled = true;
      break;
    }
  }
  return report;
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_CONJUGATE_GRADIENT_H
