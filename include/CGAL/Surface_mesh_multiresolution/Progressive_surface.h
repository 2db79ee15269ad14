// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_SURFACE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_SURFACE_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <numeric>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Progressive_surface` is a progressive mesh with its points. If the mesh was bad, it has no
collapses; if it was cancelled, those so far.

\sa `level_after()`, `copy_level()`: its levels as meshes
\sa `coarse_first()`: with a numbering for files and for levels in no time
*/
struct Progressive_surface
  : Indexed_mesh::Mesh_outcome
{
  /// The collapses. Vertices are numbered as in `vertices(mesh)`, triangles as in `faces(mesh)`.
  Progressive_mesh progressive_mesh;
  /// The position of each vertex.
  std::vector<Indexed_triangle_mesh::Point_3> points;
};

/// \ingroup PkgHLSCMMultiresolution
/// Returns the mesh after `k` collapses; sets `source_vertex` to the number that each of its
/// vertices has in the fine mesh, ascending. Linear time in the size of the fine mesh.
/// \pre `k` is at most the number of collapses
inline Indexed_triangle_mesh level_after(const Progressive_surface& surface, std::size_t k,
                                         std::vector<Vertex_index>& source_vertex)
{
  const Progressive_mesh& pm = surface.progressive_mesh;
  Indexed_triangle_mesh level;
  source_vertex.clear();
  std::vector<Vertex_index> number = removal_times(pm);
  for(Vertex_index v = 0; v < number.size(); ++v)
    if(number[v] > k) {
      number[v] = Vertex_index(source_vertex.size());
      source_vertex.push_back(v);
      level.points.push_back(surface.points[v]);
    }
  level.triangles = triangles_after(pm, k);
  for(Triangle_indices& t : level.triangles)
    t = {number[t[0]], number[t[1]], number[t[2]]};
  return level;
}

/// \ingroup PkgHLSCMMultiresolution
/// Returns the mesh after `k` collapses; see the other overload.
inline Indexed_triangle_mesh level_after(const Progressive_surface& surface, std::size_t k)
{
  std::vector<Vertex_index> source_vertex;
  return level_after(surface, k, source_vertex);
}

/*!
\ingroup PkgHLSCMMultiresolution

Appends the mesh after `k` collapses to a mesh, vertices and faces in the order of the fine mesh.

\tparam TriangleMesh a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of named parameters
\param surface the progressive mesh
\param k a number of collapses
\param result where the level goes
\param np `vertex_point_map`: where the points go, `get(vertex_point, result)` by default;
       `geom_traits`: what makes them, see `Indexed_mesh::converted_point()`

\return what is wrong, and nothing is appended: the mesh was bad, or there are fewer collapses

Linear time in the size of the fine mesh.
*/
template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
Indexed_mesh::Mesh_outcome copy_level(const Progressive_surface& surface, std::size_t k,
                                      TriangleMesh& result,
                                      const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename GetVertexPointMap<TriangleMesh, NamedParameters>::type Vertex_point_map;
  typedef typename boost::property_traits<Vertex_point_map>::value_type Point_3;
  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, result));
  Mesh_outcome outcome;
  if(surface.status != Mesh_status::CANCELLED)
    outcome.fail(surface);
  if(k > surface.progressive_mesh.collapses.size())
    outcome.fail(Mesh_status::BAD_OPTIONS,
                 "there is no level after " + std::to_string(k) + " collapses");
  if(!outcome.is_ok())
    return outcome;
  const Indexed_triangle_mesh level = level_after(surface, k);
  std::vector<vertex_descriptor> copies;
  copies.reserve(level.points.size());
  for(const auto& p : level.points) {
    copies.push_back(add_vertex(result));
    put(vpm, copies.back(), Indexed_mesh::converted_point<Point_3>(p, np));
  }
  for(const Triangle_indices& t : level.triangles)
    Euler::add_face(std::array<vertex_descriptor, 3>{copies[t[0]], copies[t[1]], copies[t[2]]},
                    result);
  return outcome;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns `surface` as a `Textured_progressive_mesh` without texture: with the numbering that makes
the vertices and triangles of each level the first ones, for `Level_extractor`,
`Selectively_refined_mesh` and `write_progressive_mesh()`. Linear time.
*/
inline Textured_progressive_mesh coarse_first(const Progressive_surface& surface)
{
  Textured_progressive_mesh mesh;
  mesh.progressive_mesh = surface.progressive_mesh;
  mesh.points = surface.points;
  mesh.vertex.resize(surface.points.size());
  std::iota(mesh.vertex.begin(), mesh.vertex.end(), Vertex_index(0));
  return coarse_first(mesh);
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_SURFACE_H
