// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Low_stretch.h"

#include "common/Interruption.h"
#include "common/Kernel.h"
#include "common/Program_error.h"

#include <CGAL/Surface_mesh_parameterization/Polygonal_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>

#include <cmath>
#include <limits>
#include <utility>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

SMP::Low_stretch_map map_with(Stretch energy, CGAL::Indexed_mesh::Indexed_triangle_mesh mesh,
                              const SMP::Low_stretch_options& options)
{
  switch(energy) {
  case Stretch::MIPS: return SMP::low_stretch_map(std::move(mesh), options, SMP::Mips_energy());
  case Stretch::ARAP: // with a barrier: files are no place for triangles of nearly no area
    return SMP::low_stretch_map(std::move(mesh), options, SMP::Barrier_energy<SMP::Arap_energy>{{}, 1e-3});
  case Stretch::AREA: return SMP::low_stretch_map(std::move(mesh), options, SMP::Area_weighted_mips_energy());
  case Stretch::SYMMETRIC_DIRICHLET: break;
  }
  return SMP::low_stretch_map(std::move(mesh), options, SMP::Symmetric_dirichlet_energy());
}

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Where a border parameterizer puts the longest border, with the area of the surface.
template <typename Parameterizer>
std::vector<SMP::HLSCM_pin>
pins_by(Parameterizer parameterizer, const Program_options& options,
        const CGAL::Indexed_mesh::Indexed_triangle_mesh& component)
{
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(component.points, component.triangles, mesh);
  const auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto index = mesh.add_property_map<Mesh::Vertex_index, int>("v:index").first;
  const auto is_set = mesh.add_property_map<Mesh::Vertex_index, bool>("v:set").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uv, index, is_set);
  if(error == SMP::ERROR_WRONG_PARAMETER) {
    throw Program_error(options.border_polygon, "give three or more corners of a polygon, in their order "
                                                "around it, no side of which crosses another one");
  }
  if(error != SMP::OK) {
    throw Program_error(options.input, "the border is too short to be put there");
  }
  const Kernel::Point_2 origin = uv[mesh.target(border)];
  double twice_area = 0; // border halfedges have the surface on their right side
  for(const auto h : CGAL::halfedges_around_face(border, mesh)) {
    twice_area += CGAL::determinant(uv[mesh.target(h)] - origin, uv[mesh.source(h)] - origin);
  }
  const double scale
      = std::sqrt(2 * CGAL::Polygon_mesh_processing::area(mesh) / std::abs(twice_area));
  std::vector<SMP::HLSCM_pin> pins;
  for(const auto h : CGAL::halfedges_around_face(border, mesh)) {
    const Kernel::Vector_2 p = uv[mesh.target(h)] - origin;
    pins.push_back({std::size_t(mesh.target(h)), std::copysign(scale, twice_area) * p.x(),
                    scale * p.y()});
  }
  return pins;
}

std::vector<SMP::HLSCM_pin>
border_pins(const Program_options& options, const CGAL::Indexed_mesh::Indexed_triangle_mesh& component)
{
  switch(options.border) {
  case Border::CIRCLE:
    return pins_by(SMP::Circular_border_arc_length_parameterizer_3<Mesh>(), options, component);
  case Border::SQUARE:
    return pins_by(SMP::Square_border_arc_length_parameterizer_3<Mesh>(), options, component);
  case Border::POLYGON:
    return pins_by(SMP::Polygonal_border_parameterizer_3<Mesh>(options.border_corners), options,
                   component);
  case Border::FREE: break;
  }
  return {};
}

} // namespace

SMP::Conformal_map
map_with_low_stretch(const Program_options& options,
                     CGAL::Indexed_mesh::Indexed_triangle_mesh component,
                     const std::vector<SMP::HLSCM_pin>& pins,
                     std::vector<CGAL::Indexed_mesh::Space_tensor> metric,
                     std::vector<CGAL::Simple_cartesian<double>::Point_2> start,
                     SMP::Low_stretch_report& stretch, Progress_bar& progress)
{
  SMP::Low_stretch_options library;
  library.pins = pins;
  library.metric = std::move(metric);
  const std::vector<SMP::HLSCM_pin> border = border_pins(options, component);
  library.pins.insert(library.pins.end(), border.begin(), border.end());
  library.start = std::move(start);
  library.face_weights = options.weights_of_faces;
  library.is_one_to_one = options.is_one_to_one;
  if(options.is_tolerance_given) {
    library.tolerance = options.library.tolerance;
  }
  if(options.library.maximal_iterations > 0) {
    library.maximal_iterations = options.library.maximal_iterations;
  }
  library.time_limit = options.library.time_limit;
  library.progress = [&progress](double fraction) { return progress.try_advance(fraction); };
  progress.start_stage("solving");
  SMP::Conformal_map result;
  SMP::HLSCM_report& report = result.report;
  report.vertices = component.points.size();
  report.faces = component.triangles.size();
  SMP::Low_stretch_map map = map_with(options.stretch, std::move(component), library);
  Interruption::check();
  if(!map.is_ok()) {
    throw Program_error(options.input, map.error
                                           + (options.border == Border::SQUARE
                                                      || options.border == Border::POLYGON
                                                  ? ": faces with three corners on a side have no room, "
                                                    "choose --border circle"
                                                  : ""));
  }
  stretch = map.report;
  result.uv = std::move(map.uv);
  report.pins = pins;
  report.method = "low-stretch";
  report.converged = stretch.converged;
  report.stopped_early = stretch.is_cut_short;
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
