// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPARSE_ROWS_H
#define CGAL_MULTIGRID_SPARSE_ROWS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/memory.h>
#include <CGAL/Multigrid/Matrix_builder.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Sparse_rows` has the rows of a self-adjoint matrix one after the other, in double
precision: what matrices are computed in, before a `Self_adjoint_matrix` is made of them.

\tparam Double an entry, what `Value_traits` calls `Double`
*/
template <class Double>
class Sparse_rows
{
public:
  typedef typename Value_traits<Double>::Diagonal Diagonal; ///< an entry on the diagonal

  /// A row while it is being computed.
  struct Row
  {
    Diagonal diagonal = Value_traits<Diagonal>::zero(); ///< the diagonal entry
    std::vector<std::uint32_t> column; ///< the columns of the entries beside it
    std::vector<Double> value;         ///< these entries

    /// Makes it a row of zeros.
    void clear()
    {
      diagonal = Value_traits<Diagonal>::zero();
      column.clear();
      value.clear();
    }
  };

  Sparse_rows() {}

  /// Makes `n` rows: `fill(i, row)` sets the empty row i. There is one `prepare()` for each block of
  /// rows, whose result, a function object, fills them; blocks are filled in any order and possibly
  /// at the same time.
  template <class Prepare>
  Sparse_rows(std::size_t n, const Prepare& prepare) : m_diagonal(n)
  {
    const std::size_t blocks = Blocked_execution::number_of_blocks(n, block_size);
    std::vector<std::vector<std::uint32_t>> columns(blocks), lengths(blocks);
    std::vector<std::vector<Double>> values(blocks);
    Blocked_execution::blocked_for(n, block_size, [&](std::size_t begin, std::size_t end) {
      const std::size_t b = begin / block_size;
      auto fill = prepare();
      Row row;
      for(std::size_t i = begin; i < end; ++i) {
        row.clear();
        fill(std::uint32_t(i), row);
        m_diagonal[i] = row.diagonal;
        lengths[b].push_back(std::uint32_t(row.column.size()));
        columns[b].insert(columns[b].end(), row.column.begin(), row.column.end());
        values[b].insert(values[b].end(), row.value.begin(), row.value.end());
      }
    });
    m_length = Blocked_execution::joined(lengths);
    m_column = Blocked_execution::joined(columns);
    columns.clear();
    m_value = Blocked_execution::joined(values);
    m_begin.resize(n + 1, 0);
    for(std::size_t i = 0; i < n; ++i)
      m_begin[i + 1] = m_begin[i] + m_length[i];
  }

  /// Returns the number of rows.
  std::size_t size() const { return m_diagonal.size(); }
  /// Returns the diagonal entries.
  const std::vector<Diagonal>& diagonal() const { return m_diagonal; }
  /// Returns the number of entries beside the diagonal in row `i`.
  std::uint32_t length(std::uint32_t i) const { return m_length[i]; }
  /// Returns the columns of the entries of row `i`.
  const std::uint32_t* columns(std::uint32_t i) const { return m_column.data() + m_begin[i]; }
  /// Returns the entries of row `i`.
  const Double* values(std::uint32_t i) const { return m_value.data() + m_begin[i]; }

  /// Makes rows `i` for which `is_zero(i)` rows of zeros. Their columns are kept.
  template <class Is_zero>
  void clear_rows(const Is_zero& is_zero)
  {
    for(std::uint32_t i = 0; i < size(); ++i)
      if(is_zero(i)) {
        m_diagonal[i] = Value_traits<Diagonal>::zero();
        m_length[i] = 0;
      }
  }

  /// Adds `part` of each diagonal entry to it.
  void shift_diagonal(double part)
  {
    typedef typename Value_traits<Diagonal>::Real Real;
    for(Diagonal& d : m_diagonal)
      d = d + Real(part) * d;
  }

  /// Returns the matrix of these rows with entries of type `Value`. Linear time.
  template <class Value>
  Self_adjoint_matrix<Value> matrix() const
  {
    typedef Value_traits<Value> Traits;
    if constexpr(Traits::is_complex)
      return Matrix_builder::build_matrix<Value>(m_length, [this](std::uint32_t i, Matrix_row& row) {
        row.diagonal = m_diagonal[i];
        for(std::uint32_t k = 0; k < m_length[i]; ++k)
          row.entries.push_back({columns(i)[k], values(i)[k].real(), values(i)[k].imag()});
      });
    else
      return Matrix_builder::build_matrix<Value>(
        m_length,
        [this](std::uint32_t i, Real_row<typename Traits::Stored>& row) {
          row.set(m_diagonal[i], m_length[i], columns(i), values(i));
          return true;
        },
        [](std::uint32_t, typename Self_adjoint_matrix<Value>::Row&) {});
  }

private:
  static constexpr std::size_t block_size = 8192;

  std::vector<Diagonal> m_diagonal;
  std::vector<std::uint32_t> m_begin, m_length, m_column;
  std::vector<Double> m_value;
};

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPARSE_ROWS_H
