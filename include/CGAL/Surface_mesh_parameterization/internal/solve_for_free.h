// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVE_FOR_FREE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVE_FOR_FREE_H

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <cmath>
#include <complex>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Sets the unknowns that are not pinned so that the residual vanishes. The matrix is factorized.
template <class Solver>
bool solve_for_free(Solver& solver, const Conformal_operator<double>& op,
                    Multigrid::Complex_vector<double>& z)
{
  typedef std::complex<double> Complex;
  Multigrid::Complex_vector<double> f(z.size()), x;
  op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex s) {
    f[i] = -(op.matrix.diagonal()[i] * z[i] + s);
  });
  solver.solve(f, x);
  for(std::size_t i = 0; i < z.size(); ++i) {
    z[i] += x[i];
    if(!std::isfinite(z[i].real()) || !std::isfinite(z[i].imag()))
      return false;
  }
  return true;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVE_FOR_FREE_H
