// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_DIAGNOSIS_H
#define HLSCM_PROGRAM_DIAGNOSIS_H

#include "common/Progress_bar.h"

#include <CGAL/Indexed_mesh/Soup_diagnosis.h>

#include <string>
#include <vector>

namespace hlscm {

using CGAL::Indexed_mesh::Polygon_soup;
using Diagnosis = CGAL::Indexed_mesh::Soup_diagnosis;
using Finding = CGAL::Indexed_mesh::Soup_finding;

/// Examines a soup in time and memory linear in its size.
Diagnosis diagnose(const Polygon_soup& soup, Progress_bar& progress);

/// Why a mesh cannot be parameterized, and what to do about it.
struct Obstacle
{
  std::string what;
  std::string remedy;
};

/// What keeps a mesh from being a surface, the obstacle to remove first at the front.
std::vector<Obstacle> surface_obstacles(const Diagnosis& diagnosis);

/// What keeps it from having an atlas: the same, but for vertices of no face, which are left out.
std::vector<Obstacle> atlas_obstacles(const Diagnosis& diagnosis);

/// All obstacles; empty for a chart.
std::vector<Obstacle> obstacles(const Diagnosis& diagnosis);

/// Throws `Program_error` for the first obstacle, if there is one.
void refuse_obstacles(const std::string& file, const std::vector<Obstacle>& obstacles);

} // namespace hlscm

#endif // HLSCM_PROGRAM_DIAGNOSIS_H
