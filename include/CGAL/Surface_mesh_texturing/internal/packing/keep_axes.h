// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_KEEP_AXES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_KEEP_AXES_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/rasterize_outline.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// If charts may only be turned by quarters: makes the axes of their planes the directions that are
// tried, the long side of the bounding box along x, and returns the options with four of them.
inline Packing_options keep_axes(Packing_options options, std::vector<Chart_outline>& outlines)
{
  if(!options.quarter_turns_only)
    return options;
  options.rotations = 4;
  for(Chart_outline& outline : outlines) {
    const auto box = bounding_box(outline, Rotation_and_scale(0., 1.));
    outline.angle = box[1][0] - box[0][0] < box[1][1] - box[0][1] ? 0.5 * CGAL_PI : 0.;
  }
  return options;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_KEEP_AXES_H
