// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Textured_triangle_mesh` is a triangle mesh with texture coordinates as four arrays.
Where the texture has a seam, a vertex has several wedges, as in `Textured_progressive_mesh`.

Invariant: `vertex` and `uv` have the same size; the entries of `vertex` are smaller than
`points.size()`, those of `triangles` smaller than `uv.size()`.
*/
struct Textured_triangle_mesh
{
  typedef Textured_progressive_mesh::Point_2 Point_2; ///< a texture coordinate
  typedef Textured_progressive_mesh::Point_3 Point_3; ///< a point of the surface

  std::vector<Point_3> points;             ///< of each vertex
  std::vector<Vertex_index> vertex;        ///< of each wedge
  std::vector<Point_2> uv;                 ///< of each wedge
  std::vector<Triangle_indices> triangles; ///< the wedges of each triangle
};

namespace internal {

// The ancestor of each wedge after k collapses, which are in the order of the wedges.
inline std::vector<Vertex_index> wedge_ancestors(const Textured_progressive_mesh& mesh,
                                                 std::size_t k)
{
  const std::size_t n = mesh.number_of_wedges(), kept = mesh.number_of_wedges_after(k);
  std::vector<Vertex_index> ancestor(n);
  for(Vertex_index w = 0; w < kept; ++w)
    ancestor[w] = w;
  for(Vertex_index w = Vertex_index(kept); w < n; ++w)
    ancestor[w] = ancestor[mesh.parent(w)];
  return ancestor;
}

inline Triangle_indices replaced(const Triangle_indices& t,
                                 const std::vector<Vertex_index>& ancestor)
{
  return {ancestor[t[0]], ancestor[t[1]], ancestor[t[2]]};
}

// The triangles of a level are the first ones: found by bisection.
inline std::size_t number_of_triangles_with(const Textured_progressive_mesh& mesh,
                                            const std::vector<Vertex_index>& ancestor)
{
  const std::vector<Triangle_indices>& triangles = mesh.progressive_mesh.triangles;
  const auto is_alive = [&ancestor](const Triangle_indices& fine) {
    const Triangle_indices t = replaced(fine, ancestor);
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  };
  return std::size_t(std::partition_point(triangles.begin(), triangles.end(), is_alive)
                     - triangles.begin());
}

// The triangles after the collapses that make these ancestors.
inline std::vector<Triangle_indices> level_triangles(const Textured_progressive_mesh& mesh,
                                                     const std::vector<Vertex_index>& ancestor)
{
  std::vector<Triangle_indices> result(number_of_triangles_with(mesh, ancestor));
  for(std::size_t t = 0; t < result.size(); ++t)
    result[t] = replaced(mesh.progressive_mesh.triangles[t], ancestor);
  return result;
}

} // namespace internal

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the number of triangles after `k` collapses. Time linear in the number of wedges.
inline std::size_t number_of_triangles_after(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses());
  return internal::number_of_triangles_with(mesh, internal::wedge_ancestors(mesh, k));
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the mesh after `k` collapses, vertices and wedges numbered as in `mesh`. Linear time.
/// Precondition: `mesh.is_whole(k)`.
inline Textured_triangle_mesh textured_level(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses() && mesh.is_whole(k));
  const std::size_t wedges = mesh.number_of_wedges_after(k);
  Textured_triangle_mesh level;
  level.points.assign(mesh.points.begin(), mesh.points.begin() + mesh.number_of_vertices_after(k));
  level.vertex.assign(mesh.vertex.begin(), mesh.vertex.begin() + wedges);
  level.uv.assign(mesh.uv.begin(), mesh.uv.begin() + wedges);
  level.triangles = internal::level_triangles(mesh, internal::wedge_ancestors(mesh, k));
  return level;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H
