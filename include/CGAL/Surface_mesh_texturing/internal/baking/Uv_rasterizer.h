// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_UV_RASTERIZER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_UV_RASTERIZER_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
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

// Which samples of the unit square lie in which triangle of the plane. Sample (x, y), counted from
// the left and the top, is at u = (x + 1/2) / columns, v = 1 - (y + 1/2) / rows.
//
// Corners are rounded to a grid of 2^29 steps a side, samples lie on it, and all decisions are made
// in integers: a sample lies in exactly one of two triangles on either side of an edge, also if it
// lies on the edge (the triangle to the left of it in the image has it, or below if the edge is
// horizontal). Triangles must lie within [-1, 2]^2, which keeps products within 64 bits.
class Uv_rasterizer
{
public:
  typedef Textured_triangle_mesh::Point_2 Point_2;

  // Prepares bands of `band_rows` rows. Linear time.
  Uv_rasterizer(const std::vector<Point_2>& uv, const std::vector<Triangle_indices>& triangles,
                std::size_t columns, std::size_t rows, std::size_t band_rows);

  std::size_t columns() const { return m_columns; }
  std::size_t rows() const { return m_rows; }
  std::size_t number_of_bands() const { return m_begin.size() - 1; }
  std::size_t begin_row(std::size_t band) const { return band * m_band_rows; }
  std::size_t end_row(std::size_t band) const
  {
    return (std::min)(m_rows, (band + 1) * m_band_rows);
  }

  // Calls visit(t, x, y) for the samples in the rows of a band, by triangles in their order.
  template <class Visit>
  void visit(std::size_t band, const Visit& visit) const
  {
    for(std::size_t i = m_begin[band]; i < m_begin[band + 1]; ++i)
      visit_rows(m_triangle[i], std::int64_t(begin_row(band)), std::int64_t(end_row(band)), visit);
  }

  // Sets triangles[y * columns + x], where y counts from the first row of the band, to the first
  // triangle with that sample or to `no_triangle`.
  void first_triangles(std::size_t band, std::uint32_t* triangles) const
  {
    const std::size_t first = begin_row(band);
    std::fill_n(triangles, (end_row(band) - first) * m_columns, no_triangle);
    visit(band, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
      std::uint32_t& triangle = triangles[(std::size_t(y) - first) * m_columns + std::size_t(x)];
      triangle = (std::min)(triangle, t);
    });
  }

  // The point of triangle t at a sample that lies in it.
  Surface_point point(std::uint32_t t, std::size_t x, std::size_t y) const
  {
    const Corners p = corners(t);
    const Grid_point q = {at_sample(std::int64_t(x)), at_sample(std::int64_t(y))};
    const double scale = 1. / double(area(p[0], p[1], p[2]));
    return {t,
            {double(area(p[1], p[2], q)) * scale, double(area(p[2], p[0], q)) * scale,
             double(area(p[0], p[1], q)) * scale}};
  }

private:
  typedef std::array<std::int64_t, 2> Grid_point;
  typedef std::array<Grid_point, 3> Corners;

  // e + k * step_x + l * step_y is not negative if the k-th sample of the l-th row is on the side.
  struct Side
  {
    std::int64_t value, step_x, step_y;
  };

  static std::int64_t area(const Grid_point& p, const Grid_point& q, const Grid_point& r)
  {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  }

  std::int64_t at_sample(std::int64_t x) const
  {
    return (x << m_shift) + (std::int64_t(1) << (m_shift - 1));
  }

  // The first sample at or after a place on the grid.
  std::int64_t sample_from(std::int64_t place) const
  {
    return (place + (std::int64_t(1) << (m_shift - 1)) - 1) >> m_shift;
  }

  Corners corners(std::uint32_t t) const
  {
    Corners result;
    for(int c = 0; c < 3; ++c) {
      const auto& p = m_points[m_triangles[t][c]];
      result[c] = {p[0], p[1]};
    }
    return result;
  }

  // First and last + 1 row with a sample that the triangle may have; none if it has no area.
  std::array<std::int64_t, 2> row_range(std::uint32_t t) const
  {
    const Corners p = corners(t);
    const auto y = std::minmax({p[0][1], p[1][1], p[2][1]});
    const auto x = std::minmax({p[0][0], p[1][0], p[2][0]});
    if(sample_from(x.first) >= sample_from(x.second + 1))
      return {0, 0};
    return {(std::max)(sample_from(y.first), std::int64_t(0)),
            (std::min)(sample_from(y.second + 1), std::int64_t(m_rows))};
  }

  Side side(const Grid_point& p, const Grid_point& q, std::int64_t x, std::int64_t y) const
  {
    const std::int64_t dx = q[0] - p[0], dy = q[1] - p[1];
    const bool has_edge = dy > 0 || (dy == 0 && dx < 0);
    return {area(p, q, {at_sample(x), at_sample(y)}) - (has_edge ? 0 : 1), -dy * (1LL << m_shift),
            dx * (1LL << m_shift)};
  }

  template <class Visit>
  void visit_rows(std::uint32_t t, std::int64_t begin, std::int64_t end, const Visit& visit) const;

  void sort_into_bands();

  const std::vector<Triangle_indices>& m_triangles;
  std::size_t m_columns, m_rows, m_band_rows;
  int m_shift; // of the grid to the samples
  std::vector<std::array<std::int32_t, 2>> m_points;
  std::vector<std::size_t> m_begin;     // of each band, in
  std::vector<std::uint32_t> m_triangle; // those that meet it
};

inline Uv_rasterizer::Uv_rasterizer(const std::vector<Point_2>& uv,
                                    const std::vector<Triangle_indices>& triangles,
                                    std::size_t columns, std::size_t rows, std::size_t band_rows)
  : m_triangles(triangles), m_columns(columns), m_rows(rows), m_band_rows(band_rows), m_shift(29)
  , m_points(uv.size())
{
  CGAL_precondition(columns > 0 && rows > 0 && band_rows > 0);
  CGAL_precondition((std::max)(columns, rows) <= std::size_t(1) << 28);
  while(((std::max)(columns, rows) - 1) >> (29 - m_shift) > 0)
    --m_shift;
  const double per_u = std::ldexp(double(columns), m_shift);
  const double per_v = std::ldexp(double(rows), m_shift);
  Blocked_execution::blocked_for(uv.size(), 1 << 16, [&](std::size_t i, std::size_t last) {
    for(; i < last; ++i)
      m_points[i] = {std::int32_t(std::floor(uv[i].x() * per_u + 0.5)),
                     std::int32_t(std::floor((1. - uv[i].y()) * per_v + 0.5))};
  });
  sort_into_bands();
}

inline void Uv_rasterizer::sort_into_bands()
{
  const std::int64_t height = std::int64_t(m_band_rows);
  m_begin.assign(Blocked_execution::number_of_blocks(m_rows, m_band_rows) + 2, 0);
  std::vector<std::array<std::uint32_t, 2>> bands(m_triangles.size());
  Blocked_execution::blocked_for(bands.size(), 1 << 15, [&](std::size_t t, std::size_t last) {
    for(; t < last; ++t) {
      const auto rows = row_range(std::uint32_t(t));
      bands[t] = {0, 0};
      if(rows[0] < rows[1])
        bands[t] = {std::uint32_t(rows[0] / height), std::uint32_t((rows[1] - 1) / height + 1)};
    }
  });
  for(const auto& b : bands)
    for(std::uint32_t i = b[0]; i < b[1]; ++i)
      ++m_begin[i + 2];
  for(std::size_t i = 2; i < m_begin.size(); ++i)
    m_begin[i] += m_begin[i - 1];
  m_triangle.resize(m_begin.back());
  for(std::uint32_t t = 0; t < bands.size(); ++t)
    for(std::uint32_t i = bands[t][0]; i < bands[t][1]; ++i)
      m_triangle[m_begin[i + 1]++] = t;
  m_begin.pop_back();
}

template <class Visit>
void Uv_rasterizer::visit_rows(std::uint32_t t, std::int64_t begin, std::int64_t end,
                               const Visit& visit) const
{
  Corners p = corners(t);
  const std::int64_t twice = area(p[0], p[1], p[2]);
  if(twice == 0)
    return;
  if(twice < 0)
    std::swap(p[1], p[2]);
  const auto range = std::minmax({p[0][0], p[1][0], p[2][0]});
  const std::int64_t left = (std::max)(sample_from(range.first), std::int64_t(0));
  const std::int64_t right = (std::min)(sample_from(range.second + 1), std::int64_t(m_columns));
  const auto rows = row_range(t);
  begin = (std::max)(begin, rows[0]);
  end = (std::min)(end, rows[1]);
  if(left >= right || begin >= end)
    return;
  std::array<Side, 3> sides = {side(p[0], p[1], left, begin), side(p[1], p[2], left, begin),
                               side(p[2], p[0], left, begin)};
  for(std::int64_t y = begin; y < end; ++y) {
    // The samples k with value + k * step >= 0 on all sides
    std::int64_t first = 0, last = right - left - 1;
    for(Side& s : sides) {
      if(s.step_x > 0) {
        if(s.value < 0)
          first = (std::max)(first, (-s.value + s.step_x - 1) / s.step_x);
      } else if(s.value < 0) {
        last = -1;
      } else if(s.step_x < 0) {
        last = (std::min)(last, s.value / -s.step_x);
      }
      s.value += s.step_y;
    }
    for(std::int64_t k = first; k <= last; ++k)
      visit(t, left + k, y);
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_UV_RASTERIZER_H
