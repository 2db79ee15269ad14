// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_ARRAYS_H
#define CGAL_INDEXED_MESH_MESH_ARRAYS_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
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
/// Returns the points of the vertices in the order of `vertices(mesh)`, in double precision: those
/// of the named parameter `vertex_point_map`, `get(vertex_point, mesh)` by default.
template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
std::vector<Indexed_triangle_mesh::Point_3>
copy_points(const TriangleMesh& mesh, const NamedParameters& np = parameters::default_values())
{
  std::vector<Indexed_triangle_mesh::Point_3> result;
  result.reserve(num_vertices(mesh));
  const auto vpm
    = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_const_property_map(CGAL::vertex_point, mesh));
  for(const auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    result.emplace_back(to_double(p[0]), to_double(p[1]), to_double(p[2]));
  }
  return result;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the points and the faces of a mesh as arrays, with the named parameters of
/// `copy_points()`. Precondition: the faces are triangles.
template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
Indexed_triangle_mesh copy_mesh(const TriangleMesh& mesh,
                                const NamedParameters& np = parameters::default_values())
{
  const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
  number_vertices(mesh, position);
  return {copy_points(mesh, np), copy_triangles(mesh, position)};
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_MESH_ARRAYS_H
