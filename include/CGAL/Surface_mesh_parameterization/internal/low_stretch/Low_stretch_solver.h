// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Remaining_gain.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/relax_turned_parts.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Vertex_insertion.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/circle_map.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/hold_pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/reach_pins.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// From a few vertices to all: on each level vertices are put into the map of the level before, and
// Newton's method goes as far as pays off.
template <class Energy>
class Low_stretch_solver
{
public:
  Low_stretch_solver(const Low_stretch_options& options, const Energy& energy)
    : m_options(options), m_energy(energy), m_coarse_energy(coarse_energy(energy))
    , m_progress(options.progress)
  {}

  // Maps a connected mesh of genus 0 with a border, normalized and in spatial order; returns the
  // place of each vertex, or none, if rounding leaves no place for one.
  //
  // A vertex inside has no place in the fan of a border vertex that goes around it once or more. That
  // is rare; if it happens, all is done again with collapses after which it cannot. Where a border is
  // held they are taken at once: others join its vertices by edges for which it may have no room.
  //
  // If the held vertices do not get to their places without a triangle that turns over, there is no
  // map, and `misses_pins()`.
  std::vector<Plane_point> run(Indexed_mesh::Indexed_triangle_mesh mesh,
                               Indexed_mesh::Vertex_rings rings, Stretch_task task)
  {
    std::vector<Plane_point> start = std::move(task.start);
    m_levels.set_task(std::move(task), mesh.points.size());
    const Border_rule rule = m_levels.holds_border(rings) ? Border_rule::ITS_OWN : Border_rule::ANY;
    build_levels(std::move(mesh), std::move(rings), rule);
    if(!start.empty())
      return improve_start(std::move(start));
    std::vector<Plane_point> places = insert_all();
    if(!places.empty() || m_misses_pins || rule == Border_rule::ITS_OWN)
      return places;
    mesh = m_levels.take_mesh();
    rings = Indexed_mesh::Vertex_rings(mesh);
    build_levels(std::move(mesh), std::move(rings), Border_rule::ITS_OWN);
    return insert_all();
  }

  // Maps the mesh of the last run again, with other held vertices, from a map of it without a flip.
  std::vector<Plane_point> run_again(std::vector<Plane_point> places, std::vector<Held_vertex> held)
  {
    m_watch.lap();
    m_progress.restart();
    m_report = Low_stretch_report();
    m_misses_pins = false;
    m_levels.set_held(std::move(held), places.size());
    return improve(std::move(places));
  }

  bool misses_pins() const { return m_misses_pins; }
  // Of the mesh of the last run.
  const std::vector<Triangle_indices>& triangles() const { return m_levels.finest().mesh.triangles; }
  const Low_stretch_report& report() const { return m_report; }

private:
  // Coarse levels need a barrier: where triangles collapse there is no place for more of them.
  typedef std::conditional_t<Has_barrier<Energy>::value, Energy, Barrier_energy<Energy>> Coarse_energy;

  static constexpr double rounding = 1e-13;      // of an energy
  // Steps on the finest level after which the matrices of coarser ones are no longer trusted: on long
  // tubes and steep noise triangles are stretched otherwise there.
  static constexpr std::size_t patience = 8;
  static constexpr double share_of_decimation = 0.2, share_of_queue = 1.;

  static Coarse_energy coarse_energy(const Energy& energy)
  {
    if constexpr(Has_barrier<Energy>::value)
      return energy;
    else
      return {energy};
  }

  bool goes_on(double part)
  {
    if(!m_progress(share_of_decimation, 1., part)
       || (m_options.time_limit > 0. && m_watch.seconds() > m_options.time_limit))
      m_report.is_cut_short = true;
    return !m_report.is_cut_short;
  }

  void build_levels(Indexed_mesh::Indexed_triangle_mesh mesh, Indexed_mesh::Vertex_rings rings,
                    Border_rule rule);
  std::vector<Plane_point> insert_all();
  std::vector<Plane_point> improve_start(std::vector<Plane_point> places);
  std::vector<Plane_point> improve(std::vector<Plane_point> places);
  std::vector<Plane_point> finished(std::vector<Plane_point> places);
  bool start(std::vector<Plane_point>& places);
  bool insert(std::size_t first, std::size_t last, std::vector<Plane_point>& places);
  template <class Level_energy>
  void minimize(std::size_t l, const Level_energy& energy, std::vector<Plane_point>& places);
  template <class Level>
  void descend(Level& level, std::size_t l);
  std::size_t most_steps(std::size_t l) const;
  template <class Level>
  bool is_enough(const Level& level, std::size_t l, const Newton_steps& newton, double swept);
  template <class Level>
  bool is_enough_after_parts(Level& level);
  template <class Level>
  double tolerance(const Level& level) const;

  const Low_stretch_options& m_options;
  const Energy& m_energy;
  const Coarse_energy m_coarse_energy;
  Low_stretch_report m_report;
  Blocked_execution::Progress m_progress;
  Blocked_execution::Stopwatch m_watch;
  Stretch_hierarchy m_levels;
  Newton_steps m_newton;
  std::vector<double> m_weights; // of the energy at vertices of the levels so far; empty: 1
  bool m_misses_pins = false;
  double m_mean = 0.; // energy an area of the last level
  Remaining_gain m_gains; // of the steps on the level
};

template <class Energy>
void Low_stretch_solver<Energy>::build_levels(Indexed_mesh::Indexed_triangle_mesh mesh,
                                              Indexed_mesh::Vertex_rings rings, Border_rule rule)
{
  const double begin = m_watch.seconds();
  m_levels.build(std::move(mesh), std::move(rings), rule, [this](double part) {
    m_report.is_cut_short = m_report.is_cut_short || !m_progress(0., share_of_decimation, part);
    return true; // without levels there is no map
  });
  m_report.seconds_decimation += m_watch.seconds() - begin;
}

template <class Energy>
std::vector<Plane_point> Low_stretch_solver<Energy>::insert_all()
{
  const std::size_t n = m_levels.finest().vertices.size(), finest = m_levels.number_of_levels() - 1;
  m_newton = Newton_steps();
  m_report.levels.clear();
  m_weights.clear();
  std::vector<Plane_point> places(n);
  if(!start(places))
    return {};
  std::size_t collapsed = n - m_levels[0].vertices.size();
  for(std::size_t i = m_levels.collapses().collapses.size(); i-- > collapsed;) // before the coarsest level
    m_levels.split(i);
  for(std::size_t l = 0; l <= finest; ++l) {
    const std::size_t still = n - m_levels[l].vertices.size();
    m_levels.add_weights(l, m_weights);
    if(!insert(still, collapsed, places))
      return {};
    collapsed = still;
    if(l == finest) // all are back
      m_levels.forget_way();
    m_newton.add_level(m_levels.from_coarser(l));
    l < finest ? minimize(l, m_coarse_energy, places) : minimize(l, m_energy, places);
    if(m_misses_pins)
      return {};
  }
  return finished(std::move(places));
}

// Frees what only the way to the map needs; none if it is not valid.
template <class Energy>
std::vector<Plane_point> Low_stretch_solver<Energy>::finished(std::vector<Plane_point> places)
{
  m_newton = Newton_steps();
  m_report.seconds = m_watch.seconds();
  if(!is_valid(m_levels.finest().mesh.triangles, places)
     || (m_levels.is_one_to_one() && !are_apart(m_levels.task().borders, places)))
    places.clear();
  return places;
}

// Improves what is given to begin with: first it is brought to the best scale, and turned and moved
// towards the pins.
template <class Energy>
std::vector<Plane_point> Low_stretch_solver<Energy>::improve_start(std::vector<Plane_point> places)
{
  m_levels.forget_way();
  if(m_levels.has_held() && are_there(m_levels.held(), places))
    return improve(std::move(places));
  Stretch_level<Energy> level(m_levels.finest().mesh.triangles,
                              m_levels.triangles_of(m_levels.number_of_levels() - 1),
                              std::move(places), {}, m_energy);
  if(!std::isfinite(level.value()))
    return {};
  level.scale();
  places = level.places();
  if(m_levels.has_held())
    align(m_levels.held(), places);
  return improve(std::move(places));
}

// Works on the finest level alone, of which coarser ones have the matrix.
template <class Energy>
std::vector<Plane_point> Low_stretch_solver<Energy>::improve(std::vector<Plane_point> places)
{
  const std::size_t finest = m_levels.number_of_levels() - 1;
  m_newton = Newton_steps(Coarse_matrices::GALERKIN);
  for(std::size_t l = 0; l <= finest; ++l)
    m_newton.add_level(m_levels.from_coarser(l));
  Stretch_level<Energy> level(m_levels.finest().mesh.triangles, m_levels.triangles_of(finest),
                              std::move(places), m_levels.is_fixed(), m_energy);
  level.keep_apart(m_levels.borders_of(finest));
  if(!std::isfinite(level.value()))
    return {};
  m_misses_pins = !reach_pins(level, m_newton, m_levels.held(), Giving_way::AT_ONCE,
                              [this](double part) { return goes_on(0.5 * part); });
  if(m_misses_pins)
    return {};
  descend(level, finest);
  return finished(level.places());
}

template <class Energy>
bool Low_stretch_solver<Energy>::start(std::vector<Plane_point>& places)
{
  const std::vector<Plane_point> circle = Circle_map(m_levels[0].mesh).run();
  for(std::size_t v = 0; v < circle.size(); ++v)
    places[m_levels[0].vertices[v]] = circle[v];
  return is_valid(m_levels[0].mesh.triangles, circle);
}

// Undoes the collapses [first, last), pass by pass, the last one first.
template <class Energy>
bool Low_stretch_solver<Energy>::insert(std::size_t first, std::size_t last,
                                        std::vector<Plane_point>& places)
{
  const Surface_metric metric = {m_levels.finest().mesh.points, m_levels.tensors(), m_weights};
  std::optional<Border_guard> guard;
  if(m_levels.is_one_to_one())
    guard.emplace(m_levels.borders_after(last), places, 0.);
  const Vertex_insertion insertion(m_levels.rings(), places, m_levels.is_fixed(), metric, m_coarse_energy,
                                   guard ? &*guard : nullptr);
  for(std::size_t begin; last > first; last = begin) {
    begin = (std::max)(first, m_levels.begin_of_pass(last));
    if(!insert_pass(insertion, m_levels.rings(), m_levels.collapses().collapses, begin, last, m_mean,
                    [this](std::size_t i) { m_levels.undo_tensor(i); }))
      return false;
  }
  return true;
}

// More steps on small levels cost hardly anything.
template <class Energy>
std::size_t Low_stretch_solver<Energy>::most_steps(std::size_t l) const
{
  if(l + 1 == m_levels.number_of_levels())
    return m_options.maximal_iterations;
  if(l == 0)
    return 200;
  return std::size_t((std::min)(20., std::ceil(std::pow(m_levels.ratio_to_finest(l), 0.7))));
}

// Whether the energy that a level has still to lose is small enough. Finer levels lose what is left, too.
template <class Energy> template <class Level>
bool Low_stretch_solver<Energy>::is_enough(const Level& level, std::size_t l, const Newton_steps& newton,
                                           double swept)
{
  const bool is_one_to_one = m_levels.is_one_to_one();
  const double tolerance_of_coarse = is_one_to_one ? 1e-5 // or borders get stuck
                                   : (std::max)(1e-5, 0.3 * m_options.tolerance);
  m_gains.add(newton, swept);
  if(l == 0 || l + 1 < m_levels.number_of_levels()) {
    m_report.energy_gap = m_gains.value() / level.value();
    return m_report.energy_gap <= (l == 0 ? Remaining_gain::tolerance_of_coarsest : tolerance_of_coarse);
  }
  m_report.energy_gap = m_gains.value_on_finest(newton, is_one_to_one) / level.value();
  return m_report.energy_gap <= (is_one_to_one || newton.is_full() ? tolerance(level) : rounding);
}

// The same on the finest level by what the next step should gain, after what turned is relaxed alone.
template <class Energy> template <class Level>
bool Low_stretch_solver<Energy>::is_enough_after_parts(Level& level)
{
  constexpr double hopeful = 0.1; // part of what the last step should have gained
  relax_turned_parts(level, m_newton, m_options.tolerance);
  const double most = tolerance(level);
  if(!m_newton.is_solved() || m_gains.is_doubtful(m_newton)
     || m_gains.value(hopeful * m_newton.decrement()) > most * level.value())
    return false;
  const double gap = m_gains.value(m_newton.next_decrement(level)) / level.value();
  m_report.energy_gap = (std::min)(m_report.energy_gap, gap);
  return gap <= most;
}

// That of the finest level. Where all can be mapped with hardly any stretch, what there is counts more.
template <class Energy> template <class Level>
double Low_stretch_solver<Energy>::tolerance(const Level& level) const
{
  const double stretch = 1. - m_energy.value(2., 1.) / level.mean();
  return (std::max)(rounding, m_options.tolerance * (std::min)(1., 10. * stretch));
}

template <class Energy> template <class Level_energy>
void Low_stretch_solver<Energy>::minimize(std::size_t l, const Level_energy& energy,
                                          std::vector<Plane_point>& places)
{
  std::vector<Plane_point> z = m_levels.take_places(l, places);
  if(l == 0 && m_levels.has_held()) {
    m_misses_pins = !hold_pins(m_levels, energy, z, [this] { return goes_on(0.); });
    if(m_misses_pins)
      return;
  }
  Stretch_level<Level_energy> level(m_levels[l].mesh.triangles, m_levels.triangles_of(l), std::move(z),
                                    m_levels.fixed_of(l), energy);
  if(l == 0 && !m_levels.has_held())
    level.scale();
  level.keep_apart(m_levels.borders_of(l));
  descend(level, l);
  m_levels.put_places(l, level.take_places(), places);
}

// Lowers the energy of a level as far as pays off.
template <class Energy> template <class Level>
void Low_stretch_solver<Energy>::descend(Level& level, std::size_t l)
{
  const bool is_finest = l + 1 == m_levels.number_of_levels();
  const double size = 1. / m_levels.ratio_to_finest(l);
  m_gains = Remaining_gain();
  std::size_t steps = 0;
  if(goes_on(0.5 * size)) {
    level.sweep(share_of_queue);
    const std::size_t most = most_steps(l);
    const auto part = [&] { return 0.5 * size * (1. + double(steps) / double(most)); };
    for(bool is_done = false; !is_done && steps < most && goes_on(part()); ++steps) {
      const bool is_hard = is_finest && !m_levels.is_one_to_one() && !m_newton.is_solved();
      if(is_hard || (is_finest && steps == patience))
        m_newton.use(Coarse_matrices::GALERKIN);
      m_newton(level, is_hard ? Newton_steps::many_iterations : Newton_steps::usual_iterations);
      const bool is_stuck = m_newton.is_stuck((std::max)(rounding, m_options.tolerance) * level.value());
      const double swept = level.sweep(is_stuck ? share_of_queue : 0.);
      is_done = is_enough(level, l, m_newton, swept) && !is_stuck;
      if(is_finest && !is_done && !m_levels.is_one_to_one())
        is_done = is_enough_after_parts(level);
      m_report.converged = is_done && is_finest;
    }
  }
  m_report.energy = m_mean = level.mean();
  m_report.area = level.area();
  m_report.levels.push_back({level.size(), m_levels[l].mesh.triangles.size(), steps});
  m_report.iterations = steps;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H
