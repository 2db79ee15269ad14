// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// `mpirun -n 4 hlscm-mpi parameterize IN.ply -o OUT.ply`: the map of a chart by several processes,
// on one machine or many that see the same files.

#include "commands/Very_large_report.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "writing/Output_files.h"

#include <CGAL/Surface_mesh_parameterization/map_distributed_chart.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
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
  const std::map<std::string, SMP::Conformal_method> methods
      = {{"hlscm", SMP::Conformal_method::HLSCM}, {"spectral", SMP::Conformal_method::SPECTRAL}};
  run->add_option("--method", options.library.solver.method,
                  "hlscm: under two pins that are far from each other (default); spectral: without "
                  "pins, by an eigenvalue problem")
      ->transform(CLI::CheckedTransformer(methods).description("hlscm|spectral"));
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

hlscm::Very_large_report of_run(const Report& report, const Options& options)
{
  return {report, options.input, options.output, options.library.solver.tolerance, true};
}

std::string to_json(const Report& report, const Options& options)
{
  nlohmann::ordered_json json = of_run(report, options).to_json();
  for(const SMP::Rank_report& rank : report.ranks) {
    json["ranks"].push_back({{"vertices", rank.vertices},
                             {"seconds_alone", rank.seconds_alone},
                             {"peak_memory_mb", double(rank.peak_memory) / 1048576.},
                             {"bytes_sent", rank.bytes_sent},
                             {"messages", rank.messages}});
  }
  return hlscm::text_of(json);
}

void print(const Report& report, const Options& options)
{
  const SMP::HLSCM_report& s = report.solver;
  const hlscm::Very_large_report said = of_run(report, options);
  std::size_t memory = 0, bytes = 0, messages = 0;
  double least = report.ranks.front().seconds_alone, most = least;
  for(const SMP::Rank_report& rank : report.ranks) {
    least = std::min(least, rank.seconds_alone);
    most = std::max(most, rank.seconds_alone);
    memory = std::max(memory, rank.peak_memory);
    bytes += rank.bytes_sent;
    messages += rank.messages;
  }
  std::cout << s.vertices << " vertices, " << s.faces << " faces, " << report.ranks.size()
            << " ranks\nlevels: " << said.levels() << '\n'
            << s.method << ", " << s.iterations << " iterations, energy " << said.energy() << ", "
            << report.flipped_faces << " flipped faces\nseconds: " << said.seconds(2)
            << "\nof a rank: " << least << " to " << most << " seconds before the iteration, "
            << memory / 1048576 << " MB of memory at most; sent " << bytes / 1000000 << " MB in "
            << messages << " messages\n";
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
      print(report, options);
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
