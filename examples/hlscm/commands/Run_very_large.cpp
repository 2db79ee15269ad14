// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Run_report.h"
#include "commands/Very_large.h"
#include "commands/Very_large_report.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Progress_bar.h"
#include "formats/Converted_obj.h"
#include "writing/Output_files.h"

#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

using Report = SMP::Very_large_chart_report;

Very_large_report of_run(const Report& report, const Program_options& options)
{
  return {report, options.input, options.output, options.library.tolerance, false};
}

std::string to_table(const Report& report, const Program_options& options)
{
  const SMP::HLSCM_report& s = report.solver;
  const Very_large_report said = of_run(report, options);
  std::ostringstream text;
  const auto add = [&text](const char* name, const std::string& what) {
    text << std::left << std::setw(12) << name << what << '\n';
  };
  const auto number = [](std::size_t n) { return std::to_string(n); };
  add("input", options.input + ": " + number(s.vertices) + " vertices, " + number(s.faces)
                   + " faces, " + number(s.borders) + (s.borders == 1 ? " border" : " borders"));
  add("method", s.method + ", " + number(s.iterations) + " iterations on the finest level, converged");
  add("levels", said.levels());
  std::string pins;
  for(const auto& pin : s.pins) {
    pins += (pins.empty() ? "vertex " : ", vertex ") + number(pin.vertex) + " at ("
          + rounded(pin.u, 4) + ", " + rounded(pin.v, 4) + ")";
  }
  if(!pins.empty()) {
    add("pins", pins);
  }
  add("energy", said.energy());
  add("flips", number(report.flipped_faces) + " of " + number(s.faces) + " faces");
  add("seconds", said.seconds(2) + "; write " + rounded(report.seconds_write, 2));
  add("memory", rounded(peak_memory_mb(), 0) + " MB at most");
  add("files", rounded(1e-6 * double(report.bytes_of_files), 0) + " MB at most; from disk "
                   + rounded(1e-6 * double(report.bytes_read), 0) + " MB, to disk "
                   + rounded(1e-6 * double(report.bytes_written), 0) + " MB");
  add("written", options.output + (options.report.empty() ? "" : ", " + options.report));
  return text.str();
}

std::string to_json(const Report& report, const Program_options& options)
{
  nlohmann::ordered_json json = of_run(report, options).to_json();
  json["seconds"]["write"] = report.seconds_write;
  json["peak_memory_mb"] = peak_memory_mb();
  json["bytes_of_files"] = report.bytes_of_files;
  json["bytes_read"] = report.bytes_read;
  json["bytes_written"] = report.bytes_written;
  return text_of(json);
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
  const double angular_defect_bound = options.is_angular_defect_given
                                          ? options.library.angular_defect_bound
                                          : library.solver.angular_defect_bound;
  library.solver = options.library;
  library.solver.angular_defect_bound = angular_defect_bound;
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
