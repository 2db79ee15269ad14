// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H
#define CGAL_SURFACE_MESH_TEXTURING_EQUAL_UV_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Uv_rasterizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The chart of each triangle of a textured mesh: triangles that share a vertex with the same
// texture coordinate lie in the same one. That needs no adjacency, and joins charts that touch in a
// point.
class Uv_charts
{
public:
  // Linear time for bounded degrees.
  explicit Uv_charts(const Textured_triangle_mesh& mesh) : m_chart(mesh.triangles.size())
  {
    Disjoint_sets sets(mesh.uv.size());
    std::vector<bool> is_listed(mesh.uv.size(), false);
    // Lists of the wedges at each vertex
    std::vector<Vertex_index> first(mesh.points.size(), no_vertex), next(mesh.uv.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        const Vertex_index v = mesh.triangles[t][c], w = mesh.wedges[t][c];
        sets.join(w, mesh.wedges[t][0]);
        if(is_listed[w])
          continue;
        is_listed[w] = true;
        for(Vertex_index other = first[v]; other != no_vertex; other = next[other])
          if(mesh.uv[other] == mesh.uv[w])
            sets.join(w, other);
        next[w] = first[v];
        first[v] = w;
      }
    std::vector<std::uint32_t> number(mesh.uv.size(), no_chart);
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      std::uint32_t& chart = number[sets.find(mesh.wedges[t][0])];
      if(chart == no_chart)
        chart = m_size++;
      m_chart[t] = chart;
    }
  }

  std::uint32_t size() const { return m_size; }
  std::uint32_t operator[](std::uint32_t triangle) const { return m_chart[triangle]; }

private:
  std::vector<std::uint32_t> m_chart;
  std::uint32_t m_size = 0;
};

// Which chart of a fine mesh is that of a light model's triangle, for two meshes in one atlas: most
// of the chart of the light model, by the area of its triangles, has its triangles' centres there.
class Chart_partners
{
public:
  // triangle_at(u, v) is the fine mesh's triangle there, if any.
  template <class TriangleAt>
  Chart_partners(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                 const TriangleAt& triangle_at)
    : m_fine(fine)
  {
    if(m_fine.size() <= 1) // whatever is found is right
      return;
    const Uv_charts charts(light);
    typedef std::pair<std::uint32_t, std::uint32_t> Pair; // light, fine
    std::vector<std::pair<Pair, double>> areas;
    for(std::uint32_t t = 0; t < light.triangles.size(); ++t) {
      const auto &p = light.uv[light.wedges[t][0]], &q = light.uv[light.wedges[t][1]],
                 &r = light.uv[light.wedges[t][2]];
      const std::uint32_t f
        = triangle_at((p.x() + q.x() + r.x()) / 3., (p.y() + q.y() + r.y()) / 3.);
      if(f != no_triangle)
        areas.push_back({{charts[t], m_fine[f]},
                         std::abs((q.x() - p.x()) * (r.y() - p.y())
                                  - (q.y() - p.y()) * (r.x() - p.x()))});
    }
    std::sort(areas.begin(), areas.end());
    std::vector<std::uint32_t> partner(charts.size(), no_chart);
    std::vector<double> largest(charts.size(), -1.);
    for(auto a = areas.begin(); a != areas.end();) {
      const Pair pair = a->first;
      double sum = 0.;
      for(; a != areas.end() && a->first == pair; ++a)
        sum += a->second;
      if(sum > largest[pair.first]) {
        largest[pair.first] = sum;
        partner[pair.first] = pair.second;
      }
    }
    m_partner.resize(light.triangles.size());
    for(std::uint32_t t = 0; t < m_partner.size(); ++t)
      m_partner[t] = partner[charts[t]];
  }

  // Whether a fine triangle lies in the chart that belongs to that of a light one, or none does.
  bool match(std::uint32_t fine_triangle, std::uint32_t light_triangle) const
  {
    return m_partner.empty() || m_partner[light_triangle] == no_chart
        || m_partner[light_triangle] == m_fine[fine_triangle];
  }

private:
  Uv_charts m_fine;
  std::vector<std::uint32_t> m_partner; // of each light triangle; empty if the fine mesh has one
};

} // namespace internal

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
