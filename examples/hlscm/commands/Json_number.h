// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_JSON_NUMBER_H
#define HLSCM_PROGRAM_JSON_NUMBER_H

#include <nlohmann/json.hpp>

#include <cmath>

namespace hlscm {

/// A number in a report. JSON has no infinity.
inline nlohmann::ordered_json number(double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_JSON_NUMBER_H
