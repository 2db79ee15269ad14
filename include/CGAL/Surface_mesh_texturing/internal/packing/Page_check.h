// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_CHECK_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_CHECK_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A place on one of the pages.
struct Page_place
{
  std::size_t page;
  Vector_2d place;
};

// Puts charts on the raster of a page each, and finds where they are not a packing: beyond the sides, or
// without their padding between them.
class Page_check
{
public:
  Page_check(const Packing_options& options, std::size_t pages)
    : m_raster(exact_raster(options)), m_pages(pages, Texel_mask(m_raster.width, m_raster.height))
  {}

  // `outline` is relative to its centre, which is in texels on the page.
  void add(const Chart_outline& outline, std::size_t page)
  {
    const double cells = 1. / m_raster.cell;
    const auto box = bounding_box(outline, Rotation_and_scale(0., cells));
    std::array<int, 2> low, high;
    Vector_2d centre;
    for(int c = 0; c < 2; ++c) {
      centre[c] = (outline.centre[c] - m_raster.origin[c]) * cells;
      low[c] = int(std::floor(centre[c] + box[0][c] - touching_tolerance));
      high[c] = int(std::floor(centre[c] + box[1][c] + touching_tolerance)) + 1;
      centre[c] -= low[c];
    }
    Texel_mask mask(high[0] - low[0], high[1] - low[1]);
    add_outline(outline, Rotation_and_scale(0., cells), centre, mask);
    const int padding = m_raster.padding;
    for(const Cell_run& run : dilated(mask, padding).runs())
      if(const int x = first_in_page(page, run, low[0] - padding, low[1] - padding); x >= 0)
        add_fault(page, x, run.y + low[1] - padding);
    for(const Cell_run& run : mask.runs()) {
      const Cell_run moved = {run.y + low[1], run.begin + low[0], run.end + low[0]};
      m_pages[page].add(moved);
      if(moved.y < 0 || moved.y >= m_raster.height || moved.begin < 0)
        add_fault(page, moved.begin, moved.y);
      if(moved.y < 0 || moved.y >= m_raster.height || moved.end > m_raster.width)
        add_fault(page, moved.end, moved.y);
    }
  }

  const std::vector<Page_place>& faults() const { return m_faults; }

  // The part of all texels of the pages that charts touch.
  double texel_utilisation(const Packing_options& options) const
  {
    double touched = 0.;
    for(const Texel_mask& page : m_pages)
      touched += double(page.count()) * m_raster.cell * m_raster.cell;
    return touched / (double(options.width) * double(options.height) * double(m_pages.size()));
  }

private:
  // The first cell of a run, moved by (x, y), that a chart has already, or -1.
  int first_in_page(std::size_t page, const Cell_run& run, int x, int y) const
  {
    const int row = run.y + y, end = (std::min)(m_raster.width, run.end + x);
    if(row < 0 || row >= m_raster.height)
      return -1;
    for(int i = (std::max)(0, run.begin + x); i < end; i = (i | 63) + 1) {
      const Word word = m_pages[page].row(row)[i >> 6] & ~Word(0) << (i & 63);
      if(word != 0)
        return (i & ~63) + lowest_bit(word) < end ? (i & ~63) + lowest_bit(word) : -1;
    }
    return -1;
  }

  void add_fault(std::size_t page, int x, int y)
  {
    m_faults.push_back({page, {m_raster.origin[0] + (x + 0.5) * m_raster.cell,
                               m_raster.origin[1] + (y + 0.5) * m_raster.cell}});
  }

  Packing_raster m_raster;
  std::vector<Texel_mask> m_pages;
  std::vector<Page_place> m_faults;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PAGE_CHECK_H
