// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `RayleighVectors` describes the three vectors of
`CGAL::Multigrid::minimize_rayleigh_quotient()` and what is done with them: \f$ x_0 \f$, whose
quotient is lowered, its preconditioned residual \f$ x_1 \f$, and the last direction \f$ x_2 \f$. All
have \f$ \sum b_i x_i = 0 \f$. Where they are, how \f$ H \f$ and \f$ B \f$ are applied and how sums
are formed is a matter of the model: those of the package have them in memory, in files, or spread
over the ranks of MPI.

`CGAL::Multigrid::minimize_rayleigh_quotient()` has a model of its own for vectors in memory.
*/
class RayleighVectors
{
public:
  /// What inner products are: `double` or `std::complex<double>`.
  typedef unspecified_type Inner;

  /// Makes \f$ \sum b_i x_i = 0 \f$ and \f$ x^H B x = 1 \f$ for \f$ x = x_0 \f$. Returns \f$ x^H H x
  /// \f$.
  double begin();

  /// Sets \f$ x_1 \f$ to the preconditioned residual \f$ H x_0 - q B x_0 \f$ for the quotient
  /// \f$ q \f$ of \f$ x_0 \f$.
  void set_residual(double q);

  /// Returns the products of the first `count` vectors, 2 or 3.
  CGAL::Multigrid::Rayleigh_products<Inner> products(int count);

  /// Sets \f$ x_2 \f$ to \f$ y_1 x_1 + y_2 x_2 \f$, without the second term if `y` has two entries,
  /// then \f$ x_0 \f$ to \f$ y_0 x_0 + x_2 \f$ divided by its norm by \f$ B \f$. Returns
  /// \f$ x_0^H H x_0 \f$.
  double step(const std::vector<Inner>& y);

  /// Returns the largest modulus of an entry of \f$ x_2 \f$.
  double largest_change();
};
