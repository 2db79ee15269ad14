// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_ENCODE_IMAGE_H
#define CGAL_SURFACE_MESH_TEXTURING_ENCODE_IMAGE_H

#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

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

#endif // CGAL_SURFACE_MESH_TEXTURING_ENCODE_IMAGE_H
