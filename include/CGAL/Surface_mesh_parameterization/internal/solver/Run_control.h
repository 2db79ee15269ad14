// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_RUN_CONTROL_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_RUN_CONTROL_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

#include <string>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What makes one method different from the others before it is run.
struct Method_profile
{
  const char* name;
  double level_ratio; // by default; 0 if it has the finest level only
  bool has_cycle;
  bool has_pins;
};

inline const Method_profile& profile_of(Conformal_method method)
{
  static const Method_profile profiles[] = {{"hlscm", 4., true, true},
                                            {"spectral", 4., true, false},
                                            {"cascadic", 10., false, true},
                                            {"lscm", 0., false, true},
                                            {"direct", 0., false, true}};
  return profiles[int(method)];
}

// Says in `status` what is wrong with the options.
inline void check_options(const HLSCM_options& options, Status& status)
{
  if(!(options.tolerance > 0.))
    status.fail(ERROR_WRONG_PARAMETER, "the tolerance must be positive");
  if(!(options.level_ratio == 0. || options.level_ratio > 1.))
    status.fail(ERROR_WRONG_PARAMETER, "the ratio of levels must be greater than 1");
  if(!(options.angular_defect_bound > 0.))
    status.fail(ERROR_WRONG_PARAMETER, "the bound of the angular defect must be positive");
  if(!(options.uv_tolerance >= 0.) || !(options.time_limit >= 0.))
    status.fail(ERROR_WRONG_PARAMETER, "the uv tolerance and the time limit must not be negative");
  if(options.schedule && options.schedule->coarse_visits == 0)
    status.fail(ERROR_WRONG_PARAMETER, "the schedule must visit the coarse level at least once");
  if(options.weights == Conformal_weights::CGAL_LSCM && !options.metric.empty())
    status.fail(ERROR_WRONG_PARAMETER, "the weights of CGAL are those of the surface's own metric");
}

// A part of the work, and the stretch of the whole that progress is told for it.
struct Phase
{
  double begin, end;
};

namespace phases {

constexpr Phase decimation = {0.05, 0.6};
constexpr Phase operators = {0.65, 0.75};
constexpr Phase only_level = {0.75, 1.}; // of methods without coarse ones
constexpr Phase coarse_levels = {0.75, 0.8};
constexpr Phase finest_level = {0.8, 1.};
constexpr Phase repair = {0.9, 1.}; // if there is one: all that is before it takes less, then

} // namespace phases

// One run from chart to map, as the user meets it: what was asked for, how far it is, whether it
// goes on, what became of it. It refers to options and report.
class Run_control
{
public:
  Run_control(const HLSCM_options& options, HLSCM_report& report);

  const HLSCM_options& options() const { return m_options; }
  HLSCM_report& report() { return m_report; }
  Status& status() { return m_status; }
  const Status& status() const { return m_status; }

  // Begins again, but for what the report says of the chart and its levels.
  void restart()
  {
    m_status = Status();
    m_report.cancelled = m_report.stopped_early = m_report.converged = false;
    m_report.iterations = 0;
    m_progress.restart();
    m_watch.lap();
    m_since_begin.lap();
  }

  // Leaves the last phase to the repair of flips.
  void make_room_for_repair() { m_share = phases::repair.begin; }

  // Tells how far a phase is; returns whether the user lets the work go on.
  bool tell(const Phase& phase, double part)
  {
    return m_progress(m_share * phase.begin, m_share * phase.end, part);
  }
  bool tell_repair(double part)
  {
    return m_progress(phases::repair.begin, phases::repair.end, part);
  }

  // Whether nothing is left to do: because of an error, or because the user said so.
  bool is_stopped()
  {
    m_report.cancelled = m_report.cancelled || m_progress.is_cancelled();
    return m_report.cancelled || !m_status.is_ok();
  }

  // Whether the user wants the map as it is.
  bool is_enough()
  {
    if(m_options.time_limit > 0. && m_since_begin.seconds() > m_options.time_limit)
      m_report.stopped_early = true;
    return m_report.stopped_early;
  }

  // Adds the time since the last call to a stage of the report.
  void lap(double& seconds) { seconds += m_watch.lap(); }

  // Takes over what an iteration on the finest level came to. The energy is in units of `unit`.
  void conclude(const Multigrid::Iteration_report& result, double unit)
  {
    m_report.iterations = result.iterations;
    m_report.converged = result.converged;
    m_report.cancelled = result.cancelled && m_progress.is_cancelled();
    m_report.energy_gap_estimate = unit * result.energy_gap;
  }

  // The same for an iteration that must meet the tolerance.
  void conclude(const Multigrid::Iteration_report& result, double unit, const char* remedy)
  {
    conclude(result, unit);
    if(!result.cancelled && !result.converged)
      m_status.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "the tolerance was not met after "
                    + std::to_string(result.iterations) + " iterations; " + remedy);
  }

  // Completes the report; returns what the doors return.
  Error_code finish();

private:
  const HLSCM_options& m_options;
  HLSCM_report& m_report;
  Status m_status;
  Blocked_execution::Progress m_progress;
  Blocked_execution::Stopwatch m_watch, m_since_begin;
  double m_share = 1.; // of the whole, without the repair
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE Run_control::Run_control(const HLSCM_options& options, HLSCM_report& report)
  : m_options(options), m_report(report), m_progress(options.progress)
{
  m_report.method = profile_of(options.method).name;
  check_options(options, m_status);
}

CGAL_HLSCM_INLINE Error_code Run_control::finish()
{
  m_report.seconds_total
    = m_report.seconds_hierarchy + m_report.seconds_operators + m_report.seconds_solve;
  if(m_report.cancelled)
    m_status.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "cancelled");
  m_report.message = m_status.message;
  return m_status.error;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_RUN_CONTROL_H
