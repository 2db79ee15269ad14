// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Adapts the map of a chart to a metric of the triangles of the whole mesh: it becomes one with little
// stretch in that metric if it stays one-to-one. Otherwise the chart is scaled to its area in it.
inline void adapt_chart(const std::vector<Indexed_mesh::Space_tensor>& metric, Mapped_chart& map)
{
  namespace SMP = Surface_mesh_parameterization;
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  SMP::Low_stretch_options options;
  double area = 0., area_in_metric = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const auto &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    options.metric.push_back(metric[map.chart.triangles[t]]);
    area += SMP::Reference_triangle<double>::of_points(a, b, c).area();
    area_in_metric
      += SMP::Reference_triangle<double>::of_points(a, b, c, options.metric.back()).area();
  }
  SMP::Low_stretch_map adapted = SMP::low_stretch_map(mesh, options);
  const auto is_good
    = [&] { return adapted.is_ok() && SMP::is_simple_border(map.chart.border_edges(), adapted.uv); };
  if(adapted.is_ok() && !is_good()) { // which is rare, and takes longer
    options.is_one_to_one = true;
    adapted = SMP::low_stretch_map(mesh, options);
  }
  if(is_good()) {
    map.uv = std::move(adapted.uv); // no triangle is flipped
    map.report.distortion = measure_chart_distortion(mesh, map.uv);
    return;
  }
  const double scale = std::sqrt(area_in_metric / area);
  for(Point_2& p : map.uv)
    p = Point_2(scale * p.x(), scale * p.y());
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H
