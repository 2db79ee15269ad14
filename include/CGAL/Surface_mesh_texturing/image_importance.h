// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H
#define CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/texels_of_triangles.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// What `image_importance()` returns.
struct Image_importance
  : Indexed_mesh::Mesh_outcome
{
  std::vector<float> of_triangles; ///< of each triangle; empty if there is an error
};

/*!
\ingroup PkgHLSCMTexturing

Returns for each triangle the importance that an image on the surface gives it, to be the
`Texture_atlas_options::density`: 1 where the image is 1 (white), 1/16 where it is 0, and linear
between, so that nothing loses all its texels. It is the mean of all channels over the texels whose
centres lie in the triangle in the texture; for triangles that have none, the texel at their middle.

\param mesh the surface, with texture coordinates in the unit square or near it
\param image the image, with values from 0 to 1; what lies beyond is cut off

Errors are those of `image_signal()`. Linear time in the numbers of triangles and of texels.
*/
inline Image_importance image_importance(const Textured_triangle_mesh& mesh,
                                         const Texture_image& image)
{
  constexpr double least = 1. / 16.;
  Image_importance result;
  if(result.fail(internal::image_on_surface_error(mesh, image)))
    return result;
  std::vector<double> sum(mesh.triangles.size(), 0.);
  std::vector<std::size_t> texels(sum.size(), 0);
  internal::visit_texels_of_triangles(
    mesh, image, [&](std::uint32_t t, std::size_t x, std::size_t y) {
      double all = 0.;
      for(std::size_t c = 0; c < image.channels; ++c)
        all += std::clamp(double(image.texel(x, y)[c]), 0., 1.);
      sum[t] += all / double(image.channels);
      ++texels[t];
    });
  for(std::size_t t = 0; t < sum.size(); ++t)
    result.of_triangles.push_back(float(least + (1. - least) * sum[t] / double(texels[t])));
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H
