// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_EDGE_TABLE_H
#define CGAL_INDEXED_MESH_INTERNAL_EDGE_TABLE_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// All sides of faces, grouped by the edge they lie on.
//
// A side is named by the corner it starts from; it runs to the next corner of the same face. Sides
// are sorted into one bucket for each vertex, the smaller end of the edge, and by the other end
// there.
class Edge_table
{
public:
  struct Side
  {
    Vertex_index other_end;
    std::uint32_t corner;
  };

  explicit Edge_table(const Polygon_soup& soup)
    : Edge_table(soup.number_of_vertices(), soup.corners.size(), [&soup](const auto& use) {
        for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
          const Polygon_soup::Face face = soup.face(f);
          for(std::size_t i = 0; i < face.size(); ++i)
            use(face[i], face[i + 1 < face.size() ? i + 1 : 0],
                soup.first_corner[f] + std::uint32_t(i));
        }
      })
  {}

  // Of triangles, whose corners are their halfedges.
  Edge_table(const std::vector<Triangle_indices>& triangles, std::size_t number_of_vertices)
    : Edge_table(number_of_vertices, 3 * triangles.size(), [&triangles](const auto& use) {
        for(Halfedge h = 0; h < 3 * triangles.size(); ++h)
          use(vertex_of(triangles, h), vertex_of(triangles, next_halfedge(h)), h);
      })
  {}

  // Calls `use(vertex, first side, last side)` for each edge.
  template <class Use>
  void for_each_edge(const Use& use)
  {
    for(std::size_t v = 0; v + 1 < m_bucket.size(); ++v) {
      Side* begin = m_sides.data() + m_bucket[v];
      Side* end = m_sides.data() + m_bucket[v + 1];
      std::sort(begin, end, [](const Side& a, const Side& b) {
        return a.other_end != b.other_end ? a.other_end < b.other_end : a.corner < b.corner;
      });
      for(Side *first = begin, *last = begin; first != end; first = last) {
        while(last != end && last->other_end == first->other_end)
          ++last;
        use(Vertex_index(v), static_cast<const Side*>(first), static_cast<const Side*>(last));
      }
    }
  }

private:
  // `for_each_side(use)` calls `use(source, target, corner)`; sides without length are left out.
  template <class ForEachSide>
  Edge_table(std::size_t vertices, std::size_t corners, const ForEachSide& for_each_side)
    : m_bucket(vertices + 1, 0), m_sides(corners)
  {
    for_each_side([this](Vertex_index a, Vertex_index b, std::uint32_t) {
      if(a != b)
        ++m_bucket[(std::min)(a, b)];
    });
    std::uint32_t begin = 0;
    for(std::uint32_t& entry : m_bucket) {
      begin += entry;
      entry = begin; // the end of each bucket; filling moves it to the begin
    }
    for_each_side([this](Vertex_index a, Vertex_index b, std::uint32_t corner) {
      if(a != b)
        m_sides[--m_bucket[(std::min)(a, b)]] = {(std::max)(a, b), corner};
    });
  }

  std::vector<std::uint32_t> m_bucket;
  std::vector<Side> m_sides;
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_EDGE_TABLE_H
