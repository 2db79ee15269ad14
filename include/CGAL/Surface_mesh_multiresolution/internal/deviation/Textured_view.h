// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <array>
#include <cmath>
#include <cstdint>
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

typedef std::uint32_t Triangle_number;
constexpr Triangle_number no_triangle = Triangle_number(-1);

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

  Real_vector<3> point(Triangle_number t, const Weights& w) const
  {
    const Triangle_indices& abc = m_triangles[t];
    return combined(point(abc[0]), point(abc[1]), point(abc[2]), w);
  }

  Real_vector<2> uv(Triangle_number t, const Weights& w) const
  {
    const Triangle_indices& abc = m_triangles[t];
    return combined(uv(abc[0]), uv(abc[1]), uv(abc[2]), w);
  }

  // Some triangle at a wedge; 0 if the wedge has none.
  Triangle_number triangle_at(Vertex_index w) const
  {
    return m_at.number(w) == 0 ? 0 : *m_at.begin(w) / 3;
  }

  // The triangle beyond the side of t that is opposite to its corner c.
  Triangle_number neighbor(Triangle_number t, int c) const
  {
    const Vertex_index p = m_triangles[t][(c + 1) % 3], q = m_triangles[t][(c + 2) % 3];
    for(const std::uint32_t* corner = m_at.begin(p); corner != m_at.end(p); ++corner) {
      const Triangle_indices& s = m_triangles[*corner / 3];
      if(*corner / 3 != t && (s[0] == q || s[1] == q || s[2] == q))
        return *corner / 3;
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

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_TEXTURED_VIEW_H
