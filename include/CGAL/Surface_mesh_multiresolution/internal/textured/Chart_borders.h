// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_CHART_BORDERS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_CHART_BORDERS_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A wedge on the border of a chart.
struct Chart_border_corner
{
  Textured_triangle_mesh::Point_2 uv;
  Vertex_index wedge, vertex;
};

// The corners of the borders of all charts of a texture, in a grid.
//
//      a --- c        A border goes over a, b and c. Without b it takes the chord a - c, and stays
//       \   /   x     simple, and apart from the other borders, exactly if none of their corners
//         b           lies in the closed triangle a b c: an edge that crosses the chord leaves the
//                     triangle through a - b or b - c, which it does not cross, or ends in it.
//
// Where borders touch or overlap from the start (mirrored halves that share their texture, the two
// sides of a cut, folds), nothing can be kept apart: corners that lie in a triangle of the texture
// that is not theirs are left out.
class Chart_borders
{
public:
  typedef Textured_triangle_mesh::Point_2 Point_2;

  Chart_borders() {}

  // The corners that no other of the triangles has in it. `triangles` have indices into `uv`.
  Chart_borders(std::vector<Chart_border_corner> corners,
                const std::vector<Triangle_indices>& triangles, const std::vector<Point_2>& uv)
  {
    set(std::move(corners));
    remove_covered(triangles, uv);
  }

  std::size_t number_of_corners() const { return m_corners.size(); }

  // Leaves out the corners that are gone; makes the grid anew, as coarse as they are now.
  template <class IsGone>
  void update(const IsGone& is_gone)
  {
    std::vector<Chart_border_corner> corners = std::move(m_corners);
    corners.erase(std::remove_if(corners.begin(), corners.end(), is_gone), corners.end());
    set(std::move(corners));
  }

  // Whether the closed triangle of three wedges has no corner but its own and those that are gone.
  template <class IsGone>
  bool is_free(const Triangle_indices& wedges, const std::vector<Point_2>& uv,
               const IsGone& is_gone) const
  {
    const Triangle triangle = {uv[wedges[0]], uv[wedges[1]], uv[wedges[2]]};
    return !for_each_near(triangle, [&](std::size_t i) {
      const Chart_border_corner& corner = m_corners[i];
      return is_in_box(corner.uv, triangle) && !is_one_of(corner.wedge, wedges)
          && !is_gone(corner) && is_in(corner.uv, triangle);
    });
  }

private:
  typedef std::array<Point_2, 3> Triangle;

  // Cells for each corner: most triangles near a border lie in one, and few others near corners.
  static constexpr double cells_per_corner = 16.;

  // By how much of a cell rounding may be wrong, and more.
  static constexpr double slack = 1e-6;

  static bool is_one_of(Vertex_index w, const Triangle_indices& wedges)
  {
    return w == wedges[0] || w == wedges[1] || w == wedges[2];
  }

  static bool is_in_box(const Point_2& p, const Triangle& t)
  {
    return p.x() >= (std::min)({t[0].x(), t[1].x(), t[2].x()})
        && p.x() <= (std::max)({t[0].x(), t[1].x(), t[2].x()})
        && p.y() >= (std::min)({t[0].y(), t[1].y(), t[2].y()})
        && p.y() <= (std::max)({t[0].y(), t[1].y(), t[2].y()});
  }

  static Orientation exact_orientation(const Point_2& p, const Point_2& q, const Point_2& r)
  {
    typedef Exact_predicates_inexact_constructions_kernel Exact;
    return CGAL::orientation(Exact::Point_2(p.x(), p.y()), Exact::Point_2(q.x(), q.y()),
                             Exact::Point_2(r.x(), r.y()));
  }

  // Whether a point of its box lies in a closed triangle, of whatever orientation, or without area.
  static bool is_in(const Point_2& p, const Triangle& t)
  {
    bool is_left = false, is_right = false;
    for(int c = 0; c < 3; ++c) {
      const Orientation side = exact_orientation(t[c], t[(c + 1) % 3], p);
      is_left = is_left || side == LEFT_TURN;
      is_right = is_right || side == RIGHT_TURN;
    }
    return !(is_left && is_right);
  }

  // The column or row of a coordinate; monotone, whatever is rounded.
  std::int32_t cell(double x, int c) const
  {
    const double at = (x - m_origin[c]) * m_cells_per_unit; // not a number beyond all range: 0
    return std::int32_t((std::min)((std::max)(0., at), double(m_size[c] - 1)));
  }

  std::size_t cell(const Point_2& p) const
  {
    return std::size_t(cell(p.y(), 1)) * std::size_t(m_size[0]) + std::size_t(cell(p.x(), 0));
  }

  void set(std::vector<Chart_border_corner> corners);
  std::vector<std::uint8_t> cells_empty_around() const;
  void remove_covered(const std::vector<Triangle_indices>& triangles,
                      const std::vector<Point_2>& uv);
  std::pair<std::int32_t, std::int32_t> columns_in_row(const Triangle& t, std::int32_t row) const;

  // Calls use(i) for the corners in the cells that a triangle meets, and a few more, until one
  // returns true; returns whether one did.
  template <class Use>
  bool for_each_near(const Triangle& t, const Use& use) const
  {
    if(m_corners.empty())
      return false;
    const std::int32_t bottom = cell((std::min)({t[0].y(), t[1].y(), t[2].y()}), 1);
    const std::int32_t top = cell((std::max)({t[0].y(), t[1].y(), t[2].y()}), 1);
    const std::int32_t left = cell((std::min)({t[0].x(), t[1].x(), t[2].x()}), 0);
    const std::int32_t right = cell((std::max)({t[0].x(), t[1].x(), t[2].x()}), 0);
    for(std::int32_t row = bottom; row <= top; ++row) {
      std::pair<std::int32_t, std::int32_t> columns(left, right);
      if(top - bottom > 1 && right - left > 1)
        columns = columns_in_row(t, row);
      const std::size_t first = std::size_t(row) * std::size_t(m_size[0]);
      const std::uint32_t end = m_begin[first + std::size_t(columns.second) + 1];
      for(std::uint32_t i = m_begin[first + std::size_t(columns.first)]; i < end; ++i)
        if(use(i))
          return true;
    }
    return false;
  }

  std::vector<Chart_border_corner> m_corners; // by cell
  std::vector<std::uint32_t> m_begin;         // of each cell, row by row
  std::array<double, 2> m_origin = {};
  std::array<std::int32_t, 2> m_size = {{1, 1}};
  double m_cells_per_unit = 0.;
};

// Sorts corners into cells, which is a stable counting sort.
inline void Chart_borders::set(std::vector<Chart_border_corner> corners)
{
  m_corners.clear();
  m_begin.assign(2, 0);
  if(corners.empty())
    return;
  const Point_2& first = corners[0].uv;
  std::array<double, 2> lo = {first.x(), first.y()}, hi = lo;
  for(const Chart_border_corner& corner : corners)
    for(int c = 0; c < 2; ++c) {
      lo[c] = (std::min)(lo[c], corner.uv[c]);
      hi[c] = (std::max)(hi[c], corner.uv[c]);
    }
  const double cells = cells_per_corner * double(corners.size());
  const double longer = (std::max)(hi[0] - lo[0], hi[1] - lo[1]);
  const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]);
  // Not more cells along a side than there may be in all, in a box as thin as it likes
  const double per_unit = (std::min)(std::sqrt(cells / area), cells / longer);
  m_cells_per_unit = longer > 0. && std::isfinite(per_unit) ? per_unit : 0.;
  m_origin = lo;
  for(int c = 0; c < 2; ++c)
    m_size[c] = m_cells_per_unit > 0. ? 1 + std::int32_t((hi[c] - lo[c]) * m_cells_per_unit) : 1;
  m_begin.assign(std::size_t(m_size[0]) * std::size_t(m_size[1]) + 1, 0);
  for(const Chart_border_corner& corner : corners)
    ++m_begin[cell(corner.uv) + 1];
  for(std::size_t i = 1; i < m_begin.size(); ++i)
    m_begin[i] += m_begin[i - 1];
  std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
  m_corners.resize(corners.size());
  for(const Chart_border_corner& corner : corners)
    m_corners[next[cell(corner.uv)]++] = corner;
}

// For each cell whether there is no corner in it and those around it.
inline std::vector<std::uint8_t> Chart_borders::cells_empty_around() const
{
  const std::size_t columns = std::size_t(m_size[0]), rows = std::size_t(m_size[1]);
  std::vector<std::uint8_t> result(columns * rows, 1);
  for(std::size_t row = 0; row < rows; ++row)
    for(std::size_t column = 0; column < columns; ++column) {
      if(m_begin[row * columns + column] == m_begin[row * columns + column + 1])
        continue;
      for(std::size_t r = row - (row > 0); r <= (std::min)(row + 1, rows - 1); ++r)
        for(std::size_t c = column - (column > 0); c <= (std::min)(column + 1, columns - 1); ++c)
          result[r * columns + c] = 0;
    }
  return result;
}

inline void Chart_borders::remove_covered(const std::vector<Triangle_indices>& triangles,
                                          const std::vector<Point_2>& uv)
{
  if(m_corners.empty())
    return;
  constexpr std::size_t block = 16384;
  // Most triangles lie in a cell and those around it without any corner, which a number for each
  // wedge tells: that of its cell, in rows with a gap between them, and whether all are empty.
  const std::vector<std::uint8_t> is_empty = cells_empty_around();
  const std::uint32_t stride = std::uint32_t(m_size[0]) + 2;
  std::vector<std::uint32_t> place(uv.size());
  Blocked_execution::blocked_for(uv.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t w = begin; w < end; ++w) {
      const std::uint32_t column = std::uint32_t(cell(uv[w].x(), 0));
      const std::uint32_t row = std::uint32_t(cell(uv[w].y(), 1));
      place[w] = 2 * (row * stride + column) + is_empty[std::size_t(row) * m_size[0] + column];
    }
  });
  const auto is_beside = [stride](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t d = a > b ? a - b : b - a;
    return d <= 1 || (d >= stride - 1 && d <= stride + 1);
  };
  std::vector<std::vector<std::uint32_t>> covered(
    Blocked_execution::number_of_blocks(triangles.size(), block));
  Blocked_execution::blocked_for(triangles.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t) {
      const Triangle_indices& wedges = triangles[t];
      const std::uint32_t at = place[wedges[0]];
      if(at % 2 == 1 && is_beside(at / 2, place[wedges[1]] / 2)
         && is_beside(at / 2, place[wedges[2]] / 2))
        continue;
      const Triangle triangle = {uv[wedges[0]], uv[wedges[1]], uv[wedges[2]]};
      for_each_near(triangle, [&](std::size_t i) {
        if(is_in_box(m_corners[i].uv, triangle) && !is_one_of(m_corners[i].wedge, wedges)
           && is_in(m_corners[i].uv, triangle))
          covered[begin / block].push_back(std::uint32_t(i));
        return false;
      });
    }
  });
  std::vector<bool> is_covered(m_corners.size(), false);
  for(const auto& found : covered)
    for(const std::uint32_t i : found)
      is_covered[i] = true;
  const Chart_border_corner* first = m_corners.data();
  std::vector<Chart_border_corner> rest;
  for(const Chart_border_corner& corner : m_corners)
    if(!is_covered[std::size_t(&corner - first)])
      rest.push_back(corner);
  set(std::move(rest));
}

// The columns of a row that a triangle meets.
inline std::pair<std::int32_t, std::int32_t>
Chart_borders::columns_in_row(const Triangle& t, std::int32_t row) const
{
  // The outer rows have all that is beyond them
  const double far = 1e300;
  const double bottom = row == 0 ? -far : m_origin[1] + (row - slack) / m_cells_per_unit;
  const double top = row + 1 == m_size[1] ? far
                                          : m_origin[1] + (row + 1 + slack) / m_cells_per_unit;
  double left = far, right = -far;
  const auto add = [&](double x) {
    left = (std::min)(left, x);
    right = (std::max)(right, x);
  };
  for(int c = 0; c < 3; ++c) {
    const Point_2 &p = t[c], &q = t[(c + 1) % 3];
    if(p.y() >= bottom && p.y() <= top)
      add(p.x());
    for(const double y : {bottom, top})
      if((p.y() < y) != (q.y() < y))
        add(p.x() + (q.x() - p.x()) * ((y - p.y()) / (q.y() - p.y())));
  }
  const double around = slack / m_cells_per_unit;
  return {cell(left - around, 0), cell(right + around, 0)};
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_CHART_BORDERS_H
