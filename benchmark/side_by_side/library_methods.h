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
  const double seconds = stopwatch.seconds(), peak_memory = peak_memory_mb();
  const SMP::HLSCM_report& report = parameterizer.report();
  Measurement measurement;
  measurement.numbers = {{"seconds_total", seconds},
                         {"peak_memory_mb", peak_memory},
                         {"seconds_hierarchy", report.seconds_hierarchy},
                         {"seconds_operators", report.seconds_operators},
                         {"seconds_solve", report.seconds_solve},
                         {"iterations", double(report.iterations)},
                         {"levels", double(report.levels.size())},
                         {"converged", double(report.converged)}};
  if(options.method == SMP::Conformal_method::HLSCM
     || options.method == SMP::Conformal_method::SPECTRAL
     || options.method == SMP::Conformal_method::LSCM)
    measurement.numbers["tolerance"] = options.tolerance;
  if(code != SMP::OK) // also if the iterations are used up: then no map is handed over
    measurement.status = report.message;
  else
    measurement.numbers["energy_gap_estimate"] = report.energy_gap_estimate / report.energy;
  return measurement;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H
