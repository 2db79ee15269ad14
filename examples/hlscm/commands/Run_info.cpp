// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "reading/Diagnosis.h"
#include "reading/Mesh_reading.h"

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

std::string conclusion(const Diagnosis& d, const std::vector<Obstacle>& reasons)
{
  if(!reasons.empty()) {
    return "no";
  }
  return d.zero_area ? "yes, triangles without area are replaced by very thin ones" : "yes";
}

void print_text(const std::string& file, const Diagnosis& d,
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
  const std::vector<Obstacle> reasons = obstacles(d);
  row("can be parameterized") << conclusion(d, reasons) << "\n";
  for(const Obstacle& reason : reasons) {
    std::cout << "  " << reason.what << ": " << reason.remedy << "\n";
  }
  const std::vector<Obstacle> against_atlas = atlas_obstacles(d);
  row("can have an atlas") << (against_atlas.empty() ? "yes" : "no") << "\n";
  for(const Obstacle& reason : against_atlas) {
    std::cout << "  " << reason.what << ": " << reason.remedy << "\n";
  }
}

void print_json(const std::string& file, const Diagnosis& d,
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
    json[row.key] = {{"count", row.finding.count}, {"first", Json::array()}};
    for(std::size_t i = 0; row.finding && i < row.elements; ++i) {
      json[row.key]["first"].push_back(row.finding.first[i]);
    }
  }
  const std::vector<Obstacle> reasons = obstacles(d);
  json["warnings"] = warnings;
  json["can_be_parameterized"] = reasons.empty();
  json["can_have_an_atlas"] = atlas_obstacles(d).empty();
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
  const Read_mesh mesh = read_mesh(options.input, progress);
  const Diagnosis diagnosis = diagnose(mesh.soup, progress);
  progress.erase();
  (options.prints_json ? print_json : print_text)(options.input, diagnosis, mesh.warnings);
  return 0;
}

} // namespace hlscm
