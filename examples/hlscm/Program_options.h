// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRAM_OPTIONS_H
#define HLSCM_PROGRAM_PROGRAM_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hlscm {

enum class Command { INFO, PARAMETERIZE, LEVELS };

/// What `levels` writes: a file for each level, one with all levels, or the progressive mesh.
enum class Level_format { OBJ, PLY, GLB, PM };

/// A vertex of the input, counted from 0, and where it goes.
struct Pin
{
  std::size_t vertex;
  double u, v;
};

/// A length, or its part of the diagonal of the bounding box.
struct Length
{
  double value;
  bool is_relative;
};

struct Program_options
{
  Command command = Command::PARAMETERIZE;
  std::string input;
  bool is_quiet = false;
  bool prints_json = false; ///< of `info`

  std::string output;    ///< .obj or .ply; of `levels` a folder
  std::string report;    ///< empty: none
  std::string pictures;  ///< a folder; empty: none
  std::vector<Pin> pins; ///< none, or two and more
  CGAL::Surface_mesh_parameterization::HLSCM_options library;

  std::vector<std::size_t> faces;          ///< of the levels; empty: parts of all
  std::optional<Length> error;             ///< of the surface of one level more
  std::optional<Length> texture_error;     ///< of the texture of one level more
  std::vector<Level_format> formats;       ///< of the levels
  bool is_lossless = false;                ///< the progressive mesh
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
