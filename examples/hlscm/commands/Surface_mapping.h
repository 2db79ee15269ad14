// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SURFACE_MAPPING_H
#define HLSCM_PROGRAM_SURFACE_MAPPING_H

#include "commands/Chart_solving.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "pictures/Level_snapshots.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>

#include <optional>
#include <vector>

namespace hlscm {

/// A surface in the plane, without pins in the unit square.
struct Mapped_surface
{
  CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh mesh;
  /// One for each connected component that was mapped.
  std::vector<CGAL::Surface_mesh_texturing::Mapped_component> components;
  /// Sums over the components, in the units of the map; or what is said of the only one.
  CGAL::Surface_mesh_parameterization::HLSCM_report report;
  /// Of the surface to its map before it was scaled, if the method is low-stretch.
  std::optional<CGAL::Surface_mesh_parameterization::Low_stretch_report> stretch;
  Similarity from_solver; ///< of the only component
};

/// Leaves only the component of `options.component`, if it is set. Returns the number of components
/// otherwise, and throws `Program_error` if there are not as many.
void choose_component(Input_surface& input, const Program_options& options);

/// Maps all of a surface; `snapshots` may be null, and sees the levels of a single component. Throws
/// `Program_error`, and may leave nothing of the surface then.
Mapped_surface map_input(Input_surface& input, const Program_options& options,
                         Level_snapshots* snapshots, Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SURFACE_MAPPING_H
