// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_STRAIGHTEN_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_STRAIGHTEN_CHARTS_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_straightener.h>

#include <cmath>
#include <utility>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `straighten_charts()` and `refine_charts()`.
struct Straightening_options
{
  int rounds = 2;          ///< over all seams; 0: seams stay where they are
  int rings = 1;           ///< how far a seam may move in a round, in edges
  std::size_t window = 24; ///< the length of the pieces that are made shortest, in edges
  /// Vertices on seams stay there if the angles around them differ from a full turn by that much,
  /// on the coarse mesh if there is one; degrees. Charts whose border does not reach the tips of
  /// the surface are much distorted.
  double pinned_defect = 25.;
  Crease_weights creases;  ///< what is taken to be short
};

namespace internal {

inline Straightening_reach reach_of(const Straightening_options& options)
{
  return {options.rings, options.window, 0, options.rounds};
}

} // namespace internal

/// \ingroup PkgHLSCMTexturing
/// The lengths of the seams inside a surface, each counted once; see `measure_seams()`.
struct Seam_length
{
  double length = 0.;    ///< in the unit of the mesh
  double weighted = 0.;  ///< the same with creases as short as `Crease_weights` says
  std::size_t edges = 0; ///< the number of edges
};

/// \ingroup PkgHLSCMTexturing
/// Returns the length of the seams of `mesh` inside the surface; 0 if there is a `charts_error()`.
/// Linear time.
CGAL_HLSCM_INLINE Seam_length measure_seams(const Indexed_triangle_mesh& mesh,
                                            const Face_charts& charts,
                                            const Crease_weights& creases = Crease_weights());

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Seam_length measure_seams(const Indexed_triangle_mesh& mesh,
                                            const Face_charts& charts,
                                            const Crease_weights& creases)
{
  if(!charts_error(mesh, charts).is_ok())
    return {};
  internal::Halfedge_triangles halfedges(mesh.triangles, mesh.points.size());
  internal::Refinable_seam_graph graph(halfedges, mesh.points, creases);
  graph.set_seams(charts.seams);
  Seam_length result;
  for(Halfedge h = 0; h < 3 * mesh.triangles.size(); ++h) {
    if(!graph.is_seam(h) || graph.is_border(h) || graph.opposite(h) < h)
      continue;
    ++result.edges;
    result.weighted += graph.metric().to_length(graph.length(h));
    result.length += std::sqrt(squared_distance(mesh.points[graph.source(h)],
                                                mesh.points[graph.target(h)]));
  }
  return result;
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

namespace internal {

// As the public one, of a mesh and charts that have been checked; `avoided` may be empty, see
// Refinable_seam_graph::avoid().
CGAL_HLSCM_INLINE Face_charts straighten_charts(const Indexed_triangle_mesh& mesh,
                                                const Face_charts& charts,
                                                const Straightening_options& options,
                                                std::vector<std::uint8_t> avoided);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Face_charts straighten_charts(const Indexed_triangle_mesh& mesh,
                                                const Face_charts& charts,
                                                const Straightening_options& options,
                                                std::vector<std::uint8_t> avoided)
{
  Halfedge_triangles halfedges(mesh.triangles, mesh.points.size());
  Refinable_seam_graph graph(halfedges, mesh.points, options.creases);
  graph.avoid(std::move(avoided));
  graph.set_seams(charts.seams);
  graph.pin_curved(options.pinned_defect);
  Seam_straightener(graph).run(reach_of(options));
  return label_charts(halfedges, graph.seams());
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns charts with shorter seams: pieces of `window` edges are replaced by the shortest paths of
edges in a band of `rings` edges around them, where creases count less, and junctions of seams move
to where their seams are shortest, those on the border of the surface along it. The ends of seams
within a chart, and vertices of much curvature, stay. If all charts are disks, they still are, and
their number does not change. The weighted length of the seams never grows. If the mesh is no manifold
(`Indexed_mesh::manifold_error()`), or there is a `charts_error()`, there are no charts.

Time linear in the number of triangles, with a small constant, plus that of the seam edges times
`rounds * rings`.
*/
inline Face_charts straighten_charts(const Indexed_triangle_mesh& mesh, const Face_charts& charts,
                                     const Straightening_options& options
                                       = Straightening_options())
{
  if(!manifold_error(mesh).empty() || !charts_error(mesh, charts).is_ok())
    return {};
  return internal::straighten_charts(mesh, charts, options, {});
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_STRAIGHTEN_CHARTS_H
