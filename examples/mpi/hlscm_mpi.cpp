// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// `mpirun -n 4 hlscm-mpi parameterize IN.ply -o OUT.ply`: the map of a chart by several processes,
// on one machine or many that see the same files.

#include "common/Interruption.h"
#include "common/Program_error.h"
#include "writing/Output_files.h"

#include <CGAL/Surface_mesh_parameterization/map_distributed_chart.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
using hlscm::Interruption::is_requested;
using Report = SMP::Distributed_chart_report;

struct Options
{
  std::string input, output, report;
  SMP::Very_large_chart_options library;
  bool is_quiet = false;
};

// The exit code, if the program is to end.
std::optional<int> parse(int argc, char** argv, bool is_first, Options& options)
{
  CLI::App app("Map charts that are distributed over the ranks of MPI", "hlscm-mpi");
  app.require_subcommand(1);
  CLI::App* const run = app.add_subcommand("parameterize", "Map a chart to the plane");
  run->add_option("IN", options.input,
                  "a binary PLY file: one surface of triangles with a border, without handles")
      ->required();
  run->add_option("-o,--output", options.output, "the same with texture coordinates, .ply")
      ->required();
  run->add_option("--report", options.report, "a report as JSON");
  run->add_option("--tolerance", options.library.solver.tolerance,
                  "the energy is at most this part above its minimum (default 0.01)")
      ->check(CLI::PositiveNumber);
  run->add_option("--max-iterations", options.library.solver.maximal_iterations,
                  "iterations on the finest level at most");
  run->add_option(
         "--memory", options.library.memory,
         "of the first rank, such as 4G (default): coarse levels of up to 300000 vertices that fit "
         "are its own")
      ->transform(CLI::AsSizeValue(false))
      ->type_name("SIZE");
  run->add_option("--work-folder", options.library.work_folder,
                  "where each rank keeps its finished levels (default: OUT.ply.work)");
  run->add_flag("--resume", options.library.resumes,
                "go on from the levels that a run of as many ranks has finished there");
  run->add_flag("-q,--quiet", options.is_quiet, "print nothing but errors");
  try {
    app.parse(argc, argv);
    if(std::filesystem::path(options.output).extension() != ".ply") {
      throw CLI::ValidationError("--output", "it must be .ply");
    }
    if(options.library.work_folder.empty()) {
      options.library.work_folder = options.output + ".work";
    }
  } catch(const CLI::ParseError& e) {
    return is_first ? app.exit(e) : e.get_exit_code();
  }
  return std::nullopt;
}

std::string to_json(const Report& report, const Options& options)
{
  using Json = nlohmann::ordered_json;
  const SMP::HLSCM_report& s = report.solver;
  Json ranks = Json::array(), levels = Json::array();
  for(const SMP::Rank_report& rank : report.ranks) {
    ranks.push_back({{"vertices", rank.vertices},
                     {"peak_memory_mb", double(rank.peak_memory) / 1048576.},
                     {"bytes_sent", rank.bytes_sent},
                     {"messages", rank.messages}});
  }
  for(const auto& level : s.levels) {
    levels.push_back({{"vertices", level.vertices}, {"iterations", level.iterations}});
  }
  const Json json = {{"input", options.input},
                     {"output", options.output},
                     {"tolerance", options.library.solver.tolerance},
                     {"vertices", s.vertices},
                     {"faces", s.faces},
                     {"borders", s.borders},
                     {"blocks", report.blocks},
                     {"distributed_levels", report.levels_in_files},
                     {"levels_finished_before", report.finished_before},
                     {"level_table", levels},
                     {"iterations", s.iterations},
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
                     {"ranks", ranks},
                     {"warnings", s.warnings}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print(const Report& report)
{
  const SMP::HLSCM_report& s = report.solver;
  std::size_t memory = 0, bytes = 0, messages = 0;
  for(const SMP::Rank_report& rank : report.ranks) {
    memory = std::max(memory, rank.peak_memory);
    bytes += rank.bytes_sent;
    messages += rank.messages;
  }
  std::cout << s.vertices << " vertices, " << s.faces << " faces, " << report.ranks.size()
            << " ranks\nlevels: " << s.levels.size() << ", " << report.levels_in_files
            << " of them distributed, "
            << (report.finished_before > 0
                    ? std::to_string(report.finished_before) + " from an earlier run, "
                    : std::string())
            << "the finest in " << report.blocks << " blocks\n"
            << s.iterations << " iterations, energy " << s.energy << ", about "
            << s.energy_gap_estimate << " above the minimum, " << report.flipped_faces
            << " flipped faces\nseconds: " << s.seconds_total << " = sort " << report.seconds_sort
            << " + decimate " << s.seconds_hierarchy << " + levels in memory "
            << s.seconds_operators << " + solve " << s.seconds_solve
            << "\nof a rank: " << memory / 1048576 << " MB of memory at most; sent "
            << bytes / 1000000 << " MB in " << messages << " messages\n";
}

void say_error(const std::string& sentence)
{
  std::fprintf(stderr, "hlscm-mpi: error: %s\n", sentence.c_str());
}

// What the first rank writes.
struct Outputs
{
  hlscm::Output_files files;
  hlscm::Output_file* map = nullptr;
  hlscm::Output_file* report = nullptr;

  explicit Outputs(const Options& options)
  {
    for(const std::string& name : {options.output, options.report}) {
      hlscm::refuse_to_overwrite(options.input, name);
    }
    if(!options.report.empty()) {
      report = &files.create(options.report);
    }
    map = &files.create(options.output);
  }

  void finish(const Report& result, const Options& options)
  {
    if(report != nullptr) {
      report->put(to_json(result, options));
    }
    hlscm::Interruption::finish();
    files.commit();
  }
};

int run(Options& options, bool is_first)
{
  std::optional<Outputs> outputs;
  if(is_first) {
    try {
      outputs.emplace(options);
    } catch(const hlscm::Program_error& e) {
      say_error(e.what());
    }
  }
  int begins = outputs ? 1 : 0;
  MPI_Bcast(&begins, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if(begins == 0) {
    return 1;
  }
  SMP::Very_large_chart_options& library = options.library;
  library.solver.threads = 1; // there is a rank for each processor
  library.finish = [&](const SMP::Very_large_chart_report& report) {
    outputs->finish(static_cast<const Report&>(report), options);
  };
  library.solver.progress = [](double) { return !hlscm::Interruption::is_requested(); };
  const Report report = SMP::map_distributed_chart(
      MPI_COMM_WORLD, options.input, [&](std::string_view bytes) { outputs->map->put(bytes); },
      library);
  if(report.error != SMP::OK) {
    if(is_first && report.solver.cancelled) {
      hlscm::Interruption::say_cancelled();
    } else if(is_first) {
      const bool is_named = report.message.rfind(options.input, 0) == 0;
      say_error(is_named ? report.message : options.input + ": " + report.message);
    }
    return 1;
  }
  if(is_first) {
    for(const std::string& warning : report.solver.warnings) {
      std::cerr << "hlscm-mpi: warning: " << options.input << ": " << warning << '\n';
    }
    if(!options.is_quiet) {
      print(report);
    }
  }
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  int rank = 0, exit_code = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const bool is_first = rank == 0;
  if(is_first) {
    hlscm::Interruption::install();
  }
  Options options;
  try {
    const std::optional<int> ended = parse(argc, argv, is_first, options);
    exit_code = ended ? *ended : run(options, is_first);
  } catch(const std::exception& e) { // of the first rank, which writes
    say_error(e.what());
  } catch(const hlscm::Cancelled&) {
    hlscm::Interruption::say_cancelled();
  }
  PetscBool has_begun = PETSC_FALSE;
  if(PetscInitialized(&has_begun) == 0 && has_begun) {
    PetscFinalize();
  }
  MPI_Finalize();
  hlscm::Interruption::end_process(exit_code);
}
