// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H

#include <CGAL/Indexed_mesh/prepare_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

namespace internal {

// What keeps triangles of wedges from being a surface.
inline Mesh_outcome level_error(const Textured_progressive_mesh& mesh,
                                const std::vector<Triangle_indices>& triangles)
{
  Mesh_outcome result;
  if(result.fail(Mesh_status::BAD_OPTIONS, index_error(triangles, mesh.number_of_wedges())))
    return result;
  Indexed_triangle_mesh level = {mesh.points, {}};
  std::vector<Vertex_index> source(mesh.points.size());
  std::iota(source.begin(), source.end(), Vertex_index(0));
  for(const Triangle_indices& t : triangles)
    level.triangles.push_back(replaced(t, mesh.vertex));
  drop_unused_vertices(level, source);
  if(!result.fail(Mesh_status::BAD_OPTIONS, repeated_vertex_error(level.triangles)))
    result.fail(Mesh_status::BAD_OPTIONS, ring_error(Vertex_rings(level), source));
  return result;
}

// Appends triangles to a mesh; `use(h, w)` is called for each halfedge with its wedge.
template <class TriangleMesh, class NamedParameters, class Use>
Mesh_outcome append_level(const Textured_progressive_mesh& mesh,
                          const std::vector<Triangle_indices>& triangles, TriangleMesh& result,
                          const NamedParameters& np, const Use& use)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename GetVertexPointMap<TriangleMesh, NamedParameters>::type Vertex_point_map;
  typedef typename boost::property_traits<Vertex_point_map>::value_type Point_3;
  const Mesh_outcome outcome = level_error(mesh, triangles);
  if(!outcome.is_ok())
    return outcome;
  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, result));
  std::vector<vertex_descriptor> copies(mesh.points.size(), Graph_traits::null_vertex());
  for(const Triangle_indices& t : triangles) {
    std::array<vertex_descriptor, 3> face;
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = mesh.vertex[t[c]];
      if(copies[v] == Graph_traits::null_vertex()) {
        copies[v] = add_vertex(result);
        put(vpm, copies[v], Indexed_mesh::converted_point<Point_3>(mesh.points[v], np));
      }
      face[c] = copies[v];
    }
    const auto f = Euler::add_face(face, result);
    auto h = halfedge(f, result);
    while(target(h, result) != face[0])
      h = next(h, result);
    for(const Vertex_index w : t) {
      use(h, w);
      h = next(h, result);
    }
  }
  return outcome;
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns a progressive mesh of `mesh` all levels of which share its texture coordinates; see
`build_textured_progressive_mesh()` of a `Textured_triangle_mesh`.

\tparam ConcurrencyTag as for `build_progressive_mesh()`
\tparam TriangleMesh a model of `FaceListGraph`
\param mesh a triangle mesh; faces that are no triangles are an error, too
\param corner_uv as for `textured_triangle_mesh()`
\param options where to stop, and what must stay
\param np `vertex_point_map` and `geom_traits`; see `Indexed_mesh::copy_points()`
*/
template <class ConcurrencyTag = Default, class TriangleMesh, class CornerUv,
          class NamedParameters = parameters::Default_named_parameters>
Textured_progressive_mesh_result
build_textured_progressive_mesh(const TriangleMesh& mesh, const CornerUv& corner_uv,
                                const Textured_progressive_mesh_options& options,
                                const NamedParameters& np = parameters::default_values())
{
  Textured_progressive_mesh_result result;
  if(result.fail(Mesh_status::BAD_MESH, Indexed_mesh::polygon_error(mesh)))
    return result;
  return build_textured_progressive_mesh<ConcurrencyTag>(
    textured_triangle_mesh(mesh, corner_uv, np), options);
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Appends a level to a mesh.

\tparam TriangleMesh a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of named parameters
\param mesh the progressive mesh
\param triangles triangles of its wedges that make up a whole level, or what a
       `Selectively_refined_mesh` shows
\param result where the level goes
\param corner_uvmap a model of `WritablePropertyMap` with the halfedge descriptor of `result` as key
       and `Point_2` as value: gets the texture coordinate at the target of each halfedge of a face;
       nothing if there is no texture
\param np `vertex_point_map`: where the points go, `get(vertex_point, result)` by default;
       `geom_traits`: what makes them, see `Indexed_mesh::converted_point()`

\return what is wrong, and nothing is appended: a triangle has a wedge that does not exist, or the
        triangles are no manifold, as those of a level that is not whole

Linear time in the number of triangles and of vertices of the fine mesh.
*/
template <class TriangleMesh, class HalfedgeUVMap,
          class NamedParameters = parameters::Default_named_parameters>
Indexed_mesh::Mesh_outcome
copy_level(const Textured_progressive_mesh& mesh, const std::vector<Triangle_indices>& triangles,
           TriangleMesh& result, HalfedgeUVMap corner_uvmap,
           const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  return internal::append_level(mesh, triangles, result, np, [&](const auto h, Vertex_index w) {
    if(mesh.has_texture())
      put(corner_uvmap, h, Point_2(mesh.uv[w].x(), mesh.uv[w].y()));
  });
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Appends a level to a mesh that gets no texture coordinates, at `get(vertex_point, result)`.
template <class TriangleMesh>
Indexed_mesh::Mesh_outcome
copy_level(const Textured_progressive_mesh& mesh, const std::vector<Triangle_indices>& triangles,
           TriangleMesh& result)
{
  return internal::append_level(mesh, triangles, result, parameters::default_values(),
                                [](const auto, Vertex_index) {});
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H
