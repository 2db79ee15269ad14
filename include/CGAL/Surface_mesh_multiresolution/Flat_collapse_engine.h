// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Batched_collapses.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Strict_collapses.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The class `Flat_collapse_engine` decimates an `Indexed_triangle_mesh` by halfedge collapses and
records them as a `Progressive_mesh`. It runs the same cost and filter policies as CGAL's
`edge_collapse()`, on flat 32-bit arrays.

A vertex is removed only if topology allows it: the mesh stays a manifold with the same Euler
characteristic and the same border components. A border vertex leaves only along the border; locked
vertices and vertices of more than 14 neighbours never leave; a vertex that has at most 14
neighbours never gets more. The result depends on the input alone,
not on the number of threads (`Blocked_execution::Thread_scope`).

\tparam Cost a model of `GetCost`; called by several threads at the same time for vertices that have
        no neighbour in common
\tparam Filter a model of `PlacementFilter`; the same holds
\tparam Texture what the engine knows of a texture; see `build_textured_progressive_mesh()`

Expected linear time in the number of vertices (batched), O(n log n) (strict); 85 bytes a vertex.
*/
template <class Cost = Hierarchy_collapse_cost<>, class Filter = Hierarchy_collapse_filter,
          class Texture = internal::No_texture_layer>
class Flat_collapse_engine
{
public:
  /// Constructs the engine on a mesh whose vertices should be in spatial order and whose mean edge
  /// length should be near 1 (`sort_spatially()`, `normalize()`). The mesh must live as long as
  /// the engine.
  ///
  /// \param is_locked for each vertex whether it must stay; empty for none
  Flat_collapse_engine(const Indexed_triangle_mesh& mesh, Indexed_mesh::Vertex_rings rings,
                       const std::vector<bool>& is_locked,
                       const Cost& cost = hierarchy_collapse_cost(),
                       const Filter& filter = hierarchy_collapse_filter(),
                       const Texture& texture = Texture())
    : m_surface(mesh, std::move(rings), is_locked, cost, filter, texture)
  {}

  /// Collapses until the target is reached or nothing more can be collapsed.
  Progressive_mesh run(const Flat_collapse_options& options);

  /// Returns the number of costs computed so far, one a vertex and its ring.
  std::size_t number_of_evaluations() const { return m_surface.evaluations; }

  /// Returns what has become of the texture.
  const Texture& texture() const { return m_surface.texture; }

private:
  typedef internal::Decimated_surface<Cost, Filter, Texture> Surface;

  Surface m_surface;
};

template <class Cost, class Filter, class Texture>
Progressive_mesh
Flat_collapse_engine<Cost, Filter, Texture>::run(const Flat_collapse_options& options)
{
  const std::vector<Triangle_indices>& triangles = m_surface.mesh.triangles;
  Progressive_mesh pm;
  pm.number_of_vertices = m_surface.number_of_vertices();
  Blocked_execution::resize_blocked(pm.triangles, triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
    std::copy(triangles.begin() + begin, triangles.begin() + end, pm.triangles.begin() + begin);
  });
  if(options.order == Collapse_order::STRICT)
    internal::Strict_collapses<Surface>(m_surface, options).run(pm);
  else
    internal::Batched_collapses<Surface>(m_surface, options).run(pm);
  return pm;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
