// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_MATRIX_BUILDER_H
#define CGAL_MULTIGRID_MATRIX_BUILDER_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/Uninitialized_vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

namespace CGAL {
namespace Multigrid {

namespace internal {

// What a number is more than one that was rounded: as a number of less precision, whose sum with that
// has 48 bits if both are single.
template <class Rest>
struct Split_number
{
  template <class Rounded>
  static Rest rest(double number, Rounded rounded) { return Rest(number - double(rounded)); }
  template <class Rounded>
  static double sum(Rounded rounded, Rest rest) { return double(rounded) + double(rest); }
};

// The same in 16 bits, of 2^-15 of the most that rounding takes off: 39 bits together.
template <>
struct Split_number<std::int16_t>
{
  static std::int16_t rest(double number, float rounded)
  {
    constexpr double most = 32767.;
    const double r = (number - double(rounded)) / unit(rounded);
    return r > -most && r < most ? std::int16_t(std::lrint(r))
         : r >= most ? std::int16_t(most) : r <= -most ? std::int16_t(-most) : std::int16_t(0);
  }
  static double sum(float rounded, std::int16_t rest) { return double(rounded) + unit(rounded) * rest; }

private:
  // 2^-39 of the power of 2 that is not greater, by its exponent.
  static double unit(float rounded)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &rounded, sizeof bits);
    bits &= 0x7f800000u;
    float power;
    std::memcpy(&power, &bits, sizeof power);
    return double(power) * 0x1p-39;
  }
};

// The rests of all numbers of an entry of a matrix.
template <class Entry, class Rest>
using Rests = std::array<Rest, Value_traits<Entry>::components>;

template <class Entry>
const typename Value_traits<Entry>::Real* numbers_of(const Entry& entry)
{
  return reinterpret_cast<const typename Value_traits<Entry>::Real*>(&entry);
}

// The rests of an entry that was rounded.
template <class Rest, class Entry, class Rounded>
Rests<Entry, Rest> rests_of(const Entry& entry, const Rounded& rounded)
{
  Rests<Entry, Rest> rests;
  for(std::size_t i = 0; i < rests.size(); ++i)
    rests[i] = Split_number<Rest>::rest(numbers_of(entry)[i], numbers_of(rounded)[i]);
  return rests;
}

// Sets `count` entries to the sums.
template <class Rest, class Entry, class Rounded>
void set_sums(const Rounded* rounded, const Rests<Rounded, Rest>* rests, std::size_t count, Entry* entries)
{
  typedef typename Value_traits<Entry>::Real Real;
  if(count == 0)
    return;
  const auto* const a = numbers_of(*rounded);
  const Rest* const b = rests->data();
  Real* const sums = reinterpret_cast<Real*>(entries);
  for(std::size_t i = 0; i < count * Value_traits<Entry>::components; ++i)
    sums[i] = Real(Split_number<Rest>::sum(a[i], b[i]));
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

The place of a row in a matrix that is being built, for a row without imaginary parts, of real
numbers or blocks. Entries that are not set become padding. What rounding takes off them may have
places of its own, for numbers of type `Rest`.
*/
template <class Stored, class Rest = typename Value_traits<Stored>::Real>
class Real_row
{
public:
  typedef typename Value_traits<Stored>::Double Double; ///< an entry in double precision
  /// What rounding takes off an entry
  typedef internal::Rests<Stored, Rest> Rests;

  /// Constructs the place whose entry `k` is at `k * Sliced_pattern::slice_rows`.
  Real_row(std::uint32_t* column, Stored* re, Stored& diagonal)
    : m_column(column), m_re(re), m_diagonal(diagonal)
  {}

  /// Gives what rounding takes off places as those of the entries.
  void keep_rest(Rests* re, Rests& diagonal)
  {
    m_rest = re;
    m_rest_diagonal = &diagonal;
  }

  /// Sets the diagonal entry and the first `count` entries beside it.
  ///
  /// \param count not more than the announced length of the row
  template <class Index>
  void set(const Double& diagonal, std::size_t count, const Index* column, const Double* re)
  {
    m_diagonal = Value_traits<Stored>::from(diagonal);
    for(std::size_t k = 0; k < count; ++k) {
      m_column[k * Sliced_pattern::slice_rows] = std::uint32_t(column[k]);
      m_re[k * Sliced_pattern::slice_rows] = Value_traits<Stored>::from(re[k]);
    }
    m_count = count;
    if(m_rest == nullptr)
      return;
    *m_rest_diagonal = internal::rests_of<Rest>(diagonal, m_diagonal);
    for(std::size_t k = 0; k < count; ++k)
      m_rest[k * Sliced_pattern::slice_rows]
        = internal::rests_of<Rest>(re[k], m_re[k * Sliced_pattern::slice_rows]);
  }

  /// Returns the number of entries that have been set.
  std::size_t count() const { return m_count; }

private:
  std::uint32_t* m_column;
  Stored* m_re;
  Stored& m_diagonal;
  Rests *m_rest = nullptr, *m_rest_diagonal = nullptr;
  std::size_t m_count = 0;
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Matrix_builder` makes a `Self_adjoint_matrix` row by row.
*/
class Matrix_builder
{
public:
  /// Returns the matrix of the given row lengths, whose row i is what `fill(i, row)` leaves in the
  /// empty `Self_adjoint_matrix<Value>::Row` that it is given. A row may be shorter than announced,
  /// not longer. One call a row, in any order and possibly at the same time.
  template <class Value, class Fill>
  static Self_adjoint_matrix<Value> build_matrix(const std::vector<std::uint32_t>& row_lengths,
                                                 const Fill& fill)
  {
    const auto none = [](std::uint32_t, Real_row<typename Value_traits<Value>::Stored>&) {
      return false;
    };
    return build_matrix<Value>(row_lengths, none, fill);
  }

  /// Returns the same matrix, where most rows are real: `fill_real(i, row)` sets the `Real_row` and
  /// returns `true`, or returns `false`, and `fill(i, row)` is called.
  template <class Value, class Fill_real, class Fill>
  static Self_adjoint_matrix<Value> build_matrix(const std::vector<std::uint32_t>& row_lengths,
                                                 const Fill_real& fill_real, const Fill& fill)
  {
    Rest<Value, typename Value_traits<Value>::Real>* const none = nullptr;
    return build_with_rest<Value>(row_lengths, fill_real, fill, none);
  }

  /// Returns `build_matrix()` of complex numbers.
  template <class Real, class... Fills>
  static Hermitian_matrix<Real> build(const std::vector<std::uint32_t>& row_lengths,
                                      const Fills&... fills)
  {
    return build_matrix<std::complex<Real>>(row_lengths, fills...);
  }

private:
  template <class Value, class Rest> friend class Split_matrix;

  // What rounding takes off the entries of a matrix without imaginary parts.
  template <class Value, class Real>
  struct Rest
  {
    std::vector<internal::Rests<typename Value_traits<Value>::Diagonal, Real>> diagonal;
    Blocked_execution::Uninitialized_vector<internal::Rests<typename Value_traits<Value>::Stored, Real>> main;
  };

  // `build_matrix()`, with the rest if one is given.
  template <class Value, class Real, class Fill_real, class Fill>
  static Self_adjoint_matrix<Value> build_with_rest(const std::vector<std::uint32_t>& row_lengths,
                                                    const Fill_real& fill_real, const Fill& fill,
                                                    Rest<Value, Real>* rest);

  static constexpr std::size_t rows = Sliced_pattern::slice_rows;
  static constexpr std::size_t block_slices = 512;

  static void sort_slots(const std::vector<std::uint32_t>& lengths, Sliced_pattern& pattern);
  static void sort_window(const std::vector<std::uint32_t>& lengths, std::size_t begin,
                          std::size_t end, Sliced_pattern& pattern);
  // The imaginary parts of a block of slices, before they are joined.
  template <class Value>
  using Imaginary = std::vector<typename Value_traits<Value>::Real>;

  template <class Value>
  static void store_row(const typename Self_adjoint_matrix<Value>::Row& row, std::size_t slot,
                        Sliced_pattern& pattern, Self_adjoint_matrix<Value>& matrix,
                        Imaginary<Value>& imaginary_of_block);
  template <class Value, class Real>
  static void pad_row(std::size_t count, std::size_t slot, Sliced_pattern& pattern,
                      Self_adjoint_matrix<Value>& matrix, Rest<Value, Real>* rest);
  template <class Value>
  static void join_imaginary(std::vector<Imaginary<Value>>& blocks, Sliced_pattern& pattern,
                             Self_adjoint_matrix<Value>& matrix);
};

// Sorts the rows of a window by length, longest first, stably.
inline void Matrix_builder::sort_window(const std::vector<std::uint32_t>& lengths,
                                        std::size_t begin, std::size_t end,
                                        Sliced_pattern& pattern)
{
  constexpr std::uint32_t longest = 31; // longer rows are rare and come first, in their order
  std::array<std::uint32_t, longest + 2> first = {};
  const auto place = [&](std::size_t i) { return longest - (std::min)(lengths[i], longest); };
  for(std::size_t i = begin; i < end; ++i)
    ++first[place(i) + 1];
  for(std::uint32_t l = 0; l <= longest; ++l)
    first[l + 1] += first[l];
  for(std::size_t i = begin; i < end; ++i)
    pattern.row_of_slot[begin + first[place(i)]++] = std::uint32_t(i);
}

// Rows of a window are sorted by length, so that slices need little padding.
inline void Matrix_builder::sort_slots(const std::vector<std::uint32_t>& lengths,
                                       Sliced_pattern& pattern)
{
  const std::size_t n = lengths.size();
  const std::size_t slices = Blocked_execution::number_of_blocks(n, rows);
  pattern.rows = n;
  pattern.row_of_slot.assign(slices * rows, 0);
  Blocked_execution::blocked_for(n, Sliced_pattern::sorting_window,
                                 [&](std::size_t begin, std::size_t end) {
    sort_window(lengths, begin, end, pattern);
  });
  pattern.slice_begin.assign(slices + 1, 0);
  Blocked_execution::blocked_for(slices, block_slices, [&](std::size_t begin, std::size_t end) {
    for(std::size_t s = begin; s < end; ++s)
      for(std::size_t slot = s * rows; slot < (std::min)((s + 1) * rows, n); ++slot)
        pattern.slice_begin[s + 1]
          = (std::max)(pattern.slice_begin[s + 1], lengths[pattern.row_of_slot[slot]]);
  });
  for(std::size_t s = 0; s < slices; ++s)
    pattern.slice_begin[s + 1] += pattern.slice_begin[s];
}

template <class Value>
void Matrix_builder::store_row(const typename Self_adjoint_matrix<Value>::Row& row,
                               std::size_t slot, Sliced_pattern& pattern,
                               Self_adjoint_matrix<Value>& matrix,
                               Imaginary<Value>& imaginary_of_block)
{
  typedef Value_traits<Value> Traits;
  typedef typename Traits::Real Real;
  const std::size_t s = slot / rows, r = slot % rows;
  const std::size_t width = pattern.slice_begin[s + 1] - pattern.slice_begin[s];
  matrix.m_diagonal[pattern.row_of_slot[slot]]
    = Value_traits<typename Traits::Diagonal>::from(row.diagonal);
  for(std::size_t k = 0; k < row.entries.size(); ++k) {
    const std::size_t at = (pattern.slice_begin[s] + k) * rows + r;
    pattern.column[at] = row.entries[k].column;
    matrix.m_main[at]
      = Value_traits<typename Traits::Stored>::from(internal::main_part(row.entries[k]));
    const double im = internal::imaginary_part(row.entries[k]);
    if(im == 0.)
      continue;
    if(pattern.imaginary[s] == Sliced_pattern::none) { // counted from the begin of the block
      pattern.imaginary[s] = std::uint32_t(imaginary_of_block.size() / rows);
      imaginary_of_block.resize(imaginary_of_block.size() + width * rows, Real(0));
    }
    imaginary_of_block[(pattern.imaginary[s] + k) * rows + r] = Real(im);
  }
}

// Fills what is left of a row of `count` entries. Padding refers to the row itself, which is in the
// cache.
template <class Value, class Real>
void Matrix_builder::pad_row(std::size_t count, std::size_t slot, Sliced_pattern& pattern,
                             Self_adjoint_matrix<Value>& matrix, Rest<Value, Real>* rest)
{
  const auto zero = Value_traits<typename Value_traits<Value>::Stored>::zero();
  const std::size_t s = slot / rows, end = pattern.slice_begin[s + 1];
  for(std::size_t k = pattern.slice_begin[s] + count; k < end; ++k) {
    pattern.column[k * rows + slot % rows] = pattern.row_of_slot[slot];
    matrix.m_main[k * rows + slot % rows] = zero;
    if(rest != nullptr)
      rest->main[k * rows + slot % rows] = {};
  }
}

// Puts the imaginary parts of the blocks one after the other.
template <class Value>
void Matrix_builder::join_imaginary(std::vector<Imaginary<Value>>& blocks,
                                    Sliced_pattern& pattern, Self_adjoint_matrix<Value>& matrix)
{
  for(std::size_t b = 0; b < blocks.size(); ++b) {
    const std::uint32_t offset = std::uint32_t(matrix.m_im.size() / rows);
    const std::size_t end = (std::min)((b + 1) * block_slices, pattern.slices());
    for(std::size_t s = b * block_slices; s < end; ++s)
      if(pattern.imaginary[s] != Sliced_pattern::none)
        pattern.imaginary[s] += offset;
    matrix.m_im.insert(matrix.m_im.end(), blocks[b].begin(), blocks[b].end());
  }
}

template <class Value, class Real, class Fill_real, class Fill>
Self_adjoint_matrix<Value>
Matrix_builder::build_with_rest(const std::vector<std::uint32_t>& row_lengths,
                                const Fill_real& fill_real, const Fill& fill,
                                Rest<Value, Real>* rest)
{
  typedef Value_traits<Value> Traits;
  typedef typename Self_adjoint_matrix<Value>::Row Row;
  auto pattern = std::make_shared<Sliced_pattern>();
  sort_slots(row_lengths, *pattern);
  const std::size_t slices = pattern->slice_begin.size() - 1;
  const std::size_t size = pattern->slice_begin[slices] * rows;
  pattern->imaginary.assign(slices, Sliced_pattern::none);
  Blocked_execution::resize_blocked(pattern->column, size);
  Self_adjoint_matrix<Value> matrix;
  const auto make = [&](auto& main, auto& diagonal, const auto& zero, const auto& zero_diagonal) {
    main.resize(size);
    if(slices > 0) // its last slots may have no row
      std::fill(main.begin() + pattern->slice_begin[slices - 1] * rows, main.end(), zero);
    diagonal.assign(pattern->rows, zero_diagonal);
  };
  typedef typename Traits::Stored Stored;
  typedef typename Traits::Diagonal Diagonal;
  make(matrix.m_main, matrix.m_diagonal, Value_traits<Stored>::zero(), Value_traits<Diagonal>::zero());
  if(rest != nullptr)
    make(rest->main, rest->diagonal, internal::Rests<Stored, Real>{}, internal::Rests<Diagonal, Real>{});
  std::vector<Imaginary<Value>> imaginary(
    Blocked_execution::number_of_blocks(slices, block_slices));
  Blocked_execution::blocked_for(pattern->rows, block_slices * rows,
                                 [&](std::size_t begin, std::size_t end) {
    Row row;
    for(std::size_t slot = begin; slot < end; ++slot) {
      const std::uint32_t i = pattern->row_of_slot[slot];
      const std::size_t at // somewhere in the arrays even if the row has no entries
        = (std::min)(pattern->slice_begin[slot / rows] * rows + slot % rows, size);
      Real_row<typename Traits::Stored, Real> place(pattern->column.data() + at,
                                              matrix.m_main.data() + at, matrix.m_diagonal[i]);
      if constexpr(!Traits::is_complex)
        if(rest != nullptr)
          place.keep_rest(rest->main.data() + at, rest->diagonal[i]);
      std::size_t count = 0;
      if(fill_real(i, place))
        count = place.count();
      else {
        row.diagonal = Value_traits<typename Row::Diagonal>::zero();
        row.entries.clear();
        fill(i, row);
        store_row<Value>(row, slot, *pattern, matrix, imaginary[begin / (block_slices * rows)]);
        count = row.entries.size();
      }
      pad_row(count, slot, *pattern, matrix, rest);
    }
  });
  join_imaginary<Value>(imaginary, *pattern, matrix);
  matrix.m_pattern = std::move(pattern);
  return matrix;
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_MATRIX_BUILDER_H
