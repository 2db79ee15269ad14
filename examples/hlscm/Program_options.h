// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRAM_OPTIONS_H
#define HLSCM_PROGRAM_PROGRAM_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

#include <optional>
#include <string>
#include <vector>

namespace hlscm {

enum class Command { INFO, PARAMETERIZE };

/// A vertex of the input, counted from 0, and where it goes.
struct Pin
{
  std::size_t vertex;
  double u, v;
};

struct Program_options
{
  Command command = Command::PARAMETERIZE;
  std::string input;
  bool is_quiet = false;
  bool prints_json = false; ///< of `info`

  std::string output;    ///< .obj or .ply
  std::string report;    ///< empty: none
  std::string pictures;  ///< a folder; empty: none
  std::vector<Pin> pins; ///< none, or two and more
  CGAL::Surface_mesh_parameterization::HLSCM_options library;
};

/// The options, or the exit code if there is nothing (more) to do: help was printed, or the usage
/// was wrong and that was said.
struct Parsed_command_line
{
  std::optional<Program_options> options;
  int exit_code = 0;
};

Parsed_command_line parse_command_line(int argc, char** argv);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRAM_OPTIONS_H
