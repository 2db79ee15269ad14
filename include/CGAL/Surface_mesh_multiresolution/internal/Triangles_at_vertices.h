// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TRIANGLES_AT_VERTICES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TRIANGLES_AT_VERTICES_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// For each vertex the corners that it has in triangles: corner 3 t + c is vertex c of triangle t.
class Triangles_at_vertices
{
public:
  Triangles_at_vertices(const std::vector<Triangle_indices>& triangles,
                        std::size_t number_of_vertices)
    : m_begin(number_of_vertices + 2, 0), m_corner(3 * triangles.size())
  {
    for(const Triangle_indices& t : triangles)
      for(const Vertex_index v : t)
        ++m_begin[v + 2];
    for(std::size_t v = 2; v < m_begin.size(); ++v)
      m_begin[v] += m_begin[v - 1];
    for(std::uint32_t t = 0; t < triangles.size(); ++t)
      for(std::uint32_t c = 0; c < 3; ++c)
        m_corner[m_begin[triangles[t][c] + 1]++] = 3 * t + c;
  }

  std::size_t number_of_vertices() const { return m_begin.size() - 2; }
  const std::uint32_t* begin(Vertex_index v) const { return m_corner.data() + m_begin[v]; }
  const std::uint32_t* end(Vertex_index v) const { return m_corner.data() + m_begin[v + 1]; }
  std::uint32_t number(Vertex_index v) const { return m_begin[v + 1] - m_begin[v]; }

private:
  std::vector<std::uint32_t> m_begin, m_corner;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TRIANGLES_AT_VERTICES_H
