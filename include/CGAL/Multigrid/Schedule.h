// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SCHEDULE_H
#define CGAL_MULTIGRID_SCHEDULE_H

namespace CGAL {
namespace Multigrid {

/// \ingroup PkgHLSCMMultigrid
/// How the visits of a coarse level are combined.
enum class Acceleration
{
  NONE,  ///< one cycle after the other (V-cycle, W-cycle)
  KRYLOV ///< steps of a flexible conjugate gradient method (K-cycle; Notay and Vassilevski 2008)
};

/*!
\ingroup PkgHLSCMMultigrid

The struct `Schedule` holds the parameters of the general multigrid cycle, as in algorithm 1 of Ray
and Lévy 2003. All classic cycles are values of it.
*/
struct Schedule
{
  unsigned int pre_smoothing = 2;  ///< \f$ m_1 \f$: smoothing steps before the coarse correction
  unsigned int post_smoothing = 2; ///< \f$ m_2 \f$: smoothing steps after the coarse correction
  unsigned int coarse_visits = 2;  ///< \f$ m_c \f$: visits of the coarse level a cycle
  Acceleration acceleration = Acceleration::KRYLOV; ///< how these visits are combined

  /// Returns the cascade: \f$ m_1 = 0, m_c = 1 \f$.
  static Schedule cascade(unsigned int post) { return {0, post, 1, Acceleration::NONE}; }
  /// Returns the V-cycle: \f$ m_c = 1 \f$.
  static Schedule v_cycle(unsigned int pre, unsigned int post)
  {
    return {pre, post, 1, Acceleration::NONE};
  }
  /// Returns the W-cycle: \f$ m_c = 2 \f$.
  static Schedule w_cycle(unsigned int pre, unsigned int post)
  {
    return {pre, post, 2, Acceleration::NONE};
  }
  /// Returns the K-cycle with two steps on each coarse level.
  static Schedule k_cycle(unsigned int pre, unsigned int post)
  {
    return {pre, post, 2, Acceleration::KRYLOV};
  }
};

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SCHEDULE_H
