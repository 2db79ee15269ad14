// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H

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

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_IMAGE_H
