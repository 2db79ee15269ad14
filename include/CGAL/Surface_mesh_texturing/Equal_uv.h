// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H
#define CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H

#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/Nearest_covered.h>
#include <CGAL/Surface_mesh_texturing/internal/Uv_rasterizer.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Equal_uv` finds, for points of a light model, those of a fine surface with the same
texture coordinates: the two share an atlas, so there is nothing to search. A chart of the light
model may reach beyond that of the fine surface, as a chord does beyond an arc; there it is the
nearest point in the texture, exactly the nearest sample of the image that lies on the surface.

Memory: 8 bytes a sample, 8 bytes a texture coordinate, 4 bytes a triangle. Linear time.

\cgalModels{SurfaceCorrespondence}
*/
class Equal_uv
{
public:
  /// Prepares the search on `fine`, which must live as long and lie in \f$ [-1, 2]^2 \f$, for images
  /// with these options.
  Equal_uv(const Textured_triangle_mesh& fine, const Baking_options& options)
    : m_columns(options.width * options.samples)
    , m_raster(fine.uv, fine.wedges, m_columns, options.height * options.samples, band_rows)
    , m_triangle(first_triangles(m_raster))
    , m_nearest(m_columns, m_raster.rows(),
                [this](std::size_t i) { return m_triangle[i] != no_triangle; })
  {}

  /// Finds the points of the fine surface for the samples of row `y`.
  void find(std::size_t y, std::vector<Baking_sample>& samples) const
  {
    std::vector<std::size_t> nearest; // of a row where there is a sample beside the surface
    for(Baking_sample& sample : samples) {
      std::size_t i = y * m_columns + sample.x;
      sample.is_beside = m_triangle[i] == no_triangle;
      if(sample.is_beside) {
        if(nearest.empty())
          m_nearest.row(y, nearest);
        i = nearest[sample.x];
      }
      if(i != internal::Nearest_covered::no_cell)
        sample.fine = m_raster.point(m_triangle[i], i % m_columns, i / m_columns);
    }
  }

private:
  static constexpr std::size_t band_rows = 32;

  static std::vector<std::uint32_t> first_triangles(const internal::Uv_rasterizer& raster)
  {
    std::vector<std::uint32_t> result(raster.columns() * raster.rows());
    Blocked_execution::blocked_for(raster.number_of_bands(), 1,
                                   [&](std::size_t band, std::size_t) {
                                     raster.first_triangles(
                                       band, &result[raster.begin_row(band) * raster.columns()]);
                                   });
    return result;
  }

  std::size_t m_columns;
  internal::Uv_rasterizer m_raster;
  std::vector<std::uint32_t> m_triangle; // of each sample
  internal::Nearest_covered m_nearest;
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H
