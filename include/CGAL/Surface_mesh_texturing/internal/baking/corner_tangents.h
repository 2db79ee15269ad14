// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_CORNER_TANGENTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_CORNER_TANGENTS_H

#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
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
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_BAKING_CORNER_TANGENTS_H
