// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_TRIANGLES_AT_VERTICES_H
#define CGAL_INDEXED_MESH_TRIANGLES_AT_VERTICES_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

// Corner 3 t + c as the vertex c of triangle t, and its other two vertices in their order. Without
// branches, which nobody could guess.
struct Triangle_corner
{
  std::uint32_t triangle, next, last;

  explicit Triangle_corner(std::uint32_t corner)
    : triangle(corner / 3)
  {
    const std::uint32_t twice_c = 2 * (corner - 3 * triangle);
    next = (9u >> twice_c) & 3u;  // 1, 2, 0
    last = (18u >> twice_c) & 3u; // 2, 0, 1
  }
};

// For each vertex the corners that it has in triangles: corner 3 t + c is vertex c of triangle t.
class Triangles_at_vertices
{
public:
  Triangles_at_vertices(const std::vector<Triangle_indices>& triangles,
                        std::size_t number_of_vertices)
  {
    const auto for_each_corner = [&triangles](const auto& use) {
      for(std::uint32_t t = 0; t < triangles.size(); ++t)
        for(std::uint32_t c = 0; c < 3; ++c)
          use(triangles[t][c], 3 * t + c);
    };
    m_begin = Blocked_execution::sort_by_key(
      number_of_vertices, for_each_corner, [this](std::size_t count) { m_corner.resize(count); },
      [this](std::uint32_t i, std::uint32_t corner) { m_corner[i] = corner; });
  }

  std::size_t number_of_vertices() const { return m_begin.size() - 1; }
  const std::uint32_t* begin(Vertex_index v) const { return m_corner.data() + m_begin[v]; }
  const std::uint32_t* end(Vertex_index v) const { return m_corner.data() + m_begin[v + 1]; }
  std::uint32_t number(Vertex_index v) const { return m_begin[v + 1] - m_begin[v]; }

private:
  Blocked_execution::Uninitialized_vector<std::uint32_t> m_begin, m_corner;
};

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_TRIANGLES_AT_VERTICES_H
