// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H
#define HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H

#include "commands/Levels_report.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "reading/Surface_reading.h"
#include "writing/Level_of_detail.h"

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <functional>

namespace hlscm {

/// Decimates a textured mesh with the threads of the options; throws `Program_error`.
Progressive_model
build_progressive(const CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh& mesh,
                  const Program_options& options, Progress_bar& progress);

/// Changes the texture coordinates of a file before they are used.
using Texture_change = std::function<CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh(
    const Input_surface&, CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh)>;

/// Reads the input, a progressive mesh or any other, and makes a progressive mesh of it; what has no
/// texture coordinates is parameterized first. Fills what the report says of that; throws
/// `Program_error`.
Progressive_model make_progressive(const Program_options& options, Progress_bar& progress,
                                   Levels_report& report, const Texture_change& change = {});

/// The position of the coarsest level whose error is within a length.
std::size_t position_within(const Progressive_model& model,
                            CGAL::Surface_mesh_multiresolution::Level_error kind,
                            const Length& length);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H
