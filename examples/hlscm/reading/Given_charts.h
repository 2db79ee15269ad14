// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GIVEN_CHARTS_H
#define HLSCM_PROGRAM_GIVEN_CHARTS_H

#include "common/Program_options.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <optional>

namespace hlscm {

/// Returns the charts of a surface that the options give, if they do: between patches named by
/// numbers in a file, one for each face, between the seams of the surface's own texture coordinates, or one for each
/// connected component. Throws `Program_error`.
std::optional<CGAL::Surface_mesh_texturing::Face_charts>
given_charts(const Input_surface& surface, const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_GIVEN_CHARTS_H
