// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SAMPLE_IMAGE_H
#define CGAL_SURFACE_MESH_TEXTURING_SAMPLE_IMAGE_H

#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <CGAL/assertions.h>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_texturing {

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

#endif // CGAL_SURFACE_MESH_TEXTURING_SAMPLE_IMAGE_H
