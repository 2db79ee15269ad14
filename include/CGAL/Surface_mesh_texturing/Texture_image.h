// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The struct `Texture_image` is an image with any number of channels. Texel (x, y), counted from the
left and from the *top*, covers the texture coordinates \f$ u \f$ from x / width to (x + 1) / width
and \f$ v \f$ from 1 - (y + 1) / height to 1 - y / height: \f$ v \f$ goes up, as in OBJ files.
(glTF counts \f$ v \f$ from the top, so its coordinates are (u, 1 - v) with the same image.)

Invariant: `texels` has `width * height * channels` entries.
*/
struct Texture_image
{
  std::size_t width = 0;     ///< in texels
  std::size_t height = 0;    ///< in texels
  std::size_t channels = 0;  ///< of a texel
  std::vector<float> texels; ///< row by row from the top, the channels of a texel side by side

  /// Returns the channels of a texel.
  float* texel(std::size_t x, std::size_t y) { return texels.data() + (y * width + x) * channels; }
  /// Returns the channels of a texel.
  const float* texel(std::size_t x, std::size_t y) const
  {
    return texels.data() + (y * width + x) * channels;
  }
};

/*!
\ingroup PkgHLSCMTexturing

Sets `value` to the channels of `image` at the finite texture coordinates (u, v): bilinear
interpolation between the centres of texels, the image repeated beyond the unit square.

\pre the image has texels.
*/
inline void sample_bilinear(const Texture_image& image, double u, double v, double* value)
{
  CGAL_precondition(image.width > 0 && image.height > 0);
  const auto place = [](double fraction, std::size_t size, std::size_t& first,
                        std::size_t& second) {
    const double x = (fraction - std::floor(fraction)) * double(size) + double(size) - 0.5;
    const double below = std::floor(x);
    first = std::size_t(below) % size;
    second = (first + 1) % size;
    return x - below;
  };
  std::size_t x[2], y[2];
  const double s = place(u, image.width, x[0], x[1]), t = place(1. - v, image.height, y[0], y[1]);
  for(std::size_t c = 0; c < image.channels; ++c) {
    const double above = (1. - s) * image.texel(x[0], y[0])[c] + s * image.texel(x[1], y[0])[c];
    const double below = (1. - s) * image.texel(x[0], y[1])[c] + s * image.texel(x[1], y[1])[c];
    value[c] = (1. - t) * above + t * below;
  }
}

/*!
\ingroup PkgHLSCMTexturing

Returns the texels as integers: `lowest` becomes 0 and `highest` the largest number of the type,
what lies between is rounded to the nearest, what lies beyond is cut off; all is 0 unless `lowest` is
the smaller one. Linear time.

\tparam Integer `std::uint8_t` or `std::uint16_t`, whose bytes are those of the machine (in PNG
files the higher one comes first).
*/
template <class Integer>
std::vector<Integer> encode_values(const Texture_image& image, double lowest, double highest)
{
  static_assert(std::is_unsigned<Integer>::value && sizeof(Integer) <= 2, "8 or 16 bits");
  const double largest = double((std::numeric_limits<Integer>::max)());
  const double scale = highest > lowest ? largest / (highest - lowest) : 0.;
  std::vector<Integer> result(image.texels.size());
  for(std::size_t i = 0; i < result.size(); ++i) {
    const double value = (double(image.texels[i]) - lowest) * scale;
    result[i] = value > 0. ? Integer((std::min)(value, largest) + 0.5) : Integer(0);
  }
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// Returns the vectors of a normal map as integers: -1 becomes 0, 1 the largest number of the type,
/// as glTF wants it. An angle changes by at most 0.4 degrees with 8 bits, 0.002 with 16.
template <class Integer>
std::vector<Integer> encode_unit_vectors(const Texture_image& image)
{
  return encode_values<Integer>(image, -1., 1.);
}

/// \ingroup PkgHLSCMTexturing
/// Returns what is left of `image` after `encode_values()` with the same arguments; no
/// image if there are not as many values as texels.
template <class Integer>
Texture_image decode_values(const std::vector<Integer>& values, const Texture_image& image,
                            double lowest, double highest)
{
  if(values.size() != image.texels.size())
    return Texture_image();
  const double step = (highest - lowest) / double((std::numeric_limits<Integer>::max)());
  Texture_image result = {image.width, image.height, image.channels, {}};
  result.texels.reserve(values.size());
  for(const Integer value : values)
    result.texels.push_back(float(lowest + step * double(value)));
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
