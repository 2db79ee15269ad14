// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Png_file.h"

#include <csetjmp>
#include <stdexcept>

#include <png.h>

namespace hlscm {

namespace {

// Pictures and normal maps of scans hardly shrink any more beyond this level, it only takes longer.
constexpr int compression_level = 4;

void append(png_structp png, png_bytep data, std::size_t size)
{
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

void flush(png_structp) {}

// Nothing here may need a destructor: errors of libpng jump out.
bool write(png_structp png, png_infop info, const unsigned char* samples, std::size_t width,
           std::size_t height, std::size_t channels, int bits)
{
  if(setjmp(png_jmpbuf(png))) {
    return false;
  }
  png_set_compression_level(png, compression_level);
  png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), bits,
               channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if(bits == 16) {
    png_set_swap(png); // from little-endian machines
  }
  const std::size_t row = width * channels * std::size_t(bits) / 8;
  for(std::size_t y = 0; y < height; ++y) {
    png_write_row(png, samples + y * row);
  }
  png_write_end(png, info);
  return true;
}

template <typename Sample>
std::string encode(const std::vector<Sample>& samples, std::size_t width, std::size_t channels)
{
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool is_good = info != nullptr;
  if(is_good) {
    png_set_write_fn(png, &bytes, append, flush);
    is_good = write(png, info, reinterpret_cast<const unsigned char*>(samples.data()), width,
                    samples.size() / (channels * width), channels, int(8 * sizeof(Sample)));
  }
  png_destroy_write_struct(&png, &info);
  if(!is_good) {
    throw std::runtime_error("the PNG file could not be composed");
  }
  return bytes;
}

} // namespace

std::string encode_png(const std::vector<std::uint8_t>& samples, std::size_t width,
                       std::size_t channels)
{
  return encode(samples, width, channels);
}

std::string encode_png(const std::vector<std::uint16_t>& samples, std::size_t width,
                       std::size_t channels)
{
  return encode(samples, width, channels);
}

} // namespace hlscm
