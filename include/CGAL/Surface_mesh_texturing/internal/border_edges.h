// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BORDER_EDGES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BORDER_EDGES_H

#include <CGAL/Surface_mesh_texturing/internal/Triangle_adjacency.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef std::array<Surface_mesh_multiresolution::Vertex_index, 2> Border_edge;

// The edges of a mesh that have one triangle, in the directions in which it has them.
inline std::vector<Border_edge>
border_edges(const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles)
{
  const Triangle_adjacency adjacency(triangles);
  std::vector<Border_edge> result;
  for(std::uint32_t t = 0; t < triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(adjacency.opposite(t, c) == Surface_mesh_multiresolution::no_vertex)
        result.push_back({triangles[t][c], triangles[t][(c + 1) % 3]});
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BORDER_EDGES_H
