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

#include <memory>

namespace hlscm {

CGAL::Surface_mesh_texturing::Texture_image read_image(const std::string& file_name)
{
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
