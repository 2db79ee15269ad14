// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <array>
#include <cmath>
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
  std::vector<Cell_run> longest_first; // the same runs
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
  result.longest_first = result.runs;
  std::stable_sort(result.longest_first.begin(), result.longest_first.end(),
                   [](const Cell_run& a, const Cell_run& b) { return a.end - a.begin > b.end - b.begin; });
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

// Of the blocks of 4 x 4 cells of a mask those at least `least` cells of which, at most half of all, are in
// it; 16 blocks are counted at a time.
inline Texel_mask blocks_of(const Texel_mask& mask, int least)
{
  constexpr int side = halftone_side, blocks_of_word = 64 / side;
  constexpr Word ones = 0x0101010101010101;
  Texel_mask result(mask.width() / side, mask.height() / side);
  for(int y = 0; y < result.height(); ++y)
    for(int i = 0; i < mask.words(); ++i) {
      std::array<Word, 2> count = {};
      for(int k = 0; k < side; ++k) {
        const std::array<Word, 2> more = cells_of_blocks(mask.row(side * y + k)[i]);
        count = {count[0] + more[0], count[1] + more[1]};
      }
      Word found = 0; // bit 4 b for block b
      for(int odd = 0; odd < 2; ++odd)
        found |= ((count[odd] + (0x80 - Word(least)) * ones) & 0x80 * ones) >> (7 - 4 * odd);
      for(; found != 0; found &= found - 1) {
        const int x = i * blocks_of_word + lowest_bit(found) / side;
        result.add({y, x, x + 1});
      }
    }
  return result;
}

// Blocks of 4 x 4 cells, the mask in the middle of as few as it needs, at least half of which are in the
// mask; or all that meet it if there are none.
inline Rasterized_chart halftone(const Rasterized_chart& fine)
{
  constexpr int side = halftone_side;
  const int w = fine.mask.width(), h = fine.mask.height();
  const int columns = (w + side - 1) / side, rows = (h + side - 1) / side;
  const int left = (columns * side - w) / 2, bottom = (rows * side - h) / 2;
  Texel_mask framed(columns * side, rows * side);
  for(const Cell_run& run : fine.mask.runs())
    framed.add({run.y + bottom, run.begin + left, run.end + left});
  std::vector<Cell_run> runs = blocks_of(framed, side * side / 2).runs();
  if(runs.empty())
    runs = blocks_of(framed, 1).runs();
  int x0 = columns, x1 = 0;
  for(const Cell_run& run : runs) {
    x0 = (std::min)(x0, run.begin);
    x1 = (std::max)(x1, run.end);
  }
  const int y0 = runs.front().y;
  Rasterized_chart result;
  result.mask = Texel_mask(x1 - x0, runs.back().y + 1 - y0);
  for(const Cell_run& run : runs)
    result.mask.add({run.y - y0, run.begin - x0, run.end - x0});
  result.centre = {(fine.centre[0] + left) / side - x0, (fine.centre[1] + bottom) / side - y0};
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

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H
