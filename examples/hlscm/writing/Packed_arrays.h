// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PACKED_ARRAYS_H
#define HLSCM_PROGRAM_PACKED_ARRAYS_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hlscm {

/// Returns bytes as text: base64 of RFC 4648.
std::string base64(std::string_view bytes);

/// Arrays of whole numbers for a page, one after the other.
///
/// Each is its length (32 bits, little endian), its number of bytes a number (one byte), and then the
/// lowest bytes of all numbers, the next ones, and so on: bytes of equal worth are alike, which is what
/// the packing needs.
class Packed_arrays
{
public:
  void add(const std::vector<std::uint32_t>& numbers);

  /// The same for numbers with a sign: 0, -1, 1, -2, 2 ... become 0, 1, 2, 3, 4 ...
  void add_signed(const std::vector<std::int32_t>& numbers);

  /// Returns a zlib stream of all arrays as base64.
  std::string text() const;

private:
  std::string m_bytes;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_PACKED_ARRAYS_H
