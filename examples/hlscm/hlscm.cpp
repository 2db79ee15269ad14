// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command-line program: `hlscm info IN` says what a mesh is, `hlscm parameterize IN -o OUT`
// maps it to the plane, `hlscm levels IN -o DIR` makes lighter models of it under one texture,
// `hlscm atlas IN -o DIR` gives any surface texture coordinates, and `hlscm bake IN -o DIR` makes a
// light model with a normal map.

#include "commands/Commands.h"
#include "common/Interruption.h"
#include "common/Program_error.h"

#include <cstdio>
#include <iostream>
#include <new>

namespace {

int run(const hlscm::Program_options& options)
{
  switch(options.command) {
  case hlscm::Command::INFO:
    return hlscm::run_info(options);
  case hlscm::Command::LEVELS:
    return hlscm::run_levels(options);
  case hlscm::Command::ATLAS:
    return hlscm::run_atlas(options);
  case hlscm::Command::BAKE:
    return hlscm::run_bake(options);
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

} // namespace

int main(int argc, char** argv)
{
  hlscm::Interruption::install();
  const hlscm::Parsed_command_line command_line = hlscm::parse_command_line(argc, argv);
  if(!command_line.options) {
    return after_output(command_line.exit_code);
  }
  const char* input = command_line.options->input.c_str();
  try {
    return after_output(run(*command_line.options));
  } catch(const hlscm::Cancelled&) {
    hlscm::Interruption::say_cancelled();
  } catch(const hlscm::Program_error& e) {
    std::fprintf(stderr, "hlscm: error: %s\n", e.what());
  } catch(const std::bad_alloc&) {
    std::fprintf(stderr,
                 "hlscm: error: %s: not enough memory, close other programs or split the mesh\n",
                 input);
  } catch(const std::exception& e) {
    std::fprintf(stderr,
                 "hlscm: error: %s: unexpected failure (%s), please report it with the mesh\n",
                 input, e.what());
  }
  return 1;
}
