// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_PLY_HEADER_H
#define CGAL_INDEXED_MESH_PLY_HEADER_H

#include <cstddef>
#include <string>
#include <string_view>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the header of a binary, little endian PLY file of vertices with texture coordinates,
/// which are there twice: viewers read either s and t, as floats, or texture_u and texture_v. A
/// face has a number of corners of the given type, and these as ints.
inline std::string ply_header_with_uv(std::size_t vertices, std::size_t faces,
                                      std::string_view corner_type = "uchar")
{
  return "ply\nformat binary_little_endian 1.0\n"
         "comment texture_u, texture_v are the texture coordinates; s, t are the same, rounded\n"
         "element vertex " + std::to_string(vertices)
         + "\nproperty double x\nproperty double y\nproperty double z\n"
           "property double texture_u\nproperty double texture_v\n"
           "property float s\nproperty float t\n"
           "element face " + std::to_string(faces)
         + "\nproperty list " + std::string(corner_type) + " int vertex_indices\nend_header\n";
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_PLY_HEADER_H
