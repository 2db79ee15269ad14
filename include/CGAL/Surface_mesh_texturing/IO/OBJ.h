// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_OBJ_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_OBJ_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>
#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A line of a text file: a keyword and numbers, in their shortest form or with so many digits behind the point.
template <class... Digits>
void put_line(Byte_output& out, std::string_view keyword, std::initializer_list<double> numbers,
              Digits... digits)
{
  out.put(keyword);
  for(const double x : numbers) {
    out.put(" ");
    out.put_text(x, digits...);
  }
  out.put("\n");
}

inline void put_obj_vertices(Byte_output& out,
                             const std::vector<Textured_triangle_mesh::Point_3>& points,
                             const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  out.put_each(points.size(), [&](Byte_output& lines, std::size_t v) {
    put_line(lines, "v", {points[v].x(), points[v].y(), points[v].z()});
  });
  out.put_each(uv.size(), [&](Byte_output& lines, std::size_t w) {
    put_line(lines, "vt", {uv[w].x(), uv[w].y()});
  });
}

// A corner v, v/vt, v//vn or v/vt/vn.
inline void put_obj_corner(Byte_output& out, Vertex_index v, std::uint32_t uv, std::uint32_t normal)
{
  out.put(" ");
  out.put_text(v + std::size_t(1));
  if(uv == no_vertex && normal == no_vertex)
    return;
  out.put("/");
  if(uv != no_vertex)
    out.put_text(uv + std::size_t(1));
  if(normal == no_vertex)
    return;
  out.put("/");
  out.put_text(normal + std::size_t(1));
}

// The corners v/vt, or v/vt/vn with normals of vertices.
inline void put_obj_face(Byte_output& out, const Triangle_indices& vertices,
                         const Triangle_indices& wedges, bool has_normals)
{
  out.put("f");
  for(std::size_t c = 0; c < 3; ++c)
    put_obj_corner(out, vertices[c], wedges[c], has_normals ? vertices[c] : no_vertex);
  out.put("\n");
}

// The corners of a face of a soup.
inline void put_obj_face(Byte_output& out, const Indexed_mesh::Polygon_soup& soup,
                         const std::vector<std::uint32_t>& normal_corners, std::size_t f)
{
  out.put("f");
  for(std::uint32_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c)
    put_obj_corner(out, soup.corners[c], soup.has_uv() ? soup.uv_corners[c] : no_vertex,
                   normal_corners.empty() ? no_vertex : normal_corners[c]);
  out.put("\n");
}

inline bool write_obj(std::ostream& os, const std::vector<Textured_triangle_mesh::Point_3>& points,
                      const std::vector<Triangle_indices>& triangles,
                      const std::vector<Textured_triangle_mesh::Point_2>& uv,
                      const std::vector<Triangle_indices>& wedges)
{
  if(!can_be_written(points, triangles, uv, wedges))
    return false;
  Byte_output out(os);
  put_obj_vertices(out, points, uv);
  out.put_each(triangles.size(), [&](Byte_output& lines, std::size_t t) {
    put_obj_face(lines, triangles[t], wedges[t], false);
  });
  return out.finish();
}

} // namespace internal

namespace IO {

/*!
\ingroup PkgHLSCMTextureFiles

Writes a mesh with texture coordinates as OBJ: lines `v x y z` and `vt u v`, then `f v/vt v/vt
v/vt`, all in the order of the arrays. Numbers have the shortest form that reads back as the same
number, whatever precision and locale `os` has.

\return `false` if `os` did not take all, or, before anything is written, if an index is out of
range or a number not finite.

Linear time.
*/
inline bool write_OBJ(std::ostream& os, const Textured_triangle_mesh& mesh)
{
  return internal::write_obj(os, mesh.points, mesh.triangles, mesh.uv, mesh.wedges);
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh with one texture coordinate for each vertex.
inline bool write_OBJ(std::ostream& os, const Indexed_triangle_mesh& mesh,
                      const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  return internal::write_obj(os, mesh.points, mesh.triangles, uv, mesh.triangles);
}

/*!
\ingroup PkgHLSCMTextureFiles

The same for a mesh of any type, in the order of `vertices(mesh)` and `faces(mesh)`.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam UVMap a model of `ReadablePropertyMap` with the vertex descriptor as key, which gives each
        vertex one texture coordinate, or with the halfedge descriptor, which gives that of the
        corner at the target of each halfedge of a face; the value is a point with two coordinates.
        For a `Seam_mesh`: the map of its vertices that `SMP::parameterize()` fills
\param os the stream
\param mesh a mesh
\param uvmap its texture coordinates
\param np optional named parameters: `vertex_point_map` and `geom_traits`; see
       `Indexed_mesh::copy_points()`

\return `false` also if not all faces are triangles, or there are none.
*/
template <class TriangleMesh, class UVMap,
          class NamedParameters = parameters::Default_named_parameters>
bool write_OBJ(std::ostream& os, const TriangleMesh& mesh, UVMap uvmap,
               const NamedParameters& np = parameters::default_values())
{
  const Textured_triangle_mesh arrays = internal::textured_mesh_of(mesh, uvmap, np);
  return !arrays.triangles.empty() && write_OBJ(os, arrays);
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes a model with the name of its file of materials, `model.name` + ".mtl", its normals, if it has
some, and the material of each triangle. The other rules are those of the first overload.
*/
inline bool write_OBJ(std::ostream& os, const Textured_model& model)
{
  if(!internal::can_be_written(model))
    return false;
  internal::Byte_output out(os);
  out.put("mtllib " + model.name + ".mtl\n");
  internal::put_obj_vertices(out, model.mesh.points, model.mesh.uv);
  out.put_each(model.frames.normals.size(), [&](internal::Byte_output& lines, std::size_t i) {
    const Vector_3& n = model.frames.normals[i];
    internal::put_line(lines, "vn", {n.x(), n.y(), n.z()}, 6);
  });
  out.put_each(model.mesh.triangles.size(), [&](internal::Byte_output& lines, std::size_t t) {
    const std::uint32_t page = internal::page_of(model, t);
    if(t == 0 || page != internal::page_of(model, t - 1))
      lines.put("usemtl " + material_name(page) + "\n");
    internal::put_obj_face(lines, model.mesh.triangles[t], model.mesh.wedges[t],
                           !model.frames.normals.empty());
  });
  return out.finish();
}

/// \ingroup PkgHLSCMTextureFiles
/// What an OBJ file has beside vertices, faces and texture coordinates.
struct OBJ_details
{
  std::vector<Vector_3> normals;             ///< lines `vn`; may be empty
  std::vector<std::uint32_t> normal_corners; ///< for each corner of a face one of them; or empty
  /// Other lines, such as `usemtl wood`, without line feeds: each before the face of this number, or
  /// behind the last one. They are ascending.
  std::vector<std::pair<std::size_t, std::string>> lines;
};

/*!
\ingroup PkgHLSCMTextureFiles

Writes faces with any number of corners: lines `v`, `vt` and `vn`, then the faces in their order, with
the other lines between them; lines before the first face that begin with `mtllib` come first. A
corner whose entry in `soup.uv_corners` is `Indexed_mesh::no_vertex` has no texture coordinate.

\return `false` if `os` did not take all, or, before anything is written, if an index is out of range
or a number not finite.

Linear time.
*/
inline bool write_OBJ(std::ostream& os, const Indexed_mesh::Polygon_soup& soup,
                      const OBJ_details& details = OBJ_details())
{
  if(!internal::can_be_written(soup)
     || !internal::corners_are_below(details.normal_corners, soup, details.normals.size()))
    return false;
  internal::Byte_output out(os);
  auto line = details.lines.begin();
  for(; line != details.lines.end() && line->first == 0 && line->second.rfind("mtllib", 0) == 0; ++line)
    out.put(line->second + "\n");
  internal::put_obj_vertices(out, soup.points, soup.uv);
  out.put_each(details.normals.size(), [&](internal::Byte_output& lines, std::size_t n) {
    const Vector_3& normal = details.normals[n];
    internal::put_line(lines, "vn", {normal.x(), normal.y(), normal.z()});
  });
  std::size_t f = 0;
  const auto put_faces_before = [&](std::size_t end) {
    out.put_each(end - f, [&](internal::Byte_output& lines, std::size_t i) {
      internal::put_obj_face(lines, soup, details.normal_corners, f + i);
    });
    f = end;
  };
  for(; line != details.lines.end() && line->first <= soup.number_of_faces(); ++line) {
    put_faces_before((std::max)(f, line->first));
    out.put(line->second + "\n");
  }
  put_faces_before(soup.number_of_faces());
  return out.finish();
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes the materials of the OBJ file of a model, one a page: colors as `map_Kd`; the normal map as
`norm` and as `map_Bump`, of which programs know one or the other.

\return `false` if `os` did not take all, or an invariant of the model does not hold.
*/
inline bool write_MTL(std::ostream& os, const Textured_model& model)
{
  if(!internal::can_be_written(model))
    return false;
  internal::Byte_output out(os);
  for(std::size_t page = 0; page < model.materials.size(); ++page) {
    const Texture_material& material = model.materials[page];
    out.put("newmtl " + material_name(page) + "\n");
    out.put("Kd 0.8 0.8 0.8\nKs 0.2 0.2 0.2\nNs 40\n");
    if(material.color != Texture_material::none)
      out.put("map_Kd " + model.textures[material.color].name + "\n");
    if(material.normal_map != Texture_material::none) {
      const std::string& name = model.textures[material.normal_map].name;
      out.put("norm " + name + "\nmap_Bump " + name + "\n");
    }
  }
  return out.finish();
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes an OBJ file: calls the overload with a stream for what follows the name.

\return `false` also if the file cannot be created or written; what it held before is lost then.
*/
template <class... Input>
bool write_OBJ(const std::string& filename, const Input&... input)
{
  return internal::write_file(filename, [&](std::ostream& os) { return write_OBJ(os, input...); });
}

/// \ingroup PkgHLSCMTextureFiles
/// Writes a file of materials; the same for `write_MTL()`.
inline bool write_MTL(const std::string& filename, const Textured_model& model)
{
  return internal::write_file(filename, [&](std::ostream& os) { return write_MTL(os, model); });
}

} // namespace IO
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_OBJ_H
