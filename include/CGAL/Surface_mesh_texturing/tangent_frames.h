// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TANGENT_FRAMES_H
#define CGAL_SURFACE_MESH_TEXTURING_TANGENT_FRAMES_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The unit normal of a triangle and its angles.
struct Weighted_normal
{
  Vector_3 normal = Vector_3(0., 0., 0.);
  std::array<double, 3> angles = {0., 0., 0.};
};

inline Weighted_normal weighted_normal(const Indexed_triangle_mesh::Point_3& a,
                                       const Indexed_triangle_mesh::Point_3& b,
                                       const Indexed_triangle_mesh::Point_3& c)
{
  const Vector_3 ab = b - a, bc = c - b, ca = a - c;
  const Vector_3 normal = cross_product(ab, -ca);
  const double area = std::sqrt(normal * normal); // twice
  if(!(area > 0.))
    return {};
  return {normal / area,
          {std::atan2(area, -(ab * ca)), std::atan2(area, -(bc * ab)),
           std::atan2(area, -(ca * bc))}};
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the unit normal of each vertex: the mean of the normals of its triangles, weighted with the
angles that they have there (Thuermer, Wuethrich 1998). Vertices have one normal, also where the
texture has a seam. A vertex without triangles that have an area has the normal (0, 0, 1). If an
index is out of range, there are no normals. Linear time.

\tparam ConcurrencyTag as for `bake_normal_map()`; `threads` count with a parallel tag, 0: as many as
        there are processors
*/
template <class ConcurrencyTag = Default>
std::vector<Vector_3> vertex_normals(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                                     const std::vector<Triangle_indices>& triangles,
                                     unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  if(!internal::indices_are_below(triangles, points.size()))
    return {};
  std::vector<internal::Weighted_normal> weighted(triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 1 << 14, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i) {
      const Triangle_indices& t = triangles[i];
      weighted[i] = internal::weighted_normal(points[t[0]], points[t[1]], points[t[2]]);
    }
  });
  std::vector<Vector_3> result(points.size(), Vector_3(0., 0., 0.));
  for(std::size_t i = 0; i < triangles.size(); ++i)
    for(int c = 0; c < 3; ++c) {
      Vector_3& sum = result[triangles[i][c]];
      sum = sum + weighted[i].angles[c] * weighted[i].normal;
    }
  Blocked_execution::blocked_for(points.size(), 1 << 14, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i) {
      const Vector_3 normal = internal::normalized(result[i]);
      result[i] = normal * normal > 0. ? normal : Vector_3(0., 0., 1.);
    }
  });
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// Returns the unit normal of each vertex of `mesh`; see the other overload.
template <class ConcurrencyTag = Default>
std::vector<Vector_3> vertex_normals(const Textured_triangle_mesh& mesh, unsigned int threads = 0)
{
  return vertex_normals<ConcurrencyTag>(mesh.points, mesh.triangles, threads);
}

namespace internal {

// A unit vector that is orthogonal to the unit vector n.
inline Vector_3 any_orthogonal(const Vector_3& n)
{
  int axis = 0; // to which n is least parallel
  for(int c = 1; c < 3; ++c)
    if(std::abs(n[c]) < std::abs(n[axis]))
      axis = c;
  const Vector_3 e(axis == 0 ? 1. : 0., axis == 1 ? 1. : 0., axis == 2 ? 1. : 0.);
  return normalized(e - (e * n) * n);
}

inline Vector_3 projected(const Vector_3& v, const Vector_3& n) { return v - (v * n) * n; }

// The tangents of the triangles of a textured mesh and where they go on from one to the next.
class Corner_tangents
{
public:
  Corner_tangents(const Textured_triangle_mesh& mesh, const std::vector<Vector_3>& normals)
    : m_mesh(mesh), m_normals(normals), m_adjacency(mesh.triangles)
    , m_orientation(mesh.triangles.size())
  {
    for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double area = uv_area(t);
      m_orientation[t] = area > 0. ? 1 : area < 0. ? -1 : 0;
    }
    orient_triangles_without_area();
  }

  // The halfedge on the other side of h if tangents are shared across it, otherwise `no_halfedge`.
  Halfedge across(Halfedge h) const
  {
    const Halfedge opposite = m_adjacency.opposite(h);
    const bool goes_on = opposite != no_halfedge
                      && m_orientation[triangle_of(h)] == m_orientation[triangle_of(opposite)]
                      && is_smooth(m_mesh, h, opposite);
    return goes_on ? opposite : no_halfedge;
  }

  bool is_mirrored(std::uint32_t t) const { return m_orientation[t] < 0; }

  // What corner c of triangle t contributes to the sum of its frame.
  Vector_3 weighted_tangent(std::uint32_t t, int c) const
  {
    const Triangle_indices& v = m_mesh.triangles[t];
    const Vector_3& n = m_normals[v[c]];
    const auto& p = m_mesh.points[v[c]];
    const Vector_3 a = projected(m_mesh.points[v[(c + 1) % 3]] - p, n);
    const Vector_3 b = projected(m_mesh.points[v[(c + 2) % 3]] - p, n);
    const Vector_3 ab = cross_product(a, b);
    const double angle = std::atan2(std::sqrt(ab * ab), a * b);
    return angle * normalized(projected(normalized(tangent(t)), n));
  }

private:
  const Textured_triangle_mesh::Point_2& uv(std::uint32_t t, int c) const
  {
    return m_mesh.uv[m_mesh.wedges[t][c % 3]];
  }

  double uv_area(std::uint32_t t) const
  {
    const auto p = uv(t, 1) - uv(t, 0), q = uv(t, 2) - uv(t, 0);
    return p.x() * q.y() - p.y() * q.x();
  }

  // Along the derivative of the point by u, of any length.
  Vector_3 tangent(std::uint32_t t) const
  {
    const double area = uv_area(t);
    if(area == 0.)
      return Vector_3(0., 0., 0.);
    const Triangle_indices& v = m_mesh.triangles[t];
    const Vector_3 x = m_mesh.points[v[1]] - m_mesh.points[v[0]];
    const Vector_3 y = m_mesh.points[v[2]] - m_mesh.points[v[0]];
    const double p = uv(t, 1).y() - uv(t, 0).y(), q = uv(t, 2).y() - uv(t, 0).y();
    return area > 0. ? q * x - p * y : p * y - q * x;
  }

  // Triangles that are only points or lines in the texture follow a neighbour.
  void orient_triangles_without_area()
  {
    std::vector<std::uint32_t> queue;
    for(std::uint32_t t = 0; t < m_orientation.size(); ++t)
      if(m_orientation[t] != 0)
        for(int c = 0; c < 3; ++c)
          spread(t, m_adjacency.opposite(t, c), queue);
    for(std::size_t i = 0; i < queue.size(); ++i)
      for(int c = 0; c < 3; ++c)
        spread(queue[i], m_adjacency.opposite(queue[i], c), queue);
    for(auto& orientation : m_orientation)
      if(orientation == 0)
        orientation = 1;
  }

  void spread(std::uint32_t t, std::uint32_t opposite, std::vector<std::uint32_t>& queue)
  {
    if(opposite == no_halfedge || m_orientation[triangle_of(opposite)] != 0)
      return;
    m_orientation[triangle_of(opposite)] = m_orientation[t];
    queue.push_back(triangle_of(opposite));
  }

  const Textured_triangle_mesh& m_mesh;
  const std::vector<Vector_3>& m_normals;
  Triangle_adjacency m_adjacency;
  std::vector<std::int8_t> m_orientation;
};

} // namespace internal

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
  const std::vector<Halfedge> first = first_corners_of_wedges(
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
