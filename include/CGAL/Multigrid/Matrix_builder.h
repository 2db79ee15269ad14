// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_MATRIX_BUILDER_H
#define CGAL_MULTIGRID_MATRIX_BUILDER_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <memory>
#include <utility>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Matrix_builder` makes a `Hermitian_matrix` row by row.
*/
class Matrix_builder
{
public:
  /// Returns the matrix of the given row lengths, whose row i is what `fill(i, row)` leaves in the
  /// `Matrix_row`. A row may be shorter than announced, not longer. One call a row.
  template <class Real, class Fill>
  static Hermitian_matrix<Real> build(const std::vector<std::uint32_t>& row_lengths,
                                      const Fill& fill);

private:
  static void sort_slots(const std::vector<std::uint32_t>& lengths, Sliced_pattern& pattern);
};

// Rows of a window are sorted by length, longest first, so that slices need little padding.
inline void Matrix_builder::sort_slots(const std::vector<std::uint32_t>& lengths,
                                       Sliced_pattern& pattern)
{
  const std::size_t n = lengths.size();
  const std::size_t slices = (n + Sliced_pattern::slice_rows - 1) / Sliced_pattern::slice_rows;
  pattern.rows = n;
  pattern.row_of_slot.assign(slices * Sliced_pattern::slice_rows, 0);
  for(std::size_t i = 0; i < n; ++i)
    pattern.row_of_slot[i] = std::uint32_t(i);
  for(std::size_t begin = 0; begin < n; begin += Sliced_pattern::sorting_window) {
    const std::size_t end = (std::min)(begin + Sliced_pattern::sorting_window, n);
    std::stable_sort(pattern.row_of_slot.begin() + begin, pattern.row_of_slot.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return lengths[a] > lengths[b]; });
  }
  pattern.slice_begin.assign(slices + 1, 0);
  for(std::size_t s = 0; s < slices; ++s) {
    std::uint32_t width = 0;
    for(std::size_t slot = s * 8; slot < (std::min)(s * 8 + 8, n); ++slot)
      width = (std::max)(width, lengths[pattern.row_of_slot[slot]]);
    pattern.slice_begin[s + 1] = pattern.slice_begin[s] + width;
  }
}

template <class Real, class Fill>
Hermitian_matrix<Real> Matrix_builder::build(const std::vector<std::uint32_t>& row_lengths,
                                             const Fill& fill)
{
  auto pattern = std::make_shared<Sliced_pattern>();
  sort_slots(row_lengths, *pattern);
  Hermitian_matrix<Real> matrix;
  const std::size_t slices = pattern->slice_begin.size() - 1;
  constexpr std::size_t rows = Sliced_pattern::slice_rows;
  pattern->imaginary.assign(slices, Sliced_pattern::none);
  pattern->column.assign(pattern->slice_begin[slices] * rows, 0);
  matrix.m_re.assign(pattern->slice_begin[slices] * rows, Real(0));
  matrix.m_diagonal.assign(pattern->rows, Real(0));
  Matrix_row row;
  for(std::size_t slot = 0; slot < pattern->rows; ++slot) {
    const std::size_t s = slot / rows, r = slot % rows;
    const std::uint32_t i = pattern->row_of_slot[slot];
    const std::size_t width = pattern->slice_begin[s + 1] - pattern->slice_begin[s];
    row.diagonal = 0.;
    row.entries.clear();
    fill(i, row);
    matrix.m_diagonal[i] = Real(row.diagonal);
    // Padding refers to the row itself, which is in the cache.
    for(std::size_t k = 0; k < width; ++k) {
      const std::size_t at = (pattern->slice_begin[s] + k) * rows + r;
      pattern->column[at] = k < row.entries.size() ? row.entries[k].column : i;
      if(k >= row.entries.size())
        continue;
      matrix.m_re[at] = Real(row.entries[k].re);
      if(row.entries[k].im == 0.)
        continue;
      if(pattern->imaginary[s] == Sliced_pattern::none) {
        pattern->imaginary[s] = std::uint32_t(matrix.m_im.size() / rows);
        matrix.m_im.resize(matrix.m_im.size() + width * rows, Real(0));
      }
      matrix.m_im[(pattern->imaginary[s] + k) * rows + r] = Real(row.entries[k].im);
    }
  }
  matrix.m_pattern = std::move(pattern);
  return matrix;
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_MATRIX_BUILDER_H
