// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Png_file.h"

#include <CGAL/Surface_mesh_texturing/IO/PNG.h>

#include <stdexcept>

namespace hlscm {

namespace {

template <typename Sample>
std::string encode(const std::vector<Sample>& samples, std::size_t width, std::size_t channels)
{
  std::string bytes = CGAL::Surface_mesh_texturing::IO::encode_PNG(samples, width, channels);
  if(bytes.empty()) {
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
