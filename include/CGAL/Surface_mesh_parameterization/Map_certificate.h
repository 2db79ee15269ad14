// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMMeasures

What keeps a map from being one-to-one, decided exactly for parameters of type `double`.
*/
struct Map_certificate
{
  std::size_t flipped_faces = 0;    ///< faces with negative area in the plane
  std::size_t degenerate_faces = 0; ///< faces without area, or with a parameter that is not finite
  bool overlaps = false;            ///< whether the interiors of two faces intersect in the plane

  /// Returns whether the map is one-to-one and keeps the orientation. Points of the border may
  /// coincide with other points of the border, for instance along a seam.
  bool is_one_to_one() const { return flipped_faces == 0 && degenerate_faces == 0 && !overlaps; }
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

Linear time for the faces, and \f$ O(b \log^2 b) \f$ for \f$ b \f$ border edges; more if the images
of the borders meet.
*/
template <class TriangleMesh, class VertexUVMap>
Map_certificate certify_map(const TriangleMesh& mesh, VertexUVMap uvmap)
{
  const Uv_view<TriangleMesh, VertexUVMap> view(mesh, uvmap);
  Map_certificate certificate;
  for(const auto f : faces(mesh)) {
    const Orientation sign = orientation_of(view.triangle(f));
    certificate.flipped_faces += sign == RIGHT_TURN ? 1 : 0;
    certificate.degenerate_faces += sign == COLLINEAR ? 1 : 0;
  }
  certificate.overlaps = has_global_overlap(view);
  return certificate;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_CERTIFICATE_H
