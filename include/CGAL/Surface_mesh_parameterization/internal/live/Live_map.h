// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Run_control.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/live/Live_conformal_solver.h>
#endif

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

class Live_conformal_solver;

// The map that a `Hierarchical_conformal_map` keeps: its chart, the pins of the user and the
// solver. Vertices are those of the chart.
class Live_map
{
public:
  typedef std::complex<double> Complex;
  typedef Indexed_mesh::Vertex_index Vertex_index;
  typedef std::vector<Chart::Mesh::Point_3> Points;

  // Checks the options. To be set then, if there is no error, are the chart and its pins; after
  // that the solver is to be built.
  Live_map(const HLSCM_options& options, Coarsest_solver coarsest);
  ~Live_map();
  Live_map(const Live_map&) = delete;
  Live_map& operator=(const Live_map&) = delete;

  void set_chart(Prepared_chart prepared);

  // Builds the solver, which has the pins of now on all levels. Without pins of the user they are
  // the two far ones, if the method has pins.
  void build(bool has_pins);

  // For each vertex of the chart its position in the mesh.
  const std::vector<std::uint32_t>& source() const;
  Error_code error() const { return m_run.status().error; }
  const HLSCM_report& report() const { return m_report; }

  // There will never be a map.
  bool is_broken() const { return m_is_broken; }
  bool has_map() const;

  // Those of the chart. Precondition: it is not broken.
  const std::vector<Indexed_mesh::Triangle_indices>& triangles() const;

  // Records an error, unless there is one already without which there would be no map.
  Error_code fail(const std::string& message);

  std::size_t number_of_pins() const { return m_wanted.size(); }
  Error_code set_pin(Vertex_index v, const Complex& value);
  Error_code release_pin(Vertex_index v);

  // Precondition of both: it is not broken.
  Error_code set_points(Points points);
  void set_face_weights(std::vector<double> weights);

  Error_code solve();
  Complex uv(Vertex_index v) const;
  Level_view preview(std::size_t vertices);

private:
  bool choose_pins();

  const HLSCM_options m_options;
  HLSCM_report m_report;
  Run_control m_run;
  Coarsest_solver m_coarsest;                // for the solver to be built
  Chart m_chart;                             // the same
  std::map<std::uint32_t, Complex> m_wanted; // the pins of the user
  Pins m_far_pins;                           // those of the spectral map
  Complex m_shift = 0.;                      // from the map of the solver
  std::unique_ptr<Live_conformal_solver> m_solver;
  bool m_is_broken = false;
  std::vector<std::uint32_t> m_preview_vertices;
  std::vector<Complex> m_preview_uv;
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE Live_map::Live_map(const HLSCM_options& options, Coarsest_solver coarsest)
  : m_options(options), m_run(m_options, m_report), m_coarsest(std::move(coarsest))
{
  if(options.method != Conformal_method::HLSCM && options.method != Conformal_method::SPECTRAL)
    m_run.status().fail(ERROR_WRONG_PARAMETER, "the method must be hlscm or spectral");
}

CGAL_HLSCM_INLINE void Live_map::set_chart(Prepared_chart prepared)
{
  m_chart = std::move(prepared.chart);
  m_run.status().fail(prepared.status.error, prepared.status.message);
  if(error() != OK)
    return;
  m_report.vertices = m_chart.mesh.points.size();
  m_report.faces = m_chart.mesh.triangles.size();
  m_report.borders = m_chart.borders.size();
  m_far_pins = far_border_pins(m_chart);
}

CGAL_HLSCM_INLINE void Live_map::build(bool has_pins)
{
  if(error() == OK) {
    if(!has_pins && m_options.method == Conformal_method::HLSCM)
      for(const Pin& pin : m_far_pins)
        m_wanted[pin.vertex] = pin.value;
    Pins pins = m_far_pins;
    for(const auto& [v, value] : m_wanted)
      if(v != m_far_pins[0].vertex && v != m_far_pins[1].vertex)
        pins.push_back({v, value});
    m_run.lap(m_report.seconds_hierarchy);
    m_solver = std::make_unique<Live_conformal_solver>(std::move(m_chart), pins,
                                                       std::move(m_coarsest), m_run);
  }
  m_is_broken = error() != OK || m_report.cancelled;
  m_run.finish();
}

CGAL_HLSCM_INLINE Error_code Live_map::fail(const std::string& message)
{
  if(!m_is_broken)
    m_run.status() = Status();
  m_run.status().fail(ERROR_WRONG_PARAMETER, message);
  return m_run.finish();
}

CGAL_HLSCM_INLINE Error_code Live_map::set_pin(Vertex_index v, const Complex& value)
{
  if(v == Indexed_mesh::no_vertex)
    return fail("a vertex that does not belong to the chart cannot be pinned");
  if(!std::isfinite(value.real()) || !std::isfinite(value.imag()))
    return fail(Indexed_mesh::not_finite_error("a pin"));
  m_wanted[v] = value;
  return OK;
}

CGAL_HLSCM_INLINE Error_code Live_map::release_pin(Vertex_index v)
{
  if(m_wanted.erase(v) == 0)
    return fail("a vertex that is not pinned cannot be released");
  return OK;
}

CGAL_HLSCM_INLINE Error_code Live_map::set_points(Points points)
{
  Chart::Mesh moved;
  moved.triangles = triangles();
  moved.points = std::move(points);
  const double scale = Indexed_mesh::normalize(moved);
  if(!(scale > 0.))
    return fail(std::string(Indexed_mesh::no_extent_error) + "; the old positions stay");
  m_solver->set_points(moved.points, scale);
  return OK;
}

// Gives the solver the pins of now, or none; false if something is wrong with the user's.
CGAL_HLSCM_INLINE bool Live_map::choose_pins()
{
  if(m_is_broken)
    return false;
  m_run.status() = Status();
  Pins pins;
  for(const auto& [v, value] : m_wanted)
    pins.push_back({v, value});
  const bool is_free = pins.size() < 2;
  check_pins(source(), is_free ? m_far_pins : pins, m_run.status());
  if(error() != OK)
    return false;
  m_report.pins = reported_pins(source(), pins);
  m_report.method
    = profile_of(is_free ? Conformal_method::SPECTRAL : Conformal_method::HLSCM).name;
  m_solver->set_pins(is_free ? m_far_pins : std::move(pins), is_free);
  return true;
}

CGAL_HLSCM_INLINE Error_code Live_map::solve()
{
  if(!choose_pins())
    return m_run.finish();
  if(has_map()) // the times of the hierarchy were told with the first map
    m_report.seconds_hierarchy = m_report.seconds_operators = m_report.seconds_solve = 0.;
  m_solver->solve();
  m_shift = 0.;
  if(has_map() && m_wanted.size() == 1)
    m_shift = m_wanted.begin()->second - m_solver->map()[m_wanted.begin()->first];
  return m_run.finish();
}

CGAL_HLSCM_INLINE Level_view Live_map::preview(std::size_t vertices)
{
  if(!choose_pins()) {
    m_run.finish();
    return {0, 0, nullptr, nullptr, nullptr};
  }
  const std::size_t l = m_solver->preview_level(vertices);
  m_preview_uv = m_solver->preview(l);
  for(Complex& z : m_preview_uv)
    z += m_shift;
  m_preview_vertices.clear();
  for(const auto v : m_solver->level(l).vertices)
    m_preview_vertices.push_back(source()[v]);
  return {l, m_report.levels.size(), &m_preview_vertices, &m_solver->level(l).mesh.triangles,
          &m_preview_uv};
}

CGAL_HLSCM_INLINE Live_map::~Live_map() {}

CGAL_HLSCM_INLINE const std::vector<std::uint32_t>& Live_map::source() const
{
  return m_solver ? m_solver->system().source : m_chart.source;
}

CGAL_HLSCM_INLINE bool Live_map::has_map() const { return m_solver && !m_solver->map().empty(); }

CGAL_HLSCM_INLINE const std::vector<Indexed_mesh::Triangle_indices>& Live_map::triangles() const
{
  return m_solver->level(m_solver->system().finest()).mesh.triangles;
}

CGAL_HLSCM_INLINE void Live_map::set_face_weights(std::vector<double> weights)
{
  m_solver->set_face_weights(std::move(weights));
}

CGAL_HLSCM_INLINE Live_map::Complex Live_map::uv(Vertex_index v) const
{
  return has_map() && v < m_solver->map().size() ? m_solver->map()[v] + m_shift : Complex(0.);
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LIVE_LIVE_MAP_H
