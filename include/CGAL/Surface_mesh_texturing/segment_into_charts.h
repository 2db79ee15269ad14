// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H

#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <functional>
#include <string>

namespace CGAL {
namespace Surface_mesh_texturing {

struct Segmentation_options
{
  Distortion_bound bound;
  std::size_t max_charts = 0;
  std::size_t least_charts = 1;
  std::size_t coarse_faces = 4000;
  std::function<bool(double)> progress;
};
struct Segmentation_result
{
  Face_charts charts;
  std::string error;
};
inline Segmentation_result segment_into_charts(const Indexed_triangle_mesh& mesh, const Segmentation_options& options)
{
  const std::size_t limit = mesh.triangles.size() / (options.least_charts > 1 ? 2 : 12) + 1;
  const internal::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> label(mesh.triangles.size(), no_vertex), of_vertex(mesh.points.size(), no_vertex);
  std::uint32_t number = 0;
  for(std::uint32_t s = 0; s < label.size(); ++s) {
    if(label[s] != no_vertex)
      continue;
    std::vector<std::uint32_t> queue{s};
    label[s] = number;
    for(const auto v : mesh.triangles[s])
      of_vertex[v] = number;
    for(std::size_t i = 0; i < queue.size() && queue.size() < limit; ++i)
      for(int c = 0; c < 3; ++c) {
        const std::uint32_t h = adjacency.opposite(queue[i], c);
        if(h == no_vertex || label[h / 3] != no_vertex)
          continue;
        int shared = 0;
        for(int d = 0; d < 3; ++d) {
          const std::uint32_t g = adjacency.opposite(h / 3, d);
          shared += g != no_vertex && label[g / 3] == number ? 1 : 0;
        }
        const Vertex_index tip = mesh.triangles[h / 3][(h % 3 + 2) % 3];
        if(shared == 3 || (shared == 1 && of_vertex[tip] == number))
          continue;
        label[h / 3] = number;
        of_vertex[tip] = number;
        queue.push_back(h / 3);
      }
    ++number;
  }
  return {charts_of_labels(mesh.triangles, label), {}};
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
