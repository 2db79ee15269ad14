// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Surface_mapping.h"

#include "commands/Low_stretch.h"
#include "commands/Signal.h"

#include "common/Interruption.h"
#include "common/Program_error.h"
#include "reading/Face_numbers.h"

#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

using CGAL::Indexed_mesh::Indexed_triangle_mesh;
using CGAL::Indexed_mesh::no_vertex;
using CGAL::Indexed_mesh::Surface_of_soup;

// The triangles with a flag, and their vertices.
Surface_of_soup part_of(const Surface_of_soup& whole, const std::vector<bool>& is_chosen)
{
  Surface_of_soup part;
  part.repairs = whole.repairs;
  std::vector<std::uint32_t> rank(whole.vertex.size(), no_vertex);
  for(std::size_t t = 0; t < is_chosen.size(); ++t) {
    for(std::size_t k = 0; is_chosen[t] && k < 3; ++k) {
      rank[whole.mesh.triangles[t][k]] = 0;
    }
  }
  for(std::size_t v = 0; v < rank.size(); ++v) {
    if(rank[v] != no_vertex) {
      rank[v] = std::uint32_t(part.vertex.size());
      part.vertex.push_back(whole.vertex[v]);
      part.mesh.points.push_back(whole.mesh.points[v]);
    }
  }
  for(std::size_t t = 0; t < is_chosen.size(); ++t) {
    if(is_chosen[t]) {
      const auto& v = whole.mesh.triangles[t];
      part.mesh.triangles.push_back({rank[v[0]], rank[v[1]], rank[v[2]]});
      part.corners.push_back(whole.corners[t]);
      part.face.push_back(whole.face[t]);
      part.diagonals.push_back(whole.diagonals[t]);
    }
  }
  return part;
}

SMP::HLSCM_options observed(const Program_options& options, Level_snapshots* snapshots)
{
  SMP::HLSCM_options library = options.library;
  if(snapshots != nullptr) {
    library.level_observer = [snapshots](const SMP::Level_view& view) {
      snapshots->observe(view);
      return true;
    };
  }
  return library;
}

using Stretch_reports = std::vector<SMP::Low_stretch_report>; // one for each component

// That of all together.
std::optional<SMP::Low_stretch_report> mean_of(const Stretch_reports& reports)
{
  if(reports.empty()) {
    return std::nullopt;
  }
  SMP::Low_stretch_report all = reports.front();
  double area = 0, energy = 0, gap = 0;
  for(const SMP::Low_stretch_report& part : reports) {
    area += part.area;
    energy += part.area * part.energy;
    gap += part.area * part.energy * part.energy_gap;
  }
  all.area = area;
  all.energy = energy / area;
  all.energy_gap = gap / energy;
  return all;
}

// One connected component with a border, without handles.
SMP::Conformal_map map_component(const Program_options& options, SMP::HLSCM_options library,
                                 Indexed_triangle_mesh component,
                                 const std::vector<SMP::HLSCM_pin>& pins,
                                 Stretch_reports& stretch, Progress_bar& progress)
{
  if(!options.method) {
    stretch.emplace_back();
    return map_with_low_stretch(options, std::move(component), pins, std::move(library.metric), {},
                                stretch.back(), progress);
  }
  return solve_chart(options, std::move(library), std::move(component), pins, progress);
}

// From the elements of the surface to those of the file.
void name_elements(const Surface_of_soup& surface, SMP::HLSCM_report& report)
{
  for(SMP::HLSCM_pin& pin : report.pins) {
    pin.vertex = surface.vertex[pin.vertex];
  }
  if(report.flip_repair) {
    for(std::size_t& face : report.flip_repair->unmended_faces) {
      face = surface.face[face];
    }
  }
}

void add(const SMP::Flip_repair_report& part, SMP::Flip_repair_report& all)
{
  all.flipped_before += part.flipped_before;
  all.degenerate_before += part.degenerate_before;
  all.flipped_after += part.flipped_after;
  all.degenerate_after += part.degenerate_after;
  all.patches += part.patches;
  all.moved_vertices += part.moved_vertices;
  all.branch_vertices += part.branch_vertices;
  all.energy_before += part.energy_before;
  all.energy_after += part.energy_after;
  all.seconds += part.seconds;
  all.unmended_faces.insert(all.unmended_faces.end(), part.unmended_faces.begin(),
                            part.unmended_faces.end());
}

// The sums over all components, and the worst of them.
SMP::HLSCM_report sum(const std::vector<SMT::Mapped_component>& components)
{
  SMP::HLSCM_report all = components.front().report;
  for(std::size_t c = 1; c < components.size(); ++c) {
    const SMP::HLSCM_report& part = components[c].report;
    all.converged = all.converged && part.converged;
    all.stopped_early = all.stopped_early || part.stopped_early;
    all.vertices += part.vertices;
    all.faces += part.faces;
    all.borders += part.borders;
    all.mollified_faces += part.mollified_faces;
    all.iterations = std::max(all.iterations, part.iterations);
    all.energy += part.energy;
    all.energy_gap_estimate += part.energy_gap_estimate;
    all.seconds_hierarchy += part.seconds_hierarchy;
    all.seconds_operators += part.seconds_operators;
    all.seconds_solve += part.seconds_solve;
    all.seconds_total += part.seconds_total;
    all.pins.insert(all.pins.end(), part.pins.begin(), part.pins.end());
    for(const std::string& warning : part.warnings) {
      if(std::find(all.warnings.begin(), all.warnings.end(), warning) == all.warnings.end()) {
        all.warnings.push_back(warning);
      }
    }
    if(part.flip_repair) {
      all.flip_repair = all.flip_repair ? all.flip_repair : SMP::Flip_repair_report();
      add(*part.flip_repair, *all.flip_repair);
    }
    if(part.levels.size() > all.levels.size()) {
      all.levels = part.levels;
    }
  }
  return all;
}

// While the solver has the mesh, the file is all that is kept beside it.
Mapped_surface map_chart(Input_surface& input, const Program_options& options,
                         const std::vector<SMP::HLSCM_pin>& pins, Level_snapshots* snapshots,
                         Progress_bar& progress)
{
  Stretch_reports stretch;
  Indexed_triangle_mesh its_own = std::move(input.surface.mesh);
  input.surface = {};
  SMP::Conformal_map map = map_component(options, observed(options, snapshots), std::move(its_own),
                                         pins, stretch, progress);
  input.surface = CGAL::Indexed_mesh::surface_of_soup(input.file.soup, input.diagnosis);
  const Indexed_triangle_mesh& mesh = input.surface.mesh;
  Mapped_surface result;
  result.stretch = mean_of(stretch);
  result.mesh.points = mesh.points;
  result.mesh.triangles = result.mesh.wedges = mesh.triangles;
  result.mesh.uv = std::move(map.uv);
  result.components.emplace_back();
  result.components.back().faces = mesh.triangles.size();
  result.components.back().borders = map.report.borders;
  result.components.back().report = std::move(map.report);
  return result;
}

// The pins as those of the texture coordinates of their vertices, each of which must have one.
std::vector<SMP::HLSCM_pin> pins_of_uv(const Program_options& options, const Input_surface& input,
                                       const SMM::Textured_triangle_mesh& mesh,
                                       std::vector<SMP::HLSCM_pin> pins)
{
  for(SMP::HLSCM_pin& pin : pins) {
    std::uint32_t wedge = no_vertex;
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for(std::size_t k = 0; k < 3; ++k) {
        if(mesh.triangles[t][k] != pin.vertex) {
          continue;
        }
        if(wedge != no_vertex && wedge != mesh.wedges[t][k]) {
          throw Program_error(options.input, "vertex " + std::to_string(input.surface.vertex[pin.vertex])
                                                 + " is pinned, but lies on a seam: choose another one");
        }
        wedge = mesh.wedges[t][k];
      }
    }
    pin.vertex = wedge;
  }
  return pins;
}

// The surface with a vertex for each texture coordinate that a vertex has. Corners with the same one get
// the same index for it.
Indexed_triangle_mesh cut_along_seams(SMM::Textured_triangle_mesh& mesh)
{
  std::map<std::tuple<std::uint32_t, double, double>, std::uint32_t> index;
  Indexed_triangle_mesh cut;
  auto uv = std::move(mesh.uv);
  mesh.uv.clear();
  for(std::size_t t = 0; t < mesh.wedges.size(); ++t) {
    for(std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      const auto& p = uv[mesh.wedges[t][k]];
      const auto [at, is_new]
          = index.try_emplace({v, p.x(), p.y()}, std::uint32_t(cut.points.size()));
      if(is_new) {
        cut.points.push_back(mesh.points[v]);
        mesh.uv.push_back(p);
      }
      mesh.wedges[t][k] = at->second;
    }
  }
  cut.triangles = mesh.wedges;
  return cut;
}

// From the texture coordinates of the file, cut along their seams.
Mapped_surface map_from_uv(const Input_surface& input, const Program_options& options,
                           const std::vector<SMP::HLSCM_pin>& pins, Progress_bar& progress)
{
  if(!input.file.soup.has_uv()) {
    throw Program_error(options.input, "there are no texture coordinates to begin with");
  }
  Mapped_surface result;
  result.mesh = to_textured(input);
  for(std::size_t t = 0; t < result.mesh.wedges.size(); ++t) {
    SMP::Uv_triangle image;
    for(std::size_t k = 0; k < 3; ++k) {
      const auto& uv = result.mesh.uv[result.mesh.wedges[t][k]];
      image[k] = SMP::Uv_point(uv.x(), uv.y());
    }
    if(SMP::orientation_of(image) != CGAL::LEFT_TURN) {
      throw Program_error(options.input, "face " + std::to_string(input.surface.face[t])
                                             + " is flipped or degenerate in the texture coordinates: "
                                               "begin with others, or without");
    }
  }
  const Indexed_triangle_mesh cut = cut_along_seams(result.mesh);
  Stretch_reports stretch(1);
  SMP::Conformal_map map
      = map_with_low_stretch(options, cut, pins_of_uv(options, input, result.mesh, pins),
                             options.library.metric, {result.mesh.uv.begin(), result.mesh.uv.end()},
                             stretch[0], progress);
  result.stretch = mean_of(stretch);
  result.mesh.uv.assign(map.uv.begin(), map.uv.end());
  result.components.emplace_back();
  result.components.back().faces = cut.triangles.size();
  result.components.back().borders = map.report.borders;
  result.components.back().report = std::move(map.report);
  result.components.back().report.pins = pins;
  return result;
}

// What is wrong, without the name of the file, which `Program_error` begins with.
std::string reason(const Program_error& error, const std::string& file)
{
  const std::string text = error.what(), begin = file + ": ";
  return text.rfind(begin, 0) == 0 ? text.substr(begin.size()) : text;
}

Mapped_surface map_components(const Input_surface& input, const Program_options& options,
                              const std::vector<SMP::HLSCM_pin>& pins, Progress_bar& progress)
{
  Stretch_reports stretch;
  SMT::Surface_map_options map;
  map.no_seams = input.surface.diagonals;
  map.pins = pins;
  map.solver = options.library;
  Program_options of_component = options; // one after the other
  map.map = [&](const SMT::Chart_mesh& component, const std::vector<SMP::HLSCM_pin>& fixed,
                const SMP::HLSCM_options& library) {
    of_component.weights_of_faces = component.entries_of(options.weights_of_faces);
    try {
      return map_component(of_component, library, component.mesh, fixed, stretch, progress);
    } catch(const Program_error& error) {
      SMP::Conformal_map none;
      none.report.message = reason(error, options.input);
      return none;
    }
  };
  progress.start_stage("cutting");
  SMT::Surface_map mapped = SMT::map_surface(input.surface.mesh, map);
  Interruption::check();
  if(!mapped.is_ok()) {
    throw Program_error(options.input, mapped.error);
  }
  Mapped_surface result;
  result.stretch = mean_of(stretch);
  result.mesh = std::move(mapped.mesh);
  result.components = std::move(mapped.components);
  return result;
}

std::vector<double> read_weights(const std::string& name, const Input_surface& input,
                                 const std::string& input_name)
{
  std::vector<double> result = read_face_numbers(name, input, input_name);
  for(std::size_t t = 0; t < result.size(); ++t) {
    if(!(result[t] > 0)) {
      throw Program_error(name, "the weight of face " + std::to_string(input.surface.face[t])
                                    + " is 0, give each face a positive one");
    }
  }
  return result;
}

} // namespace

void choose_component(Input_surface& input, const Program_options& options)
{
  if(!options.component) {
    return;
  }
  const SMT::Face_charts components
      = SMT::charts_between(input.surface.mesh.triangles,
                            std::vector<std::uint8_t>(input.surface.mesh.triangles.size(), 0));
  if(*options.component >= components.number_of_charts) {
    throw Program_error(options.input, "there is no component " + std::to_string(*options.component)
                                           + ", the surface has "
                                           + std::to_string(components.number_of_charts)
                                           + " counted from 0: choose another one");
  }
  std::vector<bool> is_chosen;
  for(const std::uint32_t c : components.chart) {
    is_chosen.push_back(c == *options.component);
  }
  input.surface = part_of(input.surface, is_chosen);
}

Mapped_surface map_input(Input_surface& input, const Program_options& given,
                         Level_snapshots* snapshots, Progress_bar& progress)
{
  Program_options options = given;
  options.library.metric = metric_of_signal(input, given);
  if(options.border == Border::POLYGON) {
    options.border_corners = read_points(options.border_polygon);
  }
  if(!options.face_weights.empty()) {
    options.weights_of_faces = read_weights(options.face_weights, input, options.input);
  }
  std::vector<SMP::HLSCM_pin> pins
      = checked_pins(options, input.file.soup.number_of_vertices());
  for(SMP::HLSCM_pin& pin : pins) {
    const std::size_t vertex = pin.vertex;
    pin.vertex = CGAL::Indexed_mesh::vertex_of_surface(input.surface, vertex);
    if(pin.vertex == no_vertex) {
      throw Program_error(options.input, "vertex " + std::to_string(vertex)
                                             + " is pinned, but no face that is mapped has it: "
                                               "choose another vertex");
    }
  }
  Mapped_surface result = options.is_from_uv ? map_from_uv(input, options, pins, progress)
                          : input.is_chart()
                              ? map_chart(input, options, pins, snapshots, progress)
                              : map_components(input, options, pins, progress);
  if(pins.empty()) {
    result.from_solver = fit_to_unit_square(result.mesh.uv);
  }
  for(SMT::Mapped_component& component : result.components) {
    name_elements(input.surface, component.report);
    if(pins.empty()) {
      move_report(result.from_solver, component.report);
    }
  }
  result.report = sum(result.components);
  return result;
}

} // namespace hlscm
