// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_METHODS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_METHODS_H

#include <CGAL/Multigrid/Smoothers.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_system.h>

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The methods: each makes a map of the finest level from a system and tells `run` what came of it.
// To add one, write such a function, name it in `find_map()` and give it a `Method_profile`.

typedef Conformal_system::Vector Conformal_vector;

// Sets the unknowns that are not pinned so that the residual vanishes. The matrix is factorized.
template <class Solver>
bool solve_for_free(Solver& solver, const Conformal_operator<double>& op, Conformal_vector& z)
{
  typedef std::complex<double> Complex;
  Conformal_vector f(z.size()), x;
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

inline std::size_t maximal_iterations(const HLSCM_options& options, std::size_t method_default)
{
  return options.maximal_iterations > 0 ? options.maximal_iterations : method_default;
}

// A sparse Cholesky factorization of the whole system.
inline Conformal_vector map_directly(Conformal_system& system, Run_control& run)
{
  const Conformal_operator<double>& op = system.hierarchy.finest();
  Conformal_vector z = system.hierarchy.at_pins(system.pins);
  Multigrid::Sparse_cholesky<Multigrid::Large_factorization> solver;
  run.report().converged = solver.factorize(op.matrix) && solve_for_free(solver, op, z);
  if(!run.report().converged)
    run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                      "the matrix cannot be factorized; use the hierarchical method");
  else if(run.tell(phases::only_level, 1.))
    system.show(0, z, run);
  return z;
}

// Conjugate gradients on the finest level alone.
inline Conformal_vector map_by_monogrid(Conformal_system& system, Run_control& run)
{
  const Conformal_operator<double>& op = system.hierarchy.finest();
  Conformal_vector z = system.hierarchy.at_pins(system.pins);
  Multigrid::Energy_stop stop;
  stop.tolerance = run.options().tolerance;
  stop.maximal_iterations = maximal_iterations(run.options(), 100000);
  const auto goes_on = [&run](double part) {
    return run.tell(phases::only_level, part) && !run.is_enough();
  };
  const auto minimize = [&](const auto& preconditioner) {
    return Multigrid::minimize_energy(op.matrix, z, op.energy(z), preconditioner, stop, goes_on);
  };
  run.conclude(run.options().preconditioner == Monogrid_preconditioner::JACOBI
                 ? minimize(Multigrid::Jacobi_preconditioner<double>(op.matrix))
                 : minimize(Multigrid::Symmetric_gauss_seidel_preconditioner<double>(op.matrix)),
               system.energy_unit, "raise the number of iterations or use the hierarchical method");
  if(!run.is_stopped() && run.tell(phases::only_level, 1.))
    system.show(0, z, run);
  return z;
}

// Those of the finest level; of a map without pins the rows of its mass are held.
inline void relax_flipped_faces(const Conformal_hierarchy& hierarchy, bool is_free,
                                const std::vector<Multigrid::Diagonal_mass>& masses,
                                Conformal_vector& z)
{
  const auto& h = hierarchy.finest().matrix;
  const auto& triangles = hierarchy.levels().back().mesh.triangles;
  if(is_free)
    relax_flipped_faces(Held_rows(h, rows_of(masses.back())), triangles, z);
  else
    relax_flipped_faces(h, triangles, z);
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

// The energy of a map without energy, for the square of its size, as rounding makes it: on strips of
// 100,000 triangles that can be unrolled, factorization and iteration end between 1e-15 and 2e-13.
constexpr double rounded_energy = 3e-13;

// How near the coarsest level of a free map comes to its minimum if there are finer ones.
constexpr double tolerance_of_coarsest = 1e-3;

// Conjugate gradients on one level, preconditioned by a cycle over those below, with pins or, for a
// free map, by the quotient of energy and border. Levels below the finest are only starting points:
// two steps are enough, since their minimisers differ from the finest one anyway.
class Cycle_iteration
{
public:
  explicit Cycle_iteration(const HLSCM_options& options)
    : m_schedule(options.schedule.value_or(Multigrid::Schedule()))
  {}

  // Lowers the energy of z on level l > 0, or, if the map is free, any level.
  Multigrid::Iteration_report improve(Conformal_system& system, std::size_t l, Run_control& run,
                                      Conformal_vector& z, double least_energy = 0.) const
  {
    const bool is_finest = l == system.finest();
    const Phase phase = is_finest ? phases::finest_level : phases::coarse_levels;
    Multigrid::Energy_stop stop;
    stop.tolerance = run.options().tolerance;
    stop.maximal_iterations = is_finest ? maximal_iterations(run.options(), 500) : 2;
    stop.least_energy = least_energy;
    stop.known_rate = is_finest ? m_rate : 0.;
    stop.estimate = estimate_for(m_schedule);
    if(is_finest)
      stop.negligible_energy = rounded_energy * std::pow(Multigrid::extent(z), 2);
    if(is_finest && run.options().uv_tolerance > 0.)
      stop.change_tolerance = run.options().uv_tolerance * Multigrid::extent(z);
    return minimize(system, l, stop, z, [&](double part) {
      return run.tell(phase, is_finest ? part : 0.5) && !run.is_enough();
    });
  }

  // As the coarsest level is solved for a free map, from the map under pins.
  Multigrid::Iteration_report improve_coarsest(Conformal_system& system, Run_control& run,
                                               Conformal_vector& z) const
  {
    Multigrid::Energy_stop stop;
    stop.tolerance = system.finest() == 0 ? run.options().tolerance : tolerance_of_coarsest;
    stop.maximal_iterations = maximal_iterations(run.options(), 500);
    return minimize(system, 0, stop, z, [](double) { return true; });
  }

  // Improves z on the finest level until it is the result.
  Multigrid::Iteration_report complete(Conformal_system& system, Run_control& run,
                                       Conformal_vector& z)
  {
    const auto result = improve(system, system.finest(), run, z);
    if(result.converged) {
      m_rate = result.rate;
      relax_flipped_faces(system.hierarchy, system.is_free, system.masses, z);
    }
    run.conclude(result, system.energy_unit,
                 "raise the number of iterations or use the direct method");
    return result;
  }

  // The rate of the last iteration with this matrix that converged; 0 if there was none.
  double rate() const { return m_rate; }
  void set_rate(double rate) { m_rate = rate; }

private:
  template <class Goes_on>
  Multigrid::Iteration_report minimize(Conformal_system& system, std::size_t l,
                                       const Multigrid::Energy_stop& stop, Conformal_vector& z,
                                       const Goes_on& goes_on) const
  {
    return system.is_free
             ? system.hierarchy.minimize_without_pins(l, system.masses[l], m_schedule, stop,
                                                      goes_on, z)
             : system.hierarchy.minimize(l, m_schedule, stop, goes_on, z);
  }

  Multigrid::Schedule m_schedule;
  double m_rate = 0.;
};

// The map of the coarsest level under the pins.
inline Conformal_vector map_of_coarsest(Conformal_system& system, Run_control& run)
{
  Conformal_hierarchy& hierarchy = system.hierarchy;
  run.report().energy_gap_estimate
    = system.finest() > 0 ? (std::numeric_limits<double>::infinity)() : 0.;
  Conformal_vector z = hierarchy.at_pins(system.pins);
  if(!hierarchy.factorize_coarsest()
     || !solve_for_free(hierarchy.coarsest_solver(), hierarchy.coarsest(), z))
    run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                      "the matrix of the coarsest level cannot be factorized");
  run.report().converged = system.finest() == 0;
  return z;
}

// Nested iteration: takes the map of the coarsest level to the next, improves it there by
// `improve(l, z)`, and so on. What is enough for the user on some level goes to the finest as it is.
template <class Improve>
void climb(const Conformal_system& system, Run_control& run, Conformal_vector& z,
           const Improve& improve)
{
  if(!run.status().is_ok())
    return;
  HLSCM_report& report = run.report();
  const std::size_t count = system.finest() + 1;
  bool goes_on = system.show(0, z, run);
  for(std::size_t l = 1; l < count; ++l) {
    Blocked_execution::Stopwatch watch;
    z = system.hierarchy.prolonged(l, z);
    if(!system.is_free)
      system.hierarchy.set_pins(l, system.pins, z);
    if(!goes_on)
      continue;
    report.levels[l].iterations = improve(l, z).iterations;
    report.levels[l].seconds = watch.lap();
    if(!run.tell(phases::coarse_levels, double(l) / double(count)))
      return;
    goes_on = system.show(l, z, run);
  }
  if(!run.is_stopped())
    run.tell(phases::only_level, 1.);
}

// The paper's cascade takes a fixed number of conjugate gradient steps on each level.
inline Conformal_vector map_by_cascade(Conformal_system& system, Run_control& run)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.maximal_iterations
    = run.options().schedule.value_or(Multigrid::Schedule::cascade(10)).post_smoothing;
  const auto relax = [&stop](const auto& op, auto& x) {
    typedef typename std::decay_t<decltype(x)>::value_type::value_type Real;
    return Multigrid::minimize_energy(op.matrix, x, op.energy(x),
                                      Multigrid::Jacobi_preconditioner<Real>(op.matrix), stop,
                                      [](double) { return true; });
  };
  Conformal_vector z = map_of_coarsest(system, run);
  climb(system, run, z, [&](std::size_t l, Conformal_vector& x) {
    const auto result = system.hierarchy.on_level(l, x, relax);
    if(l == system.finest() && result.converged)
      relax_flipped_faces(system.hierarchy, system.is_free, system.masses, x);
    if(l == system.finest())
      run.conclude(result, system.energy_unit);
    return result;
  });
  return z;
}

// Improves z on all levels from the coarsest up.
inline void climb_by_cycles(Conformal_system& system, Run_control& run, Cycle_iteration& iteration,
                            Conformal_vector& z)
{
  climb(system, run, z, [&](std::size_t l, Conformal_vector& x) {
    return l == system.finest() ? iteration.complete(system, run, x)
                                : iteration.improve(system, l, run, x);
  });
}

// Nested iteration with cycles as preconditioners: the method of the package.
inline Conformal_vector map_by_nested_iteration(Conformal_system& system, Run_control& run,
                                                Cycle_iteration& iteration)
{
  Conformal_vector z = map_of_coarsest(system, run);
  climb_by_cycles(system, run, iteration, z);
  return z;
}

// Whether a map of that size has no energy but rounding errors.
inline bool is_without_energy(double energy, double size)
{
  return !(energy > 1e-12 * size * size);
}

// Takes the second of two pins out of the preconditioner, where z is the map of the coarsest level
// under both. In a plane, where there is a map without energy, it is needed: with one pin the matrix
// would be singular. Returns whether it is; nothing if the matrix cannot be factorized at all.
inline std::optional<bool> is_second_pin_needed(Conformal_hierarchy& hierarchy, const Pins& pins,
                                                const Conformal_vector& z)
{
  if(is_without_energy(hierarchy.coarsest().energy(z), Multigrid::extent(z)))
    return true;
  hierarchy.release(pins[1].vertex);
  if(hierarchy.factorize_coarsest())
    return false;
  hierarchy.pin(pins[1].vertex);
  return hierarchy.factorize_coarsest() ? std::optional<bool>(true) : std::nullopt;
}

// The free map: the map under two pins is only the first guess on the coarsest level.
inline Conformal_vector map_without_pins(Conformal_system& system, Run_control& run,
                                         Cycle_iteration& iteration)
{
  if(!system.needs_second_pin)
    system.hierarchy.pin(system.pins[1].vertex);
  Conformal_vector z = map_of_coarsest(system, run);
  if(!run.status().is_ok())
    return z;
  const auto is_needed = is_second_pin_needed(system.hierarchy, system.pins, z);
  if(!is_needed) {
    run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                      "the matrix of the coarsest level cannot be factorized");
    return z;
  }
  system.needs_second_pin = *is_needed;
  const auto result = iteration.improve_coarsest(system, run, z);
  run.report().levels[0].iterations = result.iterations;
  if(system.finest() == 0)
    run.conclude(result, system.energy_unit, "raise the number of iterations");
  climb_by_cycles(system, run, iteration, z);
  return z;
}

// Brings a map of the finest level to its place, and reports its energy.
inline void place_map(const Conformal_system& system, Run_control& run, Conformal_vector& z)
{
  HLSCM_report& report = run.report();
  if(run.is_stopped())
    report.converged = false;
  const bool is_map = z.size() == system.source.size();
  const bool is_solution = !report.cancelled && (run.status().is_ok() || report.iterations > 0);
  double scale = 1.; // of the energy
  if(is_map)
    scale = system.fit_to_surface(system.finest(), z);
  report.energy_gap_estimate *= scale;
  if(is_solution) { // also if it gave up
    double energy = system.hierarchy.finest().energy(z);
    if(std::isnan(energy)) // squares of the unit of length are no numbers
      energy = (std::numeric_limits<double>::infinity)();
    report.energy = system.energy_unit * energy;
    if(is_map && run.status().is_ok())
      doubt_map(system, run, energy, z);
  }
  run.lap(report.seconds_solve);
}

// The map by `method`, which the system was built for.
inline Conformal_vector find_map(Conformal_method method, Conformal_system& system,
                                 Run_control& run, Cycle_iteration& iteration)
{
  Conformal_vector z;
  switch(method) {
  case Conformal_method::HLSCM: z = map_by_nested_iteration(system, run, iteration); break;
  case Conformal_method::SPECTRAL: z = map_without_pins(system, run, iteration); break;
  case Conformal_method::CASCADIC: z = map_by_cascade(system, run); break;
  case Conformal_method::LSCM: z = map_by_monogrid(system, run); break;
  case Conformal_method::DIRECT: z = map_directly(system, run); break;
  }
  place_map(system, run, z);
  return z;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_METHODS_H
