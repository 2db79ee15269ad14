// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command-line program: `hlscm info IN` says what a mesh is, `hlscm parameterize IN -o OUT`
// maps it to the plane, `hlscm levels IN -o DIR` makes lighter models of it under one texture,
// `hlscm atlas IN -o DIR` gives any surface texture coordinates, `hlscm bake IN -o DIR` makes a light
// model with a normal map, and `hlscm view IN -o OUT` shows any of these in a browser.

#include "commands/Commands.h"
#include "common/Blas.h"
#include "common/Interruption.h"
#include "common/Program_error.h"

#include <CGAL/Blocked_execution/blocked_for.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace {

int run(hlscm::Program_options options)
{
  const unsigned int processors = std::max(1u, std::thread::hardware_concurrency());
  if(options.library.threads > processors) { // of more, TBB prints that it has not so many
    options.library.threads = processors;
  }
  const bool factorizes_charts
      = options.command == hlscm::Command::ATLAS || options.command == hlscm::Command::BAKE;
  if(factorizes_charts) {
    options.library.threads = hlscm::reserve_blas_memory(options.library.threads);
  }
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
  switch(options.command) {
  case hlscm::Command::INFO:
    return hlscm::run_info(options);
  case hlscm::Command::LEVELS:
    return hlscm::run_levels(options);
  case hlscm::Command::ATLAS:
    return hlscm::run_atlas(options);
  case hlscm::Command::BAKE:
    return hlscm::run_bake(options);
  case hlscm::Command::VIEW:
    return hlscm::run_view(options);
  case hlscm::Command::WEB:
    return hlscm::run_web(options);
  case hlscm::Command::PARAMETERIZE:
    break;
  }
  return hlscm::run_parameterize(options);
}

// An error if what was printed did not arrive, which is known only now.
int after_output(int exit_code)
{
  std::cout.flush();
  if(exit_code != 0 || std::cout) {
    return exit_code;
  }
  std::fprintf(stderr, "hlscm: error: what was to be printed could not be written, make room or "
                       "choose another place for the standard output\n");
  return 1;
}

// TBB tells by the text of a failure only that it could not have a thread.
std::string sentence_of(const std::exception& e)
{
  const std::string what = e.what();
  return what.find("pthread_create") != std::string::npos
             ? "the system has no thread left, close other programs or use --threads 1"
             : "unexpected failure (" + what + "), please report it with the mesh";
}

} // namespace

int main(int argc, char** argv)
{
  std::string input = "the program";
  hlscm::end_blas_threads();
  try {
    hlscm::Interruption::install();
    const hlscm::Parsed_command_line command_line = hlscm::parse_command_line(argc, argv);
    int exit_code = command_line.exit_code;
    if(command_line.options) {
      input = command_line.options->input;
      exit_code = run(*command_line.options);
    }
    hlscm::Interruption::end_process(after_output(exit_code));
  } catch(const hlscm::Cancelled&) {
    hlscm::Interruption::say_cancelled();
  } catch(const hlscm::Program_error& e) {
    std::fprintf(stderr, "hlscm: error: %s\n", e.what());
  } catch(const std::bad_alloc&) {
    std::fprintf(stderr,
                 "hlscm: error: %s: not enough memory, close other programs or split the mesh\n",
                 input.c_str());
  } catch(const std::exception& e) {
    std::fprintf(stderr, "hlscm: error: %s: %s\n", input.c_str(), sentence_of(e).c_str());
  }
  hlscm::Interruption::end_process(1);
}
