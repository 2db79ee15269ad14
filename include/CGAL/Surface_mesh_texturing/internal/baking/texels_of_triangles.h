// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_TEXELS_OF_TRIANGLES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_TEXELS_OF_TRIANGLES_H

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
namespace internal {

// What is wrong with an image on a surface.
inline Indexed_mesh::Mesh_outcome image_on_surface_error(const Textured_triangle_mesh& mesh,
                                                         const Texture_image& image)
{
  Indexed_mesh::Mesh_outcome result;
  if(result.fail(atlas_error(mesh, "the surface"))
     || result.fail(image_error(image, "the image")))
    return result;
  if(!std::all_of(image.texels.begin(), image.texels.end(), [](float x) { return std::isfinite(x); }))
    result.fail(Mesh_status::BAD_OPTIONS, Indexed_mesh::not_finite_error("the image", "a value"));
  return result;
}

// Calls `use(t, x, y)` for the texels whose centres lie in triangle t in the texture, and for
// triangles that have none for the texel at their middle. Precondition: no error as above.
template <class Use>
void visit_texels_of_triangles(const Textured_triangle_mesh& mesh, const Texture_image& image,
                               const Use& use)
{
  std::vector<std::uint8_t> has_texel(mesh.triangles.size(), 0);
  const Uv_rasterizer raster(mesh.uv, mesh.wedges, image.width, image.height, image.height);
  for(std::size_t band = 0; band < raster.number_of_bands(); ++band)
    raster.visit(band, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
      has_texel[t] = 1;
      use(t, std::size_t(x), std::size_t(y));
    });
  const auto texel = [](double fraction, std::size_t size) {
    const double inside = fraction - std::floor(fraction);
    return (std::min)(size - 1, std::size_t(inside * double(size)));
  };
  for(std::uint32_t t = 0; t < has_texel.size(); ++t) {
    const auto& w = mesh.wedges[t];
    const auto &a = mesh.uv[w[0]], &b = mesh.uv[w[1]], &c = mesh.uv[w[2]];
    if(has_texel[t] == 0)
      use(t, texel((a.x() + b.x() + c.x()) / 3., image.width),
          texel(1. - (a.y() + b.y() + c.y()) / 3., image.height));
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_TEXELS_OF_TRIANGLES_H
