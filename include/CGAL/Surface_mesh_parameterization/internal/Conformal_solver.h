// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H

#include <CGAL/Multigrid/Monogrid_preconditioners.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/Conformal_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/Progress.h>
#include <CGAL/Surface_mesh_parameterization/internal/build_levels.h>
#include <CGAL/Surface_mesh_parameterization/internal/relax_flipped_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The weights with which the energy is that of CGAL: eight times the area of each triangle, here in
// the unit of the normalized chart, since squares of that of the input may not exist in single
// precision; `Conformal_solver::energy_unit()` makes up for it.
inline std::vector<double>
cgal_triangle_weights(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh)
{
  std::vector<double> weights(mesh.triangles.size());
  for(std::size_t t = 0; t < weights.size(); ++t)
    weights[t] = 8. * conformal_triangle(mesh, t).area();
  return weights;
}

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

// Minimises the conformal energy of a chart under pins, or without them: then two pins are only for
// the first guess, and the first of them makes the preconditioner regular.
template <class CoarsestSolver>
class Conformal_solver
{
public:
  typedef std::complex<double> Complex;
  typedef Multigrid::Complex_vector<double> Vector;

  Conformal_solver(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
                   HLSCM_report& report)
    : m_chart(chart), m_pins(pins), m_options(options), m_report(report)
    , m_progress(options.progress)
    , m_schedule(options.schedule.value_or(is_cascade() ? Multigrid::Schedule::cascade(10)
                                                        : Multigrid::Schedule()))
  {}

  // Returns the parameters of the chart's vertices; the chart's error and the report say what
  // became of it. The mesh of the chart is used up.
  Vector run();

  // Returns the collapses that led to the levels, if the options keep them.
  Surface_mesh_multiresolution::Progressive_mesh take_progressive_mesh()
  {
    return std::move(m_progressive_mesh);
  }

protected:
  typedef Surface_mesh_multiresolution::Mesh_level Level;

  bool is_stopped()
  {
    m_report.cancelled = m_report.cancelled || m_progress.is_cancelled();
    return m_report.cancelled || m_chart.error != OK;
  }

  bool is_cascade() const { return m_options.method == Conformal_method::CASCADIC; }
  bool is_spectral() const { return m_options.method == Conformal_method::SPECTRAL; }

  std::vector<Surface_mesh_multiresolution::Vertex_index> vertices_to_pin() const;
  void restart();
  void build();
  void build_hierarchy();
  void build_operators();
  void finish_level(std::size_t l);
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
  double fit_to_surface(std::size_t l, Vector& z) const;
  bool observe(std::size_t l, const Vector& z);
  bool is_enough();
  void conclude(const Multigrid::Iteration_report& result, const char* remedy);
  double energy_unit() const
  {
    return m_options.weights == Conformal_weights::EXACT ? 1. : 1. / (m_chart.scale * m_chart.scale);
  }
  std::size_t maximal_iterations(std::size_t method_default) const
  {
    return m_options.maximal_iterations > 0 ? m_options.maximal_iterations : method_default;
  }

  Chart& m_chart;
  const std::vector<Pin>& m_pins;
  const HLSCM_options& m_options;
  HLSCM_report& m_report;
  Progress m_progress;
  const Multigrid::Schedule m_schedule;
  Stopwatch m_watch;
  Stopwatch m_since_begin;
  bool m_keeps_meshes = false;
  bool m_needs_second_pin = false;                       // the preconditioner, if there are no pins
  std::vector<double> m_face_weights;                    // of the user, if any
  double m_rate = 0.;                                    // of the last iteration, if it converged
  Conformal_hierarchy<CoarsestSolver> m_hierarchy;
  std::vector<Multigrid::Diagonal_mass> m_masses;        // of the levels, if there are no pins
  double m_surface_area = 0.;                            // the same
  Surface_mesh_multiresolution::Progressive_mesh m_progressive_mesh; // if it is kept
};

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::build_hierarchy()
{
  Built_levels built = build_levels(m_chart, m_pins, m_options, [this](double part) {
    return m_progress(0.05, 0.6, part);
  });
  m_hierarchy.set_levels(std::move(built.levels));
  if(m_options.keep_progressive_mesh)
    m_progressive_mesh = std::move(built.progressive_mesh);
  for(const Level& level : m_hierarchy.levels())
    m_report.levels.push_back({level.vertices.size(), level.mesh.triangles.size(), 0, 0.});
}

template <class CoarsestSolver>
std::vector<Surface_mesh_multiresolution::Vertex_index>
Conformal_solver<CoarsestSolver>::vertices_to_pin() const
{
  if(is_spectral() && !m_needs_second_pin)
    return {m_pins[0].vertex};
  std::vector<Surface_mesh_multiresolution::Vertex_index> result;
  for(const Pin& pin : m_pins)
    result.push_back(pin.vertex);
  return result;
}

// Takes from level l what is still needed of its mesh.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::finish_level(std::size_t l)
{
  Level& level = m_hierarchy.levels()[l];
  const bool is_finest = l + 1 == m_hierarchy.number_of_levels();
  const bool needs_no_pins = is_spectral() || m_keeps_meshes;
  if(needs_no_pins)
    m_masses[l] = border_mass(level, m_chart.borders);
  if(needs_no_pins && is_finest)
    for(std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
      m_surface_area += conformal_triangle(level.mesh, t).area();
  if(m_options.level_observer || m_keeps_meshes)
    return;
  level.mesh.points = std::vector<Chart::Mesh::Point_3>();
  if(!is_finest) // only the finest faces will be asked for
    level.mesh.triangles = std::vector<Surface_mesh_multiresolution::Triangle_indices>();
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::build_operators()
{
  const std::size_t count = m_hierarchy.number_of_levels();
  m_masses.resize(count);
  m_surface_area = 0.;
  std::vector<double> weights = m_face_weights;
  if(weights.empty() && m_options.weights == Conformal_weights::CGAL_LSCM)
    weights = cgal_triangle_weights(m_hierarchy.levels().back().mesh);
  m_hierarchy.build_operators(std::move(weights), [&](std::size_t l) {
    finish_level(l);
    return m_progress(0.65, 0.75, double(count - l) / double(count));
  });
  if(m_progress.is_cancelled())
    return;
  if(is_hierarchical(m_options.method) && !is_cascade())
    m_hierarchy.build_cycle();
  for(const auto v : vertices_to_pin())
    m_hierarchy.pin(v);
  m_report.mollified_faces = m_hierarchy.finest().mollified_triangles;
  if(m_report.mollified_faces > 0)
    m_report.warnings.push_back(std::to_string(m_report.mollified_faces)
      + " faces have no area; they were given some by mollification");
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::conclude(const Multigrid::Iteration_report& result,
                                                const char* remedy)
{
  m_report.iterations = result.iterations;
  m_report.converged = result.converged;
  m_report.cancelled = result.cancelled && m_progress.is_cancelled();
  m_report.energy_gap_estimate = energy_unit() * result.energy_gap;
  if(result.cancelled || result.converged || is_cascade())
    return;
  m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "the tolerance was not met after "
               + std::to_string(result.iterations) + " iterations; " + remedy);
}

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
    conclude(Multigrid::minimize_energy(op.matrix, z, op.energy(z), preconditioner, stop, progress),
             "raise the number of iterations or use the hierarchical method");
  };
  if(m_options.preconditioner == Monogrid_preconditioner::JACOBI)
    run(Multigrid::Jacobi_preconditioner<double>(op.matrix));
  else
    run(Multigrid::Symmetric_gauss_seidel_preconditioner<double>(op.matrix));
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

// What estimate keeps the true gap below the tolerance, on generated charts, a bunny and a camel, and
// for five tolerances: the steady one under K-cycles with four smoothing steps, and the wary one,
// which makes a tenth more iterations, under eight other schedules.
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
inline bool is_without_energy(double energy, double size) { return !(energy > 1e-12 * size * size); }

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

// A map without pins has no size, position or direction of its own: that of level l gets the area
// of the surface, the first of the two far vertices at the origin and the second on the u axis.
// Returns the factor of its energy.
template <class CoarsestSolver>
double Conformal_solver<CoarsestSolver>::fit_to_surface(std::size_t l, Vector& z) const
{
  const Level& level = m_hierarchy.levels()[l];
  double area = 0.;
  for(const auto& t : level.mesh.triangles)
    area += 0.5 * (std::conj(z[t[1]] - z[t[0]]) * (z[t[2]] - z[t[0]])).imag();
  const Complex origin = z[level.position(m_pins[0].vertex)];
  const Complex direction = z[level.position(m_pins[1].vertex)] - origin;
  const double length = std::abs(direction);
  const double scale = area > 0. ? std::sqrt(m_surface_area / area) / m_chart.scale : 1.;
  const Complex factor = scale * (length > 0. ? std::conj(direction) / length : Complex(1.));
  for(Complex& value : z)
    value = factor * (value - origin);
  return std::norm(factor);
}

// Whether the user wants the map as it is.
template <class CoarsestSolver>
bool Conformal_solver<CoarsestSolver>::is_enough()
{
  if(m_options.time_limit > 0. && m_since_begin.seconds() > m_options.time_limit)
    m_report.stopped_early = true;
  return m_report.stopped_early;
}

// Shows the user the map of level l; returns whether to go on.
template <class CoarsestSolver>
bool Conformal_solver<CoarsestSolver>::observe(std::size_t l, const Vector& z)
{
  if(!m_options.level_observer)
    return !is_enough();
  const Level& level = m_hierarchy.levels()[l];
  std::vector<std::uint32_t> vertices;
  for(const auto v : level.vertices)
    vertices.push_back(m_chart.source[v]);
  Vector fitted;
  if(is_spectral()) {
    fitted = z;
    fit_to_surface(l, fitted);
  }
  const std::size_t count = m_hierarchy.number_of_levels();
  const bool goes_on = m_options.level_observer({l, count, &vertices, &level.mesh.triangles,
                                                 is_spectral() ? &fitted : &z});
  m_report.stopped_early = m_report.stopped_early || (!goes_on && l + 1 < count);
  return !is_enough();
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
    Stopwatch watch;
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

// Forgets what came of an earlier run, but for its hierarchy.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::restart()
{
  m_chart.error = OK;
  m_chart.message.clear();
  m_report.cancelled = m_report.stopped_early = m_report.converged = false;
  m_report.iterations = 0;
  m_progress.restart();
  m_watch.lap();
  m_since_begin.lap();
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::build()
{
  build_hierarchy();
  m_report.seconds_hierarchy += m_watch.lap();
  if(is_stopped())
    return;
  build_operators();
  m_report.seconds_operators += m_watch.lap();
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
    m_report.energy = energy_unit() * m_hierarchy.finest().energy(z);
  m_report.seconds_solve += m_watch.lap();
}

template <class CoarsestSolver>
typename Conformal_solver<CoarsestSolver>::Vector Conformal_solver<CoarsestSolver>::run()
{
  Vector z;
  build();
  if(!is_stopped())
    solve(z);
  return z;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H
