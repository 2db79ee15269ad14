// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Levels_report.h"
#include "commands/Repairs.h"

#include <nlohmann/json.hpp>

#include <iomanip>
#include <sstream>

namespace hlscm {

namespace {

using Json = nlohmann::ordered_json;
using CGAL::Surface_mesh_multiresolution::Surface_error;

Json to_json(const Surface_error& error)
{
  return {{"max", error.maximum}, {"mean", error.mean}};
}

} // namespace

std::string to_json(const Levels_report& report, const std::vector<Level_of_detail>& levels,
                    const Program_options& options)
{
  Json all = Json::array(), files = Json::array();
  for(const Level_of_detail& level : levels) {
    const auto& d = *level.deviation;
    all.push_back({{"faces", level.triangles.size()},
                   {"vertices", level.vertices},
                   {"texture_vertices", level.wedges},
                   {"texture_deviation", to_json(d.deviation)},
                   {"uv_change", to_json(d.uv_change)},
                   {"distance", to_json(d.distance)},
                   {"outside_area", d.outside},
                   {"unresolved_area", d.unresolved}});
  }
  for(const auto& [name, bytes] : report.files) {
    files.push_back({{"name", name}, {"bytes", bytes}});
  }
  Json json = {{"input", options.input},
               {"output", options.output},
               {"vertices", report.vertices},
               {"texture_vertices", report.wedges},
               {"faces", report.faces},
               {"smallest_faces", report.smallest_faces},
               {"diagonal", levels.empty() ? 0. : levels[0].deviation->diagonal},
               {"levels", all},
               {"files", files},
               {"seconds",
                {{"read", report.seconds_read},
                 {"parameterize", report.seconds_parameterize},
                 {"build", report.seconds_build},
                 {"measure", report.seconds_measure},
                 {"write", report.seconds_write}}},
               {"peak_memory_mb", report.peak_memory_mb},
               {"repairs", hlscm::to_json(report.repairs)},
               {"warnings", report.warnings}};
  if(report.solver) {
    json["method"] = report.solver->method;
    json["iterations"] = report.solver->iterations;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const Levels_report& report, const std::vector<Level_of_detail>& levels,
                     const Program_options& options)
{
  std::ostringstream text;
  text << options.input << ": " << report.faces << " faces, " << report.vertices << " vertices, "
       << report.wedges << " texture coordinates\n"
       << "     faces  vertices  texture deviation max, mean  distance max, mean  swimming max, mean\n"
       << "                               (% of the diagonal)       (% of the diagonal)  (1/1024)\n"
       << std::fixed;
  for(const Level_of_detail& level : levels) {
    const auto& d = *level.deviation;
    const auto percent = [&](double length) { return 100 * d.relative(length); };
    text << std::setw(10) << level.triangles.size() << std::setw(10) << level.vertices
         << std::setprecision(4) << std::setw(20) << percent(d.deviation.maximum) << std::setw(9)
         << percent(d.deviation.mean) << std::setw(13) << percent(d.distance.maximum) << std::setw(9)
         << percent(d.distance.mean) << std::setprecision(2) << std::setw(12)
         << d.texels(d.uv_change.maximum, 1024) << std::setw(8)
         << d.texels(d.uv_change.mean, 1024) << "\n";
  }
  text << std::setprecision(2) << "seconds     read " << report.seconds_read << ", parameterize "
       << report.seconds_parameterize << ", build " << report.seconds_build << ", measure "
       << report.seconds_measure << ", write " << report.seconds_write << "\n"
       << "memory      " << std::lround(report.peak_memory_mb) << " MB at most\nwritten     ";
  for(std::size_t i = 0; i < report.files.size(); ++i) {
    text << (i > 0 ? ", " : "") << report.files[i].first << " (" << report.files[i].second
         << " bytes)";
  }
  text << (options.report.empty() ? "" : ", " + options.report)
       << (options.pictures.empty() ? "" : ", " + options.pictures + "/*.png") << "\n";
  return text.str();
}

} // namespace hlscm
