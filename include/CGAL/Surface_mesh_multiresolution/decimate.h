// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_DECIMATE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_DECIMATE_H

#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/collapse_in_mesh.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Decimation_options` tells `decimate()` where to stop, as a stop predicate does, and what
else there is to choose: the first bound that is met ends the decimation.

\cgalModels{StopPredicate of CGAL's Triangulated Surface Mesh Simplification}
*/
struct Decimation_options
  : Progressive_mesh_options
{
  /// No feature is kept for its angular defect alone: the cost knows what it is worth.
  Decimation_options() { angular_defect_bound = 360.; }

  std::size_t target_edges = 0; ///< where to stop, as a number of edges; 0: anywhere
  std::size_t target_faces = 0; ///< where to stop, as a number of faces; 0: anywhere
  /// No collapse costs more. The default cost is a length in the unit of the mesh.
  double max_cost = (std::numeric_limits<double>::infinity)();

  /// Returns whether a bound is met.
  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile& profile, std::size_t, std::size_t edges) const
  {
    const Mesh_counts& left = profile.surface_mesh().counts();
    return cost > max_cost || left.vertices <= target_vertices
        || (target_edges > 0 && edges <= target_edges)
        || (target_faces > 0 && left.faces <= target_faces);
  }
};

/// \ingroup PkgHLSCMMultiresolution
/// What `decimate()` returns.
struct Decimation_result
  : Indexed_mesh::Mesh_outcome
{
  std::size_t number_of_collapses = 0;   ///< what `edge_collapse()` returns: the vertices removed
  bool is_exhausted = false;             ///< whether nothing more could be collapsed before `stop`
  /// For arrays the old number of each vertex that is left, ascending; empty for other meshes, whose
  /// vertices stay what they are.
  std::vector<Vertex_index> source_vertex;
};

/*!
\ingroup PkgHLSCMMultiresolution

Simplifies a mesh in place by halfedge collapses, as `Surface_mesh_simplification::edge_collapse()`
does with its parameters, but by `Flat_collapse_engine`.

A vertex is removed by moving it onto a neighbour: the vertices that are left, with their
descriptors, points and properties, are vertices of `mesh` that never moved, and the same holds for
faces and their properties; properties of halfedges are not kept at edges that were joined. Removed
elements are removed as by the Euler operations of CGAL: a `Surface_mesh` or a mesh of OpenMesh then
has garbage to collect. If the input is bad the mesh is not changed; if it was cancelled, as far as
that. The result does not depend on the number of threads.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`Decimation_options::threads`, or those of
        the machine) or `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
\tparam TriangleMesh a model of `MutableFaceGraph` and `FaceListGraph`
\tparam StopPredicate a model of CGAL's concept `StopPredicate` for any profile, such as
        `Surface_mesh_simplification::Count_stop_predicate` and `Count_ratio_stop_predicate`
        (CGAL 5; `Edge_count_stop_predicate`, `Edge_count_ratio_stop_predicate`,
        `Face_count_stop_predicate` and `Face_count_ratio_stop_predicate` in CGAL 6); or
        `Decimation_options`, which also set the order of collapses, locks and progress
\tparam NamedParameters a sequence of named parameters

\param mesh a triangle mesh of any size and place
\param stop when to stop; how batched collapses ask it see `Flat_collapse_engine::run()`. In the
       order `STRICT` it is asked for each collapse
\param np named parameters of CGAL:
- `vertex_point_map` and `geom_traits`: the points; see `Indexed_mesh::copy_points()`
- `edge_is_constrained_map`: neither end of a constrained edge is removed, so that these edges stay
  as they are; none by default
- `get_cost`: a model of CGAL's concept `GetCost` for a `Flat_collapse_profile`; by default
  `hierarchy_collapse_cost()` on lengths relative to the mean edge. Costs that use halfedges of the
  profile, such as `LindstromTurk_cost`, do not compile
- `filter`: a model of CGAL's concept `PlacementFilter`, such as `Bounded_normal_change_filter`; by
  default `hierarchy_collapse_filter()`
- `get_placement`: only `Surface_mesh_simplification::Halfedge_collapse_placement`, whose filter and
  locks count; any other placement does not compile, as no vertex may move
- a `visitor` does not compile

Policies that are given see the coordinates of `mesh`; see `build_progressive_mesh()`.

\return how many vertices were removed, or what is wrong with the mesh: faces that are no triangles,
        vertices without a face or with several fans of faces, coordinates that are not finite

Expected linear time (`Collapse_order::BATCHED`); about 150 bytes a vertex of temporary memory.
*/
template <class ConcurrencyTag = Default, class TriangleMesh, class StopPredicate,
          class NamedParameters = parameters::Default_named_parameters>
Decimation_result decimate(TriangleMesh& mesh, const StopPredicate& stop,
                           const NamedParameters& np = parameters::default_values())
{
  Progressive_surface surface = internal::copy_surface_of(mesh, np);
  Decimation_result result;
  if(surface.is_ok())
    result.is_exhausted = internal::decimate_by<ConcurrencyTag>(
      stop, np, internal::locked_vertices(mesh, np), surface);
  if(result.fail(surface) && result.status != Mesh_status::CANCELLED)
    return result;
  result.number_of_collapses = surface.progressive_mesh.collapses.size();
  internal::collapse_in_mesh(surface.progressive_mesh.collapses, mesh);
  return result;
}

/*!
\ingroup PkgHLSCMMultiresolution

Simplifies a mesh of two arrays in place, as any other mesh; of the named parameters `get_cost`,
`filter` and `get_placement` count. Vertices and triangles that are left keep their order and become
consecutive. A triangle with a vertex that does not exist is bad data, too.
*/
template <class ConcurrencyTag = Default, class StopPredicate,
          class NamedParameters = parameters::Default_named_parameters>
Decimation_result decimate(Indexed_triangle_mesh& mesh, const StopPredicate& stop,
                           const NamedParameters& np = parameters::default_values())
{
  Progressive_surface surface = internal::copy_surface(mesh);
  Decimation_result result;
  if(surface.is_ok())
    result.is_exhausted = internal::decimate_by<ConcurrencyTag>(stop, np, {}, surface);
  if(result.fail(surface) && result.status != Mesh_status::CANCELLED)
    return result;
  const Progressive_mesh& pm = surface.progressive_mesh;
  result.number_of_collapses = pm.collapses.size();
  mesh = level_after(surface, pm.collapses.size(), result.source_vertex);
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_DECIMATE_H
