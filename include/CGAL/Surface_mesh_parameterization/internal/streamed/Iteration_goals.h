// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_ITERATION_GOALS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_ITERATION_GOALS_H

#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/methods.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Streaming_failure.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Refuses what cannot be done beyond the memory of one process.
inline void check_options(const HLSCM_options& options)
{
  if(!(options.tolerance > 0.))
    refuse("the tolerance must be positive");
  if(options.method != Conformal_method::HLSCM && options.method != Conformal_method::SPECTRAL)
    refuse(std::string("the method ") + profile_of(options.method).name
           + " needs the whole chart in memory; the methods hlscm and spectral do not");
}

// When the iteration on the finest level ends, as for a chart in memory, for a map of that extent.
inline Multigrid::Energy_stop energy_stop(const HLSCM_options& options, double extent)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = options.tolerance;
  stop.maximal_iterations = maximal_iterations(options, 500);
  stop.negligible_energy = rounded_energy * extent * extent;
  stop.change_tolerance = options.uv_tolerance * extent;
  return stop;
}

// The same on the coarser levels. The finest one takes as much time as all others, and corrects slowly
// what is wrong in those.
inline Multigrid::Energy_stop coarse_energy_stop(const HLSCM_options& options)
{
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.2 * options.tolerance;
  stop.maximal_iterations = 20;
  return stop;
}

// What is known of the rate on a level after the iteration on the next coarser one. From a good map
// the first steps gain so little that they would promise too fast an iteration.
inline double known_rate_after(const Multigrid::Iteration_report& coarser)
{
  return coarser.converged ? coarser.rate : 0.;
}

// Reports the iteration on the finest level; ends the run if it was in vain. `advice`: what to do,
// then.
inline void conclude_iteration(const Multigrid::Iteration_report& result, const std::string& advice,
                               HLSCM_report& report)
{
  report.iterations = result.iterations;
  report.converged = result.converged;
  report.energy_gap_estimate = result.energy_gap;
  if(result.cancelled)
    throw Streaming_failure(Streaming_failure::CANCELLED, "cancelled");
  if(!result.converged)
    throw Streaming_failure(Streaming_failure::RESUMABLE, "the tolerance was not met after "
                            + std::to_string(result.iterations) + " iterations; raise their number"
                            + advice, ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
}

inline double longer_side(const Bbox_2& box)
{
  return (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
}

// Moves maps with such a box into the unit square, as they are written.
class Unit_square
{
public:
  explicit Unit_square(const Bbox_2& box)
  {
    const double size = longer_side(box);
    if(!std::isfinite(size) || !(size > 0.))
      refuse("the map that was found has parameters that are not finite numbers; scale the mesh",
             ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
    m_scale = 1. / size;
    m_shift = {-m_scale * box.xmin(), -m_scale * box.ymin()};
  }

  std::array<double, 2> moved(const std::complex<double>& z) const
  {
    const auto inside = [](double x) { return (std::min)((std::max)(x, 0.), 1.); };
    return {inside(m_scale * z.real() + m_shift[0]), inside(m_scale * z.imag() + m_shift[1])};
  }
  void move_report(HLSCM_report& report) const
  {
    Surface_mesh_parameterization::move_report(report, m_scale, m_shift[0], m_shift[1]);
  }

private:
  double m_scale = 1.;
  std::array<double, 2> m_shift = {0., 0.};
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_ITERATION_GOALS_H
