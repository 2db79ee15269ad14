// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_UV_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_UV_CHARTS_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The chart of each triangle of a textured mesh: triangles that share a vertex with the same
// texture coordinate lie in the same one. That needs no adjacency, and joins charts that touch in a
// point.
class Uv_charts
{
public:
  // Linear time for bounded degrees.
  explicit Uv_charts(const Textured_triangle_mesh& mesh) : m_chart(mesh.triangles.size())
  {
    Disjoint_sets sets(mesh.uv.size());
    std::vector<bool> is_listed(mesh.uv.size(), false);
    // Lists of the wedges at each vertex
    std::vector<Vertex_index> first(mesh.points.size(), no_vertex), next(mesh.uv.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        const Vertex_index v = mesh.triangles[t][c], w = mesh.wedges[t][c];
        sets.join(w, mesh.wedges[t][0]);
        if(is_listed[w])
          continue;
        is_listed[w] = true;
        for(Vertex_index other = first[v]; other != no_vertex; other = next[other])
          if(mesh.uv[other] == mesh.uv[w])
            sets.join(w, other);
        next[w] = first[v];
        first[v] = w;
      }
    std::vector<std::uint32_t> number(mesh.uv.size(), no_chart);
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      std::uint32_t& chart = number[sets.find(mesh.wedges[t][0])];
      if(chart == no_chart)
        chart = m_size++;
      m_chart[t] = chart;
    }
  }

  static constexpr std::uint32_t no_chart = std::uint32_t(-1);

  std::uint32_t size() const { return m_size; }
  std::uint32_t operator[](std::uint32_t triangle) const { return m_chart[triangle]; }

private:
  std::vector<std::uint32_t> m_chart;
  std::uint32_t m_size = 0;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_UV_CHARTS_H
