// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_PARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_PARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Chart_cuts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Whether each triangle is on the left of the path, which goes through a disk from border to border.
inline std::vector<bool> are_left_of(const std::vector<Vertex_index>& path,
                                     const std::vector<Triangle_indices>& triangles,
                                     const Triangle_adjacency& adjacency)
{
  std::vector<std::pair<Vertex_index, Vertex_index>> edges;
  for(std::size_t i = 0; i + 1 < path.size(); ++i) {
    edges.push_back({path[i], path[i + 1]});
    edges.push_back({path[i + 1], path[i]});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_on_path(1);
  for(const Vertex_index v : path) {
    is_on_path.resize((std::max)(is_on_path.size(), std::size_t(v) + 1), false);
    is_on_path[v] = true;
  }
  const auto is_cut = [&](Vertex_index v, Vertex_index w) {
    return v < is_on_path.size() && is_on_path[v]
        && std::binary_search(edges.begin(), edges.end(), std::make_pair(v, w));
  };
  std::vector<bool> is_left(triangles.size(), false);
  std::vector<Triangle_index> waiting;
  const auto take = [&](Triangle_index t) {
    is_left[t] = true;
    waiting.push_back(t);
  };
  for(Triangle_index t = 0; t < triangles.size() && waiting.empty(); ++t)
    for(int c = 0; c < 3; ++c)
      if(triangles[t][c] == path[0] && triangles[t][(c + 1) % 3] == path[1])
        take(t);
  while(!waiting.empty()) {
    const Triangle_index i = waiting.back();
    waiting.pop_back();
    for(int c = 0; c < 3; ++c) {
      const Triangle_indices& t = triangles[i];
      const Halfedge opposite = adjacency.opposite(i, c);
      if(opposite != no_halfedge && !is_left[triangle_of(opposite)] && !is_cut(t[c], t[(c + 1) % 3]))
        take(triangle_of(opposite));
    }
  }
  return is_left;
}

// The chart of some triangles of a chart, with its map.
inline Mapped_chart part_of(const Mapped_chart& whole, const Triangle_adjacency& adjacency,
                            const std::vector<Triangle_index>& triangles)
{
  Mapped_chart result;
  result.chart = Chart_cutter<Triangle_adjacency>(whole.chart.mesh, adjacency)(triangles);
  for(Vertex_index& v : result.chart.vertices) {
    result.uv.push_back(whole.uv[v]);
    v = whole.chart.vertices[v];
  }
  for(Triangle_index& t : result.chart.triangles)
    t = whole.chart.triangles[t];
  result.report.faces = result.chart.triangles.size();
  result.report.border_length
    = border_length(result.chart.mesh, result.chart.border_edges());
  result.report.distortion = measure_chart_distortion(result.chart.mesh, result.uv);
  result.is_valid = true;
  return result;
}

// What a cut through a chart leaves: on the right of its path, and on its left.
struct Cut_sides
{
  std::array<std::vector<Triangle_index>, 2> triangles;
  double density = 0.;                   // area in the plane to that on the surface, of the chart
  std::array<double, 2> scale = {0., 0.}; // of the map of each side, so that its density is the same

  bool are_valid() const
  {
    const auto is_positive = [](double s) { return s > 0. && std::isfinite(s); };
    return !triangles[0].empty() && !triangles[1].empty() && is_positive(scale[0])
        && is_positive(scale[1]);
  }
};

inline Cut_sides sides_of(const Chart_cut& cut, const Mapped_chart& whole,
                          const Triangle_adjacency& adjacency)
{
  const Indexed_triangle_mesh& mesh = whole.chart.mesh;
  Cut_sides result;
  const std::vector<bool> is_left = are_left_of(cut.path, mesh.triangles, adjacency);
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t)
    result.triangles[is_left[t] ? 1 : 0].push_back(t);
  std::array<Triangle_distortion, 2> sums;
  Blocked_execution::blocked_for(2, 1, [&](std::size_t k, std::size_t) {
    for(const Triangle_index i : result.triangles[k]) {
      const Triangle_indices& t = mesh.triangles[i];
      const Triangle_distortion d
        = triangle_distortion(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]],
                              whole.uv[t[1]] - whole.uv[t[0]], whole.uv[t[2]] - whole.uv[t[0]]);
      sums[k].area += d.area;
      sums[k].uv_area += d.uv_area;
    }
  });
  result.density = (sums[0].uv_area + sums[1].uv_area) / (sums[0].area + sums[1].area);
  for(int k = 0; k < 2; ++k)
    result.scale[k] = std::sqrt(result.density * (sums[k].area / sums[k].uv_area));
  return result;
}

inline Chart_outline scaled(Chart_outline outline, double scale)
{
  for(std::vector<Outline_edge>& part : outline.parts)
    for(Outline_edge& e : part)
      for(Vector_2d* p : {&e.from, &e.to})
        *p = {scale * (*p)[0], scale * (*p)[1]};
  outline.area *= scale * scale;
  outline.diameter *= scale;
  return outline;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_PARTS_H
