// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SYMBOL_CODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SYMBOL_CODER_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Code_column.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// An entropy coder of symbols 0 to 15 with adaptive probabilities, beside a stream of plain bits.
//
// The symbols go through an asymmetric numeral system (Duda 2009; the variant that is renormalised
// in words of 16 bits, Giesen 2014): a state x, from which the decoder takes a symbol and puts back
// what the symbol did not need. It is a stack, so the encoder begins with the last symbol; the
// models, which learn from the symbols, go forward in both.
//
// Encoder and decoder have the same interface: symbol() and bits() return the number that is coded,
// which the encoder is given and the decoder is not. So what is written and what is read is said in
// one place, as a function of the coder.

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

constexpr int symbol_count = 16;
constexpr int probability_bits = 15;

// Where the symbols' parts of 2^15 begin.
struct alignas(16) Symbol_starts : std::array<std::int16_t, symbol_count>
{};

// Row s: where the parts begin if s takes all but what the others need not to vanish.
constexpr std::array<Symbol_starts, symbol_count> make_symbol_targets()
{
  std::array<Symbol_starts, symbol_count> targets = {};
  for(int s = 0; s < symbol_count; ++s)
    for(int i = 0; i < symbol_count; ++i)
      targets[std::size_t(s)][std::size_t(i)]
        = std::int16_t(i <= s ? i : (1 << probability_bits) - symbol_count + i);
  return targets;
}

inline constexpr std::array<Symbol_starts, symbol_count> symbol_targets = make_symbol_targets();

// The probabilities of the symbols, as learned from those before.
//
// Each symbol moves the starts by a part of the way to its target, which is 1/4 first and 1/128
// in the end. Rounding keeps differences of at least 1: x + floor((T - x) / 2^r) is
// floor((T + (2^r - 1) x) / 2^r), and both T and x differ by at least 1 from symbol to symbol.
class Symbol_model
{
public:
  Symbol_model()
  {
    for(int i = 0; i <= symbol_count; ++i)
      m_start[std::size_t(i)] = std::int16_t(std::uint16_t(i << (probability_bits - 4)));
  }

  std::uint32_t start(std::uint32_t s) const { return std::uint16_t(m_start[s]); }
  std::uint32_t size(std::uint32_t s) const { return start(s + 1) - start(s); }

  // The symbol whose part has the given place: one less than the number of starts up to there.
  std::uint32_t symbol_at(std::uint32_t place) const
  {
#if defined(__SSE2__)
    const __m128i at = _mm_set1_epi16(std::int16_t(place));
    const __m128i behind = _mm_packs_epi16(_mm_cmpgt_epi16(half(0), at), _mm_cmpgt_epi16(half(1), at));
    return std::uint32_t(trailing_zeros(std::uint32_t(_mm_movemask_epi8(behind)) | 1u << 16)) - 1;
#else
    std::uint32_t s = 0;
    for(std::uint32_t step = symbol_count / 2; step > 0; step /= 2)
      s += start(s + step) <= place ? step : 0;
    return s;
#endif
  }

  void learn(std::uint32_t s)
  {
    const Symbol_starts& target = symbol_targets[s];
    const int shift = m_shift >> 3;
#if defined(__SSE2__) // compilers widen the numbers to 32 bits
    const __m128i count = _mm_cvtsi32_si128(shift);
    for(int i = 0; i < 2; ++i) {
      const __m128i x = half(i);
      const __m128i t = _mm_load_si128(reinterpret_cast<const __m128i*>(target.data()) + i);
      _mm_store_si128(reinterpret_cast<__m128i*>(m_start.data()) + i,
                      _mm_add_epi16(x, _mm_sra_epi16(_mm_sub_epi16(t, x), count)));
    }
#else
    for(int i = 0; i < symbol_count; ++i) {
      std::int16_t& x = m_start[std::size_t(i)];
      x = std::int16_t(x + ((target[std::size_t(i)] - x) >> shift));
    }
#endif
    m_shift += m_shift < last_shift ? 1 : 0;
  }

private:
  static constexpr int last_shift = 7 << 3;

#if defined(__SSE2__)
  __m128i half(int i) const
  {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(m_start.data()) + i);
  }
#endif

  alignas(16) std::array<std::int16_t, symbol_count + 1> m_start; // the last is 2^15, unsigned
  int m_shift = 2 << 3; // in eighths: each of the first shifts is used eight times
};

// Takes the symbols of a section, whose bytes it gives at the end.
class Symbol_encoder
{
public:
  static constexpr bool is_decoder = false;

  std::uint32_t symbol(Symbol_model& model, std::uint32_t s)
  {
    m_parts.push_back({std::uint16_t(model.start(s)), std::uint16_t(model.size(s))});
    model.learn(s);
    return s;
  }

  std::uint32_t bits(int count, std::uint32_t value) // count <= 32, and no higher bits
  {
    m_bits.put(value, count);
    return value;
  }

  // The number of bytes of the symbols, the bytes, those of the plain bits; filled up by zeros to
  // `least` bytes. The encoder is empty then, but for what its models have learned.
  std::string take_bytes(std::size_t least);

private:
  struct Part
  {
    std::uint16_t start, size;
  };

  std::vector<Part> m_parts;
  Bit_writer m_bits;
};

inline std::string Symbol_encoder::take_bytes(std::size_t least)
{
  std::uint32_t x = 1u << 16;
  std::vector<std::uint16_t> words;
  for(std::size_t i = m_parts.size(); i-- > 0;) {
    const Part& part = m_parts[i];
    if((x >> 17) >= part.size) {
      words.push_back(std::uint16_t(x & 0xFFFFu));
      x >>= 16;
    }
    x = ((x / part.size) << probability_bits) + x % part.size + part.start;
  }
  m_parts.clear();
  std::string bytes;
  append_little_endian(bytes, 4 + 2 * words.size(), 4);
  append_little_endian(bytes, x, 4);
  for(std::size_t i = words.size(); i-- > 0;)
    append_little_endian(bytes, words[i], 2);
  bytes += m_bits.take_bytes();
  bytes.resize((std::max)(bytes.size(), least), '\0');
  return bytes;
}

// Gives back the symbols of a section. Behind the end of the bytes it gives anything, and
// `is_sound()` is false then.
class Symbol_decoder
{
public:
  static constexpr bool is_decoder = true;

  // Behind the end there are eight bytes that may be read, too.
  Symbol_decoder(const char* from, std::size_t size)
  {
    if(size < 8)
      return;
    const std::uint64_t symbols = load_little_endian(from, 4);
    if(symbols < 4 || symbols > size - 4 || symbols % 2 != 0)
      return;
    m_state = std::uint32_t(load_little_endian(from + 4, 4));
    m_word = from + 8;
    m_words_end = from + 4 + symbols;
    m_plain = m_words_end;
    m_number_of_bits = 8 * (size - 4 - std::size_t(symbols));
    m_is_open = m_state >= 1u << 16;
  }

  std::uint32_t symbol(Symbol_model& model, std::uint32_t = 0)
  {
    const std::uint32_t place = m_state & ((1u << probability_bits) - 1);
    const std::uint32_t s = model.symbol_at(place);
    const std::uint32_t state
      = model.size(s) * (m_state >> probability_bits) + place - model.start(s);
    // No branch: whether a word is needed nothing foretells
    const std::uint32_t lacks_word = (state >> 16) == 0 ? 1 : 0;
    const char* word = (std::min)(m_word, m_words_end);
    const std::uint32_t bits = static_cast<unsigned char>(word[0])
                             | std::uint32_t(static_cast<unsigned char>(word[1])) << 8;
    m_state = (state << (16 * lacks_word)) | (bits & (0 - lacks_word));
    m_word = word + 2 * lacks_word;
    m_lacks_words |= m_word > m_words_end;
    model.learn(s);
    return s;
  }

  std::uint32_t bits(int count, std::uint32_t = 0)
  {
    const std::uint64_t window = next_bits();
    skip_bits(count);
    return std::uint32_t(window & ((std::uint64_t(1) << count) - 1));
  }

  // The plain bits that come next, 57 at least; and on behind some of them.
  std::uint64_t next_bits() const
  {
    const std::size_t at = (std::min)(m_at, m_number_of_bits);
    return load_64_bits(m_plain + (at >> 3)) >> (at & 7u);
  }
  void skip_bits(int count) { m_at += std::size_t(count); }

  // Whether nothing was read behind the end.
  bool is_sound() const { return m_is_open && !m_lacks_words && m_at <= m_number_of_bits; }

  // Whether, after the last symbol, there is no symbol left.
  bool is_at_end() const { return is_sound() && m_state == 1u << 16 && m_word == m_words_end; }

private:
  std::uint32_t m_state = 1u << 16;
  const char* m_plain = "\0\0\0\0\0\0\0"; // eight bytes
  const char *m_word = m_plain, *m_words_end = m_plain;
  std::size_t m_at = 0, m_number_of_bits = 0;
  bool m_is_open = false, m_lacks_words = false;
};

// --- Numbers as symbols

inline int bit_width(std::uint64_t x)
{
#if defined(__GNUC__)
  return x == 0 ? 0 : 64 - __builtin_clzll(x);
#else
  int result = 0;
  for(; x != 0; x >>= 1)
    ++result;
  return result;
#endif
}

// A number of any size in plain bits: its width, and all but its highest bit.
template <class Coder>
std::uint32_t code_plain(Coder& coder, std::uint32_t x)
{
  const int width = int(coder.bits(6, std::uint32_t(bit_width(x))));
  if(width <= 1 || width > 32)
    return std::uint32_t(width == 1);
  const std::uint32_t top = 1u << (width - 1);
  return top | coder.bits(width - 1, x & (top - 1));
}

// A number that is small most of the time: one symbol up to 11.
template <class Coder>
std::uint32_t code_small(Coder& coder, Symbol_model& model, std::uint32_t x)
{
  const auto symbol_of = [](std::uint32_t y) {
    return y < 12 ? y : y < 64 ? std::uint32_t(bit_width(y)) + 8 : 15;
  };
  const std::uint32_t s = coder.symbol(model, symbol_of(x));
  if(s < 12)
    return s;
  if(s == 15)
    return code_plain(coder, x);
  const int width = int(s) - 8;              // 4, 5, 6
  const std::uint32_t low = s == 12 ? 12u : 1u << (width - 1);
  return low + coder.bits(s == 12 ? 2 : width - 1, x - low);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SYMBOL_CODER_H
