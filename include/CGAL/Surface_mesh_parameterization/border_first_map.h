// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_BORDER_FIRST_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_BORDER_FIRST_MAP_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/border_first/Border_first_flattening.h>
#endif

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// What `border_first_map()` returns.
struct Border_first_map
  : Indexed_mesh::Mesh_outcome
{
  /// The parameter of each vertex; (0, 0) for vertices without a face; empty if there is an error.
  std::vector<Simple_cartesian<double>::Point_2> uv;
};

namespace internal {

// As the public function.
CGAL_HLSCM_INLINE Border_first_map flatten_border_first(Indexed_mesh::Indexed_triangle_mesh mesh);

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE Border_first_map flatten_border_first(Indexed_mesh::Indexed_triangle_mesh mesh)
{
  Border_first_map result;
  const std::size_t n = mesh.points.size();
  const Prepared_chart prepared = chart_of_arrays(std::move(mesh));
  const Chart& chart = prepared.chart;
  if(prepared.status.is_ok() && chart.borders.size() != 1)
    result.fail(Mesh_status::BAD_MESH, "the surface has several borders; cut it to a disk first");
  if(result.fail(Mesh_status::BAD_MESH, prepared.status.message))
    return result;
  const auto z = Border_first_flattening(chart).run();
  const bool is_finite = std::all_of(z.begin(), z.end(), [](const std::complex<double>& value) {
    return std::isfinite(value.real()) && std::isfinite(value.imag());
  });
  if(z.empty())
    result.fail(Mesh_status::FAILED, "the matrix cannot be factorized");
  else if(!is_finite)
    result.fail(Mesh_status::FAILED, "the map has parameters that are not finite numbers");
  else
    result.uv = points_of_values(chart.source, z, n);
  return result;
}
#endif

} // namespace internal

/*!
\ingroup PkgHLSCMParameterizer

Returns the conformal map of a disk under which its border keeps its lengths, up to one factor: of
all conformal maps the one whose area scale varies least (Springborn, Schröder and Pinkall 2008).

A least squares conformal map depends on how the mesh resolves the surface (see the near-kernel in
the manual), and so does its distortion. This map is determined by the surface: on a coarse mesh it
shows what it will be on a fine one. It is computed from the border inwards (boundary first
flattening: Sawhney and Crane 2017, section 4), by one sparse Cholesky factorization of the real
cotangent Laplacian of the inner vertices, which takes about half the time of the complex one of
`Conformal_method::DIRECT`.

Where the border would cross itself in a loop of at most a quarter of its edges, as at the tip of a
seam at which the surface has more than a full angle, it is turned apart: near the loop the border
keeps its turning angles instead of its lengths (mixed conditions: section 4 of the same).

The map may have flipped triangles, and its border may meet itself still. Bad data (indices out of
range, coordinates that are not finite, no disk) give a result with `error` set.

\tparam ConcurrencyTag as for `conformal_map()`; `threads` count with a parallel tag, 0: as many as
        there are processors
*/
template <class ConcurrencyTag = Default>
Border_first_map border_first_map(Indexed_mesh::Indexed_triangle_mesh mesh, unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::flatten_border_first(std::move(mesh));
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_BORDER_FIRST_MAP_H
