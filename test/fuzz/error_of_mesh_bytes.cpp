// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "error_of_mesh_bytes.h"

#include <reading/Diagnosis.h>
#include <reading/Mesh_reading.h>
#include <common/Program_error.h>

#include <support/chart_generators.h>
#include <support/soup_properties.h>

#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

using namespace hlscm;
using Mesh = test_support::Surface_mesh;
using Point_2 = CGAL::Simple_cartesian<double>::Point_2;
using Uv_map = Mesh::Property_map<Mesh::Vertex_index, Point_2>;

constexpr std::size_t most_faces_mapped = 2000; // a fuzzer wants many runs a second

SMP::HLSCM_options options_with_many_levels()
{
  SMP::HLSCM_options options;
  options.coarsest_size = 8;
  options.level_ratio = 2;
  options.maximal_iterations = 20;
  return options;
}

bool is_finite(const Point_2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); }

std::string error_in_success(const Mesh& mesh, Uv_map uv, const SMP::HLSCM_report& report)
{
  for(const auto v : mesh.vertices()) {
    if(!is_finite(uv[v])) {
      return "vertex " + std::to_string(v) + " has no finite parameter";
    }
  }
  if(!std::isfinite(report.energy) || !std::isfinite(report.energy_gap_estimate)) {
    return "the energy is not finite";
  }
  if(!report.converged && report.warnings.empty()) {
    return "not converged, but no warning";
  }
  if(!report.message.empty()) {
    return "success with the message: " + report.message;
  }
  if(report.vertices != mesh.number_of_vertices() || report.faces != mesh.number_of_faces()
     || report.borders == 0 || report.pins.size() < 2)
  {
    return "the report is not of this mesh";
  }
  if(report.levels.empty() || report.levels.back().vertices != report.vertices
     || report.levels.back().faces != report.faces)
  {
    return "the finest level is not the mesh";
  }
  const SMP::Distortion_measures measures = SMP::measure_distortion(mesh, uv);
  if(measures.flipped_faces + measures.degenerate_faces > report.faces) {
    return "more bad faces than faces";
  }
  return "";
}

std::string error_of_map(const CGAL::Indexed_mesh::Indexed_triangle_mesh& arrays)
{
  Mesh mesh = test_support::to_surface_mesh(arrays);
  if(mesh.number_of_faces() != arrays.triangles.size()) {
    return "a chart by its diagnosis, but the mesh has not all faces";
  }
  Uv_map uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv").first;
  SMP::HLSCM_parameterizer_3<Mesh> parameterizer(options_with_many_levels());
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const SMP::Error_code code = parameterizer.parameterize(mesh, border, uv);
  if(code == SMP::OK) {
    return error_in_success(mesh, uv, parameterizer.report());
  }
  return parameterizer.report().message.empty() ? "refused without a message" : "";
}

std::optional<Read_mesh> read(const std::string& file_name, std::string_view bytes,
                              Progress_bar& progress, std::string& message)
{
  try {
    return read_mesh(file_name, bytes.data(), bytes.data() + bytes.size(), progress);
  } catch(const Program_error& error) {
    message = error.what();
    return std::nullopt;
  }
}

} // namespace

std::string error_of_mesh_bytes(const std::string& file_name, std::string_view bytes)
{
  Progress_bar progress(false);
  std::string message;
  const std::optional<Read_mesh> mesh = read(file_name, bytes, progress, message);
  if(!mesh) {
    return message.size() > file_name.size() + 2 ? "" : "refused without a reason";
  }
  const Diagnosis diagnosis = diagnose(mesh->soup, progress);
  for(const Obstacle& obstacle : obstacles(diagnosis)) {
    if(obstacle.what.empty() || obstacle.remedy.empty()) {
      return "an obstacle without words";
    }
  }
  const auto surface = CGAL::Indexed_mesh::surface_of_soup(mesh->soup);
  if(!surface.is_ok()) {
    return surface.error.empty() ? "no surface, without a sentence" : "";
  }
  const std::string error = test_support::surface_of_soup_error(mesh->soup, surface);
  if(!error.empty()) {
    return "the surface of the soup: " + error;
  }
  const bool is_small = surface.mesh.triangles.size() <= most_faces_mapped;
  return obstacles(diagnosis).empty() && is_small ? error_of_map(surface.mesh) : "";
}
