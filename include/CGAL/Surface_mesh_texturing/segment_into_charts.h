// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H

#include <CGAL/Surface_mesh_texturing/grow_charts.h>
#include <CGAL/Surface_mesh_texturing/segment_coarse_to_fine.h>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

Returns charts of `mesh`, which are disks with straight seams, within a bound on their distortion:
`segment_coarse_to_fine()` with `grow_charts()` on the coarse mesh. Errors: those of both.
*/
inline Segmentation_result
segment_into_charts(const Indexed_triangle_mesh& mesh,
                    const Segmentation_options& options = Segmentation_options(),
                    const Chart_growth_options& growth = Chart_growth_options())
{
  return segment_coarse_to_fine(mesh, options, [&growth](const Indexed_triangle_mesh& coarse) {
    return grow_charts(coarse, growth);
  });
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
