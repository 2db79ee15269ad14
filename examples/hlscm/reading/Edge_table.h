// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_EDGE_TABLE_H
#define HLSCM_PROGRAM_EDGE_TABLE_H

#include "common/Polygon_soup.h"

#include <algorithm>

namespace hlscm {

/// All sides of faces, grouped by the edge they lie on.
///
/// A side is named by the corner it starts from; it runs to the next corner of the same face. Sides
/// are sorted into one bucket for each vertex, the smaller end of the edge, and by the other end
/// there.
class Edge_table
{
public:
  struct Side
  {
    std::uint32_t other_end;
    std::uint32_t corner;
  };

  explicit Edge_table(const Polygon_soup& soup)
    : m_soup(soup), m_bucket(soup.number_of_vertices() + 1, 0), m_sides(soup.corners.size())
  {
    for_each_side([this](std::uint32_t low, std::uint32_t, std::uint32_t) { ++m_bucket[low]; });
    std::uint32_t begin = 0;
    for(std::uint32_t& entry : m_bucket) {
      begin += entry;
      entry = begin; // the end of each bucket; filling moves it to the begin
    }
    for_each_side([this](std::uint32_t low, std::uint32_t high, std::uint32_t corner) {
      m_sides[--m_bucket[low]] = {high, corner};
    });
  }

  /// Calls `use(vertex, first side, last side)` for each edge.
  template <typename Use>
  void for_each_edge(Use use)
  {
    for(std::size_t v = 0; v + 1 < m_bucket.size(); ++v) {
      Side* begin = m_sides.data() + m_bucket[v];
      Side* end = m_sides.data() + m_bucket[v + 1];
      std::sort(begin, end, [](const Side& a, const Side& b) {
        return a.other_end != b.other_end ? a.other_end < b.other_end : a.corner < b.corner;
      });
      for(Side *first = begin, *last = begin; first != end; first = last) {
        while(last != end && last->other_end == first->other_end) {
          ++last;
        }
        use(v, first, last);
      }
    }
  }

private:
  template <typename Use>
  void for_each_side(Use use) const
  {
    for(std::size_t f = 0; f < m_soup.number_of_faces(); ++f) {
      const Polygon_soup::Face face = m_soup.face(f);
      for(std::size_t i = 0; i < face.size(); ++i) {
        const std::uint32_t a = face[i], b = face[i + 1 < face.size() ? i + 1 : 0];
        if(a != b) {
          use(std::min(a, b), std::max(a, b), m_soup.first_corner[f] + std::uint32_t(i));
        }
      }
    }
  }

  const Polygon_soup& m_soup;
  std::vector<std::uint32_t> m_bucket;
  std::vector<Side> m_sides;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_EDGE_TABLE_H
