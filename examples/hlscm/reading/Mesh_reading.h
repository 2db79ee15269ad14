// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_READING_H
#define HLSCM_PROGRAM_MESH_READING_H

#include "common/Polygon_soup.h"
#include "common/Progress_bar.h"

#include <string>
#include <vector>

namespace hlscm {

/// A file read as it is: nothing merged (but the corners of STL triangles), nothing reordered.
struct Read_mesh
{
  Polygon_soup soup;
  std::vector<std::string> warnings;
};

/// Reads .off, .obj, .ply (ASCII and binary) or .stl (ASCII and binary).
///
/// CGAL's readers are not used here because a tool must name what is wrong with a file: they accept
/// an OBJ file that was cut short or has indices out of range, crash on a PLY file with integer
/// coordinates, cannot say which vertex is not a number, and cannot be interrupted. The tests
/// compare both on the same files.
Read_mesh read_mesh(const std::string& file_name, Progress_bar& progress);

/// The same from the bytes of the file, whose name tells the format.
Read_mesh read_mesh(const std::string& file_name, const char* begin, const char* end,
                    Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_READING_H
