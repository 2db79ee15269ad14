// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_ERROR_H
#define CGAL_INDEXED_MESH_MESH_ERROR_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// What came of a function that takes meshes.
enum class Mesh_status
{
  OK,          ///< all is well
  BAD_MESH,    ///< a mesh, a chart or its texture coordinates are not what the function takes
  BAD_OPTIONS, ///< an option makes no sense, or an array is not one of this mesh
  CANCELLED,   ///< `progress` said stop
  FAILED       ///< the input is good, but no result was found or could be written
};

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Mesh_outcome` says whether a function succeeded, and why not. All results that may have
an error derive from it.

Two functions say it otherwise: parameterizers have an `Error_code`, which CGAL's concept
`Parameterizer_3` asks for, and readers of progressive mesh files a `Progressive_mesh_file_status`,
since what they could read of a file is a good mesh.

Invariant: there is a sentence unless `status` is `OK`.
*/
struct Mesh_outcome
{
  Mesh_status status = Mesh_status::OK; ///< what came of it
  std::string error;                    ///< what is wrong, as a sentence; empty if all is well

  /// Returns whether nothing is wrong.
  bool is_ok() const { return error.empty(); }

  /// Takes a sentence that says what is wrong, if it says so and none was before; returns whether
  /// something is wrong then.
  bool fail(Mesh_status why, std::string sentence)
  {
    if(error.empty() && !sentence.empty()) {
      status = why;
      error = std::move(sentence);
    }
    return !is_ok();
  }

  /// Takes over what another outcome says is wrong. A sentence alone says that it has failed.
  bool fail(const Mesh_outcome& other)
  {
    return fail(other.status == Mesh_status::OK ? Mesh_status::FAILED : other.status, other.error);
  }

  /// Says that it was cancelled.
  void cancel() { fail(Mesh_status::CANCELLED, "cancelled"); }
};

// What can be wrong with a mesh, as one set of sentences for all packages. Each function returns a
// sentence on the first thing that is wrong, or nothing if all is well. The mesh may have a name,
// such as "the fine mesh", where several are there.

/// \ingroup PkgHLSCMIndexedMesh
/// Returns " of " and the name of a mesh, if it has one.
inline std::string of_mesh(const std::string& name) { return name.empty() ? name : " of " + name; }

/// \ingroup PkgHLSCMIndexedMesh
/// Says that something has a number, a coordinate unless another `entry` is named, that is not finite.
inline std::string not_finite_error(const std::string& what,
                                    const std::string& entry = "a coordinate")
{
  return what + " has " + entry + " that is not a finite number";
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns whether all coordinates of a point are finite numbers.
inline bool is_finite(const Indexed_triangle_mesh::Point_3& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says which vertex has a coordinate that is not a finite number.
inline std::string point_error(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                               const std::string& name = {})
{
  for(std::size_t v = 0; v < points.size(); ++v)
    if(!is_finite(points[v]))
      return not_finite_error("vertex " + std::to_string(v) + of_mesh(name));
  return {};
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says which triangle has a vertex that is none of the first `n`.
inline std::string index_error(const std::vector<Triangle_indices>& triangles, std::size_t n,
                               const std::string& name = {})
{
  for(std::size_t t = 0; t < triangles.size(); ++t)
    for(const Vertex_index v : triangles[t])
      if(v >= n)
        return "triangle " + std::to_string(t) + of_mesh(name)
             + " has a vertex that does not exist";
  return {};
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says which triangle has a vertex twice.
inline std::string repeated_vertex_error(const std::vector<Triangle_indices>& triangles)
{
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle_indices& v = triangles[t];
    if(v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      return "triangle " + std::to_string(t) + " has a vertex twice";
  }
  return {};
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says that a mesh has no triangles.
inline std::string no_triangles_error(const std::string& name = {})
{
  return (name.empty() ? "the mesh" : name) + " has no triangles";
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says what is wrong with the arrays of a mesh, which may be `Indexed_triangle_mesh` or one with
/// texture coordinates: no triangles, an index out of range, a coordinate that is not finite. Linear
/// time.
template <class Mesh>
std::string mesh_error(const Mesh& mesh, const std::string& name = {})
{
  if(mesh.triangles.empty())
    return no_triangles_error(name);
  const std::string error = index_error(mesh.triangles, mesh.points.size(), name);
  return error.empty() ? point_error(mesh.points, name) : error;
}

/// \ingroup PkgHLSCMIndexedMesh
/// What there is to say of a mesh whose vertices all lie in one point.
constexpr const char* no_extent_error = "all edges are without length";

/// \ingroup PkgHLSCMIndexedMesh
/// Says whether an array, by its name, has another number of entries than there are `things`.
inline std::string size_error(const std::string& name, std::size_t entries, std::size_t number,
                              const std::string& things = "vertices")
{
  return entries == number ? std::string()
                           : name + " has " + std::to_string(entries) + " entries for "
                               + std::to_string(number) + " " + things;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says whether a metric has another number of tensors than there are triangles.
inline std::string metric_size_error(std::size_t tensors, std::size_t triangles)
{
  return tensors == triangles ? std::string()
                              : "the metric has " + std::to_string(tensors) + " tensors, but there are "
                                  + std::to_string(triangles) + " triangles";
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says whether a metric, unless it is empty, has not a tensor for each triangle, or which triangle
/// gets no lengths or no area by its tensor, though it has them in space. `number` has for each triangle
/// its number in the input; without, they are the same.
inline std::string metric_error(const Indexed_triangle_mesh& mesh,
                                const std::vector<Space_tensor>& metric,
                                const std::vector<Triangle_index>& number = {})
{
  const auto is_good = [](double in_metric, double in_space) {
    return std::isfinite(in_metric) && (in_metric > 0. || !(in_space > 0.));
  };
  if(!metric.empty() && metric.size() != mesh.triangles.size())
    return metric_size_error(metric.size(), mesh.triangles.size());
  for(std::size_t t = 0; t < metric.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const auto a = mesh.points[v[1]] - mesh.points[v[0]], b = mesh.points[v[2]] - mesh.points[v[0]];
    const auto n = cross_product(a, b);
    if(!is_good(metric[t].product(a, a), a * a) || !is_good(metric[t].product(b, b), b * b)
       || !is_good(metric[t].plane_determinant(n), n * n))
      return "the metric of triangle " + std::to_string(number.empty() ? t : number[t])
           + " is not positive definite, or not finite";
  }
  return {};
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says which vertex has no single fan of triangles. `source` has for each vertex of the rings its
/// number in the input; without, they are the same.
inline std::string ring_error(const Vertex_rings& rings,
                              const std::vector<Vertex_index>& source = {})
{
  if(rings.defect() == Ring_defect::NONE)
    return {};
  const Vertex_index v = rings.defective_vertex();
  const std::string vertex = "vertex " + std::to_string(source.empty() ? v : source[v]);
  if(rings.defect() == Ring_defect::ISOLATED)
    return vertex + " has no face; remove it first";
  if(rings.defect() == Ring_defect::REPEATED_HALFEDGE)
    return vertex + " has an edge with more than two faces, or with two faces of different "
                    "orientation; repair the mesh first";
  return "the faces at " + vertex + " do not form one fan; split the vertex first";
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says what is wrong with the arrays of a mesh, or which triangle has a vertex twice. Linear time.
inline std::string surface_error(const Indexed_triangle_mesh& mesh)
{
  const std::string error = mesh_error(mesh);
  return error.empty() ? repeated_vertex_error(mesh.triangles) : error;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says what is wrong with the map `uv` of the vertices of a mesh of two arrays, of which no
/// triangle may have a vertex twice. Linear time.
inline Mesh_outcome map_error(const Indexed_triangle_mesh& mesh,
                              const std::vector<Simple_cartesian<double>::Point_2>& uv)
{
  Mesh_outcome result;
  result.fail(Mesh_status::BAD_MESH, surface_error(mesh));
  result.fail(Mesh_status::BAD_OPTIONS, size_error("uv", uv.size(), mesh.points.size()));
  return result;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Says what keeps a mesh from being an oriented manifold, with or without border, all vertices of
/// which have triangles. Linear time.
inline std::string manifold_error(const Indexed_triangle_mesh& mesh)
{
  const std::string error = surface_error(mesh);
  return error.empty() ? ring_error(Vertex_rings(mesh)) : error;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_MESH_ERROR_H
