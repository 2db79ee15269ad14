// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LAYOUT_BUILDING_H
#define HLSCM_PROGRAM_LAYOUT_BUILDING_H

#include "commands/Layout_report.h"
#include "common/Program_options.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/equal_parts.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace hlscm {

/// Returns the sides of the triangles that the options want to be seams, three bits each, between
/// groups or materials; empty if they want none. Throws `Program_error`.
std::vector<std::uint8_t> limits_of_charts(const Input_surface& surface,
                                           const Program_options& options, Layout_report& report);

/// Sets what the options say of densities and directions; throws `Program_error`.
void set_layout(const Input_surface& surface, const Program_options& options,
                CGAL::Surface_mesh_texturing::Texture_atlas_options& library);

/// Packs the charts of the input anew; throws `Program_error`.
CGAL::Surface_mesh_texturing::Texture_atlas_result
repack(const Input_surface& surface, const Program_options& options,
       const CGAL::Surface_mesh_texturing::Texture_atlas_options& library, Layout_report& report);

/// Returns which components are equal, if these shall share their place; then the arrays of `library`
/// are those of the representatives. Throws `Program_error`.
std::optional<CGAL::Surface_mesh_texturing::Equal_parts>
equal_parts(const Input_surface& surface, const Program_options& options,
            CGAL::Surface_mesh_texturing::Texture_atlas_options& library, Layout_report& report);

/// Measures what the options are about, if there are some.
void measure_layout(const Input_surface& surface,
                    const CGAL::Surface_mesh_texturing::Texture_atlas& atlas,
                    const Program_options& options, Layout_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LAYOUT_BUILDING_H
