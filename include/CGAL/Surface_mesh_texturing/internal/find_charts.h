// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FIND_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FIND_CHARTS_H

#include <CGAL/Surface_mesh_texturing/grow_charts.h>
#include <CGAL/Surface_mesh_texturing/segment_into_charts.h>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Charts that are grown on a level of so many triangles. The progress is that of the growth.
inline Segmentation_result find_charts(const Indexed_triangle_mesh& mesh,
                                       const Chart_growth_options& growth, std::size_t coarse_faces)
{
  Segmentation_options options;
  options.coarse_faces = coarse_faces;
  return segment_into_charts(mesh, options, [&growth](const Indexed_triangle_mesh& coarse) {
    return grow_charts(coarse, growth);
  });
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FIND_CHARTS_H
