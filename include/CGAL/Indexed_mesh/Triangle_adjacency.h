// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H
#define CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

typedef std::array<Vertex_index, 2> Border_edge;

// The halfedge 3 t + c goes from corner c of triangle t to its next corner.
inline std::uint32_t next_halfedge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previous_halfedge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

// The triangle across each edge of a mesh the edges of which have one or two triangles, of equal
// orientation.
class Triangle_adjacency
{
public:
  explicit Triangle_adjacency(const std::vector<Triangle_indices>& triangles)
    : m_opposite(3 * triangles.size(), no_vertex)
  {
    // The halfedges by their smaller vertex, which the two of an edge share
    Vertex_index n = 0;
    for(const Triangle_indices& t : triangles)
      for(const Vertex_index v : t)
        n = v < n ? n : v + 1;
    std::vector<std::uint32_t> begin(n + 1, 0), halfedge(m_opposite.size());
    const auto ends = [&triangles](std::uint32_t h) {
      const Triangle_indices& t = triangles[h / 3];
      return std::array<Vertex_index, 2>{t[h % 3], t[(h + 1) % 3]};
    };
    const auto smaller = [&ends](std::uint32_t h) {
      const auto e = ends(h);
      return e[0] < e[1] ? e[0] : e[1];
    };
    for(std::uint32_t h = 0; h < m_opposite.size(); ++h)
      ++begin[smaller(h) + 1];
    for(std::size_t v = 0; v < n; ++v)
      begin[v + 1] += begin[v];
    std::vector<std::uint32_t> end(begin.begin(), begin.end() - (n > 0 ? 1 : 0));
    for(std::uint32_t h = 0; h < m_opposite.size(); ++h) {
      const Vertex_index v = smaller(h);
      for(std::uint32_t i = begin[v]; i < end[v]; ++i) {
        const auto e = ends(halfedge[i]), f = ends(h);
        if(e[0] == f[1] && e[1] == f[0]) {
          m_opposite[h] = halfedge[i];
          m_opposite[halfedge[i]] = h;
        }
      }
      halfedge[end[v]++] = h;
    }
  }

  /// The halfedge on the other side of that from corner c of t, or `no_vertex` on the border.
  std::uint32_t opposite(std::uint32_t t, int c) const { return m_opposite[3 * t + c]; }
  std::uint32_t opposite(std::uint32_t halfedge) const { return m_opposite[halfedge]; }

  /// Gives the array of opposite halfedges away.
  std::vector<std::uint32_t> take() { return std::move(m_opposite); }

private:
  std::vector<std::uint32_t> m_opposite;
};

// The edges of a mesh that have one triangle, in the directions in which it has them.
inline std::vector<Border_edge>
border_edges(const std::vector<Triangle_indices>& triangles)
{
  const Triangle_adjacency adjacency(triangles);
  std::vector<Border_edge> result;
  for(std::uint32_t t = 0; t < triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(adjacency.opposite(t, c) == no_vertex)
        result.push_back({triangles[t][c], triangles[t][(c + 1) % 3]});
  return result;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H
