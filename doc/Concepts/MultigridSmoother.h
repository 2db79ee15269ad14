// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridSmoother` describes what makes the error on a level smooth: steps
\f$ u \leftarrow u + z \f$ on \f$ H u = f \f$ that are cheap, and lower most what oscillates from one
unknown to the next. For the cycle to be a preconditioner of conjugate gradients, what all steps
together do to the residual must be symmetric and positive definite, and it must not depend on \f$ u
\f$ or \f$ f \f$ but linearly.

`Matrix` is `CGAL::Multigrid::Self_adjoint_matrix<Value>` and `Vector` the
`CGAL::Multigrid::Value_vector<Value>` of the levels. Each level has a smoother of its own.

\cgalRefines{DefaultConstructible,MoveConstructible}

\cgalHasModel{CGAL::Multigrid::Chebyshev_smoother}
*/
class MultigridSmoother
{
public:
  /// Prepares the smoother for a matrix.
  void set_matrix(const Matrix& h);

  /// Takes note that row `i` of the matrix has changed.
  void update_row(const Matrix& h, std::uint32_t i);

  /// Takes `steps` steps. The product with the last one is left to the caller, who often does not
  /// need it.
  ///
  /// \param h the matrix of `set_matrix()`
  /// \param steps their number, > 0
  /// \param u the unknowns, updated; those of rows of zeros (pins) stay as they are
  /// \param r on entry the residual \f$ f - H u \f$; on exit that before the last step
  /// \param z on exit, whatever its size was, the last step: the residual is now \f$ r - H z \f$
  void smooth(const Matrix& h, unsigned int steps, Vector& u, Vector& r, Vector& z) const;

  /// Returns the bytes that the smoother takes.
  std::size_t memory() const;
};
