// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ENERGIES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ENERGIES_H

#include <cmath>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_parameterization {

// Legend: J is the Jacobian of a map with the singular values s1 >= s2 > 0,
// I = |J|^2 = s1^2 + s2^2, D = det J = s1 s2.

/*!
\ingroup PkgHLSCMStretch

The struct `Stretch_jet` has the derivatives of an energy \f$ f(I, D) \f$ by
\f$ I = |J|^2 = \sigma_1^2 + \sigma_2^2 \f$ and \f$ D = \det J = \sigma_1 \sigma_2 \f$.
*/
template <class FT>
struct Stretch_jet
{
  FT value;    ///< \f$ f \f$
  FT f_i, f_d; ///< first derivatives
  FT f_ii, f_id, f_dd; ///< second derivatives
};

/*!
\ingroup PkgHLSCMStretch

The symmetric Dirichlet energy \f$ |J|^2 + |J^{-1}|^2 = I (1 + 1 / D^2) \f$ (Smith and Schaefer 2015,
equation 5; Schreiner et al. 2004). It is at least 4, which isometries have; it counts what is too
small as much as what is too large.

\cgalModels{StretchEnergy}
*/
struct Symmetric_dirichlet_energy
{
  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const { return i * (FT(1) + FT(1) / (d * d)); }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    const FT r = FT(1) / d, rr = r * r, irr = i * rr;
    return {i + irr, FT(1) + rr, FT(-2) * irr * r, FT(0), FT(-2) * rr * r, FT(6) * irr * rr};
  }
};

/*!
\ingroup PkgHLSCMStretch

The MIPS energy \f$ \sigma_1 / \sigma_2 + \sigma_2 / \sigma_1 = I / D \f$ (Hormann and Greiner 2000,
section 3). It is at least 2, which conformal maps have, of whatever scale.

\cgalModels{StretchEnergy}
*/
struct Mips_energy
{
  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const { return i / d; }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    const FT r = FT(1) / d, ir = i * r;
    return {ir, r, -ir * r, FT(0), -r * r, FT(2) * ir * r * r};
  }
};

/*!
\ingroup PkgHLSCMStretch

The energy \f$ (\sigma_1 / \sigma_2 + \sigma_2 / \sigma_1)
(\sigma_1 \sigma_2 + 1 / (\sigma_1 \sigma_2))^\theta = I / D \cdot (D + 1 / D)^\theta \f$
(Degener, Meseth and Klein 2003, section 3): MIPS with a weight for areas. \f$ \theta = 0 \f$ is
MIPS, \f$ \theta = 1 \f$ the symmetric Dirichlet energy, a larger one keeps areas better and angles
worse. It is at least \f$ 2^{1 + \theta} \f$.

\cgalModels{StretchEnergy}
*/
struct Area_weighted_mips_energy
{
  double theta = 2.; ///< \f$ \theta \geq 0 \f$

  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const
  {
    using std::pow;
    return i / d * pow(d + FT(1) / d, FT(theta));
  }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    using std::pow;
    // f = I h(D), h = (D + 1/D)^theta / D: h' = h k, h'' = h (k^2 + k')
    const FT th(theta), r = FT(1) / d, s = d + r, p = (FT(1) - r * r) / s;
    const FT h = pow(s, th) * r, k = th * p - r;
    const FT p1 = FT(2) * r * r * r / s - p * p; // p'
    const FT k1 = th * p1 + r * r;
    const FT h1 = h * k, h2 = h * (k * k + k1);
    return {i * h, h, i * h1, FT(0), h1, i * h2};
  }
};

/*!
\ingroup PkgHLSCMStretch

The energy \f$ |J - R|^2 = (\sigma_1 - 1)^2 + (\sigma_2 - 1)^2 = I - 2 \sqrt{I + 2 D} + 2 \f$, where
\f$ R \f$ is the nearest rotation: "as rigid as possible" (Liu et al. 2008, equation 2). It is at
least 0. It does not grow when a triangle collapses: its minimum among maps without flips may have
triangles that almost do.

\cgalModels{StretchEnergy}
*/
struct Arap_energy
{
  static constexpr bool has_barrier = false; ///< see `Has_barrier`

  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const
  {
    using std::sqrt;
    return i - FT(2) * sqrt(i + FT(2) * d) + FT(2);
  }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    using std::sqrt;
    const FT q = i + FT(2) * d, s = sqrt(q), r = FT(1) / s, c = r / (FT(2) * q);
    return {i - FT(2) * s + FT(2), FT(1) - r, FT(-2) * r, c, FT(2) * c, FT(4) * c};
  }
};

/*!
\ingroup PkgHLSCMStretch

The class `Powered_energy` is a power \f$ f^p \f$ of another energy: the larger \f$ p \f$, the more
the worst triangles count, and the more evenly distortion is spread. Of MIPS it is what the
exponential of AMIPS (Fu, Liu and Guo 2015) is for, without its overflow.

\tparam Energy a model of `StretchEnergy` of no negative values

\cgalModels{StretchEnergy}
*/
template <class Energy>
struct Powered_energy
{
  Energy energy = Energy(); ///< \f$ f \f$
  double power = 4.;        ///< \f$ p \geq 1 \f$

  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const
  {
    using std::pow;
    return pow(energy.value(i, d), FT(power));
  }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    using std::pow;
    const Stretch_jet<FT> f = energy(i, d);
    const FT p(power), first = p * pow(f.value, p - FT(1));
    const FT second = p * (p - FT(1)) * pow(f.value, p - FT(2));
    return {pow(f.value, p), first * f.f_i, first * f.f_d,
            first * f.f_ii + second * f.f_i * f.f_i, first * f.f_id + second * f.f_i * f.f_d,
            first * f.f_dd + second * f.f_d * f.f_d};
  }
};

/*!
\ingroup PkgHLSCMStretch

The class `Barrier_energy` adds \f$ w I / D^2 = w |J^{-1}|^2 \f$ to another energy: it then grows without
bound when a triangle collapses, as that of ARAP does not.

\tparam Energy a model of `StretchEnergy`

\cgalModels{StretchEnergy}
*/
template <class Energy>
struct Barrier_energy
{
  Energy energy = Energy(); ///< the other energy
  double weight = 0.01;     ///< \f$ w > 0 \f$

  /// Returns the energy.
  template <class FT>
  FT value(const FT& i, const FT& d) const { return energy.value(i, d) + FT(weight) * i / (d * d); }

  /// Returns the energy and its derivatives.
  template <class FT>
  Stretch_jet<FT> operator()(const FT& i, const FT& d) const
  {
    const Stretch_jet<FT> f = energy(i, d);
    const FT r = FT(1) / d, wrr = FT(weight) * r * r;
    return {f.value + wrr * i, f.f_i + wrr, f.f_d - FT(2) * wrr * r * i,
            f.f_ii, f.f_id - FT(2) * wrr * r, f.f_dd + FT(6) * wrr * r * r * i};
  }
};

/// \ingroup PkgHLSCMStretch
/// Whether an energy grows without bound when a triangle collapses: unless it says that it does not, by
/// a member `has_barrier` that is `false`.
template <class Energy, class = void>
struct Has_barrier : std::true_type {};

/// \cond SKIP_IN_MANUAL
template <class Energy>
struct Has_barrier<Energy, std::void_t<decltype(Energy::has_barrier)>>
  : std::bool_constant<Energy::has_barrier> {};
/// \endcond

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_STRETCH_ENERGIES_H
