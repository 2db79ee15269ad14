// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_ITERATION_CONTROL_H
#define CGAL_MULTIGRID_ITERATION_CONTROL_H

#include <CGAL/Blocked_execution/compile_once.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// How far the steps of an iteration that were made are believed to say what the next ones do.
enum class Gap_estimate
{
  STEADY, ///< the energy falls steadily, as under a K-cycle that smooths well
  /// What changes slowest is hardly seen at first, or the energy falls in bursts, as under V-cycles
  /// and with little smoothing.
  WARY
};

/// \ingroup PkgHLSCMMultigrid
/// When an iteration that lowers an energy stops.
struct Energy_stop
{
  double tolerance = 1e-2;         ///< of \f$ (E - E_{\min}) / E \f$
  /// The least energy for which the tolerance is meant: where \f$ E \f$ is smaller, it counts as
  /// this.
  double least_energy = 0.;
  /// What is left of an energy whose minimum is 0 when no step can lower it any further, because of
  /// rounding. From the 50th iteration on, an energy below this ends the iteration: no part of 0
  /// can be met as a tolerance.
  double negligible_energy = 0.;
  /// Of the change of an unknown that is still to come; 0 if it does not matter. The first of the
  /// two tolerances that is met ends the iteration.
  double change_tolerance = 0.;
  /// Norm of the residual that ends the iteration at once, whatever the energy; 0 if it does not
  /// matter.
  double residual_tolerance = 0.;
  double known_rate = 0.;          ///< see `Energy_gap_estimator`
  Gap_estimate estimate = Gap_estimate::STEADY; ///< how careful the estimate is
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
  double decrease = 0.;          ///< of \f$ E \f$ in one of the last two steps, their mean
  double rate = 0.;              ///< `Energy_gap_estimator::rate()` at the end
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Energy_gap_estimator` predicts how much a conjugate gradient iteration has still to gain.
The energy falls by a known amount \f$ d_k \f$ in each step; the sum of the steps to come is
extrapolated from the last ones as a geometric series. A wary estimator also remembers what it
extrapolated before: if more has been gained since, it was wrong by a factor, and may be so again.
*/
class Energy_gap_estimator
{
public:
  /// Constructs an estimator, for an iteration whose steps are known to lower the energy by this
  /// factor, one to the next, from an earlier iteration with the same matrix; 0 if nothing is
  /// known.
  explicit Energy_gap_estimator(double known_rate = 0.,
                                Gap_estimate estimate = Gap_estimate::STEADY)
    : m_known_rate(known_rate), m_is_wary(estimate == Gap_estimate::WARY)
  {}

  /// Tells by how much the last step lowered the energy.
  void add(double decrease)
  {
    m_decreases.push_back(decrease);
    if(m_is_wary)
      m_extrapolated.push_back(extrapolated());
  }

  /// Returns by how much one of the last two steps lowered the energy, in the mean; one that was not made
  /// by 0.
  double decrease() const
  {
    const std::size_t n = m_decreases.size();
    return 0.5 * ((n > 1 ? m_decreases[n - 2] : 0.) + (n > 0 ? m_decreases[n - 1] : 0.));
  }

  /// Returns the slowest rate of the last steps: mean rates over one, two, four ... steps.
  double rate() const
  {
    const std::size_t n = m_decreases.size();
    double result = m_known_rate;
    for(std::size_t span = 1; span < n && span <= long_iteration; span *= 2) {
      const double before = larger_of_two(n - 1 - span);
      if(before > 0.)
        result = (std::max)(result, std::pow(larger_of_two(n - 1) / before, 1. / double(span)));
    }
    return result;
  }

  /// Returns the estimate of what remains after the last step; infinity before the third, if no
  /// rate was known.
  double remaining() const
  {
    const std::size_t n = m_decreases.size();
    const double sum = m_is_wary && n > 0 ? m_extrapolated.back() : extrapolated();
    if(!(sum < infinity))
      return infinity;
    double result = safety(n) * sum;
    if(n >= 3 && (m_is_wary || (n <= short_iteration && !(m_known_rate > 0.))))
      result = (std::max)(result, safety(n) * series(m_decreases[n - 1],
                                                     m_decreases[n - 1] / m_decreases[n - 2]));
    if(m_is_wary)
      result = (std::max)(result, 2. * shortfall() * sum);
    return n > long_iteration ? (std::max)(result, gain_of_second_half()) : result;
  }

private:
  static constexpr double infinity = (std::numeric_limits<double>::infinity)();

  // The sum of the geometric series that follows `last`.
  static double series(double last, double rate)
  {
    return !(last > 0.) ? 0. : rate < 1. ? last * rate / (1. - rate) : infinity;
  }

  double extrapolated() const
  {
    const std::size_t n = m_decreases.size();
    return n == 0 || (n < 3 && !(m_known_rate > 0.)) ? infinity
                                                     : series(larger_of_two(n - 1), rate());
  }

  // By what factor more has been gained since one of the last extrapolations than it promised for
  // all the time to come.
  double shortfall() const
  {
    const std::size_t n = m_decreases.size();
    double result = 0., gain = 0.;
    for(std::size_t k = n; k-- > 1 && n - k <= long_iteration;) {
      gain += m_decreases[k];
      if(m_extrapolated[k - 1] > 0.)
        result = (std::max)(result, gain / m_extrapolated[k - 1]);
    }
    return result;
  }

  // Single steps are often small by chance: of two, the larger counts.
  double larger_of_two(std::size_t k) const
  {
    return k == 0 ? m_decreases[0] : (std::max)(m_decreases[k], m_decreases[k - 1]);
  }

  // On 17 charts of 17K to 1.1M faces, each with two hierarchies, a factor of 2 was enough for the
  // true gap to stay below the tolerance for 1e-2, 1e-3 and 1e-4; it costs half a step on average.
  // Short histories say less about the rate: other schedules were 2.7 times off after four steps.
  static double safety(std::size_t n) { return 2. + 4. / double(n); }

  // The first step takes away what the coarse levels got wrong, often a hundred times more than the
  // next one: no rate of the steps that follow. So long the last two steps are looked at alone, too.
  static constexpr std::size_t short_iteration = 5;

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

  double m_known_rate;
  bool m_is_wary;
  std::vector<double> m_decreases;
  std::vector<double> m_extrapolated; // after each of them; if it is wary
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Iteration_control` decides after each step of an iteration whether another one is needed,
and keeps account of what came of it.
*/
class Iteration_control
{
public:
  /// Begins an iteration at the given energy.
  Iteration_control(const Energy_stop& stop, double energy)
    : m_stop(stop), m_gap(stop.known_rate, stop.estimate), m_change(0., stop.estimate)
  {
    m_report.energy = energy;
    m_report.energy_gap = (std::numeric_limits<double>::infinity)();
  }

  /// Returns whether another step is to be made.
  bool goes_on() const { return !m_is_over && m_report.iterations < m_stop.maximal_iterations; }

  /// Returns whether `step()` wants to know the largest change of an unknown.
  bool watches_changes() const { return m_stop.change_tolerance > 0.; }

  /// Returns whether `take_residual()` wants to know the norm of the residual.
  bool watches_residual() const { return m_stop.residual_tolerance > 0.; }

  /// Takes note of the norm of the residual before a step; returns whether it is small enough.
  bool take_residual(double norm)
  {
    m_first_residual = (std::max)(m_first_residual, norm);
    m_residual = norm;
    m_report.converged = norm <= m_stop.residual_tolerance;
    m_is_over = m_is_over || m_report.converged;
    return m_report.converged;
  }

  /// Takes note of a step that lowered the energy by `decrease` to `energy` and changed no unknown
  /// by more than `change`. `observe(part)` is told how far the iteration has come, in [0, 1];
  /// returning false stops it.
  void step(double energy, double decrease, double change,
            Blocked_execution::Function_ref<bool(double)> observe)
  {
    ++m_report.iterations;
    m_report.energy = energy;
    m_gap.add(decrease);
    m_report.decrease = m_gap.decrease();
    m_report.energy_gap = m_gap.remaining();
    m_report.rate = m_gap.rate();
    m_change.add(change);
    const bool is_enough = m_report.energy_gap <= goal()
                        || (watches_changes() && m_change.remaining() <= m_stop.change_tolerance)
                        || is_energy_negligible();
    m_report.converged = is_enough && m_report.iterations >= m_stop.minimal_iterations;
    if(!m_report.converged)
      m_report.cancelled = !observe(part());
    m_is_over = m_report.converged || m_report.cancelled;
  }

  /// Takes note that no direction is left.
  void end(bool converged)
  {
    m_report.converged = converged;
    m_report.energy_gap = 0.;
    m_is_over = true;
  }

  /// Returns what came of the iteration.
  const Iteration_report& report() const { return m_report; }

private:
  // Not before an iteration that has a minimum above 0 would have found it.
  bool is_energy_negligible() const
  {
    constexpr std::size_t long_iteration = 50;
    return m_stop.negligible_energy > 0. && m_report.energy < m_stop.negligible_energy
        && m_report.iterations >= long_iteration;
  }

  // The gap that is small enough.
  double goal() const
  {
    return m_stop.tolerance * (std::max)(std::abs(m_report.energy), m_stop.least_energy);
  }

  // The part that is done: on a logarithmic scale from the first estimate to the tolerance.
  double part()
  {
    if(watches_residual())
      return (std::max)(0., std::log(m_first_residual / m_residual)
                              / std::log(m_first_residual / m_stop.residual_tolerance));
    if(!(m_first_gap < (std::numeric_limits<double>::infinity)()))
      m_first_gap = m_report.energy_gap;
    if(!(goal() > 0. && goal() < m_first_gap && m_report.energy_gap < m_first_gap))
      return 0.;
    const double part
      = std::log(m_first_gap / m_report.energy_gap) / std::log(m_first_gap / goal());
    return (std::max)(0., (std::min)(part, 1.));
  }

  Energy_stop m_stop;
  Energy_gap_estimator m_gap, m_change;
  Iteration_report m_report;
  double m_first_residual = 0., m_residual = 0.;
  double m_first_gap = (std::numeric_limits<double>::infinity)();
  bool m_is_over = false;
};

namespace internal {

// What an iteration calls: by references, so that it is compiled once for each type of values.
template <class V>
struct Iteration_parts
{
  Blocked_execution::Function_ref<void(const std::vector<V>&, std::vector<V>&)> apply;
  Blocked_execution::Function_ref<void(std::vector<V>&, std::vector<V>&)> precondition;
  Blocked_execution::Function_ref<bool(double)> observe;
};

} // namespace internal

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_ITERATION_CONTROL_H
