// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "commands/Repairs.h"
#include "commands/Surface_mapping.h"
#include "commands/Very_large.h"
#include "common/Interruption.h"
#include "pictures/Level_snapshots.h"
#include "writing/Mesh_writing.h"
#include "pictures/Pictures.h"
#include "common/Program_error.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

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
      if(!options.signal.empty()) {
        refuse_to_overwrite(options.signal, name);
      }
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
  print_notes(options.input, report.repairs, report.warnings);
  std::cout << to_table(report, options) << std::flush;
}

} // namespace

int run_parameterize(const Program_options& options)
{
  if(options.memory > 0) {
    return run_very_large(options);
  }
  Progress_bar progress(!options.is_quiet);
  Run_files files(options);
  Run_report report;

  const Stopwatch reading;
  Input_surface input
      = read_surface(options.input, options, obstacles, progress, report.warnings);
  choose_component(input, options);
  report.seconds_read = reading.seconds();

  const Stopwatch working;
  std::optional<Level_snapshots> snapshots;
  if(files.pictures) {
    snapshots.emplace(input.surface.mesh.points);
  }
  Mapped_surface map
      = map_input(input, options, snapshots ? &*snapshots : nullptr, progress);
  report.solver = map.report;
  report.stretch = map.stretch;
  report.components = map.components;
  report.repairs = input.surface.repairs;
  report.seconds_total = working.seconds();
  const Stopwatch measuring;
  report.distortion = SMP::measure_distortion(map.mesh);
  if(!std::isfinite(report.solver.energy)) { // too large for a number in the unit of the mesh
    report.solver.energy = report.distortion.conformal_energy;
  }
  report.seconds_measure = measuring.seconds();
  report.warnings = all_warnings(report);

  std::vector<Drawn_surface> drawn;
  if(files.pictures) {
    drawn = snapshots->surfaces(map.mesh, map.from_solver);
  }
  const Stopwatch writing;
  write_mesh(with_map(std::move(input.file), input.surface, std::move(map.mesh.uv),
                      map.mesh.wedges, report.warnings),
             options.output, *files.output, progress);
  report.seconds_write = writing.seconds();
  report.peak_memory_mb = peak_memory_mb();
  if(files.report != nullptr) {
    files.report->put(to_json(report, options));
  }
  if(files.pictures) {
    files.pictures->draw(drawn, progress);
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
