// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_BASE_SECTION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_BASE_SECTION_H

#include <CGAL/Indexed_mesh/mesh_indices.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Code_column.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/progressive_mesh_format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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

// The ends of batches, which ascend to the number of splits; nothing if they are not sound.
inline std::optional<std::vector<std::size_t>>
read_batch_ends(const File_header& header, const char*& from, const char* end)
{
  if(end - from < 4)
    return std::nullopt;
  const std::size_t count = std::size_t(load_little_endian(from, 4));
  from += 4;
  Column_reader ends(from, end, count);
  if(!ends.is_sound())
    return std::nullopt;
  std::vector<std::size_t> result;
  std::size_t last = 0;
  for(std::size_t i = 0; i < count; ++i) {
    last += ends.next<Column_code::EXP_GOLOMB>();
    if(last > header.number_of_splits())
      return std::nullopt;
    result.push_back(last);
  }
  if(!ends.is_sound() || (count > 0 && last != header.number_of_splits()))
    return std::nullopt;
  return result;
}

// The triangles of the base, by its wedges; nothing if they are not sound. Each wedge has a
// triangle: there is no memory for more than there can be.
inline std::optional<std::vector<Triangle_indices>>
read_triangles(const File_header& header, const char*& from, const char* end)
{
  Column_reader corners(from, end, 3 * std::size_t(header.base.triangles));
  if(!corners.is_sound())
    return std::nullopt;
  std::vector<Triangle_indices> triangles(header.base.triangles);
  Triangle_indices last = {0, 0, 0};
  for(Triangle_indices& t : triangles) {
    for(int c = 0; c < 3; ++c) {
      t[c] = last[c] + unzigzag(corners.next<Column_code::EXP_GOLOMB>());
      if(t[c] >= header.base.wedges)
        return std::nullopt;
    }
    last = t;
  }
  if(!corners.is_sound() || header.base.wedges > 3 * std::size_t(header.base.triangles))
    return std::nullopt;
  return triangles;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_BASE_SECTION_H
