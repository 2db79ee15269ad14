// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Low_stretch.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <limits>
#include <utility>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

SMP::Low_stretch_map map_with(Stretch energy, const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh,
                              const SMP::Low_stretch_options& options)
{
  switch(energy) {
  case Stretch::MIPS: return SMP::low_stretch_map(mesh, options, SMP::Mips_energy());
  case Stretch::ARAP: // with a barrier: files are no place for triangles of nearly no area
    return SMP::low_stretch_map(mesh, options, SMP::Barrier_energy<SMP::Arap_energy>{{}, 1e-3});
  case Stretch::AREA: return SMP::low_stretch_map(mesh, options, SMP::Area_weighted_mips_energy());
  case Stretch::SYMMETRIC_DIRICHLET: break;
  }
  return SMP::low_stretch_map(mesh, options, SMP::Symmetric_dirichlet_energy());
}

} // namespace

SMP::Conformal_map
map_with_low_stretch(const Program_options& options,
                     const CGAL::Indexed_mesh::Indexed_triangle_mesh& component,
                     const std::vector<SMP::HLSCM_pin>& pins,
                     std::vector<CGAL::Indexed_mesh::Space_tensor> metric,
                     SMP::Low_stretch_report& stretch, Progress_bar& progress)
{
  SMP::Low_stretch_options library;
  library.pins = pins;
  library.metric = std::move(metric);
  if(options.is_tolerance_given) {
    library.tolerance = options.library.tolerance;
  }
  if(options.library.maximal_iterations > 0) {
    library.maximal_iterations = options.library.maximal_iterations;
  }
  library.time_limit = options.library.time_limit;
  library.progress = [&progress](double fraction) { return progress.try_advance(fraction); };
  progress.start_stage("solving");
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
  SMP::Low_stretch_map map = map_with(options.stretch, component, library);
  Interruption::check();
  if(!map.is_ok()) {
    throw Program_error(options.input, map.error);
  }
  stretch = map.report;
  SMP::Conformal_map result;
  result.uv = std::move(map.uv);
  SMP::HLSCM_report& report = result.report;
  report.pins = pins;
  report.method = "low-stretch";
  report.converged = stretch.converged;
  report.stopped_early = stretch.is_cut_short;
  report.vertices = component.points.size();
  report.faces = component.triangles.size();
  report.borders = stretch.borders;
  report.levels.resize(stretch.levels.size());
  for(std::size_t l = 0; l < stretch.levels.size(); ++l) {
    report.levels[l].vertices = stretch.levels[l].vertices;
    report.levels[l].faces = stretch.levels[l].faces;
    report.levels[l].iterations = stretch.levels[l].iterations;
  }
  report.iterations = stretch.iterations;
  report.energy = std::numeric_limits<double>::infinity(); // the conformal one is not known
  report.energy_gap_estimate = std::numeric_limits<double>::infinity();
  report.seconds_hierarchy = stretch.seconds_decimation;
  report.seconds_solve = stretch.seconds - stretch.seconds_decimation;
  report.seconds_total = stretch.seconds;
  return result;
}

} // namespace hlscm
