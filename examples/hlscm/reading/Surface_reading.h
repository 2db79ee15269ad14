// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SURFACE_READING_H
#define HLSCM_PROGRAM_SURFACE_READING_H

#include "common/Program_error.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "reading/Diagnosis.h"
#include "reading/Mesh_reading.h"

#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <cmath>
#include <string>
#include <vector>

namespace hlscm {

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

/// A mesh file, and the surface that it is meant to be.
struct Input_surface
{
  Read_mesh file;
  Diagnosis diagnosis;                          ///< of the file
  CGAL::Indexed_mesh::Surface_of_soup surface; ///< an oriented manifold of triangles

  /// Whether it can be mapped as it is: connected, with a border and without handles.
  bool is_chart() const
  {
    return diagnosis.is_surface() && diagnosis.components == 1 && diagnosis.borders > 0
           && diagnosis.genus == 0;
  }
};

/// Reads a mesh file and merges vertices, if the options want that, with a warning that says so.
Read_mesh read_and_weld(const std::string& input, const Program_options& options,
                        Progress_bar& progress);

/// Reads any mesh and makes a surface of it, or throws `Program_error`: if there is no surface in it,
/// or if the options are strict and there are obstacles. Adds the warnings of the reader.
Input_surface read_surface(const std::string& input, const Program_options& options,
                           std::vector<Obstacle> (*obstacles)(const Diagnosis&),
                           Progress_bar& progress, std::vector<std::string>& warnings);

/// The surface with the texture coordinates of the file. Precondition: `file.soup.has_uv()`.
CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh to_textured(const Input_surface& input);

/// The file with a map of its surface in the place of its texture coordinates, `wedges[t][c]` for
/// corner c of triangle t. Faces along whose diagonals there are seams become triangles, with a
/// warning. Corners that have none get `no_vertex`.
Read_mesh with_map(Read_mesh file, const CGAL::Indexed_mesh::Surface_of_soup& surface,
                   std::vector<Polygon_soup::Point_2> uv,
                   const std::vector<CGAL::Indexed_mesh::Triangle_indices>& wedges,
                   std::vector<std::string>& warnings);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SURFACE_READING_H
