// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_RASTER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_RASTER_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Texel_mask.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A run of a chart as the union of two runs of 2^level cells.
struct Probe
{
  int y, first, second, level;
};

// The probes of a mask, those first that are likely to find an obstacle: every 2^k-th row, for
// decreasing k.
inline std::vector<Probe> probes_of(const Texel_mask& mask)
{
  std::vector<Probe> result;
  const auto rank = [](const Probe& p) { return p.y == 0 ? 32 : lowest_bit(Word(p.y)); };
  for(const Cell_run& run : mask.runs()) {
    int level = 0;
    while(2 << level <= run.end - run.begin)
      ++level;
    result.push_back({run.y, run.begin, run.end - (1 << level), level});
  }
  std::stable_sort(result.begin(), result.end(), [&](const Probe& a, const Probe& b) {
    return (std::min)(rank(a), 5) > (std::min)(rank(b), 5);
  });
  return result;
}

// The cells of a page that are taken. For each k there is the set of the cells x such that one of
// the 2^k cells from x on is taken, so that a run of a chart is compared with the page, for 64
// positions at a time, in two steps.
class Page_raster
{
public:
  Page_raster(int width, int height)
    : m_width(width), m_height(height), m_words((width + 63) / 64),
      m_framed(std::size_t(stride(width)) * (height + 2 * frame), 1)
  {
    for(int y = 0; y < height; ++y)
      std::fill_n(m_framed.begin() + index(0, y), width, std::uint8_t(0));
    for(int k = 0; 1 << k <= width; ++k)
      m_levels.emplace_back(std::size_t(m_words) * height + m_words + 1, 0);
  }

  int width() const { return m_width; }
  int height() const { return m_height; }
  int words() const { return m_words; } // of a row

  // The cells around a page that count as taken, and the cells of a row with them.
  static constexpr int frame = 4;
  static int stride(int width) { return width + 2 * frame; }

  // The number of the cells that are taken at the offsets y * stride + x from a place.
  int number_of_taken(const int* begin, const int* end, int x, int y) const
  {
    const std::uint8_t* place = m_framed.data() + index(x, y);
    int n = 0;
    for(const int* offset = begin; offset != end; ++offset)
      n += place[*offset];
    return n;
  }

  // Takes the cells of a mask whose lower left corner lies at (x, y), which may be outside.
  void take(const std::vector<Cell_run>& runs, int x, int y)
  {
    if(runs.empty())
      return;
    for(const Cell_run& run : runs) {
      const int begin = (std::max)(0, run.begin + x), end = (std::min)(m_width, run.end + x);
      if(run.y + y < 0 || run.y + y >= m_height || begin >= end)
        continue;
      std::fill(m_framed.begin() + index(begin, run.y + y),
                m_framed.begin() + index(end, run.y + y), std::uint8_t(1));
      set_bits(row(0, run.y + y), begin, end);
    }
    update((std::max)(0, runs.front().y + y), (std::min)(m_height, runs.back().y + y + 1));
  }

  // Sets bit x of `free` for the positions x at which none of the probes, y rows up, meets a cell
  // that is taken; looks only at those that are set before, in the words [begin, end), which
  // shrink to where there are some. Returns whether there are any.
  bool restrict_to_free(const std::vector<Probe>& probes, int y, Word* free, int& begin,
                        int& end) const
  {
    for(const Probe& probe : probes) {
      const Word* words = row(probe.level, y + probe.y);
      const Word *p = words + (probe.first >> 6), *q = words + (probe.second >> 6);
      const int s = probe.first & 63, t = probe.second & 63;
      for(int i = begin; i < end; ++i) {
        const Word first = p[i] >> s | p[i + 1] << 1 << (63 - s);
        const Word second = q[i] >> t | q[i + 1] << 1 << (63 - t);
        free[i] &= ~(first | second);
      }
      while(begin < end && free[begin] == 0)
        ++begin;
      while(begin < end && free[end - 1] == 0)
        --end;
      if(begin == end)
        return false;
    }
    return true;
  }

private:
  typedef std::vector<Word> Level;

  // Of a cell of the page or of the frame.
  std::ptrdiff_t index(int x, int y) const
  {
    return std::ptrdiff_t(y + frame) * stride(m_width) + x + frame;
  }

  Word* row(int k, int y) { return m_levels[k].data() + std::size_t(m_words) * y; }
  const Word* row(int k, int y) const { return m_levels[k].data() + std::size_t(m_words) * y; }

  // Derives the higher levels of the rows [begin, end) from the first.
  void update(int begin, int end)
  {
    for(int y = begin; y < end; ++y)
      for(int k = 1; k < int(m_levels.size()); ++k) {
        const Word* from = row(k - 1, y);
        Word* to = row(k, y);
        const int shift = 1 << (k - 1), skip = shift >> 6, s = shift & 63;
        for(int i = 0; i < m_words; ++i) {
          const Word low = i + skip < m_words ? from[i + skip] : 0;
          const Word high = i + skip + 1 < m_words ? from[i + skip + 1] : 0;
          to[i] = from[i] | low >> s | high << 1 << (63 - s);
        }
      }
  }

  int m_width, m_height, m_words;
  std::vector<std::uint8_t> m_framed; // 1 where a cell is taken, with the frame
  std::vector<Level> m_levels; // each with a row and a word more than the page, which are read only
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_RASTER_H
