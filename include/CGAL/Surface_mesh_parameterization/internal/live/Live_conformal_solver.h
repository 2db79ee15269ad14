// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H

#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_solver.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>
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
template <class CoarsestSolver>
class Live_conformal_solver
  : private Conformal_solver<CoarsestSolver>
{
  typedef Conformal_solver<CoarsestSolver> Base;

public:
  using typename Base::Complex;
  using typename Base::Vector;
  typedef Indexed_mesh::Vertex_index Vertex_index;

  // Builds the hierarchy, on all levels of which the pins of now stay. All is kept by reference;
  // the pins, and the method, HLSCM or SPECTRAL, may change.
  Live_conformal_solver(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
                        HLSCM_report& report)
    : Base(chart, pins, options, report)
  {
    m_keeps_meshes = true;
    this->build();
    set_pinned();
  }

  // Gives the vertices of the chart, which is normalized, new positions.
  void set_points(const std::vector<Chart::Mesh::Point_3>& points);

  // Multiplies the energy of each triangle of the chart by a weight.
  void set_face_weights(std::vector<double> weights)
  {
    m_face_weights = std::move(weights);
    m_is_outdated = true;
  }

  // Brings the map up to date; the chart's error and the report say what became of it.
  void solve();

  // The map; empty if there is none.
  const Vector& map() const { return m_map; }

  // The finest level of at most `size` vertices, or the coarsest, and nearly what its map will be.
  std::size_t preview_level(std::size_t size) const;
  Vector preview(std::size_t level);
  const Surface_mesh_multiresolution::Mesh_level& level(std::size_t l) const
  {
    return m_hierarchy.levels()[l];
  }
  const Surface_mesh_multiresolution::Mesh_level& finest_level() const
  {
    return m_hierarchy.levels().back();
  }

private:
  using Base::m_chart;
  using Base::m_face_weights;
  using Base::m_hierarchy;
  using Base::m_keeps_meshes;
  using Base::m_needs_second_pin;
  using Base::m_options;
  using Base::m_pins;
  using Base::m_rate;
  using Base::m_report;
  using Base::m_watch;

  // What a move of one pin by 1 makes of the map.
  struct Unit_move
  {
    Vertex_index vertex = Indexed_mesh::no_vertex;
    Vector map;
    double error = 0.; // in the norm of the energy
  };

  static bool is_move(const Pin& pin) { return pin.value != 0.; }

  void set_pinned();
  void update_operators();
  void update_pins();
  std::vector<Pin> moves() const;
  bool move_all_alike(const std::vector<Pin>& moves);
  bool map_of_moves(std::size_t last, const std::vector<Pin>& moves, Vector& w);
  void add(const Complex& factor, const Vector& w, double error);
  void add_map_of_moves(const std::vector<Pin>& moves);
  double energy_for_tolerance() const;
  bool is_good_enough() const;
  void follow_pins();
  void iterate();

  std::set<Vertex_index> m_pinned; // in the operators
  bool m_is_outdated = false;      // the operators are
  bool m_was_spectral = false;
  bool m_is_solved = false;        // m_map is the minimum for the operators and the values it has
  double m_gap = 0.;               // of its energy
  Unit_move m_unit_move;           // for the operators; the last one
  Vector m_map;
};

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::set_pinned()
{
  const auto vertices = this->vertices_to_pin();
  m_pinned = std::set<Vertex_index>(vertices.begin(), vertices.end());
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::
set_points(const std::vector<Chart::Mesh::Point_3>& points)
{
  for(auto& level : m_hierarchy.levels())
    for(std::size_t i = 0; i < level.vertices.size(); ++i)
      level.mesh.points[i] = points[level.vertices[i]];
  m_is_outdated = true;
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::update_operators()
{
  if(!m_is_outdated)
    return;
  m_is_outdated = m_is_solved = false;
  m_rate = 0.;
  m_unit_move = Unit_move();
  this->build_operators();
  set_pinned();
  m_hierarchy.factorize_coarsest();
  m_report.seconds_operators += m_watch.lap();
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::update_pins()
{
  const std::set<Vertex_index> before = m_pinned;
  set_pinned();
  if(m_pinned == before)
    return;
  for(const Vertex_index v : before)
    if(m_pinned.count(v) == 0) {
      m_hierarchy.release(v);
      m_is_solved = false;
    }
  for(const Vertex_index v : m_pinned)
    if(before.count(v) == 0)
      m_hierarchy.pin(v);
  m_unit_move = Unit_move();
  m_rate = 0.;
  if(!m_hierarchy.factorize_coarsest() && this->is_spectral() && !m_needs_second_pin) {
    m_needs_second_pin = true;
    update_pins();
  }
}

// By how much each pin is to move.
template <class CoarsestSolver>
std::vector<Pin> Live_conformal_solver<CoarsestSolver>::moves() const
{
  std::vector<Pin> result;
  for(const Pin& pin : m_pins)
    result.push_back({pin.vertex, pin.value - m_map[pin.vertex]});
  return result;
}

// If one similarity moves all pins, it moves the map: two pins need nothing else.
template <class CoarsestSolver>
bool Live_conformal_solver<CoarsestSolver>::move_all_alike(const std::vector<Pin>& moves)
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
template <class CoarsestSolver>
bool Live_conformal_solver<CoarsestSolver>::
map_of_moves(std::size_t last, const std::vector<Pin>& moves, Vector& w)
{
  w = m_hierarchy.at_pins(moves);
  if(!solve_for_free(m_hierarchy.coarsest_solver(), m_hierarchy.coarsest(), w))
    return false;
  for(std::size_t l = 1; l <= last; ++l) {
    w = m_hierarchy.prolonged(l, w);
    m_hierarchy.set_pins(l, moves, w);
    if(l + 1 < m_hierarchy.number_of_levels())
      this->improve(l, w);
  }
  return true;
}

// Adds `factor` times a map whose error in the norm of the energy is `error`.
template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::add(const Complex& factor, const Vector& w, double error)
{
  Multigrid::add_scaled(factor, w, m_map);
  const double sum = std::sqrt(m_gap) + std::abs(factor) * error;
  m_gap = sum * sum;
}

// The energy whose part by the tolerance the map of a move may be off, though its own is smaller:
// errors add up in the norm, and most of what is left between that of the map and the tolerance is
// for this move, the rest for the next ones.
template <class CoarsestSolver>
double Live_conformal_solver<CoarsestSolver>::energy_for_tolerance() const
{
  constexpr double this_move = 0.7, at_least = 0.2;
  const double energy = m_hierarchy.finest().energy(m_map);
  const double room = 1. - std::sqrt(m_gap / (m_options.tolerance * energy));
  const double part = (std::max)(at_least, this_move * room); // if that is a number
  return part * part * energy;
}

// Computes the map of the moves and adds it.
template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::add_map_of_moves(const std::vector<Pin>& moves)
{
  const std::size_t finest = m_hierarchy.number_of_levels() - 1;
  Vector w;
  if(!map_of_moves(finest, moves, w))
    return m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM,
                        "the system of the coarsest level cannot be solved");
  double error = 0.;
  if(finest > 0) {
    const auto result = this->improve(finest, w, energy_for_tolerance());
    m_report.iterations += result.iterations;
    if(result.converged)
      m_rate = (std::max)(m_rate, result.rate);
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

template <class CoarsestSolver>
bool Live_conformal_solver<CoarsestSolver>::is_good_enough() const
{
  return m_gap <= m_options.tolerance * m_hierarchy.finest().energy(m_map);
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::follow_pins()
{
  const std::vector<Pin> all = moves();
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
  for(const Pin& pin : m_pins)
    m_map[pin.vertex] = pin.value; // whatever was rounded
  if(!m_is_solved && !this->is_stopped())
    iterate();
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::iterate()
{
  const std::size_t finest = m_hierarchy.number_of_levels() - 1;
  if(finest > 0 || this->is_spectral()) {
    const auto result = this->improve(finest, m_map);
    this->finish(result, m_map);
    m_gap = result.energy_gap;
  } else {
    m_report.converged
      = solve_for_free(m_hierarchy.coarsest_solver(), m_hierarchy.coarsest(), m_map);
    m_gap = 0.;
  }
  m_is_solved = m_report.converged;
}

template <class CoarsestSolver>
void Live_conformal_solver<CoarsestSolver>::solve()
{
  this->restart();
  if(!m_was_spectral && this->is_spectral() && !m_map.empty())
    m_needs_second_pin
      = is_without_energy(m_hierarchy.finest().energy(m_map), Multigrid::extent(m_map));
  update_operators();
  update_pins();
  if(m_was_spectral != this->is_spectral()) {
    m_was_spectral = this->is_spectral();
    m_is_solved = false;
    m_rate = 0.;
  }
  if(m_map.empty()) {
    Base::solve(m_map);
    m_gap = m_report.energy_gap_estimate / this->energy_unit();
    m_is_solved = m_report.converged;
    set_pinned(); // what the first guess has left
    if(this->is_stopped())
      m_map.clear();
    return;
  }
  if(!this->is_spectral())
    follow_pins();
  else if(!m_is_solved)
    iterate();
  m_report.converged = m_is_solved;
  m_report.energy_gap_estimate = this->energy_unit() * m_gap;
  this->conclude_map(m_map);
}

template <class CoarsestSolver>
std::size_t Live_conformal_solver<CoarsestSolver>::preview_level(std::size_t size) const
{
  std::size_t l = 0;
  while(l + 1 < m_hierarchy.number_of_levels() && level(l + 1).vertices.size() <= size)
    ++l;
  return l;
}

template <class CoarsestSolver>
typename Live_conformal_solver<CoarsestSolver>::Vector
Live_conformal_solver<CoarsestSolver>::preview(std::size_t l)
{
  this->restart();
  update_operators();
  update_pins();
  Vector w(level(l).vertices.size(), 0.);
  if(m_map.empty()) {
    m_hierarchy.factorize_coarsest();
    map_of_moves(l, m_pins, w);
    return w;
  }
  if(!this->is_spectral())
    map_of_moves(l, moves(), w);
  for(std::size_t i = 0; i < w.size(); ++i)
    w[i] += m_map[level(l).vertices[i]];
  return w;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_CONFORMAL_SOLVER_H
