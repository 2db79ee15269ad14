// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CRC32_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CRC32_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

typedef std::array<std::array<std::uint32_t, 256>, 8> Crc32_tables;

// Table j holds the remainders of a byte followed by j zero bytes; polynomial 0x04C11DB7,
// reflected.
constexpr Crc32_tables make_crc32_tables()
{
  Crc32_tables tables = {};
  for(std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for(int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    tables[0][byte] = crc;
  }
  for(std::size_t j = 1; j < 8; ++j)
    for(std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[j - 1][byte];
      tables[j][byte] = (crc >> 8) ^ tables[0][crc & 255u];
    }
  return tables;
}

inline constexpr Crc32_tables crc32_tables = make_crc32_tables();

// The CRC-32 of zlib and PNG of bytes that follow others with the CRC `before`. Eight bytes a step
// (Kounavis and Berry 2005): a library of headers should not ask its users to link zlib for this.
inline std::uint32_t crc32(const char* data, std::size_t size, std::uint32_t before = 0)
{
  const auto byte = [&data](int i) { return std::uint32_t(static_cast<unsigned char>(data[i])); };
  const Crc32_tables& t = crc32_tables;
  std::uint32_t crc = ~before;
  for(; size >= 8; size -= 8, data += 8) {
    crc ^= byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
    crc = t[7][crc & 255u] ^ t[6][(crc >> 8) & 255u] ^ t[5][(crc >> 16) & 255u] ^ t[4][crc >> 24]
        ^ t[3][byte(4)] ^ t[2][byte(5)] ^ t[1][byte(6)] ^ t[0][byte(7)];
  }
  for(; size > 0; --size, ++data)
    crc = (crc >> 8) ^ t[0][(crc ^ byte(0)) & 255u];
  return ~crc;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CRC32_H
