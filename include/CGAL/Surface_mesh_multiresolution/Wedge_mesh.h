// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_WEDGE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_WEDGE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/triangle_numbers.h>

#include <CGAL/assertions.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Wedge_mesh` is a triangle mesh with texture coordinates whose triangles are given by
wedges, as in a level of a `Textured_progressive_mesh`: a wedge is a vertex with one texture
coordinate, and a vertex on a seam has several.

Invariant: `vertex` and `uv` have the same size; the entries of `vertex` are smaller than
`points.size()`, those of `triangles` smaller than `uv.size()`.
*/
struct Wedge_mesh
{
  typedef Textured_progressive_mesh::Point_2 Point_2; ///< a texture coordinate
  typedef Textured_progressive_mesh::Point_3 Point_3; ///< a point of the surface

  std::vector<Point_3> points;             ///< of each vertex
  std::vector<Vertex_index> vertex;        ///< of each wedge
  std::vector<Point_2> uv;                 ///< of each wedge
  std::vector<Triangle_indices> triangles; ///< the wedges of each triangle
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the number of triangles after `k` collapses. Linear time; `Level_extractor` knows it for
/// all `k`.
inline std::size_t number_of_triangles_after(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses());
  return internal::triangle_numbers(mesh)[mesh.number_of_wedges_after(k)];
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the mesh after `k` collapses, vertices and wedges numbered as in `mesh`. Linear time.
/// Precondition: `mesh.is_whole(k)`.
inline Wedge_mesh textured_level(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses() && mesh.is_whole(k));
  const std::size_t wedges = mesh.number_of_wedges_after(k);
  Wedge_mesh level;
  level.points.assign(mesh.points.begin(), mesh.points.begin() + mesh.number_of_vertices_after(k));
  level.vertex.assign(mesh.vertex.begin(), mesh.vertex.begin() + wedges);
  level.uv.assign(mesh.uv.begin(), mesh.uv.begin() + wedges);
  level.triangles = internal::level_triangles(mesh, k, internal::wedge_ancestors(mesh, 0, k));
  return level;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_WEDGE_MESH_H
