// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_LEVEL_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_LEVEL_H

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the level of `mesh` after `k` collapses as a mesh of its own, with `extractor`, which is one
of `mesh`. Time proportional to its size.

\pre `mesh.is_whole(k)`.
*/
inline Textured_triangle_mesh textured_level(const Textured_progressive_mesh& mesh,
                                             const Level_extractor& extractor, std::size_t k)
{
  CGAL_precondition(mesh.is_whole(k));
  Textured_triangle_mesh result;
  result.points.assign(mesh.points.begin(),
                       mesh.points.begin() + std::ptrdiff_t(mesh.number_of_vertices_after(k)));
  result.uv.assign(mesh.uv.begin(),
                   mesh.uv.begin() + std::ptrdiff_t(mesh.number_of_wedges_after(k)));
  result.wedges = extractor.triangles(k);
  result.triangles = result.wedges;
  for(Triangle_indices& t : result.triangles)
    for(Vertex_index& v : t)
      v = mesh.vertex[v];
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_LEVEL_H
