// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_PLY_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_PLY_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>
#include <CGAL/Indexed_mesh/ply_header.h>
#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

inline void put_ply_header_with_corners(Byte_output& out, std::size_t vertices, std::size_t faces,
                                        std::string_view corner_type)
{
  out.put("ply\nformat binary_little_endian 1.0\ncomment texcoord has u and v of each corner\n"
          "element vertex ");
  out.put_text(vertices);
  out.put("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
  out.put_text(faces);
  for(const std::string_view property : {" int vertex_indices", " float texcoord"}) {
    out.put("\nproperty list ");
    out.put(corner_type);
    out.put(property);
  }
  out.put("\nend_header\n");
}

// The number of corners, or of texture coordinates, of a face.
inline void put_ply_count(Byte_output& out, std::size_t number, bool is_small)
{
  if(is_small)
    out.put_bytes(std::uint8_t(number));
  else
    out.put_bytes(std::uint32_t(number));
}

// For each vertex its only texture coordinate; empty if one has several, or none.
inline std::vector<std::uint32_t> uv_of_vertices(const Indexed_mesh::Polygon_soup& soup)
{
  std::vector<std::uint32_t> result(soup.points.size(), no_vertex);
  for(std::size_t c = 0; c < soup.uv_corners.size(); ++c) {
    std::uint32_t& uv = result[soup.corners[c]];
    if(soup.uv_corners[c] == no_vertex || (uv != no_vertex && uv != soup.uv_corners[c]))
      return {};
    uv = soup.uv_corners[c];
  }
  return soup.has_uv() ? result : std::vector<std::uint32_t>();
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
  out.put(Indexed_mesh::ply_header_with_uv(mesh.uv.size(), mesh.wedges.size()));
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

Writes faces with any number of corners, and vertices, in their order. If each vertex has one texture
coordinate, they are those of the vertices, as above; vertices of no face have (0, 0). Otherwise each
face has a list `texcoord` of the coordinates of its corners, as floats, which MeshLab reads; it is
empty for faces without.

\return as above

Linear time.
*/
inline bool write_PLY(std::ostream& os, const Indexed_mesh::Polygon_soup& soup)
{
  if(!internal::can_be_written(soup))
    return false;
  std::size_t most = 0;
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f)
    most = (std::max)(most, soup.face(f).size());
  const std::vector<std::uint32_t> uv_of_vertex = internal::uv_of_vertices(soup);
  const bool is_small = 2 * most < 256, has_vertices = !uv_of_vertex.empty();
  const std::string_view corner_type = is_small ? "uchar" : "uint";
  internal::Byte_output out(os);
  if(has_vertices)
    out.put(Indexed_mesh::ply_header_with_uv(soup.points.size(), soup.number_of_faces(),
                                             corner_type));
  else
    internal::put_ply_header_with_corners(out, soup.points.size(), soup.number_of_faces(),
                                          corner_type);
  for(std::size_t v = 0; v < soup.points.size(); ++v) {
    for(int k = 0; k < 3; ++k)
      out.put_bytes(soup.points[v][k]);
    if(!has_vertices)
      continue;
    const auto uv = uv_of_vertex[v] == no_vertex ? Indexed_mesh::Polygon_soup::Point_2(0., 0.)
                                                 : soup.uv[uv_of_vertex[v]];
    out.put_bytes(uv.x());
    out.put_bytes(uv.y());
    out.put_bytes(float(uv.x()));
    out.put_bytes(float(uv.y()));
  }
  for(std::uint32_t f = 0; f < soup.number_of_faces(); ++f) {
    const std::uint32_t begin = soup.first_corner[f], end = soup.first_corner[f + 1];
    internal::put_ply_count(out, end - begin, is_small);
    for(std::uint32_t c = begin; c < end; ++c)
      out.put_bytes(soup.corners[c]);
    if(has_vertices)
      continue;
    const bool has_uv = soup.has_uv()
      && std::find(soup.uv_corners.begin() + begin, soup.uv_corners.begin() + end, no_vertex)
         == soup.uv_corners.begin() + end;
    internal::put_ply_count(out, has_uv ? 2 * (end - begin) : 0, is_small);
    for(std::uint32_t c = begin; has_uv && c < end; ++c) {
      out.put_bytes(float(soup.uv[soup.uv_corners[c]].x()));
      out.put_bytes(float(soup.uv[soup.uv_corners[c]].y()));
    }
  }
  return out.finish();
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
