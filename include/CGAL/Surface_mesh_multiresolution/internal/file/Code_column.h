// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CODE_COLUMN_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CODE_COLUMN_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// --- Numbers in little endian, whatever the machine

inline std::uint64_t load_little_endian(const char* from, int bytes)
{
  std::uint64_t value = 0;
  for(int i = 0; i < bytes; ++i)
    value |= std::uint64_t(static_cast<unsigned char>(from[i])) << (8 * i);
  return value;
}

inline std::uint64_t load_64_bits(const char* from)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  std::uint64_t value;
  std::memcpy(&value, from, 8);
  return value;
#else
  return load_little_endian(from, 8);
#endif
}

inline void append_little_endian(std::string& to, std::uint64_t value, int bytes)
{
  for(int i = 0; i < bytes; ++i)
    to.push_back(char((value >> (8 * i)) & 255u));
}

// Signed numbers as unsigned ones, small if they are near 0: 0, -1, 1, -2, 2 ...
inline std::uint32_t zigzag(std::uint32_t x) { return (x << 1) ^ (std::uint32_t(0) - (x >> 31)); }
inline std::uint32_t unzigzag(std::uint32_t x) { return (x >> 1) ^ (std::uint32_t(0) - (x & 1u)); }

inline int trailing_zeros(std::uint64_t x) // x > 0
{
#if defined(__GNUC__)
  return __builtin_ctzll(x);
#else
  int result = 0;
  for(; (x & 1u) == 0; x >>= 1)
    ++result;
  return result;
#endif
}

// A column is a row of numbers of one kind in a bit stream, lowest bits first, under one of two
// codes with a parameter k:
//
// RICE        x = q 2^k + r: q zeros, a one, r in k bits; for q >= 20, 20 zeros and x in 32 bits.
//             For residuals, whose distribution falls off exponentially (Rice 1979).
// EXP_GOLOMB  x = (2^q - 1) 2^k + r: q <= 24 zeros, a one, r in q + k bits, k <= 8. For what is
//             near most of the time, and anywhere otherwise.
//
// In the stream: k (one byte), the number of bytes (four), the bytes. No number takes more than 57
// bits, so that one unaligned load of 64 bits is enough for it, nor less than one.
enum class Column_code { RICE, EXP_GOLOMB };

constexpr int rice_escape = 20;
constexpr int max_rice_parameter = 31;
constexpr int max_exp_golomb_prefix = 24;
constexpr int max_exp_golomb_parameter = 8;

// The bits of `x`, or a number above 57 if it cannot be written.
template <Column_code code>
int code_length(std::uint32_t x, int k)
{
  if(code == Column_code::RICE) {
    const std::uint32_t q = x >> k;
    return q < std::uint32_t(rice_escape) ? int(q) + 1 + k : rice_escape + 32;
  }
  int q = 0;
  for(std::uint64_t y = (std::uint64_t(x) >> k) + 1; y > 1; y >>= 1)
    ++q;
  return q <= max_exp_golomb_prefix ? 2 * q + 1 + k : 64;
}

class Bit_writer
{
public:
  void put(std::uint64_t bits, int count) // count <= 57, and no higher bits
  {
    m_bits |= bits << m_count;
    m_count += count;
    flush(0);
  }

  // The bytes, the last filled up by zeros. There are none then.
  std::string take_bytes()
  {
    flush(7);
    return std::exchange(m_bytes, std::string());
  }

private:
  void flush(int slack)
  {
    for(; m_count + slack >= 8; m_count -= 8, m_bits >>= 8)
      m_bytes.push_back(char(m_bits & 255u));
    m_count = (std::max)(m_count, 0);
  }

  std::string m_bytes;
  std::uint64_t m_bits = 0;
  int m_count = 0; // < 8 between calls
};

template <Column_code code>
void put_number(Bit_writer& bits, std::uint32_t x, int k)
{
  const std::uint64_t one = 1;
  if(code == Column_code::RICE) {
    const std::uint32_t q = x >> k;
    if(q < std::uint32_t(rice_escape))
      bits.put((std::uint64_t(x & ((one << k) - 1)) << (q + 1)) | (one << q), int(q) + 1 + k);
    else
      bits.put(std::uint64_t(x) << rice_escape, rice_escape + 32);
  } else {
    const int length = code_length<code>(x, k), q = (length - 1 - k) / 2;
    const std::uint64_t r = x - (((one << q) - 1) << k);
    bits.put((r << (q + 1)) | (one << q), length);
  }
}

// The parameter with the shortest code. It is sought from the mean on: all are convex enough.
template <Column_code code>
int best_parameter(const std::vector<std::uint32_t>& numbers)
{
  if(numbers.empty())
    return 0;
  const int last = code == Column_code::RICE ? max_rice_parameter : max_exp_golomb_parameter;
  const auto bits = [&numbers](int k) {
    std::uint64_t sum = 0;
    for(const std::uint32_t x : numbers)
      sum += std::uint64_t(code_length<code>(x, k)) * (code_length<code>(x, k) > 57 ? 1 << 20 : 1);
    return sum;
  };
  double sum = 0.;
  for(const std::uint32_t x : numbers)
    sum += double(x);
  int k = 0;
  while(k < last && double(std::uint64_t(2) << k) * double(numbers.size()) < sum)
    ++k;
  std::uint64_t best = bits(k);
  for(const int step : {-1, 1})
    for(int j = k + step; j >= 0 && j <= last; j += step) {
      const std::uint64_t other = bits(j);
      if(other > best)
        break;
      best = other;
      k = j;
    }
  return k;
}

template <Column_code code>
void append_column(std::string& to, const std::vector<std::uint32_t>& numbers)
{
  const int k = best_parameter<code>(numbers);
  Bit_writer bits;
  for(const std::uint32_t x : numbers)
    put_number<code>(bits, x, k);
  const std::string bytes = bits.take_bytes();
  append_little_endian(to, std::uint64_t(k), 1);
  append_little_endian(to, bytes.size(), 4);
  to += bytes;
}

// Flags and the like, which often are all 0: a column without bytes then.
inline void append_flags(std::string& to, const std::vector<std::uint32_t>& flags)
{
  if(std::all_of(flags.begin(), flags.end(), [](std::uint32_t flag) { return flag == 0; }))
    append_column<Column_code::RICE>(to, {});
  else
    append_column<Column_code::RICE>(to, flags);
}

// Reads a column. Beyond its end it reads what follows in memory, at most eight bytes of it, and
// `is_sound()` is false then.
class Column_reader
{
public:
  Column_reader() {}

  // A column of at least `count` numbers at `from`, which it moves behind the column. Not sound if
  // there are not that many bits before `end`.
  Column_reader(const char*& from, const char* end, std::size_t count)
  {
    if(end - from < 5)
      return;
    const int k = static_cast<unsigned char>(from[0]);
    const std::uint64_t size = load_little_endian(from + 1, 4);
    from += 5;
    if(k > max_rice_parameter || size > std::uint64_t(end - from) || count > 8 * size)
      return;
    m_data = from;
    m_size = std::size_t(size);
    m_k = k;
    m_mask = (std::uint64_t(1) << k) - 1;
    m_is_open = true;
    from += size;
  }

  bool is_empty() const { return m_size == 0; }

  // Whether this is a column, and nothing was read behind its end.
  bool is_sound() const { return m_is_open && m_at <= 8 * m_size; }

  template <Column_code code>
  std::uint32_t next()
  {
    return number_at<code>((std::min)(m_at >> 3, m_size));
  }

  // The same without a look at the end, where bad data may pass it by 57 bits a number.
  template <Column_code code>
  std::uint32_t next_unbounded()
  {
    return number_at<code>(m_at >> 3);
  }

private:
  // The number that begins in this byte.
  template <Column_code code>
  std::uint32_t number_at(std::size_t byte)
  {
    const std::uint64_t one = 1;
    const std::uint64_t window = load_64_bits(m_data + byte) >> (m_at & 7u);
    if(code == Column_code::RICE) {
      const int q = trailing_zeros(window | (one << rice_escape));
      if(q == rice_escape) {
        m_at += rice_escape + 32;
        return std::uint32_t(window >> rice_escape);
      }
      m_at += std::size_t(q + 1 + m_k);
      return std::uint32_t((std::uint64_t(q) << m_k) | ((window >> (q + 1)) & m_mask));
    }
    const int q = trailing_zeros(window | (one << max_exp_golomb_prefix));
    const int k = m_k & 15;
    m_at += std::size_t(2 * q + 1 + k);
    const std::uint64_t r = (window >> (q + 1)) & ((one << (q + k)) - 1);
    return std::uint32_t((((one << q) - 1) << k) + r);
  }

  const char* m_data = nullptr;
  std::size_t m_size = 0, m_at = 0; // bytes, bits
  std::uint64_t m_mask = 0;
  int m_k = 0;
  bool m_is_open = false;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CODE_COLUMN_H
