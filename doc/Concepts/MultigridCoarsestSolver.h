// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridCoarsestSolver` describes a direct solver for self-adjoint systems. Rows of
zeros stand for fixed unknowns (pins) and are left out.

\cgalRefines{DefaultConstructible}

\cgalHasModel{CGAL::Multigrid::Sparse_cholesky}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Solver_traits_cholesky}
*/
class MultigridCoarsestSolver
{
public:
  /// Factorizes `matrix`; returns whether that succeeded. The factorization is kept until the next
  /// call; `matrix` is not needed any more.
  ///
  /// \tparam Value an entry, such as `std::complex<float>`. Only those that are used need be
  ///         supported.
  template <class Value>
  bool factorize(const CGAL::Multigrid::Self_adjoint_matrix<Value>& matrix);

  /// Returns whether `factorize()` has been called, and has succeeded the last time.
  bool is_factorized() const;

  /// Sets `x`, whatever its size was, to the solution for the right-hand side `f`; the unknowns of
  /// rows of zeros become 0.
  ///
  /// \tparam V an entry of a vector, perhaps in another precision than the matrix was
  ///
  /// \pre `is_factorized()`
  template <class V>
  void solve(const std::vector<V>& f, std::vector<V>& x);
};
