// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_REPAIR_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_REPAIR_CHART_H

#include <CGAL/Surface_mesh_parameterization/internal/repair/mapped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Run_control.h>

#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Takes what the repair changed over into the report of the map.
inline void report_repair(Flip_repair_report repair, HLSCM_report& report)
{
  const double rise = repair.energy_after - repair.energy_before;
  repair.energy_before = report.energy;
  report.energy += rise;
  report.energy_gap_estimate += rise;
  repair.energy_after = report.energy;
  if(!repair.unmended_faces.empty())
    report.warnings.push_back(std::to_string(repair.unmended_faces.size())
                              + (repair.stopped_early ? " flipped faces are left: there was no time"
                                                      : " flipped faces could not be repaired"));
  report.flip_repair = std::move(repair);
}

// Repairs the map `z` of a chart of `mesh`, given by the place of each vertex of the mesh in it or
// `no_vertex`, by the function of the options, and takes what changes over into the report.
template <class TriangleMesh>
void repair_chart(const TriangleMesh& mesh, const std::vector<std::uint32_t>& places,
                  const Pins& pins, Run_control& run, std::vector<std::complex<double>>& z)
{
  const auto place = get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh);
  std::size_t position = 0;
  for(const auto v : vertices(mesh))
    put(place, v, places[position++]);
  std::vector<bool> is_pinned(z.size(), false);
  for(const Pin& pin : pins)
    is_pinned[pin.vertex] = true;
  const Mapped_faces<TriangleMesh> mapped(mesh, place);
  Map_to_repair map
    = {mapped.triangles, is_pinned, shapes_of_faces(mesh, mapped, run.options().weights), z};
  const Blocked_execution::Stopwatch watch;
  Flip_repair_report repair = run.options().repair_flips(
    map, [&run](double part) { return run.tell_repair(part) && !run.is_enough(); });
  for(std::size_t& face : repair.unmended_faces)
    face = mapped.positions[face];
  repair.seconds = watch.seconds();
  run.tell_repair(1.);
  report_repair(std::move(repair), run.report());
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_REPAIR_CHART_H
