// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_PIECES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_PIECES_H

#include <CGAL/Surface_mesh_texturing/internal/filling/Control_net.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A straight piece of a border.
struct Border_piece
{
  std::uint32_t sample = 0, chart = 0, page = 0; // the number of the point at which it begins
  Plane_vector_d from, way;
  Plane_vector_d outward; // of length 1, or 0; the chart is on the left of the way
  double inverse = 0.;    // of the square of the length, or 0

  Border_piece() {}
  Border_piece(std::uint32_t s, std::uint32_t c, std::uint32_t p, const Plane_vector_d& begin,
               const Plane_vector_d& along)
    : sample(s), chart(c), page(p), from(begin), way(along)
  {
    const double squared = way.squared_length();
    if(squared > 0.) {
      inverse = 1. / squared;
      outward = Plane_vector_d{way.y, -way.x} * (1. / std::sqrt(squared));
    }
  }
};

// The nearest point of a piece of a border.
struct Nearest_on_piece
{
  const Border_piece* piece = nullptr;
  double squared_distance = 0.;
  double part = 0.;   // of the way along the piece
  Plane_vector_d way; // from there
};

// Pieces of borders on pages, by the cells of a grid whose sides are the reach; what is beyond the pages is
// in their outermost cells.
class Border_pieces
{
public:
  typedef Plane_vector_d Vector;

  Border_pieces(const Vector& page, double reach)
    : m_reach(reach), m_per_unit(1. / reach), m_columns(int(page.x / reach) + 1), m_rows(int(page.y / reach) + 1)
  {}

  // Sorts these pieces, of a number of pages, into the cells.
  void assign(const std::vector<Border_piece>& pieces, std::size_t pages)
  {
    m_begin.assign(pages * std::size_t(m_columns) * std::size_t(m_rows) + 2, 0);
    for(const Border_piece& piece : pieces)
      for_each_cell(piece, [this](std::size_t cell) { ++m_begin[cell + 2]; });
    for(std::size_t cell = 1; cell < m_begin.size(); ++cell)
      m_begin[cell] += m_begin[cell - 1];
    m_pieces.resize(m_begin.back());
    for(const Border_piece& piece : pieces)
      for_each_cell(piece, [&](std::size_t cell) { m_pieces[m_begin[cell + 1]++] = piece; });
  }

  // Calls use(nearest point of a piece) for those within reach of a point that matters(piece), some of them
  // several times.
  template <class Matters, class Use>
  void for_each_near(std::uint32_t page, const Vector& p, const Matters& matters, const Use& use) const
  {
    const int column = cell_of(p.x, m_columns), row = cell_of(p.y, m_rows);
    const int first = (std::max)(0, column - 1), last = (std::min)(m_columns - 1, column + 1);
    Nearest_on_piece nearest;
    for(int y = (std::max)(0, row - 1); y <= (std::min)(m_rows - 1, row + 1); ++y) {
      const std::uint32_t end = m_begin[cell_at(page, last, y) + 1];
      for(std::uint32_t k = m_begin[cell_at(page, first, y)]; k < end; ++k) {
        const Border_piece& piece = m_pieces[k];
        if(!matters(piece))
          continue;
        const Vector q = p - piece.from;
        nearest.part = (std::min)(1., (std::max)(0., q.dot(piece.way) * piece.inverse));
        nearest.way = q - piece.way * nearest.part;
        nearest.squared_distance = nearest.way.squared_length();
        if(nearest.squared_distance <= m_reach * m_reach) {
          nearest.piece = &piece;
          use(nearest);
        }
      }
    }
  }

private:
  int cell_of(double x, int n) const { return std::clamp(int(x * m_per_unit), 0, n - 1); }
  std::size_t cell_at(std::uint32_t page, int column, int row) const
  {
    return (std::size_t(page) * std::size_t(m_rows) + std::size_t(row)) * std::size_t(m_columns)
         + std::size_t(column);
  }

  template <class Use>
  void for_each_cell(const Border_piece& piece, const Use& use) const
  {
    const Vector to = piece.from + piece.way;
    const std::pair<double, double> x = std::minmax(piece.from.x, to.x), y = std::minmax(piece.from.y, to.y);
    for(int row = cell_of(y.first, m_rows); row <= cell_of(y.second, m_rows); ++row)
      for(int column = cell_of(x.first, m_columns); column <= cell_of(x.second, m_columns); ++column)
        use(cell_at(piece.page, column, row));
  }

  double m_reach, m_per_unit; // the sides of cells, and the cells along a unit
  int m_columns, m_rows;
  std::vector<std::uint32_t> m_begin;  // of the pieces of each cell
  std::vector<Border_piece> m_pieces;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_PIECES_H
