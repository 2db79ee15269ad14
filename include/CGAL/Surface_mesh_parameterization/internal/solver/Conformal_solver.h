// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SOLVER_H

#include <CGAL/Multigrid/Monogrid_preconditioners.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_problem.h>

#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Sets the unknowns that are not pinned so that the residual vanishes. The matrix is factorized.
template <class Solver>
bool solve_for_free(Solver& solver, const Conformal_operator<double>& op,
                    Multigrid::Complex_vector<double>& z)
{
  typedef std::complex<double> Complex;
  Multigrid::Complex_vector<double> f(z.size()), x;
  op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex s) {
    f[i] = -(op.matrix.diagonal()[i] * z[i] + s);
  });
  solver.solve(f, x);
  for(std::size_t i = 0; i < z.size(); ++i) {
    z[i] += x[i];
    if(!std::isfinite(z[i].real()) || !std::isfinite(z[i].imag()))
      return false;
  }
  return true;
}

// Minimises the energy of a `Conformal_problem`.
template <class CoarsestSolver>
class Conformal_solver
  : protected Conformal_problem<CoarsestSolver>
{
  typedef Conformal_problem<CoarsestSolver> Base;

public:
  using typename Base::Complex;
  using typename Base::Vector;
  using Base::take_progressive_mesh;

  Conformal_solver(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
                   HLSCM_report& report)
    : Base(chart, pins, options, report)
    , m_schedule(options.schedule.value_or(this->is_cascade() ? Multigrid::Schedule::cascade(10)
                                                              : Multigrid::Schedule()))
  {}

  // Returns the parameters of the chart's vertices; the chart's error and the report say what
  // became of it. The mesh of the chart is used up.
  Vector run();

protected:
  using Base::conclude;
  using Base::fit_to_surface;
  using Base::is_cascade;
  using Base::is_enough;
  using Base::is_spectral;
  using Base::is_stopped;
  using Base::m_chart;
  using Base::m_hierarchy;
  using Base::m_masses;
  using Base::m_needs_second_pin;
  using Base::m_options;
  using Base::m_pins;
  using Base::m_progress;
  using Base::m_report;
  using Base::m_watch;
  using Base::observe;

  void solve(Vector& z);
  void conclude_map(Vector& z);
  void solve_directly(Vector& z);
  void solve_monogrid(Vector& z);
  void solve_hierarchy(Vector& z);
  Multigrid::Iteration_report improve(std::size_t l, Vector& z, double least_energy = 0.);
  Multigrid::Iteration_report relax(std::size_t l, Vector& z) const;
  bool release_second_pin(double energy, double size);
  void solve_coarsest(Vector& z);
  void finish(const Multigrid::Iteration_report& result, Vector& z);
  std::size_t maximal_iterations(std::size_t method_default) const
  {
    return m_options.maximal_iterations > 0 ? m_options.maximal_iterations : method_default;
  }

  const Multigrid::Schedule m_schedule;
  double m_rate = 0.; // of the last iteration, if it converged
};

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_directly(Vector& z)
{
  Multigrid::Sparse_cholesky<Multigrid::Large_factorization> solver;
  m_report.converged = solver.factorize(m_hierarchy.finest().matrix)
                    && solve_for_free(solver, m_hierarchy.finest(), z);
  if(!m_report.converged)
    m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                 "the matrix cannot be factorized; use the hierarchical method");
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_monogrid(Vector& z)
{
  const Conformal_operator<double>& op = m_hierarchy.finest();
  Multigrid::Energy_stop stop;
  stop.tolerance = m_options.tolerance;
  stop.maximal_iterations = maximal_iterations(100000);
  const auto progress = [this](double part) { return m_progress(0.75, 1., part) && !is_enough(); };
  const auto run = [&](const auto& preconditioner) {
    return Multigrid::minimize_energy(op.matrix, z, op.energy(z), preconditioner, stop, progress);
  };
  conclude(m_options.preconditioner == Monogrid_preconditioner::JACOBI
             ? run(Multigrid::Jacobi_preconditioner<double>(op.matrix))
             : run(Multigrid::Symmetric_gauss_seidel_preconditioner<double>(op.matrix)),
           "raise the number of iterations or use the hierarchical method");
}

// The paper's cascade takes a fixed number of conjugate gradient steps.
template <class CoarsestSolver>
Multigrid::Iteration_report Conformal_solver<CoarsestSolver>::relax(std::size_t l, Vector& z) const
{
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.maximal_iterations = m_schedule.post_smoothing;
  return m_hierarchy.on_level(l, z, [&](const auto& op, auto& x) {
    typedef typename std::decay_t<decltype(x)>::value_type::value_type Real;
    return Multigrid::minimize_energy(op.matrix, x, op.energy(x),
                                      Multigrid::Jacobi_preconditioner<Real>(op.matrix), stop,
                                      [](double) { return true; });
  });
}

// What estimate keeps the true gap below the tolerance, on generated charts, a bunny and a camel,
// and for five tolerances: the steady one under K-cycles with four smoothing steps, and the wary
// one, which makes a tenth more iterations, under eight other schedules.
inline Multigrid::Gap_estimate estimate_for(const Multigrid::Schedule& schedule)
{
  return schedule.acceleration == Multigrid::Acceleration::KRYLOV && schedule.coarse_visits > 1
             && schedule.pre_smoothing + schedule.post_smoothing >= 4
           ? Multigrid::Gap_estimate::STEADY : Multigrid::Gap_estimate::WARY;
}

// Conjugate gradients preconditioned by a cycle. Levels below the finest are only starting points:
// two steps are enough, since their minimisers differ from the finest one anyway.
template <class CoarsestSolver>
Multigrid::Iteration_report Conformal_solver<CoarsestSolver>::improve(std::size_t l, Vector& z,
                                                                      double least_energy)
{
  const bool is_finest = l + 1 == m_hierarchy.number_of_levels();
  Multigrid::Energy_stop stop;
  stop.tolerance = m_options.tolerance;
  stop.maximal_iterations = is_finest ? maximal_iterations(500) : 2;
  stop.least_energy = least_energy;
  stop.known_rate = is_finest ? m_rate : 0.;
  stop.estimate = estimate_for(m_schedule);
  if(is_finest && m_options.uv_tolerance > 0.)
    stop.change_tolerance = m_options.uv_tolerance * Multigrid::extent(z);
  const auto progress = [&](double part) {
    return m_progress(is_finest ? 0.8 : 0.75, is_finest ? 1. : 0.8, is_finest ? part : 0.5)
        && !is_enough();
  };
  if(is_spectral())
    return m_hierarchy.minimize_without_pins(l, m_masses[l], m_schedule, stop, progress, z);
  return m_hierarchy.minimize(l, m_schedule, stop, progress, z);
}

// Whether a map of that size has no energy but rounding errors.
inline bool is_without_energy(double energy, double size)
{
  return !(energy > 1e-12 * size * size);
}

// Takes the second pin out of the preconditioner. In a plane, where there is a map without energy,
// it is needed: with one pin the matrix would be singular.
template <class CoarsestSolver>
bool Conformal_solver<CoarsestSolver>::release_second_pin(double energy, double size)
{
  const auto v = m_pins[1].vertex;
  m_needs_second_pin = is_without_energy(energy, size);
  if(m_needs_second_pin)
    return true;
  m_hierarchy.release(v);
  if(m_hierarchy.factorize_coarsest())
    return true;
  m_needs_second_pin = true;
  m_hierarchy.pin(v);
  return m_hierarchy.factorize_coarsest();
}

// The map of the coarsest level: that of the pins, from which inverse iterations go on if there
// are to be none.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_coarsest(Vector& z)
{
  const auto& op = m_hierarchy.coarsest();
  if(!m_hierarchy.factorize_coarsest()
     || !solve_for_free(m_hierarchy.coarsest_solver(), op, z)
     || (is_spectral() && !release_second_pin(op.energy(z), Multigrid::extent(z))))
    return m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                        "the matrix of the coarsest level cannot be factorized");
  const bool is_only = m_hierarchy.number_of_levels() == 1;
  m_report.converged = is_only;
  if(!is_spectral())
    return;
  Multigrid::Energy_stop stop;
  stop.tolerance = is_only ? m_options.tolerance : 1e-3;
  stop.maximal_iterations = maximal_iterations(500);
  const auto result = m_hierarchy.minimize_without_pins(0, m_masses[0], m_schedule, stop,
                                                        [](double) { return true; }, z);
  m_report.levels[0].iterations = result.iterations;
  if(is_only)
    conclude(result, "raise the number of iterations");
}

// What is left to do after the iteration on the finest level.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::finish(const Multigrid::Iteration_report& result, Vector& z)
{
  if(result.converged) {
    m_rate = result.rate;
    relax_flipped_faces(m_hierarchy.finest().matrix, m_hierarchy.levels().back().mesh.triangles, z);
  }
  conclude(result, "raise the number of iterations or of smoothing steps");
}

// Nested iteration: solve the coarsest level, take the solution to the next, improve it there. What
// is enough for the user on some level goes to the finest as it is.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_hierarchy(Vector& z)
{
  const std::size_t count = m_hierarchy.number_of_levels();
  m_report.energy_gap_estimate = count > 1 ? (std::numeric_limits<double>::infinity)() : 0.;
  solve_coarsest(z);
  if(m_chart.error != OK)
    return;
  bool goes_on = observe(0, z);
  for(std::size_t l = 1; l < count; ++l) {
    Blocked_execution::Stopwatch watch;
    z = m_hierarchy.prolonged(l, z);
    if(!is_spectral())
      m_hierarchy.set_pins(l, m_pins, z);
    if(!goes_on)
      continue;
    const auto result = is_cascade() ? relax(l, z) : improve(l, z);
    if(l + 1 == count)
      finish(result, z);
    m_report.levels[l].iterations = result.iterations;
    m_report.levels[l].seconds = watch.lap();
    if(!m_progress(0.75, 0.8, double(l) / double(count)))
      return;
    goes_on = observe(l, z);
  }
}

// Computes the map from nothing.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve(Vector& z)
{
  if(is_spectral() && !m_needs_second_pin)
    m_hierarchy.pin(m_pins[1].vertex); // for the first guess
  z = m_hierarchy.at_pins(m_pins);
  switch(m_options.method) {
  case Conformal_method::DIRECT: solve_directly(z); break;
  case Conformal_method::LSCM: solve_monogrid(z); break;
  default: solve_hierarchy(z);
  }
  if(!is_stopped() && m_progress(0.75, 1., 1.) && !is_hierarchical(m_options.method))
    observe(0, z);
  conclude_map(z);
}

// Brings the map to its place, and reports its energy.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::conclude_map(Vector& z)
{
  if(is_stopped())
    m_report.converged = false;
  if(is_spectral() && z.size() == m_chart.source.size())
    m_report.energy_gap_estimate *= fit_to_surface(m_hierarchy.number_of_levels() - 1, z);
  if(!m_report.cancelled && (m_chart.error == OK || m_report.iterations > 0)) // also if it gave up
    m_report.energy = this->energy_unit() * m_hierarchy.finest().energy(z);
  m_report.seconds_solve += m_watch.lap();
}

template <class CoarsestSolver>
typename Conformal_solver<CoarsestSolver>::Vector Conformal_solver<CoarsestSolver>::run()
{
  Vector z;
  this->build();
  if(!is_stopped())
    solve(z);
  return z;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SOLVER_H
