// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Batched_collapses.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The layer of a mesh on which there is nothing but the surface.
///
/// \cgalModels{CollapseLayer}
struct No_collapse_layer
{
  static constexpr bool is_active = false; ///< the engine asks nothing of it
};

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

\tparam Cost a model of CGAL's concept `GetCost`; called by several threads at the same time for
        vertices that have no neighbour in common
\tparam Filter a model of CGAL's concept `PlacementFilter`; the same holds
\tparam Layer a model of `CollapseLayer`: what else lies on the surface and has a say, such as the
        texture of `build_textured_progressive_mesh()`

Expected linear time in the number of vertices (batched), O(n log n) (strict); 85 bytes a vertex.
*/
template <class Cost = Hierarchy_collapse_cost<>, class Filter = Hierarchy_collapse_filter,
          class Layer = No_collapse_layer>
class Flat_collapse_engine
{
public:
  /// Constructs the engine on a mesh whose vertices should be in spatial order and whose mean edge
  /// length should be near 1 (`sort_spatially()`, `normalize()`). The mesh must live as long as
  /// the engine.
  ///
  /// \param mesh the mesh
  /// \param rings the connectivity of `mesh`, without a defect: `Indexed_mesh::Vertex_rings(mesh)`
  /// \param is_locked for each vertex whether it must stay; empty for none
  /// \param cost the cost of a collapse
  /// \param filter which collapses are allowed
  /// \param layer what else lies on the surface
  Flat_collapse_engine(const Indexed_triangle_mesh& mesh, Indexed_mesh::Vertex_rings rings,
                       const std::vector<bool>& is_locked,
                       const Cost& cost = hierarchy_collapse_cost(),
                       const Filter& filter = hierarchy_collapse_filter(),
                       const Layer& layer = Layer())
    : m_surface(mesh, std::move(rings), is_locked, cost, filter, layer)
  {}

  /// Collapses until the target is reached or nothing more can be collapsed.
  Progressive_mesh run(const Flat_collapse_options& options);

  /// Collapses until a stop predicate says so or nothing more can be collapsed;
  /// `options.target_vertices` does not count.
  ///
  /// The order is not `SPREAD`. In the strict order the predicate is asked for each collapse, as in
  /// `edge_collapse()`. In the batched order it is asked for the cheapest collapse of each pass, and for numbers and costs
  /// that the pass would reach; it must not change its mind when costs rise and numbers fall.
  ///
  /// \param options all but where to stop
  /// \param stop a model of CGAL's concept `StopPredicate`, for any profile
  /// \param shown the mesh whose points the profile shows to `stop`: the same mesh with its vertices
  ///        at other places, as before `normalize()`
  /// \param unit what a cost is multiplied by before `stop` sees it
  template <class StopPredicate>
  Progressive_mesh run(const Flat_collapse_options& options, const StopPredicate& stop,
                       const Indexed_triangle_mesh& shown, double unit = 1.);

  /// The same with the mesh and the costs of the engine.
  template <class StopPredicate>
  Progressive_mesh run(const Flat_collapse_options& options, const StopPredicate& stop)
  {
    return run(options, stop, m_surface.mesh);
  }

  /// Returns why the last run ended.
  Decimation_end end() const { return m_end; }

  /// Returns the number of costs computed so far, one a vertex and its ring.
  std::size_t number_of_evaluations() const { return m_surface.evaluations; }

  /// Gives the connectivity of what is left away; the ring of a removed vertex is that at its
  /// collapse. The engine must not run again.
  Indexed_mesh::Vertex_rings take_rings() { return std::move(m_surface.rings); }

  /// Returns what has become of the layer.
  const Layer& layer() const { return m_surface.layer; }

private:
  typedef internal::Decimated_surface<Cost, Filter, Layer> Surface;

  template <class Stop>
  Progressive_mesh run_until(const Flat_collapse_options& options, Stop stop);

  Surface m_surface;
  Decimation_end m_end;
};

template <class Cost, class Filter, class Layer>
Progressive_mesh
Flat_collapse_engine<Cost, Filter, Layer>::run(const Flat_collapse_options& options)
{
  return run_until(options, internal::Stop_at_vertices(m_surface.number_of_vertices(),
                                                       options.target_vertices));
}

template <class Cost, class Filter, class Layer>
template <class StopPredicate>
Progressive_mesh Flat_collapse_engine<Cost, Filter, Layer>::
run(const Flat_collapse_options& options, const StopPredicate& stop,
    const Indexed_triangle_mesh& shown, double unit)
{
  CGAL_precondition(options.order != Collapse_order::SPREAD);
  return run_until(options, internal::Stop_by_predicate<StopPredicate>(
                              stop, shown, m_surface.rings, unit));
}

template <class Cost, class Filter, class Layer>
template <class Stop>
Progressive_mesh Flat_collapse_engine<Cost, Filter, Layer>::
run_until(const Flat_collapse_options& options, Stop stop)
{
  const std::vector<Triangle_indices>& triangles = m_surface.mesh.triangles;
  Progressive_mesh pm;
  pm.number_of_vertices = m_surface.number_of_vertices();
  Blocked_execution::resize_blocked(pm.triangles, triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
    std::copy(triangles.begin() + begin, triangles.begin() + end, pm.triangles.begin() + begin);
  });
  m_end = options.order == Collapse_order::STRICT
    ? internal::Strict_collapses<Surface, Stop>(m_surface, options, stop).run(pm)
    : internal::Batched_collapses<Surface, Stop>(m_surface, options, stop).run(pm);
  return pm;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
