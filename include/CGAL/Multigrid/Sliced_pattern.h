// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SLICED_PATTERN_H
#define CGAL_MULTIGRID_SLICED_PATTERN_H

#include <CGAL/Multigrid/vector_operations.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL {
namespace Multigrid {

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

// The sums of the rows of a slice, of real numbers and blocks.
template <class Value>
class Slice_sums
{
public:
  typedef typename Value_traits<Value>::Vector_value Sum;
  typedef typename Value_traits<Value>::Stored Stored;

  void add(const std::uint32_t* column, const Stored* entry, std::size_t width, const Sum* x)
  {
    for(int r = 0; r < slice_rows; ++r)
      m_sum[r] = Value_traits<Sum>::zero();
    for(std::size_t k = 0; k < width; ++k)
      for(int r = 0; r < slice_rows; ++r)
        m_sum[r] += entry[k * slice_rows + r] * x[column[k * slice_rows + r]];
  }
  const Sum& operator[](std::size_t r) const { return m_sum[r]; }

private:
  Sum m_sum[slice_rows];
};

template <class Real>
class Slice_sums<std::complex<Real>>
{
public:
  typedef std::complex<Real> Sum;

  void add(const std::uint32_t* column, const Real* re, std::size_t width, const Sum* x)
  {
    sum_slice(column, re, width, reinterpret_cast<const Real*>(x), m_sum);
  }
  void add_imaginary(const std::uint32_t* column, const Real* im, std::size_t width, const Sum* x)
  {
    internal::add_imaginary(column, im, width, reinterpret_cast<const Real*>(x), m_sum);
  }
  Sum operator[](std::size_t r) const { return Sum(m_sum[2 * r], m_sum[2 * r + 1]); }

private:
  Real m_sum[2 * slice_rows];
};

} // namespace internal

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SLICED_PATTERN_H
