// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Repairs.h"

#include <iostream>

namespace hlscm {

using CGAL::Indexed_mesh::Soup_finding;
using CGAL::Indexed_mesh::Soup_repairs;
using Json = nlohmann::ordered_json;

Json to_json(const Soup_finding& finding, std::size_t elements)
{
  Json json = {{"count", finding.count}, {"first", Json::array()}};
  for(std::size_t i = 0; finding && i < elements; ++i) {
    json["first"].push_back(finding.first[i]);
  }
  return json;
}

Json to_json(const Soup_repairs& repairs)
{
  struct Row
  {
    const char* key;
    const Soup_finding& finding;
    std::size_t elements; // how many indices say where it is
  };
  const Row rows[] = {{"triangulated_faces", repairs.triangulated, 1},
                      {"folded_faces", repairs.folded, 1},
                      {"collapsed_faces", repairs.collapsed, 1},
                      {"duplicate_faces", repairs.duplicate, 2},
                      {"separated_edges", repairs.separated, 2},
                      {"turned_faces", repairs.turned, 1},
                      {"cut_edges", repairs.cut, 2},
                      {"split_vertices", repairs.split, 1},
                      {"isolated_vertices", repairs.isolated, 1}};
  Json json = Json::object();
  for(const Row& row : rows) {
    if(row.finding) {
      json[row.key] = to_json(row.finding, row.elements);
    }
  }
  return json;
}

void print_notes(const std::string& file, const Soup_repairs& repairs,
                 const std::vector<std::string>& warnings)
{
  for(const std::string& sentence : repairs.sentences()) {
    std::cerr << "hlscm: note: " << file << ": " << sentence << "\n";
  }
  for(const std::string& warning : warnings) {
    std::cerr << "hlscm: warning: " << file << ": " << warning << "\n";
  }
}

} // namespace hlscm
