// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

template <std::size_t N>
using Real_vector = std::array<double, N>;

template <std::size_t N>
Real_vector<N> minus(const Real_vector<N>& a, const Real_vector<N>& b)
{
  Real_vector<N> result;
  for(std::size_t i = 0; i < N; ++i)
    result[i] = a[i] - b[i];
  return result;
}

// a + s (b - a)
template <std::size_t N>
Real_vector<N> between(const Real_vector<N>& a, const Real_vector<N>& b, double s)
{
  Real_vector<N> result;
  for(std::size_t i = 0; i < N; ++i)
    result[i] = a[i] + s * (b[i] - a[i]);
  return result;
}

template <std::size_t N>
double product(const Real_vector<N>& a, const Real_vector<N>& b)
{
  double sum = 0.;
  for(std::size_t i = 0; i < N; ++i)
    sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
double norm(const Real_vector<N>& a)
{
  return std::sqrt(product(a, a));
}

typedef std::array<double, 3> Weights; // barycentric, with the sum 1

// Textured triangles whose arrays are somebody else's, with the triangles at each wedge.
class Textured_view
{
public:
  // `wedges`: how many of the wedges there are; the triangles have no others.
  Textured_view(const std::vector<Wedge_mesh::Point_3>& points,
                const std::vector<Vertex_index>& vertex,
                const std::vector<Wedge_mesh::Point_2>& uv,
                const std::vector<Triangle_indices>& triangles, std::size_t wedges)
    : m_points(points), m_vertex(vertex), m_uv(uv), m_triangles(triangles)
    , m_at(triangles, wedges)
  {
    for(Vertex_index w = 0; w < wedges && m_is_identity; ++w)
      m_is_identity = vertex[w] == w;
  }

  explicit Textured_view(const Wedge_mesh& mesh)
    : Textured_view(mesh.points, mesh.vertex, mesh.uv, mesh.triangles, mesh.uv.size())
  {}

  std::size_t number_of_wedges() const { return m_at.number_of_vertices(); }
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }
  const Triangles_at_vertices& at() const { return m_at; }
  Real_vector<3> point(Vertex_index w) const
  {
    const auto& p = m_points[m_is_identity ? w : m_vertex[w]];
    return {p.x(), p.y(), p.z()};
  }

  Real_vector<2> uv(Vertex_index w) const { return {m_uv[w].x(), m_uv[w].y()}; }

  Real_vector<3> point(Triangle_index t, const Weights& w) const
  {
    const Triangle_indices& abc = m_triangles[t];
    return combined(point(abc[0]), point(abc[1]), point(abc[2]), w);
  }

  Real_vector<2> uv(Triangle_index t, const Weights& w) const
  {
    const Triangle_indices& abc = m_triangles[t];
    return combined(uv(abc[0]), uv(abc[1]), uv(abc[2]), w);
  }

  // Some triangle at a wedge; 0 if the wedge has none.
  Triangle_index triangle_at(Vertex_index w) const
  {
    return m_at.number(w) == 0 ? 0 : triangle_of(*m_at.begin(w));
  }

  // The triangle beyond the side of t that is opposite to its corner c.
  Triangle_index neighbor(Triangle_index t, int c) const
  {
    const Vertex_index p = m_triangles[t][(c + 1) % 3], q = m_triangles[t][(c + 2) % 3];
    for(const std::uint32_t* corner = m_at.begin(p); corner != m_at.end(p); ++corner) {
      const Triangle_indices& s = m_triangles[triangle_of(*corner)];
      if(triangle_of(*corner) != t && (s[0] == q || s[1] == q || s[2] == q))
        return triangle_of(*corner);
    }
    return no_triangle;
  }

private:
  template <std::size_t N>
  static Real_vector<N> combined(const Real_vector<N>& a, const Real_vector<N>& b,
                                 const Real_vector<N>& c, const Weights& w)
  {
    Real_vector<N> result;
    for(std::size_t i = 0; i < N; ++i)
      result[i] = w[0] * a[i] + w[1] * b[i] + w[2] * c[i];
    return result;
  }

  const std::vector<Wedge_mesh::Point_3>& m_points;
  const std::vector<Vertex_index>& m_vertex;
  const std::vector<Wedge_mesh::Point_2>& m_uv;
  const std::vector<Triangle_indices>& m_triangles;
  Triangles_at_vertices m_at;
  bool m_is_identity = true; // `vertex`: saves a read from far away
};

// A point of a triangle. A weight is 0 just if the point lies on the side opposite to its corner.
struct Nearest_surface_point
  : Surface_point
{
  double squared_distance = (std::numeric_limits<double>::infinity)(); // from what it is nearest to
};

// The point nearest to the origin of the triangle abc in the plane or in space: the foot of the
// perpendicular, or the best point of the sides. (`nearest_in_triangle()` of the levels does this in
// float, with one division: what it weighs are prolongations; this one measures.)
template <std::size_t N>
Nearest_surface_point nearest_to_origin(const std::array<Real_vector<N>, 3>& abc)
{
  const Real_vector<N> u = minus(abc[1], abc[0]), v = minus(abc[2], abc[0]);
  const double uu = product(u, u), uv = product(u, v), vv = product(v, v);
  const double au = -product(abc[0], u), av = -product(abc[0], v);
  const double area = uu * vv - uv * uv, wb = vv * au - uv * av, wc = uu * av - uv * au;
  const auto at = [&abc](const Weights& w) {
    Real_vector<N> p;
    for(std::size_t i = 0; i < N; ++i)
      p[i] = w[0] * abc[0][i] + w[1] * abc[1][i] + w[2] * abc[2][i];
    return Nearest_surface_point{{no_triangle, w}, product(p, p)};
  };
  // Below 1e-24 of its squared sides, a doubled squared area is rounding.
  if(area > 1e-24 * uu * vv && wb > 0. && wc > 0. && wb + wc < area)
    return at({1. - (wb + wc) / area, wb / area, wc / area});
  Nearest_surface_point best;
  best.weights = {1., 0., 0.};
  for(int c = 0; c < 3; ++c) {
    const Real_vector<N>&a = abc[c], e = minus(abc[(c + 1) % 3], a);
    const double length = product(e, e);
    const double s = length > 0. ? -product(a, e) / length : 0.;
    Weights w = {0., 0., 0.};
    w[(c + 1) % 3] = (std::min)(1., (std::max)(0., s));
    w[c] = 1. - w[(c + 1) % 3];
    const Nearest_surface_point candidate = at(w);
    if(candidate.squared_distance < best.squared_distance)
      best = candidate;
  }
  return best;
}

// The point of triangle t that is nearest to p, in space or in the texture.
template <std::size_t N>
Nearest_surface_point nearest_in(const Textured_view& surface, Triangle_index t,
                                 const Real_vector<N>& p)
{
  const auto corner = [&](int c) {
    const Vertex_index w = surface.triangles()[t][c];
    if constexpr(N == 3)
      return minus(surface.point(w), p);
    else
      return minus(surface.uv(w), p);
  };
  Nearest_surface_point result = nearest_to_origin<N>({corner(0), corner(1), corner(2)});
  result.triangle = t;
  return result;
}

// A local minimum of the distance from p along the surface, which is no farther than any point of
// the triangle `start`: from a nearest point on a side, or at a corner, the descent goes on in the
// triangles beyond.
inline Nearest_surface_point descend_to_nearest(const Textured_view& surface, Triangle_index start,
                                        const Real_vector<3>& p)
{
  Nearest_surface_point best = nearest_in(surface, start, p);
  const auto improves = [&](Triangle_index t) {
    const Nearest_surface_point candidate = nearest_in(surface, t, p);
    const bool is_better = candidate.squared_distance < best.squared_distance;
    if(is_better)
      best = candidate;
    return is_better;
  };
  for(bool goes_on = true; goes_on;) {
    goes_on = false;
    const Weights w = best.weights;
    const Triangle_index t = best.triangle;
    const auto zeros = std::count(w.begin(), w.end(), 0.);
    if(zeros == 1) {
      const int c = int(std::find(w.begin(), w.end(), 0.) - w.begin());
      const Triangle_index next = surface.neighbor(t, c);
      goes_on = next != no_triangle && improves(next);
    } else if(zeros == 2) {
      const auto corner = std::max_element(w.begin(), w.end()) - w.begin();
      const Vertex_index v = surface.triangles()[t][std::size_t(corner)];
      for(const std::uint32_t* at = surface.at().begin(v); at != surface.at().end(v); ++at)
        goes_on = (triangle_of(*at) != t && improves(triangle_of(*at))) || goes_on;
    }
  }
  return best;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H
