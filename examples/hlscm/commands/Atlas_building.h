// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_ATLAS_BUILDING_H
#define HLSCM_PROGRAM_ATLAS_BUILDING_H

#include "commands/Layout_report.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <cstdint>
#include <vector>

namespace hlscm {

struct Built_atlas
{
  CGAL::Surface_mesh_texturing::Texture_atlas atlas;
  CGAL::Surface_mesh_texturing::Texture_atlas_report report;
  Layout_report layout;
  std::vector<std::uint32_t> packed; ///< the triangles that are in the place of no others; empty: all
};

/// Builds the atlas of a surface as the options want it; throws `Program_error`.
Built_atlas build_atlas(const Input_surface& surface, const Program_options& options,
                        Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_ATLAS_BUILDING_H
