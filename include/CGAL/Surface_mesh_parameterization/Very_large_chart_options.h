// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_VERY_LARGE_CHART_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_VERY_LARGE_CHART_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <cstddef>
#include <functional>
#include <string>

namespace CGAL {
namespace Surface_mesh_parameterization {

struct Very_large_chart_report;

/// \ingroup PkgHLSCMParameterizer
/// The options of `map_very_large_chart()`.
struct Very_large_chart_options
{
  /// Vertices may go whatever their angular defect: so many are pointed by noise alone where there are
  /// very many vertices that coarse levels would consist of them.
  Very_large_chart_options() { solver.angular_defect_bound = 360.; }

  /// What the solver is told: `method`, `HLSCM` or `SPECTRAL`, `tolerance`, `uv_tolerance`,
  /// `maximal_iterations`, `level_ratio`, `coarsest_size`, `angular_defect_bound`, `threads` and
  /// `progress`; others do not count.
  HLSCM_options solver;
  /// Bytes of memory that it should do with. Beside blocks and the levels in memory, a bit a vertex
  /// and the border count; the system's own copies of files do not.
  std::size_t memory = std::size_t(4) << 30;
  /// Vertices of a block at most, but for blocks of 200; 0: as many as the memory allows.
  std::size_t block_vertices = 0;
  /// Vertices of the first level that is taken into memory at most; 0: as many as the memory allows.
  std::size_t gathered_vertices = 0;
  /// The folder of the files of the run, which it creates and removes. It should be on the disk of
  /// the output, and needs about 150 bytes a face.
  std::string work_folder;
  /// Whether the run goes on from the last finished level of one that was ended, whose files are
  /// still in the folder; if there are none, it begins.
  bool resumes = false;
  /// Called when all of the output was put, before the files are removed: it may give the output its
  /// name. What it throws leaves the files, and the function.
  std::function<void(const Very_large_chart_report&)> finish;
};

/*!
\ingroup PkgHLSCMParameterizer

What `map_very_large_chart()` did, and what came of it.
*/
struct Very_large_chart_report
{
  Error_code error = OK;              ///< `OK`, or what went wrong
  std::string message;                ///< one sentence on it; empty if nothing did
  HLSCM_report solver;                ///< as of `HLSCM_parameterizer_3`, for the map that was written
  std::size_t flipped_faces = 0;      ///< faces of negative area in the map, by an exact predicate
  std::size_t blocks = 0;             ///< of the finest level
  std::size_t levels_in_files = 0;    ///< those that did not fit into the memory
  std::size_t finished_before = 0;    ///< of these, those that an earlier run had finished
  double seconds_sort = 0.;           ///< time of reading the input and of sorting all levels
  double seconds_write = 0.;          ///< time of writing the output
  std::size_t bytes_of_files = 0;     ///< of the work folder at its largest
  std::size_t bytes_read = 0;         ///< from disks, as far as the system counts; else 0
  std::size_t bytes_written = 0;      ///< to disks, the same
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_VERY_LARGE_CHART_OPTIONS_H
