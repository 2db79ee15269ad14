// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_MAP_CHART_CONFORMALLY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_MAP_CHART_CONFORMALLY_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Run_control.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/solver/methods.h>
#endif

#include <complex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What became of a chart.
struct Chart_map
{
  std::vector<std::complex<double>> z;  // of the chart's vertices; empty if there is no map
  std::vector<std::uint32_t> source;    // for each of them its position in the input
  Pins pins;                            // by which it was found; none if it is free
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh; // if the options keep it
};

// The collapses that were kept, taken from the map; none if the method has no hierarchy.
inline Chart_progressive_mesh take_collapses(Chart_map& map)
{
  if(map.progressive_mesh.triangles.empty())
    return {};
  return {std::move(map.progressive_mesh), std::move(map.source)};
}

// Maps a chart of an input with so many vertices; the report and the status of `run` say what came
// of it. Knows no mesh but arrays: whatever maps a chart, comes by here.
CGAL_HLSCM_INLINE Chart_map
map_chart_conformally(Prepared_chart prepared, std::size_t number_of_input_vertices,
                      const Wanted_pins& wanted, Coarsest_solver coarsest, Run_control& run);

#ifdef CGAL_HLSCM_DEFINITIONS

// Reports the chart; its pins, or those with which a free map begins.
inline Pins begin_chart(const Chart& chart, std::size_t number_of_input_vertices,
                        const Wanted_pins& wanted, Run_control& run)
{
  HLSCM_report& report = run.report();
  report.vertices = chart.mesh.points.size();
  report.faces = chart.mesh.triangles.size();
  report.borders = chart.borders.size();
  if(!profile_of(run.options().method).has_pins) {
    if(wanted)
      report.warnings.push_back("the method has no pins; those that were set are not used");
    return far_border_pins(chart);
  }
  const Pins pins
    = wanted ? pins_of_chart(chart, number_of_input_vertices, *wanted, run.status())
             : far_border_pins(chart);
  check_pins(chart.source, pins, run.status());
  if(run.status().is_ok())
    warn_of_pins(chart, pins, report.warnings);
  report.pins = reported_pins(chart.source, pins);
  return pins;
}

CGAL_HLSCM_INLINE Chart_map
map_chart_conformally(Prepared_chart prepared, std::size_t number_of_input_vertices,
                      const Wanted_pins& wanted, Coarsest_solver coarsest, Run_control& run)
{
  const HLSCM_options& options = run.options();
  Chart_map result;
  run.status().fail(prepared.status.error, prepared.status.message);
  if(run.is_stopped())
    return result;
  const Pins pins = begin_chart(prepared.chart, number_of_input_vertices, wanted, run);
  run.lap(run.report().seconds_hierarchy);
  if(run.is_stopped())
    return result;
  Conformal_system system(std::move(prepared.chart), pins, parts_for(options),
                          std::move(coarsest), run);
  Cycle_iteration iteration(options);
  if(!run.is_stopped())
    result.z = find_map(options.method, system, run, iteration);
  if(run.is_stopped())
    result.z.clear();
  result.source = std::move(system.source);
  result.progressive_mesh = std::move(system.progressive_mesh);
  if(!system.is_free)
    result.pins = pins;
  return result;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_MAP_CHART_CONFORMALLY_H
