// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H

#include "../timing.h"
#include "Measurement.h"
#include "child_process.h"
#include "pins.h"

#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

namespace side_by_side {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace internal {

template <class ConcurrencyTag>
Measurement run_library_by(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap,
                           const SMP::HLSCM_options& options)
{
  typedef SMP::HLSCM_parameterizer_3<Surface_mesh, CGAL::Default, CGAL::Default, ConcurrencyTag>
      Parameterizer;
  auto is_parameterized = mesh.add_property_map<Vertex, bool>("v:is_parameterized", false).first;
  const Halfedge border = border_halfedge(mesh);
  const double system_before = system_seconds();
  const timing::Stopwatch stopwatch;
  Parameterizer parameterizer(options);
  parameterizer.set_pins({pins.begin(), pins.end()});
  const SMP::Error_code code = parameterizer.parameterize(
      mesh, border, uvmap, get(boost::vertex_index, mesh), is_parameterized);
  const double seconds = stopwatch.seconds(), peak_memory = peak_memory_mb();
  const SMP::HLSCM_report& report = parameterizer.report();
  const std::size_t number_of_coarse_vertices =
      report.levels.empty() ? 0 : report.levels.front().vertices;
  Measurement measurement;
  measurement.numbers = {{"seconds_total", seconds},
                         {"seconds_system", system_seconds() - system_before},
                         {"peak_memory_mb", peak_memory},
                         {"seconds_hierarchy", report.seconds_hierarchy},
                         {"seconds_operators", report.seconds_operators},
                         {"seconds_solve", report.seconds_solve},
                         {"iterations", double(report.iterations)},
                         {"levels", double(report.levels.size())},
                         {"coarse_vertices", double(number_of_coarse_vertices)},
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

} // namespace internal

// Runs HLSCM_parameterizer_3 with the given options, on one thread unless they say more, and fills
// `uvmap`.
inline Measurement run_library(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap,
                               const SMP::HLSCM_options& options)
{
  return options.threads > 1
             ? internal::run_library_by<CGAL::Parallel_if_available_tag>(mesh, pins, uvmap, options)
             : internal::run_library_by<CGAL::Sequential_tag>(mesh, pins, uvmap, options);
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_LIBRARY_METHODS_H
