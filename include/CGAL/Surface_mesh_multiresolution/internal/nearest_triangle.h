// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NEAREST_TRIANGLE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NEAREST_TRIANGLE_H

#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Triangles_at_vertices.h>

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

// The point of triangle (a, b, c) nearest to the origin: the foot of the perpendicular if it lies
// inside, otherwise the best of the three sides.
inline Nearest_point nearest_to_origin(const std::array<Float_vector, 3>& corner)
{
  const Float_vector &a = corner[0], &b = corner[1], &c = corner[2];
  const Float_vector u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
  const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), au = -dot(a, u), av = -dot(a, v);
  const float area = uu * vv - uv * uv;
  const auto at = [&](const std::array<float, 3>& w) {
    const Float_vector p = {w[0] * a.x + w[1] * b.x + w[2] * c.x,
                            w[0] * a.y + w[1] * b.y + w[2] * c.y,
                            w[0] * a.z + w[1] * b.z + w[2] * c.z};
    return Nearest_point{dot(p, p), w};
  };
  if(area > 1e-12f * uu * vv) {
    const float wb = (vv * au - uv * av) / area, wc = (uu * av - uv * au) / area;
    if(wb >= 0.f && wc >= 0.f && wb + wc <= 1.f)
      return at({1.f - wb - wc, wb, wc});
  }
  Nearest_point best;
  for(int side = 0; side < 3; ++side) {
    const int next = side == 2 ? 0 : side + 1;
    const float t = nearest_on_segment(corner[side], corner[next]);
    std::array<float, 3> w = {0.f, 0.f, 0.f};
    w[side] = 1.f - t;
    w[next] = t;
    const Nearest_point candidate = at(w);
    if(candidate.squared_distance < best.squared_distance)
      best = candidate;
  }
  return best;
}

inline Nearest_point nearest_in_triangle(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                                         const Triangle_indices& t,
                                         const Indexed_triangle_mesh::Point_3& p)
{
  return nearest_to_origin({difference(points[t[0]], p), difference(points[t[1]], p),
                            difference(points[t[2]], p)});
}

// For each vertex of `fine` that is not kept, the weights of the nearest triangle of `coarse`: a
// walk from star to star, beginning at the ancestor and going to the vertex of the best triangle
// that weighs most, as long as that brings it nearer.
inline std::vector<Prolongation::Stencil>
walk_stencils(const Indexed_triangle_mesh& fine, const Indexed_triangle_mesh& coarse,
              const std::vector<Vertex_index>& kept, const std::vector<Vertex_index>& ancestor)
{
  const Triangles_at_vertices at(coarse.triangles, coarse.points.size());
  std::vector<Vertex_index> rank(fine.points.size());
  for(Vertex_index j = 0; j < kept.size(); ++j)
    rank[kept[j]] = j;
  std::vector<Prolongation::Stencil> result;
  result.reserve(fine.points.size() - kept.size());
  for(Vertex_index v = 0; v < fine.points.size(); ++v) {
    if(ancestor[v] == v)
      continue;
    Nearest_point best;
    Triangle_indices best_triangle = {0, 0, 0};
    Vertex_index star = rank[ancestor[v]], next_star = star;
    do {
      star = next_star;
      for(const std::uint32_t* corner = at.begin(star); corner != at.end(star); ++corner) {
        const Triangle_indices& t = coarse.triangles[*corner / 3];
        const Nearest_point candidate = nearest_in_triangle(coarse.points, t, fine.points[v]);
        if(candidate.squared_distance < best.squared_distance) {
          best = candidate;
          best_triangle = t;
          const auto heaviest = std::max_element(best.weight.begin(), best.weight.end());
          next_star = t[heaviest - best.weight.begin()];
        }
      }
    } while(next_star != star);
    result.push_back({v, {kept[best_triangle[0]], kept[best_triangle[1]], kept[best_triangle[2]]},
                      best.weight});
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_NEAREST_TRIANGLE_H
