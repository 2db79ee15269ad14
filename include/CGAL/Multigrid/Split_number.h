// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPLIT_NUMBER_H
#define CGAL_MULTIGRID_SPLIT_NUMBER_H

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

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

// The numbers of an entry of a matrix, which is one or a block, and the rests of all of them.
template <class Entry>
struct Entry_numbers
{
  static constexpr int count = 1;
  template <class Rest>
  using Rests = Rest;

  static const Entry* begin(const Entry& entry) { return &entry; }
  static Entry* begin(Entry& entry) { return &entry; }
  static Entry zero() { return Entry(0); }
};
template <class Real, int N>
struct Entry_numbers<Eigen::Matrix<Real, N, N>>
{
  typedef Eigen::Matrix<Real, N, N> Entry;
  static constexpr int count = N * N;
  template <class Rest>
  using Rests = Eigen::Matrix<Rest, N, N>;

  static const Real* begin(const Entry& entry) { return entry.data(); }
  static Real* begin(Entry& entry) { return entry.data(); }
  static Entry zero() { return Entry::Zero(); }
};

// Sets the rests of an entry that was rounded.
template <class Rest, class Entry, class Rounded, class Rests>
void set_rests(const Entry& entry, const Rounded& rounded, Rests& rests)
{
  const auto* const numbers = Entry_numbers<Entry>::begin(entry);
  const auto* const rounded_numbers = Entry_numbers<Rounded>::begin(rounded);
  for(int i = 0; i < Entry_numbers<Entry>::count; ++i)
    Entry_numbers<Rests>::begin(rests)[i] = Split_number<Rest>::rest(numbers[i], rounded_numbers[i]);
}

// Sets `count` entries to the sums.
template <class Rest, class Entry, class Rounded, class Rests>
void set_sums(const Rounded* rounded, const Rests* rests, std::size_t count, Entry* entries)
{
  if(count == 0)
    return;
  const auto* const a = Entry_numbers<Rounded>::begin(*rounded);
  const auto* const b = Entry_numbers<Rests>::begin(*rests);
  auto* const sums = Entry_numbers<Entry>::begin(*entries);
  for(std::size_t i = 0; i < count * Entry_numbers<Entry>::count; ++i)
    sums[i] = std::remove_reference_t<decltype(*sums)>(Split_number<Rest>::sum(a[i], b[i]));
}

} // namespace internal
} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPLIT_NUMBER_H
