// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `StretchEnergy` describes how much a map stretches what is near a point: a function
\f$ f(I, D) \f$ of \f$ I = |J|^2 = \sigma_1^2 + \sigma_2^2 \f$ and
\f$ D = \det J = \sigma_1 \sigma_2 > 0 \f$, where \f$ J \f$ is the Jacobian of the map and
\f$ \sigma_1 \geq \sigma_2 \f$ are its singular values. Every energy that does not change when the
surface or its image is turned is of this kind.

The functions are called by several threads at the same time. If \f$ f \f$ does not grow without
bound when \f$ D \f$ goes to 0, it has a member `static constexpr bool has_barrier = false`.

\cgalHasModel{CGAL::Surface_mesh_parameterization::Symmetric_dirichlet_energy}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Mips_energy}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Area_weighted_mips_energy}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Arap_energy}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Powered_energy}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Barrier_energy}
*/
class StretchEnergy
{
public:
  /// Returns \f$ f(I, D) \f$.
  double value(double I, double D) const;

  /// Returns \f$ f(I, D) \f$ with its first and second derivatives. It is continuous in them.
  CGAL::Surface_mesh_parameterization::Stretch_jet<double> operator()(double I, double D) const;
};
