// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Very_large_report.h"

#include <iomanip>
#include <sstream>

namespace hlscm {

using Json = nlohmann::ordered_json;

Json Very_large_report::to_json() const
{
  const auto& s = report.solver;
  Json pins = Json::array(), levels = Json::array();
  for(const auto& pin : s.pins) {
    pins.push_back({{"index", pin.vertex}, {"uv", {pin.u, pin.v}}});
  }
  for(const auto& level : s.levels) {
    levels.push_back({{"vertices", level.vertices}, {"iterations", level.iterations}});
  }
  return {{"input", input},
          {"output", output},
          {"method", s.method},
          {"tolerance", tolerance},
          {"vertices", s.vertices},
          {"faces", s.faces},
          {"borders", s.borders},
          {"pins", pins},
          {"levels", s.levels.size()},
          {is_distributed ? "distributed_levels" : "levels_in_files", report.levels_in_files},
          {"levels_finished_before", report.finished_before},
          {"level_table", levels},
          {"blocks", report.blocks},
          {"iterations", s.iterations},
          {"converged", s.converged},
          {"energy", s.energy},
          {"energy_gap_estimate", s.energy_gap_estimate},
          {"flips", report.flipped_faces},
          {"mollified_faces", s.mollified_faces},
          {"seconds",
           {{"sort", report.seconds_sort},
            {"decimate", s.seconds_hierarchy},
            {"levels_in_memory", s.seconds_operators},
            {"solve", s.seconds_solve},
            {"total", s.seconds_total}}},
          {"warnings", s.warnings}};
}

std::string Very_large_report::levels() const
{
  std::string vertices;
  for(const auto& level : report.solver.levels) {
    vertices += (vertices.empty() ? "" : ", ") + std::to_string(level.vertices);
  }
  return std::to_string(report.solver.levels.size()) + " (vertices: " + vertices + "), "
       + std::to_string(report.levels_in_files) + " of them "
       + (is_distributed ? "distributed, " : "in files, ")
       + (report.finished_before > 0
              ? std::to_string(report.finished_before) + " from an earlier run, "
              : std::string())
       + "the finest in " + std::to_string(report.blocks)
       + (report.blocks == 1 ? " block" : " blocks");
}

std::string Very_large_report::energy() const
{
  std::ostringstream text;
  text << report.solver.energy << ", about " << report.solver.energy_gap_estimate
       << " above the minimum";
  return text.str();
}

std::string Very_large_report::seconds(int digits) const
{
  const auto& s = report.solver;
  return rounded(s.seconds_total, digits) + " = sort " + rounded(report.seconds_sort, digits)
       + " + decimate " + rounded(s.seconds_hierarchy, digits) + " + levels in memory "
       + rounded(s.seconds_operators, digits) + " + solve " + rounded(s.seconds_solve, digits);
}

std::string text_of(const Json& json)
{
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string rounded(double value, int digits)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

} // namespace hlscm
