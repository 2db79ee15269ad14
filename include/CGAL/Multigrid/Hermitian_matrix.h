// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_HERMITIAN_MATRIX_H
#define CGAL_MULTIGRID_HERMITIAN_MATRIX_H

#include <CGAL/Blocked_execution/memory.h>
#include <CGAL/Multigrid/vector_operations.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

One row of a Hermitian matrix while it is being built: the real diagonal entry and the entries
beside it.
*/
struct Matrix_row
{
  /// An entry beside the diagonal.
  struct Entry
  {
    std::uint32_t column; ///< its column
    double re;            ///< its real part
    double im;            ///< its imaginary part
  };

  double diagonal = 0.;       ///< the diagonal entry
  std::vector<Entry> entries; ///< those beside it, in any order, each column once
};

/*!
\ingroup PkgHLSCMMultigrid

The sparsity pattern that matrices of one level share: rows in slices of eight, whose entries are
stored column-wise (sliced ELLPACK), rows of near equal length side by side. Slices with an
imaginary part anywhere are marked.
*/
struct Sliced_pattern
{
  static constexpr std::size_t slice_rows = 8;       ///< rows of a slice
  static constexpr std::size_t sorting_window = 256; ///< rows that are sorted by length together

  std::size_t rows = 0;                   ///< rows of the matrix
  std::vector<std::uint32_t> row_of_slot; ///< padded with row 0, whose slot is never written
  /// In units of `slice_rows` entries; one more than slices.
  std::vector<std::uint32_t> slice_begin;
  /// The begin of each slice's imaginary parts, in the same units, or `none`.
  std::vector<std::uint32_t> imaginary;
  std::vector<std::uint32_t> column; ///< the column of each entry

  static constexpr std::uint32_t none = std::uint32_t(-1); ///< no imaginary parts
  /// Returns the number of slices.
  std::size_t slices() const { return imaginary.size(); }
  /// Returns the bytes that the pattern takes.
  std::size_t memory() const
  {
    return (row_of_slot.size() + slice_begin.size() + imaginary.size() + column.size())
           * sizeof(std::uint32_t);
  }
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Hermitian_matrix` is a sparse Hermitian matrix with a real diagonal, most of whose
entries are real, such as that of a conformal energy. The values are stored as `Real`.
*/
template <class Real>
class Hermitian_matrix
{
public:
  typedef std::complex<Real> Complex; ///< an entry

  /// Returns the number of rows; 0 for a matrix that was not built.
  std::size_t size() const { return m_pattern == nullptr ? 0 : m_pattern->rows; }
  /// Returns the diagonal, by rows.
  const std::vector<Real>& diagonal() const { return m_diagonal; }
  /// Returns the pattern. Precondition: the matrix was built.
  const Sliced_pattern& pattern() const { return *m_pattern; }

  /// Calls `use(i, s)` for every row i with \f$ s = \sum_{j \ne i} H_{ij} x_j \f$, in any order and
  /// possibly at the same time.
  template <class Use>
  void for_each_row_sum(const Complex_vector<Real>& x, const Use& use) const;

  /// Sets `y` to \f$ H x \f$.
  void multiply(const Complex_vector<Real>& x, Complex_vector<Real>& y) const
  {
    for_each_row_sum(x, [&](std::size_t i, Complex s) { y[i] = m_diagonal[i] * x[i] + s; });
  }

  /// Calls `use(j, H_ij)` for the entries beside the diagonal of the row i in `slot`, stored zeros
  /// left out. `slot_of_row()` tells where a row is.
  template <class Use>
  void for_each_entry(std::size_t slot, const Use& use) const;

  /// Returns the number of entries that are not 0, those of the diagonal included. Linear time.
  std::size_t number_of_nonzeros() const;

  /// Returns the bytes that the matrix takes, with its pattern.
  std::size_t memory() const
  {
    return (m_diagonal.size() + m_re.size() + m_im.size()) * sizeof(Real)
           + (m_pattern == nullptr ? 0 : m_pattern->memory());
  }

  /// Returns for each row its slot.
  std::vector<std::uint32_t> slot_of_row() const;

  /// Returns the slot of row `i`. Constant time.
  std::size_t slot_of_row(std::uint32_t i) const;

  /// Returns row `i` and sets it to zero; its column is kept. Constant time.
  Matrix_row take_row(std::uint32_t i);

  /// Sets row `i`, which is zero, to what `take_row()` returned for it. Constant time.
  void put_row(std::uint32_t i, const Matrix_row& row);

  template <class Other> friend class Hermitian_matrix;
  friend class Matrix_builder;

  /// Constructs a matrix of the same entries in another precision; the pattern is shared.
  template <class Other>
  void assign(const Hermitian_matrix<Other>& other)
  {
    m_pattern = other.m_pattern;
    m_diagonal.assign(other.m_diagonal.begin(), other.m_diagonal.end());
    m_re.resize(other.m_re.size());
    for_each_index(m_re.size(), [&](std::size_t i) { m_re[i] = Real(other.m_re[i]); });
    m_im.assign(other.m_im.begin(), other.m_im.end());
  }

private:
  std::shared_ptr<const Sliced_pattern> m_pattern;
  std::vector<Real> m_diagonal, m_im;
  Blocked_execution::Uninitialized_vector<Real> m_re;
};

namespace internal {

constexpr int slice_rows = int(Sliced_pattern::slice_rows);

// The sums of one slice, real and imaginary parts in turn: eight rows at once, entry by entry.
template <class Real>
inline void sum_slice(const std::uint32_t* column, const Real* re, std::size_t width, const Real* x,
                      Real* sum)
{
  for(int r = 0; r < 2 * slice_rows; ++r)
    sum[r] = Real(0);
  for(std::size_t k = 0; k < width; ++k)
    for(int r = 0; r < slice_rows; ++r) {
      const Real* z = x + 2 * std::size_t(column[k * slice_rows + r]);
      sum[2 * r] += re[k * slice_rows + r] * z[0];
      sum[2 * r + 1] += re[k * slice_rows + r] * z[1];
    }
}

#if defined(__GNUC__) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)

// The same in single precision, where a complex number is loaded as one word of 64 bits; 1.7 times
// as fast as what compilers make of the loops above.
inline void sum_slice(const std::uint32_t* column, const float* re, std::size_t width,
                      const float* x, float* sum)
{
  typedef float Floats __attribute__((vector_size(32)));
  typedef std::uint64_t Words __attribute__((vector_size(32)));
  const auto word = [x](std::uint32_t i) {
    std::uint64_t result;
    std::memcpy(&result, x + 2 * std::size_t(i), sizeof(result));
    return result;
  };
  Floats low = {}, high = {};
  for(std::size_t k = 0; k < width; ++k) {
    const std::uint32_t* c = column + k * slice_rows;
    Floats w;
    std::memcpy(&w, re + k * slice_rows, sizeof(w));
    const Words low_words = {word(c[0]), word(c[1]), word(c[2]), word(c[3])};
    const Words high_words = {word(c[4]), word(c[5]), word(c[6]), word(c[7])};
    low += Floats(__builtin_shufflevector(w, w, 0, 0, 1, 1, 2, 2, 3, 3)) * Floats(low_words);
    high += Floats(__builtin_shufflevector(w, w, 4, 4, 5, 5, 6, 6, 7, 7)) * Floats(high_words);
  }
  std::memcpy(sum, &low, sizeof(low));
  std::memcpy(sum + slice_rows, &high, sizeof(high));
}

#endif
#endif

// What imaginary parts add to the sums.
template <class Real>
inline void add_imaginary(const std::uint32_t* column, const Real* im, std::size_t width,
                          const Real* x, Real* sum)
{
  for(std::size_t k = 0; k < width; ++k)
    for(int r = 0; r < slice_rows; ++r) {
      const Real* z = x + 2 * std::size_t(column[k * slice_rows + r]);
      sum[2 * r] -= im[k * slice_rows + r] * z[1];
      sum[2 * r + 1] += im[k * slice_rows + r] * z[0];
    }
}

} // namespace internal

template <class Real>
template <class Use>
void Hermitian_matrix<Real>::for_each_row_sum(const Complex_vector<Real>& x, const Use& use) const
{
  const Sliced_pattern& p = *m_pattern;
  const Real* xp = reinterpret_cast<const Real*>(x.data());
  Blocked_execution::blocked_for(p.slices(), 1024, [&](std::size_t first, std::size_t last) {
    for(std::size_t s = first; s < last; ++s) {
      const std::size_t begin = std::size_t(p.slice_begin[s]) * internal::slice_rows;
      const std::size_t width = p.slice_begin[s + 1] - p.slice_begin[s];
      Real sum[2 * internal::slice_rows];
      internal::sum_slice(p.column.data() + begin, m_re.data() + begin, width, xp, sum);
      if(p.imaginary[s] != Sliced_pattern::none)
        internal::add_imaginary(p.column.data() + begin,
                                m_im.data() + std::size_t(p.imaginary[s]) * internal::slice_rows,
                                width, xp, sum);
      const std::size_t slot = s * internal::slice_rows;
      const std::size_t count = (std::min)(p.rows - slot, std::size_t(internal::slice_rows));
      for(std::size_t r = 0; r < count; ++r)
        use(std::size_t(p.row_of_slot[slot + r]), Complex(sum[2 * r], sum[2 * r + 1]));
    }
  });
}

template <class Real>
template <class Use>
void Hermitian_matrix<Real>::for_each_entry(std::size_t slot, const Use& use) const
{
  const Sliced_pattern& p = *m_pattern;
  const std::size_t s = slot / internal::slice_rows, r = slot % internal::slice_rows;
  for(std::size_t k = p.slice_begin[s]; k < p.slice_begin[s + 1]; ++k) {
    const std::size_t at = k * internal::slice_rows + r;
    const std::size_t im = p.imaginary[s] == Sliced_pattern::none
                         ? 0 : (p.imaginary[s] + k - p.slice_begin[s]) * internal::slice_rows + r;
    const Complex value(m_re[at], p.imaginary[s] == Sliced_pattern::none ? Real(0) : m_im[im]);
    if(value != Complex(0))
      use(p.column[at], value);
  }
}

template <class Real>
std::size_t Hermitian_matrix<Real>::number_of_nonzeros() const
{
  std::size_t count = 0;
  for(std::size_t slot = 0; slot < size(); ++slot) {
    count += m_diagonal[m_pattern->row_of_slot[slot]] != Real(0) ? 1 : 0;
    for_each_entry(slot, [&count](std::uint32_t, const Complex&) { ++count; });
  }
  return count;
}

template <class Real>
std::vector<std::uint32_t> Hermitian_matrix<Real>::slot_of_row() const
{
  std::vector<std::uint32_t> slot(size());
  for(std::uint32_t s = 0; s < size(); ++s)
    slot[m_pattern->row_of_slot[s]] = s;
  return slot;
}

template <class Real>
std::size_t Hermitian_matrix<Real>::slot_of_row(std::uint32_t i) const
{
  // Rows are sorted within windows only.
  const auto window = m_pattern->row_of_slot.begin()
                    + i / Sliced_pattern::sorting_window * Sliced_pattern::sorting_window;
  return std::find(window, m_pattern->row_of_slot.end(), i) - m_pattern->row_of_slot.begin();
}

template <class Real>
Matrix_row Hermitian_matrix<Real>::take_row(std::uint32_t i)
{
  Matrix_row row;
  row.diagonal = double(m_diagonal[i]);
  for_each_entry(slot_of_row(i), [&row](std::uint32_t j, const Complex& value) {
    row.entries.push_back({j, double(value.real()), double(value.imag())});
  });
  put_row(i, Matrix_row());
  return row;
}

template <class Real>
void Hermitian_matrix<Real>::put_row(std::uint32_t i, const Matrix_row& row)
{
  const Sliced_pattern& p = *m_pattern;
  const std::size_t slot = slot_of_row(i), s = slot / internal::slice_rows,
                    r = slot % internal::slice_rows;
  m_diagonal[i] = Real(row.diagonal);
  for(std::size_t k = 0; k < p.slice_begin[s + 1] - p.slice_begin[s]; ++k) {
    const std::size_t at = (p.slice_begin[s] + k) * internal::slice_rows + r;
    const auto entry = std::find_if(row.entries.begin(), row.entries.end(), [&](const auto& e) {
      return e.column == p.column[at];
    });
    const bool is_set = entry != row.entries.end();
    m_re[at] = is_set ? Real(entry->re) : Real(0);
    if(p.imaginary[s] != Sliced_pattern::none)
      m_im[(p.imaginary[s] + k) * internal::slice_rows + r] = is_set ? Real(entry->im) : Real(0);
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_HERMITIAN_MATRIX_H
