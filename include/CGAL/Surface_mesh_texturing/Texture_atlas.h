// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Textured_triangle_mesh;
using Surface_mesh_multiresolution::vertices_of_wedges;

/*!
\ingroup PkgHLSCMTexturing

The struct `Texture_atlas` is a mesh with its charts side by side in one or several textures.

Invariants: `mesh.triangles` are those of the surface, in their order; the texture coordinates lie
in \f$ [0, 1]^2 \f$ of the page of their chart, one for each wedge (see `with_wedges()`); no two
triangles on a page overlap.
*/
struct Texture_atlas
{
  Textured_triangle_mesh mesh;     ///< the surface with its texture coordinates
  Face_charts charts;              ///< of its triangles
  std::vector<std::uint32_t> page; ///< of each chart
  std::size_t number_of_pages = 0; ///< textures
  std::size_t width = 0;           ///< of a page, in texels
  std::size_t height = 0;          ///< of a page, in texels
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H
