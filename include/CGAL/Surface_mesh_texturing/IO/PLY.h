// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_PLY_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_PLY_H

#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

inline void put_ply_header(Byte_output& out, std::size_t vertices, std::size_t faces)
{
  out.put("ply\nformat binary_little_endian 1.0\n"
          "comment texture_u, texture_v are the texture coordinates; s, t are the same, rounded\n"
          "element vertex ");
  out.put_text(vertices);
  out.put(
    "\nproperty double x\nproperty double y\nproperty double z\n"
    "property double texture_u\nproperty double texture_v\nproperty float s\nproperty float t\n"
    "element face ");
  out.put_text(faces);
  out.put("\nproperty list uchar int vertex_indices\nend_header\n");
}

} // namespace internal

namespace IO {

/*!
\ingroup PkgHLSCMTextureFiles

Writes a mesh with texture coordinates as PLY, binary and little endian, with a vertex for each
texture coordinate and the triangles in their order. A vertex has x, y, z, texture_u and texture_v
as doubles, and s and t, which are the texture coordinate once more, rounded to floats: Blender
reads s and t only, MeshLab both pairs.

\return `false` if `os` did not take all, or, before anything is written, if an index is out of
range or a number not finite.

Linear time. `os` must not change bytes: open files with `std::ios::binary`.
*/
inline bool write_PLY(std::ostream& os, const Textured_triangle_mesh& mesh)
{
  if(!internal::can_be_written(mesh) || (mesh.points.empty() && !mesh.uv.empty()))
    return false;
  const std::vector<Vertex_index> vertex = vertices_of_wedges(mesh);
  internal::Byte_output out(os);
  internal::put_ply_header(out, mesh.uv.size(), mesh.wedges.size());
  for(std::size_t w = 0; w < mesh.uv.size(); ++w) {
    const auto& p = mesh.points[vertex[w]];
    const auto& uv = mesh.uv[w];
    for(const double x : {p.x(), p.y(), p.z(), uv.x(), uv.y()})
      out.put_bytes(x);
    out.put_bytes(float(uv.x()));
    out.put_bytes(float(uv.y()));
  }
  for(const Triangle_indices& t : mesh.wedges) {
    out.put_bytes(std::uint8_t(3));
    for(const Vertex_index w : t)
      out.put_bytes(w);
  }
  return out.finish();
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh with one texture coordinate for each vertex: its vertices in their order.
inline bool write_PLY(std::ostream& os, const Indexed_triangle_mesh& mesh,
                      const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  if(uv.size() != mesh.points.size())
    return false;
  return write_PLY(os, Textured_triangle_mesh{mesh.points, mesh.triangles, uv, mesh.triangles});
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh of any type; the parameters are those of `write_OBJ()`.
template <class TriangleMesh, class UVMap,
          class NamedParameters = parameters::Default_named_parameters>
bool write_PLY(std::ostream& os, const TriangleMesh& mesh, UVMap uvmap,
               const NamedParameters& np = parameters::default_values())
{
  const Textured_triangle_mesh arrays = internal::textured_mesh_of(mesh, uvmap, np);
  return !arrays.triangles.empty() && write_PLY(os, arrays);
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes a PLY file: calls the overload with a stream for what follows the name.

\return `false` also if the file cannot be created or written; what it held before is lost then.
*/
template <class... Input>
bool write_PLY(const std::string& filename, const Input&... input)
{
  return internal::write_file(filename, [&](std::ostream& os) { return write_PLY(os, input...); });
}

} // namespace IO
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_PLY_H
