// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LOW_STRETCH_H
#define HLSCM_PROGRAM_LOW_STRETCH_H

#include "common/Program_options.h"
#include "common/Progress_bar.h"

#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <vector>

namespace hlscm {

/// Maps a connected component of genus 0 with a border with little stretch, in a metric of its
/// triangles or, if that is empty, in its own; what it says of energies is in `stretch`. `start` may be
/// empty. Throws `Program_error`.
CGAL::Surface_mesh_parameterization::Conformal_map
map_with_low_stretch(const Program_options& options,
                     CGAL::Indexed_mesh::Indexed_triangle_mesh component,
                     const std::vector<CGAL::Surface_mesh_parameterization::HLSCM_pin>& pins,
                     std::vector<CGAL::Indexed_mesh::Space_tensor> metric,
                     std::vector<CGAL::Simple_cartesian<double>::Point_2> start,
                     CGAL::Surface_mesh_parameterization::Low_stretch_report& stretch,
                     Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LOW_STRETCH_H
