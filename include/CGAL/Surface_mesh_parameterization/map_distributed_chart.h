// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_DISTRIBUTED_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_DISTRIBUTED_CHART_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>
#ifdef CGAL_HLSCM_MPI_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_run.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <mpi.h>
#include <petscsys.h>
#include <sys/resource.h>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMParameterizer

The part of a chart that one rank of MPI has. Vertices have global numbers: those of rank 0 come
first, then those of rank 1, and so on. Triangles may be on any rank.
*/
struct Distributed_chart
{
  std::vector<std::array<double, 3>> points;           ///< of the vertices of this rank
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< global numbers of their vertices
};

/// \ingroup PkgHLSCMParameterizer
/// What one rank did in `map_distributed_chart()`.
struct Rank_report
{
  std::size_t vertices = 0;    ///< of the finest level on it
  double seconds_alone = 0.;   ///< of its own part of the work before the iteration, without waiting
  std::size_t peak_memory = 0; ///< of its process, in bytes
  std::size_t bytes_sent = 0;  ///< to other ranks, but for sums and the like
  std::size_t messages = 0;    ///< in which they were sent
};

/// \ingroup PkgHLSCMParameterizer
/// What `map_distributed_chart()` did: the same on all ranks but for the seconds, which are those
/// of the rank. `levels_in_files` are those that all ranks share; what is of files is 0.
struct Distributed_chart_report
  : Very_large_chart_report
{
  std::vector<Rank_report> ranks; ///< what each of them did
};

/*!
\ingroup PkgHLSCMParameterizer

Computes the least squares conformal map of a chart that is distributed over the ranks of MPI: that
of `conformal_map()` with its two far border pins, or without pins if the method is
`Conformal_method::SPECTRAL`, to the same tolerance, moved into the unit square. All ranks decimate
blocks of the surface and share the finer levels, on which PETSc iterates; rank 0 has the coarser
ones.

\param comm the ranks, all of which call this
\param chart what this rank has of a connected surface of genus 0 with one or more borders
\param uv becomes where the vertices of this rank are; (0, 0) for vertices without a face
\param options of these count: of `solver` what `Very_large_chart_options` says, `progress` that of
       rank 0, and 0 `threads` are one; `block_vertices` (0: 100000); `gathered_vertices`, up to
       which a level is rank 0's (0: 300000, or `memory` / 1300 if that is less); `work_folder`, where
       each rank keeps the levels that are finished, or none if it is empty; and `resumes`: whether
       such files of as many ranks are gone on from, if all of them see theirs

Blocks do not depend on the number of ranks: levels are the same but for ties that rounding decides,
and the map differs within the tolerance. Bad data on any rank is an error on all of them, in one
sentence; what `progress` throws is thrown on rank 0, and ends the others as if it had said stop. A
rank that ends, or has no memory left while others wait for it, ends all, as errors of PETSc do.

PETSc, with complex numbers, is begun on all ranks of MPI if it was not: if `comm` has not all of
them, begin it before. Who calls this ends it, before MPI.

Linear time but for the iterations, about 800 bytes for each vertex of a rank.
*/
CGAL_HLSCM_MPI_INLINE Distributed_chart_report
map_distributed_chart(MPI_Comm comm, const Distributed_chart& chart,
                      std::vector<std::array<double, 2>>& uv,
                      const Very_large_chart_options& options = Very_large_chart_options());

/*!
\ingroup PkgHLSCMParameterizer

The same for a file, as `map_very_large_chart()`: of the binary PLY file `input`, which all ranks
see, each reads its part; `put` and `options.finish` are called on rank 0, the latter with what
will be returned.
*/
CGAL_HLSCM_MPI_INLINE Distributed_chart_report
map_distributed_chart(MPI_Comm comm, const std::string& input,
                      const std::function<void(std::string_view)>& put,
                      const Very_large_chart_options& options = Very_large_chart_options());

#ifdef CGAL_HLSCM_MPI_DEFINITIONS

namespace internal {

// Calls `work(ranks, map)`, where `map(part)` returns the map of the vertices of a part, and
// reports what came of it.
template <class Work>
Distributed_chart_report map_parts(MPI_Comm comm, const Very_large_chart_options& options,
                                   const Work& work)
{
  const Blocked_execution::Stopwatch watch;
  const Blocked_execution::Thread_scope threads((std::max)(options.solver.threads, 1u));
  Distributed_chart_report report;
  Ranks ranks(comm);
  std::optional<Kept_levels> kept;
  try {
    begin_petsc();
    check_options(options.solver);
    const std::size_t bytes = petsc_bytes(), messages = petsc_messages();
    work(ranks, [&](Mesh_part part) {
      std::vector<std::array<double, 2>> uv;
      report.seconds_sort = watch.seconds();
      kept.emplace(ranks, options, part);
      Distributed_run run(ranks, options, *kept, report);
      try {
        run.map(std::move(part));
        uv = run.uv();
      } catch(const std::bad_alloc&) { // the others wait for what this rank should send
        MPI_Abort(comm, 1);
      }
      struct rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      report.ranks = ranks.all(Rank_report{
        run.number_of_vertices(), ranks.seconds_alone(), std::size_t(usage.ru_maxrss) * 1024,
        ranks.bytes_sent() + petsc_bytes() - bytes,
        ranks.messages_sent() + petsc_messages() - messages});
      return uv;
    });
    const bool is_finished = ranks.decided_by_first([&] {
      if(options.finish)
        options.finish(report);
      return true;
    });
    if(!is_finished)
      throw Streaming_failure(Streaming_failure::RESUMABLE, "the output cannot be finished");
    kept->remove();
  } catch(const Streaming_failure& failure) {
    report.error = failure.error;
    report.message = report.solver.message = failure.what();
    report.solver.converged = false;
    report.solver.cancelled = failure.kind == Streaming_failure::CANCELLED;
    if(kept && failure.kind == Streaming_failure::BAD_INPUT)
      kept->remove();
  }
  return report;
}

} // namespace internal

CGAL_HLSCM_MPI_INLINE Distributed_chart_report
map_distributed_chart(MPI_Comm comm, const Distributed_chart& chart,
                      std::vector<std::array<double, 2>>& uv,
                      const Very_large_chart_options& options)
{
  return internal::map_parts(comm, options, [&](internal::Ranks& ranks, const auto& map) {
    uv = map(internal::checked_part(ranks, chart.points, chart.triangles));
  });
}

CGAL_HLSCM_MPI_INLINE Distributed_chart_report
map_distributed_chart(MPI_Comm comm, const std::string& input,
                      const std::function<void(std::string_view)>& put,
                      const Very_large_chart_options& options)
{
  return internal::map_parts(comm, options, [&](internal::Ranks& ranks, const auto& map) {
    std::optional<internal::Ply_records> ply;
    ranks.together([&] { ply.emplace(input); });
    const auto uv = map(internal::read_part(ranks, *ply));
    ranks.together([&] { ply->check_that_it_stayed(); });
    internal::write_parts(ranks, *ply, uv, put);
  });
}

#endif // CGAL_HLSCM_MPI_DEFINITIONS

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_DISTRIBUTED_CHART_H
