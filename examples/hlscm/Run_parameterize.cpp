// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Commands.h"
#include "Diagnosis.h"
#include "Interruption.h"
#include "Level_snapshots.h"
#include "Mesh.h"
#include "Mesh_reading.h"
#include "Mesh_writing.h"
#include "Pictures.h"
#include "Program_error.h"
#include "Run_report.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

#include <chrono>
#include <iostream>
#include <optional>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

/// The files of a run; those that cannot be written are found out before the work begins.
struct Run_files
{
  explicit Run_files(const Program_options& options)
  {
    for(const std::string& name : {options.output, options.report}) {
      std::error_code ignored;
      if(std::filesystem::equivalent(options.input, name, ignored)) {
        throw Program_error(name, "the output is the input, choose another name");
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

Mesh read_chart(const Program_options& options, Progress_bar& progress, Run_report& report)
{
  const Read_mesh read = read_mesh(options.input, progress);
  report.warnings = read.warnings;
  const Diagnosis diagnosis = diagnose(read.soup, progress);
  const std::vector<Obstacle> all = obstacles(diagnosis);
  if(!all.empty()) {
    throw Program_error(options.input, all.front().what + ", " + all.front().remedy);
  }
  return build_mesh(read.soup);
}

std::vector<std::pair<Mesh::Vertex_index, Kernel::Point_2>>
checked_pins(const Program_options& options, const Mesh& mesh)
{
  std::vector<std::pair<Mesh::Vertex_index, Kernel::Point_2>> pins;
  for(const Pin& pin : options.pins) {
    if(pin.vertex >= mesh.number_of_vertices()) {
      throw Program_error(options.input, "pin " + std::to_string(pin.vertex)
                                             + " is out of range, the "
                                               "mesh has "
                                             + std::to_string(mesh.number_of_vertices())
                                             + " vertices counted from 0: choose another vertex");
    }
    for(const auto& other : pins) {
      if(std::size_t(other.first) == pin.vertex) {
        throw Program_error(options.input,
                            "vertex " + std::to_string(pin.vertex)
                                + " is pinned twice, give each vertex at most one pin");
      }
    }
    pins.emplace_back(Mesh::Vertex_index(Mesh::size_type(pin.vertex)),
                      Kernel::Point_2(pin.u, pin.v));
  }
  if(!pins.empty() && std::all_of(pins.begin(), pins.end(), [&](const auto& pin) {
       return pin.second == pins[0].second;
     }))
  {
    throw Program_error(options.input,
                        "all pins have the same place, which maps the whole surface to a "
                        "point: choose two places or more");
  }
  return pins;
}

void solve(const Program_options& options, const Mesh& mesh, Uv_map uv, Level_snapshots* snapshots,
           Progress_bar& progress, SMP::HLSCM_report& report)
{
  SMP::HLSCM_options library = options.library;
  library.progress = [&progress](double fraction) { return progress.try_advance(fraction); };
  if(snapshots != nullptr) {
    library.level_observer = [snapshots](const SMP::Level_view& view) {
      snapshots->observe(view);
      return true;
    };
  }
  SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default, CGAL::Parallel_if_available_tag>
      parameterizer(library);
  parameterizer.set_pins(checked_pins(options, mesh));

  progress.start_stage("solving");
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uv);
  Interruption::check();
  report = parameterizer.report();
  if(error != SMP::OK) {
    throw Program_error(options.input, report.message);
  }
}

/// Moves the map into the unit square, as large as possible without turning it.
Similarity fit_to_unit_square(const Mesh& mesh, Uv_map uv, SMP::HLSCM_report& report)
{
  CGAL::Bbox_2 box;
  for(const auto v : mesh.vertices()) {
    box += uv[v].bbox();
  }
  const double size = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  Similarity to_square;
  to_square.scale = size > 0 ? 1 / size : 1;
  to_square.shift = {-to_square.scale * box.xmin(), -to_square.scale * box.ymin()};
  const auto into_square = [&to_square](double u, double v) {
    const Vector_2 p = to_square(u, v);
    return Vector_2{std::clamp(p[0], 0., 1.), std::clamp(p[1], 0., 1.)}; // from rounding errors
  };
  for(const auto v : mesh.vertices()) {
    const Vector_2 p = into_square(uv[v].x(), uv[v].y());
    uv[v] = Kernel::Point_2(p[0], p[1]);
  }
  for(SMP::HLSCM_pin& pin : report.pins) {
    const Vector_2 p = into_square(pin.u, pin.v);
    pin.u = p[0];
    pin.v = p[1];
  }
  const double area_scale = to_square.scale * to_square.scale;
  report.energy *= area_scale;
  report.energy_gap_estimate *= area_scale;
  if(report.flip_repair) {
    report.flip_repair->energy_before *= area_scale;
    report.flip_repair->energy_after *= area_scale;
  }
  return to_square;
}

void add_warnings(Run_report& report)
{
  const auto& solver = report.solver;
  report.warnings.insert(report.warnings.end(), solver.warnings.begin(), solver.warnings.end());
  if(report.distortion.flipped_faces > 0) {
    report.warnings.push_back("flipped triangles in the map: "
                              + std::to_string(report.distortion.flipped_faces) + " of "
                              + std::to_string(solver.faces));
  }
}

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
  Mesh mesh = read_chart(options, progress, report);
  report.seconds_read = reading.seconds();

  const Stopwatch working;
  Uv_map uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  std::optional<Level_snapshots> snapshots;
  if(files.pictures) {
    snapshots.emplace(mesh);
  }
  solve(options, mesh, uv, snapshots ? &*snapshots : nullptr, progress, report.solver);
  Similarity to_result;
  if(options.pins.empty()) {
    to_result = fit_to_unit_square(mesh, uv, report.solver);
  }
  report.seconds_total = working.seconds();
  const Stopwatch measuring;
  report.distortion = SMP::measure_distortion(mesh, uv);
  report.seconds_measure = measuring.seconds();
  add_warnings(report);

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
  if(!options.is_quiet) {
    print(report, options);
  }
  return 0;
}

} // namespace hlscm
