// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `MultigridTransfer` describes the linear operator \f$ P \f$ that takes the values of a
coarse level to the next finer one, and its transpose.

\cgalHasModel{CGAL::Surface_mesh_multiresolution::Prolongation}
*/
class MultigridTransfer
{
public:
  /// Sets `fine`, whatever its size was, to \f$ P \f$ times `coarse`.
  ///
  /// \tparam Vector a vector of the levels, `CGAL::Multigrid::Value_vector<Value>`
  template <class Vector>
  void prolongate(const Vector& coarse, Vector& fine) const;

  /// Sets `coarse`, whatever its size was, to \f$ P^T \f$ times `fine`, whose values may be lost.
  template <class Vector>
  void restrict_in_place(Vector& fine, Vector& coarse) const;
};
