// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SEAM_LENGTH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SEAM_LENGTH_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The length of the seams between triangles, each once.
inline double seam_length(const Indexed_triangle_mesh& mesh, const Triangle_adjacency& adjacency,
                          const Face_charts& charts)
{
  double sum = 0.;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t opposite = adjacency.opposite(t, c);
      if(opposite != no_halfedge && 3 * t + std::uint32_t(c) < opposite && charts.is_seam(t, c))
        sum += std::sqrt(squared_distance(mesh.points[mesh.triangles[t][c]],
                                          mesh.points[mesh.triangles[t][(c + 1) % 3]]));
    }
  return sum;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SEAM_LENGTH_H
