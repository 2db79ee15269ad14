// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CHART_SOLVING_H
#define HLSCM_PROGRAM_CHART_SOLVING_H

#include "pictures/Level_snapshots.h"
#include "common/Mesh.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"

#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <string>
#include <vector>

namespace hlscm {

/// Reads a mesh that can be parameterized, or throws `Program_error`.
Mesh read_chart(const std::string& input, Progress_bar& progress,
                std::vector<std::string>& warnings);

struct Solved_chart
{
  CGAL::Surface_mesh_parameterization::HLSCM_report report;
  /// Empty unless the options of the library keep it.
  CGAL::Surface_mesh_parameterization::Chart_progressive_mesh progressive_mesh;
};

/// Parameterizes a chart with the pins of the program's options; throws `Program_error`. Where the
/// default method finds no exact map, and the user has set neither a method nor limits, it is the map
/// of the direct method, which has no progressive mesh, and a warning says so.
Solved_chart solve_chart(const Program_options& options,
                         CGAL::Surface_mesh_parameterization::HLSCM_options library,
                         const Mesh& mesh, Uv_map uv, Progress_bar& progress);

/// Moves the map into the unit square, as large as possible without turning it.
Similarity fit_to_unit_square(const Mesh& mesh, Uv_map uv,
                              CGAL::Surface_mesh_parameterization::HLSCM_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_CHART_SOLVING_H
