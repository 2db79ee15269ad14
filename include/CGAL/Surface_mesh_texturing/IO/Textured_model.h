// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
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
by `tangent_frames()` for this mesh, and then there is no second set of texture coordinates; the
entries of `base_wedges` are smaller than `base_uv.size()`.
*/
struct Textured_model
{
  std::string name;                        ///< of the model; of its file of materials without .mtl
  Textured_triangle_mesh mesh;             ///< the surface
  std::vector<std::uint32_t> page;         ///< of each triangle
  std::vector<Texture_material> materials; ///< of each page
  std::vector<Texture_file> textures;      ///< the pictures of all materials
  Tangent_frames frames;                   ///< normals of the vertices, and perhaps tangents
  /// Another set of texture coordinates, such as those of colors where `mesh` has those of a light
  /// map; and for each corner of a triangle its own. GLB files have it as the first set, TEXCOORD_0,
  /// and that of `mesh` as the second, to which textures refer; other formats leave it out. Empty for
  /// none.
  std::vector<Textured_triangle_mesh::Point_2> base_uv;
  std::vector<Triangle_indices> base_wedges; ///< empty, or as long as `mesh.triangles`
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

/// \ingroup PkgHLSCMTextureFiles
/// Returns the name of the material of a page in an OBJ file and its file of materials.
inline std::string material_name(std::size_t page) { return "page_" + std::to_string(page + 1); }

namespace internal {

// Whether the arrays of a textured mesh fit together, with finite numbers.
inline bool can_be_written(const std::vector<Textured_triangle_mesh::Point_3>& points,
                           const std::vector<Triangle_indices>& triangles,
                           const std::vector<Textured_triangle_mesh::Point_2>& uv,
                           const std::vector<Triangle_indices>& wedges)
{
  return triangles.size() == wedges.size() && indices_are_below(triangles, points.size())
      && indices_are_below(wedges, uv.size())
      && point_error(points).empty()
      && std::all_of(uv.begin(), uv.end(), [](const Textured_triangle_mesh::Point_2& p) {
           return std::isfinite(p.x()) && std::isfinite(p.y());
         });
}

inline bool can_be_written(const Textured_triangle_mesh& mesh)
{
  return can_be_written(mesh.points, mesh.triangles, mesh.uv, mesh.wedges);
}

// Whether a soup has these entries for its corners, smaller than n or none, or no entries at all.
inline bool corners_are_below(const std::vector<std::uint32_t>& entries,
                              const Indexed_mesh::Polygon_soup& soup, std::size_t n)
{
  return entries.empty()
      || (entries.size() == soup.corners.size()
          && std::all_of(entries.begin(), entries.end(),
                         [n](std::uint32_t i) { return i < n || i == no_vertex; }));
}

inline bool can_be_written(const Indexed_mesh::Polygon_soup& soup)
{
  return soup_error(soup).empty()
      && corners_are_below(soup.uv_corners, soup, soup.uv.size())
      && Surface_mesh_multiresolution::uv_error(soup.uv).empty();
}

inline bool has_valid_frames(const Textured_model& model)
{
  const Tangent_frames& all = model.frames;
  const std::size_t points = model.mesh.points.size(), uv = model.mesh.uv.size();
  return (all.normals.empty() || all.normals.size() == points)
      && (all.corners.empty()
          || (all.corners.size() == model.mesh.triangles.size() && !all.normals.empty()
              && indices_are_below(all.corners, all.frames.size())))
      && std::all_of(all.frames.begin(), all.frames.end(), [&](const Tangent_frame& f) {
           return f.vertex < points && f.wedge < uv;
         });
}

inline bool has_valid_base(const Textured_model& model)
{
  return model.base_wedges.empty()
      || (model.frames.corners.empty()
          && can_be_written(model.mesh.points, model.mesh.triangles, model.base_uv,
                            model.base_wedges));
}

// Whether the invariants of a model hold.
inline bool can_be_written(const Textured_model& model)
{
  const auto is_texture = [&model](std::size_t number) {
    return number == Texture_material::none || number < model.textures.size();
  };
  const std::size_t pages = (std::max<std::size_t>)(model.materials.size(), 1);
  return can_be_written(model.mesh) && has_valid_frames(model) && has_valid_base(model)
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

// A mesh of any type with its texture coordinates, those of halfedges at their targets. Empty if
// not all faces are triangles.
template <class TriangleMesh, class UVMap, class NamedParameters>
Textured_triangle_mesh textured_mesh_of(const TriangleMesh& mesh, const UVMap& uvmap,
                                        const NamedParameters& np)
{
  return is_triangle_mesh(mesh) ? textured_arrays_of_graph(mesh, uvmap, np)
                                : Textured_triangle_mesh();
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_TEXTURED_MODEL_H
