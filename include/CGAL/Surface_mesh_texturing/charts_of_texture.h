// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHARTS_OF_TEXTURE_H
#define CGAL_SURFACE_MESH_TEXTURING_CHARTS_OF_TEXTURE_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Textured_triangle_mesh;

/*!
\ingroup PkgHLSCMTexturing

Returns the charts of a texture: an edge is a seam unless the texture coordinates of both its ends
are equal on both sides, whatever their indices. Charts need not be disks; see `cut_to_disks()`. None
for a mesh with a `mesh_error()` or `texture_error()`. Linear time.
*/
inline Face_charts charts_of_texture(const Textured_triangle_mesh& mesh)
{
  if(!mesh_error(mesh).empty() || !texture_error(mesh).empty())
    return {};
  const Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint8_t> seams(mesh.triangles.size(), 0);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h)
    if(adjacency.opposite(h) != no_halfedge && !is_smooth(mesh, h, adjacency.opposite(h)))
      internal::mark(seams, h);
  return charts_between(adjacency, std::move(seams));
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHARTS_OF_TEXTURE_H
