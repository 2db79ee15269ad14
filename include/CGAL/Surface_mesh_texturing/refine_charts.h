// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_REFINE_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_REFINE_CHARTS_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/straighten_charts.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Progressive_mesh;

namespace internal {

// Collapses as far as k; returns the halfedge of each collapse.
inline std::vector<Halfedge> collapse_all(const Progressive_mesh& pm, std::size_t k,
                                          Halfedge_triangles& mesh)
{
  std::vector<Halfedge> edges(k);
  for(std::size_t i = 0; i < k; ++i)
    edges[i] = mesh.collapse(pm.collapses[i].removed, pm.collapses[i].kept);
  return edges;
}

// The seams of the coarse triangles at the fine ones that survive.
inline std::vector<std::uint8_t> seams_of_survivors(const Progressive_mesh& pm,
                                                    const Halfedge_triangles& mesh,
                                                    const std::vector<Halfedge>& edges,
                                                    const Face_charts& coarse)
{
  std::vector<std::uint8_t> seams(pm.triangles.size(), 1);
  for(const Halfedge e : edges)
    if(e != no_halfedge) {
      seams[triangle_of(e)] = 0;
      if(mesh.opposite(e) != no_halfedge)
        seams[triangle_of(mesh.opposite(e))] = 0;
    }
  CGAL_precondition(std::size_t(std::count(seams.begin(), seams.end(), 1)) == coarse.seams.size());
  std::size_t i = 0;
  for(std::uint8_t& s : seams)
    if(s != 0)
      s = coarse.seams[i++];
  return seams;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the charts of the fine mesh of `pm` that come of the charts `coarse` of its mesh after `k`
collapses, whose triangles are those of `triangles_after(pm, k)`.

The collapses are undone one by one. Where a vertex on seams becomes two, each seam goes with the
triangles beside it, and the new edge becomes a seam if it must join the seams of both; so the graph
of the seams keeps its homotopy type, and each chart its topology. Each time the mesh has four times
the vertices the seams are made straight in one round, and at the end in all rounds (see
`straighten_charts()`), which costs time in proportion to their length. In all, a seam moves by
about two edges of the coarse mesh at most.

\param pm whose collapses keep the mesh a manifold, of the same topology, and border vertices on the
border, as those of `Flat_collapse_engine`
\param points of the fine mesh
\param options of the straightening; with `rounds` 0 the seams are only carried along
\param occlusion of each vertex, its `ambient_occlusion()`; empty for none

\pre all that: this is a part of `segment_coarse_to_fine()`, which makes `pm` itself and checks the
rest, and whom a check of the collapses would cost more than they do

Time linear in the number of triangles of `pm`.
*/
CGAL_HLSCM_INLINE Face_charts
refine_charts(const Progressive_mesh& pm, const std::vector<Indexed_triangle_mesh::Point_3>& points,
              std::size_t k, const Face_charts& coarse,
              const Straightening_options& options = Straightening_options(),
              const std::vector<float>& occlusion = {});

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Face_charts
refine_charts(const Progressive_mesh& pm, const std::vector<Indexed_triangle_mesh::Point_3>& points,
              std::size_t k, const Face_charts& coarse, const Straightening_options& options,
              const std::vector<float>& occlusion)
{
  CGAL_precondition(k <= pm.collapses.size() && points.size() == pm.number_of_vertices);
  internal::Halfedge_triangles mesh(pm.triangles, points.size());
  internal::Refinable_seam_graph graph(mesh, points, options.creases);
  graph.set_occlusion(occlusion);
  const std::vector<Halfedge> edges = internal::collapse_all(pm, k, mesh);
  graph.set_seams(internal::seams_of_survivors(pm, mesh, edges, coarse));
  graph.pin_curved(options.pinned_defect);
  internal::Seam_straightener straightener(graph);
  // Not at once: on the coarse mesh a move by one edge would be a far one
  int level = 0;
  std::size_t next_level = 4 * pm.number_of_vertices_after(k);
  for(std::size_t i = k; i-- > 0;) {
    if(edges[i] != no_halfedge)
      graph.split(edges[i], pm.collapses[i].removed, pm.collapses[i].kept);
    if(options.rounds > 0 && i > 0 && pm.number_of_vertices_after(i) >= next_level) {
      straightener.run({options.rings + (std::min)(level, 2), options.window, level, level + 1});
      ++level;
      next_level *= 4;
    }
  }
  internal::Straightening_reach last = internal::reach_of(options);
  last.rings += (std::min)(level, 2); // edges are short by now
  straightener.run(last);
  return internal::label_charts(mesh, graph.seams());
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_REFINE_CHARTS_H
