// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_surface.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <utility>

namespace CGAL {
namespace Surface_mesh_multiresolution {

namespace internal {

// The arrays of a mesh, with the points of the named parameters, without its collapses, or what is
// wrong with it.
template <class TriangleMesh, class NamedParameters>
Progressive_surface copy_surface_of(const TriangleMesh& mesh, const NamedParameters& np)
{
  Progressive_surface result;
  if(!result.fail(Mesh_status::BAD_MESH, Indexed_mesh::polygon_error(mesh))) {
    Indexed_triangle_mesh arrays = Indexed_mesh::copy_mesh(mesh, np);
    result.points = std::move(arrays.points);
    result.progressive_mesh.triangles = std::move(arrays.triangles);
  } else {
    result.points = Indexed_mesh::copy_points(mesh, np);
  }
  result.fail(Mesh_status::BAD_MESH, point_error(result.points));
  result.progressive_mesh.number_of_vertices = result.points.size();
  return result;
}

inline Progressive_surface copy_surface(const Indexed_triangle_mesh& mesh)
{
  Progressive_surface result;
  if(result.fail(Mesh_status::BAD_MESH, mesh_error(mesh)))
    return result;
  result.points = mesh.points;
  result.progressive_mesh.number_of_vertices = mesh.points.size();
  result.progressive_mesh.triangles = mesh.triangles;
  return result;
}

// What is wrong with the locks of a mesh of n vertices.
inline Mesh_outcome lock_error(const Progressive_mesh_options& options, std::size_t n)
{
  Mesh_outcome result;
  if(!options.is_locked.empty())
    result.fail(Mesh_status::BAD_OPTIONS,
                Indexed_mesh::size_error("is_locked", options.is_locked.size(), n));
  return result;
}

// Appends the collapses that `run(engine, prepared)` returns, in terms of the input of the mesh that
// is prepared.
template <class Cost, class Filter, class Run>
void decimate(Prepared_mesh prepared, const Progressive_mesh_options& options, const Cost& cost,
              const Filter& filter, const Run& run, Progressive_surface& result)
{
  if(result.fail(lock_error(options, result.points.size())) || result.fail(prepared))
    return;
  Flat_collapse_engine<Cost, Filter> engine(prepared.mesh, std::move(prepared.rings),
                                            prepared.flags(options.is_locked), cost, filter);
  Progressive_mesh pm = run(engine, prepared);
  if(engine.end().is_cancelled)
    result.cancel();
  result.progressive_mesh.collapses.reserve(pm.collapses.size());
  for(const Halfedge_collapse& c : pm.collapses)
    result.progressive_mesh.collapses.push_back(
      {prepared.source[c.removed], prepared.source[c.kept]});
  result.progressive_mesh.batch_ends = std::move(pm.batch_ends);
}

// With the default policies, which want edges of length 1.
template <class Run>
void decimate_normalized(const Progressive_mesh_options& options, const Run& run,
                         Progressive_surface& result)
{
  if(result.is_ok())
    decimate(prepare_mesh({result.points, result.progressive_mesh.triangles}), options,
             hierarchy_collapse_cost(), hierarchy_collapse_filter(options.angular_defect_bound),
             run, result);
}

// With the default policies, to the target of `options`.
CGAL_HLSCM_INLINE void decimate_to_target(const Progressive_mesh_options& options,
                                          Progressive_surface& result);

// With given policies, which see the coordinates of the mesh.
template <class Cost, class Filter, class Run>
void decimate_as_it_is(const Progressive_mesh_options& options, const Cost& cost,
                       const Filter& filter, const Run& run, Progressive_surface& result)
{
  Preparation as_it_is;
  as_it_is.normalizes = false;
  if(result.is_ok())
    decimate(prepare_mesh({result.points, result.progressive_mesh.triangles}, as_it_is), options,
             cost, filter, run, result);
}

// What runs an engine to the target of `options`.
inline auto to_target(const Progressive_mesh_options& options)
{
  return [&options](auto& engine, const Prepared_mesh&) { return engine.run(options); };
}

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE void decimate_to_target(const Progressive_mesh_options& options,
                                          Progressive_surface& result)
{
  decimate_normalized(options, to_target(options), result);
}
#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

Returns a progressive mesh of `mesh`, made by `Flat_collapse_engine` with its default policies.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`Progressive_mesh_options::threads`) or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
\tparam TriangleMesh a model of `FaceListGraph`
\tparam NamedParameters a sequence of named parameters
\param mesh a triangle mesh of any size and place, which is not changed
\param options where to stop, and what must stay
\param np `vertex_point_map` and `geom_traits`; see `Indexed_mesh::copy_points()`

Bad data (faces that are no triangles, vertices without a face or with several fans of faces,
coordinates that are not finite) give a result with `error` set and no collapses.

Expected linear time; see `Flat_collapse_engine`.

\sa `decimate()`, which changes the mesh
*/
template <class ConcurrencyTag = Default, class TriangleMesh,
          class NamedParameters = parameters::Default_named_parameters>
Progressive_surface
build_progressive_mesh(const TriangleMesh& mesh,
                       const Progressive_mesh_options& options = Progressive_mesh_options(),
                       const NamedParameters& np = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Progressive_surface result = internal::copy_surface_of(mesh, np);
  internal::decimate_to_target(options, result);
  return result;
}

/// \ingroup PkgHLSCMMultiresolution
/// Returns a progressive mesh of two arrays, as of any mesh. A triangle with a vertex that
/// does not exist is bad data, too.
template <class ConcurrencyTag = Default>
Progressive_surface
build_progressive_mesh(const Indexed_triangle_mesh& mesh,
                       const Progressive_mesh_options& options = Progressive_mesh_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Progressive_surface result = internal::copy_surface(mesh);
  internal::decimate_to_target(options, result);
  return result;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns a progressive mesh of `mesh`, made by `Flat_collapse_engine` with the given policies, which
see the coordinates of `mesh` (those of this package want edge lengths of about 1, that is between
1e-6 and 1e6) and a `Flat_collapse_profile`. `options.angular_defect_bound` is not used.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam Cost a model of CGAL's concept `GetCost`
\tparam Filter a model of CGAL's concept `PlacementFilter`

Tag, named parameters and bad data: as above.
*/
template <class ConcurrencyTag = Default, class TriangleMesh, class Cost, class Filter,
          class NamedParameters = parameters::Default_named_parameters>
Progressive_surface
build_progressive_mesh(const TriangleMesh& mesh, const Progressive_mesh_options& options,
                       const Cost& cost, const Filter& filter,
                       const NamedParameters& np = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Progressive_surface result = internal::copy_surface_of(mesh, np);
  internal::decimate_as_it_is(options, cost, filter, internal::to_target(options), result);
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H
