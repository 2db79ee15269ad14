// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CHART_SOLVING_H
#define HLSCM_PROGRAM_CHART_SOLVING_H

#include "pictures/Level_snapshots.h"
#include "common/Kernel.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"

#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <string>
#include <vector>

namespace hlscm {

/// The pins of the options; throws `Program_error` if a vertex is out of range or pinned twice, or if
/// all have the same place.
std::vector<CGAL::Surface_mesh_parameterization::HLSCM_pin>
checked_pins(const Program_options& options, std::size_t number_of_vertices);

/// Parameterizes a chart with the given pins, vertices of the mesh; throws `Program_error`. Where the
/// method is the program's choice and finds no exact map, and the user has set no limits, it is the
/// map of the direct method, which has no progressive mesh, and a warning says so.
CGAL::Surface_mesh_parameterization::Conformal_map
solve_chart(const Program_options& options,
            CGAL::Surface_mesh_parameterization::HLSCM_options library,
            CGAL::Indexed_mesh::Indexed_triangle_mesh mesh,
            const std::vector<CGAL::Surface_mesh_parameterization::HLSCM_pin>& pins,
            Progress_bar& progress);

/// Moves a map into the unit square, as large as possible without turning it.
Similarity fit_to_unit_square(std::vector<Kernel::Point_2>& uv);

/// Says the same of the pins and the energies of a report.
void move_report(const Similarity& similarity,
                 CGAL::Surface_mesh_parameterization::HLSCM_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_CHART_SOLVING_H
