// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Image_reading.h"

#include "common/Program_error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ONLY_TGA
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include <png.h>

namespace hlscm {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// What libpng found wrong, as long as its functions can jump.
struct Png_failure
{
  std::jmp_buf back;
  char reason[200] = "";
};

[[noreturn]] void fail_png(png_structp png, png_const_charp reason)
{
  Png_failure& failure = *static_cast<Png_failure*>(png_get_error_ptr(png));
  std::strncpy(failure.reason, reason, sizeof failure.reason - 1);
  std::longjmp(failure.back, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// Reads all chunks and rows; here nothing has a destructor, since errors jump over it. `row` is
// freed by the caller.
void read_png(std::FILE* file, png_structp png, png_infop info, std::vector<png_byte>& row)
{
  png_init_io(png, file);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(png, info);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  row.resize(png_get_rowbytes(png, info));
  const png_uint_32 height = png_get_image_height(png, info);
  for(int pass = 0; pass < passes; ++pass) {
    for(png_uint_32 y = 0; y < height; ++y) {
      png_read_row(png, row.data(), nullptr);
    }
  }
  png_read_end(png, info);
}

/// The decoder of pictures does not look at the check sums of a PNG file: throws `Program_error` if
/// one of them is wrong.
void check_png(const std::string& file_name)
{
  const File file(std::fopen(file_name.c_str(), "rb"), std::fclose);
  png_byte signature[8] = {};
  if(!file || std::fread(signature, 1, sizeof signature, file.get()) != sizeof signature
     || png_sig_cmp(signature, 0, sizeof signature) != 0)
  {
    return; // no PNG file
  }
  std::rewind(file.get());
  Png_failure failure;
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail_png, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if(info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    throw std::bad_alloc();
  }
  std::vector<png_byte> row;
  if(setjmp(failure.back) == 0) {
    read_png(file.get(), png, info, row);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if(failure.reason[0] != '\0') {
    throw Program_error(file_name, std::string("the picture is damaged (") + failure.reason
                                       + "), copy or export it again");
  }
}

} // namespace

CGAL::Surface_mesh_texturing::Texture_image read_image(const std::string& file_name)
{
  check_png(file_name);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_us, void (*)(void*)> samples(
      stbi_load_16(file_name.c_str(), &width, &height, &channels, 3), stbi_image_free);
  if(!samples) {
    throw Program_error(file_name, std::string("cannot be read as a picture (")
                                       + stbi_failure_reason()
                                       + "), give a .png, .jpg, .bmp or .tga file");
  }
  CGAL::Surface_mesh_texturing::Texture_image image;
  image.width = std::size_t(width);
  image.height = std::size_t(height);
  image.channels = 3;
  image.texels.resize(3 * image.width * image.height);
  for(std::size_t i = 0; i < image.texels.size(); ++i) {
    image.texels[i] = float(samples.get()[i]) / 65535.f;
  }
  return image;
}

} // namespace hlscm
