// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SCALE_BY_DENSITY_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SCALE_BY_DENSITY_H

#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Makes the charts as large as their density asks for.
inline void scale_by_density(const std::vector<float>& density, Mapped_chart& map)
{
  if(density.empty())
    return;
  double sum = 0., all = 0.;
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& vs = mesh.triangles[t];
    const double area
      = std::sqrt(squared_area(mesh.points[vs[0]], mesh.points[vs[1]], mesh.points[vs[2]]));
    sum += area * density[map.chart.triangles[t]];
    all += area;
  }
  const double scale = all > 0. ? sum / all : 1.;
  for(Point_2& p : map.uv)
    p = Point_2(scale * p.x(), scale * p.y());
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_SCALE_BY_DENSITY_H
