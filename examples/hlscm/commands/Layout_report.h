// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LAYOUT_REPORT_H
#define HLSCM_PROGRAM_LAYOUT_REPORT_H

#include "common/Program_options.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace hlscm {

/// What the options of the layout made of an atlas.
struct Layout_report
{
  std::size_t mirrored_charts = 0;           ///< of the input, packed anew
  std::size_t defective_charts = 0;          ///< of these, those that are not one-to-one
  std::vector<std::string> warnings;
  std::size_t parts = 0;                     ///< groups or materials that are limits of charts
  std::vector<std::string> page_names;       ///< the group or material of each page, if so asked for
  double least_density = 0, most_density = 0; ///< texels along a unit of length, of all charts
  double axis_parallel = 0;                  ///< the part of the borders of charts in the texture
  std::size_t tiles = 0;                     ///< of UDIM, from 1001 on
  std::size_t components = 0;                ///< of the input, if equal ones share something
  std::size_t halved_components = 0;         ///< of these, those whose halves count by themselves
  std::size_t copies = 0, mirrored_copies = 0; ///< of these, those that have what others have
  std::size_t charts_with_equals = 0;        ///< charts that another one is equal to
};

/// Adds them to the report, if there are such options.
void add_layout(const Layout_report& report, const Layout_settings& settings,
                nlohmann::ordered_json& json);

/// The lines for people.
void add_layout_lines(const Layout_report& report, const Layout_settings& settings,
                      std::ostream& text);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LAYOUT_REPORT_H
