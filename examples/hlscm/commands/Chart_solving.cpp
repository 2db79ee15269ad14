// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Chart_solving.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <algorithm>
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

Solved_chart solve_chart(const Program_options& options, SMP::HLSCM_options library,
                         const Mesh& mesh, const std::vector<SMP::HLSCM_pin>& pins, Uv_map uv,
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
  SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default, CGAL::Parallel_if_available_tag>
      parameterizer(library);
  std::vector<std::pair<Mesh::Vertex_index, Kernel::Point_2>> pinned;
  for(const SMP::HLSCM_pin& pin : pins) {
    pinned.emplace_back(Mesh::Vertex_index(Mesh::size_type(pin.vertex)),
                        Kernel::Point_2(pin.u, pin.v));
  }
  parameterizer.set_pins(pinned);

  progress.start_stage("solving");
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uv);
  Interruption::check();
  if(error != SMP::OK) {
    throw Program_error(options.input, parameterizer.report().message);
  }
  return {parameterizer.report(), parameterizer.progressive_mesh()};
}

namespace {

// Into the square also where rounding errors lead out of it.
Vector_2 into_square(const Similarity& to_square, double u, double v)
{
  const Vector_2 p = to_square(u, v);
  return {std::clamp(p[0], 0., 1.), std::clamp(p[1], 0., 1.)};
}

} // namespace

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
    const Vector_2 p = into_square(to_square, point.x(), point.y());
    point = Kernel::Point_2(p[0], p[1]);
  }
  return to_square;
}

void move_report(const Similarity& similarity, SMP::HLSCM_report& report)
{
  for(SMP::HLSCM_pin& pin : report.pins) {
    const Vector_2 p = into_square(similarity, pin.u, pin.v);
    pin.u = p[0];
    pin.v = p[1];
  }
  const double area_scale = similarity.scale * similarity.scale;
  report.energy *= area_scale;
  report.energy_gap_estimate *= area_scale;
  if(report.flip_repair) {
    report.flip_repair->energy_before *= area_scale;
    report.flip_repair->energy_after *= area_scale;
  }
}

} // namespace hlscm
