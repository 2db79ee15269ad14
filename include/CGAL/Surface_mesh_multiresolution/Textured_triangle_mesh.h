// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/is_measurable.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Textured_triangle_mesh` is a triangle mesh with a texture coordinate at each corner.
Where corners of the same vertex have different ones, there is a seam.

Invariant: `wedges` is as long as `triangles`; the entries of `triangles` are smaller than
`points.size()`, those of `wedges` smaller than `uv.size()`.
*/
struct Textured_triangle_mesh
{
  typedef Simple_cartesian<double>::Point_2 Point_2; ///< a texture coordinate
  typedef Simple_cartesian<double>::Point_3 Point_3; ///< a point of the surface

  std::vector<Point_3> points;             ///< of each vertex
  std::vector<Triangle_indices> triangles; ///< the vertices of each triangle
  std::vector<Point_2> uv;                 ///< texture coordinates, in any number and order
  std::vector<Triangle_indices> wedges;    ///< for each corner of a triangle where in `uv` its own is
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the texture coordinate of a corner.
inline const Textured_triangle_mesh::Point_2& uv_of(const Textured_triangle_mesh& mesh, Halfedge h)
{
  return mesh.uv[vertex_of(mesh.wedges, h)];
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns whether the texture goes on across the edge with the halfedges `h` and `opposite`: the
/// texture coordinates of both its ends are equal on both sides, whatever their indices. This is
/// what makes wedges, seams and charts of a texture. Equal is meant exactly.
inline bool is_smooth(const Textured_triangle_mesh& mesh, Halfedge h, Halfedge opposite)
{
  return uv_of(mesh, h) == uv_of(mesh, next_halfedge(opposite))
      && uv_of(mesh, next_halfedge(h)) == uv_of(mesh, opposite);
}

namespace internal {

// What is wrong with a texture coordinate, or null.
inline const char* defect_of_uv(const Textured_triangle_mesh::Point_2& uv)
{
  if(!std::isfinite(uv.x()) || !std::isfinite(uv.y()))
    return " that is not a finite number";
  return is_measurable(uv.x()) && is_measurable(uv.y())
           ? nullptr : " so large that its square is not a finite number";
}

} // namespace internal

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns a sentence on the first texture coordinate that is not a finite number or of which
/// `is_measurable()` does not hold, or nothing; the mesh may have a name, as in
/// `Indexed_mesh::mesh_error()`.
inline std::string uv_error(const std::vector<Textured_triangle_mesh::Point_2>& uv,
                            const std::string& name = {})
{
  for(std::size_t w = 0; w < uv.size(); ++w)
    if(!std::isfinite(uv[w].x()) || !std::isfinite(uv[w].y()))
      return "texture coordinate " + std::to_string(w) + of_mesh(name) + " is not a finite number";
    else if(internal::defect_of_uv(uv[w]) != nullptr)
      return "texture coordinate " + std::to_string(w) + of_mesh(name)
           + " is so large that its square is not a finite number";
  return {};
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns a sentence on the first point of which `is_measurable()` does not hold, or nothing.
inline std::string size_error(const std::vector<Textured_triangle_mesh::Point_3>& points,
                              const std::string& name = {})
{
  for(std::size_t v = 0; v < points.size(); ++v)
    if(!is_measurable(points[v].x()) || !is_measurable(points[v].y())
       || !is_measurable(points[v].z()))
      return "vertex " + std::to_string(v) + of_mesh(name)
           + " has a coordinate so large that its square is not a finite number";
  return {};
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns a sentence on what is wrong with the texture of a mesh, or nothing. Linear time.
inline std::string texture_error(const Textured_triangle_mesh& mesh, const std::string& name = {})
{
  if(mesh.wedges.size() != mesh.triangles.size())
    return (name.empty() ? "the mesh" : name)
         + " has not as many triangles in the texture as on the surface";
  for(std::size_t t = 0; t < mesh.wedges.size(); ++t)
    for(const Vertex_index w : mesh.wedges[t]) {
      const bool is_there = w < mesh.uv.size();
      const char* defect = is_there ? internal::defect_of_uv(mesh.uv[w]) : "";
      if(defect != nullptr)
        return "triangle " + std::to_string(t) + of_mesh(name)
             + (is_there ? " has a texture coordinate" : " has a corner without texture coordinate")
             + defect;
    }
  return uv_error(mesh.uv, name); // those without a triangle
}

namespace internal {

// Twice the signed area of a triangle in the texture.
inline double double_area(const Textured_triangle_mesh::Point_2& p,
                          const Textured_triangle_mesh::Point_2& q,
                          const Textured_triangle_mesh::Point_2& r)
{
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

// Whether a triangle with these areas before and after a change has turned over; one that had no
// area may become anything.
inline bool has_turned_over(double before, double after)
{
  return before != 0. && !(before > 0. ? after > 0. : after < 0.);
}

// The corners of one vertex, joined to wedges. A corner (v, a, b) has the edge to a before it and
// the edge to b behind it.
class Wedges_at_vertex
{
public:
  explicit Wedges_at_vertex(const Textured_triangle_mesh& mesh)
    : m_mesh(mesh), m_triangles(mesh.triangles, mesh.points.size())
  {}

  // Sets `wedges[t][c]` for the corners of v, counting on from `number`. Quadratic in the degree.
  void join(Vertex_index v, std::vector<Triangle_indices>& wedges, Vertex_index& number)
  {
    m_corners.clear();
    for(const std::uint32_t* c = m_triangles.begin(v); c != m_triangles.end(v); ++c)
      m_corners.push_back(corner(*c));
    for(Corner& c : m_corners)
      for(const Corner& d : m_corners) // the edge behind c is the halfedge before it
        if(d.ahead == c.behind && is_smooth(m_mesh, previous_halfedge(c.corner), d.corner))
          join(c.group, d.group);
    for(const Corner& c : m_corners) {
      Vertex_index& wedge = wedges[triangle_of(c.corner)][corner_of(c.corner)];
      for(const Corner& d : m_corners) {
        if(&d == &c)
          break;
        if(d.group == c.group)
          wedge = vertex_of(wedges, d.corner);
      }
      if(wedge == no_vertex)
        wedge = number++;
    }
  }

private:
  struct Corner
  {
    Halfedge corner;
    Vertex_index ahead, behind; // the vertices of the two edges
    std::size_t group;
  };

  Corner corner(Halfedge h) const
  {
    return {h, vertex_of(m_mesh.triangles, next_halfedge(h)),
            vertex_of(m_mesh.triangles, previous_halfedge(h)), m_corners.size()};
  }

  void join(std::size_t from, std::size_t to)
  {
    for(Corner& c : m_corners)
      if(c.group == from)
        c.group = to;
  }

  const Textured_triangle_mesh& m_mesh;
  Triangles_at_vertices m_triangles;
  std::vector<Corner> m_corners;
};

// Whether the invariants hold.
inline bool has_its_own_indices(const Textured_triangle_mesh& mesh)
{
  return mesh.wedges.size() == mesh.triangles.size()
      && index_error(mesh.triangles, mesh.points.size()).empty()
      && index_error(mesh.wedges, mesh.uv.size()).empty();
}

// The texture coordinate of a halfedge by a function or a property map.
template <class CornerUv, class Halfedge>
auto uv_at(const CornerUv& corner_uv, const Halfedge h)
{
  if constexpr(std::is_invocable<const CornerUv&, Halfedge>::value)
    return corner_uv(h);
  else
    return get(corner_uv, h);
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the triangles of `mesh` with the texture coordinates of their corners. Vertices are numbered
as in `vertices(mesh)`, triangles as in `faces(mesh)`. Linear time.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam NamedParameters a sequence of named parameters
\param mesh a triangle mesh
\param corner_uv the texture coordinates at the targets of the halfedges of faces, in these: a model
       of `ReadablePropertyMap` with the halfedge descriptor as key, or a function of it. With a map
       `m` of vertices that is `[&](auto h) { return get(m, target(h, mesh)); }`. For `mesh` with a
       `Seam_mesh` of type `S` above it, `seams`, and the map `m` of its vertices that
       `SMP::parameterize()` fills it is
       `[&](auto h) { return get(m, target(boost::graph_traits<S>::halfedge_descriptor(h), seams));
       }`
\param np `vertex_point_map`: the points; `get(vertex_point, mesh)` by default

\pre all faces are triangles
*/
template <class TriangleMesh, class CornerUv,
          class NamedParameters = parameters::Default_named_parameters>
Textured_triangle_mesh
textured_triangle_mesh(const TriangleMesh& mesh, const CornerUv& corner_uv,
                       const NamedParameters& np = parameters::default_values())
{
  Indexed_triangle_mesh arrays = Indexed_mesh::copy_mesh(mesh, np);
  Textured_triangle_mesh result;
  result.points = std::move(arrays.points);
  result.triangles = std::move(arrays.triangles);
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    Triangle_indices wedges;
    for(Vertex_index& wedge : wedges) {
      const auto uv = internal::uv_at(corner_uv, h);
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

Returns `mesh` with one texture coordinate for each wedge, that is for the corners of a vertex
between one seam and the next, in the order of the vertices. An edge is no seam if the texture
coordinates of its ends are equal on both sides, whatever their indices. Returns an empty mesh if an
index is out of range. Linear time for bounded degrees.
*/
inline Textured_triangle_mesh with_wedges(const Textured_triangle_mesh& mesh)
{
  Textured_triangle_mesh result;
  if(!internal::has_its_own_indices(mesh))
    return result;
  result.points = mesh.points;
  result.triangles = mesh.triangles;
  result.wedges.assign(mesh.triangles.size(), {no_vertex, no_vertex, no_vertex});
  internal::Wedges_at_vertex at_vertex(mesh);
  Vertex_index number = 0;
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    at_vertex.join(v, result.wedges, number);
  result.uv.resize(number);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      result.uv[result.wedges[t][c]] = mesh.uv[mesh.wedges[t][c]];
  return result;
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns for each entry of `mesh.uv` its vertex. One that no triangle has is taken for that of the
vertex with its number, so that isolated vertices of a mesh with one for each vertex are kept; or of
vertex 0, if there are fewer. Returns nothing if an index is out of range. Linear time.
*/
inline std::vector<Vertex_index> vertices_of_wedges(const Textured_triangle_mesh& mesh)
{
  if(!internal::has_its_own_indices(mesh))
    return {};
  std::vector<Vertex_index> vertex(mesh.uv.size(), 0);
  for(std::size_t w = 0; w < (std::min)(mesh.uv.size(), mesh.points.size()); ++w)
    vertex[w] = Vertex_index(w);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(std::size_t c = 0; c < 3; ++c)
      vertex[mesh.wedges[t][c]] = mesh.triangles[t][c];
  return vertex;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_TRIANGLE_MESH_H
