// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_NEAREST_TRIANGLE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_NEAREST_TRIANGLE_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The point of a triangle that is nearest to another point.
struct Nearest_point
{
  float squared_distance = (std::numeric_limits<float>::infinity)();
  std::array<float, 3> weight = {1.f, 0.f, 0.f}; // barycentric
};

struct Float_vector
{
  float x, y, z;
};

inline Float_vector difference(const Indexed_triangle_mesh::Point_3& a,
                               const Indexed_triangle_mesh::Point_3& b)
{
  return {float(a.x() - b.x()), float(a.y() - b.y()), float(a.z() - b.z())};
}

inline float dot(const Float_vector& a, const Float_vector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The weight t in [0, 1] of b for the point nearest to the origin on the segment (a, b).
inline float nearest_on_segment(const Float_vector& a, const Float_vector& b)
{
  const Float_vector e = {b.x - a.x, b.y - a.y, b.z - a.z};
  const float length = dot(e, e);
  if(!(length > 0.f))
    return 0.f;
  const float t = -dot(a, e) / length;
  return t < 0.f ? 0.f : (t > 1.f ? 1.f : t);
}

typedef std::array<Float_vector, 3> Float_triangle;

inline Float_triangle triangle_around(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                                      const Triangle_indices& t,
                                      const Indexed_triangle_mesh::Point_3& origin)
{
  return {difference(points[t[0]], origin), difference(points[t[1]], origin),
          difference(points[t[2]], origin)};
}

inline Nearest_point point_of_weights(const Float_triangle& t, const std::array<float, 3>& w)
{
  const Float_vector p = {w[0] * t[0].x + w[1] * t[1].x + w[2] * t[2].x,
                          w[0] * t[0].y + w[1] * t[1].y + w[2] * t[2].y,
                          w[0] * t[0].z + w[1] * t[1].z + w[2] * t[2].z};
  return Nearest_point{dot(p, p), w};
}

// The foot of the perpendicular from the origin if it lies in the triangle; otherwise a point at
// infinity.
inline Nearest_point foot_of_origin(const Float_triangle& t)
{
  const Float_vector &a = t[0], &b = t[1], &c = t[2];
  const Float_vector u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
  const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), au = -dot(a, u), av = -dot(a, v);
  const float area = uu * vv - uv * uv;
  const float wb = vv * au - uv * av, wc = uu * av - uv * au;
  if(!(area > 1e-12f * uu * vv) || wb < 0.f || wc < 0.f || wb + wc > area)
    return Nearest_point();
  const float inverse = 1.f / area;
  const float wa = (std::max)(0.f, 1.f - (wb + wc) * inverse); // rounding may go below
  return point_of_weights(t, {wa, wb * inverse, wc * inverse});
}

// The point of the three sides that is nearest to the origin.
inline Nearest_point nearest_on_sides(const Float_triangle& t)
{
  Nearest_point best;
  for(int side = 0; side < 3; ++side) {
    const int next = side == 2 ? 0 : side + 1;
    const float along = nearest_on_segment(t[side], t[next]);
    std::array<float, 3> w = {0.f, 0.f, 0.f};
    w[side] = 1.f - along;
    w[next] = along;
    const Nearest_point candidate = point_of_weights(t, w);
    if(candidate.squared_distance < best.squared_distance)
      best = candidate;
  }
  return best;
}

inline Nearest_point nearest_in_triangle(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                                         const Triangle_indices& t,
                                         const Indexed_triangle_mesh::Point_3& p)
{
  const Float_triangle triangle = triangle_around(points, t, p);
  const Nearest_point foot = foot_of_origin(triangle);
  return foot.squared_distance < Nearest_point().squared_distance ? foot
                                                                  : nearest_on_sides(triangle);
}

// The best of the triangles at a vertex.
struct Nearest_triangle
{
  Nearest_point point;
  std::uint32_t triangle = 0;
};

// The triangle of the star of `star` that has the foot of the perpendicular from p. The first that
// is much nearer than the centre of the star will do; on folded surfaces there may be others
// farther off.
inline Nearest_triangle triangle_below(const Triangles_at_vertices& at,
                                       const Indexed_triangle_mesh& mesh, Vertex_index star,
                                       const Indexed_triangle_mesh::Point_3& p)
{
  const Float_vector to_centre = difference(mesh.points[star], p);
  const float near = 0.1f * dot(to_centre, to_centre);
  Nearest_triangle best;
  for(const std::uint32_t* corner = at.begin(star); corner != at.end(star); ++corner) {
    const Triangle_indices& t = mesh.triangles[triangle_of(*corner)];
    const Nearest_point candidate = foot_of_origin(triangle_around(mesh.points, t, p));
    if(candidate.squared_distance < best.point.squared_distance) {
      best = {candidate, triangle_of(*corner)};
      if(candidate.squared_distance < near)
        break;
    }
  }
  return best;
}

// The triangle whose plane point below p lies in it, in the star of `star`; if no triangle of it
// has one, a walk goes on in the star of that vertex of the nearest triangle that weighs most, as
// long as this brings it nearer.
inline Nearest_triangle walk_to_nearest(const Triangles_at_vertices& at,
                                        const Indexed_triangle_mesh& mesh, Vertex_index star,
                                        const Indexed_triangle_mesh::Point_3& p)
{
  Nearest_triangle best;
  for(;;) {
    const Nearest_triangle inside = triangle_below(at, mesh, star, p);
    if(inside.point.squared_distance < Nearest_point().squared_distance)
      return inside.point.squared_distance <= best.point.squared_distance ? inside : best;
    const float before = best.point.squared_distance;
    for(const std::uint32_t* corner = at.begin(star); corner != at.end(star); ++corner) {
      const Triangle_indices& t = mesh.triangles[triangle_of(*corner)];
      const Nearest_point candidate = nearest_on_sides(triangle_around(mesh.points, t, p));
      if(candidate.squared_distance < best.point.squared_distance)
        best = {candidate, triangle_of(*corner)};
    }
    const auto heaviest = std::max_element(best.point.weight.begin(), best.point.weight.end());
    const Vertex_index next = mesh.triangles[best.triangle][heaviest - best.point.weight.begin()];
    if(next == star || !(best.point.squared_distance < before))
      return best;
    star = next;
  }
}

// Stencils, and for each the triangle of the coarse mesh whose vertices it refers to.
struct Located_stencils
{
  std::vector<Prolongation::Stencil> stencils;
  std::vector<std::uint32_t> triangles;
};

// For each vertex of `fine` that is not kept, the weights of the nearest triangle of `coarse` that
// a walk from its ancestor finds.
inline Located_stencils
walk_stencils(const Indexed_triangle_mesh& fine, const Indexed_triangle_mesh& coarse,
              const std::vector<Vertex_index>& kept, const std::vector<Vertex_index>& ancestor)
{
  const Triangles_at_vertices at(coarse.triangles, coarse.points.size());
  const std::vector<Vertex_index> rank = ranks(kept, fine.points.size());
  const std::vector<Vertex_index> removed = Blocked_execution::select(
    fine.points.size(), [&ancestor](Vertex_index v) { return ancestor[v] != v; });
  Located_stencils result;
  Blocked_execution::resize_blocked(result.stencils, removed.size());
  result.triangles.resize(removed.size());
  Blocked_execution::blocked_for(removed.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const Vertex_index v = removed[i];
      const Nearest_triangle best = walk_to_nearest(at, coarse, rank[ancestor[v]], fine.points[v]);
      const Triangle_indices& t = coarse.triangles[best.triangle];
      result.stencils[i] = {v, {kept[t[0]], kept[t[1]], kept[t[2]]}, best.point.weight};
      result.triangles[i] = best.triangle;
    }
  });
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_NEAREST_TRIANGLE_H
