// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_SORTED_MESH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_SORTED_MESH_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A copy of a mesh in spatial order and of mean edge length 1, and the way back.
class Sorted_mesh
{
public:
  explicit Sorted_mesh(const Indexed_triangle_mesh& original)
    : m_mesh(original), m_place(original.triangles.size())
  {
    m_has_extent = Indexed_mesh::normalize(m_mesh) > 0.;
    m_source = Indexed_mesh::sort_spatially(m_mesh);
    find_places(original);
  }

  const Indexed_triangle_mesh& mesh() const { return m_mesh; }

  // For each vertex the one of the original.
  const std::vector<Vertex_index>& source() const { return m_source; }

  // Whether there is an edge that has a length.
  bool has_extent() const { return m_has_extent; }

  // The charts of the original that are those of this mesh.
  Face_charts charts_of_original(const Face_charts& charts) const;

private:
  void find_places(const Indexed_triangle_mesh& original);

  Indexed_triangle_mesh m_mesh;
  std::vector<Vertex_index> m_source;
  std::vector<std::uint32_t> m_place; // of each original triangle, with its corner at corner 0
  bool m_has_extent = false;
};

// Triangles are sorted by their smallest vertex, their first one, and otherwise keep their order.
inline void Sorted_mesh::find_places(const Indexed_triangle_mesh& original)
{
  std::vector<Vertex_index> rank(m_source.size());
  for(Vertex_index v = 0; v < m_source.size(); ++v)
    rank[m_source[v]] = v;
  std::vector<std::uint32_t> begin(m_source.size(), 0);
  for(std::size_t t = m_mesh.triangles.size(); t-- > 0;)
    begin[m_mesh.triangles[t][0]] = std::uint32_t(t);
  for(std::size_t t = 0; t < m_place.size(); ++t) {
    const Triangle_indices& triangle = original.triangles[t];
    std::uint32_t first = 0;
    for(std::uint32_t c = 1; c < 3; ++c)
      if(rank[triangle[c]] < rank[triangle[first]])
        first = c;
    m_place[t] = 3 * begin[rank[triangle[first]]]++ + first;
  }
}

inline Face_charts Sorted_mesh::charts_of_original(const Face_charts& charts) const
{
  Face_charts result;
  result.number_of_charts = charts.number_of_charts;
  result.seams.resize(m_place.size());
  result.chart.resize(m_place.size());
  std::vector<std::uint32_t> number(charts.number_of_charts, no_vertex);
  std::uint32_t numbers = 0;
  for(std::size_t t = 0; t < m_place.size(); ++t) {
    const std::uint32_t place = m_place[t] / 3, first = m_place[t] % 3;
    for(std::uint32_t c = 0; c < 3; ++c)
      if(charts.is_seam(place, int(c)))
        result.seams[t] |= std::uint8_t(1u << (c + first) % 3);
    std::uint32_t& chart = number[charts.chart[place]];
    if(chart == no_vertex)
      chart = numbers++;
    result.chart[t] = chart;
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_SORTED_MESH_H
