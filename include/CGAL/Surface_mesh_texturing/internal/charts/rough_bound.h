// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ROUGH_BOUND_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ROUGH_BOUND_H

#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

typedef Simple_cartesian<double>::Point_2 Point_2;
typedef std::function<std::vector<Point_2>(const Indexed_triangle_mesh&)> Chart_map;

// Scales a map so that its area is that of the surface. False if it has no area.
inline bool scale_to_surface(Chart_distortion& distortion, std::vector<Point_2>& uv)
{
  const double scale = std::sqrt(distortion.area / distortion.uv_area);
  if(!(scale > 0.) || !std::isfinite(scale))
    return false;
  for(Point_2& p : uv)
    p = Point_2(scale * p.x(), scale * p.y());
  distortion.uv_area *= scale * scale;
  return true;
}

// Some triangles around the first one, ascending, that form a disk: those nearest to it across edges, of
// which there are up to `size`.
inline std::vector<Triangle_index> disk_around(const Indexed_triangle_mesh& mesh,
                                               const Triangle_adjacency& adjacency,
                                               Triangle_index first, std::size_t size)
{
  std::vector<bool> is_in(mesh.triangles.size(), false), has_vertex(mesh.points.size(), false);
  std::vector<Triangle_index> disk;
  const auto add = [&](Triangle_index t) {
    is_in[t] = true;
    for(const Vertex_index v : mesh.triangles[t])
      has_vertex[v] = true;
    disk.push_back(t);
  };
  add(first);
  for(std::size_t i = 0; i < disk.size() && disk.size() < size; ++i)
    for(int c = 0; c < 3 && disk.size() < size; ++c) {
      const Halfedge h = adjacency.opposite(disk[i], c);
      if(h == no_halfedge || is_in[triangle_of(h)])
        continue;
      int shared = 0; // edges with the disk: with one of them the vertex across must be new
      for(int d = 0; d < 3; ++d) {
        const Halfedge g = adjacency.opposite(triangle_of(h), d);
        shared += g != no_halfedge && is_in[triangle_of(g)] ? 1 : 0;
      }
      if(shared < 3 && (shared == 2 || !has_vertex[vertex_of(mesh.triangles, previous_halfedge(h))]))
        add(triangle_of(h));
    }
  std::sort(disk.begin(), disk.end());
  return disk;
}

// The distortion of the maps of small disks of a chart, all together: that of larger charts is hardly
// less.
inline Chart_distortion distortion_of_disks(const Indexed_triangle_mesh& mesh, const Chart_map& map)
{
  constexpr std::size_t disks = 64, size = 32; // triangles
  const Triangle_adjacency adjacency(mesh.triangles);
  Chart_cutter<Triangle_adjacency> cut_out(mesh, adjacency);
  Indexed_triangle_mesh all;
  std::vector<Point_2> all_uv;
  for(std::size_t i = 0; i < disks; ++i) {
    const Chart_mesh chart = cut_out(disk_around(
      mesh, adjacency, Triangle_index(i * mesh.triangles.size() / disks), size));
    std::vector<Point_2> uv = map(chart.mesh);
    if(uv.size() != chart.mesh.points.size())
      continue;
    Chart_distortion distortion = measure_chart_distortion(chart.mesh, uv);
    if(!scale_to_surface(distortion, uv))
      continue;
    const Vertex_index offset = Vertex_index(all.points.size());
    all.points.insert(all.points.end(), chart.mesh.points.begin(), chart.mesh.points.end());
    all_uv.insert(all_uv.end(), uv.begin(), uv.end());
    for(const Triangle_indices& t : chart.mesh.triangles)
      all.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return all.triangles.empty() ? Chart_distortion() : measure_chart_distortion(all, all_uv);
}

// What is within one of two bounds is within this.
inline Distortion_bound higher_bound(const Distortion_bound& a, const Distortion_bound& b)
{
  return {(std::max)(a.area_scale, b.area_scale), (std::max)(a.quasi_conformal, b.quasi_conformal)};
}

// The bound of a chart. Where triangles lie at all angles, as those of scans with much noise do, small
// disks take up the root of it and more, and cuts hardly help: then it is relative to them.
inline Distortion_bound rough_bound(const Indexed_triangle_mesh& mesh, const Chart_map& map,
                                    const Distortion_bound& bound)
{
  const Chart_distortion least = distortion_of_disks(mesh, map);
  if(least.is_within({std::sqrt(bound.area_scale), std::sqrt(bound.quasi_conformal)}))
    return bound;
  return {bound.area_scale * (std::max)(1., least.area_scale),
          bound.quasi_conformal * (std::max)(1., least.quasi_conformal)};
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ROUGH_BOUND_H
