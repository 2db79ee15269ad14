// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPARSE_ROWS_H
#define CGAL_MULTIGRID_SPARSE_ROWS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/Uninitialized_vector.h>
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

  /// A row while it is being computed, at the end of those before it.
  class Row
  {
  public:
    Diagonal diagonal = Value_traits<Diagonal>::zero(); ///< the diagonal entry

    /// Constructs a row of zeros.
    Row(std::vector<std::uint32_t>& columns, std::vector<Double>& values)
      : m_columns(columns), m_values(values), m_begin(columns.size())
    {}
    /// Returns the number of entries beside the diagonal.
    std::uint32_t length() const { return std::uint32_t(m_columns.size() - m_begin); }
    /// Returns the column of entry `k`.
    std::uint32_t column(std::uint32_t k) const { return m_columns[m_begin + k]; }
    /// Returns entry `k`.
    Double& value(std::uint32_t k) { return m_values[m_begin + k]; }
    /// Appends an entry of a column that the row does not have.
    void append(std::uint32_t column, const Double& value)
    {
      m_columns.push_back(column);
      m_values.push_back(value);
    }
    /// Appends `count` entries of columns that the row does not have; their values are to be set
    /// from what is returned on.
    Double* append(const std::uint32_t* columns, std::uint32_t count)
    {
      m_columns.insert(m_columns.end(), columns, columns + count);
      m_values.resize(m_columns.size());
      return m_values.data() + (m_columns.size() - count);
    }
    /// Adds to the entry of a column, which need not be there. Linear in the number of entries.
    void add(std::uint32_t column, const Double& value)
    {
      const auto at = std::find(m_columns.begin() + m_begin, m_columns.end(), column);
      if(at != m_columns.end())
        m_values[at - m_columns.begin()] += value;
      else
        append(column, value);
    }

  private:
    std::vector<std::uint32_t>& m_columns;
    std::vector<Double>& m_values;
    std::size_t m_begin;
  };

  Sparse_rows() {}

  /// Makes `n` rows: `fill(i, row)` sets the empty row i. There is one `prepare()` for each block of
  /// rows, whose result, a function object, fills them; blocks are filled in any order and possibly
  /// at the same time.
  template <class Prepare>
  Sparse_rows(std::size_t n, const Prepare& prepare)
    : m_diagonal(n), m_begin(n), m_length(n)
  {
    while((n >> m_shift) >= most_blocks)
      ++m_shift;
    const std::size_t block_size = std::size_t(1) << m_shift;
    m_blocks.resize(Blocked_execution::number_of_blocks(n, block_size));
    Blocked_execution::blocked_for(n, block_size, [&](std::size_t begin, std::size_t end) {
      Block& block = m_blocks[begin >> m_shift];
      auto fill = prepare();
      block.columns.reserve(expected_length * (end - begin));
      block.values.reserve(expected_length * (end - begin));
      for(std::size_t i = begin; i < end; ++i) {
        m_begin[i] = std::uint32_t(block.columns.size());
        Row row(block.columns, block.values);
        fill(std::uint32_t(i), row);
        m_diagonal[i] = row.diagonal;
        m_length[i] = row.length();
      }
      block.columns.shrink_to_fit(); // they stay as they are
      block.values.shrink_to_fit();
    });
  }

  /// Constructs the rows of a matrix, a `Self_adjoint_matrix` or a `Split_matrix`. Linear time.
  template <class Matrix, class Traits = typename Matrix::Traits>
  explicit Sparse_rows(const Matrix& matrix)
  {
    const std::vector<std::uint32_t> slot = matrix.slot_of_row();
    *this = Sparse_rows(matrix.size(), [&matrix, &slot] {
      return [&matrix, &slot](std::uint32_t i, Row& row) {
        row.diagonal = Value_traits<Diagonal>::from(matrix.diagonal(i));
        matrix.for_each_entry(slot[i], [&row](std::uint32_t j, const auto& value) {
          row.append(j, Value_traits<Double>::from(value));
        });
      };
    });
  }

  /// Returns the number of rows.
  std::size_t size() const { return m_diagonal.size(); }
  /// Returns the diagonal entries.
  const std::vector<Diagonal>& diagonal() const { return m_diagonal; }
  /// Returns the diagonal entry of row `i`.
  const Diagonal& diagonal(std::uint32_t i) const { return m_diagonal[i]; }
  /// Returns the number of entries beside the diagonal in row `i`.
  std::uint32_t length(std::uint32_t i) const { return m_length[i]; }
  /// Returns the columns of the entries of row `i`.
  const std::uint32_t* columns(std::uint32_t i) const 
  {
    return m_blocks[i >> m_shift].columns.data() + m_begin[i];
  }
  /// Returns the entries of row `i`.
  const Double* values(std::uint32_t i) const 
  {
    return m_blocks[i >> m_shift].values.data() + m_begin[i];
  }

  /// Calls `use(j, A_ij)` for the entries beside the diagonal of row `i`.
  template <class Use>
  void for_each_entry(std::uint32_t i, const Use& use) const
  {
    const std::uint32_t n = length(i), *column = columns(i);
    const Double* value = values(i);
    for(std::uint32_t k = 0; k < n; ++k)
      use(column[k], value[k]);
  }

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

  /// Multiplies all entries by a number.
  void scale(double factor)
  {
    typedef typename Value_traits<Diagonal>::Real Real;
    for(Diagonal& d : m_diagonal)
      d = Real(factor) * d;
    for(Block& block : m_blocks)
      for(Double& value : block.values)
        value = Real(factor) * value;
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
  // What prepares a block may take time in the number of all rows.
  static constexpr std::size_t most_blocks = 64, expected_length = 8;


  struct Block // of rows, as they were filled
  {
    std::vector<std::uint32_t> columns;
    std::vector<Double> values;
  };

  std::uint32_t m_shift = 13; // blocks have 2 to this many rows

  std::vector<Diagonal> m_diagonal;
  std::vector<std::uint32_t> m_begin, m_length; // of each row in its block
  std::vector<Block> m_blocks;
};

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPARSE_ROWS_H
