// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_solver.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/check_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/pins.h>

#include <CGAL/Default.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// What `conformal_map()` returns.
struct Conformal_map
{
  /// The parameter of each vertex; (0, 0) for vertices without a face; empty if there is an error.
  std::vector<Simple_cartesian<double>::Point_2> uv;
  HLSCM_report report; ///< what was done; `message` tells why there is no map
  Error_code error = OK; ///< `OK`, or what is wrong with the mesh or the options
};

/*!
\ingroup PkgHLSCMParameterizer

Returns the least squares conformal map with a free border of a connected mesh of genus 0 that has a
border: what `HLSCM_parameterizer_3` computes, with pins of its own choice, for a mesh that is two
arrays. `HLSCM_options::threads`, `keep_progressive_mesh` and `repair_flips` do not count here: the
threads are those of the caller's `Blocked_execution::Thread_scope`.

Time and memory as for `HLSCM_parameterizer_3`; meshes of less than about 10,000 triangles are best
mapped with `Conformal_method::DIRECT`.
*/
inline Conformal_map conformal_map(Indexed_mesh::Indexed_triangle_mesh mesh,
                                   const HLSCM_options& options = HLSCM_options())
{
  Conformal_map result;
  const std::size_t n = mesh.points.size();
  result.report.method = internal::name_of(options.method);
  internal::Chart chart;
  internal::check_options(options, chart);
  if(chart.error == OK)
    chart = internal::chart_of_arrays(std::move(mesh));
  if(chart.error == OK) {
    result.report.vertices = chart.mesh.points.size();
    result.report.faces = chart.mesh.triangles.size();
    result.report.borders = chart.borders.size();
    const std::vector<internal::Pin> pins = internal::far_border_pins(chart);
    internal::Conformal_solver<typename internal::Coarsest_solver<Default>::type>
      solver(chart, pins, options, result.report);
    const auto z = solver.run();
    if(chart.error == OK && !result.report.cancelled)
      result.uv = internal::points_of_values(chart, z, n);
  }
  result.report.message = result.report.cancelled ? "cancelled" : chart.message;
  result.error = result.report.cancelled ? ERROR_CANNOT_SOLVE_LINEAR_SYSTEM : chart.error;
  return result;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_MAP_H
