// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `SurfaceElement` describes what each triangle adds to the matrix of an equation on a
surface: a function object, called for all triangles in any order and by several threads at the same
time.

\cgalHasModel{CGAL::Surface_mesh_multigrid::Laplace_element}
\cgalHasModel{CGAL::Surface_mesh_multigrid::Anisotropic_element}
*/
class SurfaceElement
{
public:
  /// Sets `e`, which is zero, for a triangle. The sum over all triangles must be positive
  /// semi-definite.
  ///
  /// \tparam Double the entry of the matrix in double precision: `double`, `std::complex<double>` or a
  ///         block of Eigen
  void operator()(const CGAL::Surface_mesh_multigrid::Surface_triangle& t,
                  CGAL::Surface_mesh_multigrid::Element_matrix<Double>& e) const;
};
