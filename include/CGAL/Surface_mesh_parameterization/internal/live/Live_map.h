// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/live/Live_conformal_solver.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/check_options.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The map that a `Hierarchical_conformal_map` keeps: its chart, the pins of the user and the
// solver, which refers to the others, so that they stay in their place. Vertices are those of the
// chart.
template <class CoarsestSolver>
class Live_map
{
public:
  typedef std::complex<double> Complex;
  typedef Indexed_mesh::Vertex_index Vertex_index;
  typedef std::vector<Chart::Mesh::Point_3> Points;

  // Checks the options. To be set then, if there is no error, are the chart and its pins; after
  // that the solver is to be built.
  explicit Live_map(const HLSCM_options& options);
  Live_map(const Live_map&) = delete;
  Live_map& operator=(const Live_map&) = delete;

  void set_chart(Chart chart);

  // Builds the solver, which has the pins of now on all levels. Without pins of the user they are
  // the two far ones, if the method has pins.
  void build(bool has_pins);

  const Chart& chart() const { return m_chart; }
  const HLSCM_report& report() const { return m_report; }

  // There will never be a map.
  bool is_broken() const { return m_is_broken; }
  bool has_map() const { return m_solver && !m_solver->map().empty(); }

  // Those of the chart. Precondition: it is not broken.
  const std::vector<Indexed_mesh::Triangle_indices>& triangles() const
  {
    return m_solver->finest_level().mesh.triangles;
  }

  // Records an error, unless there is one already without which there would be no map.
  Error_code fail(const std::string& message);

  std::size_t number_of_pins() const { return m_wanted.size(); }
  Error_code set_pin(Vertex_index v, const Complex& value);
  Error_code release_pin(Vertex_index v);

  // Precondition of both: it is not broken.
  Error_code set_points(Points points);
  void set_face_weights(std::vector<double> weights)
  {
    m_solver->set_face_weights(std::move(weights));
  }

  Error_code solve();
  Complex uv(Vertex_index v) const { return m_solver->map()[v] + m_shift; }
  Level_view preview(std::size_t vertices);

private:
  Error_code finish();
  bool choose_pins();

  HLSCM_options m_options;
  HLSCM_report m_report;
  Blocked_execution::Stopwatch m_watch;
  Chart m_chart;
  std::map<std::uint32_t, Complex> m_wanted; // the pins of the user
  std::vector<Pin> m_far_pins, m_pins;       // those of the spectral map; of the solver
  Complex m_shift = 0.;                      // from the map of the solver
  std::unique_ptr<Live_conformal_solver<CoarsestSolver>> m_solver;
  bool m_is_broken = false;
  std::vector<std::uint32_t> m_preview_vertices;
  std::vector<Complex> m_preview_uv;
};

template <class CoarsestSolver>
Live_map<CoarsestSolver>::Live_map(const HLSCM_options& options)
  : m_options(options)
{
  check_options(options, m_chart);
  if(options.method != Conformal_method::HLSCM && options.method != Conformal_method::SPECTRAL)
    m_chart.fail(ERROR_WRONG_PARAMETER, "the method must be hlscm or spectral");
}

template <class CoarsestSolver>
void Live_map<CoarsestSolver>::set_chart(Chart chart)
{
  m_chart = std::move(chart);
  if(m_chart.error != OK)
    return;
  m_report.vertices = m_chart.mesh.points.size();
  m_report.faces = m_chart.mesh.triangles.size();
  m_report.borders = m_chart.borders.size();
  m_far_pins = far_border_pins(m_chart);
}

template <class CoarsestSolver>
void Live_map<CoarsestSolver>::build(bool has_pins)
{
  if(m_chart.error == OK) {
    if(!has_pins && m_options.method == Conformal_method::HLSCM)
      for(const Pin& pin : m_far_pins)
        m_wanted[pin.vertex] = pin.value;
    m_pins = m_far_pins;
    for(const auto& [v, value] : m_wanted)
      if(v != m_far_pins[0].vertex && v != m_far_pins[1].vertex)
        m_pins.push_back({v, value});
    m_report.seconds_hierarchy = m_watch.lap();
    m_solver = std::make_unique<Live_conformal_solver<CoarsestSolver>>(m_chart, m_pins, m_options,
                                                                       m_report);
  }
  m_is_broken = m_chart.error != OK || m_report.cancelled;
  finish();
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::finish()
{
  m_report.seconds_total
    = m_report.seconds_hierarchy + m_report.seconds_operators + m_report.seconds_solve;
  if(m_report.cancelled)
    m_chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "cancelled");
  m_report.message = m_chart.message;
  return m_chart.error;
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::fail(const std::string& message)
{
  if(!m_is_broken)
    m_chart.error = OK;
  m_chart.fail(ERROR_WRONG_PARAMETER, message);
  return finish();
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::set_pin(Vertex_index v, const Complex& value)
{
  if(v == Indexed_mesh::no_vertex)
    return fail("a vertex that does not belong to the chart cannot be pinned");
  if(!std::isfinite(value.real()) || !std::isfinite(value.imag()))
    return fail("a pin has a coordinate that is not a finite number");
  m_wanted[v] = value;
  return OK;
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::release_pin(Vertex_index v)
{
  if(m_wanted.erase(v) == 0)
    return fail("a vertex that is not pinned cannot be released");
  return OK;
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::set_points(Points points)
{
  Chart::Mesh moved;
  moved.triangles = triangles();
  moved.points = std::move(points);
  const double scale = Indexed_mesh::normalize(moved);
  if(!(scale > 0.))
    return fail("all vertices lie in one point; the old positions stay");
  m_chart.scale = scale;
  m_solver->set_points(moved.points);
  return OK;
}

// The pins of the solver and its method; false if something is wrong with the user's.
template <class CoarsestSolver>
bool Live_map<CoarsestSolver>::choose_pins()
{
  if(m_is_broken)
    return false;
  m_chart.error = OK;
  m_chart.message.clear();
  std::vector<Pin> pins;
  for(const auto& [v, value] : m_wanted)
    pins.push_back({v, value});
  const bool is_spectral = pins.size() < 2;
  if(is_spectral)
    pins = m_far_pins;
  check_pins(m_chart, pins);
  if(m_chart.error != OK)
    return false;
  m_pins = std::move(pins);
  m_options.method = is_spectral ? Conformal_method::SPECTRAL : Conformal_method::HLSCM;
  m_report.method = name_of(m_options.method);
  m_report.pins.clear();
  for(const auto& [v, value] : m_wanted)
    m_report.pins.push_back({m_chart.source[v], value.real(), value.imag()});
  return true;
}

template <class CoarsestSolver>
Error_code Live_map<CoarsestSolver>::solve()
{
  if(!choose_pins())
    return finish();
  if(has_map()) // the times of the hierarchy were told with the first map
    m_report.seconds_hierarchy = m_report.seconds_operators = m_report.seconds_solve = 0.;
  m_solver->solve();
  m_shift = 0.;
  if(has_map() && m_wanted.size() == 1)
    m_shift = m_wanted.begin()->second - m_solver->map()[m_wanted.begin()->first];
  return finish();
}

template <class CoarsestSolver>
Level_view Live_map<CoarsestSolver>::preview(std::size_t vertices)
{
  if(!choose_pins()) {
    finish();
    return {0, 0, nullptr, nullptr, nullptr};
  }
  const std::size_t l = m_solver->preview_level(vertices);
  m_preview_uv = m_solver->preview(l);
  for(Complex& z : m_preview_uv)
    z += m_shift;
  m_preview_vertices.clear();
  for(const auto v : m_solver->level(l).vertices)
    m_preview_vertices.push_back(m_chart.source[v]);
  return {l, m_report.levels.size(), &m_preview_vertices, &m_solver->level(l).mesh.triangles,
          &m_preview_uv};
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H
