// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_READING_H
#define HLSCM_PROGRAM_MESH_READING_H

#include "common/Progress_bar.h"

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hlscm {

using CGAL::Indexed_mesh::Polygon_soup;

/// A line of a file that is no vertex and no face, but belongs to the mesh: the name of an object, of
/// a group or of a material, smoothing.
struct Mesh_line
{
  std::size_t face; ///< it stands before this one, counted from 0; or their number
  std::string text; ///< as in an OBJ file, without a line feed
};

/// A file read as it is: nothing merged (but equal points of STL and glTF), nothing reordered.
struct Read_mesh
{
  Polygon_soup soup;
  std::vector<Polygon_soup::Point_3> normals; ///< of OBJ files; may be empty
  std::vector<std::uint32_t> normal_corners;  ///< of each corner one of `normals`, or empty
  std::vector<std::array<float, 3>> colours;  ///< of each point, of PLY files; may be empty
  std::vector<Mesh_line> lines;               ///< in the order of the file; of OBJ and glTF
  std::vector<std::string> warnings;
};

/// Reads .glb, .gltf, .off, .obj, .ply (text and binary) or .stl (text and binary), also packed by
/// gzip; from a file, from a pipe, or from the standard input by the name "-". The extension of the
/// name tells the format; of a pipe and of the standard input the content does.
///
/// CGAL's readers are not used here because a tool must name what is wrong with a file: they accept
/// an OBJ file that was cut short or has indices out of range, crash on a PLY file with integer
/// coordinates, cannot say which vertex is not a number, and cannot be interrupted. The tests
/// compare both on the same files.
Read_mesh read_mesh(const std::string& file_name, Progress_bar& progress);

/// The same from the bytes of the file.
Read_mesh read_mesh(const std::string& file_name, const char* begin, const char* end,
                    Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_READING_H
