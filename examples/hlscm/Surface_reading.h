// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SURFACE_READING_H
#define HLSCM_PROGRAM_SURFACE_READING_H

#include "Polygon_soup.h"
#include "Progress_bar.h"

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <string>
#include <vector>

namespace hlscm {

/// Reads a triangle mesh that is a surface, of any topology, or throws `Program_error`. Vertices of
/// no face are left out with a warning; the others, and the faces, keep their order.
Polygon_soup read_surface(const std::string& input, Progress_bar& progress,
                          std::vector<std::string>& warnings);

/// The triangles of a soup of triangles.
CGAL::Surface_mesh_multiresolution::Indexed_triangle_mesh to_indexed(const Polygon_soup& soup);

/// The same with their texture coordinates. Precondition: `soup.has_uv()`.
CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh to_textured(const Polygon_soup& soup);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SURFACE_READING_H
