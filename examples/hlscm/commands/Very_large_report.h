// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_VERY_LARGE_REPORT_H
#define HLSCM_PROGRAM_VERY_LARGE_REPORT_H

#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>

#include <nlohmann/json.hpp>
#include <string>

namespace hlscm {

/// What is said of a chart beyond the memory of one process, in files or distributed over ranks.
struct Very_large_report
{
  const CGAL::Surface_mesh_parameterization::Very_large_chart_report& report;
  std::string input, output;
  double tolerance;
  bool is_distributed;

  /// The report of both programs; each adds what only it knows.
  nlohmann::ordered_json to_json() const;

  /// One line each.
  std::string levels() const;
  std::string energy() const;
  std::string seconds(int digits) const;
};

/// JSON as it is written.
std::string text_of(const nlohmann::ordered_json& json);

/// A number with so many digits after the point.
std::string rounded(double value, int digits);

} // namespace hlscm

#endif // HLSCM_PROGRAM_VERY_LARGE_REPORT_H
