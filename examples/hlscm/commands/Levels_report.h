// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LEVELS_REPORT_H
#define HLSCM_PROGRAM_LEVELS_REPORT_H

#include "writing/Level_of_detail.h"
#include "common/Program_options.h"

#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm {

/// What a run of `levels` did.
struct Levels_report
{
  CGAL::Indexed_mesh::Soup_repairs repairs; ///< before all else
  std::vector<std::string> warnings;
  std::optional<CGAL::Surface_mesh_parameterization::HLSCM_report> solver; ///< if it was needed
  std::size_t faces = 0, vertices = 0, wedges = 0; ///< of the fine mesh
  std::size_t smallest_faces = 0;
  std::vector<std::pair<std::string, std::size_t>> files; ///< names, and sizes in bytes
  double seconds_read = 0, seconds_parameterize = 0, seconds_build = 0, seconds_measure = 0,
         seconds_write = 0;
  double peak_memory_mb = 0; ///< of the process (2^20 bytes), before pictures
};

std::string to_json(const Levels_report& report, const std::vector<Level_of_detail>& levels,
                    const Program_options& options);

/// The table for people.
std::string to_table(const Levels_report& report, const std::vector<Level_of_detail>& levels,
                     const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LEVELS_REPORT_H
