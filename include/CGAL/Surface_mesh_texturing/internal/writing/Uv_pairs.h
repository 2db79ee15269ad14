// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_UV_PAIRS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_UV_PAIRS_H

#include <CGAL/Surface_mesh_texturing/IO/Textured_model.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The corners of a model with two sets of texture coordinates: one vertex for each pair that there is.
struct Uv_pairs
{
  std::vector<Tangent_frame> vertices;  // without tangents
  std::vector<Vertex_index> base;       // of each, its coordinate in the other set
  std::vector<Triangle_indices> corners; // the vertices of each triangle
};

// In the order of the first corners. Linear time if each coordinate has few partners.
inline Uv_pairs pair_up(const Textured_model& model)
{
  Uv_pairs result;
  result.corners = model.mesh.triangles;
  // Lists of the pairs of each wedge
  std::vector<Vertex_index> first(model.mesh.uv.size(), no_vertex), next;
  for(std::size_t t = 0; t < result.corners.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = model.mesh.triangles[t][c], wedge = model.mesh.wedges[t][c],
                         base = model.base_wedges[t][c];
      Vertex_index i = first[wedge];
      while(i != no_vertex && (result.base[i] != base || result.vertices[i].vertex != v))
        i = next[i];
      if(i == no_vertex) {
        i = Vertex_index(result.vertices.size());
        result.vertices.push_back({v, wedge, Vector_3(0., 0., 0.), 1.});
        result.base.push_back(base);
        next.push_back(first[wedge]);
        first[wedge] = i;
      }
      result.corners[t][c] = i;
    }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_UV_PAIRS_H
