// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_CYCLE_H
#define CGAL_MULTIGRID_CYCLE_H

#include <CGAL/Multigrid/Schedule.h>

#include <cstddef>

namespace CGAL {
namespace Multigrid {

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

#endif // CGAL_MULTIGRID_CYCLE_H
