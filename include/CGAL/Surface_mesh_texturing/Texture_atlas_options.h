// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OPTIONS_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_texturing/Atlas_packer.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `build_texture_atlas()`.
struct Texture_atlas_options
{
  /// How far charts may be distorted. Charts that are given are cut only if their maps are not
  /// one-to-one.
  Distortion_bound bound;
  /// The number of charts to come down to, beyond the bound on distortion if need be; 0 for as few
  /// as the bound allows. There are more only where a map would not be one-to-one otherwise, and of
  /// a surface with more components.
  std::size_t max_charts = 0;
  /// The part of its convex hull in the plane that a chart fills at least, as far as charts can be
  /// told apart: less means fewer charts, and more of the texture left empty.
  double least_fill = 0.75;
  /// Triangles of the level on which the charts are found.
  std::size_t coarse_faces = 4000;
  /// Meshes of more than four times as many triangles are made coarser to about so many first; the
  /// charts are found, mapped and, where need be, cut again there, since few of them then have to
  /// be cut again on the fine mesh.
  std::size_t trial_faces = 60000;
  /// The charts, if they are given; those that are no disks are cut.
  std::optional<Face_charts> charts;
  /// How charts are mapped: by default by `border_first_map()`, whose area scale varies least, as
  /// the charts were tried when they were found. A least squares method may need more charts within
  /// the same bound.
  std::optional<Surface_mesh_parameterization::Conformal_method> method;
  /// See `HLSCM_options::tolerance`.
  double tolerance = 1e-2;
  /// With a `method`, charts with fewer triangles are mapped by a direct solver all the same.
  std::size_t direct_faces = 20000;
  /// For each triangle the texels that it is to have along a unit of length, relative to others; a
  /// chart gets the mean over its area. Empty for equal texel density.
  std::vector<float> density;
  /// What places the charts in the textures.
  Atlas_packer packer = Atlas_packer::RASTER;
  /// The textures, and how charts are placed in them.
  Packing_options packing;
  /// Told the part done in [0, 1] from time to time; returning `false` cancels.
  std::function<bool(double)> progress;
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OPTIONS_H
