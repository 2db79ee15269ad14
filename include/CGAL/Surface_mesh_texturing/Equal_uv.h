// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H
#define CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H

#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/Chart_partners.h>
#include <CGAL/Surface_mesh_texturing/internal/Nearest_covered.h>
#include <CGAL/Surface_mesh_texturing/internal/Uv_rasterizer.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Equal_uv` finds, for points of a light model, those of a fine surface with the same
texture coordinates: the two share an atlas, so there is nothing to search.

A chart of the light model may reach beyond that of the fine surface, as a chord does beyond an arc,
even into the next one; there it is the nearest point of its own chart in the texture, exactly the
nearest sample of the image that lies in it. (Charts are triangles that share vertices and texture
coordinates; one of the light model belongs to the fine one in which most of it lies. Own points are
looked for up to 64 samples away, before the nearest one of any chart counts.)

Memory: 6 bytes a sample, 16 bytes a texture coordinate, 8 bytes a triangle. Linear time.

\cgalModels{SurfaceCorrespondence}
*/
class Equal_uv
{
public:
  /// Prepares the search on `fine` from `light` for images with these options. Both must live as
  /// long and lie in \f$ [-1, 2]^2 \f$.
  Equal_uv(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
           const Baking_options& options)
    : m_columns(options.width * options.samples), m_rows(options.height * options.samples)
    , m_raster(fine.uv, fine.wedges, m_columns, m_rows, band_rows)
    , m_triangle(first_triangles(m_raster))
    , m_nearest(m_columns, m_rows, [this](std::size_t i) { return m_triangle[i] != no_triangle; })
    , m_partners(fine, light, [this](double u, double v) { return triangle_at(u, v); })
  {}

  /// Finds the points of the fine surface for the samples of row `y`.
  void find(std::size_t y, std::vector<Baking_sample>& samples) const
  {
    std::vector<std::size_t> nearest; // of a row where there is a sample beside the surface
    for(Baking_sample& sample : samples) {
      std::size_t i = y * m_columns + sample.x;
      sample.is_beside = !is_right(i, sample);
      if(sample.is_beside) {
        if(nearest.empty())
          m_nearest.row(y, nearest);
        i = nearest[sample.x];
        if(i != no_cell && !is_right(i, sample))
          i = nearest_right(y, sample, i);
      }
      if(i != no_cell)
        sample.fine = m_raster.point(m_triangle[i], i % m_columns, i / m_columns);
    }
  }

private:
  static constexpr std::size_t band_rows = 32, no_cell = internal::Nearest_covered::no_cell;
  static constexpr std::int64_t reach = 64;

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

  std::uint32_t triangle_at(double u, double v) const
  {
    const double x = u * double(m_columns), y = (1. - v) * double(m_rows);
    if(!(x >= 0. && y >= 0. && x < double(m_columns) && y < double(m_rows)))
      return no_triangle;
    return m_triangle[std::size_t(y) * m_columns + std::size_t(x)];
  }

  // Whether the fine surface is there, and in the chart of the sample.
  bool is_right(std::size_t i, const Baking_sample& sample) const
  {
    return m_triangle[i] != no_triangle
        && m_partners.match(m_triangle[i], sample.light.triangle);
  }

  // The nearest cell in the chart of the sample, ring by ring; `otherwise` if there is none near.
  std::size_t nearest_right(std::size_t row, const Baking_sample& sample,
                            std::size_t otherwise) const
  {
    const std::int64_t x = sample.x, y = std::int64_t(row);
    std::int64_t least = (reach + 1) * (reach + 1);
    std::size_t result = otherwise;
    for(std::int64_t ring = 1; ring <= reach && ring * ring < least; ++ring)
      for(std::int64_t dy = -ring; dy <= ring; ++dy) {
        if(y + dy < 0 || y + dy >= std::int64_t(m_rows))
          continue;
        const std::int64_t step = std::abs(dy) == ring ? 1 : 2 * ring;
        for(std::int64_t dx = -ring; dx <= ring; dx += step) {
          const std::int64_t squared_distance = dx * dx + dy * dy;
          if(x + dx < 0 || x + dx >= std::int64_t(m_columns) || squared_distance >= least)
            continue;
          const std::size_t i = std::size_t(y + dy) * m_columns + std::size_t(x + dx);
          if(is_right(i, sample)) {
            least = squared_distance;
            result = i;
          }
        }
      }
    return result;
  }

  std::size_t m_columns, m_rows;
  internal::Uv_rasterizer m_raster;
  std::vector<std::uint32_t> m_triangle; // of each sample
  internal::Nearest_covered m_nearest;
  internal::Chart_partners m_partners;
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H
