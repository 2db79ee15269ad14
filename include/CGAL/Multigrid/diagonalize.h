// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_DIAGONALIZE_H
#define CGAL_MULTIGRID_DIAGONALIZE_H

#include <CGAL/Multigrid/vector_operations.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// A matrix of a few rows and columns.
template <class Inner, std::size_t N>
using Small_matrix = std::array<std::array<Inner, N>, N>;

/*!
\ingroup PkgHLSCMMultigrid

Diagonalizes the first `n` rows and columns of a Hermitian matrix `a`, of real or complex numbers of
double precision, by Jacobi's rotations: they become the eigenvalues, in no order. Returns the
eigenvectors as columns. Eigen's solvers for such small problems would take a fifth of the time in which
a program with the parameterizer is compiled.
*/
template <class Inner, std::size_t N>
Small_matrix<Inner, N> diagonalize(int n, Small_matrix<Inner, N>& a)
{
  constexpr int most_sweeps = 30; // quadratic convergence makes four or five of it
  constexpr double negligible = 1e-17;
  Small_matrix<Inner, N> v = {};
  for(int i = 0; i < n; ++i)
    v[i][i] = 1.;
  bool is_diagonal = false;
  for(int sweep = 0; sweep < most_sweeps && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for(int p = 0; p < n; ++p)
      for(int q = p + 1; q < n; ++q) {
        const double r = std::abs(a[p][q]), app = std::real(a[p][p]), aqq = std::real(a[q][q]);
        if(!(r > negligible * (std::abs(app) + std::abs(aqq))))
          continue;
        is_diagonal = false;
        // The rotation that makes of the columns x and y: c x - s z y and s x + c z y
        const Inner z = Value_traits<Inner>::adjoint(a[p][q]) / r;
        const double theta = (aqq - app) / (2. * r);
        const double t = (theta < 0. ? -1. : 1.) / (std::abs(theta) + std::hypot(theta, 1.));
        const double c = 1. / std::hypot(t, 1.), s = t * c;
        for(Small_matrix<Inner, N>* m : {&a, &v})
          for(int i = 0; i < n; ++i) {
            const Inner x = (*m)[i][p], y = z * (*m)[i][q];
            (*m)[i][p] = c * x - s * y;
            (*m)[i][q] = s * x + c * y;
          }
        for(int j = 0; j < n; ++j) {
          const Inner x = a[p][j], y = Value_traits<Inner>::adjoint(z) * a[q][j];
          a[p][j] = c * x - s * y;
          a[q][j] = s * x + c * y;
        }
        a[p][q] = a[q][p] = 0.;
      }
  }
  return v;
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_DIAGONALIZE_H
