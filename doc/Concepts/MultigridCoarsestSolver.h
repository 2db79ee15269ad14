// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridCoarsestSolver` describes a direct solver for Hermitian systems. Rows of zeros
stand for fixed unknowns (pins) and are left out.

\cgalRefines{DefaultConstructible}

\cgalHasModel{CGAL::Multigrid::Sparse_cholesky}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Solver_traits_cholesky}
*/
class MultigridCoarsestSolver
{
public:
  /// Factorizes `matrix`; returns whether that succeeded. The factorization is kept until the next
  /// call; `matrix` is not needed any more.
  template <class Real>
  bool factorize(const CGAL::Multigrid::Hermitian_matrix<Real>& matrix);

  /// Sets `x`, whatever its size was, to the solution for the right-hand side `f`; the unknowns of
  /// rows of zeros become 0.
  ///
  /// \pre `factorize()` has succeeded
  template <class Real>
  void solve(const CGAL::Multigrid::Complex_vector<Real>& f,
             CGAL::Multigrid::Complex_vector<Real>& x);
};
