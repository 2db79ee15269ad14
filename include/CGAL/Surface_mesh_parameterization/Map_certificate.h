// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <CGAL/Iterator_range.h>

#include <boost/iterator/counting_iterator.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMMeasures

What keeps a map from being one-to-one, decided exactly for parameters of type `double`, or why that
cannot be said.
*/
struct Map_certificate
  : Indexed_mesh::Mesh_outcome
{
  std::size_t flipped_faces = 0;    ///< faces with negative area in the plane
  std::size_t degenerate_faces = 0; ///< faces without area, or with a parameter that is not finite
  bool overlaps = false;            ///< whether the interiors of two faces intersect in the plane

  /// Returns whether the map is one-to-one and keeps the orientation. Points of the border may
  /// coincide with other points of the border, for instance along a seam.
  bool is_one_to_one() const
  {
    return is_ok() && flipped_faces == 0 && degenerate_faces == 0 && !overlaps;
  }
};

/*!
\ingroup PkgHLSCMMeasures

Writes the degenerate faces of the map `uvmap`, those whose area in the plane is 0 by an exact
predicate or that have a parameter which is not a finite number, to `out`.

\tparam FaceOutputIterator a model of `OutputIterator` that takes face descriptors

\return `out` after the last face

Linear time.
*/
template <class TriangleMesh, class VertexUVMap, class FaceOutputIterator>
FaceOutputIterator degenerate_faces(const TriangleMesh& mesh, VertexUVMap uvmap,
                                    FaceOutputIterator out)
{
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  for(const auto f : faces(mesh))
    if(orientation_of(view.triangle(f)) == COLLINEAR)
      *out++ = f;
  return out;
}

/*!
\ingroup PkgHLSCMMeasures

Writes the pairs of faces whose images under the map `uvmap` have interiors that intersect to `out`,
each pair once and in the order of `faces(mesh)`. What overlap means is said at
`has_global_overlap()`; a face with a neighbour of the other orientation overlaps it.

\tparam PairOutputIterator a model of `OutputIterator` that takes objects of type
        `std::pair<face_descriptor, face_descriptor>`

\return `out` after the last pair

Time \f$ O(n \log^2 n + k) \f$ for \f$ n \f$ faces and \f$ k \f$ pairs whose bounding boxes
intersect: for certainty that there are none, `has_global_overlap()` is faster.
*/
template <class TriangleMesh, class VertexUVMap, class PairOutputIterator>
PairOutputIterator overlapping_faces(const TriangleMesh& mesh, VertexUVMap uvmap,
                                     PairOutputIterator out)
{
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  const std::vector<face_descriptor> all(faces(mesh).begin(), faces(mesh).end());
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  visit_overlapping_faces(view, [&pairs](const Uv_face& a, const Uv_face& b) {
    pairs.push_back(std::minmax(a.position, b.position));
    return true;
  });
  std::sort(pairs.begin(), pairs.end());
  for(const auto& [a, b] : pairs)
    *out++ = std::pair<face_descriptor, face_descriptor>(all[a], all[b]);
  return out;
}

/*!
\ingroup PkgHLSCMMeasures

Returns whether the map `uvmap` of `mesh` is one-to-one, and if not, why.

The map of a disk whose faces all have positive areas is one-to-one if the image of its border is a
simple closed curve. For a point beside that curve has as many preimages as the curve winds around
it, since each preimage counts +1, and a simple curve winds around no point more than once. With
holes the same holds if the images of the border cycles are simple and disjoint and only one of them
runs counterclockwise, with the surface on its inner side: again no winding number, now the sum over
the cycles, is greater than 1. Where the borders meet, or the mesh has several components, the faces
are compared in pairs, by `has_global_overlap()`.

Points in space are not looked at. Faces that are no triangles are an error. Linear time for the faces, and \f$ O(b \log^2 b) \f$ for
\f$ b \f$ border edges; more if the images of the borders meet.
*/
template <class TriangleMesh, class VertexUVMap>
Map_certificate certify_map(const TriangleMesh& mesh, VertexUVMap uvmap)
{
  Map_certificate certificate;
  if(certificate.fail(Indexed_mesh::Mesh_status::BAD_MESH, Indexed_mesh::polygon_error(mesh)))
    return certificate;
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  for(const auto f : faces(mesh)) {
    const Orientation sign = orientation_of(view.triangle(f));
    certificate.flipped_faces += sign == RIGHT_TURN ? 1 : 0;
    certificate.degenerate_faces += sign == COLLINEAR ? 1 : 0;
  }
  certificate.overlaps = has_global_overlap(view);
  return certificate;
}

/*!
\ingroup PkgHLSCMMeasures

The class `Uv_arrays` is a view of a map of a mesh that is two arrays, for `certify_map()` and
`visit_overlapping_faces()`. Both arrays must live as long. It has no faces if a vertex of a
triangle does not exist or has no parameter.
*/
class Uv_arrays
{
public:
  typedef Simple_cartesian<double>::Point_2 Point_2; ///< a parameter

  /// Constructs it from the mesh and the parameter of each vertex.
  Uv_arrays(const Indexed_mesh::Indexed_triangle_mesh& mesh, const std::vector<Point_2>& uv)
    : m_triangles(Indexed_mesh::index_error(mesh.triangles, uv.size()).empty() ? mesh.triangles
                                                                               : no_triangles())
    , m_uv(uv)
  {}

  /// Returns the image of a vertex.
  Uv_point point(Indexed_mesh::Vertex_index v) const { return Uv_point(m_uv[v].x(), m_uv[v].y()); }
  /// Returns the image of triangle `t`.
  Uv_triangle triangle(std::size_t t) const
  {
    const auto& v = m_triangles[t];
    return {point(v[0]), point(v[1]), point(v[2])};
  }
  /// Returns the triangles, by the indices of their vertices.
  const std::vector<Indexed_mesh::Triangle_indices>& triangles() const { return m_triangles; }
  /// Returns the parameter of each vertex.
  const std::vector<Point_2>& uv() const { return m_uv; }

  /// Returns itself, a range of faces that are numbers.
  const Uv_arrays& mesh() const { return *this; }
  friend std::size_t num_faces(const Uv_arrays& view) { return view.m_triangles.size(); }
  friend auto faces(const Uv_arrays& view)
  {
    typedef boost::counting_iterator<std::size_t> Iterator;
    return make_range(Iterator(0), Iterator(view.m_triangles.size()));
  }

private:
  static const std::vector<Indexed_mesh::Triangle_indices>& no_triangles()
  {
    static const std::vector<Indexed_mesh::Triangle_indices> none;
    return none;
  }

  const std::vector<Indexed_mesh::Triangle_indices>& m_triangles;
  const std::vector<Point_2>& m_uv;
};

namespace internal {

// How many of the simple and disjoint images of borders are counterclockwise, or clockwise if `sign`
// says so. Edges run with the surface on their left.
inline std::size_t
number_of_outer_borders(const Uv_arrays& view,
                        const std::vector<std::array<std::uint32_t, 2>>& border, Orientation sign)
{
  std::vector<std::uint32_t> next(view.uv().size(), Indexed_mesh::no_vertex);
  for(const auto& [from, to] : border)
    next[from] = to;
  std::size_t result = 0;
  for(const auto& edge : border) {
    std::vector<Uv_point> cycle; // empty if it was there before
    for(std::uint32_t v = edge[0]; next[v] != Indexed_mesh::no_vertex;
        v = std::exchange(next[v], Indexed_mesh::no_vertex))
      cycle.push_back(view.point(v));
    if(cycle.empty())
      continue;
    const std::size_t n = cycle.size();
    const auto i = std::size_t(std::min_element(cycle.begin(), cycle.end()) - cycle.begin());
    result += orientation(cycle[(i + n - 1) % n], cycle[i], cycle[(i + 1) % n]) == sign ? 1 : 0;
  }
  return result;
}

} // namespace internal

/// \ingroup PkgHLSCMMeasures
/// Returns whether a map of a mesh that is two arrays covers a part of the plane twice.
inline bool has_global_overlap(const Uv_arrays& view)
{
  const Indexed_mesh::Triangle_adjacency adjacency(view.triangles());
  std::array<std::size_t, 3> count = {0, 0, 0}; // of each orientation
  std::vector<std::array<std::uint32_t, 2>> border;
  for(std::uint32_t t = 0; t < view.triangles().size(); ++t) {
    const Orientation sign = orientation_of(view.triangle(t));
    ++count[std::size_t(int(sign) + 1)];
    for(int c = 0; c < 3; ++c) {
      const Indexed_mesh::Halfedge o = adjacency.opposite(t, c);
      if(o == Indexed_mesh::no_halfedge)
        border.push_back({view.triangles()[t][c], view.triangles()[t][(c + 1) % 3]});
      else if(sign == RIGHT_TURN
              && orientation_of(view.triangle(Indexed_mesh::triangle_of(o))) == LEFT_TURN)
        return true;
    }
  }
  if(count[1] == 0 && (count[0] == 0 || count[2] == 0) && is_simple_border(border, view.uv())
     && internal::number_of_outer_borders(view, border, count[0] == 0 ? LEFT_TURN : RIGHT_TURN) <= 1)
    return false;
  return has_overlapping_triangles(view);
}

/// \ingroup PkgHLSCMMeasures
/// The same for a mesh that is two arrays, with the parameter `uv[v]` of each vertex. Nothing is
/// counted and `error` set if there is an `Indexed_mesh::map_error()`.
inline Map_certificate certify_map(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                   const std::vector<Simple_cartesian<double>::Point_2>& uv)
{
  Map_certificate certificate;
  if(certificate.fail(Indexed_mesh::map_error(mesh, uv)))
    return certificate;
  const Uv_arrays view(mesh, uv);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Orientation sign = orientation_of(view.triangle(t));
    certificate.flipped_faces += sign == RIGHT_TURN ? 1 : 0;
    certificate.degenerate_faces += sign == COLLINEAR ? 1 : 0;
  }
  certificate.overlaps = has_global_overlap(view);
  return certificate;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H
