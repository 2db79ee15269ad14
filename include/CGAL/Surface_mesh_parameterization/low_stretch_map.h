// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretched_chart.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

Returns a map of a surface to the plane with little stretch and without a flipped or degenerate
triangle: a local minimum of the mean of an energy of stretch over the surface, with a free border or
one that the options prescribe.

Unlike a conformal map it keeps areas as well as angles, as far as both can be kept; by default
neither shrinks nor grows without need (the symmetric Dirichlet energy). Faces are never flipped,
whatever the surface: the mesh is collapsed to some forty vertices, which are mapped one-to-one, and
each vertex that comes back is put where it turns no triangle over, which is always possible. In
between, steps of Newton's method lower the energy of each level, shortened so that no triangle turns
over; their linear systems are solved by conjugate gradients with multigrid cycles. So around every
vertex the map is one-to-one. Parts of the surface that are far from each other may overlap in the
plane, see `certify_map()`, unless `Low_stretch_options::is_one_to_one`.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`Low_stretch_options::threads`) or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
\tparam Energy a model of `StretchEnergy`

\param mesh a connected surface of genus 0 with at least one border, in any unit of length
\param options when to stop, and what the map is to be like: pins, a prescribed border, a map to begin
       with, weights of faces, no overlaps
\param energy the energy

Bad data (indices out of range, coordinates that are not finite, closed or other surfaces) give a
result with `error` set and without parameters. `FAILED` says that the surface is stretched so much
that rounding leaves no place for a vertex, or that no way was found to bring the pins, which are kept
exactly, to their places without a triangle that turns over. Which face or vertex it is, if it is one,
says the sentence.

Expected linear time. The result does not depend on the number of threads.
*/
template <class ConcurrencyTag = Default, class Energy = Symmetric_dirichlet_energy>
Low_stretch_map low_stretch_map(Indexed_mesh::Indexed_triangle_mesh mesh,
                                const Low_stretch_options& options = Low_stretch_options(),
                                const Energy& energy = Energy())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  internal::Stretched_chart<Energy> chart(mesh.points.size(), options, energy);
  const std::vector<Indexed_mesh::Triangle_indices> faces = internal::faces_if_asked_for(mesh, options);
  return chart.map(internal::chart_of_arrays(std::move(mesh), options.metric), faces);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H
