// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CHECKERBOARD_H
#define HLSCM_PROGRAM_CHECKERBOARD_H

#include "writing/Png_file.h"

#include <array>

namespace hlscm {

/// Returns a PNG file of `width` x `height` pixels: a checkerboard with so many squares in a row.
inline std::string checkerboard_png(std::size_t width, std::size_t height, std::size_t squares)
{
  std::vector<std::uint8_t> rgb;
  for(std::size_t y = 0; y < height; ++y) {
    for(std::size_t x = 0; x < width; ++x) {
      const bool is_dark = (x * squares / width + y * squares / width) % 2 == 1;
      for(const int value : is_dark ? std::array<int, 3>{56, 102, 158}
                                    : std::array<int, 3>{250, 247, 242}) {
        rgb.push_back(std::uint8_t(value));
      }
    }
  }
  return encode_png(rgb, width);
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_CHECKERBOARD_H
