// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "commands/Repairs.h"
#include "reading/Diagnosis.h"
#include "reading/Surface_reading.h"

#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_texturing/chart_topology.h>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <iostream>

namespace hlscm {

namespace {

using Json = nlohmann::ordered_json;

struct Row
{
  const char* key;   // of the JSON
  const char* label; // of the text
  const Finding& finding;
  std::size_t elements; // how many indices say where it is
};

std::vector<Row> findings(const Diagnosis& d)
{
  return {{"not_finite_vertices", "vertices that are not finite", d.not_finite, 1},
          {"isolated_vertices", "isolated vertices", d.isolated, 1},
          {"non_triangular_faces", "faces that are no triangles", d.not_triangular, 1},
          {"folded_faces", "faces that use a vertex twice", d.folded, 1},
          {"zero_area_faces", "triangles without area", d.zero_area, 1},
          {"duplicate_faces", "pairs of duplicate faces", d.duplicate, 2},
          {"non_manifold_edges", "non-manifold edges", d.non_manifold_edges, 2},
          {"misoriented_faces", "pairs of misoriented faces", d.misoriented, 2},
          {"non_manifold_vertices", "non-manifold vertices", d.non_manifold_vertices, 1}};
}

/// What the commands that map a mesh would do to it first.
struct Plan
{
  std::string refusal; ///< why it cannot be mapped at all; empty if it can
  CGAL::Indexed_mesh::Soup_repairs repairs;
  std::size_t components = 0; ///< of the surface
  std::size_t cut = 0;        ///< of these: closed, or with handles
};

Plan plan_for(const Polygon_soup& soup, const Diagnosis& d)
{
  namespace SMT = CGAL::Surface_mesh_texturing;
  Plan plan;
  if(d.not_finite) {
    plan.refusal = surface_obstacles(d).front().what;
    return plan;
  }
  const auto surface = CGAL::Indexed_mesh::surface_of_soup(soup, d);
  plan.refusal = surface.error;
  plan.repairs = surface.repairs;
  const auto& triangles = surface.mesh.triangles;
  const auto charts
      = SMT::charts_between(triangles, std::vector<std::uint8_t>(triangles.size(), 0));
  for(const auto& topology : SMT::chart_topologies(triangles, charts)) {
    ++plan.components;
    plan.cut += topology.borders == 0 || topology.genus() > 0;
  }
  return plan;
}

/// One line each.
std::vector<std::string> steps(const Plan& plan, const Diagnosis& d)
{
  std::vector<std::string> all = plan.repairs.sentences();
  if(plan.cut > 0) {
    all.push_back(std::to_string(plan.cut)
                  + (plan.cut == 1 ? " component is closed or has handles: it is cut open"
                                   : " components are closed or have handles: they are cut open"));
  }
  if(plan.components > 1) {
    all.push_back("the " + std::to_string(plan.components)
                  + " components are laid side by side");
  }
  if(d.coinciding_points > 0) {
    all.push_back(std::to_string(d.coinciding_points)
                  + " vertices have the place of another one: merge them first if the parts belong "
                    "together");
  }
  if(d.zero_area) {
    all.push_back("triangles without area are replaced by very thin ones");
  }
  return all;
}

void print_text(const std::string& file, const Diagnosis& d, const Plan& plan,
                const std::vector<std::string>& warnings)
{
  const auto row = [](const std::string& label) -> std::ostream& {
    return std::cout << std::left << std::setw(34) << label;
  };
  row("file") << file << "\n";
  row("vertices, edges, faces") << d.vertices << ", " << d.edges << ", " << d.faces << "\n";
  row("connected components") << d.components << "\n";
  row("borders") << d.borders << "\n";
  row("Euler characteristic") << d.euler_characteristic << "\n";
  row("genus") << (d.has_genus() ? std::to_string(d.genus) : "not defined") << "\n";
  for(const Row& finding : findings(d)) {
    row(finding.label) << finding.finding.count;
    if(finding.finding) {
      std::cout << ", first " << finding.finding.first[0];
      if(finding.elements == 2) {
        std::cout << " and " << finding.finding.first[1];
      }
    }
    std::cout << "\n";
  }
  for(const std::string& warning : warnings) {
    row("warning") << warning << "\n";
  }
  row("can be mapped") << (plan.refusal.empty() ? "yes" : "no, " + plan.refusal) << "\n";
  for(const std::string& step : steps(plan, d)) {
    std::cout << "  " << step << "\n";
  }
  const std::vector<Obstacle> reasons = obstacles(d);
  row("is a chart as it is") << (reasons.empty() ? "yes" : "no") << "\n";
  for(const Obstacle& reason : reasons) {
    std::cout << "  " << reason.what << ": " << reason.remedy << "\n";
  }
}

void print_json(const std::string& file, const Diagnosis& d, const Plan& plan,
                const std::vector<std::string>& warnings)
{
  Json json = {{"file", file},
               {"vertices", d.vertices},
               {"edges", d.edges},
               {"faces", d.faces},
               {"components", d.components},
               {"borders", d.borders},
               {"euler_characteristic", d.euler_characteristic},
               {"genus", d.has_genus() ? Json(d.genus) : Json(nullptr)},
               {"orientable", d.is_orientable},
               {"manifold", d.is_manifold()}};
  for(const Row& row : findings(d)) {
    json[row.key] = to_json(row.finding, row.elements);
  }
  const std::vector<Obstacle> reasons = obstacles(d);
  json["warnings"] = warnings;
  json["can_be_parameterized"] = plan.refusal.empty();
  json["can_have_an_atlas"] = plan.refusal.empty();
  json["is_chart"] = reasons.empty();
  json["repairs"] = to_json(plan.repairs);
  json["components_to_cut"] = plan.cut;
  json["obstacles"] = Json::array();
  for(const Obstacle& reason : reasons) {
    json["obstacles"].push_back({{"what", reason.what}, {"remedy", reason.remedy}});
  }
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

} // namespace

int run_info(const Program_options& options)
{
  Progress_bar progress(true);
  const Read_mesh mesh = read_and_weld(options.input, options, progress);
  const Diagnosis diagnosis = diagnose(mesh.soup, progress);
  const Plan plan = plan_for(mesh.soup, diagnosis);
  progress.erase();
  (options.prints_json ? print_json : print_text)(options.input, diagnosis, plan, mesh.warnings);
  return 0;
}

} // namespace hlscm
