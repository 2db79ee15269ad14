// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H

#include "Measurement.h"
#include "Stopwatch.h"
#include "child_process.h"
#include "pins.h"

#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

namespace side_by_side {

namespace SMP = CGAL::Surface_mesh_parameterization;

// Runs HLSCM_parameterizer_3 with the given options and fills `uvmap`.
inline Measurement run_library(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap,
                               const SMP::HLSCM_options& options)
{
  auto is_parameterized = mesh.add_property_map<Vertex, bool>("v:is_parameterized", false).first;
  const Halfedge border = border_halfedge(mesh);
  const Stopwatch stopwatch;
  SMP::HLSCM_parameterizer_3<Surface_mesh> parameterizer(options);
  parameterizer.set_pins({pins.begin(), pins.end()});
  const SMP::Error_code code = parameterizer.parameterize(
      mesh, border, uvmap, get(boost::vertex_index, mesh), is_parameterized);
  Measurement measurement;
  const SMP::HLSCM_report& report = parameterizer.report();
  measurement.numbers = {{"seconds_total", stopwatch.seconds()},
                         {"peak_memory_mb", peak_memory_mb()},
                         {"seconds_hierarchy", report.seconds_hierarchy},
                         {"seconds_operators", report.seconds_operators},
                         {"seconds_solve", report.seconds_solve},
                         {"iterations", double(report.iterations)},
                         {"levels", double(report.levels.size())},
                         {"converged", double(report.converged)},
                         {"energy_gap_estimate", report.energy_gap_estimate / report.energy}};
  if(!report.levels.empty())
    measurement.numbers["coarsest_vertices"] = double(report.levels.front().vertices);
  if(code != SMP::OK && report.converged) // running out of iterations is a result, not a failure
    measurement.status = report.message;
  return measurement;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H
