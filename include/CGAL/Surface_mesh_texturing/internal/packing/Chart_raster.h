// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_RASTER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_RASTER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/rasterize_outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A run of a chart as the union of two runs of 2^level cells.
struct Probe
{
  int y, first, second, level;
};

// The probes of the runs of a mask, those first that are likely to find an obstacle: every 2^k-th
// row, for decreasing k.
inline std::vector<Probe> probes_of(const std::vector<Cell_run>& runs)
{
  std::vector<Probe> result;
  result.reserve(runs.size());
  const auto rank = [](const Probe& p) { return p.y == 0 ? 32 : lowest_bit(Word(p.y)); };
  for(const Cell_run& run : runs) {
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

  // The number of the `n` cells that are taken at the offsets y * stride + x from a place.
  int number_of_taken(const int* offsets, int n, int x, int y) const
  {
    const std::uint8_t* place = m_framed.data() + index(x, y);
    int result = 0;
    for(int i = 0; i < n; ++i)
      result += place[offsets[i]];
    return result;
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
      for(int i = begin; i < end; ++i)
        free[i] &= ~obstacles(probe, words, i);
      while(begin < end && free[begin] == 0)
        ++begin;
      while(begin < end && free[end - 1] == 0)
        --end;
      if(begin == end)
        return false;
    }
    return true;
  }

  // The same for all positions of the rows [bottom, top), each of which has its words in `free`, as many
  // at a time as the processor can.
  bool restrict_to_free(const std::vector<Probe>& probes, int bottom, int top, Word* free) const
  {
    const int n = m_words * (top - bottom);
    for(const Probe& probe : probes) {
      const Word* words = row(probe.level, bottom + probe.y);
      Word any = 0;
      for(int i = 0; i < n; ++i) {
        free[i] &= ~obstacles(probe, words, i);
        any |= free[i];
      }
      if(any == 0)
        return false;
    }
    return true;
  }

private:
  typedef std::vector<Word> Level;

  // The positions of word i at which a probe meets a cell that is taken; `words` are those of its level, from
  // its row on.
  static Word obstacles(const Probe& probe, const Word* words, int i)
  {
    const Word *p = words + (probe.first >> 6) + i, *q = words + (probe.second >> 6) + i;
    const int s = probe.first & 63, t = probe.second & 63;
    return (p[0] >> s | p[1] << 1 << (63 - s)) | (q[0] >> t | q[1] << 1 << (63 - t));
  }

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

// The raster on which charts are packed: the part of a page that they may touch, in cells.
struct Packing_raster
{
  int width = 0, height = 0;
  double cell = 1.;         // the side of a cell, in texels
  int padding = 0;          // cells between charts
  Vector_2d origin = {};    // the lower left corner, in texels of the page
};

// The raster on which a packing is exact: its cells are the texels of the coarsest mip level.
// Without any cell if the page is too small.
inline Packing_raster exact_raster(const Packing_options& options)
{
  const std::size_t cell = std::size_t(1) << options.mip_levels;
  const std::size_t border = (options.padding + 1) / 2;
  const std::size_t columns = options.width / cell, rows = options.height / cell;
  Packing_raster result;
  if(columns <= 2 * border || rows <= 2 * border)
    return result;
  result.width = int(columns - 2 * border);
  result.height = int(rows - 2 * border);
  result.cell = double(cell);
  result.padding = int(options.padding);
  result.origin = {double(border * cell), double(options.height - rows * cell + border * cell)};
  return result;
}

// A raster of about `cells` cells, or the same if it has not more. Charts that touch a cell in part
// grow by half a cell on each side on average, and by half the padding; the padding is chosen such
// that both together are what they are on the exact raster, if possible.
inline Packing_raster coarser_raster(const Packing_raster& exact, double cells)
{
  const double ratio = std::sqrt(double(exact.width) * exact.height / cells);
  if(!(ratio > 1.))
    return exact;
  Packing_raster result = exact;
  result.cell = exact.cell * ratio;
  result.width = (std::max)(1, int(exact.width / ratio + 1e-6));
  result.height = (std::max)(1, int(exact.height / ratio + 1e-6));
  result.padding = (std::max)(0, int(std::lround((exact.padding + 1) / ratio)) - 1);
  return result;
}

// The raster of a draft, of about 512 cells along a page, or the exact one if that has not more. Cells are
// some texels wide, so that what is a packing there is one on the exact raster, with gaps a little wider.
inline Packing_raster draft_raster(const Packing_raster& exact)
{
  constexpr double cells = 512.;
  const int ratio = int(std::lround(std::sqrt(double(exact.width) * exact.height) / cells));
  if(ratio <= 1)
    return exact;
  Packing_raster result = exact;
  result.cell = exact.cell * ratio;
  result.width = (std::max)(1, exact.width / ratio);
  result.height = (std::max)(1, exact.height / ratio);
  result.padding = (exact.padding + ratio - 1) / ratio;
  return result;
}

// A chart in one direction on a raster.
struct Chart_raster
{
  int width = 0, height = 0;           // 0 if it is larger than the page
  Vector_2d centre = {};               // of the chart, from the lower left corner
  std::vector<Probe> probes;           // of the cells it touches
  std::vector<Cell_run> padded;        // these and the padding around, from the same corner
  std::vector<int> rim;                // some cells around it, see `rim_of()`
};

// Which charts have a rim: it takes more memory than the rest of a small chart.
enum class Rims { ALL, NONE };

inline Chart_raster chart_raster(const Chart_outline& outline, double angle, double density,
                                 const Packing_raster& raster, Rims rims)
{
  Chart_raster result;
  const Rasterized_chart chart
    = rasterize(outline, angle, density / raster.cell, raster.width, raster.height);
  if(chart.mask.width() == 0)
    return result;
  result.width = chart.mask.width();
  result.height = chart.mask.height();
  result.centre = chart.centre;
  result.probes = probes_of(chart.mask.runs());
  result.padded = dilated(chart.mask, raster.padding).runs();
  for(Cell_run& run : result.padded)
    run = {run.y - raster.padding, run.begin - raster.padding, run.end - raster.padding};
  if(rims == Rims::ALL)
    result.rim = rim_of(chart.mask, Page_raster::stride(raster.width));
  return result;
}

// The placement of a chart whose centre lies at `centre`, in cells.
inline Chart_placement chart_placement(const Chart_outline& outline, const Packing_raster& raster,
                                       std::uint32_t page, double angle, double scale,
                                       const Vector_2d& centre)
{
  Chart_placement result;
  result.page = page;
  result.angle = angle;
  result.scale = scale;
  const auto q = result(Chart_shape::Point_2(outline.centre[0], outline.centre[1]));
  result.offset = Chart_shape::Point_2(raster.origin[0] + centre[0] * raster.cell - q.x(),
                                       raster.origin[1] + centre[1] * raster.cell - q.y());
  return result;
}

// Why there is no packing: the chart for which no place was found, and whether it found none on an
// empty page.
inline std::string misfit_message(std::size_t chart, bool is_larger_than_page,
                                  const Packing_options& options)
{
  if(is_larger_than_page && options.texels_per_unit > 0.)
    return "chart " + std::to_string(chart) + " is larger than a page";
  return "the charts do not fit on " + std::to_string(options.max_pages) + " page"
         + (options.max_pages == 1 ? "" : "s")
         + (options.texels_per_unit > 0. ? " with this density" : ", however small they are");
}

// Charts at one density, in several directions each, made when they are needed.
class Chart_rasters
{
public:
  // `density` is in texels per unit of the outlines.
  Chart_rasters(const std::vector<Chart_outline>& outlines, int rotations, double density,
                const Packing_raster& raster, Rims rims = Rims::ALL)
    : m_outlines(outlines), m_rotations(rotations), m_density(density), m_raster(raster),
      m_rims(rims), m_charts(outlines.size() * rotations), m_is_made(m_charts.size(), 0)
  {}

  std::size_t size() const { return m_outlines.size(); }
  int rotations() const { return m_rotations; }
  const Packing_raster& raster() const { return m_raster; }

  double angle(std::size_t chart, int rotation) const
  {
    return m_outlines[chart].angle + 2. * CGAL_PI * rotation / m_rotations;
  }

  // Makes those for which `is_needed(chart, rotation)`.
  template <class Is_needed>
  void make_where(const Is_needed& is_needed)
  {
    Blocked_execution::blocked_for(m_charts.size(), 8, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        if(!m_is_made[i] && is_needed(i / m_rotations, int(i % m_rotations)))
          make_one(i);
    });
  }

  // Makes all directions of a chart.
  void make(std::size_t chart)
  {
    const std::size_t first = chart * m_rotations;
    Blocked_execution::blocked_for(m_rotations, 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = first + begin; i < first + end; ++i)
        if(!m_is_made[i])
          make_one(i);
    });
  }

  void make_all()
  {
    make_where([](std::size_t, int) { return true; });
  }

  // Returns a chart that has been made.
  const Chart_raster& made(std::size_t chart, int rotation) const
  {
    return m_charts[chart * m_rotations + rotation];
  }

  // Whether charts that are made have a rim.
  bool have_rims() const { return m_rims == Rims::ALL; }

  // Makes one more with a rim.
  Chart_raster with_rim(std::size_t chart, int rotation) const
  {
    return chart_raster(m_outlines[chart], angle(chart, rotation), m_density, m_raster, Rims::ALL);
  }

private:
  void make_one(std::size_t i)
  {
    const std::size_t chart = i / m_rotations;
    m_charts[i] = chart_raster(m_outlines[chart], angle(chart, int(i % m_rotations)), m_density,
                               m_raster, m_rims);
    m_is_made[i] = 1;
  }

  const std::vector<Chart_outline>& m_outlines;
  int m_rotations;
  double m_density;
  Packing_raster m_raster;
  Rims m_rims;
  std::vector<Chart_raster> m_charts; // the rotations of the first, of the second ...
  std::vector<char> m_is_made;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_CHART_RASTER_H
