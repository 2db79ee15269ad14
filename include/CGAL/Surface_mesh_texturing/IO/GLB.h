// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_GLB_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_GLB_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Glb_placement.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Uv_pairs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

template <class Vector>
std::array<float, 3> to_floats(const Vector& v)
{
  return {float(v.x()), float(v.y()), float(v.z())};
}

// The origin of glTF's textures is their upper left corner.
inline std::array<float, 2> to_gltf_uv(const Textured_triangle_mesh::Point_2& uv)
{
  return {float(uv.x()), float(1 - uv.y())};
}

// Whether the numbers of a mesh stay finite as floats.
inline bool are_within_floats(const std::vector<Textured_triangle_mesh::Point_3>& points,
                              const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  const auto is_within = [](double x) {
    return std::abs(x) <= double((std::numeric_limits<float>::max)());
  };
  return std::all_of(points.begin(), points.end(), [&](const Textured_triangle_mesh::Point_3& p) {
           return is_within(p.x()) && is_within(p.y()) && is_within(p.z());
         })
      && std::all_of(uv.begin(), uv.end(), [&](const Textured_triangle_mesh::Point_2& p) {
           return is_within(p.x()) && is_within(1. - p.y());
         });
}

// Composes the file of a model.
class Glb_of_model
{
public:
  explicit Glb_of_model(const Textured_model& model)
    : m_model(model), m_placement(model.mesh.triangles, [&model](Vertex_index v) -> const auto& {
        return model.mesh.points[v];
      })
  {
    if(has_base())
      m_pairs = pair_up(model);
  }

  bool write(std::ostream& os)
  {
    add_vertices();
    const bool has_tangents = !m_model.frames.corners.empty();
    const auto& corners = has_base()    ? m_pairs.corners
                          : has_tangents ? m_model.frames.corners
                                         : m_model.mesh.wedges;
    std::vector<std::vector<Triangle_indices>> triangles(
      (std::max<std::size_t>)(m_model.materials.size(), 1));
    for(std::size_t t = 0; t < corners.size(); ++t)
      triangles[page_of(m_model, t)].push_back(corners[t]);
    std::vector<std::string> primitives;
    for(std::size_t page = 0; page < triangles.size(); ++page)
      if(!triangles[page].empty()) {
        const int indices = m_glb.add_triangles(triangles[page]);
        primitives.push_back(m_glb.primitive(m_attributes, indices, add_material(page)));
      }
    m_glb.add_node(m_model.name, m_glb.add_mesh(m_model.name, primitives),
                   m_placement.json());
    return m_glb.write(os);
  }

private:
  bool has_base() const { return !m_model.base_wedges.empty(); }

  // One for each wedge, for each frame, or for each pair of texture coordinates.
  std::vector<Tangent_frame> vertices() const
  {
    if(has_base())
      return m_pairs.vertices;
    if(!m_model.frames.corners.empty())
      return m_model.frames.frames;
    std::vector<Tangent_frame> result;
    for(const Vertex_index v : vertices_of_wedges(m_model.mesh))
      result.push_back({v, Vertex_index(result.size()), Vector_3(0., 0., 0.), 1.});
    return result;
  }

  // Directions stay as they are: green is up in the picture on both sides.
  void add_vertices()
  {
    const Textured_triangle_mesh& mesh = m_model.mesh;
    const std::vector<Vector_3> made
      = m_model.frames.normals.empty() ? vertex_normals(mesh.points, mesh.triangles)
                                       : std::vector<Vector_3>();
    const std::vector<Vector_3>& all_normals = made.empty() ? m_model.frames.normals : made;
    std::vector<std::array<float, 3>> points, normals;
    std::vector<std::array<float, 2>> uv;
    std::vector<std::array<float, 4>> tangents;
    for(const Tangent_frame& v : vertices()) {
      points.push_back(m_placement.position(mesh.points[v.vertex]));
      normals.push_back(to_floats(all_normals[v.vertex]));
      uv.push_back(to_gltf_uv(mesh.uv[v.wedge]));
      const auto t = to_floats(v.tangent);
      tangents.push_back({t[0], t[1], t[2], float(v.sign)});
    }
    const std::size_t n = points.size();
    m_attributes["POSITION"] = m_glb.add_positions(m_glb.add_vertices(points), points, n);
    m_attributes["NORMAL"] = m_glb.add_vectors(m_glb.add_vertices(normals), n, "VEC3");
    m_attributes[has_base() ? "TEXCOORD_1" : "TEXCOORD_0"]
      = m_glb.add_vectors(m_glb.add_vertices(uv), n, "VEC2");
    if(has_base()) {
      for(std::size_t i = 0; i < n; ++i)
        uv[i] = to_gltf_uv(m_model.base_uv[m_pairs.base[i]]);
      m_attributes["TEXCOORD_0"] = m_glb.add_vectors(m_glb.add_vertices(uv), n, "VEC2");
    }
    if(!m_model.frames.corners.empty())
      m_attributes["TANGENT"] = m_glb.add_vectors(m_glb.add_vertices(tangents), n, "VEC4");
  }

  int add_material(std::size_t page)
  {
    const Texture_material material
      = m_model.materials.empty() ? Texture_material() : m_model.materials[page];
    const int color = texture(material.color), normal_map = texture(material.normal_map);
    return m_glb.add_material(material_name(page), color, normal_map, has_base() ? 1 : 0);
  }

  // Each picture is stored once.
  int texture(std::size_t number)
  {
    if(number == Texture_material::none)
      return -1;
    const auto [found, is_new] = m_textures.insert({number, 0});
    if(is_new)
      found->second = m_glb.add_texture(m_model.textures[number].png);
    return found->second;
  }

  const Textured_model& m_model;
  Uv_pairs m_pairs; // if there are two sets of texture coordinates
  Glb_placement m_placement;
  Glb_builder m_glb;
  std::map<std::string, int> m_attributes;
  std::map<std::size_t, int> m_textures;
};

// Composes the file of the levels of a progressive mesh, the finest first.
class Glb_of_levels
{
public:
  typedef Surface_mesh_multiresolution::Textured_progressive_mesh Textured_progressive_mesh;
  typedef std::vector<std::vector<Triangle_indices>> Levels;

  Glb_of_levels(const Textured_progressive_mesh& mesh, const Levels& levels)
    : m_mesh(mesh), m_levels(levels)
  {}

  bool can_be_written() const
  {
    std::size_t bound = m_mesh.uv.size();
    for(const std::vector<Triangle_indices>& level : m_levels) {
      if(level.empty() || !indices_are_below(level, bound))
        return false;
      bound = number_of_wedges(level);
    }
    const std::size_t points = m_mesh.points.size();
    return !m_levels.empty() && m_mesh.vertex.size() == m_mesh.uv.size()
        && std::all_of(m_mesh.vertex.begin(), m_mesh.vertex.end(),
                       [points](Vertex_index v) { return v < points; })
        && indices_are_below(m_mesh.progressive_mesh.triangles, m_mesh.uv.size())
        && are_within_floats(m_mesh.points, m_mesh.uv);
  }

  bool write(std::ostream& os, const Texture_file& color)
  {
    const int texture = color.png.empty() ? -1 : m_glb.add_texture(color.png);
    const int material = m_glb.add_material(color.name, texture, -1);
    const Glb_placement placement(m_levels[0], [this](Vertex_index w) -> const auto& {
      return m_mesh.points[m_mesh.vertex[w]];
    });
    add_vertices(placement);
    for(const std::vector<Triangle_indices>& level : m_levels) {
      const std::string name = std::to_string(level.size()) + " triangles";
      m_meshes.push_back(m_glb.add_mesh(name, {primitive(level, material)}));
    }
    for(std::size_t i = 0; i < m_levels.size(); ++i)
      m_glb.add_node(std::to_string(m_levels[i].size()) + " triangles", m_meshes[i],
                     placement.json(), i == 0 ? links() : std::string());
    if(m_levels.size() > 1)
      m_glb.use_extension("MSFT_lod");
    return m_glb.write(os);
  }

private:
  // A level has the first ones of the finer level.
  static std::size_t number_of_wedges(const std::vector<Triangle_indices>& level)
  {
    Vertex_index largest = 0;
    for(const Triangle_indices& t : level)
      largest = (std::max)({largest, t[0], t[1], t[2]});
    return std::size_t(largest) + 1;
  }

  // Of the fine surface, whatever the level: coarse models look smoother than they are.
  std::vector<Vector_3> fine_normals() const
  {
    std::vector<Triangle_indices> triangles = m_mesh.progressive_mesh.triangles;
    for(Triangle_indices& t : triangles)
      for(Vertex_index& w : t)
        w = m_mesh.vertex[w];
    return vertex_normals(m_mesh.points, triangles);
  }

  // Those of the finest level
  void add_vertices(const Glb_placement& placement)
  {
    const std::vector<Vector_3> all_normals = fine_normals();
    std::vector<std::array<float, 3>> normals;
    std::vector<std::array<float, 2>> uv;
    const std::size_t n = number_of_wedges(m_levels[0]);
    for(std::size_t w = 0; w < n; ++w) {
      m_points.push_back(placement.position(m_mesh.points[m_mesh.vertex[w]]));
      normals.push_back(to_floats(all_normals[m_mesh.vertex[w]]));
      uv.push_back(to_gltf_uv(m_mesh.uv[w]));
    }
    m_point_view = m_glb.add_vertices(m_points);
    m_normal_view = m_glb.add_vertices(normals);
    m_uv_view = m_glb.add_vertices(uv);
  }

  std::string primitive(const std::vector<Triangle_indices>& level, int material)
  {
    const std::size_t n = number_of_wedges(level);
    std::map<std::string, int> attributes;
    attributes["POSITION"] = m_glb.add_positions(m_point_view, m_points, n);
    attributes["NORMAL"] = m_glb.add_vectors(m_normal_view, n, "VEC3");
    attributes["TEXCOORD_0"] = m_glb.add_vectors(m_uv_view, n, "VEC2");
    const int indices = m_glb.add_triangles(level);
    return m_glb.primitive(attributes, indices, material);
  }

  // What the node of the finest level says of the others.
  std::string links() const
  {
    constexpr double screen_pixels = 1920. * 1080., pixels_of_a_triangle = 8.;
    if(m_levels.size() < 2)
      return {};
    std::vector<std::string> ids, coverages;
    for(std::size_t i = 1; i < m_levels.size(); ++i) {
      ids.push_back(std::to_string(i));
      const double seen = double(m_levels[i].size()) / 2; // half face away
      coverages.push_back(
        json_number((std::min)(1., seen * pixels_of_a_triangle / screen_pixels)));
    }
    coverages.push_back("0.0"); // the last one is never hidden
    return "\"extensions\":{\"MSFT_lod\":{\"ids\":" + json_list(ids)
         + "}},\"extras\":{\"MSFT_screencoverage\":" + json_list(coverages) + "},";
  }

  const Textured_progressive_mesh& m_mesh;
  const Levels& m_levels;
  Glb_builder m_glb;
  std::vector<std::array<float, 3>> m_points;
  std::vector<int> m_meshes;
  int m_point_view = -1, m_normal_view = -1, m_uv_view = -1;
};

} // namespace internal

namespace IO {

/*!
\ingroup PkgHLSCMTextureFiles

Writes a model as glTF 2.0 in one binary file (GLB), its pictures in it: a vertex for each texture
coordinate, or for each of `model.frames.frames` if there are tangents, and a primitive with a
material for each page that has triangles. A second set of texture coordinates is TEXCOORD_1; see
`Textured_model`. If the model has no normals, they are those of
`vertex_normals()`. Numbers are rounded to floats. Where that would move points by more than a
thousandth of the mean edge, as far from the origin, positions are relative to the centre of the
bounding box, and the node has the translation (and, for boxes smaller than 2^-60 or larger than
2^60, the scale) to their place.

\return `false` if `os` did not take all, or, before anything is written, if an invariant of the
model does not hold, a number does not fit in a float, or the file would be longer than 4 GB.

Linear time; the file is composed in memory. `os` must not change bytes: open files with
`std::ios::binary`.
*/
CGAL_HLSCM_INLINE bool write_GLB(std::ostream& os, const Textured_model& model);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE bool write_GLB(std::ostream& os, const Textured_model& model)
{
  return internal::can_be_written(model) && !model.mesh.triangles.empty()
      && internal::are_within_floats(model.mesh.points, model.mesh.uv)
      && internal::are_within_floats(model.mesh.points, model.base_uv)
      && internal::Glb_of_model(model).write(os);
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh without pictures.
inline bool write_GLB(std::ostream& os, const Textured_triangle_mesh& mesh)
{
  Textured_model model;
  model.name = "mesh";
  model.mesh = mesh;
  return write_GLB(os, model);
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh with one texture coordinate for each vertex.
inline bool write_GLB(std::ostream& os, const Indexed_triangle_mesh& mesh,
                      const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  return write_GLB(os, Textured_triangle_mesh{mesh.points, mesh.triangles, uv, mesh.triangles});
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for a mesh of any type; the parameters are those of `write_OBJ()`.
template <class TriangleMesh, class UVMap,
          class NamedParameters = parameters::Default_named_parameters>
bool write_GLB(std::ostream& os, const TriangleMesh& mesh, UVMap uvmap,
               const NamedParameters& np = parameters::default_values())
{
  return write_GLB(os, internal::textured_mesh_of(mesh, uvmap, np));
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes levels of detail as one GLB file: the nodes of the extension MSFT_lod, with one texture and
one buffer of vertices, as each level has the first vertices of the next finer one. Viewers that do
not know the extension show the finest. MSFT_screencoverage changes to the next level when that has
a triangle for every eight pixels of a screen of 1920 x 1080.

\param os the stream
\param mesh the progressive mesh
\param levels the triangles of whole levels, as `Level_extractor::triangles()` returns them, the
       finest first
\param color the colors, whose name becomes that of the material; no texture if it has no bytes

\return `false` for the same reasons as above, or if there is no level, or they are not in order.
*/
CGAL_HLSCM_INLINE bool
write_GLB(std::ostream& os, const Surface_mesh_multiresolution::Textured_progressive_mesh& mesh,
          const std::vector<std::vector<Triangle_indices>>& levels, const Texture_file& color);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE bool
write_GLB(std::ostream& os, const Surface_mesh_multiresolution::Textured_progressive_mesh& mesh,
          const std::vector<std::vector<Triangle_indices>>& levels, const Texture_file& color)
{
  internal::Glb_of_levels file(mesh, levels);
  return file.can_be_written() && file.write(os, color);
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

/*!
\ingroup PkgHLSCMTextureFiles

Writes a GLB file: calls the overload with a stream for what follows the name.

\return `false` also if the file cannot be created or written; what it held before is lost then.
*/
template <class... Input>
bool write_GLB(const std::string& filename, const Input&... input)
{
  return internal::write_file(filename, [&](std::ostream& os) { return write_GLB(os, input...); });
}

} // namespace IO
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_GLB_H
