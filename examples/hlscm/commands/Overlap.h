// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_OVERLAP_H
#define HLSCM_PROGRAM_OVERLAP_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlscm {

/// Returns the number of texels of a texture, with so many of them on each page, whose centres lie
/// inside of more than one triangle.
std::size_t
overlapping_texels(const CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh& mesh,
                   const std::vector<std::uint32_t>& page, std::size_t width, std::size_t height);

} // namespace hlscm

#endif // HLSCM_PROGRAM_OVERLAP_H
