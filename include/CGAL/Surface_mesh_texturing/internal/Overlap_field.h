// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_OVERLAP_FIELD_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_OVERLAP_FIELD_H

#include <CGAL/Surface_mesh_texturing/internal/Silhouette.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The number of cells in which two silhouettes overlap, the second of which lies at (x, y) from
// the first.
inline int overlap(const Silhouette& a, const Silhouette& b, int x, int y)
{
  int result = 0;
  if(x >= a.width || y >= a.height || x + b.width <= 0 || y + b.height <= 0)
    return result;
  const int end = (std::min)(a.height, y + b.height);
  for(int row = (std::max)(0, y); row < end; ++row) {
    const Cell_run *p = a.runs.data() + a.row_begin[row];
    const Cell_run *p_end = a.runs.data() + a.row_begin[row + 1];
    const Cell_run *q = b.runs.data() + b.row_begin[row - y];
    const Cell_run *q_end = b.runs.data() + b.row_begin[row - y + 1];
    while(p != p_end && q != q_end) {
      result += (std::max)(0, (std::min)(p->end, q->end + x) - (std::max)(p->begin, q->begin + x));
      if(p->end < q->end + x)
        ++p;
      else
        ++q;
    }
  }
  return result;
}

// The weights of the silhouettes over each cell of a rectangle, summed along its rows, so that
// the weighted overlap of a silhouette at many places is found quickly.
class Overlap_field
{
public:
  // The cells from (x, y) on; nothing is there.
  void reset(int x, int y, int width, int height)
  {
    m_x = x;
    m_y = y;
    m_width = width;
    m_height = height;
    m_sums.assign(std::size_t(width + 1) * height, 0);
  }

  void add(const Silhouette& s, int x, int y, int weight)
  {
    x -= m_x;
    y -= m_y;
    if(x >= m_width || x + s.width <= 0)
      return;
    for(int row = (std::max)(0, -y); row < s.height && row + y < m_height; ++row)
      for(int i = s.row_begin[row]; i < s.row_begin[row + 1]; ++i) {
        const int begin = (std::max)(0, s.runs[i].begin + x);
        const int end = (std::min)(m_width, s.runs[i].end + x);
        if(begin < end) {
          int* sums = m_sums.data() + std::size_t(m_width + 1) * (row + y);
          sums[begin] += weight;
          sums[end] -= weight;
        }
      }
  }

  // To be called between `add()` and `overlaps()`.
  void integrate()
  {
    for(int y = 0; y < m_height; ++y) {
      int* sums = m_sums.data() + std::size_t(m_width + 1) * y;
      int weight = 0, sum = 0;
      for(int x = 0; x <= m_width; ++x) {
        weight += sums[x];
        sums[x] = sum;
        sum += weight;
      }
    }
  }

  // Returns the least overlap at the places x, x + 1 ... x + n - 1 of row y, and the overlaps in
  // `result`; once all are known to be greater than `most`, they are no longer summed.
  int overlaps(const Silhouette& s, int x, int y, int n, int most, int* result) const
  {
    std::fill_n(result, n, 0);
    int least = 0;
    const int* origin = m_sums.data() + std::ptrdiff_t(m_width + 1) * (y - m_y) + (x - m_x);
    for(std::size_t i = 0; i < s.runs.size() && least <= most;) {
      const std::size_t end = (std::min)(s.runs.size(), i + 8);
      for(; i < end; ++i) {
        const int* row = origin + std::ptrdiff_t(m_width + 1) * s.runs[i].y;
        const int *from = row + s.runs[i].begin, *to = row + s.runs[i].end;
        for(int k = 0; k < n; ++k)
          result[k] += to[k] - from[k];
      }
      least = *std::min_element(result, result + n);
    }
    return least;
  }

private:
  int m_x = 0, m_y = 0, m_width = 0, m_height = 0;
  std::vector<int> m_sums; // of each row, one more than it has cells
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_OVERLAP_FIELD_H
