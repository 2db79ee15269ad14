// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_HALVE_CHART_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_HALVE_CHART_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Cuts off a disk with half of the triangles, in the order of their distance across edges from the
// first one; what is left may be in several pieces. The last resort: it always gives smaller
// charts. Precondition: two triangles or more.
inline Face_charts halve_chart(const Indexed_triangle_mesh& mesh)
{
  const std::size_t half = mesh.triangles.size() / 2;
  const Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> label(mesh.triangles.size(), 0), disk = {0};
  std::vector<bool> has_vertex(mesh.points.size(), false);
  const auto add = [&](std::uint32_t t) {
    label[t] = 1;
    for(const Vertex_index v : mesh.triangles[t])
      has_vertex[v] = true;
  };
  add(0);
  for(std::size_t i = 0; i < disk.size() && disk.size() < half; ++i)
    for(int c = 0; c < 3 && disk.size() < half; ++c) {
      const std::uint32_t h = adjacency.opposite(disk[i], c);
      if(h == no_vertex || label[h / 3] == 1)
        continue;
      int shared = 0; // edges with the disk: with one of them the vertex across must be new
      for(int d = 0; d < 3; ++d) {
        const std::uint32_t g = adjacency.opposite(h / 3, d);
        shared += g != no_vertex && label[g / 3] == 1 ? 1 : 0;
      }
      if(shared == 3 || (shared == 1 && has_vertex[mesh.triangles[h / 3][(h % 3 + 2) % 3]]))
        continue;
      add(h / 3);
      disk.push_back(h / 3);
    }
  return charts_of_labels(mesh.triangles, label);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_HALVE_CHART_H
