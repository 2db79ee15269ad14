// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/assertions.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

One halfedge collapse: `removed` becomes `kept` in all its triangles, and those that have both
disappear.
*/
struct Halfedge_collapse
{
  Vertex_index removed; ///< the vertex that goes
  Vertex_index kept;    ///< the vertex that stays where it is
};

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Progressive_mesh` is a triangle mesh with an ordered list of halfedge collapses, that is
a chain of coarser and coarser meshes whose vertices are vertices of the fine one (Ray and Lévy
2003, section 4 and algorithm 2; Kobbelt et al. 1998).

The collapses form a forest on the vertices. The mesh after the first \f$ k \f$ collapses has as
triangles those fine triangles whose corners, mapped to their ancestors that are still there, are
distinct; nothing else needs to be stored for any level to be extracted or for a vertex split to
be undone. The fine mesh itself is level \f$ k = 0 \f$, so restoring it is exact.

Invariants: every vertex is removed at most once, and never after it was removed as the `kept` of
another collapse; `batch_ends` ascends and ends at `collapses.size()`.

Memory: 12 bytes a triangle and 8 bytes a collapse.
*/
struct Progressive_mesh
{
  std::size_t number_of_vertices = 0;       ///< of the fine mesh
  std::vector<Triangle_indices> triangles;  ///< of the fine mesh
  std::vector<Halfedge_collapse> collapses; ///< in the order in which they take place
  /// Numbers of collapses after which the mesh is evenly coarse: the ends of the passes of a
  /// batched engine. Empty if any number is as good as another.
  std::vector<std::size_t> batch_ends;

  /// Returns the number of vertices after `k` collapses.
  std::size_t number_of_vertices_after(std::size_t k) const { return number_of_vertices - k; }
};

/// \ingroup PkgHLSCMMultiresolution
/// Returns the progressive mesh without collapses of a mesh; its triangles are not copied.
inline Progressive_mesh trivial_progressive_mesh(std::size_t number_of_vertices)
{
  Progressive_mesh pm;
  pm.number_of_vertices = number_of_vertices;
  return pm;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns for each vertex the number of collapses after which it is gone: \f$ i + 1 \f$ for the vertex
that collapse \f$ i \f$ removes, and `collapses.size() + 1` for the vertices that are never removed.
Linear time.
*/
inline std::vector<Vertex_index> removal_times(const Progressive_mesh& pm)
{
  std::vector<Vertex_index> time(pm.number_of_vertices, Vertex_index(pm.collapses.size() + 1));
  for(std::size_t i = 0; i < pm.collapses.size(); ++i)
    time[pm.collapses[i].removed] = Vertex_index(i + 1);
  return time;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns for each vertex its ancestor after `k` collapses, which is the vertex itself if it is still
there. Linear time.
*/
inline std::vector<Vertex_index> ancestors_after(const Progressive_mesh& pm, std::size_t k)
{
  CGAL_precondition(k <= pm.collapses.size());
  std::vector<Vertex_index> ancestor(pm.number_of_vertices);
  for(Vertex_index v = 0; v < pm.number_of_vertices; ++v)
    ancestor[v] = v;
  for(std::size_t i = k; i-- > 0;) // later collapses first: their kept vertex is settled
    ancestor[pm.collapses[i].removed] = ancestor[pm.collapses[i].kept];
  return ancestor;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns the triangles after `k` collapses, with the vertex indices of the fine mesh and in the order
of its triangles; for `k` = 0 that is `pm.triangles`. Linear time.
*/
inline std::vector<Triangle_indices> triangles_after(const Progressive_mesh& pm, std::size_t k)
{
  const std::vector<Vertex_index> ancestor = ancestors_after(pm, k);
  std::vector<Triangle_indices> result;
  for(const Triangle_indices& t : pm.triangles) {
    const Triangle_indices s = {ancestor[t[0]], ancestor[t[1]], ancestor[t[2]]};
    if(s[0] != s[1] && s[1] != s[2] && s[2] != s[0])
      result.push_back(s);
  }
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_H
