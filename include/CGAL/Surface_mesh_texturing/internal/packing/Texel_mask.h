// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_TEXEL_MASK_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_TEXEL_MASK_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#endif

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef std::uint64_t Word;

// The position of the lowest bit that is set, of a word that is not 0.
inline int lowest_bit(Word w)
{
#if defined(__GNUC__)
  return __builtin_ctzll(w);
#elif defined(_MSC_VER) && defined(_WIN64)
  unsigned long i;
  _BitScanForward64(&i, w);
  return int(i);
#else
  int i = 0;
  for(; (w & 1) == 0; w >>= 1)
    ++i;
  return i;
#endif
}

inline int number_of_bits(Word w)
{
#if defined(__GNUC__)
  return __builtin_popcountll(w);
#else
  int n = 0;
  for(; w != 0; w &= w - 1)
    ++n;
  return n;
#endif
}

// The cells x from `begin` to before `end` of row `y`.
struct Cell_run
{
  int y, begin, end;
};

// Sets the bits from `begin` to before `end`, of which there must be one.
inline void set_bits(Word* words, int begin, int end)
{
  const int first = begin >> 6, last = (end - 1) >> 6;
  for(int i = first; i <= last; ++i)
    words[i] |= (i == first ? ~Word(0) << (begin & 63) : ~Word(0))
                & (i == last ? ~Word(0) >> (63 - ((end - 1) & 63)) : ~Word(0));
}

// A set of cells of a raster: a bit each, row by row, each row beginning with a new word.
class Texel_mask
{
public:
  Texel_mask(int width = 0, int height = 0)
    : m_width(width), m_height(height), m_words((width + 63) / 64),
      m_bits(std::size_t(m_words) * height, 0)
  {}

  int width() const { return m_width; }
  int height() const { return m_height; }
  int words() const { return m_words; } // of a row
  Word* row(int y) { return m_bits.data() + std::size_t(m_words) * y; }
  const Word* row(int y) const { return m_bits.data() + std::size_t(m_words) * y; }

  bool has(int x, int y) const { return (row(y)[x >> 6] >> (x & 63) & 1) != 0; }

  // Adds a run, of which what lies outside of the raster is ignored.
  void add(const Cell_run& run)
  {
    const int begin = (std::max)(0, run.begin), end = (std::min)(m_width, run.end);
    if(run.y >= 0 && run.y < m_height && begin < end)
      set_bits(row(run.y), begin, end);
  }

  std::size_t count() const
  {
    std::size_t n = 0;
    for(const Word w : m_bits)
      n += number_of_bits(w);
    return n;
  }

  std::vector<Cell_run> runs() const;

private:
  // The first cell from x on in the row that is in the set or not.
  int find(const Word* words, int x, bool is_in) const
  {
    while(x < m_width) {
      const Word w = (is_in ? words[x >> 6] : ~words[x >> 6]) >> (x & 63);
      if(w != 0)
        return (std::min)(m_width, x + lowest_bit(w));
      x = (x | 63) + 1;
    }
    return m_width;
  }

  int m_width, m_height, m_words;
  std::vector<Word> m_bits;
};

// The maximal runs, row by row.
inline std::vector<Cell_run> Texel_mask::runs() const
{
  std::vector<Cell_run> result;
  for(int y = 0; y < m_height; ++y)
    for(int x = 0; (x = find(row(y), x, true)) < m_width;) {
      const int end = find(row(y), x, false);
      result.push_back({y, x, end});
      x = end;
    }
  return result;
}

// The cells that a mask's cells touch when it moves up to `n` cells to the right and up.
inline Texel_mask swept(const Texel_mask& mask, int n)
{
  Texel_mask wide(mask.width() + n, mask.height()), result(wide.width(), mask.height() + n);
  for(const Cell_run& run : mask.runs())
    wide.add({run.y, run.begin, run.end + n});
  for(int y = 0; y < mask.height(); ++y)
    for(int i = 0; i <= n; ++i)
      for(int k = 0; k < wide.words(); ++k)
        result.row(y + i)[k] |= wide.row(y)[k];
  return result;
}

// The cells at most `r` away from one of the mask's in rows and columns; (x, y) becomes
// (x + r, y + r).
inline Texel_mask dilated(const Texel_mask& mask, int r) { return swept(mask, 2 * r); }

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_TEXEL_MASK_H
