// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridLevels` describes the operations of a multigrid cycle on a hierarchy of linear
systems \f$ A_l u_l = f_l \f$, where level 0 is the coarsest. `CGAL::Multigrid::cycle()` says in
which order they are called; matrices and vectors are a matter of the model.

A model need not be numerical: one that only writes down the calls shows what a
`CGAL::Multigrid::Schedule` does.

\cgalHasModel{CGAL::Multigrid::Multigrid_levels}
*/
class MultigridLevels
{
public:
  /// Takes `steps` smoothing steps on the system of `level`, from the present \f$ u_l \f$. For the
  /// cycle to be a preconditioner of conjugate gradients the smoother must be symmetric.
  ///
  /// \pre `level > 0`
  void smooth(std::size_t level, unsigned int steps);

  /// Sets \f$ f_{l-1} = R\,(f_l - A_l u_l) \f$ and \f$ u_{l-1} = 0 \f$.
  ///
  /// \pre `level > 0`
  void restrict_residual(std::size_t level);

  /// Adds \f$ P u_{l-1} \f$ to \f$ u_l \f$.
  ///
  /// \pre `level > 0`
  void correct(std::size_t level);

  /// Solves \f$ A_0 u_0 = f_0 \f$.
  void solve_coarsest();

  /// Sets \f$ u_l \f$ to an approximate solution, by at most `steps` steps of a Krylov method that
  /// is preconditioned by `coarse_cycle()`. That is a cycle on `level` from \f$ u_l = 0 \f$, which
  /// the model sets before each call; it reads \f$ f_l \f$ and changes \f$ u_l \f$.
  ///
  /// \pre `level > 0` and `steps > 0`
  template <class CoarseCycle>
  void accelerate(std::size_t level, unsigned int steps, const CoarseCycle& coarse_cycle);
};
