// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H
#define CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Uv_rasterizer.h>

#include <algorithm>
#include <cmath>
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
  if(result.fail(internal::atlas_error(mesh, "the surface"))
     || result.fail(internal::image_error(image, "the image")))
    return result;
  if(!std::all_of(image.texels.begin(), image.texels.end(), [](float x) { return std::isfinite(x); })
     && result.fail(Mesh_status::BAD_OPTIONS, "the image has a value that is not a finite number"))
    return result;
  std::vector<double> sum(mesh.triangles.size(), 0.);
  std::vector<std::size_t> texels(sum.size(), 0);
  const auto add = [&](std::uint32_t t, std::size_t x, std::size_t y) {
    double all = 0.;
    for(std::size_t c = 0; c < image.channels; ++c)
      all += std::clamp(double(image.texel(x, y)[c]), 0., 1.);
    sum[t] += all / double(image.channels);
    ++texels[t];
  };
  const internal::Uv_rasterizer raster(mesh.uv, mesh.wedges, image.width, image.height, image.height);
  for(std::size_t band = 0; band < raster.number_of_bands(); ++band)
    raster.visit(band, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
      add(t, std::size_t(x), std::size_t(y));
    });
  const auto texel = [](double fraction, std::size_t size) {
    const double inside = fraction - std::floor(fraction);
    return (std::min)(size - 1, std::size_t(inside * double(size)));
  };
  for(std::uint32_t t = 0; t < sum.size(); ++t) {
    const Triangle_indices& w = mesh.wedges[t];
    const auto &a = mesh.uv[w[0]], &b = mesh.uv[w[1]], &c = mesh.uv[w[2]];
    if(texels[t] == 0)
      add(t, texel((a.x() + b.x() + c.x()) / 3., image.width),
          texel(1. - (a.y() + b.y() + c.y()) / 3., image.height));
    result.of_triangles.push_back(float(least + (1. - least) * sum[t] / double(texels[t])));
  }
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IMAGE_IMPORTANCE_H
