// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
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

// The largest integer up to a number, which must be one: `std::floor()` is a call without SSE 4.1.
inline int floor_of(double x)
{
  const int towards_zero = int(x);
  return towards_zero - int(x < towards_zero);
}

// The smallest integer from such a number on.
inline int ceil_of(double x) { return -floor_of(-x); }

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

  // Becomes a mask of the same size and, in it, what this is when it moves by so many bits, of all rows one
  // after the other; no cell may go beyond the words of its row.
  void set_and_moved(const Texel_mask& mask, int bits)
  {
    const std::size_t skip = std::size_t(bits) >> 6, n = m_bits.size();
    const int s = bits & 63;
    const Word* from = mask.m_bits.data();
    std::copy_n(from, (std::min)(skip, n), m_bits.data());
    if(skip < n)
      m_bits[skip] = from[skip] | from[0] << s;
    for(std::size_t i = skip + 1; i < n; ++i)
      m_bits[i] = from[i] | from[i - skip] << s | from[i - skip - 1] >> 1 >> (63 - s);
  }

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

// The cells that a mask's cells touch when it moves up to `n` cells to the right and up: each step moves
// what was found so far by as much as that reaches, or less at the end.
inline Texel_mask swept(const Texel_mask& mask, int n)
{
  Texel_mask result(mask.width() + n, mask.height() + n), before = result;
  const int words = result.words();
  for(int y = 0; y < mask.height(); ++y)
    std::copy_n(mask.row(y), mask.words(), result.row(y));
  for(const int cells_apart : {1, 64 * words}) // in a row, and in a column
    for(int reach = 1; reach <= n; reach *= 2) {
      std::swap(result, before);
      result.set_and_moved(before, cells_apart * (std::min)(reach, n + 1 - reach));
    }
  return result;
}

// The cells at most `r` away from one of the mask's in rows and columns; (x, y) becomes
// (x + r, y + r).
inline Texel_mask dilated(const Texel_mask& mask, int r) { return swept(mask, 2 * r); }

// Sets the words of the cells that are in a mask dilated by one, but not in the mask; returns their number.
inline std::size_t rim_between(const Texel_mask& inner, const Texel_mask& outer, std::vector<Word>& rim)
{
  std::size_t size = 0;
  rim.clear();
  for(int y = 0; y < outer.height(); ++y)
    for(int i = 0; i < outer.words(); ++i) {
      const bool has_row = y > 0 && y <= inner.height();
      const Word low = has_row && i < inner.words() ? inner.row(y - 1)[i] : 0;
      const Word before = has_row && i > 0 ? inner.row(y - 1)[i - 1] : 0;
      rim.push_back(outer.row(y)[i] & ~(low << 1 | before >> 63));
      size += std::size_t(number_of_bits(rim.back()));
    }
  return size;
}

// Cells just outside of the mask, and those two cells further, evenly chosen, as offsets in
// rows of `stride` cells from the mask's lower left corner. Any of them in a row are from all sides.
inline std::vector<int> rim_of(const Texel_mask& mask, int stride)
{
  constexpr std::size_t samples = 64; // of each rim
  constexpr std::size_t apart = 11;
  std::vector<int> chosen, result;
  std::vector<Word> rim;
  Texel_mask inner = mask;
  for(int r = 1; r <= 3; ++r) {
    Texel_mask outer = dilated(inner, 1);
    if(r != 2) {
      const std::size_t size = rim_between(inner, outer, rim), n = (std::min)(size, samples);
      std::size_t before = 0, i = 0; // cells, and how many of them were chosen
      for(std::size_t k = 0; i < n; ++k) {
        Word ring = rim[k];
        const std::size_t end = before + std::size_t(number_of_bits(ring));
        const int y = int(k / std::size_t(outer.words())), x = 64 * int(k % std::size_t(outer.words()));
        for(; i < n && i * size / n < end; ++i) {
          for(; before < i * size / n; ++before)
            ring &= ring - 1;
          chosen.push_back((y - r) * stride + x + lowest_bit(ring) - r);
        }
        before = end;
      }
    }
    inner = std::move(outer);
  }
  for(std::size_t first = 0; first < apart; ++first)
    for(std::size_t i = first; i < chosen.size(); i += apart)
      result.push_back(chosen[i]);
  return result;
}

// A point nearer to a cell than this, in cells, counts as touching it: the coordinates that users
// compute of placements are rounded.
constexpr double touching_tolerance = 1e-3;

// A chart that is rotated and scaled, as cells of a raster.
struct Rasterized_chart
{
  Texel_mask mask;          // no empty row or column at its sides
  Vector_2d centre = {};    // of the chart, in cells from the lower left corner of the mask
};

// p -> x p turned by the angle
struct Rotation_and_scale
{
  Rotation_and_scale(double angle, double scale)
    : c(scale * std::cos(angle)), s(scale * std::sin(angle))
  {}
  Vector_2d operator()(const Vector_2d& p) const
  {
    return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
  }
  double c, s;
};

// The bounding box (lower left, upper right) of an outline after a map.
inline std::array<Vector_2d, 2> bounding_box(const Chart_outline& outline,
                                             const Rotation_and_scale& map)
{
  std::array<Vector_2d, 2> box = {};
  bool is_first = true;
  for(const auto& part : outline.parts)
    for(const Outline_edge& e : part)
      for(const Vector_2d& p : {map(e.from), map(e.to)}) {
        for(int c = 0; c < 2; ++c) {
          box[0][c] = is_first ? p[c] : (std::min)(box[0][c], p[c]);
          box[1][c] = is_first ? p[c] : (std::max)(box[1][c], p[c]);
        }
        is_first = false;
      }
  return box;
}

// The number of cells that a length needs.
inline double cells_of(double length) { return std::ceil(length + 2. * touching_tolerance); }

// Adds the cells that a segment touches.
inline void add_segment(const Vector_2d& a, const Vector_2d& b, Texel_mask& mask)
{
  const Vector_2d &lo = a[1] < b[1] ? a : b, &hi = a[1] < b[1] ? b : a;
  const double height = hi[1] - lo[1], slope = height > 0. ? (hi[0] - lo[0]) / height : 0.;
  const int first = floor_of(lo[1] - touching_tolerance / 2.);
  const int last = floor_of(hi[1] + touching_tolerance / 2.);
  for(int y = first; y <= last; ++y) {
    // the ends of the part within the row, or somewhat more
    const double bottom = y - touching_tolerance, top = y + 1. + touching_tolerance;
    const double x = lo[1] >= bottom ? lo[0] : lo[0] + (bottom - lo[1]) * slope;
    const double z = hi[1] <= top ? hi[0] : lo[0] + (top - lo[1]) * slope;
    const double left = (std::max)((std::min)(x, z), (std::min)(a[0], b[0]));
    const double right = (std::min)((std::max)(x, z), (std::max)(a[0], b[0]));
    mask.add({y, floor_of(left - touching_tolerance / 2.),
              floor_of(right + touching_tolerance / 2.) + 1});
  }
}

// Where an outline crosses the middle of a row of cells.
struct Row_crossing
{
  double x;
  int winding;
  bool operator<(const Row_crossing& o) const { return x < o.x; }
};

// The crossings of each row, of which there are `rows`, one after the other; `ends` becomes where each
// row ends.
inline std::vector<Row_crossing> row_crossings(const std::vector<Outline_edge>& edges, int rows,
                                               std::vector<int>& ends)
{
  const auto first_row = [rows](double y) { return (std::min)(rows, (std::max)(0, ceil_of(y - 0.5))); };
  ends.assign(rows + 1, 0);
  for(const Outline_edge& e : edges) {
    const int from = first_row(e.from[1]), to = first_row(e.to[1]);
    for(int y = (std::min)(from, to); y < (std::max)(from, to); ++y)
      ++ends[y + 1];
  }
  for(int y = 0; y < rows; ++y)
    ends[y + 1] += ends[y];
  std::vector<Row_crossing> result(ends[rows]);
  for(const Outline_edge& e : edges) {
    const bool is_up = e.from[1] < e.to[1];
    const Vector_2d &lo = is_up ? e.from : e.to, &hi = is_up ? e.to : e.from;
    const int end = first_row(hi[1]);
    for(int y = first_row(lo[1]); y < end; ++y)
      result[ends[y]++] = {lo[0] + (y + 0.5 - lo[1]) * (hi[0] - lo[0]) / (hi[1] - lo[1]),
                           is_up ? e.winding : -e.winding};
  }
  ends.pop_back();
  return result;
}

// Adds the cells whose centres have a winding number other than 0.
inline void add_inside(const std::vector<Outline_edge>& edges, Texel_mask& mask)
{
  std::vector<int> ends;
  std::vector<Row_crossing> crossings = row_crossings(edges, mask.height(), ends);
  for(int y = 0, begin = 0; y < mask.height(); begin = ends[y++]) {
    std::sort(crossings.begin() + begin, crossings.begin() + ends[y]);
    int winding = 0;
    for(int i = begin; i + 1 < ends[y]; ++i) {
      winding += crossings[i].winding;
      if(winding != 0)
        mask.add({y, ceil_of(crossings[i].x - 0.5), ceil_of(crossings[i + 1].x - 0.5)});
    }
  }
}

// Adds the cells that an outline touches if its centre lies at `centre`, in cells from the lower
// left corner of the mask.
inline void add_outline(const Chart_outline& outline, const Rotation_and_scale& map,
                        const Vector_2d& centre, Texel_mask& mask)
{
  const int x = int(std::floor(centre[0])), y = int(std::floor(centre[1]));
  if(outline.diameter == 0.) // perhaps without any edge
    mask.add({y, x, x + 1});
  std::vector<Outline_edge> edges;
  for(const auto& part : outline.parts) {
    edges = part;
    for(Outline_edge& e : edges) {
      for(Vector_2d* p : {&e.from, &e.to}) {
        const Vector_2d q = map(*p);
        *p = {q[0] + centre[0], q[1] + centre[1]};
      }
      add_segment(e.from, e.to, mask);
    }
    add_inside(edges, mask);
  }
}

// The cells that an outline touches, its bounding box in the middle of as few rows and columns as
// it needs, or an empty mask if these are more than `max_width` and `max_height`. A chart without
// triangles takes one cell.
inline Rasterized_chart rasterize(const Chart_outline& outline, double angle, double scale,
                                  int max_width, int max_height)
{
  const Rotation_and_scale map(angle, scale);
  const auto box = bounding_box(outline, map);
  const double w = cells_of(box[1][0] - box[0][0]), h = cells_of(box[1][1] - box[0][1]);
  Rasterized_chart result;
  if(!(w <= max_width && h <= max_height))
    return result;
  result.mask = Texel_mask(int(w), int(h));
  result.centre = {0.5 * (w - box[1][0] - box[0][0]), 0.5 * (h - box[1][1] - box[0][1])};
  add_outline(outline, map, result.centre, result.mask);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H
