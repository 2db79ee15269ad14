// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CHECKERBOARD_H
#define HLSCM_PROGRAM_CHECKERBOARD_H

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace hlscm {

/// Returns a PNG file of `width` x `height` pixels, of a palette: a checkerboard with so many squares in
/// a row.
inline std::string checkerboard_png(std::size_t width, std::size_t height, std::size_t squares)
{
  constexpr std::uint8_t colours[] = {250, 247, 242, 56, 102, 158}; // light and dark
  std::vector<std::uint8_t> pixels(width * height);
  for(std::size_t y = 0; y < height; ++y)
    for(std::size_t x = 0; x < width; ++x)
      pixels[y * width + x] = (x * squares / width + y * squares / width) % 2;
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = png_uint_32(width);
  image.height = png_uint_32(height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = 2;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if(!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, colours)) {
    throw std::runtime_error("the PNG file could not be composed");
  }
  bytes.resize(size);
  return bytes;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_CHECKERBOARD_H
