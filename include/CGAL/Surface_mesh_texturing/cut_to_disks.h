// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H
#define CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/chart_topology.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Disk_cutter.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

namespace internal {

// As the public one, of a mesh and charts that have been checked; `avoided` may be empty, see
// Refinable_seam_graph::avoid().
inline Face_charts cut_to_disks(const Indexed_triangle_mesh& mesh,
                                const Triangle_adjacency& adjacency, Face_charts charts,
                                const Disk_cut_options& options,
                                const std::vector<std::uint8_t>& avoided)
{
  charts.seams = without_lonely_seams(adjacency, std::move(charts.seams));
  const std::vector<Chart_topology> topologies = chart_topologies(adjacency, charts);
  if(error_of_charts(topologies).empty())
    return charts;
  const std::vector<Chart_mesh> meshes = cut_out_charts(mesh, adjacency, charts);
  for(std::size_t c = 0; c < meshes.size(); ++c) {
    if(topologies[c].is_disk())
      continue;
    const std::vector<std::uint8_t> seams
      = Disk_cutter(meshes[c].mesh, options, meshes[c].sides(avoided)).cut();
    for(std::size_t t = 0; t < seams.size(); ++t)
      charts.seams[meshes[c].triangles[t]] |= seams[t];
  }
  return charts;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns `charts` with seams added within those charts that are no disks, until all are. Seams are
short and prefer creases, concave ones above all. A chart with several borders gets seams between
them, a chart with handles seams along these, and a closed chart a tree of seams to its extremities.

Any surface that `Face_charts` can describe will do; if there is a `charts_error()` there are no
charts. Time \f$ O(n \log n) \f$ for the charts that
are no disks, linear for the others.
*/
inline Face_charts cut_to_disks(const Indexed_triangle_mesh& mesh, Face_charts charts,
                                const Disk_cut_options& options = Disk_cut_options())
{
  if(!surface_error(mesh).empty())
    return {};
  const Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  if(!internal::adjacency_error(mesh, adjacency, charts).is_ok())
    return {};
  return internal::cut_to_disks(mesh, adjacency, std::move(charts), options, {});
}

/*!
\ingroup PkgHLSCMTexturing

Returns the connected components of `mesh` as charts, each cut to one disk. On a mesh of many
triangles it is faster to cut a coarse one and to refine the cut; see `segment_coarse_to_fine()`. None
if there is a `charts_error()`.
*/
inline Face_charts one_disk_per_component(const Indexed_triangle_mesh& mesh,
                                          const Disk_cut_options& options = Disk_cut_options())
{
  return cut_to_disks(
    mesh, charts_between(mesh.triangles, std::vector<std::uint8_t>(mesh.triangles.size())),
    options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H
