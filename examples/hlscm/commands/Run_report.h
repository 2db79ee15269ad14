// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_RUN_REPORT_H
#define HLSCM_PROGRAM_RUN_REPORT_H

#include "common/Program_options.h"

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>

#include <optional>
#include <string>
#include <vector>

namespace hlscm {

/// What a run of `parameterize` did. Pins and energies belong to the map that is written.
struct Run_report
{
  CGAL::Surface_mesh_parameterization::HLSCM_report solver;
  /// Of the surface to its map before it was scaled, if the method is low-stretch.
  std::optional<CGAL::Surface_mesh_parameterization::Low_stretch_report> stretch;
  CGAL::Surface_mesh_parameterization::Distortion_measures distortion;
  /// Of each connected component.
  std::vector<CGAL::Surface_mesh_texturing::Mapped_component> components;
  CGAL::Indexed_mesh::Soup_repairs repairs; ///< before it was mapped
  std::vector<std::string> warnings;
  double seconds_read = 0;    ///< reading and checking the file and building the mesh
  double seconds_measure = 0; ///< of the distortion
  double seconds_total = 0;   ///< all but reading and writing files and pictures
  double seconds_write = 0;   ///< the mesh; pictures are not included
  double peak_memory_mb = 0;  ///< of the process (2^20 bytes), before pictures
};

/// Peak memory of this process so far, in units of 2^20 bytes.
double peak_memory_mb();

/// Those that the report has, those of the solver, and what its numbers warn of.
std::vector<std::string> all_warnings(const Run_report& report);

std::string to_json(const Run_report& report, const Program_options& options);

/// The table for people.
std::string to_table(const Run_report& report, const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_RUN_REPORT_H
