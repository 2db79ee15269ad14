// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_REPORT_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_REPORT_H

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// What became of one chart.
struct Chart_report
{
  std::size_t faces = 0;         ///< its triangles
  double border_length = 0.;     ///< of its border and of the seams within it, in units of the mesh
  Chart_distortion distortion;   ///< of its map
  std::size_t repaired_flips = 0;///< triangles that were flipped before its map was repaired
  bool is_one_to_one = true;     ///< whether its map is one-to-one, by exact predicates
  std::size_t page = 0;          ///< its texture
};

/*!
\ingroup PkgHLSCMTexturing

What `build_texture_atlas()` did, and what came of it.
*/
struct Texture_atlas_report
{
  std::vector<Chart_report> charts; ///< of each chart
  /// Charts of the first segmentation that failed on the fine mesh and were cut again.
  std::size_t recut_charts = 0;
  double seam_length = 0.;     ///< of all seams, each once, without the border of the surface
  /// Of the whole atlas, in texels to units of length: so `area_scale_range` compares charts too.
  Surface_mesh_parameterization::Distortion_measures distortion;
  double texels_per_unit = 0.; ///< mean texels along a unit of length of the mesh
  double utilisation = 0.;     ///< area of all triangles to that of the pages
  double seconds_segment = 0.; ///< time of the segmentation
  double seconds_map = 0.;     ///< time of the maps, their validation, and of cutting charts again
  double seconds_pack = 0.;    ///< time of the packing
  double seconds_total = 0.;   ///< time of all
  bool cancelled = false;      ///< whether the progress function said stop
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_REPORT_H
