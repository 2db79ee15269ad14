// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H

#include <CGAL/Surface_mesh_parameterization/internal/solver/methods.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A solver that keeps its hierarchy and its map for other pins, positions and weights.
//
// The map is linear in the values of the pins. When pins move, the map of their moves alone is
// found as if it were a new one, and added; its energy is small, and so is the accuracy that it
// needs. If the pin that moved last moves on, that map is at hand, and only scaled. Errors add up
// in the norm of the energy.
class Live_conformal_solver
{
public:
  typedef std::complex<double> Complex;
  typedef Conformal_vector Vector;
  typedef Indexed_mesh::Vertex_index Vertex_index;

  // Builds the hierarchy, on all levels of which these pins stay. `run`, which is kept by reference,
  // says whether it came to that.
  Live_conformal_solver(Chart chart, const Pins& pins, Coarsest_solver coarsest, Run_control& run)
    : m_run(run), m_system(std::move(chart), pins, parts_of_live_map(run.options()),
                           std::move(coarsest), run)
    , m_iteration(run.options())
  {}
  Live_conformal_solver(const Live_conformal_solver&) = delete;
  Live_conformal_solver& operator=(const Live_conformal_solver&) = delete;

  const Conformal_system& system() const { return m_system; }

  // Gives the vertices of the chart, which is normalized by `scale`, new positions.
  void set_points(const std::vector<Chart::Mesh::Point_3>& points, double scale);

  // Multiplies the energy of each triangle of the chart by a weight.
  void set_face_weights(std::vector<double> weights)
  {
    m_system.face_weights = std::move(weights);
    m_is_outdated = true;
  }

  // Takes other pins; if the map is free, those with which it begins.
  void set_pins(Pins pins, bool is_free)
  {
    m_system.pins = std::move(pins);
    m_system.is_free = is_free;
  }

  // Brings the map up to date; the run says what became of it.
  void solve();

  // The map; empty if there is none.
  const Vector& map() const { return m_map; }

  // The finest level of at most `size` vertices, or the coarsest, and nearly what its map will be.
  std::size_t preview_level(std::size_t size) const;
  Vector preview(std::size_t level);
  const Surface_mesh_multiresolution::Mesh_level& level(std::size_t l) const
  {
    return m_system.hierarchy.levels()[l];
  }

private:
  // What a move of one pin by 1 makes of the map.
  struct Unit_move
  {
    Vertex_index vertex = Indexed_mesh::no_vertex;
    Vector map;
    double error = 0.; // in the norm of the energy
  };

  static System_parts parts_of_live_map(const HLSCM_options& options)
  {
    System_parts parts = parts_for(options);
    parts.has_border_mass = parts.keeps_meshes = true;
    return parts;
  }
  static bool is_move(const Pin& pin) { return pin.value != 0.; }

  void begin();
  void update_operators();
  void update_pins();
  Pins moves() const;
  bool move_all_alike(const Pins& moves);
  bool map_of_moves(std::size_t last, const Pins& moves, Vector& w);
  void add(const Complex& factor, const Vector& w, double error);
  void add_map_of_moves(const Pins& moves);
  double energy_for_tolerance() const;
  bool is_good_enough() const;
  void follow_pins();
  void iterate();

  Run_control& m_run;
  Conformal_system m_system;
  Cycle_iteration m_iteration;
  bool m_is_outdated = false;      // the operators are
  bool m_was_free = false;
  bool m_is_solved = false;        // m_map is the minimum for the operators and the values it has
  double m_gap = 0.;               // of its energy
  Unit_move m_unit_move;           // for the operators; the last one
  Vector m_map;
};

inline void
Live_conformal_solver::set_points(const std::vector<Chart::Mesh::Point_3>& points, double scale)
{
  for(auto& level : m_system.hierarchy.levels())
    for(std::size_t i = 0; i < level.vertices.size(); ++i)
      level.mesh.points[i] = points[level.vertices[i]];
  m_system.set_scale(scale);
  m_is_outdated = true;
}

inline void Live_conformal_solver::update_operators()
{
  if(!m_is_outdated)
    return;
  m_is_outdated = m_is_solved = false;
  m_iteration.set_rate(0.);
  m_unit_move = Unit_move();
  m_system.build_operators(m_run);
  m_system.hierarchy.factorize_coarsest();
  m_run.lap(m_run.report().seconds_operators);
}

inline void Live_conformal_solver::update_pins()
{
  const Conformal_hierarchy::Pin_changes changes = m_system.update_pins();
  if(changes.pinned + changes.released == 0)
    return;
  m_is_solved = m_is_solved && changes.released == 0;
  m_unit_move = Unit_move();
  m_iteration.set_rate(0.);
  if(!m_system.hierarchy.factorize_coarsest() && m_system.is_free && !m_system.needs_second_pin) {
    m_system.needs_second_pin = true;
    update_pins();
  }
}

// Brings operators and pins up to date.
inline void Live_conformal_solver::begin()
{
  m_run.restart();
  update_operators();
  update_pins();
}

// By how much each pin is to move.
inline Pins Live_conformal_solver::moves() const
{
  Pins result;
  for(const Pin& pin : m_system.pins)
    result.push_back({pin.vertex, pin.value - m_map[pin.vertex]});
  return result;
}

// If one similarity moves all pins, it moves the map: two pins need nothing else.
inline bool Live_conformal_solver::move_all_alike(const Pins& moves)
{
  const double count = double(moves.size());
  Complex mean = 0., mean_move = 0., product = 0.;
  for(const Pin& m : moves) {
    mean += m_map[m.vertex] / count;
    mean_move += m.value / count;
  }
  double square = 0., size = 0.;
  for(const Pin& m : moves) {
    const Complex from_mean = m_map[m.vertex] - mean;
    product += std::conj(from_mean) * (m.value - mean_move);
    square += std::norm(from_mean);
    size = (std::max)({size, std::abs(from_mean), std::abs(m.value)});
  }
  if(!(square > 0.))
    return false;
  const Complex factor = product / square, shift = mean_move - factor * mean;
  for(const Pin& m : moves)
    if(!(std::abs(m.value - (factor * m_map[m.vertex] + shift)) <= 1e-13 * size))
      return false;
  Multigrid::for_each_index(m_map.size(), [&](std::size_t i) {
    m_map[i] += factor * m_map[i] + shift;
  });
  m_gap *= std::norm(1. + factor);
  return true;
}

// The map of the moves on level `last`, from below.
inline bool Live_conformal_solver::
map_of_moves(std::size_t last, const Pins& moves, Vector& w)
{
  w = m_system.hierarchy.at_pins(moves);
  if(!solve_for_free(m_system.hierarchy.coarsest_solver(), m_system.hierarchy.coarsest(), w))
    return false;
  for(std::size_t l = 1; l <= last; ++l) {
    w = m_system.hierarchy.prolonged(l, w);
    m_system.hierarchy.set_pins(l, moves, w);
    if(l < m_system.finest())
      m_iteration.improve(m_system, l, m_run, w);
  }
  return true;
}

// Adds `factor` times a map whose error in the norm of the energy is `error`.
inline void Live_conformal_solver::add(const Complex& factor, const Vector& w, double error)
{
  Multigrid::add_scaled(factor, w, m_map);
  const double sum = std::sqrt(m_gap) + std::abs(factor) * error;
  m_gap = sum * sum;
}

// The energy whose part by the tolerance the map of a move may be off, though its own is smaller:
// errors add up in the norm, and most of what is left between that of the map and the tolerance is
// for this move, the rest for the next ones.
inline double Live_conformal_solver::energy_for_tolerance() const
{
  constexpr double this_move = 0.7, at_least = 0.2;
  const double energy = m_system.hierarchy.finest().energy(m_map);
  const double room = 1. - std::sqrt(m_gap / (m_run.options().tolerance * energy));
  const double part = (std::max)(at_least, this_move * room); // if that is a number
  return part * part * energy;
}

// Computes the map of the moves and adds it.
inline void Live_conformal_solver::add_map_of_moves(const Pins& moves)
{
  const std::size_t finest = m_system.finest();
  Vector w;
  if(!map_of_moves(finest, moves, w))
    return m_run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                               "the system of the coarsest level cannot be solved");
  double error = 0.;
  if(finest > 0) {
    const auto result = m_iteration.improve(m_system, finest, m_run, w, energy_for_tolerance());
    m_run.report().iterations += result.iterations;
    if(result.converged)
      m_iteration.set_rate((std::max)(m_iteration.rate(), result.rate));
    error = std::sqrt(result.energy_gap);
  }
  add(1., w, error);
  m_unit_move = Unit_move();
  const auto moved = std::find_if(moves.begin(), moves.end(), is_move);
  if(std::count_if(moves.begin(), moves.end(), is_move) != 1)
    return;
  const Complex inverse = 1. / moved->value;
  Multigrid::for_each_index(w.size(), [&](std::size_t i) { w[i] *= inverse; });
  m_unit_move = {moved->vertex, std::move(w), error * std::abs(inverse)};
}

inline bool Live_conformal_solver::is_good_enough() const
{
  return m_gap <= m_run.options().tolerance * m_system.hierarchy.finest().energy(m_map);
}

inline void Live_conformal_solver::follow_pins()
{
  const Pins all = moves();
  const auto moved = std::find_if(all.begin(), all.end(), is_move);
  if(moved != all.end() && !move_all_alike(all)) {
    const bool is_dragged_on = moved->vertex == m_unit_move.vertex
                            && std::count_if(all.begin(), all.end(), is_move) == 1;
    if(is_dragged_on)
      add(moved->value, m_unit_move.map, m_unit_move.error);
    else
      add_map_of_moves(all);
    m_is_solved = m_is_solved && is_good_enough();
  }
  for(const Pin& pin : m_system.pins)
    m_map[pin.vertex] = pin.value; // whatever was rounded
  if(!m_is_solved && !m_run.is_stopped())
    iterate();
}

inline void Live_conformal_solver::iterate()
{
  if(m_system.finest() > 0 || m_system.is_free) {
    m_gap = m_iteration.complete(m_system, m_run, m_map).energy_gap;
  } else {
    m_run.report().converged
      = solve_for_free(m_system.hierarchy.coarsest_solver(), m_system.hierarchy.coarsest(), m_map);
    m_gap = 0.;
  }
  m_is_solved = m_run.report().converged;
}

inline void Live_conformal_solver::solve()
{
  if(!m_was_free && m_system.is_free && !m_map.empty())
    m_system.needs_second_pin
      = is_without_energy(m_system.hierarchy.finest().energy(m_map), Multigrid::extent(m_map));
  begin();
  if(m_was_free != m_system.is_free) {
    m_was_free = m_system.is_free;
    m_is_solved = false;
    m_iteration.set_rate(0.);
  }
  HLSCM_report& report = m_run.report();
  if(m_map.empty()) {
    m_map = find_map(m_system.is_free ? Conformal_method::SPECTRAL : Conformal_method::HLSCM,
                     m_system, m_run, m_iteration);
    m_gap = report.energy_gap_estimate / m_system.energy_unit;
    m_is_solved = report.converged;
    if(m_run.is_stopped())
      m_map.clear();
    return;
  }
  if(!m_system.is_free)
    follow_pins();
  else if(!m_is_solved)
    iterate();
  report.converged = m_is_solved;
  report.energy_gap_estimate = m_system.energy_unit * m_gap;
  place_map(m_system, m_run, m_map);
}

inline std::size_t Live_conformal_solver::preview_level(std::size_t size) const
{
  std::size_t l = 0;
  while(l + 1 < m_system.finest() + 1 && level(l + 1).vertices.size() <= size)
    ++l;
  return l;
}

inline Conformal_vector
Live_conformal_solver::preview(std::size_t l)
{
  begin();
  Vector w(level(l).vertices.size(), 0.);
  if(m_map.empty()) {
    const bool needed = m_system.needs_second_pin;
    m_system.needs_second_pin = true; // a free map begins under both
    m_system.update_pins();
    m_system.hierarchy.factorize_coarsest();
    map_of_moves(l, m_system.pins, w);
    m_system.needs_second_pin = needed;
    m_system.update_pins();
    return w;
  }
  if(!m_system.is_free)
    map_of_moves(l, moves(), w);
  for(std::size_t i = 0; i < w.size(); ++i)
    w[i] += m_map[level(l).vertices[i]];
  return w;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H
