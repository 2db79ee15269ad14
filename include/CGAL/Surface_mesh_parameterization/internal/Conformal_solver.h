// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Monogrid_preconditioners.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/Chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/border_mass.h>
#include <CGAL/Surface_mesh_parameterization/internal/coarse_cotangents.h>
#include <CGAL/Surface_mesh_parameterization/internal/pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/relax_flipped_faces.h>

#include <chrono>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Seconds since it was made or last asked.
class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    m_start = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

// Parts of the whole, in [0, 1], told to the user's function; remembers that it said stop.
class Progress
{
public:
  explicit Progress(const std::function<bool(double)>& function) : m_function(function) {}

  // Whether the work, of which the stretch [begin, end] of the whole is done to `part`, goes on.
  bool operator()(double begin, double end, double part)
  {
    m_done = (std::max)(m_done, begin + (end - begin) * part); // estimates may go back
    if(m_function && !m_is_cancelled)
      m_is_cancelled = !m_function(m_done);
    return !m_is_cancelled;
  }

  bool is_cancelled() const { return m_is_cancelled; }

private:
  const std::function<bool(double)>& m_function;
  double m_done = 0.;
  bool m_is_cancelled = false;
};

// Minimises the conformal energy of a chart under pins, or without them: then two pins are only a
// part of the first guess and of the preconditioner.
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

private:
  typedef Surface_mesh_multiresolution::Mesh_level Level;
  typedef Multigrid::Multigrid_levels<Surface_mesh_multiresolution::Prolongation, CoarsestSolver>
    Multigrid_levels;

  bool is_cascade() const { return m_options.method == Conformal_method::CASCADIC; }
  bool is_spectral() const { return m_options.method == Conformal_method::SPECTRAL; }
  bool has_cycles() const { return m_options.method == Conformal_method::HLSCM || is_spectral(); }
  bool is_hierarchical() const { return is_cascade() || has_cycles(); }

  Surface_mesh_multiresolution::Progressive_mesh decimate();
  void build_levels();
  std::vector<std::vector<double>> triangle_weights() const;
  void build_operators();
  void solve_directly(Vector& z);
  void solve_monogrid(Vector& z);
  void solve_hierarchy(Vector& z);
  template <class Real>
  Multigrid::Iteration_report improve(std::size_t l, const Conformal_operator<Real>& op,
                                      Multigrid::Complex_vector<Real>& z);
  template <class Real, class Precondition, class Observe>
  Multigrid::Iteration_report
  minimize_without_pins(std::size_t l, const Conformal_operator<Real>& op,
                        Multigrid::Complex_vector<Real>& z, const Precondition& precondition,
                        const Multigrid::Energy_stop& stop, const Observe& observe) const;
  template <class Real>
  Multigrid::Iteration_report relax(const Conformal_operator<Real>& op,
                                    Multigrid::Complex_vector<Real>& z);
  void solve_coarsest(Vector& z);
  double fit_to_surface(std::size_t l, Vector& z) const;
  void observe(std::size_t l, const Vector& z) const;
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
  std::vector<Level> m_levels;                           // level 0 is the coarsest
  std::vector<std::vector<bool>> m_is_pinned;            // of each level
  std::vector<Conformal_operator<float>> m_operators;    // of the levels between
  Conformal_operator<double> m_coarsest, m_finest;       // those at the ends
  std::vector<Multigrid::Diagonal_mass> m_masses;        // of the levels, if there are no pins
  double m_surface_area = 0.;                            // the same
  Multigrid_levels m_multigrid;
};

template <class CoarsestSolver>
Surface_mesh_multiresolution::Progressive_mesh Conformal_solver<CoarsestSolver>::decimate()
{
  namespace SMM = Surface_mesh_multiresolution;
  std::vector<bool> is_locked(m_chart.mesh.points.size(), false);
  for(const Pin& pin : m_pins)
    is_locked[pin.vertex] = true;
  const auto progress = [this](double part) { return m_progress(0.05, 0.6, part); };
  const std::size_t target = (std::max)(m_options.coarsest_size, std::size_t(3));
  if(m_options.engine == Decimation_engine::CGAL) {
    SMM::Edge_collapse_options options;
    options.target_vertices = target;
    options.angular_defect_bound = m_options.angular_defect_bound;
    options.progress = progress;
    return SMM::progressive_mesh_by_edge_collapse(m_chart.mesh, is_locked, options);
  }
  SMM::Flat_collapse_options options;
  options.target_vertices = target;
  options.order = m_options.engine == Decimation_engine::FLAT ? SMM::Collapse_order::BATCHED
                                                              : SMM::Collapse_order::STRICT;
  options.progress = progress;
  SMM::Flat_collapse_engine<> engine(
    m_chart.mesh, std::move(m_chart.rings), is_locked, SMM::hierarchy_collapse_cost(),
    SMM::hierarchy_collapse_filter(m_options.angular_defect_bound));
  return engine.run(options);
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::build_levels()
{
  namespace SMM = Surface_mesh_multiresolution;
  if(is_hierarchical()) {
    const SMM::Progressive_mesh pm = decimate();
    if(m_progress.is_cancelled())
      return;
    SMM::Hierarchy_options options;
    options.ratio = m_options.level_ratio > 1. ? m_options.level_ratio
                  : is_cascade() ? 10. : 4.;
    options.coarsest_size = m_options.coarsest_size;
    options.rule = m_options.prolongation;
    m_levels = SMM::build_hierarchy(std::move(m_chart.mesh), pm, options);
  } else {
    m_levels = SMM::build_hierarchy(std::move(m_chart.mesh), SMM::trivial_progressive_mesh(
      m_chart.source.size()), SMM::Hierarchy_options());
  }
  m_chart.rings = SMM::internal::Vertex_rings();
  std::vector<bool> is_pinned(m_chart.source.size(), false);
  for(const Pin& pin : m_pins)
    is_pinned[pin.vertex] = true;
  for(const Level& level : m_levels) {
    m_report.levels.push_back({level.vertices.size(), level.mesh.triangles.size(), 0, 0.});
    m_is_pinned.emplace_back(level.vertices.size());
    for(std::size_t v = 0; v < level.vertices.size(); ++v)
      m_is_pinned.back()[v] = is_pinned[level.vertices[v]];
  }
}

// The weights of the triangles of each level. CGAL's energy weights a triangle by eight times its
// area, here in the unit of the normalized chart, since squares of that of the input may not exist
// in single precision; `energy_unit()` makes up for it. Coarse triangles, which are larger, get the
// mean weight of the fine ones that they stand for, so that the energy of a level resembles that of
// the finest.
template <class CoarsestSolver>
std::vector<std::vector<double>> Conformal_solver<CoarsestSolver>::triangle_weights() const
{
  std::vector<std::vector<double>> weights(m_levels.size());
  if(m_options.weights == Conformal_weights::EXACT)
    return weights;
  const auto& mesh = m_levels.back().mesh;
  Vector density(mesh.points.size(), 0.); // weight and number of the triangles at each vertex
  for(const auto& t : mesh.triangles) {
    const Conformal_triangle triangle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    weights.back().push_back(8. * triangle.area());
    for(const auto v : t)
      density[v] += Complex(weights.back().back(), 1.);
  }
  for(std::size_t l = m_levels.size() - 1; l-- > 0;) {
    Vector coarse;
    m_levels[l + 1].from_coarser.restrict_in_place(density, coarse);
    density.swap(coarse);
    for(const auto& t : m_levels[l].mesh.triangles) {
      const Complex sum = density[t[0]] + density[t[1]] + density[t[2]];
      weights[l].push_back(sum.real() / sum.imag());
    }
  }
  return weights;
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::build_operators()
{
  namespace SMM = Surface_mesh_multiresolution;
  typedef SMM::internal::Triangles_at_vertices Triangles_at_vertices;
  const std::size_t count = m_levels.size();
  const std::vector<std::vector<double>> weights = triangle_weights();
  m_operators.resize(count);
  const auto corners = [this](std::size_t l) {
    return Triangles_at_vertices(m_levels[l].mesh.triangles, m_levels[l].vertices.size());
  };
  Triangles_at_vertices at = corners(count - 1);
  Half_cotangents cot(m_levels.back().mesh);
  for(std::size_t l = count; l-- > 0;) {
    Level& level = m_levels[l];
    const auto assemble = [&](auto& op) {
      typedef std::decay_t<decltype(op.matrix.diagonal()[0])> Real;
      op = assemble_conformal_operator<Real>(level.mesh.triangles, at, cot, m_is_pinned[l],
                                             weights[l]);
    };
    if(l + 1 == count)
      assemble(m_finest);
    else if(l == 0)
      assemble(m_coarsest);
    else
      assemble(m_operators[l]);
    if(is_spectral())
      m_masses.push_back(border_mass(level.mesh, at));
    if(is_spectral() && l + 1 == count)
      for(const auto& t : level.mesh.triangles)
        m_surface_area += Conformal_triangle(level.mesh.points[t[0]], level.mesh.points[t[1]],
                                             level.mesh.points[t[2]]).area();
    if(l > 0) {
      Triangles_at_vertices coarse_at = corners(l - 1);
      cot = coarse_cotangents({{level.mesh, at}, cot}, {m_levels[l - 1].mesh, coarse_at},
                              level.from_coarser);
      at = std::move(coarse_at);
    }
    if(!m_options.level_observer) { // only the finest faces will be asked for
      level.mesh.points = std::vector<Chart::Mesh::Point_3>();
      if(l + 1 < count)
        level.mesh.triangles = std::vector<SMM::Triangle_indices>();
    }
    if(!m_progress(0.65, 0.75, double(count - l) / double(count)))
      return;
  }
  std::reverse(m_masses.begin(), m_masses.end());
  m_report.mollified_faces = m_finest.mollified_triangles;
  if(m_report.mollified_faces > 0)
    m_report.warnings.push_back(std::to_string(m_report.mollified_faces)
      + " faces have no area; they were given some by mollification");
  if(count == 1 || !has_cycles())
    return;
  for(std::size_t l = 0; l < count; ++l) {
    Multigrid::Hermitian_matrix<float> matrix;
    if(l == 0)
      matrix.assign(m_coarsest.matrix);
    else if(l + 1 == count)
      matrix.assign(m_finest.matrix);
    else
      matrix = m_operators[l].matrix;
    std::vector<float> inverse = Multigrid::l1_inverse_diagonal(matrix);
    m_multigrid.add_level(std::move(matrix), std::move(inverse),
                          l == 0 ? nullptr : &m_levels[l].from_coarser);
  }
}

// Sets the unknowns that are not pinned so that the residual vanishes.
template <class Solver, class Real>
bool solve_for_free(Solver& solver, const Conformal_operator<Real>& op,
                    Multigrid::Complex_vector<double>& z)
{
  typedef std::complex<double> Complex;
  Multigrid::Complex_vector<double> f(z.size()), x;
  op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex s) {
    f[i] = -(op.matrix.diagonal()[i] * z[i] + s);
  });
  if(!solver.factorize(op.matrix))
    return false;
  solver.solve(f, x);
  for(std::size_t i = 0; i < z.size(); ++i) {
    z[i] += x[i];
    if(!std::isfinite(z[i].real()) || !std::isfinite(z[i].imag()))
      return false;
  }
  return true;
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::conclude(const Multigrid::Iteration_report& result,
                                                const char* remedy)
{
  m_report.iterations = result.iterations;
  m_report.converged = result.converged;
  m_report.cancelled = result.cancelled;
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
  m_report.converged = solve_for_free(solver, m_finest, z);
  if(!m_report.converged)
    m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                 "the matrix cannot be factorized; use the hierarchical method");
}

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_monogrid(Vector& z)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = m_options.tolerance;
  stop.maximal_iterations = maximal_iterations(100000);
  const auto progress = [this](double part) { return m_progress(0.75, 1., part); };
  const double energy = m_finest.energy(z);
  const char* remedy = "raise the number of iterations or use the hierarchical method";
  if(m_options.preconditioner == Monogrid_preconditioner::JACOBI)
    conclude(Multigrid::minimize_energy(m_finest.matrix, z, energy,
               Multigrid::Jacobi_preconditioner<double>(m_finest.matrix), stop, progress), remedy);
  else
    conclude(Multigrid::minimize_energy(m_finest.matrix, z, energy,
               Multigrid::Symmetric_gauss_seidel_preconditioner<double>(m_finest.matrix), stop,
               progress), remedy);
}

// The paper's cascade takes a fixed number of conjugate gradient steps.
template <class CoarsestSolver>
template <class Real>
Multigrid::Iteration_report
Conformal_solver<CoarsestSolver>::relax(const Conformal_operator<Real>& op,
                                        Multigrid::Complex_vector<Real>& z)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.maximal_iterations = m_schedule.post_smoothing;
  return Multigrid::minimize_energy(op.matrix, z, op.energy(z),
                                    Multigrid::Jacobi_preconditioner<Real>(op.matrix), stop,
                                    [](double) { return true; });
}

// Conjugate gradients preconditioned by a cycle. Levels below the finest are only starting points:
// two steps are enough, since their minimisers differ from the finest one anyway.
template <class CoarsestSolver>
template <class Real>
Multigrid::Iteration_report
Conformal_solver<CoarsestSolver>::improve(std::size_t l, const Conformal_operator<Real>& op,
                                          Multigrid::Complex_vector<Real>& z)
{
  const bool is_finest = l + 1 == m_levels.size();
  Multigrid::Energy_stop stop;
  stop.tolerance = m_options.tolerance;
  stop.maximal_iterations = is_finest ? maximal_iterations(500) : 2;
  const auto precondition = [&](const Multigrid::Complex_vector<Real>& r,
                                Multigrid::Complex_vector<Real>& x) {
    m_multigrid.precondition(m_schedule, l, r, x);
  };
  const auto progress = [&](double part) {
    return m_progress(is_finest ? 0.8 : 0.75, is_finest ? 1. : 0.8, is_finest ? part : 0.5);
  };
  if(is_spectral())
    return minimize_without_pins(l, op, z, precondition, stop, progress);
  return Multigrid::minimize_energy(op.matrix, z, op.energy(z), precondition, stop, progress);
}

// The rows of the pins, for which the preconditioner has no correction, are moved by the combination
// with the map itself.
template <class CoarsestSolver>
template <class Real, class Precondition, class Observe>
Multigrid::Iteration_report
Conformal_solver<CoarsestSolver>::minimize_without_pins(std::size_t l,
                                                        const Conformal_operator<Real>& op,
                                                        Multigrid::Complex_vector<Real>& z,
                                                        const Precondition& precondition,
                                                        const Multigrid::Energy_stop& stop,
                                                        const Observe& observe) const
{
  typedef Multigrid::Complex_vector<Real> Real_vector;
  const auto apply = [&op](const Real_vector& x, Real_vector& y) { op.multiply(x, y); };
  const auto precondition_free = [&](Real_vector& r, Real_vector& x) {
    for(const auto& pin : op.pinned)
      r[pin.vertex] = 0;
    precondition(r, x);
  };
  return Multigrid::minimize_rayleigh_quotient(apply, m_masses[l], z, precondition_free, stop,
                                               observe);
}

// The map of the coarsest level: that of the pins, from which inverse iterations go on if there
// are to be none.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_coarsest(Vector& z)
{
  const Conformal_operator<double>& op = m_levels.size() == 1 ? m_finest : m_coarsest;
  CoarsestSolver& solver = m_multigrid.coarsest_solver();
  if(!solve_for_free(solver, op, z))
    return m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                        "the matrix of the coarsest level cannot be factorized");
  m_report.converged = true;
  if(!is_spectral())
    return;
  Multigrid::Energy_stop stop;
  stop.tolerance = m_levels.size() == 1 ? m_options.tolerance : 1e-3;
  stop.maximal_iterations = maximal_iterations(500);
  const auto precondition = [&solver](const Vector& r, Vector& x) { solver.solve(r, x); };
  const auto result = minimize_without_pins(0, op, z, precondition, stop,
                                            [](double) { return true; });
  m_report.levels[0].iterations = result.iterations;
  if(m_levels.size() == 1)
    conclude(result, "raise the number of iterations");
}

// A map without pins has no size, position or direction of its own: that of level l gets the area of
// the surface, the first of the two far vertices at the origin and the second on the u axis. Returns
// the factor of its energy.
template <class CoarsestSolver>
double Conformal_solver<CoarsestSolver>::fit_to_surface(std::size_t l, Vector& z) const
{
  const Level& level = m_levels[l];
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

template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::observe(std::size_t l, const Vector& z) const
{
  if(!m_options.level_observer)
    return;
  std::vector<std::uint32_t> vertices;
  for(const auto v : m_levels[l].vertices)
    vertices.push_back(m_chart.source[v]);
  Vector fitted;
  if(is_spectral()) {
    fitted = z;
    fit_to_surface(l, fitted);
  }
  m_options.level_observer({l, m_levels.size(), &vertices, &m_levels[l].mesh.triangles,
                            is_spectral() ? &fitted : &z});
}

// Nested iteration: solve the coarsest level, take the solution to the next, improve it there.
template <class CoarsestSolver>
void Conformal_solver<CoarsestSolver>::solve_hierarchy(Vector& z)
{
  const std::size_t count = m_levels.size();
  solve_coarsest(z);
  if(m_chart.error != OK)
    return;
  observe(0, z);
  for(std::size_t l = 1; l < count; ++l) {
    Stopwatch watch;
    Vector fine;
    m_levels[l].from_coarser.prolongate(z, fine);
    z.swap(fine);
    Multigrid::Iteration_report result;
    if(l + 1 == count) {
      result = is_cascade() ? relax(m_finest, z) : improve(l, m_finest, z);
      if(result.converged)
        relax_flipped_faces(m_finest.matrix, m_levels[l].mesh.triangles, z);
      conclude(result, "raise the number of iterations or of smoothing steps");
    } else {
      Multigrid::Complex_vector<float> rounded(z.begin(), z.end());
      result = is_cascade() ? relax(m_operators[l], rounded) : improve(l, m_operators[l], rounded);
      z.assign(rounded.begin(), rounded.end());
      if(!is_spectral()) // pins keep their full precision
        for(const Pin& pin : m_pins)
          z[m_levels[l].position(pin.vertex)] = pin.value;
    }
    m_report.levels[l].iterations = result.iterations;
    m_report.levels[l].seconds = watch.lap();
    if(!m_progress(0.75, 0.8, double(l) / double(count)))
      return;
    observe(l, z);
  }
}

template <class CoarsestSolver>
typename Conformal_solver<CoarsestSolver>::Vector Conformal_solver<CoarsestSolver>::run()
{
  const auto is_stopped = [this] {
    m_report.cancelled = m_report.cancelled || m_progress.is_cancelled();
    return m_report.cancelled || m_chart.error != OK;
  };
  build_levels();
  m_report.seconds_hierarchy += m_watch.lap();
  if(is_stopped())
    return Vector();
  build_operators();
  m_report.seconds_operators += m_watch.lap();
  if(is_stopped())
    return Vector();
  Vector z(m_levels[0].vertices.size(), 0.);
  for(const Pin& pin : m_pins)
    z[m_levels[0].position(pin.vertex)] = pin.value;
  switch(m_options.method) {
  case Conformal_method::DIRECT: solve_directly(z); break;
  case Conformal_method::LSCM: solve_monogrid(z); break;
  default: solve_hierarchy(z);
  }
  if(!is_stopped() && m_progress(0.75, 1., 1.) && !is_hierarchical())
    observe(0, z);
  if(is_stopped())
    m_report.converged = false;
  if(is_spectral() && !z.empty() && z.size() == m_chart.source.size())
    m_report.energy_gap_estimate *= fit_to_surface(m_levels.size() - 1, z);
  if(!m_report.cancelled && (m_chart.error == OK || m_report.iterations > 0))
    m_report.energy = energy_unit() * m_finest.energy(z); // also of an iteration that gave up
  m_report.seconds_solve += m_watch.lap();
  return z;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CONFORMAL_SOLVER_H
