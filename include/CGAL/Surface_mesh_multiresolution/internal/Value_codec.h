// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VALUE_CODEC_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VALUE_CODEC_H

#include <CGAL/Surface_mesh_multiresolution/internal/progressive_mesh_format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Maps the bits of floating point numbers to integers in the order of the numbers, and back, so
// that the difference of two near numbers is small.
inline std::uint32_t ordered(std::uint32_t bits) { return (bits >> 31) != 0 ? ~bits : bits | 1u << 31; }
inline std::uint32_t unordered(std::uint32_t x) { return (x >> 31) != 0 ? x & ~(1u << 31) : ~x; }

// A coordinate as one integer of the width that `File_header::mask()` tells, which is predicted,
// and for float64 a second one, the lower half, which is not.
class Value_codec
{
public:
  struct Code
  {
    std::uint32_t high, low;
  };

  Value_codec() {}
  explicit Value_codec(const File_header& header) : m_format(header.format)
  {
    for(int c = 0; c < 5; ++c) {
      m_origin[c] = header.origin[c];
      m_step[c] = header.step[c < 3 ? 0 : 1];
      m_mask[c] = header.mask(c);
    }
  }

  std::uint32_t mask(int c) const { return m_mask[c]; }
  bool has_low() const { return m_format == Value_format::FLOAT64; }

  Code code_of(double x, int c) const
  {
    if(m_format == Value_format::FLOAT32)
      return {ordered(bit_cast<std::uint32_t>(float(x))), 0};
    if(m_format == Value_format::FLOAT64) {
      const auto bits = bit_cast<std::uint64_t>(x);
      return {ordered(std::uint32_t(bits >> 32)), std::uint32_t(bits)};
    }
    const double q = m_step[c] > 0. ? std::floor((x - m_origin[c]) / m_step[c] + 0.5) : 0.;
    return {std::uint32_t((std::min)((std::max)(q, 0.), double(m_mask[c]))), 0};
  }

  // Not a finite number only if the code is not one of a writer.
  template <Value_format format>
  double value_of(const Code& code, int c) const
  {
    if(format == Value_format::QUANTIZED)
      return m_origin[c] + m_step[c] * code.high;
    if(format == Value_format::FLOAT32)
      return bit_cast<float>(unordered(code.high));
    return bit_cast<double>(std::uint64_t(unordered(code.high)) << 32 | code.low);
  }

private:
  Value_format m_format = Value_format::QUANTIZED;
  std::array<double, 5> m_origin = {}, m_step = {};
  std::array<std::uint32_t, 5> m_mask = {};
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_VALUE_CODEC_H
