// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Chart_solving.h"

#include "reading/Diagnosis.h"
#include "common/Blas_memory.h"
#include "common/Interruption.h"
#include "reading/Mesh_reading.h"
#include "common/Program_error.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

std::vector<std::pair<Mesh::Vertex_index, Kernel::Point_2>>
checked_pins(const Program_options& options, const Mesh& mesh)
{
  std::vector<std::pair<Mesh::Vertex_index, Kernel::Point_2>> pins;
  for(const Pin& pin : options.pins) {
    if(pin.vertex >= mesh.number_of_vertices()) {
      throw Program_error(options.input, "pin " + std::to_string(pin.vertex)
                                             + " is out of range, the "
                                               "mesh has "
                                             + std::to_string(mesh.number_of_vertices())
                                             + " vertices counted from 0: choose another vertex");
    }
    for(const auto& other : pins) {
      if(std::size_t(other.first) == pin.vertex) {
        throw Program_error(options.input,
                            "vertex " + std::to_string(pin.vertex)
                                + " is pinned twice, give each vertex at most one pin");
      }
    }
    pins.emplace_back(Mesh::Vertex_index(Mesh::size_type(pin.vertex)),
                      Kernel::Point_2(pin.u, pin.v));
  }
  if(!pins.empty() && std::all_of(pins.begin(), pins.end(), [&](const auto& pin) {
       return pin.second == pins[0].second;
     }))
  {
    throw Program_error(options.input,
                        "all pins have the same place, which maps the whole surface to a "
                        "point: choose two places or more");
  }
  return pins;
}

using Parameterizer =
    SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default,
                               CGAL::Parallel_if_available_tag>;

// Charts for which multigrid is made take at most some 40 iterations.
constexpr std::size_t patience = 200;

// Whether the direct method may take the place of the default one. So many faces cost it two seconds
// and 300 MB.
bool may_fall_back(const Program_options& options, const Mesh& mesh)
{
  constexpr std::size_t most_faces = 300000;
  const SMP::HLSCM_options& o = options.library;
  return !options.is_method_given && o.method == SMP::Conformal_method::HLSCM
         && o.maximal_iterations == 0 && o.time_limit == 0 && mesh.number_of_faces() <= most_faces;
}

// A halfedge of the longest border; of any border if lengths are too small for CGAL to add them.
Mesh::Halfedge_index border_of(const Mesh& mesh)
{
  const auto longest = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  if(longest != Mesh::null_halfedge()) {
    return longest;
  }
  const auto all = mesh.halfedges();
  const auto found
      = std::find_if(all.begin(), all.end(), [&](auto h) { return mesh.is_border(h); });
  return found == all.end() ? Mesh::null_halfedge() : *found;
}

// Whether an iteration ended since no energy was left but what rounding makes, which on long strips
// says little of lengths.
bool is_vague(const SMP::HLSCM_report& report, const SMP::HLSCM_options& options)
{
  constexpr std::size_t long_iteration = 50; // the least with such an end
  return report.converged && report.iterations >= long_iteration && options.uv_tolerance == 0
         && !(report.energy_gap_estimate <= options.tolerance * std::abs(report.energy));
}

std::string not_converged(std::size_t iterations)
{
  return "the tolerance was not met after " + std::to_string(iterations)
         + " iterations, take --method direct, which makes none";
}

} // namespace

Mesh read_chart(const std::string& input, Progress_bar& progress,
                std::vector<std::string>& warnings)
{
  const Read_mesh read = read_mesh(input, progress);
  warnings = read.warnings;
  refuse_obstacles(input, obstacles(diagnose(read.soup, progress)));
  return build_mesh(read.soup);
}

Solved_chart solve_chart(const Program_options& options, SMP::HLSCM_options library,
                         const Mesh& mesh, Uv_map uv, Progress_bar& progress)
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
  const bool falls_back = may_fall_back(options, mesh);
  if(falls_back) {
    library.maximal_iterations = patience;
  }
  const auto pins = checked_pins(options, mesh);
  Parameterizer parameterizer(library);
  parameterizer.set_pins(pins);
  if(library.method == SMP::Conformal_method::DIRECT) {
    reserve_blas_memory(1);
  }
  progress.start_stage("solving");
  const auto border = border_of(mesh);
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uv);
  Interruption::check();
  const SMP::HLSCM_report& report = parameterizer.report();
  const bool gave_up = error != SMP::OK && report.iterations > 0 && !report.converged;
  if(falls_back && (gave_up || is_vague(report, library))) {
    library.method = SMP::Conformal_method::DIRECT;
    library.level_observer = nullptr; // the coarse levels were shown
    Parameterizer direct(library);
    direct.set_pins(pins);
    reserve_blas_memory(1);
    if(direct.parameterize(mesh, border, uv) == SMP::OK) {
      Solved_chart result = {direct.report(), {}};
      result.report.warnings.push_back("the default method found no exact map in "
                                       + std::to_string(report.iterations)
                                       + " iterations, this is that of --method direct");
      return result;
    }
    Interruption::check();
  }
  if(error != SMP::OK) {
    throw Program_error(options.input,
                        gave_up ? not_converged(report.iterations) : report.message);
  }
  return {report, parameterizer.progressive_mesh()};
}

Similarity fit_to_unit_square(const Mesh& mesh, Uv_map uv, SMP::HLSCM_report& report)
{
  CGAL::Bbox_2 box;
  for(const auto v : mesh.vertices()) {
    box += uv[v].bbox();
  }
  const double size = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  Similarity to_square;
  to_square.scale = size > 0 ? 1 / size : 1;
  to_square.shift = {-to_square.scale * box.xmin(), -to_square.scale * box.ymin()};
  const auto into_square = [&to_square](double u, double v) {
    const Vector_2 p = to_square(u, v);
    return Vector_2{std::clamp(p[0], 0., 1.), std::clamp(p[1], 0., 1.)}; // from rounding errors
  };
  for(const auto v : mesh.vertices()) {
    const Vector_2 p = into_square(uv[v].x(), uv[v].y());
    uv[v] = Kernel::Point_2(p[0], p[1]);
  }
  for(SMP::HLSCM_pin& pin : report.pins) {
    const Vector_2 p = into_square(pin.u, pin.v);
    pin.u = p[0];
    pin.v = p[1];
  }
  const double area_scale = to_square.scale * to_square.scale;
  if(std::isfinite(report.energy)) {
    report.energy *= area_scale;
    report.energy_gap_estimate *= area_scale;
  } else { // in the unit of the mesh it was too large for a number
    report.energy = SMP::measure_distortion(mesh, uv).conformal_energy;
    report.energy_gap_estimate = std::numeric_limits<double>::infinity();
  }
  if(report.flip_repair) {
    report.flip_repair->energy_before *= area_scale;
    report.flip_repair->energy_after *= area_scale;
  }
  return to_square;
}

} // namespace hlscm
