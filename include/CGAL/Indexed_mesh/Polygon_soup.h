// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_POLYGON_SOUP_H
#define CGAL_INDEXED_MESH_POLYGON_SOUP_H

#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/*!
\ingroup PkgHLSCMIndexedMesh

The struct `Polygon_soup` is what people have before it is known to be a surface: points, and faces
with any number of corners that name them. See `diagnose_soup()` and `surface_of_soup()`.

Invariants: `first_corner` begins with 0, does not fall, and ends with `corners.size()`; the entries
of `corners` are smaller than `points.size()` (see `soup_error()`); `uv_corners` is empty or as long as
`corners`, with entries smaller than `uv.size()`, or `no_vertex`.
*/
struct Polygon_soup
{
  typedef Indexed_triangle_mesh::Point_3 Point_3;      ///< a point
  typedef Simple_cartesian<double>::Point_2 Point_2;   ///< a texture coordinate

  /// The corners of a face, as a range of vertices.
  struct Face
  {
    const Vertex_index* first; ///< the first corner
    const Vertex_index* last;  ///< behind the last one

    /// Returns the begin of the range.
    const Vertex_index* begin() const { return first; }
    /// Returns the end of the range.
    const Vertex_index* end() const { return last; }
    /// Returns the number of corners.
    std::size_t size() const { return std::size_t(last - first); }
    /// Returns the vertex of a corner.
    Vertex_index operator[](std::size_t i) const { return first[i]; }
  };

  std::vector<Point_3> points;                ///< of each vertex
  std::vector<Vertex_index> corners;          ///< the vertices of all faces, one face after the other
  std::vector<std::uint32_t> first_corner{0}; ///< of each face, and the end of the last one
  std::vector<Point_2> uv;                    ///< texture coordinates; may be empty
  std::vector<std::uint32_t> uv_corners;      ///< for each of `corners` where in `uv` its own is

  /// Returns the number of vertices.
  std::size_t number_of_vertices() const { return points.size(); }
  /// Returns the number of faces.
  std::size_t number_of_faces() const { return first_corner.size() - 1; }
  /// Returns a face.
  Face face(std::size_t f) const
  {
    return {corners.data() + first_corner[f], corners.data() + first_corner[f + 1]};
  }
  /// Returns whether all corners have texture coordinates.
  bool has_uv() const { return !corners.empty() && uv_corners.size() == corners.size(); }
  /// Makes a face of the corners that were added since the last one.
  void close_face() { first_corner.push_back(std::uint32_t(corners.size())); }
};

/// \ingroup PkgHLSCMIndexedMesh
/// Returns a sentence on what is wrong with the points and the faces of a soup, or nothing: its
/// invariants, and points that are not finite. Texture coordinates do not count. Linear time.
inline std::string soup_error(const Polygon_soup& soup)
{
  if(soup.first_corner.empty() || soup.first_corner.front() != 0
     || soup.first_corner.back() != soup.corners.size()
     || !std::is_sorted(soup.first_corner.begin(), soup.first_corner.end()))
    return "the faces do not follow one after the other";
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for(const Vertex_index v : soup.face(f))
      if(v >= soup.points.size())
        return "face " + std::to_string(f) + " has a vertex that does not exist";
  return point_error(soup.points);
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns a soup given as points, of which `p[0]`, `p[1]` and `p[2]` are the coordinates, and for
/// each face the range of its vertices, as CGAL's functions of polygon soups take it. Linear time.
template <class PointRange, class PolygonRange>
Polygon_soup polygon_soup(const PointRange& points, const PolygonRange& polygons)
{
  Polygon_soup soup;
  for(const auto& p : points)
    soup.points.emplace_back(to_double(p[0]), to_double(p[1]), to_double(p[2]));
  for(const auto& polygon : polygons) {
    for(const auto v : polygon)
      soup.corners.push_back(std::size_t(v) < soup.points.size() ? Vertex_index(v) : no_vertex);
    soup.close_face();
  }
  return soup;
}

/*!
\ingroup PkgHLSCMIndexedMesh

Returns the vertices and the faces of a mesh of any type, the faces of which may have any number of
corners, as arrays: vertices in the order of `vertices(mesh)`, faces in that of `faces(mesh)`, and
the corners of a face at the targets of its halfedges from `halfedge(f, mesh)` on. Linear time.

\tparam FaceGraph a model of `FaceListGraph`
\param mesh a mesh
\param np optional named parameters of `copy_points()`
*/
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
Polygon_soup copy_soup(const FaceGraph& mesh,
                       const NamedParameters& np = parameters::default_values())
{
  const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
  number_vertices(mesh, position);
  Polygon_soup soup;
  soup.points = copy_points(mesh, np);
  for(const auto f : faces(mesh)) {
    for(const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      soup.corners.push_back(get(position, target(h, mesh)));
    soup.close_face();
  }
  return soup;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_POLYGON_SOUP_H
