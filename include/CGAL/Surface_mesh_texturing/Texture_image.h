// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H

#include <CGAL/assertions.h>

#include <cmath>
#include <cstddef>
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

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
