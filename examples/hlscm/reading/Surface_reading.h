// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SURFACE_READING_H
#define HLSCM_PROGRAM_SURFACE_READING_H

#include "common/Program_error.h"
#include "common/Progress_bar.h"

#include <CGAL/Indexed_mesh/Polygon_soup.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <cmath>
#include <string>
#include <vector>

namespace hlscm {

using CGAL::Indexed_mesh::Polygon_soup;

/// Throws `Program_error` for points that a GLB file cannot hold: its numbers have 32 bits.
template <typename Points>
void refuse_beyond_floats(const std::string& input, const Points& points)
{
  for(std::size_t v = 0; v < points.size(); ++v) {
    for(int k = 0; k < 3; ++k) {
      if(!std::isfinite(float(points[v][k]))) {
        throw Program_error(input, "vertex " + std::to_string(v)
                                       + " has a coordinate too large for the numbers of 32 bits "
                                         "in a GLB file, scale the mesh down");
      }
    }
  }
}

/// Reads a triangle mesh that is a surface, of any topology, for a model that is written as a GLB
/// file, too, or throws `Program_error`. Vertices of no face are left out with a warning; the
/// others, and the faces, keep their order.
Polygon_soup read_surface(const std::string& input, Progress_bar& progress,
                          std::vector<std::string>& warnings);

/// The triangles of a soup of triangles.
CGAL::Indexed_mesh::Indexed_triangle_mesh to_indexed(const Polygon_soup& soup);

/// The same with their texture coordinates. Precondition: `soup.has_uv()`.
CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh to_textured(const Polygon_soup& soup);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SURFACE_READING_H
