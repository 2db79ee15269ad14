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
  constexpr std::array<std::uint8_t, 3> light = {250, 247, 242}, dark = {56, 102, 158};
  std::vector<std::uint8_t> rows[2], rgb; // two kinds of rows
  for(std::size_t kind = 0; kind < 2; ++kind)
    for(std::size_t x = 0; x < width; ++x) {
      const auto& colour = (x * squares / width + kind) % 2 == 1 ? dark : light;
      rows[kind].insert(rows[kind].end(), colour.begin(), colour.end());
    }
  for(std::size_t y = 0; y < height; ++y) {
    const std::vector<std::uint8_t>& row = rows[y * squares / width % 2];
    rgb.insert(rgb.end(), row.begin(), row.end());
  }
  return encode_png(rgb, width);
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_CHECKERBOARD_H
