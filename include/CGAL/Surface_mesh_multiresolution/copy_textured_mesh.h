// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <array>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the triangles of `mesh` with the texture coordinates of their corners. Vertices are numbered
as in `vertices(mesh)`, triangles as in `faces(mesh)`. Linear time.

\tparam TriangleMesh a model of `FaceListGraph` with a point property
\param mesh a triangle mesh
\param corner_uv a function that returns for a halfedge of a face the texture coordinate at its
       target in this face. With a map `m` of vertices that is
       `[&](auto h) { return get(m, target(h, mesh)); }`. For `mesh` with a `Seam_mesh` of type `S`
       above it, `seams`, and the map `m` of its vertices that `SMP::parameterize()` fills it is
       `[&](auto h) { return get(m, target(boost::graph_traits<S>::halfedge_descriptor(h), seams));
       }`

\pre all faces are triangles
*/
template <class TriangleMesh, class CornerUv>
Textured_triangle_mesh textured_triangle_mesh(const TriangleMesh& mesh, const CornerUv& corner_uv)
{
  Textured_triangle_mesh result;
  const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
  Indexed_mesh::number_vertices(mesh, position);
  result.points = Indexed_mesh::copy_points(mesh);
  result.triangles = Indexed_mesh::copy_triangles(mesh, position);
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    Triangle_indices wedges;
    for(Vertex_index& wedge : wedges) {
      const auto uv = corner_uv(h);
      wedge = Vertex_index(result.uv.size());
      result.uv.emplace_back(to_double(uv[0]), to_double(uv[1]));
      h = next(h, mesh);
    }
    result.wedges.push_back(wedges);
  }
  return result;
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Appends a level to a mesh.

\tparam TriangleMesh a model of `MutableFaceGraph` with a point property
\param mesh the progressive mesh
\param triangles triangles of its wedges that make up a whole level, or what a
       `Selectively_refined_mesh` shows
\param result where the level goes
\param corner_uvmap a model of `WritablePropertyMap` with the halfedge descriptor of `result` as key
       and `Point_2` as value: gets the texture coordinate at the target of each halfedge of a face

Linear time in the number of triangles and of vertices of the fine mesh.
*/
template <class TriangleMesh, class HalfedgeUVMap>
void copy_level(const Textured_progressive_mesh& mesh,
                const std::vector<Triangle_indices>& triangles, TriangleMesh& result,
                HalfedgeUVMap corner_uvmap)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  typedef typename boost::property_map_value<TriangleMesh, vertex_point_t>::type Point_3;
  const auto vpm = get(vertex_point, result);
  std::vector<vertex_descriptor> copies(mesh.points.size(), Graph_traits::null_vertex());
  for(const Triangle_indices& t : triangles) {
    std::array<vertex_descriptor, 3> face;
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = mesh.vertex[t[c]];
      if(copies[v] == Graph_traits::null_vertex()) {
        copies[v] = add_vertex(result);
        put(vpm, copies[v], Point_3(mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z()));
      }
      face[c] = copies[v];
    }
    const auto f = Euler::add_face(face, result);
    auto h = halfedge(f, result);
    while(target(h, result) != face[0])
      h = next(h, result);
    for(const Vertex_index w : t) {
      put(corner_uvmap, h, Point_2(mesh.uv[w].x(), mesh.uv[w].y()));
      h = next(h, result);
    }
  }
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_COPY_TEXTURED_MESH_H
