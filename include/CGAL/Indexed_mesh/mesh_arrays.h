// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_ARRAYS_H
#define CGAL_INDEXED_MESH_MESH_ARRAYS_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/Default.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// Whether a sequence of named parameters has `geom_traits`.
template <class NamedParameters>
constexpr bool has_geom_traits
  = !std::is_same<typename internal_np::Lookup_named_param_def<internal_np::geom_traits_t,
                                                               NamedParameters, Default>::type,
                  Default>::value;

/// \ingroup PkgHLSCMIndexedMesh
/// Says whether a mesh has a face that is no triangle.
template <class FaceGraph>
std::string polygon_error(const FaceGraph& mesh)
{
  return is_triangle_mesh(mesh)
           ? std::string() : "not all faces are triangles; triangulate the mesh first";
}

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
/// Returns a point in double precision, with the named parameter `geom_traits` of `copy_points()`.
template <class Point, class NamedParameters>
Indexed_triangle_mesh::Point_3 double_point(const Point& p, const NamedParameters& np)
{
  typedef Indexed_triangle_mesh::Point_3 Result;
  if constexpr(has_geom_traits<NamedParameters>) {
    const auto& traits = parameters::get_parameter(np, internal_np::geom_traits);
    return Result(to_double(traits.compute_x_3_object()(p)),
                  to_double(traits.compute_y_3_object()(p)),
                  to_double(traits.compute_z_3_object()(p)));
  } else {
    (void)np;
    return Result(to_double(p[0]), to_double(p[1]), to_double(p[2]));
  }
}

/*!
\ingroup PkgHLSCMIndexedMesh

Returns the points of the vertices in the order of `vertices(mesh)`, in double precision.

\param np optional named parameters:
- `vertex_point_map`: the points; `get(vertex_point, mesh)` by default
- `geom_traits`: how they are read: a kernel, or any class with `compute_x_3_object()` and its kin,
  whose numbers `to_double()` takes. Without, `p[0]`, `p[1]` and `p[2]` are the coordinates of `p`.
*/
template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
std::vector<Indexed_triangle_mesh::Point_3>
copy_points(const TriangleMesh& mesh, const NamedParameters& np = parameters::default_values())
{
  std::vector<Indexed_triangle_mesh::Point_3> result;
  result.reserve(num_vertices(mesh));
  const auto vpm
    = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_const_property_map(CGAL::vertex_point, mesh));
  for(const auto v : vertices(mesh))
    result.push_back(double_point(get(vpm, v), np));
  return result;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns a point of another type: of its three coordinates, or, with the named parameter
/// `geom_traits`, what its `construct_point_3_object()` makes of them as numbers of its type `FT`.
template <class Point, class NamedParameters>
Point converted_point(const Indexed_triangle_mesh::Point_3& p, const NamedParameters& np)
{
  if constexpr(has_geom_traits<NamedParameters>) {
    const auto& traits = parameters::get_parameter(np, internal_np::geom_traits);
    typedef typename std::decay<decltype(traits)>::type::FT FT;
    return traits.construct_point_3_object()(FT(p.x()), FT(p.y()), FT(p.z()));
  } else {
    (void)np;
    return Point(p.x(), p.y(), p.z());
  }
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
