// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VSPLIT_STENCILS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VSPLIT_STENCILS_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>
#include <CGAL/Surface_mesh_multiresolution/internal/nearest_triangle.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// For each vertex that the collapses [first, last) remove from `fine` the weights of the nearest
// of the triangles that fill its place right after its collapse. The last collapse comes first, as
// in the vertex splits, so that all sources are known when a stencil is applied.
inline std::vector<Prolongation::Stencil>
vsplit_stencils(const Indexed_triangle_mesh& fine, const Progressive_mesh& pm, std::size_t first,
                std::size_t last, const std::vector<Vertex_index>& index_in_fine)
{
  Progressive_mesh part;
  part.number_of_vertices = fine.points.size();
  part.triangles = fine.triangles;
  for(std::size_t i = first; i < last; ++i)
    part.collapses.push_back({index_in_fine[pm.collapses[i].removed],
                              index_in_fine[pm.collapses[i].kept]});
  Progressive_mesh_cursor cursor(part);
  std::vector<Prolongation::Stencil> result;
  result.reserve(last - first);
  while(cursor.position() < part.collapses.size()) {
    const Vertex_index v = part.collapses[cursor.position()].removed;
    cursor.collapse();
    Nearest_point best;
    Triangle_indices best_triangle = {0, 0, 0};
    for(const std::uint32_t t : cursor.last_changed_triangles()) {
      const Triangle_indices& triangle = cursor.triangles()[t];
      const Nearest_point candidate
        = nearest_in_triangle(fine.points, triangle, fine.points[v]);
      if(candidate.squared_distance < best.squared_distance) {
        best = candidate;
        best_triangle = triangle;
      }
    }
    if(cursor.last_changed_triangles().empty()) { // the only triangle at v is gone
      const Vertex_index kept = part.collapses[cursor.position() - 1].kept;
      best_triangle = {kept, kept, kept};
    }
    result.push_back({v, best_triangle, best.weight});
  }
  std::reverse(result.begin(), result.end());
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VSPLIT_STENCILS_H
