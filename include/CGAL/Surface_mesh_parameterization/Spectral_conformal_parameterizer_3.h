// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_SPECTRAL_CONFORMAL_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_SPECTRAL_CONFORMAL_PARAMETERIZER_3_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMParameterizer

The class `Spectral_conformal_parameterizer_3` computes a conformal map with a free border without
pins (Mullen et al. 2008): of all maps \f$ z \f$ whose border has its centre of mass at the origin,
that of the least conformal energy for the size of the border,
\f[ \min_z \frac{z^H H z}{z^H B z}, \qquad \sum_i b_i z_i = 0, \f]
with the operator \f$ H \f$ of the conformal energy and \f$ B = \mathrm{diag}(b) \f$, half the
length of the border edges at each border vertex. It is the smallest eigenvalue but 0 of \f$ H z =
\lambda B z \f$, found by the locally optimal conjugate gradient method (Knyazev 2001),
preconditioned by the multigrid cycle of `HLSCM_parameterizer_3`.

No vertex is singled out: sizes vary less over the map than with two pins, and its energy is mostly
lower. The map comes with the area of the surface; of the two far vertices of the longest border
that `HLSCM_parameterizer_3` would pin, one lies at the origin and one on the positive u axis.

Options, report and requirements are those of `HLSCM_parameterizer_3`, `HLSCM_options::method` set
to `Conformal_method::SPECTRAL`. `HLSCM_options::tolerance` bounds the relative distance of the
quotient from its minimum. Where two eigenvalues nearly agree, maps of nearly the same energy may
look different.

\tparam TriangleMesh a model of `FaceGraph`
\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d` for the coarsest level
\tparam ConcurrencyTag `Sequential_tag` (default), `Parallel_tag` or `Parallel_if_available_tag`

\cgalModels{Parameterizer_3 of CGAL's Triangulated Surface Mesh Parameterization}
*/
template <class TriangleMesh_, class SolverTraits_ = Default, class ConcurrencyTag = Sequential_tag>
class Spectral_conformal_parameterizer_3
  : private HLSCM_parameterizer_3<TriangleMesh_, Default, SolverTraits_, ConcurrencyTag>
{
  typedef HLSCM_parameterizer_3<TriangleMesh_, Default, SolverTraits_, ConcurrencyTag> Base;

public:
#ifdef DOXYGEN_RUNNING
  typedef TriangleMesh_ Triangle_mesh; ///< The mesh.
  typedef SolverTraits_ Solver_traits; ///< What solves the coarsest level.

  /// Gives access to the options. The method must stay `Conformal_method::SPECTRAL`.
  HLSCM_options& options();
  /// Returns the report of the last run of this parameterizer or of a copy of it.
  const HLSCM_report& report() const;
  /// Computes the map; see `HLSCM_parameterizer_3::parameterize()`.
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                          VertexIndexMap vimap, VertexParameterizedMap vpmap);
  /// Computes the map; see `HLSCM_parameterizer_3::parameterize()`.
  template <class VertexUVMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap);
#else
  using typename Base::TriangleMesh;
  using typename Base::Triangle_mesh;
  using typename Base::Solver_traits;
  using typename Base::vertex_descriptor;
  using typename Base::halfedge_descriptor;
  using typename Base::Vertex_point_map;
  using typename Base::Kernel;
  using typename Base::Point_2;
  using Base::options;
  using Base::report;
  using Base::is_one_to_one_mapping;
  using Base::parameterize;
#endif

  /// Constructs the parameterizer; the method of the options is ignored.
  explicit Spectral_conformal_parameterizer_3(const HLSCM_options& options = HLSCM_options(),
                                              const Solver_traits& solver_traits = Solver_traits())
    : Base(options, typename Base::Border_parameterizer(), solver_traits)
  {
    Base::options().method = Conformal_method::SPECTRAL;
  }

  /// Constructs the parameterizer with an object that solves the coarsest level.
  explicit Spectral_conformal_parameterizer_3(const Solver_traits& solver_traits)
    : Spectral_conformal_parameterizer_3(HLSCM_options(), solver_traits)
  {}
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_SPECTRAL_CONFORMAL_PARAMETERIZER_3_H
