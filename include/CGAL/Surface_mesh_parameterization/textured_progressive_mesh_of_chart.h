// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H

#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Chart_progressive_mesh.h>

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the progressive mesh of a chart and its map, all levels of which share the map as their
texture coordinates, from the collapses with which it was parameterized.

\param mesh the mesh that was parameterized
\param uvmap a model of `ReadablePropertyMap` with the vertex descriptor as key and the parameter as
       value
\param chart what `HLSCM_parameterizer_3::progressive_mesh()` returns
\param options see the other overloads; `is_locked` is in the order of `chart.vertices`

Linear time.
*/
template <class TriangleMesh, class VertexUVMap>
Surface_mesh_multiresolution::Textured_progressive_mesh_result
build_textured_progressive_mesh(
  const TriangleMesh& mesh, VertexUVMap uvmap, const Chart_progressive_mesh& chart,
  const Surface_mesh_multiresolution::Textured_progressive_mesh_options& options
  = Surface_mesh_multiresolution::Textured_progressive_mesh_options())
{
  namespace SMM = Surface_mesh_multiresolution;
  const auto rank = Indexed_mesh::ranks(chart.vertices, num_vertices(mesh));
  std::vector<SMM::Textured_triangle_mesh::Point_3> points(chart.vertices.size());
  std::vector<SMM::Textured_triangle_mesh::Point_2> uv(chart.vertices.size());
  const auto vpm = get(CGAL::vertex_point, mesh);
  std::size_t position = 0;
  for(const auto v : vertices(mesh)) {
    const CGAL::Indexed_mesh::Vertex_index r = rank[position++];
    if(r == CGAL::Indexed_mesh::no_vertex)
      continue;
    const auto& p = get(vpm, v);
    const auto& q = get(uvmap, v);
    points[r] = SMM::Textured_triangle_mesh::Point_3(to_double(p[0]), to_double(p[1]),
                                                     to_double(p[2]));
    uv[r] = SMM::Textured_triangle_mesh::Point_2(to_double(q[0]), to_double(q[1]));
  }
  SMM::Textured_progressive_mesh_result result
    = SMM::build_textured_progressive_mesh(chart.progressive_mesh, std::move(points),
                                           std::move(uv), options);
  for(CGAL::Indexed_mesh::Vertex_index& v : result.mesh.source_vertex)
    v = chart.vertices[v];
  return result;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H
