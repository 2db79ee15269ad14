// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridOperator` describes what `CGAL::Multigrid::minimize_energy()` and
`CGAL::Multigrid::minimize_rayleigh_quotient()` know of a self-adjoint matrix \f$ H \f$: a function
object that multiplies by it.

\cgalHasModel{CGAL::Multigrid::Self_adjoint_matrix}
A lambda function is a model, too.
*/
class MultigridOperator
{
public:
  /// Sets `y`, which has the size of `x`, to \f$ H x \f$.
  ///
  /// \tparam V an entry of a vector
  template <class V>
  void operator()(const std::vector<V>& x, std::vector<V>& y) const;
};
