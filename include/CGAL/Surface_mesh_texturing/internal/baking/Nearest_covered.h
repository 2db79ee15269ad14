// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_NEAREST_COVERED_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_NEAREST_COVERED_H

#include <CGAL/Blocked_execution/blocked_for.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// For each cell of an image the nearest covered one: the exact Euclidean distance transform of
// Meijster, Roerdink, Hesselink 2000, first by columns and then, when asked, row by row. Of equally
// near cells the leftmost counts, of those in one column the upper one.
class Nearest_covered
{
public:
  static constexpr std::size_t no_cell = std::size_t(-1);

  // Linear time; is_covered(i) tells about cell i = y * columns + x. There are fewer than 65535
  // rows.
  template <class IsCovered>
  Nearest_covered(std::size_t columns, std::size_t rows, const IsCovered& is_covered)
    : m_columns(columns), m_row(columns * rows)
  {
    CGAL_precondition(rows < std::size_t(none));
    Blocked_execution::blocked_for(columns, 512, [&](std::size_t begin, std::size_t end) {
      for(std::size_t y = 0; y < rows; ++y)
        for(std::size_t x = begin; x < end; ++x) {
          const std::size_t i = y * columns + x;
          m_row[i] = is_covered(i) ? Row(y) : y > 0 ? m_row[i - columns] : none;
        }
      for(std::size_t y = rows - 1; y-- > 0;)
        for(std::size_t x = begin; x < end; ++x) {
          Row& row = m_row[y * columns + x];
          const Row below = m_row[(y + 1) * columns + x];
          // One that comes from above lies at most at y, as do both if they are the same
          if(below != none && below > y && (row == none || below - y < y - row))
            row = below;
        }
    });
  }

  // Sets nearest[x] to the covered cell nearest to (x, y), or to `no_cell` if there is none at all.
  void row(std::size_t y, std::vector<std::size_t>& nearest) const
  {
    struct Site
    {
      std::int64_t x, squared_height; // of the covered cell
      std::int64_t begin;             // of the cells to which it is nearest
    };
    std::vector<Site> sites;
    const std::int64_t columns = std::int64_t(m_columns);
    for(std::int64_t x = 0; x < columns; ++x) {
      const Row row = m_row[y * m_columns + std::size_t(x)];
      if(row == none)
        continue;
      const std::int64_t height = std::int64_t(row) - std::int64_t(y);
      Site site = {x, height * height, 0};
      while(!sites.empty()) {
        // Where the new site becomes nearer than the last one
        const Site& s = sites.back();
        const std::int64_t twice = 2 * (x - s.x);
        const std::int64_t sum = x * x - s.x * s.x + site.squared_height - s.squared_height;
        site.begin = sum < 0 ? 0 : sum / twice + 1;
        if(site.begin > s.begin)
          break;
        sites.pop_back();
        site.begin = 0;
      }
      if(site.begin < columns)
        sites.push_back(site);
    }
    nearest.assign(m_columns, no_cell);
    for(std::size_t i = 0; i < sites.size(); ++i) {
      const std::int64_t end = i + 1 < sites.size() ? sites[i + 1].begin : columns;
      const std::size_t x = std::size_t(sites[i].x);
      const std::size_t cell = std::size_t(m_row[y * m_columns + x]) * m_columns + x;
      std::fill(nearest.begin() + sites[i].begin, nearest.begin() + end, cell);
    }
  }

private:
  typedef std::uint16_t Row; // half the memory of 32 bits

  static constexpr Row none = Row(-1);

  std::size_t m_columns;
  std::vector<Row> m_row; // of the nearest covered cell in the column of each cell
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_NEAREST_COVERED_H
