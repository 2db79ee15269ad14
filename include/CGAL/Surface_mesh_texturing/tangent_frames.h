// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TANGENT_FRAMES_H
#define CGAL_SURFACE_MESH_TEXTURING_TANGENT_FRAMES_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/corner_tangents.h>

#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The struct `Tangent_frame` is the frame of tangent space at one vertex of a renderer: a vertex with
one texture coordinate and one tangent, glTF's attributes POSITION, NORMAL, TEXCOORD, TANGENT.
*/
struct Tangent_frame
{
  Vertex_index vertex = no_vertex; ///< of the surface, which has the normal \f$ N \f$
  Vertex_index wedge = no_vertex;  ///< its texture coordinate
  Vector_3 tangent;                ///< unit vector \f$ T \perp N \f$ towards growing \f$ u \f$
  double sign = 1.;                ///< +1, or -1 where the texture is mirrored
};

/*!
\ingroup PkgHLSCMTexturing

The struct `Tangent_frames` are the frames of tangent space of a textured mesh.

A normal map's vector \f$ (x, y, z) \f$ stands for the direction \f$ x T + y B + z N \f$ with
\f$ B = w\, N \times T \f$, where \f$ N \f$ and \f$ T \f$ are the interpolated vectors, *not*
normalized, and \f$ w \f$ is the sign, which is the same at all corners of a triangle. \f$ B \f$
points to growing \f$ v \f$, which is upwards in the image: the "+Y up" of glTF, whose TANGENT is
\f$ (T, w) \f$.
*/
struct Tangent_frames
{
  std::vector<Vector_3> normals;         ///< unit vector for each vertex of the mesh
  std::vector<Tangent_frame> frames;     ///< in the order of their first corners
  std::vector<Triangle_indices> corners; ///< for each corner of a triangle its frame
};

/*!
\ingroup PkgHLSCMTexturing

Returns the tangent frames of `mesh` with unit `normals`, one for each vertex, as Mikkelsen 2008
("Simulation of Wrinkled Surfaces Revisited") defines them: each triangle has the direction of
growing \f$ u \f$ on it; a corner has its projection onto the plane that is orthogonal to the
normal; corners that share vertex, texture coordinate and orientation and are neighbours across
edges at both ends of which they do have the mean of these, weighted with their angles in that
plane.

Triangles without area in the texture count for nothing and have the frames of a neighbour. Where no
triangle tells a direction, the tangent is any that is orthogonal to the normal. Linear time.

Edges should have one or two triangles, of equal orientation; frames do not go on across others. If
an index is out of range, or the normals are those of another mesh, there are no frames.
*/
inline Tangent_frames tangent_frames(const Textured_triangle_mesh& mesh,
                                     std::vector<Vector_3> normals)
{
  if(normals.size() != mesh.points.size() || mesh.wedges.size() != mesh.triangles.size()
     || !internal::indices_are_below(mesh.triangles, mesh.points.size())
     || !internal::indices_are_below(mesh.wedges, mesh.uv.size()))
    return {};
  const internal::Corner_tangents tangents(mesh, normals);
  const std::vector<Halfedge> first = internal::first_corners_of_wedges(
    3 * mesh.triangles.size(), [&tangents](Halfedge h) { return tangents.across(h); });
  Tangent_frames result;
  result.corners.resize(mesh.triangles.size());
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t corner = 3 * t + c, f = first[corner];
      if(f == corner) { // it is the smallest of its frame
        result.corners[t][c] = Vertex_index(result.frames.size());
        result.frames.push_back({mesh.triangles[t][c], mesh.wedges[t][c], Vector_3(0., 0., 0.),
                                 tangents.is_mirrored(t) ? -1. : 1.});
      }
      result.corners[t][c] = vertex_of(result.corners, f);
      Vector_3& sum = result.frames[result.corners[t][c]].tangent;
      sum = sum + tangents.weighted_tangent(t, int(c));
    }
  for(Tangent_frame& frame : result.frames) {
    const Vector_3& n = normals[frame.vertex];
    frame.tangent = internal::normalized(frame.tangent - (frame.tangent * n) * n);
    if(!(frame.tangent * frame.tangent > 0.))
      frame.tangent = internal::any_orthogonal(n);
  }
  result.normals = std::move(normals);
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TANGENT_FRAMES_H
