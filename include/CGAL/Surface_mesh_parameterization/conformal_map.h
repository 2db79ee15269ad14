// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/mapped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/map_chart_conformally.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// What `conformal_map()` returns.
struct Conformal_map
  : Indexed_mesh::Mesh_outcome
{
  /// The parameter of each vertex; (0, 0) for vertices without a face; empty if there is an error.
  std::vector<Simple_cartesian<double>::Point_2> uv;
  HLSCM_report report;  ///< what was done; its `message` is `error`
  Error_code code = OK; ///< what `HLSCM_parameterizer_3` would return
  /// The collapses, if `HLSCM_options::keep_progressive_mesh` was set and the method has a hierarchy.
  Chart_progressive_mesh progressive_mesh;
};

namespace internal {

CGAL_HLSCM_INLINE Conformal_map map_arrays(Indexed_mesh::Indexed_triangle_mesh mesh,
                                           const Wanted_pins& wanted, const HLSCM_options& options);

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE Conformal_map map_arrays(Indexed_mesh::Indexed_triangle_mesh mesh,
                                           const Wanted_pins& wanted, const HLSCM_options& options)
{
  Conformal_map result;
  const std::size_t n = mesh.points.size();
  Run_control run(options, result.report);
  Indexed_mesh::Indexed_triangle_mesh kept; // for the repair
  if(options.repair_flips) {
    run.make_room_for_repair();
    kept = mesh;
  }
  using Indexed_mesh::Mesh_status;
  Prepared_chart prepared = {{}, run.status()};
  Mesh_status why = Mesh_status::BAD_OPTIONS; // of the mesh and the options, if they are wrong
  if(run.status().is_ok()) {
    prepared = chart_of_arrays(std::move(mesh), options.metric);
    if(!prepared.status.is_ok() && !prepared.has_bad_metric)
      why = Mesh_status::BAD_MESH;
  }
  Chart_map map = map_chart_conformally(std::move(prepared), n, wanted, Coarsest_solver(), run);
  if(options.repair_flips && !run.is_stopped())
    repair_arrays(kept, Indexed_mesh::ranks(map.source, n), map.pins, run, map.z);
  if(!run.is_stopped()) {
    result.uv = points_of_values(map.source, map.z, n);
    result.progressive_mesh = take_collapses(map);
  }
  result.code = run.finish();
  const bool is_unsolved = result.code == ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
  result.fail(result.report.cancelled ? Mesh_status::CANCELLED
              : is_unsolved           ? Mesh_status::FAILED : why, result.report.message);
  return result;
}
#endif

} // namespace internal

/*!
\ingroup PkgHLSCMParameterizer

Returns the least squares conformal map with a free border of a connected mesh of genus 0 that has a
border: what `HLSCM_parameterizer_3` computes, with pins of its own choice, for a mesh that is two
arrays.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`HLSCM_options::threads`) or `Default` for
        the threads of the caller's `Blocked_execution::Thread_scope`

Time and memory as for `HLSCM_parameterizer_3`; meshes of less than about 10,000 triangles are best
mapped with `Conformal_method::DIRECT`. Bad data (indices out of range, coordinates that are not
finite, no faces, no border) give a result with `error` set.
*/
template <class ConcurrencyTag = Default>
Conformal_map conformal_map(Indexed_mesh::Indexed_triangle_mesh mesh,
                            const HLSCM_options& options = HLSCM_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::map_arrays(std::move(mesh), std::nullopt, options);
}

/*!
\ingroup PkgHLSCMParameterizer

The same with pins.

\param mesh the mesh
\param pins two or more vertices of the mesh, by their indices, and their parameters; with fewer, or
       one that is no vertex of a triangle, `error` is set
\param options as above
*/
template <class ConcurrencyTag = Default>
Conformal_map conformal_map(Indexed_mesh::Indexed_triangle_mesh mesh,
                            const std::vector<HLSCM_pin>& pins,
                            const HLSCM_options& options = HLSCM_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::map_arrays(std::move(mesh), pins, options);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H
