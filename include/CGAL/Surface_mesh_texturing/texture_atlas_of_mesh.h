// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OF_MESH_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OF_MESH_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <CGAL/boost/graph/helpers.h>

#include <utility>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

Builds the texture atlas of a mesh of any type: see the other overload.

\tparam TriangleMesh a model of `FaceListGraph` with a point property
\param mesh the mesh; it is not changed
\param uvmap a model of `WritablePropertyMap` with the halfedge descriptor as key and a point with
       two coordinates as value: gets for each halfedge of a face the texture coordinate of the
       corner at its target. Coordinates of all pages lie in \f$ [0, 1]^2 \f$.
\param chartmap a model of `WritablePropertyMap` with the face descriptor as key and `std::size_t`
       as value: gets the chart of each face; the page of a chart is `atlas.page[chart]`
\param options the options; the triangles of `charts` and `density` come in the order of
       `faces(mesh)`

If there is an error, the maps are left as they are.
*/
template <class TriangleMesh, class HalfedgeUVMap, class FaceChartMap>
Texture_atlas_result build_texture_atlas(const TriangleMesh& mesh, HalfedgeUVMap uvmap,
                                         FaceChartMap chartmap,
                                         const Texture_atlas_options& options
                                         = Texture_atlas_options())
{
  namespace SMM = Surface_mesh_multiresolution;
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Uv;
  Texture_atlas_result result;
  if(!is_triangle_mesh(mesh)) {
    result.error = "not all faces are triangles; triangulate the mesh first";
    return result;
  }
  const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
  Indexed_mesh::number_vertices(mesh, position);
  result = build_texture_atlas(
    {Indexed_mesh::copy_points(mesh), Indexed_mesh::copy_triangles(mesh, position)}, options);
  if(!result.error.empty())
    return result;
  std::size_t t = 0;
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    for(const Vertex_index wedge : result.atlas.mesh.wedges[t]) {
      put(uvmap, h, Uv(result.atlas.mesh.uv[wedge].x(), result.atlas.mesh.uv[wedge].y()));
      h = next(h, mesh);
    }
    put(chartmap, f, std::size_t(result.atlas.charts.chart[t]));
    ++t;
  }
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_OF_MESH_H
