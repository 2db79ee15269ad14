// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_STL_KIND_H
#define HLSCM_PROGRAM_STL_KIND_H

#include "formats/Text_scanner.h"
#include "formats/byte_order.h"

#include <cctype>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace hlscm {
namespace stl {

constexpr std::size_t header_size = 84;   // 80 bytes of comment, then the number of triangles
constexpr std::size_t triangle_size = 50; // normal, three points (floats), two bytes

/// Whether a word of a text file is a keyword, given in small letters.
inline bool is_keyword(std::string_view word, std::string_view keyword)
{
  return word.size() == keyword.size()
         && std::equal(word.begin(), word.end(), keyword.begin(), [](char a, char b) {
              return std::tolower(static_cast<unsigned char>(a)) == b;
            });
}

/// The size of a binary file with so many triangles as it says; 0 if it is too short to say it.
inline std::size_t binary_size(const char* begin, const char* end)
{
  const bool has_header = std::size_t(end - begin) >= header_size;
  return has_header ? header_size + triangle_size * little_endian<std::uint32_t>(begin + 80) : 0;
}

/// Whether it is a text file. Binary ones may begin with "solid" too, but hold zero bytes.
inline bool is_text(const char* begin, const char* end)
{
  const std::size_t size = std::size_t(end - begin), size_if_binary = binary_size(begin, end);
  Text_scanner scanner(begin, end);
  if(size == size_if_binary || !scanner.next_content_line('\0')
     || !is_keyword(scanner.word(), "solid"))
  {
    return false;
  }
  return size < size_if_binary || std::memchr(begin, '\0', size) == nullptr;
}

} // namespace stl
} // namespace hlscm

#endif // HLSCM_PROGRAM_STL_KIND_H
