// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_KEEP_SEAMS_OFF_H
#define CGAL_SURFACE_MESH_TEXTURING_KEEP_SEAMS_OFF_H

#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>
#include <CGAL/Surface_mesh_texturing/straighten_charts.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Returns the number of edges inside the surface that are seams of `charts` and marked in `sides`,
/// at one of their triangles at least, as in `Face_charts::seams`; 0 if arrays differ in length.
inline std::size_t number_of_seams_on(const Indexed_mesh::Triangle_adjacency& adjacency,
                                      const Face_charts& charts,
                                      const std::vector<std::uint8_t>& sides)
{
  if(3 * sides.size() != adjacency.number_of_halfedges() || charts.seams.size() != sides.size())
    return 0;
  std::size_t result = 0;
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const Halfedge o = adjacency.opposite(h);
    if(o != no_halfedge && h < o && charts.is_seam(h)
       && (internal::is_marked(sides, h) || internal::is_marked(sides, o)))
      ++result;
  }
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// The same without an adjacency at hand; see `charts_between()`.
inline std::size_t number_of_seams_on(const std::vector<Triangle_indices>& triangles,
                                      const Face_charts& charts,
                                      const std::vector<std::uint8_t>& sides)
{
  if(sides.size() != triangles.size() || charts.seams.size() != triangles.size()
     || !index_error(triangles, Indexed_mesh::no_vertex).empty())
    return 0;
  return number_of_seams_on(Indexed_mesh::Triangle_adjacency(triangles), charts, sides);
}

namespace internal {

// For each triangle a chart: triangles that are connected across marked edges get the one that has
// most of their area.
inline std::vector<std::uint32_t> charts_of_clusters(const Indexed_triangle_mesh& mesh,
                                                     const Triangle_adjacency& adjacency,
                                                     const Face_charts& charts,
                                                     const std::vector<std::uint8_t>& sides)
{
  const std::size_t n = mesh.triangles.size();
  Disjoint_sets clusters(n);
  for(Halfedge h = 0; h < 3 * n; ++h)
    if(is_marked(sides, h) && adjacency.opposite(h) != no_halfedge)
      clusters.join(triangle_of(h), triangle_of(adjacency.opposite(h)));
  struct Part
  {
    std::uint32_t cluster, chart;
    double area;
  };
  std::vector<Part> parts(n);
  for(Triangle_index t = 0; t < n; ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    parts[t] = {clusters.find(t), charts.chart[t],
                std::sqrt(squared_area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]))};
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::make_pair(a.cluster, a.chart) < std::make_pair(b.cluster, b.chart);
  });
  std::vector<std::uint32_t> result(n);
  std::vector<double> most(n, -1.);
  for(std::size_t i = 0; i < n;) {
    const Part part = parts[i];
    double area = 0.;
    for(; i < n && parts[i].cluster == part.cluster && parts[i].chart == part.chart; ++i)
      area += parts[i].area;
    if(area > most[part.cluster]) {
      most[part.cluster] = area;
      result[part.cluster] = part.chart;
    }
  }
  for(Triangle_index t = 0; t < n; ++t)
    result[t] = result[clusters.find(t)]; // the first of them, which has its own by now
  return result;
}

// As the public one, of a manifold and as many sides as it has triangles.
inline Face_charts keep_seams_off(const Indexed_triangle_mesh& mesh,
                                  const Triangle_adjacency& adjacency, const Face_charts& charts,
                                  std::vector<std::uint8_t> sides,
                                  const Straightening_options& straightening,
                                  const Disk_cut_options& cut)
{
  if(!adjacency_error(mesh.triangles.size(), adjacency, charts).is_ok())
    return {};
  if(number_of_seams_on(adjacency, charts, sides) == 0)
    return charts;
  const std::size_t n = mesh.triangles.size();
  for(Halfedge h = 0; h < 3 * n; ++h)
    if(is_marked(sides, h) && adjacency.opposite(h) != no_halfedge)
      mark(sides, adjacency.opposite(h));
  const std::vector<std::uint32_t> label = charts_of_clusters(mesh, adjacency, charts, sides);
  std::vector<std::uint8_t> seams(n, 0);
  for(Halfedge h = 0; h < 3 * n; ++h) {
    const Halfedge o = adjacency.opposite(h);
    if(o == no_halfedge)
      continue;
    const Triangle_index t = triangle_of(h), u = triangle_of(o);
    const bool is_cut = charts.is_seam(h) && charts.chart[t] == charts.chart[u]; // within a chart
    if(label[t] != label[u] || (is_cut && !is_marked(sides, h)))
      mark(seams, h);
  }
  const Face_charts parts = charts_between(adjacency, std::move(seams));
  const Face_charts disks = cut_to_disks(mesh, adjacency, parts, cut, sides);
  return straighten_charts(mesh, disks, straightening, sides);
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns charts without seams on the edges that are marked in `sides`, as in `Face_charts::seams`; one
of the two triangles of an edge will do. Triangles that are connected across such edges come into the
chart that has most of their area. Charts that are no disks then are cut (`cut_to_disks()`), and all
seams are made straight (`straighten_charts()`), where a marked edge counts as longer than any way
around: there are seams on them only where there is no other way to cut a chart to a disk, as on a
closed surface all edges of which are marked. `number_of_seams_on()` tells.

Charts that have no seam on marked edges stay what they are. There are no charts if the mesh is no
manifold, there is a `charts_error()`, or `sides` has not as many entries as there are triangles.

Time as of those two functions.
*/
inline Face_charts keep_seams_off(const Indexed_triangle_mesh& mesh, const Face_charts& charts,
                                  std::vector<std::uint8_t> sides,
                                  const Straightening_options& straightening
                                  = Straightening_options(),
                                  const Disk_cut_options& cut = Disk_cut_options())
{
  if(sides.size() != mesh.triangles.size() || !manifold_error(mesh).empty())
    return {};
  return internal::keep_seams_off(mesh, Indexed_mesh::Triangle_adjacency(mesh.triangles), charts,
                                  std::move(sides), straightening, cut);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_KEEP_SEAMS_OFF_H
