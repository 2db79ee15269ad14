// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_OPTIONS_H
#define CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_OPTIONS_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Multigrid/Schedule.h>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Surface_mesh_multigrid {

/// \ingroup PkgHLSCMSurfaceMultigrid
/// The options of `Surface_multigrid_solver`.
struct Surface_multigrid_options
{
  double tolerance = 1e-6; ///< of the norm of the residual to that of the right-hand side
  std::size_t maximal_iterations = 100; ///< at most so many
  /// The cycle that preconditions each iteration.
  Multigrid::Schedule schedule = Multigrid::Schedule::v_cycle(4, 4);
  /// How many threads there may be if the solver has a parallel tag; 0 stands for all.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time; returning false stops it.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMSurfaceMultigrid
/// What came of a matrix or of a solution.
struct Surface_multigrid_report
  : Indexed_mesh::Mesh_outcome
{
  std::size_t iterations = 0;     ///< steps of the conjugate gradient method
  double relative_residual = 0.;  ///< the norm of the residual to that of the right-hand side
  /// The part of the right-hand side that no solution can have, to its norm: where constants are in
  /// the kernel of the matrix, the mean over each component is left out.
  double unsolvable_part = 0.;
  double seconds = 0.;            ///< of wall-clock time
};

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_SURFACE_MULTIGRID_OPTIONS_H
