// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPLIT_MATRIX_H
#define CGAL_MULTIGRID_SPLIT_MATRIX_H

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Matrix_builder.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// The single precision of a value.
template <class Value>
struct Single_precision { typedef float type; };

/// \cond SKIP_IN_MANUAL
template <class Real>
struct Single_precision<std::complex<Real>> { typedef std::complex<float> type; };
template <class Real, int N>
struct Single_precision<Eigen::Matrix<Real, N, N>> { typedef Eigen::Matrix<float, N, N> type; };
template <class Real, int N>
struct Single_precision<Columns<Real, N>> { typedef Columns<float, N> type; };
/// \endcond

/*!
\ingroup PkgHLSCMMultigrid

The class `Split_matrix` is a `Self_adjoint_matrix` whose entries are sums of two, with 48 bits
together: the first parts are a matrix of their own in single precision, which a cycle needs anyway,
and the second ones take half the memory of a matrix in double precision beside it.

\tparam Value an entry, in double precision
\tparam Rest a number of the second parts: `float`, or `std::int16_t`, with 39 bits together and half
        of that memory, if `Value` is not complex

\cgalModels{MultigridOperator}
*/
template <class Value, class Rest = float>
class Split_matrix
{
public:
  typedef Value_traits<Value> Traits;                 ///< what is known of its entries
  typedef typename Traits::Diagonal Diagonal;         ///< a diagonal entry
  typedef typename Traits::Vector_value Vector_value; ///< an entry of a vector
  typedef Value_vector<Value> Vector;                 ///< a vector
  /// The matrix in single precision
  typedef Self_adjoint_matrix<typename Single_precision<Value>::type> Single;

  Split_matrix() {}

  /// Splits a matrix whose entries single precision has the range of.
  explicit Split_matrix(const Self_adjoint_matrix<Value>& matrix)
  {
    m_first.assign(matrix);
    set_rests(matrix.m_diagonal, m_first.m_diagonal, m_rest.diagonal);
    set_rests(matrix.m_main, m_first.m_main, m_rest.main);
    set_rests(matrix.m_im, m_first.m_im, m_rest_im);
  }

  /// Constructs a matrix of real numbers or blocks row by row, without one in double precision beside
  /// it: `fill(i, row)` sets the `Real_row` of row i, of at most that length.
  template <class Fill>
  Split_matrix(const std::vector<std::uint32_t>& row_lengths, const Fill& fill)
  {
    static_assert(!Traits::is_complex, "imaginary parts have no Real_row");
    m_first = Matrix_builder::build_with_rest<typename Single_precision<Value>::type>(
      row_lengths,
      [&fill](std::uint32_t i, Real_row<Stored_single, Rest>& row) {
        fill(i, row);
        return true;
      },
      [](std::uint32_t, typename Single::Row&) {}, &m_rest);
  }

  /// Returns the number of rows.
  std::size_t size() const { return m_first.size(); }
  /// Returns the matrix rounded to single precision.
  const Single& single() const { return m_first; }
  /// Returns the matrix rounded to single precision and leaves none.
  Single take_single()
  {
    Single single = std::move(m_first);
    *this = Split_matrix();
    return single;
  }
  /// Returns the diagonal entry of row `i`.
  Diagonal diagonal(std::size_t i) const
  {
    return sum<Diagonal>(m_first.m_diagonal[i], m_rest.diagonal[i]);
  }
  /// Returns the slot of row `i`. Constant time.
  std::size_t slot_of_row(std::uint32_t i) const { return m_first.slot_of_row(i); }
  /// Returns for each row its slot.
  std::vector<std::uint32_t> slot_of_row() const { return m_first.slot_of_row(); }
  /// Returns how many entries beside the diagonal the row in `slot` has at most.
  std::uint32_t width(std::size_t slot) const
  {
    const std::size_t s = slot / internal::slice_rows;
    return m_first.pattern().slice_begin[s + 1] - m_first.pattern().slice_begin[s];
  }

  /// Sets `y`, of the same size, to the product with `x`.
  void multiply(const Vector& x, Vector& y) const
  {
    const auto prepare = [this] { return Joined_entries{*this, {}, {}}; };
    const auto use = [&](std::size_t i, const Vector_value& s) { y[i] = diagonal(i) * x[i] + s; };
    internal::for_each_row_sum<Value>(m_first.pattern(), x.data(), prepare, use);
  }
  /// Is `multiply()`.
  void operator()(const Vector& x, Vector& y) const { multiply(x, y); }

  /// Calls `use(j, H_ij)` for the entries beside the diagonal of the row in `slot`, stored zeros
  /// left out.
  template <class Use>
  void for_each_entry(std::size_t slot, const Use& use) const
  {
    const Sliced_pattern& p = m_first.pattern();
    const std::size_t s = slot / internal::slice_rows, r = slot % internal::slice_rows;
    for(std::size_t k = p.slice_begin[s]; k < p.slice_begin[s + 1]; ++k) {
      const std::size_t at = k * internal::slice_rows + r;
      Value value(sum<Stored>(m_first.m_main[at], m_rest.main[at]));
      if constexpr(Traits::is_complex)
        if(p.imaginary[s] != Sliced_pattern::none) {
          const std::size_t im = (p.imaginary[s] + k - p.slice_begin[s]) * internal::slice_rows + r;
          value.imag(double(m_first.m_im[im]) + double(m_rest_im[im][0]));
        }
      if(!Traits::is_zero(value))
        use(p.column[at], value);
    }
  }

  /// Returns the bytes that it takes beside `single()`.
  std::size_t memory() const
  {
    return m_rest.diagonal.size() * sizeof(m_rest.diagonal[0])
           + m_rest.main.size() * sizeof(m_rest.main[0]) + m_rest_im.size() * sizeof(m_rest_im[0]);
  }

private:
  static_assert(std::is_same<Rest, float>::value || !Traits::is_complex, "of real numbers only");

  typedef typename Traits::Stored Stored;
  typedef typename Single_precision<Value>::type Single_value;
  typedef typename Value_traits<Single_value>::Stored Stored_single;

  template <class Entry, class Single_entry, class Rests>
  static Entry sum(const Single_entry& first, const Rests& rests)
  {
    Entry entry;
    internal::set_sums<Rest>(&first, &rests, 1, &entry);
    return entry;
  }

  template <class Entries, class Parts, class Rests>
  static void set_rests(const Entries& entries, const Parts& parts, Rests& rests)
  {
    rests.resize(entries.size());
    for_each_index(entries.size(), [&](std::size_t i) {
      rests[i] = internal::rests_of<Rest>(entries[i], parts[i]);
    });
  }

  // The entries of a slice, joined.
  struct Joined_entries
  {
    const Split_matrix& matrix;
    std::vector<Stored> main_parts;
    std::vector<typename Traits::Real> imaginary_parts;

    const Stored* main(std::size_t begin, std::size_t count)
    {
      return join(matrix.m_first.m_main, matrix.m_rest.main, begin, count, main_parts);
    }
    const typename Traits::Real* imaginary(std::size_t begin, std::size_t count)
    {
      return join(matrix.m_first.m_im, matrix.m_rest_im, begin, count, imaginary_parts);
    }

    template <class Parts, class Rests, class Entry>
    static const Entry* join(const Parts& first, const Rests& rest, std::size_t begin,
                             std::size_t count, std::vector<Entry>& entries)
    {
      if(entries.size() < count)
        entries.resize(count);
      internal::set_sums<Rest>(first.data() + begin, rest.data() + begin, count, entries.data());
      return entries.data();
    }
  };

  Single m_first;
  Matrix_builder::Rest<Single_value, Rest> m_rest;
  std::vector<internal::Rests<typename Traits::Real, Rest>> m_rest_im;
};

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPLIT_MATRIX_H
