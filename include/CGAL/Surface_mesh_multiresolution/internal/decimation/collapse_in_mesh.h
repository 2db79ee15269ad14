// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <CGAL/assertions.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Joins the two edges of the triangle of h that h is not one of: `kept` takes the place of the
// opposite of `gone`, which is the next or the previous halfedge of h.
//
//        a                 a
//       / \                |        The face and the edge of `gone` disappear.
//      /   \      ->       |
//     v --- t              t
template <class TriangleMesh, class Halfedge>
void fold_triangle(const Halfedge kept, const Halfedge gone, TriangleMesh& mesh)
{
  const Halfedge outer = opposite(gone, mesh);
  const auto face_inside = face(gone, mesh), face_outside = face(outer, mesh);
  set_next(prev(outer, mesh), kept, mesh);
  set_next(kept, next(outer, mesh), mesh);
  set_face(kept, face_outside, mesh);
  if(face_outside != boost::graph_traits<TriangleMesh>::null_face())
    set_halfedge(face_outside, kept, mesh);
  remove_face(face_inside, mesh);
  remove_edge(edge(gone, mesh), mesh);
}

// Collapses h: its source v goes, its target t stays with all that belongs to it, while
// `Euler::collapse_edge()` chooses by the orientation of the edge. Where a halfedge that stands for
// its vertex goes, the one that takes its place does, so that it or its opposite is on the border if
// it was, as meshes want it.
//
//         a
//       / | \          The edges (v, a) and (v, b) give way to (t, a) and (t, b); one of the two
//     ..  v -> t       triangles may not exist, and then (v, a) or (v, b) neither.
//       \ | /
//         b
template <class TriangleMesh, class Halfedge>
void collapse_halfedge(const Halfedge h, TriangleMesh& mesh)
{
  const Halfedge o = opposite(h, mesh);
  const auto v = source(h, mesh), t = target(h, mesh);
  const bool has_left = !is_border(h, mesh), has_right = !is_border(o, mesh);
  const bool is_ear = !(has_left && has_right) // v is in one triangle
                   && next(opposite(next(o, mesh), mesh), mesh) == h;
  const Halfedge from_a = prev(h, mesh), to_a = next(h, mesh), from_b = prev(o, mesh),
                 to_b = next(o, mesh); // those of border loops if there is no triangle
  for(Halfedge g = o;;) { // all halfedges to v now go to t
    const Halfedge following = opposite(next(g, mesh), mesh);
    set_target(g, t, mesh);
    if(following == o)
      break;
    g = following;
  }
  if(halfedge(t, mesh) == h) {
    const Halfedge on_left = is_ear ? from_b : from_a;
    const Halfedge on_right = opposite(is_ear ? to_a : to_b, mesh);
    set_halfedge(t, !has_left ? on_left : (!has_right ? on_right : from_b), mesh);
  }
  if(has_left) {
    const auto a = target(to_a, mesh);
    if(halfedge(a, mesh) == opposite(from_a, mesh))
      set_halfedge(a, to_a, mesh);
    fold_triangle(to_a, from_a, mesh);
  } else {
    set_next(from_a, to_a, mesh);
  }
  if(has_right) {
    const auto b = source(from_b, mesh);
    if(halfedge(b, mesh) == to_b)
      set_halfedge(b, opposite(from_b, mesh), mesh);
    fold_triangle(from_b, to_b, mesh);
  } else {
    set_next(from_b, next(o, mesh), mesh); // another one than before at an ear
  }
  remove_edge(edge(h, mesh), mesh);
  remove_vertex(v, mesh);
}

// Makes the collapses, which the topology of the mesh allows one after the other; vertices have
// their numbers in vertices(mesh). Linear time for bounded degrees of the vertices that go.
template <class TriangleMesh>
void collapse_in_mesh(const std::vector<Halfedge_collapse>& collapses, TriangleMesh& mesh)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  std::vector<typename Graph_traits::vertex_descriptor> vertex(vertices(mesh).begin(),
                                                               vertices(mesh).end());
  for(const Halfedge_collapse& c : collapses) {
    auto h = halfedge(vertex[c.removed], mesh); // to the vertex that goes
    const auto first = h;
    while(source(h, mesh) != vertex[c.kept]) {
      h = opposite(next(h, mesh), mesh);
      CGAL_assertion(h != first);
      CGAL_USE(first);
    }
    collapse_halfedge(opposite(h, mesh), mesh);
  }
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H
