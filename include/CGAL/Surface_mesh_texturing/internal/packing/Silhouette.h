// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <cmath>
#include <utility>
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

// Blocks of `size` x `size` cells, the mask in the middle of as few as it needs, at least half of
// which are in the mask; or all that meet it if there are none.
inline Rasterized_chart halftone(const Rasterized_chart& fine, int size)
{
  const int w = fine.mask.width(), h = fine.mask.height();
  const int columns = (w + size - 1) / size, rows = (h + size - 1) / size;
  const int left = (columns * size - w) / 2, bottom = (rows * size - h) / 2;
  std::vector<int> count(std::size_t(columns) * rows, 0);
  for(const Cell_run& run : fine.mask.runs()) {
    int* row = count.data() + std::size_t((run.y + bottom) / size) * columns;
    for(int x = run.begin + left; x < run.end + left;) {
      const int next = (std::min)(run.end + left, (x / size + 1) * size);
      row[x / size] += next - x;
      x = next;
    }
  }
  const int most = *std::max_element(count.begin(), count.end());
  const int least = most * 2 >= size * size ? (size * size + 1) / 2 : 1;
  int x0 = columns, x1 = 0, y0 = rows, y1 = 0;
  for(int y = 0; y < rows; ++y)
    for(int x = 0; x < columns; ++x)
      if(count[std::size_t(y) * columns + x] >= least) {
        x0 = (std::min)(x0, x);
        x1 = (std::max)(x1, x + 1);
        y0 = (std::min)(y0, y);
        y1 = (std::max)(y1, y + 1);
      }
  Rasterized_chart result;
  result.mask = Texel_mask(x1 - x0, y1 - y0);
  result.centre = {(fine.centre[0] + left) / size - x0, (fine.centre[1] + bottom) / size - y0};
  for(int y = y0; y < y1; ++y)
    for(int x = x0; x < x1; ++x)
      if(count[std::size_t(y) * columns + x] >= least)
        result.mask.add({y - y0, x - x0, x - x0 + 1});
  return result;
}

// The silhouette of an outline at a density in texels per unit.
inline Silhouette silhouette(const Chart_outline& outline, double angle, double density,
                             const Silhouette_raster& raster)
{
  constexpr int samples = 4; // of a side of a cell
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
    chart = halftone(chart, samples);
  return silhouette_of(chart.mask, chart.centre);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_SILHOUETTE_H
