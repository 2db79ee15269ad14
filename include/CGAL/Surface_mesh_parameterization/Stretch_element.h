// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ELEMENT_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ELEMENT_H

#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>
#include <CGAL/Surface_mesh_parameterization/stretch_energies.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

The struct `Plane_jacobian` is a linear map of the plane,
\f$ w \mapsto \alpha w + \beta \bar w \f$ in complex numbers. Its singular values are
\f$ |\alpha| \pm |\beta| \f$.
*/
template <class FT>
struct Plane_jacobian
{
  Plane_vector<FT> alpha; ///< the conformal part
  Plane_vector<FT> beta;  ///< the anticonformal part

  /// Constructs the map of these parts.
  Plane_jacobian(const Plane_vector<FT>& alpha, const Plane_vector<FT>& beta)
    : alpha(alpha), beta(beta) {}
  /// Constructs the map that takes the corners of `t` to `z`.
  Plane_jacobian(const Reference_triangle<FT>& t, const std::array<Plane_vector<FT>, 3>& z)
  {
    const Plane_vector<FT> a = z[1] - z[0], b = z[2] - z[0];
    const Plane_vector<FT> g1 = t.half_gradient(1), g2 = t.half_gradient(2);
    alpha = a.times(g1.conjugate()) + b.times(g2.conjugate());
    beta = a.times(g1) + b.times(g2);
  }

  /// Returns \f$ I = |J|^2 \f$.
  FT squared_norm() const { return FT(2) * (alpha.squared_length() + beta.squared_length()); }
  /// Returns \f$ D = \det J \f$.
  FT determinant() const { return alpha.squared_length() - beta.squared_length(); }
};

/// \ingroup PkgHLSCMStretch
/// What becomes of the second derivative of an energy that is not convex.
enum class Curvature
{
  EXACT,    ///< it stays as it is
  PROJECTED ///< negative eigenvalues become 0, as Newton's method wants it
};

/// \ingroup PkgHLSCMStretch
/// A symmetric or general 2 x 2 matrix, by rows.
template <class FT>
struct Plane_matrix
{
  FT xx = FT(0), xy = FT(0), yx = FT(0), yy = FT(0); ///< the entries
};

/*!
\ingroup PkgHLSCMStretch

The class `Stretch_element` is the energy \f$ A f(|J|^2, \det J) \f$ of a triangle with its first and
second derivatives by the places of its three corners, at a map.

In the parts \f$ \alpha, \beta \f$ of the Jacobian \f$ I = 2 (|\alpha|^2 + |\beta|^2) \f$ and
\f$ D = |\alpha|^2 - |\beta|^2 \f$, so that all modes of the second derivative are known: turning
\f$ \alpha \f$ has the eigenvalue \f$ t = 4 f_I + 2 f_D \f$ (the twist), turning \f$ \beta \f$ has
\f$ s = 4 f_I - 2 f_D \f$, and lengthening them a 2 x 2 matrix. Neither singular vectors nor
trigonometry are needed (compare Smith, de Goes and Kim 2019).

\tparam FT `double`, or a longer type
*/
template <class FT = double>
class Stretch_element
{
public:
  typedef Plane_vector<FT> Vector; ///< a vector of the plane
  typedef Plane_matrix<FT> Matrix; ///< a block of the second derivative

  /// Constructs one without a value, which may only be assigned to.
  Stretch_element() {}

  /// Constructs it for a map whose Jacobian on `t` is `jacobian`, of positive determinant.
  ///
  /// \tparam Energy a model of `StretchEnergy`
  template <class Energy>
  Stretch_element(const Reference_triangle<FT>& t, const Plane_jacobian<FT>& jacobian,
                  const Energy& energy, Curvature curvature)
    : Stretch_element(t.area(), jacobian, energy, curvature)
  {}

  /// Constructs it with another weight `w` than the area.
  template <class Energy>
  Stretch_element(const FT& w, const Plane_jacobian<FT>& jacobian, const Energy& energy,
                  Curvature curvature)
    : m_alpha(jacobian.alpha), m_beta(jacobian.beta)
  {
    const Stretch_jet<FT> f = energy(jacobian.squared_norm(), jacobian.determinant());
    m_value = w * f.value;
    m_twist_slope = w * (FT(4) * f.f_i + FT(2) * f.f_d);
    m_flip_slope = w * (FT(4) * f.f_i - FT(2) * f.f_d);
    m_twist = m_twist_slope;
    m_flip = m_flip_slope;
    m_aa = w * (FT(16) * (f.f_ii + f.f_id) + FT(4) * f.f_dd);
    m_bb = w * (FT(16) * (f.f_ii - f.f_id) + FT(4) * f.f_dd);
    m_ab = w * (FT(16) * f.f_ii - FT(4) * f.f_dd);
    if(curvature == Curvature::PROJECTED)
      project();
  }

  /// Returns the energy.
  const FT& value() const { return m_value; }

  /// Returns the derivative by the place of corner `j` of `t`, the triangle it was constructed with.
  Vector gradient(const Reference_triangle<FT>& t, int j) const { return gradient(t.half_gradient(j)); }

  /// Returns the derivative by the place of the corner whose `half_gradient()` is `g`.
  Vector gradient(const Vector& g) const
  {
    return g.times(m_alpha) * m_twist_slope + g.conjugate().times(m_beta) * m_flip_slope;
  }

  /// Returns the second derivative by the places of corners `j` and `k`.
  Matrix block(const Reference_triangle<FT>& t, int j, int k) const
  {
    return block(t.half_gradient(j), t.half_gradient(k));
  }

  /// Returns the second derivative by the places of the corners that have these half gradients.
  Matrix block(const Vector& gj, const Vector& gk) const
  {
    const Vector aj = gj.times(m_alpha), bj = gj.conjugate().times(m_beta);
    const Vector ak = gk.times(m_alpha), bk = gk.conjugate().times(m_beta);
    const Vector row_a = ak * m_aa + bk * m_ab, row_b = ak * m_ab + bk * m_bb;
    const Vector q = gj.times(gk.conjugate());
    const FT same = (m_twist + m_flip) * q.x, turn = (m_twist - m_flip) * q.y;
    return {same + aj.x * row_a.x + bj.x * row_b.x, -turn + aj.x * row_a.y + bj.x * row_b.y,
            turn + aj.y * row_a.x + bj.y * row_b.x, same + aj.y * row_a.y + bj.y * row_b.y};
  }

private:
  // Makes the second derivative positive semi-definite. The matrix of the lengths p = |alpha| and
  // q = |beta| is (t + aa p^2, ab p q; ab p q, s + bb q^2).
  void project()
  {
    using std::sqrt;
    const FT pp = m_alpha.squared_length(), qq = m_beta.squared_length();
    const FT twist = (std::max)(m_twist, FT(0)), flip = (std::max)(m_flip, FT(0));
    const FT a = m_twist + m_aa * pp, d = m_flip + m_bb * qq, pq = sqrt(pp * qq), b = m_ab * pq;
    if(a >= FT(0) && d >= FT(0) && a * d >= b * b) {
      if(twist != m_twist)
        m_aa = (a - twist) / pp;
      if(flip != m_flip && qq > FT(0))
        m_bb = (d - flip) / qq;
      m_twist = twist;
      m_flip = flip;
      return;
    }
    const FT mean = (a + d) / FT(2), half = (a - d) / FT(2), radius = sqrt(half * half + b * b);
    const FT upper = (std::max)(mean + radius, FT(0));
    // The part of the larger eigenvalue alone: upper times its unit vector times its transpose
    const FT c = radius > FT(0) ? half / radius : FT(1), e = radius > FT(0) ? b / radius : FT(0);
    const FT new_a = upper * (FT(1) + c) / FT(2), new_d = upper * (FT(1) - c) / FT(2);
    m_aa = (new_a - twist) / pp;
    m_bb = qq > FT(0) ? (new_d - flip) / qq : FT(0);
    m_ab = pq > FT(0) ? upper * e / (FT(2) * pq) : FT(0);
    m_twist = twist;
    m_flip = flip;
  }

  Vector m_alpha, m_beta;
  FT m_value;
  FT m_twist_slope, m_flip_slope; // the factors of alpha and beta in the gradient
  FT m_twist, m_flip;             // t, s
  FT m_aa, m_bb, m_ab;            // the coefficients of the products of alpha and beta
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ELEMENT_H
