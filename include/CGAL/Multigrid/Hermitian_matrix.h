// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_HERMITIAN_MATRIX_H
#define CGAL_MULTIGRID_HERMITIAN_MATRIX_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Sliced_pattern.h>
#include <CGAL/Multigrid/vector_operations.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// An entry of a row beside the diagonal.
template <class Value>
struct Matrix_entry
{
  std::uint32_t column; ///< its column
  Value value;          ///< its value
};

template <>
struct Matrix_entry<std::complex<double>>
{
  std::uint32_t column; ///< its column
  double re;            ///< its real part
  double im;            ///< its imaginary part
};

/*!
\ingroup PkgHLSCMMultigrid

One row of a self-adjoint matrix while it is being built, in double precision: the diagonal entry
and the entries beside it.
*/
template <class Value>
struct Self_adjoint_row
{
  typedef Matrix_entry<Value> Entry;                      ///< an entry beside the diagonal
  typedef typename Value_traits<Value>::Diagonal Diagonal; ///< one on it

  Diagonal diagonal = Value_traits<Diagonal>::zero(); ///< the diagonal entry
  std::vector<Entry> entries; ///< those beside it, in any order, each column once
};

/// \ingroup PkgHLSCMMultigrid
/// A row of a Hermitian matrix of complex numbers: its entries are `{column, re, im}`.
typedef Self_adjoint_row<std::complex<double>> Matrix_row;

/*!
\ingroup PkgHLSCMMultigrid

The class `Self_adjoint_matrix` is a sparse matrix \f$ H = H^H \f$. Of complex numbers the diagonal
is real; the imaginary parts beside it take memory and time only in slices of rows that have any,
which is for matrices most of whose entries are real, such as that of a conformal energy.

It is a function object: `h(x, y)` sets y to \f$ H x \f$.

\tparam Value what `Value_traits` knows: `float`, `double`, `std::complex` of them, or a block of
        `Block_values.h`

\cgalModels{MultigridOperator}
*/
template <class Value>
class Self_adjoint_matrix
{
public:
  typedef Value_traits<Value> Traits;              ///< what is known of its entries
  typedef typename Traits::Diagonal Diagonal;      ///< a diagonal entry
  typedef typename Traits::Vector_value Vector_value; ///< an entry of a vector
  typedef Value_vector<Value> Vector;              ///< a vector
  typedef Self_adjoint_row<typename Traits::Double> Row; ///< a row, in double precision

  /// Returns the number of rows; 0 for a matrix that was not built.
  std::size_t size() const { return m_pattern == nullptr ? 0 : m_pattern->rows; }
  /// Returns the diagonal, by rows.
  const std::vector<Diagonal>& diagonal() const { return m_diagonal; }
  /// Returns the diagonal entry of row `i`.
  const Diagonal& diagonal(std::size_t i) const { return m_diagonal[i]; }
  /// Returns the pattern. Precondition: the matrix was built.
  const Sliced_pattern& pattern() const { return *m_pattern; }

  /// Calls `use(i, s)` for every row i with \f$ s = \sum_{j \ne i} H_{ij} x_j \f$, in any order and
  /// possibly at the same time.
  template <class Use>
  void for_each_row_sum(const Vector& x, const Use& use) const;

  /// Sets `y`, of the same size, to \f$ H x \f$.
  void multiply(const Vector& x, Vector& y) const
  {
    for_each_row_sum(x, [&](std::size_t i, const Vector_value& s) {
      y[i] = m_diagonal[i] * x[i] + s;
    });
  }
  /// Is `multiply()`.
  void operator()(const Vector& x, Vector& y) const { multiply(x, y); }

  /// Calls `use(j, H_ij)` for the entries beside the diagonal of the row i in `slot`, stored zeros
  /// left out. `slot_of_row()` tells where a row is.
  template <class Use>
  void for_each_entry(std::size_t slot, const Use& use) const;

  /// Returns the number of entries that are not 0, those of the diagonal included. Linear time.
  std::size_t number_of_nonzeros() const;

  /// Returns the bytes that the matrix takes, with its pattern.
  std::size_t memory() const
  {
    return m_diagonal.size() * sizeof(Diagonal) + m_main.size() * sizeof(Stored)
           + m_im.size() * sizeof(Real) + (m_pattern == nullptr ? 0 : m_pattern->memory());
  }

  /// Returns for each row its slot.
  std::vector<std::uint32_t> slot_of_row() const;

  /// Returns the slot of row `i`. Constant time.
  std::size_t slot_of_row(std::uint32_t i) const;

  /// Returns row `i` and sets it to zero; its column is kept. Constant time.
  Row take_row(std::uint32_t i);

  /// Sets row `i`, which is zero, to what `take_row()` returned for it. Constant time.
  void put_row(std::uint32_t i, const Row& row);

  template <class Other> friend class Self_adjoint_matrix;
  template <class Other, class Rest> friend class Split_matrix;
  friend class Matrix_builder;

  /// Constructs a matrix of the same entries in another precision; the pattern is shared.
  template <class Other>
  void assign(const Self_adjoint_matrix<Other>& other)
  {
    m_pattern = other.m_pattern;
    m_diagonal.resize(other.m_diagonal.size());
    for_each_index(m_diagonal.size(), [&](std::size_t i) {
      m_diagonal[i] = Value_traits<Diagonal>::from(other.m_diagonal[i]);
    });
    m_main.resize(other.m_main.size());
    for_each_index(m_main.size(), [&](std::size_t i) {
      m_main[i] = Value_traits<Stored>::from(other.m_main[i]);
    });
    m_im.assign(other.m_im.begin(), other.m_im.end());
  }

private:
  typedef typename Traits::Stored Stored;
  typedef typename Traits::Real Real;

  std::shared_ptr<const Sliced_pattern> m_pattern;
  std::vector<Diagonal> m_diagonal;
  Blocked_execution::Uninitialized_vector<Stored> m_main; // all entries but for imaginary parts
  std::vector<Real> m_im;
};

/// \ingroup PkgHLSCMMultigrid
/// A Hermitian matrix of complex numbers, stored as `Real`.
template <class Real>
using Hermitian_matrix = Self_adjoint_matrix<std::complex<Real>>;

namespace internal {

// What a row stores of an entry beside its imaginary part, and this.
template <class Value>
const Value& main_part(const Matrix_entry<Value>& entry) { return entry.value; }
inline double main_part(const Matrix_entry<std::complex<double>>& entry) { return entry.re; }
template <class Value>
double imaginary_part(const Matrix_entry<Value>&) { return 0.; }
inline double imaginary_part(const Matrix_entry<std::complex<double>>& entry) { return entry.im; }

// Entries as they are stored.
template <class Stored, class Real>
struct Stored_entries
{
  const Stored* main_parts;
  const Real* imaginary_parts;

  const Stored* main(std::size_t begin, std::size_t) const { return main_parts + begin; }
  const Real* imaginary(std::size_t begin, std::size_t) const { return imaginary_parts + begin; }
};

// The row sums of a matrix of pattern p. What `prepare()` returns for each block of slices has
// functions of a place and a number of entries: `main()` and `imaginary()` return these.
template <class Value, class Prepare, class Use>
void for_each_row_sum(const Sliced_pattern& p, const typename Value_traits<Value>::Vector_value* x,
                      const Prepare& prepare, const Use& use)
{
  Blocked_execution::blocked_for(p.slices(), 1024, [&](std::size_t first, std::size_t last) {
    auto entries = prepare();
    for(std::size_t s = first; s < last; ++s) {
      const std::size_t begin = std::size_t(p.slice_begin[s]) * slice_rows;
      const std::size_t width = p.slice_begin[s + 1] - p.slice_begin[s];
      const std::uint32_t* column = p.column.data() + begin;
      Slice_sums<Value> sum;
      sum.add(column, entries.main(begin, width * slice_rows), width, x);
      if constexpr(Value_traits<Value>::is_complex)
        if(p.imaginary[s] != Sliced_pattern::none)
          sum.add_imaginary(column,
                            entries.imaginary(std::size_t(p.imaginary[s]) * slice_rows,
                                              width * slice_rows),
                            width, x);
      const std::size_t slot = s * slice_rows;
      const std::size_t count = (std::min)(p.rows - slot, std::size_t(slice_rows));
      for(std::size_t r = 0; r < count; ++r)
        use(std::size_t(p.row_of_slot[slot + r]), sum[r]);
    }
  });
}

} // namespace internal

template <class Value>
template <class Use>
void Self_adjoint_matrix<Value>::for_each_row_sum(const Vector& x, const Use& use) const
{
  const auto prepare = [this] {
    return internal::Stored_entries<Stored, Real>{m_main.data(), m_im.data()};
  };
  internal::for_each_row_sum<Value>(*m_pattern, x.data(), prepare, use);
}

template <class Value>
template <class Use>
void Self_adjoint_matrix<Value>::for_each_entry(std::size_t slot, const Use& use) const
{
  const Sliced_pattern& p = *m_pattern;
  const std::size_t s = slot / internal::slice_rows, r = slot % internal::slice_rows;
  for(std::size_t k = p.slice_begin[s]; k < p.slice_begin[s + 1]; ++k) {
    const std::size_t at = k * internal::slice_rows + r;
    Value value(m_main[at]);
    if constexpr(Traits::is_complex)
      if(p.imaginary[s] != Sliced_pattern::none)
        value.imag(m_im[(p.imaginary[s] + k - p.slice_begin[s]) * internal::slice_rows + r]);
    if(!Traits::is_zero(value))
      use(p.column[at], value);
  }
}

template <class Value>
std::size_t Self_adjoint_matrix<Value>::number_of_nonzeros() const
{
  std::size_t count = 0;
  for(std::size_t slot = 0; slot < size(); ++slot) {
    count += Value_traits<Diagonal>::is_zero(m_diagonal[m_pattern->row_of_slot[slot]]) ? 0 : 1;
    for_each_entry(slot, [&count](std::uint32_t, const Value&) { ++count; });
  }
  return count;
}

template <class Value>
std::vector<std::uint32_t> Self_adjoint_matrix<Value>::slot_of_row() const
{
  std::vector<std::uint32_t> slot(size());
  for(std::uint32_t s = 0; s < size(); ++s)
    slot[m_pattern->row_of_slot[s]] = s;
  return slot;
}

template <class Value>
std::size_t Self_adjoint_matrix<Value>::slot_of_row(std::uint32_t i) const
{
  // Rows are sorted within windows only.
  const auto window = m_pattern->row_of_slot.begin()
                    + i / Sliced_pattern::sorting_window * Sliced_pattern::sorting_window;
  return std::find(window, m_pattern->row_of_slot.end(), i) - m_pattern->row_of_slot.begin();
}

template <class Value>
typename Self_adjoint_matrix<Value>::Row Self_adjoint_matrix<Value>::take_row(std::uint32_t i)
{
  Row row;
  row.diagonal = Value_traits<typename Row::Diagonal>::from(m_diagonal[i]);
  const std::size_t slot = slot_of_row(i), s = slot / internal::slice_rows;
  row.entries.reserve(m_pattern->slice_begin[s + 1] - m_pattern->slice_begin[s]);
  for_each_entry(slot, [&row](std::uint32_t j, const Value& value) {
    if constexpr(Traits::is_complex)
      row.entries.push_back({j, double(value.real()), double(value.imag())});
    else
      row.entries.push_back({j, Value_traits<typename Traits::Double>::from(value)});
  });
  put_row(i, Row());
  return row;
}

template <class Value>
void Self_adjoint_matrix<Value>::put_row(std::uint32_t i, const Row& row)
{
  const Sliced_pattern& p = *m_pattern;
  const std::size_t slot = slot_of_row(i), s = slot / internal::slice_rows,
                    r = slot % internal::slice_rows;
  m_diagonal[i] = Value_traits<Diagonal>::from(row.diagonal);
  for(std::size_t k = 0; k < p.slice_begin[s + 1] - p.slice_begin[s]; ++k) {
    const std::size_t at = (p.slice_begin[s] + k) * internal::slice_rows + r;
    const auto entry = std::find_if(row.entries.begin(), row.entries.end(), [&](const auto& e) {
      return e.column == p.column[at];
    });
    const bool is_set = entry != row.entries.end();
    m_main[at] = is_set ? Value_traits<Stored>::from(internal::main_part(*entry))
                        : Value_traits<Stored>::zero();
    if(p.imaginary[s] != Sliced_pattern::none)
      m_im[(p.imaginary[s] + k) * internal::slice_rows + r]
        = is_set ? Real(internal::imaginary_part(*entry)) : Real(0);
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_HERMITIAN_MATRIX_H
