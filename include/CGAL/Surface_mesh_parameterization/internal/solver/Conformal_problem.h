// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_PROBLEM_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_PROBLEM_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

inline bool is_hierarchical(Conformal_method method)
{
  return method != Conformal_method::LSCM && method != Conformal_method::DIRECT;
}

// Decimates the mesh of a chart; pins stay.
inline Surface_mesh_multiresolution::Progressive_mesh
decimate(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
         const std::function<bool(double)>& progress)
{
  namespace SMM = Surface_mesh_multiresolution;
  std::vector<bool> is_locked(chart.mesh.points.size(), false);
  for(const Pin& pin : pins)
    is_locked[pin.vertex] = true;
  const std::size_t target = (std::max)(options.coarsest_size, std::size_t(3));
  if(options.engine == Decimation_engine::CGAL) {
    SMM::Progressive_mesh_options decimation;
    decimation.is_locked = std::move(is_locked);
    decimation.target_vertices = target;
    decimation.angular_defect_bound = options.angular_defect_bound;
    decimation.progress = progress;
    return SMM::progressive_mesh_by_edge_collapse(chart.mesh, decimation);
  }
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = target;
  decimation.order = options.engine == Decimation_engine::FLAT ? SMM::Collapse_order::BATCHED
                                                               : SMM::Collapse_order::STRICT;
  decimation.progress = progress;
  SMM::Flat_collapse_engine<> engine(
    chart.mesh, std::move(chart.rings), is_locked, SMM::hierarchy_collapse_cost(),
    SMM::hierarchy_collapse_filter(options.angular_defect_bound));
  return engine.run(decimation);
}

// Levels, the coarsest first, and the collapses that led to them.
struct Built_levels
{
  std::vector<Surface_mesh_multiresolution::Mesh_level> levels;
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh;
};

// The levels for the method of the options from the mesh of the chart, which is moved into the
// finest; none if `progress`, which is told how far the decimation is, returns false.
inline Built_levels
build_levels(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
             const std::function<bool(double)>& progress)
{
  namespace SMM = Surface_mesh_multiresolution;
  SMM::Hierarchy_options hierarchy;
  if(options.level_ratio > 1.)
    hierarchy.ratio = options.level_ratio;
  else if(options.method == Conformal_method::CASCADIC)
    hierarchy.ratio = 10.;
  hierarchy.coarsest_size = options.coarsest_size;
  hierarchy.rule = options.prolongation;
  bool goes_on = true;
  const auto observe = [&](double part) { return goes_on = progress(part); };
  Built_levels result;
  result.progressive_mesh
    = is_hierarchical(options.method) ? decimate(chart, pins, options, observe)
                                      : SMM::trivial_progressive_mesh(chart.source.size());
  chart.rings = Indexed_mesh::Vertex_rings();
  if(goes_on)
    result.levels
      = SMM::build_hierarchy(std::move(chart.mesh), result.progressive_mesh, hierarchy);
  return result;
}

// The weights with which the energy is that of CGAL: eight times the area of each triangle, here in
// the unit of the normalized chart, since squares of that of the input may not exist in single
// precision; `Conformal_problem::energy_unit()` makes up for it.
inline std::vector<double>
cgal_triangle_weights(const Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  std::vector<double> weights(mesh.triangles.size());
  for(std::size_t t = 0; t < weights.size(); ++t)
    weights[t] = 8. * conformal_triangle(mesh, t).area();
  return weights;
}

// The conformal energy of a chart on all levels under pins, or without them: then two pins are only
// for the first guess, and the first of them makes the preconditioner regular. Tells and shows the
// user what becomes of it.
template <class CoarsestSolver>
class Conformal_problem
{
public:
  typedef std::complex<double> Complex;
  typedef Multigrid::Complex_vector<double> Vector;

  Conformal_problem(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
                    HLSCM_report& report)
    : m_chart(chart), m_pins(pins), m_options(options), m_report(report)
    , m_progress(options.progress)
  {}

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

  std::vector<Indexed_mesh::Vertex_index> vertices_to_pin() const;
  void restart();
  void build();
  void build_hierarchy();
  void build_operators();
  void finish_level(std::size_t l);
  double fit_to_surface(std::size_t l, Vector& z) const;
  bool observe(std::size_t l, const Vector& z);
  bool is_enough();
  void conclude(const Multigrid::Iteration_report& result, const char* remedy);
  double energy_unit() const
  {
    return m_options.weights == Conformal_weights::EXACT ? 1.
                                                         : 1. / (m_chart.scale * m_chart.scale);
  }

  Chart& m_chart;
  const std::vector<Pin>& m_pins;
  const HLSCM_options& m_options;
  HLSCM_report& m_report;
  Blocked_execution::Progress m_progress;
  Blocked_execution::Stopwatch m_watch;
  Blocked_execution::Stopwatch m_since_begin;
  bool m_keeps_meshes = false;
  bool m_needs_second_pin = false;                // the preconditioner, if there are no pins
  std::vector<double> m_face_weights;             // of the user, if any
  Conformal_hierarchy<CoarsestSolver> m_hierarchy;
  std::vector<Multigrid::Diagonal_mass> m_masses; // of the levels, if there are no pins
  double m_surface_area = 0.;                     // the same
  Surface_mesh_multiresolution::Progressive_mesh m_progressive_mesh; // if it is kept
};

template <class CoarsestSolver>
void Conformal_problem<CoarsestSolver>::build_hierarchy()
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
std::vector<Indexed_mesh::Vertex_index>
Conformal_problem<CoarsestSolver>::vertices_to_pin() const
{
  if(is_spectral() && !m_needs_second_pin)
    return {m_pins[0].vertex};
  std::vector<Indexed_mesh::Vertex_index> result;
  for(const Pin& pin : m_pins)
    result.push_back(pin.vertex);
  return result;
}

// Takes from level l what is still needed of its mesh.
template <class CoarsestSolver>
void Conformal_problem<CoarsestSolver>::finish_level(std::size_t l)
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
    level.mesh.triangles = std::vector<Indexed_mesh::Triangle_indices>();
}

template <class CoarsestSolver>
void Conformal_problem<CoarsestSolver>::build_operators()
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
void Conformal_problem<CoarsestSolver>::build()
{
  build_hierarchy();
  m_report.seconds_hierarchy += m_watch.lap();
  if(is_stopped())
    return;
  build_operators();
  m_report.seconds_operators += m_watch.lap();
}

// Forgets what came of an earlier run, but for its hierarchy.
template <class CoarsestSolver>
void Conformal_problem<CoarsestSolver>::restart()
{
  m_chart.error = OK;
  m_chart.message.clear();
  m_report.cancelled = m_report.stopped_early = m_report.converged = false;
  m_report.iterations = 0;
  m_progress.restart();
  m_watch.lap();
  m_since_begin.lap();
}

// Whether the user wants the map as it is.
template <class CoarsestSolver>
bool Conformal_problem<CoarsestSolver>::is_enough()
{
  if(m_options.time_limit > 0. && m_since_begin.seconds() > m_options.time_limit)
    m_report.stopped_early = true;
  return m_report.stopped_early;
}

// A map without pins has no size, position or direction of its own: that of level l gets the area
// of the surface, the first of the two far vertices at the origin and the second on the u axis.
// Returns the factor of its energy.
template <class CoarsestSolver>
double Conformal_problem<CoarsestSolver>::fit_to_surface(std::size_t l, Vector& z) const
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

// Shows the user the map of level l; returns whether to go on.
template <class CoarsestSolver>
bool Conformal_problem<CoarsestSolver>::observe(std::size_t l, const Vector& z)
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

template <class CoarsestSolver>
void Conformal_problem<CoarsestSolver>::conclude(const Multigrid::Iteration_report& result,
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

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_PROBLEM_H
