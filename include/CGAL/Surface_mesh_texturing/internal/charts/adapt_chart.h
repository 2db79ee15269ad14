// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Adapts the map of a chart to a metric of the triangles of the whole mesh: it becomes one with
// little stretch in that metric. That is first looked for from nothing; if it is not one-to-one, or
// is no better than the chart scaled to its area in the metric, as where the surface is a long tube,
// then from there.
inline void adapt_chart(const std::vector<Indexed_mesh::Space_tensor>& metric, Mapped_chart& map)
{
  namespace SMP = Surface_mesh_parameterization;
  typedef SMP::Reference_triangle<double> Reference;
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  SMP::Low_stretch_options options;
  std::vector<Reference> references;
  double area = 0., area_in_metric = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const auto &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    options.metric.push_back(metric[map.chart.triangles[t]]);
    area += Reference::of_points(a, b, c).area();
    references.push_back(Reference::of_points(a, b, c, options.metric.back()));
    area_in_metric += references.back().area();
  }
  const double scale = std::sqrt(area_in_metric / area);
  for(Point_2& p : map.uv)
    p = Point_2(scale * p.x(), scale * p.y());
  double energy = 0.; // of the map that is there
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<SMP::Plane_vector<double>, 3> corner;
    for(int k = 0; k < 3; ++k)
      corner[k] = {map.uv[mesh.triangles[t][k]].x(), map.uv[mesh.triangles[t][k]].y()};
    const SMP::Plane_jacobian<double> j(references[t], corner);
    energy += references[t].area()
            * SMP::Symmetric_dirichlet_energy().value(j.squared_norm(), j.determinant());
  }
  SMP::Low_stretch_map adapted = SMP::low_stretch_map(mesh, options);
  if(!adapted.is_ok() || adapted.report.energy * area_in_metric > energy
     || !SMP::is_simple_border(map.chart.border_edges(), adapted.uv)) {
    options.is_one_to_one = true; // takes longer
    options.start = map.uv;
    adapted = SMP::low_stretch_map(mesh, options);
  }
  if(!adapted.is_ok())
    return;
  map.uv = std::move(adapted.uv); // no triangle is flipped
  map.report.distortion = measure_chart_distortion(mesh, map.uv);
}

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

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ADAPT_CHART_H
