// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Chart_solving.h"

#include "common/Blas.h"
#include "common/Interruption.h"
#include "common/Program_error.h"

#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

std::vector<SMP::HLSCM_pin> checked_pins(const Program_options& options,
                                         std::size_t number_of_vertices)
{
  std::vector<SMP::HLSCM_pin> pins;
  std::vector<bool> is_pinned(options.pins.empty() ? 0 : number_of_vertices, false);
  for(const Pin& pin : options.pins) {
    if(pin.vertex >= number_of_vertices) {
      throw Program_error(options.input, "pin " + std::to_string(pin.vertex)
                                             + " is out of range, the "
                                               "mesh has "
                                             + std::to_string(number_of_vertices)
                                             + " vertices counted from 0: choose another vertex");
    }
    if(is_pinned[pin.vertex]) {
      throw Program_error(options.input,
                          "vertex " + std::to_string(pin.vertex)
                              + " is pinned twice, give each vertex at most one pin");
    }
    is_pinned[pin.vertex] = true;
    pins.push_back({pin.vertex, pin.u, pin.v});
  }
  if(!pins.empty() && std::all_of(pins.begin(), pins.end(), [&](const SMP::HLSCM_pin& pin) {
       return pin.u == pins[0].u && pin.v == pins[0].v;
     }))
  {
    throw Program_error(options.input,
                        "all pins have the same place, which maps the whole surface to a "
                        "point: choose two places or more");
  }
  return pins;
}

namespace {

using CGAL::Indexed_mesh::Indexed_triangle_mesh;
using Pins = std::vector<SMP::HLSCM_pin>;

// Charts for which multigrid is made take at most some 40 iterations.
constexpr std::size_t patience = 200;

// Whether the direct method may take the place of the one that the program chose. So many faces
// cost it two seconds and 300 MB.
bool may_fall_back(const Program_options& options, const SMP::HLSCM_options& library,
                   const Indexed_triangle_mesh& mesh)
{
  constexpr std::size_t most_faces = 300000;
  const bool is_chosen = library.method == SMP::Conformal_method::HLSCM
                      || library.method == SMP::Conformal_method::SPECTRAL;
  return is_chosen && !options.is_method_given && library.maximal_iterations == 0
      && library.time_limit == 0 && mesh.triangles.size() <= most_faces;
}

SMP::Conformal_map map_of(Indexed_triangle_mesh mesh, const Pins& pins, const SMP::HLSCM_options& options)
{
  return pins.empty() ? SMP::conformal_map(std::move(mesh), options)
                      : SMP::conformal_map(std::move(mesh), pins, options);
}

// Whether an iteration ended since no energy was left but what rounding makes, which on long strips
// says little of lengths.
bool is_vague(const SMP::HLSCM_report& report, const SMP::HLSCM_options& options)
{
  constexpr std::size_t long_iteration = 50; // the least with such an end
  return report.converged && report.iterations >= long_iteration && options.uv_tolerance == 0
      && !(report.energy_gap_estimate <= options.tolerance * std::abs(report.energy));
}

// Also where rounding errors lead out of it.
double into_square(double x) { return std::clamp(x, 0., 1.); }

std::string not_converged(std::size_t iterations)
{
  return "the tolerance was not met after " + std::to_string(iterations)
       + " iterations, take --method direct, which makes none";
}

// The map of the direct method, and why; nothing if it has none either.
std::optional<SMP::Conformal_map> solve_directly(SMP::HLSCM_options library,
                                                 Indexed_triangle_mesh mesh,
                                                 const Pins& pins, std::size_t iterations)
{
  reserve_blas_memory(1);
  library.method = SMP::Conformal_method::DIRECT;
  library.level_observer = nullptr; // the coarse levels were shown
  SMP::Conformal_map result = map_of(std::move(mesh), pins, library);
  Interruption::check();
  if(!result.is_ok()) {
    return std::nullopt;
  }
  result.report.warnings.push_back("multigrid found no exact map in " + std::to_string(iterations)
                                   + " iterations, this is that of --method direct");
  return result;
}

} // namespace

SMP::Conformal_map solve_chart(const Program_options& options, SMP::HLSCM_options library,
                               Indexed_triangle_mesh mesh, const Pins& pins,
                               Progress_bar& progress)
{
  if(options.repairs_flips) {
    library.repair_flips = SMP::Flip_repairer();
  }
  if(options.engine == Engine::FLAT_STRICT) {
    library.engine = SMP::Decimation_engine::FLAT_STRICT;
  } else if(options.engine == Engine::CGAL) {
    library.decimate = SMP::Edge_collapse_decimation();
  }
  library.progress = [&progress](double fraction) { return progress.try_advance(fraction); };
  const bool falls_back = may_fall_back(options, library, mesh);
  if(falls_back) {
    library.maximal_iterations = patience;
  }
  if(library.method == SMP::Conformal_method::DIRECT) {
    reserve_blas_memory(1);
  }
  progress.start_stage("solving");
  SMP::Conformal_map map
      = map_of(falls_back ? Indexed_triangle_mesh(mesh) : std::move(mesh), pins, library);
  Interruption::check();
  const SMP::HLSCM_report& report = map.report;
  const bool gave_up = !map.is_ok() && report.iterations > 0 && !report.converged;
  if(falls_back && (gave_up || is_vague(report, library))) {
    auto direct = solve_directly(library, std::move(mesh), pins, report.iterations);
    if(direct) {
      return std::move(*direct);
    }
  }
  if(!map.is_ok()) {
    throw Program_error(options.input,
                        gave_up ? not_converged(report.iterations) : report.message);
  }
  return map;
}

Similarity fit_to_unit_square(std::vector<Kernel::Point_2>& uv)
{
  CGAL::Bbox_2 box;
  for(const Kernel::Point_2& p : uv) {
    box += p.bbox();
  }
  const double size = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  Similarity to_square;
  to_square.scale = size > 0 ? 1 / size : 1;
  to_square.shift = {-to_square.scale * box.xmin(), -to_square.scale * box.ymin()};
  for(Kernel::Point_2& point : uv) {
    const Vector_2 p = to_square(point.x(), point.y());
    point = Kernel::Point_2(into_square(p[0]), into_square(p[1]));
  }
  return to_square;
}

void move_report(const Similarity& similarity, SMP::HLSCM_report& report)
{
  SMP::move_report(report, similarity.scale, similarity.shift[0], similarity.shift[1]);
  for(SMP::HLSCM_pin& pin : report.pins) {
    pin.u = into_square(pin.u);
    pin.v = into_square(pin.v);
  }
}

} // namespace hlscm
