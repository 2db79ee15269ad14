// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_ELEMENT_MATRIX_H
#define CGAL_SURFACE_MESH_MULTIGRID_ELEMENT_MATRIX_H

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Surface_mesh_multigrid/Surface_hierarchy.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_multigrid {

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The struct `Element_matrix` is the part of a self-adjoint matrix that one triangle adds: a 3 x 3
matrix of entries at its corners.

\tparam Double an entry in double precision: `double`, `std::complex<double>` or a block
*/
template <class Double>
struct Element_matrix
{
  typedef typename Multigrid::Value_traits<Double>::Diagonal Diagonal; ///< a diagonal entry

  /// The diagonal entries at the corners.
  std::array<Diagonal, 3> diagonal;
  /// At `j` the entry of row \f$ j+1 \f$ and column \f$ j+2 \f$ (modulo 3), beside the edge opposite
  /// to corner `j`; the entry of row \f$ j+2 \f$ and column \f$ j+1 \f$ is its adjoint.
  std::array<Double, 3> beside;

  /// Constructs zeros.
  Element_matrix()
  {
    diagonal.fill(Multigrid::Value_traits<Diagonal>::zero());
    beside.fill(Multigrid::Value_traits<Double>::zero());
  }

  /// Adds `w` times the identity to the entries that make \f$ w |x_{j+1} - x_{j+2}|^2 \f$.
  void add_difference(int j, double w)
  {
    diagonal[(j + 1) % 3] += identity<Diagonal>(w);
    diagonal[(j + 2) % 3] += identity<Diagonal>(w);
    beside[j] -= identity<Double>(w);
  }

  /// Adds `w` times the identity to the diagonal entry of corner `j`.
  void add_diagonal(int j, double w) { diagonal[j] += identity<Diagonal>(w); }

private:
  template <class Entry>
  static Entry identity(double w)
  {
    if constexpr(Multigrid::Value_traits<Entry>::rows > 1)
      return w * Entry::Identity();
    else
      return Entry(w);
  }
};

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The struct `Laplace_element` is the element matrix of \f$ a K + b M \f$: \f$ K \f$ is the cotangent
Laplacian, positive semi-definite, and \f$ M \f$ the lumped mass, a third of the area of the faces
at a vertex. \f$ a = 1, b = 0 \f$ is Poisson's equation; \f$ b > 0 \f$ the screened one;
\f$ b = 1 \f$ a step of length \f$ a \f$ of implicit heat flow. Of vectors every component is taken
alike.

\cgalModels{SurfaceElement}
*/
struct Laplace_element
{
  double stiffness = 1.; ///< \f$ a \f$, a number
  double mass = 0.;      ///< \f$ b \f$, of the unit of one over an area, relative to \f$ a \f$

  /// Sets the element matrix.
  template <class Double>
  void operator()(const Surface_triangle& t, Element_matrix<Double>& e) const
  {
    for(int j = 0; j < 3; ++j)
      e.add_difference(j, 0.5 * stiffness * t.cotangent(j));
    if(mass != 0.)
      for(int j = 0; j < 3; ++j)
        e.add_diagonal(j, mass * t.area() / 3.);
  }
};

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The struct `Anisotropic_element` is the element matrix of \f$ \int \nabla u \cdot T \nabla u + b u^2
\f$ with a tensor \f$ T \f$ for each face and lumped mass.

\tparam Tensor a function object: `tensor(f)` is the symmetric positive semi-definite
        `Eigen::Matrix3d` of face `f`, in space; only its part in the plane of the face counts

\cgalModels{SurfaceElement}
*/
template <class Tensor>
struct Anisotropic_element
{
  Tensor tensor;    ///< \f$ T \f$
  double mass = 0.; ///< \f$ b \f$

  /// Sets the element matrix.
  template <class Double>
  void operator()(const Surface_triangle& t, Element_matrix<Double>& e) const
  {
    const Eigen::Matrix3d T = tensor(t.index);
    const auto side = [&t](int j) { // opposite to corner j
      const auto &p = t.points[(j + 1) % 3], &q = t.points[(j + 2) % 3];
      return Eigen::Vector3d((q.x() - p.x()) / t.unit(), (q.y() - p.y()) / t.unit(),
                             (q.z() - p.z()) / t.unit());
    };
    const Eigen::Vector3d normal = side(0).cross(side(1));
    const double twice_area = 2. * t.shape().area();
    if(!(normal.norm() > 0.)) { // of a needle only its length is known
      Laplace_element{T.trace() / 3., mass}(t, e);
      return;
    }
    std::array<Eigen::Vector3d, 3> g; // gradients of the hat functions times twice the area
    for(int j = 0; j < 3; ++j)
      g[j] = normal.normalized().cross(side(j));
    for(int j = 0; j < 3; ++j)
      e.add_difference(j, -g[(j + 1) % 3].dot(T * g[(j + 2) % 3]) / (2. * twice_area));
    for(int j = 0; j < 3; ++j)
      e.add_diagonal(j, mass * t.area() / 3.);
  }
};

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_ELEMENT_MATRIX_H
