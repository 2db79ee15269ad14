// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_TEXTURED_MODEL_H
#define HLSCM_PROGRAM_TEXTURED_MODEL_H

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>
#include <CGAL/Surface_mesh_texturing/vertex_normals.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hlscm {

using CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh;

/// A picture that a model refers to: the name of its file, and its bytes.
struct Texture_file
{
  std::string name;
  std::string png;
};

/// What lies on one page of an atlas.
struct Page_textures
{
  const Texture_file* colour = nullptr;     ///< or none
  const Texture_file* normal_map = nullptr; ///< in the tangent space of the model, or none
};

/// A model as its files and pictures need it.
struct Textured_model
{
  Textured_triangle_mesh mesh;         ///< with one entry of `uv` for each wedge
  std::vector<std::uint32_t> page;     ///< of each triangle
  std::vector<Page_textures> textures; ///< of each page
  /// The normals of the vertices; without tangents if there are no `corners`.
  CGAL::Surface_mesh_texturing::Tangent_frames frames;

  bool has_tangents() const { return !frames.corners.empty(); }
};

/// Returns for each triangle of an atlas its page.
inline std::vector<std::uint32_t>
pages_of_triangles(const CGAL::Surface_mesh_texturing::Texture_atlas& atlas)
{
  std::vector<std::uint32_t> page;
  for(const std::uint32_t chart : atlas.charts.chart) {
    page.push_back(atlas.page[chart]);
  }
  return page;
}

/// Returns for each wedge its vertex.
inline std::vector<std::uint32_t> vertices_of_wedges(const Textured_triangle_mesh& mesh)
{
  std::vector<std::uint32_t> vertex(mesh.uv.size(), 0);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for(std::size_t c = 0; c < 3; ++c) {
      vertex[mesh.wedges[t][c]] = mesh.triangles[t][c];
    }
  }
  return vertex;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_TEXTURED_MODEL_H
