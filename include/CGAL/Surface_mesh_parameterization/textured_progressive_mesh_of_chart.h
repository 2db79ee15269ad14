// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

namespace internal {

typedef Surface_mesh_multiresolution::Textured_progressive_mesh_options Levels_options;
typedef Surface_mesh_multiresolution::Textured_progressive_mesh_result Levels_result;

// What is wrong with a chart of a mesh with `n` vertices, or nothing.
inline std::string chart_error(const Chart_progressive_mesh& chart, std::size_t n,
                               const Levels_options& options)
{
  if(!options.is_locked.empty() && options.is_locked.size() != chart.vertices.size())
    return "`is_locked` is not in the order of the chart's vertices";
  if(chart.vertices.empty() || chart.progressive_mesh.triangles.empty())
    return "the collapses of the chart were not kept; set HLSCM_options::keep_progressive_mesh";
  if(chart.vertices.size() != chart.progressive_mesh.number_of_vertices)
    return "the chart has not as many vertices as its collapses";
  for(const std::uint32_t v : chart.vertices)
    if(v >= n)
      return "the chart is not one of this mesh";
  return std::string();
}

// The levels, from the points and parameters of the chart's vertices.
template <class ConcurrencyTag>
Levels_result
levels_of_chart(const Chart_progressive_mesh& chart,
                std::vector<Surface_mesh_multiresolution::Textured_triangle_mesh::Point_3> points,
                std::vector<Surface_mesh_multiresolution::Textured_triangle_mesh::Point_2> uv,
                const Levels_options& options)
{
  Levels_result result = Surface_mesh_multiresolution::build_textured_progressive_mesh<ConcurrencyTag>(
    chart.progressive_mesh, std::move(points), std::move(uv), options);
  for(CGAL::Indexed_mesh::Vertex_index& v : result.mesh.source_vertex)
    v = chart.vertices[v];
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the progressive mesh of a chart and its map, all levels of which share the map as their
texture coordinates, from the collapses with which it was parameterized.

\tparam ConcurrencyTag as for `build_progressive_mesh()`
\param mesh the mesh that was parameterized
\param uvmap a model of `ReadablePropertyMap` with the vertex descriptor as key and the parameter as
       value
\param chart what `HLSCM_parameterizer_3::progressive_mesh()` returns
\param options see the other overloads; `is_locked` is in the order of `chart.vertices`
\param np `vertex_point_map` and `geom_traits`; see `Indexed_mesh::copy_points()`

A chart of another mesh, or one without collapses, and coordinates that are not finite give a result
with `error` set. Linear time.
*/
template <class ConcurrencyTag = Default, class TriangleMesh, class VertexUVMap,
          class NamedParameters = parameters::Default_named_parameters>
Surface_mesh_multiresolution::Textured_progressive_mesh_result
build_textured_progressive_mesh(
  const TriangleMesh& mesh, VertexUVMap uvmap, const Chart_progressive_mesh& chart,
  const Surface_mesh_multiresolution::Textured_progressive_mesh_options& options
  = Surface_mesh_multiresolution::Textured_progressive_mesh_options(),
  const NamedParameters& np = parameters::default_values())
{
  namespace SMM = Surface_mesh_multiresolution;
  SMM::Textured_progressive_mesh_result result;
  if(result.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
                 internal::chart_error(chart, num_vertices(mesh), options)))
    return result;
  const auto rank = Indexed_mesh::ranks(chart.vertices, num_vertices(mesh));
  std::vector<SMM::Textured_triangle_mesh::Point_3> points(chart.vertices.size());
  std::vector<SMM::Textured_triangle_mesh::Point_2> uv(chart.vertices.size());
  const auto vpm
    = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_const_property_map(CGAL::vertex_point, mesh));
  std::size_t position = 0;
  for(const auto v : vertices(mesh)) {
    const CGAL::Indexed_mesh::Vertex_index r = rank[position++];
    if(r == CGAL::Indexed_mesh::no_vertex)
      continue;
    const auto& q = get(uvmap, v);
    points[r] = Indexed_mesh::double_point(get(vpm, v), np);
    if(!Indexed_mesh::is_finite(points[r]))
      result.fail(Indexed_mesh::Mesh_status::BAD_MESH,
                  Indexed_mesh::not_finite_error("vertex " + std::to_string(position - 1)));
    uv[r] = SMM::Textured_triangle_mesh::Point_2(to_double(q[0]), to_double(q[1]));
  }
  return result.is_ok()
       ? internal::levels_of_chart<ConcurrencyTag>(chart, std::move(points), std::move(uv), options)
       : result;
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

The same for a mesh that is two arrays, with what `conformal_map()` returns: its `uv` and its
`progressive_mesh`.

\param points of the vertices of the mesh
\param uv their parameters
\param chart the collapses
\param options see above

Errors and time: as above, and arrays of another length.
*/
template <class ConcurrencyTag = Default>
Surface_mesh_multiresolution::Textured_progressive_mesh_result
build_textured_progressive_mesh(
  const std::vector<Surface_mesh_multiresolution::Textured_triangle_mesh::Point_3>& points,
  const std::vector<Surface_mesh_multiresolution::Textured_triangle_mesh::Point_2>& uv,
  const Chart_progressive_mesh& chart,
  const Surface_mesh_multiresolution::Textured_progressive_mesh_options& options
  = Surface_mesh_multiresolution::Textured_progressive_mesh_options())
{
  namespace SMM = Surface_mesh_multiresolution;
  SMM::Textured_progressive_mesh_result result;
  result.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
              Indexed_mesh::size_error("uv", uv.size(), points.size()));
  if(result.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
                 internal::chart_error(chart, points.size(), options)))
    return result;
  std::vector<SMM::Textured_triangle_mesh::Point_3> chart_points;
  std::vector<SMM::Textured_triangle_mesh::Point_2> chart_uv;
  for(const std::uint32_t v : chart.vertices) {
    if(!Indexed_mesh::is_finite(points[v])
       && result.fail(Indexed_mesh::Mesh_status::BAD_MESH,
                      Indexed_mesh::not_finite_error("vertex " + std::to_string(v))))
      return result;
    chart_points.push_back(points[v]);
    chart_uv.push_back(uv[v]);
  }
  return internal::levels_of_chart<ConcurrencyTag>(chart, std::move(chart_points),
                                                   std::move(chart_uv), options);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_TEXTURED_PROGRESSIVE_MESH_OF_CHART_H
