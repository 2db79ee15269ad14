// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Chart_solving.h"
#include "commands/Commands.h"
#include "common/Interruption.h"
#include "pictures/Level_snapshots.h"
#include "common/Mesh.h"
#include "writing/Mesh_writing.h"
#include "pictures/Pictures.h"
#include "common/Program_error.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>

#include <iostream>
#include <optional>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

/// The files of a run; those that cannot be written are found out before the work begins.
struct Run_files
{
  explicit Run_files(const Program_options& options)
  {
    for(const std::string& name : {options.output, options.report}) {
      refuse_to_overwrite(options.input, name);
    }
    if(!options.pictures.empty()) {
      pictures.emplace(all, options.pictures);
    }
    if(!options.report.empty()) {
      report = &all.create(options.report);
    }
    output = &all.create(options.output);
  }

  Output_files all;
  Output_file* output = nullptr;
  Output_file* report = nullptr;
  std::optional<Picture_files> pictures;
};

void print(const Run_report& report, const Program_options& options)
{
  for(const std::string& warning : report.warnings) {
    std::cerr << "hlscm: warning: " << options.input << ": " << warning << "\n";
  }
  std::cout << to_table(report, options) << std::flush;
}

} // namespace

int run_parameterize(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  Run_files files(options);
  Run_report report;

  const Stopwatch reading;
  Mesh mesh = read_chart(options.input, progress, report.warnings);
  report.seconds_read = reading.seconds();

  const Stopwatch working;
  Uv_map uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  std::optional<Level_snapshots> snapshots;
  if(files.pictures) {
    snapshots.emplace(mesh);
  }
  SMP::HLSCM_options library = options.library;
  if(snapshots) {
    library.level_observer = [&snapshots](const SMP::Level_view& view) {
      snapshots->observe(view);
      return true;
    };
  }
  report.solver = solve_chart(options, library, mesh, uv, progress).report;
  Similarity to_result;
  if(options.pins.empty()) {
    to_result = fit_to_unit_square(mesh, uv, report.solver);
  }
  report.seconds_total = working.seconds();
  const Stopwatch measuring;
  report.distortion = SMP::measure_distortion(mesh, uv);
  report.seconds_measure = measuring.seconds();
  report.warnings = all_warnings(report);

  const Stopwatch writing;
  write_mesh(mesh, uv, options.output, *files.output, progress);
  report.seconds_write = writing.seconds();
  report.peak_memory_mb = peak_memory_mb();
  if(files.report != nullptr) {
    files.report->put(to_json(report, options));
  }
  if(files.pictures) {
    files.pictures->draw(snapshots->surfaces(uv, to_result), progress);
  }
  Interruption::finish();
  files.all.commit();
  progress.erase();
  if(options.is_verbose) {
    std::cerr << report.solver;
  }
  if(!options.is_quiet) {
    print(report, options);
  }
  return 0;
}

} // namespace hlscm
