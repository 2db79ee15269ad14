// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RESIDUAL_CODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RESIDUAL_CODER_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Symbol_coder.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What a residual is one of: each kind has its own probabilities.
enum class Residual_kind : std::uint8_t
{
  UV, BASIS, NORMAL, TANGENT,  // of wedges inside; see Split_coder.h
  BORDER_UV, BORDER_POINT,
  PARENT,
  EXACT_X, EXACT_Y, EXACT_Z, EXACT_U, EXACT_V // of files without loss
};

// Signed numbers near 0, whose size can be foretold in part.
//
// The caller says how far apart the things are from which a number was predicted, in steps of a
// factor. For each of these steps the mean of the numbers so far is kept; the symbol tells how
// large the next one is beside it, in half octaves, and the bits below are plain. So few
// probabilities have to be learned: what small and large residuals have in common is learned once.
class Residual_coder
{
public:
  static constexpr int number_of_spreads = 72;

  Residual_coder()
  {
    for(auto& of_kind : m_scales)
      for(int spread = 0; spread < number_of_spreads; ++spread)
        of_kind[std::size_t(spread)].mean = 1 << (std::min)(spread / 2, 24);
  }

  // `residual` is a number in two's complement; see Symbol_coder.h for what a coder is.
  template <class Coder>
  std::uint32_t code(Coder& coder, Residual_kind kind, int spread, std::uint32_t residual);

private:
  static constexpr int number_of_kinds = int(Residual_kind::EXACT_V) + 1;
  static constexpr std::uint32_t escape = 15;

  struct Scale
  {
    std::int32_t mean;      // of the sizes, in 16ths
    std::int32_t shift = 1; // the next number moves the mean by 2^-shift of the way
  };

  // y < 4 are symbols of their own, then there are two an octave.
  static std::uint32_t symbol_of(std::uint32_t y)
  {
    if(y < 4)
      return y;
    const int width = bit_width(y);
    const std::uint32_t symbol = std::uint32_t(2 * width - 2) + ((y >> (width - 2)) & 1u);
    return (std::min)(symbol, escape);
  }

  // The least number of each symbol, and the bits that the symbol does not tell.
  struct Symbol_range
  {
    std::uint8_t begin, below;
  };
  static constexpr std::array<Symbol_range, escape> ranges
    = {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 1}, {6, 1}, {8, 2}, {12, 2}, {16, 3}, {24, 3}, {32, 4},
        {48, 4}, {64, 5}, {96, 5}, {128, 6}}};

  // The size of a number, and its sign unless it is 0.
  template <class Coder>
  static std::uint32_t code_size(Coder& coder, Symbol_model& model, int shift, std::uint32_t size,
                                 std::uint32_t& sign);

  std::array<std::array<Scale, number_of_spreads>, number_of_kinds> m_scales;
  std::array<std::array<Symbol_model, 32>, number_of_kinds> m_models;
};

template <class Coder>
std::uint32_t Residual_coder::code_size(Coder& coder, Symbol_model& model, int shift,
                                        std::uint32_t size, std::uint32_t& sign)
{
  const std::uint32_t s = coder.symbol(model, symbol_of(size >> shift));
  if(s == escape) {
    size = code_plain(coder, size);
    sign = size == 0 ? 0 : coder.bits(1, sign);
    return size;
  }
  const std::uint32_t begin = std::uint32_t(ranges[s].begin) << shift;
  const int below = ranges[s].below + shift; // at most 28, as means have 29 bits at most
  if constexpr(Coder::is_decoder) { // all bits at a time, without branches
    const std::uint64_t bits = coder.next_bits();
    size = begin + (std::uint32_t(bits) & ((1u << below) - 1));
    sign = std::uint32_t(bits >> below) & std::uint32_t(size != 0);
    coder.skip_bits(below + (size != 0 ? 1 : 0));
  } else {
    coder.bits(below, size - begin);
    coder.bits(size == 0 ? 0 : 1, sign);
  }
  return size;
}

template <class Coder>
std::uint32_t Residual_coder::code(Coder& coder, Residual_kind kind, int spread,
                                   std::uint32_t residual)
{
  constexpr std::int32_t longest = 1 << 24;
  Scale& scale = m_scales[std::size_t(kind)][std::size_t((std::min)(spread, number_of_spreads - 1))];
  // The mean to a quarter of an octave, less the octaves that are plain
  const int width = bit_width(std::uint32_t(scale.mean)), shift = (std::max)(width - 7, 0);
  const int quarter = width < 3 ? 0 : (scale.mean >> (width - 3)) & 3;
  Symbol_model& model = m_models[std::size_t(kind)][std::size_t(4 * (width - shift) + quarter)];
  std::uint32_t sign = residual >> 31;
  const std::uint32_t size = code_size(coder, model, shift, (residual ^ (0 - sign)) + sign, sign);
  const auto bounded = std::int32_t((std::min)(size, std::uint32_t(longest)));
  scale.mean += (16 * bounded - scale.mean) >> scale.shift;
  scale.shift += scale.shift < 5 ? 1 : 0;
  return (size ^ (0 - sign)) + sign;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_RESIDUAL_CODER_H
