// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Place_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A raster for charts that are grown by their share of the padding. On the finest one, whose cells
// are those of the exact raster, grown charts overlap just if they are too near to each other. On
// the others, whose cells are blocks of `ratio` x `ratio` of these, they overlap about as much.
struct Silhouette_raster
{
  Silhouette_raster(const Packing_raster& exact, int r)
    : ratio(r), cell(exact.cell * r), padding(exact.padding),
      width((exact.width + exact.padding + r / 2) / r),
      height((exact.height + exact.padding + r / 2) / r)
  {}

  int ratio;
  double cell; // in texels
  int padding; // in cells of the exact raster
  int width, height;
};

// A chart in one direction, grown by its share of the padding.
struct Silhouette
{
  int width = 0, height = 0;   // 0 if it is larger than the page
  Vector_2d centre = {};       // of the chart, from the lower left corner
  std::vector<Cell_run> runs;
  std::vector<int> row_begin;  // the first run of each row, and the end of all
};

inline Silhouette silhouette_of(const Texel_mask& mask, const Vector_2d& centre)
{
  Silhouette result;
  result.width = mask.width();
  result.height = mask.height();
  result.centre = centre;
  result.runs = mask.runs();
  result.row_begin.assign(mask.height() + 1, 0);
  for(const Cell_run& run : result.runs)
    ++result.row_begin[run.y + 1];
  for(int y = 0; y < mask.height(); ++y)
    result.row_begin[y + 1] += result.row_begin[y];
  return result;
}

// The side of the blocks of cells that become one, see `halftone()`.
constexpr int halftone_side = 4;

// For the blocks of a row of words, in each of the bytes of two words a block, those of even and of odd
// numbers: how many cells of the row they have.
inline std::array<Word, 2> cells_of_blocks(Word w)
{
  constexpr Word pairs = 0x5555555555555555, fours = 0x3333333333333333, bytes = 0x0f0f0f0f0f0f0f0f;
  w -= w >> 1 & pairs;
  w = (w & fours) + (w >> 2 & fours);
  return {w & bytes, w >> 4 & bytes};
}

// Blocks of 4 x 4 cells, the mask in the middle of as few as it needs, at least half of which are in the
// mask; or all that meet it if there are none. Counts 16 blocks at a time.
inline Rasterized_chart halftone(const Rasterized_chart& fine)
{
  constexpr int side = halftone_side, blocks_of_word = 64 / side;
  constexpr Word ones = 0x0101010101010101;
  const int w = fine.mask.width(), h = fine.mask.height();
  const int columns = (w + side - 1) / side, rows = (h + side - 1) / side;
  const int left = (columns * side - w) / 2, bottom = (rows * side - h) / 2;
  Texel_mask framed(columns * side, rows * side);
  for(int y = 0; y < h; ++y) {
    Word* row = framed.row(y + bottom);
    for(int i = 0; i < fine.mask.words(); ++i)
      row[i] = fine.mask.row(y)[i];
    if(left > 0)
      for(int i = framed.words() - 1; i >= 0; --i)
        row[i] = row[i] << left | (i > 0 ? row[i - 1] >> (64 - left) : 0);
  }
  Rasterized_chart result;
  for(const int least : {side * side / 2, 1}) {
    Texel_mask blocks(columns, rows);
    int x0 = columns, x1 = 0, y0 = rows, y1 = 0;
    for(int y = 0; y < rows; ++y)
      for(int i = 0; i < framed.words(); ++i) {
        std::array<Word, 2> count = {};
        for(int k = 0; k < side; ++k) {
          const std::array<Word, 2> more = cells_of_blocks(framed.row(y * side + k)[i]);
          count = {count[0] + more[0], count[1] + more[1]};
        }
        Word found = 0; // bit 4 b for block b
        for(int odd = 0; odd < 2; ++odd)
          found |= ((count[odd] + (0x80 - Word(least)) * ones) & 0x80 * ones) >> (7 - 4 * odd);
        for(; found != 0; found &= found - 1) {
          const int x = i * blocks_of_word + lowest_bit(found) / side;
          blocks.add({y, x, x + 1});
          x0 = (std::min)(x0, x);
          x1 = (std::max)(x1, x + 1);
          y0 = (std::min)(y0, y);
          y1 = y + 1;
        }
      }
    if(x0 >= x1)
      continue;
    result.mask = Texel_mask(x1 - x0, y1 - y0);
    for(int y = y0; y < y1; ++y) {
      const Word* from = blocks.row(y);
      Word* to = result.mask.row(y - y0);
      for(int x = x0; x < x1; x += 64) {
        const int i = x >> 6, s = x & 63;
        const Word last = (x1 - x) < 64 ? (Word(1) << (x1 - x)) - 1 : ~Word(0);
        to[(x - x0) >> 6] = (from[i] >> s | (i + 1 < blocks.words() ? from[i + 1] << 1 << (63 - s) : 0)) & last;
      }
    }
    result.centre = {(fine.centre[0] + left) / side - x0, (fine.centre[1] + bottom) / side - y0};
    break;
  }
  return result;
}

// The silhouette of an outline at a density in texels per unit.
inline Silhouette silhouette(const Chart_outline& outline, double angle, double density,
                             const Silhouette_raster& raster)
{
  constexpr int samples = halftone_side; // of a side of a cell
  const bool is_exact = raster.ratio == 1;
  const double cell = is_exact ? 1. : double(raster.ratio) / samples; // of the exact raster
  const int parts = is_exact ? 1 : samples;
  // Charts that touch a cell in part grow by half a cell on each side on average
  const double growth = 0.5 * (raster.padding + 1) / cell - 0.5;
  const int sweep = is_exact ? raster.padding : (std::max)(0, 2 * int(std::lround(growth)));
  Rasterized_chart chart
    = rasterize(outline, angle, density * raster.ratio / (raster.cell * cell),
                raster.width * parts - sweep, raster.height * parts - sweep);
  if(chart.mask.width() == 0)
    return Silhouette();
  chart.mask = swept(chart.mask, sweep);
  for(double& c : chart.centre)
    c += 0.5 * sweep;
  if(!is_exact)
    chart = halftone(chart);
  return silhouette_of(chart.mask, chart.centre);
}

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
      least = result[0];
      for(int k = 1; k < n; ++k) // some at a time, unlike std::min_element()
        least = (std::min)(least, result[k]);
    }
    return least;
  }

private:
  int m_x = 0, m_y = 0, m_width = 0, m_height = 0;
  std::vector<int> m_sums; // of each row, one more than it has cells
};

// Where the centre of a chart lies, on any raster.
struct Loose_place
{
  std::uint32_t page = 0;
  int rotation = 0;
  Vector_2d centre = {}; // in cells of the finest `Silhouette_raster`
};

// The silhouettes of all charts at one density on one raster, made when they are needed.
class Silhouettes
{
public:
  // The outlines and `work`, to which about the nanoseconds are added, must outlive this.
  Silhouettes(const std::vector<Chart_outline>& outlines, int rotations, double density,
              const Silhouette_raster& raster, double& work)
    : m_outlines(outlines), m_rotations(rotations), m_density(density), m_raster(raster),
      m_work(work), m_silhouettes(outlines.size() * rotations)
  {}

  const std::vector<Chart_outline>& outlines() const { return m_outlines; }
  const Silhouette_raster& raster() const { return m_raster; }
  std::size_t size() const { return m_outlines.size(); }
  int rotations() const { return m_rotations; }

  const Silhouette& operator()(std::size_t chart, int rotation)
  {
    std::unique_ptr<Silhouette>& s = m_silhouettes[chart * m_rotations + rotation];
    if(!s) {
      const Chart_outline& outline = m_outlines[chart];
      const double angle = outline.angle + 2. * CGAL_PI * rotation / m_rotations;
      s.reset(new Silhouette(silhouette(outline, angle, m_density, m_raster)));
      m_work += work_of(outline, *s);
    }
    return *s;
  }

  // The place nearest to another, within the page if the chart has a silhouette.
  Raster_place raster_place(std::size_t chart, const Loose_place& place)
  {
    const Silhouette& s = (*this)(chart, place.rotation);
    Raster_place result;
    result.page = place.page;
    result.rotation = place.rotation;
    constexpr double half = 0.5 - 1e-6; // halves are frequent, and must not depend on rounding
    const int x = int(std::floor(place.centre[0] / m_raster.ratio - s.centre[0] + half));
    const int y = int(std::floor(place.centre[1] / m_raster.ratio - s.centre[1] + half));
    result.x = (std::max)(0, (std::min)(m_raster.width - s.width, x));
    result.y = (std::max)(0, (std::min)(m_raster.height - s.height, y));
    return result;
  }

  Loose_place loose_place(std::size_t chart, const Raster_place& place)
  {
    const Silhouette& s = (*this)(chart, place.rotation);
    Loose_place result;
    result.page = place.page;
    result.rotation = place.rotation;
    result.centre = {m_raster.ratio * (place.x + s.centre[0]),
                     m_raster.ratio * (place.y + s.centre[1])};
    return result;
  }

private:
  // About the nanoseconds: each edge is drawn, each sample is read.
  double work_of(const Chart_outline& outline, const Silhouette& s) const
  {
    std::size_t edges = 0;
    for(const auto& part : outline.parts)
      edges += part.size();
    const double samples = m_raster.ratio == 1 ? 1. : 16.; // of a cell
    return 1e3 + 30. * double(edges) + samples * s.width * s.height;
  }

  const std::vector<Chart_outline>& m_outlines;
  int m_rotations;
  double m_density;
  Silhouette_raster m_raster;
  double& m_work;
  std::vector<std::unique_ptr<Silhouette>> m_silhouettes;
};

// Charts on pages of a raster, which may overlap.
class Arrangement
{
public:
  explicit Arrangement(Silhouettes& silhouettes) : m_silhouettes(silhouettes) {}

  std::size_t size() const { return m_places.size(); }
  Silhouettes& silhouettes() { return m_silhouettes; }
  const Raster_place& place(std::size_t chart) const { return m_places[chart]; }

  // Whether each chart is smaller than a page in the direction it was given.
  bool is_possible() const { return m_is_possible; }

  void set(const std::vector<Loose_place>& places)
  {
    const std::size_t n = places.size();
    m_places.resize(n);
    for(std::size_t i = 0; i < n; ++i)
      m_places[i] = m_silhouettes.raster_place(i, places[i]);
    m_overlaps.assign(n * n, 0);
    m_sums.assign(n, 0);
    m_is_possible = true;
    for(std::size_t i = 0; i < n; ++i)
      m_is_possible = m_is_possible && m_silhouettes(i, m_places[i].rotation).width > 0;
    for(std::size_t i = 0; i < n; ++i)
      update(i);
  }

  std::vector<Loose_place> loose_places()
  {
    std::vector<Loose_place> result(size());
    for(std::size_t i = 0; i < size(); ++i)
      result[i] = m_silhouettes.loose_place(i, m_places[i]);
    return result;
  }

  void move(std::size_t chart, const Raster_place& place)
  {
    m_places[chart] = place;
    update(chart);
  }

  // In cells.
  int overlap_of(std::size_t i, std::size_t j) const { return m_overlaps[i * size() + j]; }
  std::int64_t overlap_of(std::size_t i) const { return m_sums[i]; }

  // The charts whose bounding boxes are at most `reach` away from that of a chart.
  std::vector<std::size_t> neighbours(std::size_t i, int reach)
  {
    const Raster_place& p = m_places[i];
    const Silhouette& s = m_silhouettes(i, p.rotation);
    std::vector<std::size_t> result;
    for(std::size_t j = 0; j < size(); ++j) {
      const Raster_place& q = m_places[j];
      const Silhouette& t = m_silhouettes(j, q.rotation);
      if(j != i && q.page == p.page && q.x - reach < p.x + s.width && p.x - reach < q.x + t.width
         && q.y - reach < p.y + s.height && p.y - reach < q.y + t.height)
        result.push_back(j);
    }
    return result;
  }

  std::int64_t total_overlap() const
  {
    std::int64_t sum = 0;
    for(const std::int64_t s : m_sums)
      sum += s;
    return sum / 2;
  }

private:
  void update(std::size_t i)
  {
    const Raster_place& p = m_places[i];
    const Silhouette& s = m_silhouettes(i, p.rotation);
    for(std::size_t j = 0; j < size(); ++j) {
      const Raster_place& q = m_places[j];
      int& old = m_overlaps[i * size() + j];
      int now = 0;
      if(j != i && q.page == p.page)
        now = overlap(s, m_silhouettes(j, q.rotation), q.x - p.x, q.y - p.y);
      m_sums[i] += now - old;
      m_sums[j] += now - old;
      old = m_overlaps[j * size() + i] = now;
    }
  }

  Silhouettes& m_silhouettes;
  std::vector<Raster_place> m_places;
  std::vector<int> m_overlaps; // of each pair
  std::vector<std::int64_t> m_sums;
  bool m_is_possible = true;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_ARRANGEMENT_H
