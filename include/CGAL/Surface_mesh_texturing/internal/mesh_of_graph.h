// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MESH_OF_GRAPH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MESH_OF_GRAPH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <CGAL/Default.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Textured_triangle_mesh;

namespace internal {

template <class FaceGraph>
Mesh_outcome polygon_error(const FaceGraph& mesh, const std::string& name)
{
  if(is_triangle_mesh(mesh))
    return {};
  return {Mesh_status::BAD_MESH,
          "not all faces of " + name + " are triangles; triangulate it first"};
}

// What keeps these two from being baked; empty if nothing does.
template <class FineMesh, class LightMesh>
Mesh_outcome polygon_error_of_models(const FineMesh& fine, const LightMesh& light)
{
  const Mesh_outcome result = polygon_error(fine, "the fine mesh");
  return result.is_ok() ? polygon_error(light, "the light model") : result;
}

// The arrays of a mesh with texture coordinates. `uvmap` has a halfedge as key, which stands for the
// corner at its target, or a vertex.
template <class FaceGraph, class UVMap, class NamedParameters>
Textured_triangle_mesh textured_arrays_of_graph(const FaceGraph& mesh, const UVMap& uvmap,
                                                const NamedParameters& np)
{
  typedef typename boost::graph_traits<FaceGraph>::halfedge_descriptor Halfedge_descriptor;
  typedef typename boost::property_traits<UVMap>::key_type Key;
  if constexpr(std::is_same<Key, Halfedge_descriptor>::value) {
    return Surface_mesh_multiresolution::with_wedges(
      Surface_mesh_multiresolution::textured_triangle_mesh(mesh, uvmap, np));
  } else {
    Indexed_triangle_mesh arrays = Indexed_mesh::copy_mesh(mesh, np);
    Textured_triangle_mesh result;
    result.points = std::move(arrays.points);
    result.triangles = result.wedges = std::move(arrays.triangles);
    for(const auto v : vertices(mesh)) {
      const auto& uv = get(uvmap, v);
      result.uv.emplace_back(to_double(uv[0]), to_double(uv[1]));
    }
    return result;
  }
}

// Calls f(t, c, h) for the edge between the corners c and c + 1 of each triangle t.
template <class FaceGraph, class Function>
void for_each_side(const FaceGraph& mesh, const Function& f)
{
  std::size_t t = 0;
  for(const auto face : faces(mesh)) {
    auto h = halfedge(face, mesh); // towards corner 0
    for(int c = 0; c < 3; ++c) {
      h = next(h, mesh);
      f(t, c, h);
    }
    ++t;
  }
}

template <class NamedParameters>
constexpr bool has_constrained_edges
  = !std::is_same<typename internal_np::Lookup_named_param_def<internal_np::edge_is_constrained_t,
                                                               NamedParameters, Default>::type,
                  Default>::value;

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MESH_OF_GRAPH_H
