// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Newton_steps.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_metric.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Vertex_insertion.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/circle_map.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/collapse_to_few.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/reach_pins.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    : m_options(options), m_energy(energy), m_coarse_energy(coarse_energy(energy)), m_progress(options.progress)
  {}

  // Maps a connected mesh of genus 0 with a border, normalized and in spatial order; returns the
  // place of each vertex, or none, if rounding leaves no place for one.
  //
  // A vertex inside has no place in the fan of a border vertex that goes around it once or more. That
  // is rare; if it happens, all is done again with collapses after which it cannot.
  //
  // The vertices of `held`, different ones, are held at their places. If they do not get there without
  // a triangle that turns over, there is no map, and `misses_pins()`. `metric` has a tensor for each
  // triangle, or none if the metric is that of the surface.
  std::vector<Plane_point> run(Indexed_mesh::Indexed_triangle_mesh mesh,
                               Indexed_mesh::Vertex_rings rings, std::vector<Held_vertex> held,
                               std::vector<Indexed_mesh::Space_tensor> metric)
  {
    m_metric = std::move(metric);
    m_held = std::move(held);
    m_is_fixed.assign(m_held.empty() ? 0 : mesh.points.size(), false);
    for(const Held_vertex& h : m_held)
      m_is_fixed[h.vertex] = true;
    std::vector<Plane_point> places = run_with(std::move(mesh), std::move(rings), Border_rule::ANY);
    if(!places.empty() || m_misses_pins)
      return places;
    mesh = std::move(m_levels.back().mesh);
    rings = Indexed_mesh::Vertex_rings(mesh);
    return run_with(std::move(mesh), std::move(rings), Border_rule::ITS_OWN);
  }

  bool misses_pins() const { return m_misses_pins; }
  const Low_stretch_report& report() const { return m_report; }

private:
  typedef Surface_mesh_multiresolution::Mesh_level Mesh_level;
  // Coarse levels need a barrier: where triangles collapse there is no place for more of them.
  typedef std::conditional_t<Has_barrier<Energy>::value, Energy, Barrier_energy<Energy>> Coarse_energy;

  static constexpr std::size_t coarsest_size = 40;
  static constexpr double ratio = 3.;
  static constexpr std::size_t iterations = 5;   // of conjugate gradients, a Newton step
  static constexpr double residual = 1e-3;       // that ends them, of that before them
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

  std::vector<Plane_point> run_with(Indexed_mesh::Indexed_triangle_mesh mesh,
                                    Indexed_mesh::Vertex_rings rings, Border_rule rule);
  static bool is_valid(const std::vector<Triangle_indices>& triangles,
                       const std::vector<Plane_point>& places);
  bool start(const Mesh_level& coarsest, std::vector<Plane_point>& places);
  bool insert(std::size_t first, std::size_t last, std::vector<Plane_point>& places);
  template <class Level_energy, class Reference>
  bool hold_pins(const Mesh_level& coarsest, const Reference& reference, const Level_energy& energy,
                 std::vector<Plane_point>& z);
  template <class Level_energy>
  void minimize(std::size_t l, const Level_energy& energy, std::vector<Plane_point>& places);
  std::size_t most_steps(std::size_t l) const;
  template <class Level>
  bool is_enough(const Level& level, std::size_t l, double gain);

  const Low_stretch_options& m_options;
  const Energy& m_energy;
  const Coarse_energy m_coarse_energy;
  Low_stretch_report m_report;
  Blocked_execution::Progress m_progress;
  Blocked_execution::Stopwatch m_watch;
  Surface_mesh_multiresolution::Progressive_mesh m_collapses;
  Indexed_mesh::Vertex_rings m_rings;
  std::vector<Mesh_level> m_levels;
  std::vector<Indexed_mesh::Space_tensor> m_metric; // of the triangles of the finest level
  Vertex_tensors m_tensors;
  Newton_steps m_newton;
  std::vector<Held_vertex> m_held;
  std::vector<bool> m_is_fixed; // empty without pins
  bool m_misses_pins = false;
  double m_mean = 0.; // energy an area of the last level
  double m_last_gain = 0.;
};

template <class Energy>
std::vector<Plane_point>
Low_stretch_solver<Energy>::run_with(Indexed_mesh::Indexed_triangle_mesh mesh,
                                     Indexed_mesh::Vertex_rings rings, Border_rule rule)
{
  namespace SMM = Surface_mesh_multiresolution;
  const std::size_t n = mesh.points.size();
  m_newton = Newton_steps();
  m_report.levels.clear();
  const double begin = m_watch.seconds();
  const auto collapsing = [this](double part) {
    m_report.is_cut_short = m_report.is_cut_short || !m_progress(0., share_of_decimation, part);
    return true; // without levels there is no map
  };
  const std::size_t coarsest = coarsest_size + m_held.size();
  m_collapses = collapse_to_few(mesh, std::move(rings), m_is_fixed, coarsest, rule, collapsing,
                                m_rings);
  m_tensors = Vertex_tensors(mesh, m_metric);
  m_tensors.collapse(m_collapses.collapses);
  SMM::Hierarchy_options shape;
  shape.ratio = ratio;
  shape.coarsest_size = coarsest;
  m_levels = SMM::build_hierarchy(std::move(mesh), m_collapses, shape);
  m_report.seconds_decimation += m_watch.seconds() - begin;
  std::vector<Plane_point> places(n);
  if(!start(m_levels[0], places))
    return {};
  std::size_t collapsed = n - m_levels[0].vertices.size();
  for(std::size_t i = m_collapses.collapses.size(); i-- > collapsed;) { // before the coarsest level
    m_rings.split(m_collapses.collapses[i].removed, m_collapses.collapses[i].kept);
    m_tensors.undo(m_collapses.collapses[i]);
  }
  for(std::size_t l = 0; l < m_levels.size(); ++l) {
    const std::size_t still = n - m_levels[l].vertices.size();
    if(!insert(still, collapsed, places))
      return {};
    collapsed = still;
    if(l + 1 == m_levels.size()) { // all are back
      m_rings = Indexed_mesh::Vertex_rings();
      m_collapses = SMM::Progressive_mesh();
    }
    m_newton.add_level(l == 0 ? nullptr : &m_levels[l].from_coarser);
    if(l + 1 < m_levels.size())
      minimize(l, m_coarse_energy, places);
    else
      minimize(l, m_energy, places);
    if(m_misses_pins)
      return {};
  }
  m_report.seconds = m_watch.seconds();
  return is_valid(m_levels.back().mesh.triangles, places) ? places : std::vector<Plane_point>();
}

// Whether there is a map, without a flip.
template <class Energy>
bool Low_stretch_solver<Energy>::is_valid(const std::vector<Triangle_indices>& triangles,
                                          const std::vector<Plane_point>& places)
{
  return !places.empty()
      && std::all_of(triangles.begin(), triangles.end(), [&places](const Triangle_indices& t) {
           return is_surely_positive(places[t[0]], places[t[1]], places[t[2]]);
         });
}

template <class Energy>
bool Low_stretch_solver<Energy>::start(const Mesh_level& coarsest, std::vector<Plane_point>& places)
{
  const std::vector<Plane_point> circle = Circle_map(coarsest.mesh).run();
  if(!is_valid(coarsest.mesh.triangles, circle))
    return false;
  for(std::size_t v = 0; v < circle.size(); ++v)
    places[coarsest.vertices[v]] = circle[v];
  return true;
}

// Undoes the collapses [first, last), the last one first.
template <class Energy>
bool Low_stretch_solver<Energy>::insert(std::size_t first, std::size_t last,
                                        std::vector<Plane_point>& places)
{
  const Surface_metric metric = {m_levels.back().mesh.points, m_tensors};
  Vertex_insertion<Surface_metric, Coarse_energy> insertion(m_rings, places, m_is_fixed, metric,
                                                            m_coarse_energy);
  for(std::size_t i = last; i-- > first;) {
    m_tensors.undo(m_collapses.collapses[i]);
    if(!insertion(m_collapses.collapses[i], m_mean))
      return false;
  }
  return true;
}

// More steps on small levels cost hardly anything.
template <class Energy>
std::size_t Low_stretch_solver<Energy>::most_steps(std::size_t l) const
{
  if(l + 1 == m_levels.size())
    return m_options.maximal_iterations;
  if(l == 0)
    return 200;
  const double size = double(m_levels.back().vertices.size()) / double(m_levels[l].vertices.size());
  return std::size_t((std::min)(20., std::ceil(std::pow(size, 0.7))));
}

// Whether the energy that a level has still to lose is small enough: what it lost last goes on as a
// geometric series, whose ratio is that of the last two gains, and at least `usual_rate`. A small gain
// after a large one may be luck: an eighth of that counts.
template <class Energy>
template <class Level>
bool Low_stretch_solver<Energy>::is_enough(const Level& level, std::size_t l, double gain)
{
  constexpr double usual_rate = 0.8, largest_rate = 0.95;
  constexpr double rounding = 1e-13, tolerance_of_coarse = 1e-5, tolerance_of_coarsest = 1e-7;
  const double ratio = m_last_gain > 0. ? gain / m_last_gain : 0.;
  const double rate = (std::min)(largest_rate, (std::max)(usual_rate, ratio));
  const double expected = (std::max)(gain, m_last_gain / 8.);
  m_last_gain = gain;
  m_report.energy_gap = expected * rate / (1. - rate) / level.value();
  if(l == 0)
    return m_report.energy_gap <= tolerance_of_coarsest;
  if(l + 1 < m_levels.size())
    return m_report.energy_gap <= tolerance_of_coarse;
  // Where all can be mapped with hardly any stretch, what there is counts more
  const double stretch = 1. - m_energy.value(2., 1.) / level.mean();
  return m_report.energy_gap
      <= (std::max)(rounding, m_options.tolerance * (std::min)(1., 10. * stretch));
}

// Brings the pins of the coarsest level, which has all of them, to their places, from a map without
// pins.
template <class Energy>
template <class Level_energy, class Reference>
bool Low_stretch_solver<Energy>::hold_pins(const Mesh_level& coarsest, const Reference& reference,
                                           const Level_energy& energy, std::vector<Plane_point>& z)
{
  constexpr int steps = 100;
  Stretch_level<Level_energy> level(coarsest.mesh.triangles, reference, std::move(z), {}, energy);
  level.scale();
  Newton_steps newton;
  newton.add_level(nullptr);
  m_last_gain = 0.;
  for(int i = 0; i < steps; ++i)
    if(is_enough(level, 0, newton(level, iterations, residual) + level.sweep(0.)))
      break;
  z = level.places();
  std::vector<Held_vertex> held;
  for(const Held_vertex& h : m_held)
    held.push_back({Vertex_index(coarsest.position(h.vertex)), h.place});
  m_misses_pins = !reach_pins(coarsest.mesh.triangles, reference, energy, held, z);
  return !m_misses_pins;
}

template <class Energy>
template <class Level_energy>
void Low_stretch_solver<Energy>::minimize(std::size_t l, const Level_energy& energy,
                                          std::vector<Plane_point>& places)
{
  const Mesh_level& here = m_levels[l];
  const bool is_finest = l + 1 == m_levels.size();
  std::vector<Plane_point> z(here.vertices.size());
  for(std::size_t v = 0; v < z.size(); ++v)
    z[v] = places[here.vertices[v]];
  const Surface_metric metric = {m_levels.back().mesh.points, m_tensors};
  const auto reference = [&](std::size_t t) {
    const Triangle_indices& v = here.mesh.triangles[t];
    const auto& p = here.mesh.points;
    if(m_metric.empty())
      return Reference_triangle<double>::of_points(p[v[0]], p[v[1]], p[v[2]]);
    if(is_finest)
      return Reference_triangle<double>::of_points(p[v[0]], p[v[1]], p[v[2]], m_metric[t]);
    return metric(here.vertices[v[0]], here.vertices[v[1]], here.vertices[v[2]]);
  };
  if(l == 0 && !m_held.empty() && !hold_pins(here, reference, energy, z))
    return;
  std::vector<bool> is_fixed(m_held.empty() ? 0 : z.size());
  for(std::size_t v = 0; v < is_fixed.size(); ++v)
    is_fixed[v] = m_is_fixed[here.vertices[v]];
  Stretch_level<Level_energy> level(here.mesh.triangles, reference, std::move(z),
                                    std::move(is_fixed), energy);
  if(l == 0 && m_held.empty())
    level.scale();
  const double size = double(here.vertices.size()) / double(m_levels.back().vertices.size());
  m_last_gain = 0.;
  std::size_t steps = 0;
  if(goes_on(0.5 * size)) {
    level.sweep(share_of_queue);
    const std::size_t most = most_steps(l);
    const auto part = [&] { return 0.5 * size * (1. + double(steps) / double(most)); };
    for(bool is_done = false; !is_done && steps < most && goes_on(part()); ++steps) {
      is_done = is_enough(level, l, m_newton(level, iterations, residual) + level.sweep(0.));
      m_report.converged = is_done && is_finest;
    }
  }
  m_mean = level.mean();
  for(std::size_t v = 0; v < here.vertices.size(); ++v)
    places[here.vertices[v]] = level.places()[v];
  m_report.area = level.area();
  m_report.energy = level.mean();
  m_report.levels.push_back({here.vertices.size(), here.mesh.triangles.size(), steps});
  m_report.iterations = steps;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_LOW_STRETCH_SOLVER_H
