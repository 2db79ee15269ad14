// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_VERY_LARGE_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_VERY_LARGE_CHART_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_run.h>
#endif

#include <CGAL/tags.h>

#include <functional>
#include <new>
#include <string>
#include <string_view>

namespace CGAL {
namespace Surface_mesh_parameterization {

namespace internal {

// As the public function.
CGAL_HLSCM_INLINE Very_large_chart_report
map_streamed_chart(const std::string& input, const std::function<void(std::string_view)>& put,
                   const Very_large_chart_options& options);

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE Very_large_chart_report
map_streamed_chart(const std::string& input, const std::function<void(std::string_view)>& put,
                   const Very_large_chart_options& options)
{
  Very_large_chart_report report;
  try {
    check_options(options.solver);
    Streamed_run run(input, options, report);
    try {
      run.map();
      run.write(put);
    } catch(const Streaming_failure& failure) {
      if(failure.kind == Streaming_failure::BAD_INPUT)
        run.discard();
      throw;
    }
  } catch(const Streaming_failure& failure) {
    report.error = failure.error;
    report.message = report.solver.message = failure.what();
    report.solver.converged = false;
    report.solver.cancelled = failure.kind == Streaming_failure::CANCELLED;
  } catch(const std::bad_alloc&) {
    report.error = ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
    report.message = report.solver.message = "there is not enough memory for this run, begin anew and "
                                             "let it use less";
    report.solver.converged = false;
  }
  return report;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMParameterizer

Computes the least squares conformal map of a chart that is too large for the memory: that of
`conformal_map()` with its two far border pins, or without pins if the method is
`Conformal_method::SPECTRAL`, to the same tolerance, by the same hierarchy. It is
cut along a space-filling curve into blocks that are decimated one after the other, level by level,
until a level fits; the others are in files, over which each iteration makes five passes.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.solver.threads` threads; by
        default that, in programs that are linked with TBB

\param input a binary PLY file of triangles, little or big endian, without lists but the vertices of
       the faces: a connected surface of genus 0 with one or more borders
\param put is given the bytes of the output, a binary PLY file: the vertices of the input in their
       order with texture coordinates in the unit square, (0, 0) for vertices without a face, and the
       faces. It is not called before all is known to be well.
\param options what the run may take, and where its files are

Bad data of any kind, a full disk and damaged files are errors, in one sentence. The files stay when
there is something to resume: after a full disk, too few iterations, or `progress` that said stop, or
if the process was killed; not after what is wrong with the input.

The input must not change until the function returns; that it did is an error if it is seen.

Linear time but for the iterations; for POSIX systems. On a file system that copies on write the
promise of room on a full disk may be broken by it, and with it the process.
*/
template <class ConcurrencyTag = Parallel_if_available_tag>
Very_large_chart_report
map_very_large_chart(const std::string& input, const std::function<void(std::string_view)>& put,
                     const Very_large_chart_options& options)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.solver.threads);
  return internal::map_streamed_chart(input, put, options);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_VERY_LARGE_CHART_H
