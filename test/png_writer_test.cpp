// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures are what stb_image reads.

#include <support/written_meshes.h>

#ifndef HLSCM_WITHOUT_PNG
#include <CGAL/Surface_mesh_texturing/IO/PNG.h>
#endif

#ifdef HLSCM_WITH_STB
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop
#endif

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace png_writer_test {

using namespace written_meshes;

// ---------------------------------------------------------------------------------------------
// Pictures

#if !defined(HLSCM_WITHOUT_PNG) && defined(HLSCM_WITH_STB)

SMT::Texture_image ramp(std::size_t channels)
{
  SMT::Texture_image image = {7, 5, channels, {}};
  for(std::size_t i = 0; i < 35 * channels; ++i)
    image.texels.push_back(float(i) / float(35 * channels - 1));
  return image;
}

std::string png_of(const SMT::Texture_image& image, const SMT::PNG_options& options)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_PNG(os, image, options));
  return os.str();
}

// Calls `check` with the samples that stb_image reads.
template <class Sample>
void expect_samples(const std::string& png, const SMT::Texture_image& image,
                    const std::vector<Sample>& expected)
{
  const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
  int width = 0, height = 0, channels = 0;
  void* read = nullptr;
  if(sizeof(Sample) == 2)
    read = stbi_load_16_from_memory(bytes, int(png.size()), &width, &height, &channels, 0);
  else
    read = stbi_load_from_memory(bytes, int(png.size()), &width, &height, &channels, 0);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(stbi_is_16_bit_from_memory(bytes, int(png.size())), int(sizeof(Sample) == 2));
  ASSERT_EQ(std::size_t(width), image.width);
  ASSERT_EQ(std::size_t(height), image.height);
  ASSERT_EQ(std::size_t(channels), image.channels);
  std::vector<Sample> samples(expected.size());
  std::memcpy(samples.data(), read, samples.size() * sizeof(Sample));
  stbi_image_free(read);
  EXPECT_EQ(samples, expected);
}

TEST(Writers, png_holds_8_and_16_bits_of_all_channels)
{
  for(std::size_t channels = 1; channels <= 4; ++channels) {
    const SMT::Texture_image image = ramp(channels);
    SMT::PNG_options options;
    expect_samples(png_of(image, options), image, SMT::encode_values<std::uint8_t>(image, 0., 1.));
    options.bits = 16;
    expect_samples(png_of(image, options), image, SMT::encode_values<std::uint16_t>(image, 0., 1.));
    options.lowest = -1.; // as for a normal map
    expect_samples(png_of(image, options), image,
                   SMT::encode_unit_vectors<std::uint16_t>(image));
  }
}

TEST(Writers, png_compresses_as_told_without_loss)
{
  const std::vector<std::uint8_t> samples(3 * 64 * 64, 77);
  const std::string stored = SMT::IO::encode_PNG(samples, 64, 3, 0);
  const std::string packed = SMT::IO::encode_PNG(samples, 64, 3, 9);
  EXPECT_GT(stored.size(), samples.size());
  EXPECT_LT(packed.size(), samples.size() / 20);
  const SMT::Texture_image image = {64, 64, 3, {}};
  expect_samples(stored, image, samples);
  expect_samples(packed, image, samples);
}

TEST(Writers, png_refuses_bad_images)
{
  SMT::PNG_options bits, range, compression;
  bits.bits = 12;
  range.lowest = 2.;
  compression.compression = 10;
  const SMT::Texture_image good = ramp(3);
  SMT::Texture_image cut = good;
  cut.texels.pop_back();
  std::ostringstream os;
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, bits));
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, range));
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, compression));
  EXPECT_FALSE(SMT::IO::write_PNG(os, cut));
  EXPECT_FALSE(SMT::IO::write_PNG(os, SMT::Texture_image()));
  EXPECT_FALSE(SMT::IO::write_PNG(os, ramp(5)));
  EXPECT_EQ(os.str(), "");
  EXPECT_EQ(SMT::IO::encode_PNG(std::vector<std::uint8_t>(10), 3, 3), "");
  EXPECT_EQ(SMT::IO::encode_PNG(std::vector<std::uint8_t>(), 3, 3), "");
}

#endif

} // namespace png_writer_test
