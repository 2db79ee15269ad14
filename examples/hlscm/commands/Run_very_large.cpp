// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Run_report.h"
#include "commands/Very_large.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Progress_bar.h"
#include "formats/Converted_obj.h"
#include "writing/Output_files.h"

#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

using Report = SMP::Very_large_chart_report;

std::string rounded(double value, int digits)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string to_table(const Report& report, const Program_options& options)
{
  const SMP::HLSCM_report& s = report.solver;
  std::ostringstream text;
  const auto add = [&text](const char* name, const std::string& what) {
    text << std::left << std::setw(12) << name << what << '\n';
  };
  const auto number = [](std::size_t n) { return std::to_string(n); };
  add("input", options.input + ": " + number(s.vertices) + " vertices, " + number(s.faces)
                   + " faces, " + number(s.borders) + (s.borders == 1 ? " border" : " borders"));
  add("method", s.method + ", " + number(s.iterations) + " iterations on the finest level, converged");
  std::string levels;
  for(const auto& level : s.levels) {
    levels += (levels.empty() ? "" : ", ") + number(level.vertices);
  }
  add("levels", number(s.levels.size()) + " (vertices: " + levels + "), "
                    + number(report.levels_in_files) + " of them in files, "
                    + (report.finished_before > 0
                           ? number(report.finished_before) + " from an earlier run, "
                           : std::string())
                    + "the finest in " + number(report.blocks)
                    + (report.blocks == 1 ? " block" : " blocks"));
  std::string pins;
  for(const auto& pin : s.pins) {
    pins += (pins.empty() ? "vertex " : ", vertex ") + number(pin.vertex) + " at ("
          + rounded(pin.u, 4) + ", " + rounded(pin.v, 4) + ")";
  }
  add("pins", pins);
  std::ostringstream energy;
  energy << s.energy << ", about " << s.energy_gap_estimate << " above the minimum";
  add("energy", energy.str());
  add("flips", number(report.flipped_faces) + " of " + number(s.faces) + " faces");
  add("seconds", rounded(s.seconds_total, 2) + " = sort " + rounded(report.seconds_sort, 2)
                     + " + decimate " + rounded(s.seconds_hierarchy, 2) + " + levels in memory "
                     + rounded(s.seconds_operators, 2) + " + solve " + rounded(s.seconds_solve, 2)
                     + "; write " + rounded(report.seconds_write, 2));
  add("memory", rounded(peak_memory_mb(), 0) + " MB at most");
  add("files", rounded(1e-6 * double(report.bytes_of_files), 0) + " MB at most; from disk "
                   + rounded(1e-6 * double(report.bytes_read), 0) + " MB, to disk "
                   + rounded(1e-6 * double(report.bytes_written), 0) + " MB");
  add("written", options.output + (options.report.empty() ? "" : ", " + options.report));
  return text.str();
}

std::string to_json(const Report& report, const Program_options& options)
{
  using Json = nlohmann::ordered_json;
  const SMP::HLSCM_report& s = report.solver;
  Json pins = Json::array(), levels = Json::array();
  for(const auto& pin : s.pins) {
    pins.push_back({{"index", pin.vertex}, {"uv", {pin.u, pin.v}}});
  }
  for(const auto& level : s.levels) {
    levels.push_back({{"vertices", level.vertices}, {"iterations", level.iterations}});
  }
  const Json json = {{"input", options.input},
                     {"output", options.output},
                     {"method", s.method},
                     {"tolerance", options.library.tolerance},
                     {"vertices", s.vertices},
                     {"faces", s.faces},
                     {"borders", s.borders},
                     {"pins", pins},
                     {"levels", s.levels.size()},
                     {"levels_in_files", report.levels_in_files},
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
                       {"total", s.seconds_total},
                       {"write", report.seconds_write}}},
                     {"peak_memory_mb", peak_memory_mb()},
                     {"bytes_of_files", report.bytes_of_files},
                     {"bytes_read", report.bytes_read},
                     {"bytes_written", report.bytes_written},
                     {"warnings", s.warnings}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// What an earlier run has left is beside the output.
std::string work_folder_of(const Program_options& options)
{
  return options.work_folder.empty() ? options.output + ".work" : options.work_folder;
}

} // namespace

int run_very_large(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  Output_files files;
  for(const std::string& name : {options.output, options.report}) {
    refuse_to_overwrite(options.input, name);
  }
  Output_file* const report_file
      = options.report.empty() ? nullptr : &files.create(options.report);
  Output_file& output = files.create(options.output);

  SMP::Very_large_chart_options library;
  library.solver = options.library;
  library.solver.progress = [&progress](double part) { return progress.try_advance(part); };
  library.memory = options.memory;
  library.work_folder = work_folder_of(options);
  library.resumes = options.is_resumed;
  library.finish = [&](const Report& report) {
    Interruption::check();
    if(report_file != nullptr) {
      report_file->put(to_json(report, options));
    }
    Interruption::finish();
    files.commit();
  };
  std::string input = options.input;
  std::optional<Converted_obj> converted;
  const std::string extension = std::filesystem::path(options.input).extension().string();
  if(extension == ".obj" || extension == ".OBJ") {
    progress.start_stage("converting");
    converted.emplace(options.input, library.work_folder, progress);
    input = converted->path();
  }
  progress.start_stage("mapping");
  const Report report = SMP::map_very_large_chart(
      input, [&output](std::string_view bytes) { output.put(bytes); }, library);
  if(report.error != SMP::OK) {
    Interruption::check();
    throw Program_error(options.input, report.message);
  }
  progress.erase();
  if(options.is_verbose) {
    std::cerr << report.solver;
  }
  if(!options.is_quiet) {
    for(const std::string& warning : report.solver.warnings) {
      std::cerr << "hlscm: warning: " << options.input << ": " << warning << '\n';
    }
    std::cout << to_table(report, options) << std::flush;
  }
  return 0;
}

} // namespace hlscm
