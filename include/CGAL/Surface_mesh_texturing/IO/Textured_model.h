// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>
#include <CGAL/Surface_mesh_texturing/vertex_normals.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTextureFiles
/// The struct `Texture_file` is a picture to which a model refers.
struct Texture_file
{
  std::string name; ///< of the file, as seen from the file of the model
  std::string png;  ///< the bytes of the file, see `IO::write_PNG()`
};

/// \ingroup PkgHLSCMTextureFiles
/// The struct `Texture_material` says what lies on one page of an atlas.
struct Texture_material
{
  /// "No texture".
  static constexpr std::size_t none = std::size_t(-1);

  std::size_t color = none;      ///< the position of the colors among the textures of the model
  std::size_t normal_map = none; ///< that of the normal map, in the tangent space of the model
};

/*!
\ingroup PkgHLSCMTextureFiles

The struct `Textured_model` is a mesh with texture coordinates and all that files say beside it.

Invariant: `page` is empty, which stands for one page, or as long as `mesh.triangles`, with entries
smaller than `materials.size()`; the entries of `materials` are smaller than `textures.size()`, or
`none`; `frames.normals` is empty or has a vector for each vertex; `frames.corners` is empty or made
by `tangent_frames()` for this mesh.
*/
struct Textured_model
{
  std::string name;                        ///< of the model; of its file of materials without .mtl
  Textured_triangle_mesh mesh;             ///< the surface
  std::vector<std::uint32_t> page;         ///< of each triangle
  std::vector<Texture_material> materials; ///< of each page
  std::vector<Texture_file> textures;      ///< the pictures of all materials
  Tangent_frames frames;                   ///< normals of the vertices, and perhaps tangents
};

/// \ingroup PkgHLSCMTextureFiles
/// Returns for each triangle of an atlas its page. Linear time.
inline std::vector<std::uint32_t> pages_of_triangles(const Texture_atlas& atlas)
{
  std::vector<std::uint32_t> page;
  page.reserve(atlas.charts.chart.size());
  for(const std::uint32_t chart : atlas.charts.chart)
    page.push_back(atlas.page[chart]);
  return page;
}

/// \ingroup PkgHLSCMTextureFiles
/// Returns an atlas as a model with smooth normals and, for each page, a material without textures.
/// Linear time.
inline Textured_model textured_model(const Texture_atlas& atlas, const std::string& name = "atlas")
{
  Textured_model model;
  model.name = name;
  model.mesh = atlas.mesh;
  model.page = pages_of_triangles(atlas);
  model.materials.resize(atlas.number_of_pages);
  model.frames.normals = vertex_normals(atlas.mesh.points, atlas.mesh.triangles);
  return model;
}

namespace internal {

inline bool are_below(const std::vector<Triangle_indices>& triangles, std::size_t bound)
{
  return std::all_of(triangles.begin(), triangles.end(), [bound](const Triangle_indices& t) {
    return t[0] < bound && t[1] < bound && t[2] < bound;
  });
}

// Whether the arrays of a textured mesh fit together, with finite numbers.
inline bool can_be_written(const std::vector<Textured_triangle_mesh::Point_3>& points,
                           const std::vector<Triangle_indices>& triangles,
                           const std::vector<Textured_triangle_mesh::Point_2>& uv,
                           const std::vector<Triangle_indices>& wedges)
{
  return triangles.size() == wedges.size() && are_below(triangles, points.size())
      && are_below(wedges, uv.size())
      && std::all_of(points.begin(), points.end(), [](const Textured_triangle_mesh::Point_3& p) {
           return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
         })
      && std::all_of(uv.begin(), uv.end(), [](const Textured_triangle_mesh::Point_2& p) {
           return std::isfinite(p.x()) && std::isfinite(p.y());
         });
}

inline bool can_be_written(const Textured_triangle_mesh& mesh)
{
  return can_be_written(mesh.points, mesh.triangles, mesh.uv, mesh.wedges);
}

inline bool has_valid_frames(const Textured_model& model)
{
  const Tangent_frames& all = model.frames;
  const std::size_t points = model.mesh.points.size(), uv = model.mesh.uv.size();
  return (all.normals.empty() || all.normals.size() == points)
      && (all.corners.empty()
          || (all.corners.size() == model.mesh.triangles.size() && !all.normals.empty()
              && are_below(all.corners, all.frames.size())))
      && std::all_of(all.frames.begin(), all.frames.end(), [&](const Tangent_frame& f) {
           return f.vertex < points && f.wedge < uv;
         });
}

// Whether the invariants of a model hold.
inline bool can_be_written(const Textured_model& model)
{
  const auto is_texture = [&model](std::size_t number) {
    return number == Texture_material::none || number < model.textures.size();
  };
  const std::size_t pages = (std::max<std::size_t>)(model.materials.size(), 1);
  return can_be_written(model.mesh) && has_valid_frames(model)
      && (model.page.empty() || model.page.size() == model.mesh.triangles.size())
      && std::all_of(model.page.begin(), model.page.end(),
                     [pages](std::uint32_t page) { return page < pages; })
      && std::all_of(model.materials.begin(), model.materials.end(),
                     [&is_texture](const Texture_material& m) {
                       return is_texture(m.color) && is_texture(m.normal_map);
                     });
}

inline std::uint32_t page_of(const Textured_model& model, std::size_t triangle)
{
  return model.page.empty() ? 0 : model.page[triangle];
}

inline std::string material_name(std::size_t page) { return "page_" + std::to_string(page + 1); }

template <class Point>
Textured_triangle_mesh::Point_2 to_uv(const Point& p)
{
  return {to_double(p[0]), to_double(p[1])};
}

// Sets `wedges` to one for each vertex, whose texture coordinate is that of the vertex.
template <class TriangleMesh, class VertexUVMap>
void set_uv_of_vertices(const TriangleMesh& mesh, const VertexUVMap& uvmap,
                        Textured_triangle_mesh& result)
{
  for(const auto v : vertices(mesh))
    result.uv.push_back(to_uv(get(uvmap, v)));
  result.wedges = result.triangles;
}

// Sets `wedges` to one for the corners of a vertex between one seam and the next.
template <class TriangleMesh, class HalfedgeUVMap>
void set_uv_of_corners(const TriangleMesh& mesh, const HalfedgeUVMap& uvmap,
                       Textured_triangle_mesh& result)
{
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    Triangle_indices wedges;
    for(Vertex_index& wedge : wedges) {
      wedge = Vertex_index(result.uv.size());
      result.uv.push_back(to_uv(get(uvmap, h)));
      h = next(h, mesh);
    }
    result.wedges.push_back(wedges);
  }
  result = Surface_mesh_multiresolution::with_wedges(result);
}

// A mesh of any type with its texture coordinates, those of halfedges at their targets. Empty if
// not all faces are triangles.
template <class TriangleMesh, class UVMap, class NamedParameters>
Textured_triangle_mesh textured_mesh_of(const TriangleMesh& mesh, const UVMap& uvmap,
                                        const NamedParameters& np)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename boost::property_traits<UVMap>::key_type Key;
  Textured_triangle_mesh result;
  if(!is_triangle_mesh(mesh))
    return result;
  const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
  Indexed_mesh::number_vertices(mesh, position);
  const auto vpm = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                                get_const_property_map(CGAL::vertex_point, mesh));
  for(const auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    result.points.emplace_back(to_double(p[0]), to_double(p[1]), to_double(p[2]));
  }
  result.triangles = Indexed_mesh::copy_triangles(mesh, position);
  // A map for the vertices of a `Seam_mesh` has as its key what they are converted to.
  constexpr bool is_of_vertices
    = !std::is_same<Key, typename Graph_traits::halfedge_descriptor>::value
   && std::is_convertible<typename Graph_traits::vertex_descriptor, Key>::value;
  if constexpr(is_of_vertices)
    set_uv_of_vertices(mesh, uvmap, result);
  else
    set_uv_of_corners(mesh, uvmap, result);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H
