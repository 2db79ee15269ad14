// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MATRIX_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MATRIX_H

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Mesh_block.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

struct Border_entry // of a row, beside those of its triangles
{
  std::uint32_t row, column;
  double re, im;
};

// What a step of the smoother multiplies the residual of a row by: see `Chebyshev_smoother`.
inline double inverse_diagonal_of(const Multigrid::Matrix_row& row)
{
  double sum = 0.;
  for(const auto& entry : row.entries)
    sum += std::hypot(entry.re, entry.im);
  return row.diagonal > 0. ? 1. / (0.5 * (row.diagonal + sum)) : 0.;
}

// The Hermitian matrix of the conformal energy of a streamed mesh, in files. A row has an entry for
// each triangle at its vertex v, that of the corner after v: these are all neighbours but one at
// the border. That one, and the imaginary parts, which only border edges have, are in memory.
// Pins are not in it.
class Streamed_matrix
{
public:
  typedef std::complex<double> Complex;

  std::size_t size() const { return m_diagonal.size(); }
  const Mapped_array<double>& diagonal() const { return m_diagonal; }
  const std::vector<Border_entry>& border() const { return m_border; } // by rows
  // See `Chebyshev_smoother`.
  const Mapped_array<float>& inverse_diagonal() const { return m_inverse_diagonal; }

  void create(Work_folder& folder, const std::string& name, std::size_t rows, std::size_t entries);
  void open(Work_folder& folder, const std::string& name);

  // Appends the rows of a block; blocks come in their order.
  void add_block(const Mesh_block& block);

  // Calls `use(array, name)` for all files.
  template <class Use>
  void for_each_array(const Use& use)
  {
    use(m_begin, "row_begin");
    use(m_column, "column");
    use(m_value, "value");
    use(m_rounded, "rounded");
    use(m_diagonal, "diagonal");
    use(m_inverse_diagonal, "inverse_diagonal");
    use(m_border_file, "border");
  }
  void save_border(Work_folder& folder, const std::string& name)
  {
    m_border_file = folder.create<Border_entry>(name + "border", m_border.size());
    std::copy(m_border.begin(), m_border.end(), m_border_file.begin());
  }

  // Calls `use(i, s)` for the rows i in [begin, end), s = (H x)_i, in the precision of x.
  template <class Real, class Use>
  void for_each_product(std::size_t begin, std::size_t end, const std::complex<Real>* x,
                        const Use& use) const;

  void release(std::size_t begin, std::size_t end) const
  {
    m_column.release(m_begin[begin], m_begin[end]);
    m_value.release(m_begin[begin], m_begin[end]);
    m_rounded.release(m_begin[begin], m_begin[end]);
    m_diagonal.release(begin, end);
    m_inverse_diagonal.release(begin, end);
    m_begin.release(begin, end);
  }

  // As a `Self_adjoint_matrix` offers them.
  std::size_t slot_of_row(std::uint32_t v) const { return v; }
  template <class Use>
  void for_each_entry(std::size_t row, const Use& use) const;

private:
  void set_row(std::size_t i, std::uint64_t at, std::size_t entries,
               const Multigrid::Matrix_row& row);

  template <class Real>
  const Real* values() const
  {
    if constexpr(std::is_same<Real, float>::value)
      return m_rounded.data();
    else
      return m_value.data();
  }
  std::vector<Border_entry>::const_iterator border_from(std::size_t row) const
  {
    return std::lower_bound(m_border.begin(), m_border.end(), row,
                            [](const Border_entry& e, std::size_t i) { return e.row < i; });
  }

  Mapped_array<std::uint64_t> m_begin;
  Mapped_array<std::uint32_t> m_column;
  Mapped_array<double> m_value;
  Mapped_array<float> m_rounded;
  Mapped_array<double> m_diagonal;
  Mapped_array<float> m_inverse_diagonal;
  Mapped_array<Border_entry> m_border_file;
  std::vector<Border_entry> m_border;
};

inline void Streamed_matrix::create(Work_folder& folder, const std::string& name,
                                    std::size_t rows, std::size_t entries)
{
  m_begin = folder.create<std::uint64_t>(name + "row_begin", rows + 1);
  m_column = folder.create<std::uint32_t>(name + "column", entries);
  m_value = folder.create<double>(name + "value", entries);
  m_rounded = folder.create<float>(name + "rounded", entries);
  m_diagonal = folder.create<double>(name + "diagonal", rows);
  m_inverse_diagonal = folder.create<float>(name + "inverse_diagonal", rows);
}

inline void Streamed_matrix::open(Work_folder& folder, const std::string& name)
{
  for_each_array([&](auto& array, const char* of) {
    typedef typename std::decay_t<decltype(array)>::value_type Value;
    array = folder.open<Value>(name + of);
  });
  m_border.assign(m_border_file.begin(), m_border_file.end());
}

inline void Streamed_matrix::add_block(const Mesh_block& block)
{
  const auto& triangles = block.mesh.triangles;
  const Indexed_mesh::Triangles_at_vertices at(triangles, block.mesh.points.size());
  for(std::uint32_t v = 0; v < block.own; ++v)
    m_begin[block.first + v + 1] = m_begin[block.first + v] + at.number(v);
  constexpr std::size_t part = 4096;
  std::vector<std::vector<Border_entry>> border(
    Blocked_execution::number_of_blocks(block.own, part));
  Blocked_execution::blocked_for(block.own, part, [&](std::size_t begin, std::size_t end) {
    Multigrid::Matrix_row row;
    for(std::size_t v = begin; v < end; ++v) {
      row.entries.clear();
      row.diagonal = 0.;
      fill_conformal_row(std::uint32_t(v), triangles, at, block.cotangents, {}, row);
      for(auto& entry : row.entries)
        entry.column = block.global(entry.column);
      const std::size_t entries = at.number(std::uint32_t(v)), i = block.first + v;
      set_row(i, m_begin[i], entries, row);
      for(std::size_t k = 0; k < row.entries.size(); ++k) {
        const auto& e = row.entries[k];
        if(k >= entries || e.im != 0.)
          border[begin / part].push_back(
            {std::uint32_t(i), e.column, k < entries ? 0. : e.re, e.im});
      }
    }
  });
  for(const auto& entries : border)
    m_border.insert(m_border.end(), entries.begin(), entries.end());
  release(block.first, block.first + block.own);
}

inline void Streamed_matrix::set_row(std::size_t i, std::uint64_t at, std::size_t entries,
                                     const Multigrid::Matrix_row& row)
{
  for(std::size_t k = 0; k < entries; ++k) {
    const auto& e = row.entries[k];
    m_column[at + k] = e.column;
    m_value[at + k] = e.re;
    m_rounded[at + k] = float(e.re);
  }
  m_diagonal[i] = row.diagonal;
  m_inverse_diagonal[i] = float(inverse_diagonal_of(row));
}

template <class Real, class Use>
void Streamed_matrix::for_each_product(std::size_t begin, std::size_t end,
                                       const std::complex<Real>* x, const Use& use) const
{
  const Real* const value = values<Real>();
  const std::uint32_t* const column = m_column.data();
  auto border = border_from(begin);
  std::uint64_t k = m_begin[begin];
  for(std::size_t i = begin; i < end; ++i) {
    Real re = Real(m_diagonal[i]) * x[i].real(), im = Real(m_diagonal[i]) * x[i].imag();
    for(const std::uint64_t last = m_begin[i + 1]; k < last; ++k) {
      const std::complex<Real>& y = x[column[k]];
      re += value[k] * y.real();
      im += value[k] * y.imag();
    }
    for(; border != m_border.end() && border->row == i; ++border) {
      const std::complex<Real>& y = x[border->column];
      re += Real(border->re) * y.real() - Real(border->im) * y.imag();
      im += Real(border->re) * y.imag() + Real(border->im) * y.real();
    }
    use(i, std::complex<Real>(re, im));
  }
}

template <class Use>
void Streamed_matrix::for_each_entry(std::size_t row, const Use& use) const
{
  const auto first = border_from(row);
  auto border_end = first;
  while(border_end != m_border.end() && border_end->row == row)
    ++border_end;
  std::vector<bool> is_used(std::size_t(border_end - first), false);
  for(std::uint64_t k = m_begin[row]; k < m_begin[row + 1]; ++k) {
    Complex value = m_value[k];
    for(auto b = first; b != border_end; ++b)
      if(b->column == m_column[k]) {
        value += Complex(b->re, b->im);
        is_used[std::size_t(b - first)] = true;
      }
    use(m_column[k], value);
  }
  for(auto b = first; b != border_end; ++b)
    if(!is_used[std::size_t(b - first)])
      use(b->column, Complex(b->re, b->im));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MATRIX_H
