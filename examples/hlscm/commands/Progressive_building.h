// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H
#define HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H

#include "writing/Level_of_detail.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

namespace hlscm {

/// Decimates a textured mesh with the threads of the options; throws `Program_error`.
Progressive_model
build_progressive(const CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh& mesh,
                  const Program_options& options, Progress_bar& progress);

/// The position of the coarsest level whose error is within a length.
std::size_t position_within(const Progressive_model& model,
                            CGAL::Surface_mesh_multiresolution::Level_error kind,
                            const Length& length);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRESSIVE_BUILDING_H
