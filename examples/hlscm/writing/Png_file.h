// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PNG_FILE_H
#define HLSCM_PROGRAM_PNG_FILE_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hlscm {

/// Returns a PNG file of an image with one (grey) or three channels, row by row from the top.
std::string encode_png(const std::vector<std::uint8_t>& samples, std::size_t width,
                       std::size_t channels = 3);

/// The same with 16 bits a channel.
std::string encode_png(const std::vector<std::uint16_t>& samples, std::size_t width,
                       std::size_t channels = 3);

} // namespace hlscm

#endif // HLSCM_PROGRAM_PNG_FILE_H
