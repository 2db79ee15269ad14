// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SCHEDULE_H
#define CGAL_MULTIGRID_SCHEDULE_H

#include <cstddef>

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

/*!
\ingroup PkgHLSCMMultigrid

Runs one multigrid cycle on the system \f$ A_l u_l = f_l \f$ of `level`, from the present
\f$ u_l \f$. It is algorithm 1 of Ray and Lévy 2003, whose line numbers stand below; level 0 is the
coarsest.

\tparam Levels a model of `MultigridLevels`
*/
template <class Levels>
void cycle(Levels& levels, const Schedule& schedule, std::size_t level)
{
  if(level == 0) { // 1
    levels.solve_coarsest(); // 2
    return;
  }
  levels.smooth(level, schedule.pre_smoothing);  // 4
  levels.restrict_residual(level);               // 5, 6: f of level - 1; its u becomes 0
  const auto coarse_cycle = [&] { cycle(levels, schedule, level - 1); };
  if(schedule.acceleration == Acceleration::KRYLOV && level > 1)
    levels.accelerate(level - 1, schedule.coarse_visits, coarse_cycle); // 7
  else // another visit of the coarsest level would change nothing
    for(unsigned int visit = 0; visit < (level > 1 ? schedule.coarse_visits : 1u); ++visit)
      coarse_cycle();                            // 7
  levels.correct(level);                         // 8, 9
  levels.smooth(level, schedule.post_smoothing); // 10
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SCHEDULE_H
