// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_ARRAYS_H
#define CGAL_INDEXED_MESH_MESH_ARRAYS_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// Gives each vertex its position in `vertices(mesh)`; returns their number.
template <class TriangleMesh, class VertexPositionMap>
std::size_t number_vertices(const TriangleMesh& mesh, const VertexPositionMap& position)
{
  Vertex_index number = 0; // num_vertices() would count removed vertices
  for(const auto v : vertices(mesh))
    put(position, v, number++);
  return number;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the faces in the order of `faces(mesh)`. Precondition: they are triangles.
template <class TriangleMesh, class VertexPositionMap>
std::vector<Triangle_indices> copy_triangles(const TriangleMesh& mesh,
                                             const VertexPositionMap& position)
{
  std::vector<Triangle_indices> result;
  result.reserve(num_faces(mesh));
  for(const auto f : faces(mesh)) {
    const auto h0 = halfedge(f, mesh), h1 = next(h0, mesh), h2 = next(h1, mesh);
    CGAL_precondition(next(h2, mesh) == h0);
    result.push_back({Vertex_index(get(position, target(h0, mesh))),
                      Vertex_index(get(position, target(h1, mesh))),
                      Vertex_index(get(position, target(h2, mesh)))});
  }
  return result;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the points of the vertices in the order of `vertices(mesh)`, in double precision.
template <class TriangleMesh>
std::vector<Indexed_triangle_mesh::Point_3> copy_points(const TriangleMesh& mesh)
{
  std::vector<Indexed_triangle_mesh::Point_3> result;
  result.reserve(num_vertices(mesh));
  const auto vpm = get(CGAL::vertex_point, mesh);
  for(const auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    result.emplace_back(to_double(p[0]), to_double(p[1]), to_double(p[2]));
  }
  return result;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_MESH_ARRAYS_H
