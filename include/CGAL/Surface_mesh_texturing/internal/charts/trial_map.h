// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TRIAL_MAP_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TRIAL_MAP_H

#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/ch_graham_andrew.h>

#include <iterator>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef Simple_cartesian<double>::Point_2 Trial_uv;

// What the map of a possible chart is like.
struct Trial_map
{
  Chart_distortion distortion;
  bool is_disk = false;       // and has been mapped
  bool is_one_to_one = false; // no flipped triangle, and the border does not meet itself
  double fill = 0.;           // the part of its convex hull that the chart fills in the plane
};

inline double hull_area(const std::vector<Border_edge>& border, const std::vector<Trial_uv>& uv)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_2 Exact_point; // for predicates
  std::vector<Exact_point> points, hull;
  for(const Border_edge& e : border)
    points.push_back(Exact_point(uv[e[0]].x(), uv[e[0]].y()));
  ch_graham_andrew(points.begin(), points.end(), std::back_inserter(hull));
  double twice = 0.;
  for(std::size_t i = 0; i < hull.size(); ++i) {
    const Exact_point &p = hull[i], &q = hull[(i + 1) % hull.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

// Maps the chart, if it is a disk, as the whole chart will be mapped later.
inline Trial_map try_map(const Chart_mesh& chart)
{
  namespace SMP = Surface_mesh_parameterization;
  Trial_map result;
  const SMP::Border_first_map map = SMP::border_first_map(chart.mesh);
  result.is_disk = map.error.empty();
  if(!result.is_disk)
    return result;
  const std::vector<Border_edge> border = chart.border_edges();
  result.distortion = measure_chart_distortion(chart.mesh, map.uv);
  result.is_one_to_one
    = result.distortion.flipped_faces == 0 && result.distortion.degenerate_faces == 0;
  if(result.is_one_to_one)
    SMP::visit_crossing_edges(border, map.uv, [&result](const Border_edge&, const Border_edge&) {
      return result.is_one_to_one = false;
    });
  const double hull = hull_area(border, map.uv);
  result.fill = hull > 0. ? result.distortion.uv_area / hull : 0.;
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TRIAL_MAP_H
