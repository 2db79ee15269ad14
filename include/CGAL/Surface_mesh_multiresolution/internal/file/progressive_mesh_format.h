// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_FORMAT_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_FORMAT_H

#include <CGAL/Surface_mesh_multiresolution/is_measurable.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Code_column.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

// The layout of a file, all numbers in little endian:
//   header     104 bytes: see `File_header`
//   sections   the base, then the splits, coarse to fine, up to 4097 a section
// A section is the number of its splits (4 bytes, 0 for the base), that of its bytes (4), their
// CRC-32 (4), and the bytes: columns of numbers, see Code_column.h. The CRC is that of the two
// numbers and the bytes, continued from the section before, so that a section that is lost is
// noticed. Each section leads from one whole mesh to another: it never cuts the pair of splits of
// one vertex.
//   base       ends of batches (differences), corners of triangles (differences to the triangle
//              before), pairs, values
//   splits     symbols and plain bits, see Symbol_coder.h: the parents of all splits of the section,
//              then of each the corners that it takes and the values, see Split_coder.h
// Pairs: whether a wedge shares its vertex with the one before. Values: residuals of x, y, z of each
// vertex and u, v of each wedge; for float64 five columns or numbers more with the lower halves.
// Version 3 has a texture, version 4 has none: u and v are left out, and no wedge shares its vertex
// with another.
//
// Versions 1, with texture, and 2 are read as well. Their splits are columns:
//   splits     pairs, kinds, ranges and deltas of parents, corners skipped, corners moved, values
// Kinds: of splits of border wedges.

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

// PNG's idea: bytes that no text has, and that a transfer as text changes.
constexpr std::array<unsigned char, 8> file_magic = {0x89, 'P', 'M', 'S', '\r', '\n', 0x1A, '\n'};

constexpr std::uint32_t oldest_version = 1, latest_version = 4;

// Odd versions have a texture.
constexpr bool has_texture_in(std::uint32_t version) { return version % 2 == 1; }
// The later two have symbols where the first have columns.
constexpr bool has_symbols_in(std::uint32_t version) { return version >= 3; }

constexpr std::size_t file_header_size = 104;
constexpr std::size_t section_header_size = 12;
constexpr std::uint32_t splits_per_section = 4096;

// The splits of the section that begins with so many wedges: a half more, so that the first picture
// does not wait for much.
constexpr std::uint32_t splits_of_section(std::uint32_t wedges)
{
  const std::uint32_t half = wedges / 2;
  return half < 256 ? 256 : half < splits_per_section ? half : splits_per_section;
}

// Sections of splits are not larger: 16 numbers of at most 52 bits a split, one of them 57, and the
// heads of the columns; symbols and plain bits are fewer.
constexpr std::uint64_t max_section_bytes(std::uint32_t splits)
{
  return 108 * std::uint64_t(splits) + 128;
}

// Nor are they smaller, if they have symbols: few bytes should not cost much memory.
constexpr std::uint64_t min_section_bytes(std::uint32_t splits) { return splits / 8; }

enum class Value_format : std::uint8_t { QUANTIZED, FLOAT32, FLOAT64 };

struct File_counts
{
  std::uint32_t wedges, vertices, triangles;
};

struct File_header
{
  bool has_texture = true;
  bool has_symbols = true; // or columns
  Value_format format = Value_format::QUANTIZED;
  int position_bits = 0, uv_bits = 0;  // if quantized
  File_counts fine = {}, base = {};
  std::array<double, 5> origin = {};   // the least x, y, z, u, v, and
  std::array<double, 2> step = {};     // the steps of positions and uv, if quantized

  std::uint32_t number_of_splits() const { return fine.wedges - base.wedges; }
  int number_of_values() const { return has_texture ? 5 : 3; } // of a wedge
  bool is_quantized() const { return format == Value_format::QUANTIZED; }
  int bits(int c) const { return c < 3 ? position_bits : uv_bits; }

  // The bits that a value has.
  std::uint32_t mask(int c) const
  {
    return is_quantized() ? std::uint32_t((std::uint64_t(1) << bits(c)) - 1) : std::uint32_t(-1);
  }
};

// The same bits as a value of another type.
template <class To, class From>
To bit_cast(const From& from)
{
  static_assert(sizeof(To) == sizeof(From), "types of one size");
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

inline std::string bytes_of(const File_header& header)
{
  std::string bytes(file_magic.begin(), file_magic.end());
  append_little_endian(bytes, (header.has_symbols ? 3 : 1) + (header.has_texture ? 0 : 1), 2);
  append_little_endian(bytes, std::uint64_t(header.format), 2);
  append_little_endian(bytes, std::uint64_t(header.position_bits), 2);
  append_little_endian(bytes, std::uint64_t(header.uv_bits), 2);
  for(const File_counts& counts : {header.fine, header.base})
    for(const std::uint32_t count : {counts.wedges, counts.vertices, counts.triangles})
      append_little_endian(bytes, count, 4);
  for(const double x : header.origin)
    append_little_endian(bytes, bit_cast<std::uint64_t>(x), 8);
  for(const double x : header.step)
    append_little_endian(bytes, bit_cast<std::uint64_t>(x), 8);
  append_little_endian(bytes, 0, 4); // for later versions
  append_little_endian(bytes, crc32(bytes.data(), bytes.size()), 4);
  return bytes;
}

// Whether the numbers can be those of a mesh.
inline bool is_sound(const File_header& h)
{
  const std::uint64_t splits = std::uint64_t(h.fine.wedges) - h.base.wedges;
  if(h.base.wedges < 3 || h.base.wedges > h.fine.wedges || h.fine.wedges >= (1u << 30)
     || h.base.vertices > h.base.wedges || h.fine.vertices > h.fine.wedges
     || h.base.vertices > h.fine.vertices || h.base.triangles < 1
     || h.fine.triangles < h.base.triangles + splits
     || h.fine.triangles > h.base.triangles + 2 * splits || h.fine.triangles >= (1u << 29))
    return false;
  if(!h.has_texture && (h.base.vertices != h.base.wedges || h.fine.vertices != h.fine.wedges))
    return false;
  if(!h.is_quantized())
    return true;
  for(int c = 0; c < 5; ++c) {
    if(h.bits(c) < 1 || h.bits(c) > 30)
      return false;
    const double step = h.step[c < 3 ? 0 : 1];
    const double end = h.origin[c] + step * h.mask(c);
    if(!(step >= 0.) || !std::isfinite(h.origin[c]) || !std::isfinite(end))
      return false;
    if(h.has_texture && !(is_measurable(h.origin[c]) && is_measurable(end)))
      return false;
  }
  return true;
}

// The header in bytes with the right magic and version and CRC; `is_sound()` fails if it is none.
inline File_header header_of(const char* bytes)
{
  const auto number = [bytes](std::size_t at, int size) {
    return load_little_endian(bytes + at, size);
  };
  File_header h;
  if(number(10, 2) > std::uint64_t(Value_format::FLOAT64) || number(96, 4) != 0)
    return h;
  const auto version = std::uint32_t(number(8, 2));
  h.has_texture = has_texture_in(version);
  h.has_symbols = has_symbols_in(version);
  h.format = Value_format(number(10, 2));
  h.position_bits = int(number(12, 2));
  h.uv_bits = int(number(14, 2));
  std::size_t at = 16;
  for(File_counts* counts : {&h.fine, &h.base})
    for(std::uint32_t* count : {&counts->wedges, &counts->vertices, &counts->triangles}) {
      *count = std::uint32_t(number(at, 4));
      at += 4;
    }
  for(double& x : h.origin) {
    x = bit_cast<double>(number(at, 8));
    at += 8;
  }
  for(double& x : h.step) {
    x = bit_cast<double>(number(at, 8));
    at += 8;
  }
  return h;
}

// The CRC of a section of this many splits whose bytes are given.
inline std::uint32_t section_crc(std::uint32_t splits, const char* bytes, std::size_t size,
                                 std::uint32_t before)
{
  std::string numbers;
  append_little_endian(numbers, splits, 4);
  append_little_endian(numbers, size, 4);
  return crc32(bytes, size, crc32(numbers.data(), numbers.size(), before));
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_FORMAT_H
