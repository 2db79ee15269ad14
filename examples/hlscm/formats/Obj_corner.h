// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_OBJ_CORNER_H
#define HLSCM_PROGRAM_OBJ_CORNER_H

#include "formats/Text_scanner.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace hlscm {

// What nothing has for an index, so that the check at the end finds it.
constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

// An index of the file, from 1, or from -1 for the last so far, as one from 0.
inline std::uint32_t absolute(long long index, std::size_t so_far)
{
  const long long result = index > 0 ? index - 1 : index + (long long)(so_far);
  return 0 <= result && result < no_index ? std::uint32_t(result) : no_index;
}

/// "7", "7/1", "7//3" or "7/1/3": indices of a vertex, of a texture coordinate and of a normal, all
/// from 1; 0 stands for none.
struct Corner
{
  std::array<long long, 3> indices{};

  /// Whether the text is a corner.
  bool read(std::string_view text)
  {
    const char *p = text.data(), *end = p + text.size();
    for(std::size_t i = 0; i < 3; ++i) {
      const char* begin = p;
      if(!read_index(p, end, indices[i]) || (i == 0 && p == begin)) {
        return false;
      }
      if(p == end) {
        return true;
      }
      ++p; // the slash
    }
    return false;
  }

private:
  // Reads up to a slash or the end; no digits at all are the index 0, but "0" is none.
  static bool read_index(const char*& p, const char* end, long long& index)
  {
    const char* begin = p;
    const bool is_relative = p != end && *p == '-';
    p += p != end && (*p == '-' || *p == '+');
    const char* digits = p;
    for(; p != end && is_digit(*p) && p - digits < 18; ++p) {
      index = 10 * index + (*p - '0');
    }
    const bool is_number = p != digits && index != 0;
    index = is_relative ? -index : index;
    return (is_number || p == begin) && (p == end || *p == '/');
  }
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_OBJ_CORNER_H
