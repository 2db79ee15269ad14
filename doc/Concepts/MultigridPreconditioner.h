// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridPreconditioner` describes what `CGAL::Multigrid::minimize_energy()` improves
its directions with: a function object that approximates \f$ H^{-1} r \f$. It may change from step
to step, as a K-cycle does, since the conjugate gradients are flexible.

\cgalHasModel{CGAL::Multigrid::Diagonal_preconditioner}
\cgalHasModel{CGAL::Multigrid::Gauss_seidel_preconditioner}
A lambda function that calls `CGAL::Multigrid::Multigrid_levels::precondition()` is a model, too.
*/
class MultigridPreconditioner
{
public:
  /// Sets `z`, whatever its size was, to an approximation of \f$ H^{-1} r \f$; 0 at rows of zeros.
  ///
  /// \tparam V an entry of a vector
  template <class V>
  void operator()(const std::vector<V>& r, std::vector<V>& z) const;
};
