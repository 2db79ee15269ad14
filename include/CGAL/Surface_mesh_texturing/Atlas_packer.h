// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_ATLAS_PACKER_H
#define CGAL_SURFACE_MESH_TEXTURING_ATLAS_PACKER_H

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Which model of `ChartPacker` packs an atlas.
enum class Atlas_packer
{
  RASTER, ///< `Raster_packer`
  HORIZON ///< `Horizon_packer`
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_ATLAS_PACKER_H
