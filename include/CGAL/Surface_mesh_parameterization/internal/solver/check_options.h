// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHECK_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHECK_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

inline const char* name_of(Conformal_method method)
{
  static const char* const names[] = {"hlscm", "spectral", "cascadic", "lscm", "direct"};
  return names[int(method)];
}

// Says in `chart` what is wrong with the options.
inline void check_options(const HLSCM_options& options, Chart& chart)
{
  if(!(options.tolerance > 0.))
    chart.fail(ERROR_WRONG_PARAMETER, "the tolerance must be positive");
  if(!(options.level_ratio == 0. || options.level_ratio > 1.))
    chart.fail(ERROR_WRONG_PARAMETER, "the ratio of levels must be greater than 1");
  if(!(options.angular_defect_bound > 0.))
    chart.fail(ERROR_WRONG_PARAMETER, "the bound of the angular defect must be positive");
  if(!(options.uv_tolerance >= 0.) || !(options.time_limit >= 0.))
    chart.fail(ERROR_WRONG_PARAMETER, "the uv tolerance and the time limit must not be negative");
  if(options.schedule && options.schedule->coarse_visits == 0)
    chart.fail(ERROR_WRONG_PARAMETER, "the schedule must visit the coarse level at least once");
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CHECK_OPTIONS_H
