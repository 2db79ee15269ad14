// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Chart_solving.h"

#include "reading/Diagnosis.h"
#include "common/Interruption.h"
#include "reading/Mesh_reading.h"
#include "common/Program_error.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <algorithm>
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
  SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default, CGAL::Parallel_if_available_tag>
      parameterizer(library);
  parameterizer.set_pins(checked_pins(options, mesh));

  progress.start_stage("solving");
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uv);
  Interruption::check();
  if(error != SMP::OK) {
    throw Program_error(options.input, parameterizer.report().message);
  }
  return {parameterizer.report(), parameterizer.progressive_mesh()};
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
  report.energy *= area_scale;
  report.energy_gap_estimate *= area_scale;
  if(report.flip_repair) {
    report.flip_repair->energy_before *= area_scale;
    report.flip_repair->energy_after *= area_scale;
  }
  return to_square;
}

} // namespace hlscm
