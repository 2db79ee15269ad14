// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_PREPARE_MESH_H
#define CGAL_INDEXED_MESH_PREPARE_MESH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// The steps of `prepare_mesh()` that not all want.
struct Preparation
{
  /// Whether vertices without a triangle are left out; otherwise they are an error.
  bool drops_unused_vertices = false;
  /// Whether the mean edge length becomes 1 and the middle the origin.
  bool normalizes = true;
};

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Prepared_mesh` is a mesh as the algorithms of all packages like it best: small numbers,
what is near in space near in memory, and known to be a manifold.
*/
struct Prepared_mesh
  : Mesh_outcome
{
  Indexed_triangle_mesh mesh;       ///< in spatial order
  std::vector<Vertex_index> source; ///< for each vertex the one of the input
  Vertex_rings rings;               ///< of `mesh`
  double scale = 1.;                ///< the lengths of `mesh` to those of the input; 0: no extent

  /// Returns flags of vertices of the input for those of `mesh`; empty if there are none.
  std::vector<bool> flags(const std::vector<bool>& of_input) const
  {
    std::vector<bool> result(of_input.empty() ? 0 : source.size());
    for(std::size_t v = 0; v < result.size(); ++v)
      result[v] = of_input[source[v]];
    return result;
  }
};

/// \ingroup PkgHLSCMIndexedMesh
/// Keeps the vertices for which `is_kept`, with their entries of `source`, and the triangles that
/// have only such. Linear time.
inline void keep_vertices(Indexed_triangle_mesh& mesh, std::vector<Vertex_index>& source,
                          const std::vector<bool>& is_kept)
{
  std::vector<Vertex_index> rank(is_kept.size());
  std::size_t kept = 0;
  for(std::size_t v = 0; v < is_kept.size(); ++v) {
    rank[v] = Vertex_index(kept);
    if(!is_kept[v])
      continue;
    mesh.points[kept] = mesh.points[v];
    source[kept] = source[v];
    ++kept;
  }
  mesh.points.erase(mesh.points.begin() + kept, mesh.points.end());
  source.resize(kept);
  std::size_t triangles = 0;
  for(const Triangle_indices& t : mesh.triangles)
    if(is_kept[t[0]] && is_kept[t[1]] && is_kept[t[2]])
      mesh.triangles[triangles++] = {rank[t[0]], rank[t[1]], rank[t[2]]};
  mesh.triangles.resize(triangles);
}

/// \ingroup PkgHLSCMIndexedMesh
/// Leaves out vertices without a triangle, with their entries of `source`. Linear time.
inline void drop_unused_vertices(Indexed_triangle_mesh& mesh, std::vector<Vertex_index>& source)
{
  std::vector<std::atomic<bool>> is_used(mesh.points.size());
  Blocked_execution::blocked_for(mesh.triangles.size(), block_of_points,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t)
      for(const Vertex_index v : mesh.triangles[t])
        is_used[v].store(true, std::memory_order_relaxed);
  });
  const std::vector<bool> is_kept(is_used.begin(), is_used.end());
  if(std::find(is_kept.begin(), is_kept.end(), false) != is_kept.end())
    keep_vertices(mesh, source, is_kept);
}

/*!
\ingroup PkgHLSCMIndexedMesh

Takes a mesh of any size and place, with vertices in any order, and returns it prepared: normalized,
sorted along a space-filling curve, and with rings of neighbours.

Errors: all edges without length, a vertex without a triangle or with several fans of triangles, an
edge of more than two triangles. Indices must be in range and coordinates finite; see
`mesh_error()`. Linear time.
*/
inline Prepared_mesh prepare_mesh(Indexed_triangle_mesh mesh,
                                  const Preparation& steps = Preparation())
{
  Prepared_mesh result;
  std::vector<Vertex_index> source(mesh.points.size());
  std::iota(source.begin(), source.end(), Vertex_index(0));
  if(steps.drops_unused_vertices)
    drop_unused_vertices(mesh, source);
  if(steps.normalizes)
    result.scale = normalize(mesh);
  if(!(result.scale > 0.)) {
    result.fail(Mesh_status::BAD_MESH, no_extent_error);
    return result;
  }
  result.source = sort_spatially(mesh);
  for(Vertex_index& v : result.source)
    v = source[v];
  result.mesh = std::move(mesh);
  result.rings = Vertex_rings(result.mesh);
  result.fail(Mesh_status::BAD_MESH, ring_error(result.rings, result.source));
  return result;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_PREPARE_MESH_H
