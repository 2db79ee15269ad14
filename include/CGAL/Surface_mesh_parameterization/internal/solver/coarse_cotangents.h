// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSE_COTANGENTS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSE_COTANGENTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Multigrid/vector_operations.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A mesh, and the triangles at its vertices.
struct Connected_mesh
{
  const Indexed_mesh::Indexed_triangle_mesh& mesh;
  const Indexed_mesh::Triangles_at_vertices& at;
};

// The same with a metric, which need not be that of the points.
struct Metric_mesh
  : Connected_mesh
{
  const Half_cotangents& cot;
};

// Gives a coarse level the metric of the fine one. The chords of a noisy surface, or of one made of
// slivers, are smoother than it: what is conformal for them has a much higher energy on the
// surface, and a coarse correction that does not know of it goes too far. So a coarse triangle T
// gets the mean of the cotangents that the fine triangles t below it have in its barycentric
// coordinates, the functions lambda_0, lambda_1, lambda_2, linear on each t:
//
//   cot_k(T) = - sum_t sum_e cot_e(t) (d_e lambda_i) (d_e lambda_j) / sum_t |area(lambda(t))|
//
// with the differences d_e along the three edges e of t and {i, j, k} = {0, 1, 2}. The right-hand
// side is twice the Dirichlet energy of linear functions in the metric of the fine triangles, in
// units of the triangle that they cover: so much of the product P^T H P as fits into the pattern of
// the coarse matrix. The conformal energy of T is not negative: that of the fine triangles is not.
class Coarse_metric
{
public:
  typedef Indexed_mesh::Indexed_triangle_mesh Mesh;
  typedef Indexed_mesh::Triangle_indices Triangle_indices;
  typedef Surface_mesh_multiresolution::Prolongation Prolongation;

  // `triangles`: for each stencil the coarse triangle of its sources, or none if they must be
  // searched for
  Coarse_metric(const Metric_mesh& fine, const Connected_mesh& coarse,
                const Prolongation& prolongation, const std::vector<std::uint32_t>& triangles)
    : m_fine(fine), m_coarse(coarse), m_kept(prolongation.kept())
  {
    find_owners(prolongation, triangles);
  }

  // The cotangents of the coarse level; those of its own geometry where nothing better is known.
  Half_cotangents cotangents() const;

private:
  typedef Simple_cartesian<double>::Vector_3 Vector;

  struct Gradients // of lambda_1 and lambda_2 in the plane of a coarse triangle
  {
    Vector g1, g2;
  };

  struct Sum
  {
    std::array<double, 3> value = {0., 0., 0.};
    double area = 0.;
  };

  void find_gradients(std::size_t begin, std::size_t end, std::vector<Gradients>& gradients) const;
  void find_owners(const Prolongation& prolongation, const std::vector<std::uint32_t>& triangles);
  std::uint32_t triangle_with(const std::array<std::uint32_t, 3>& corners) const;
  std::uint32_t owner_of(std::uint32_t t, const std::vector<std::uint32_t>& rank,
                         const std::vector<std::uint32_t>& owner_of_vertex) const;
  std::uint32_t triangle_toward(std::uint32_t v, const Vector& direction) const;
  void prefetch(std::uint32_t i) const;
  void add(std::uint32_t t, const Gradients& gradients, Sum& sum) const;

  const Metric_mesh& m_fine;
  const Connected_mesh& m_coarse;
  const std::vector<std::uint32_t>& m_kept;
  // The fine triangles below each coarse one
  Blocked_execution::Uninitialized_vector<std::uint32_t> m_begin, m_below;
};

// Of the coarse triangles [begin, end).
inline void Coarse_metric::find_gradients(std::size_t begin, std::size_t end,
                                          std::vector<Gradients>& gradients) const
{
  const Mesh& mesh = m_coarse.mesh;
  gradients.resize(end - begin);
  for(std::size_t t = begin; t < end; ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const Vector a = mesh.points[v[1]] - mesh.points[v[0]];
    const Vector b = mesh.points[v[2]] - mesh.points[v[0]];
    const double aa = a * a, ab = a * b, bb = b * b, determinant = aa * bb - ab * ab;
    if(determinant > 1e-12 * aa * bb)
      gradients[t - begin] = {(bb / determinant) * a - (ab / determinant) * b,
                              (aa / determinant) * b - (ab / determinant) * a};
    else // nothing covers it: it keeps its own cotangents
      gradients[t - begin] = {Vector(0., 0., 0.), Vector(0., 0., 0.)};
  }
}

// The coarse triangle that has the three corners, if there is one.
inline std::uint32_t
Coarse_metric::triangle_with(const std::array<std::uint32_t, 3>& corners) const
{
  const auto has = [](const Triangle_indices& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
  };
  if(corners[0] == no_vertex || corners[1] == no_vertex || corners[2] == no_vertex)
    return no_triangle;
  const auto& at = m_coarse.at;
  for(const std::uint32_t* c = at.begin(corners[0]); c != at.end(corners[0]); ++c) {
    const Triangle_indices& t = m_coarse.mesh.triangles[*c / 3];
    if(has(t, corners[1]) && has(t, corners[2]))
      return *c / 3;
  }
  return no_triangle;
}

// The coarse triangle above the fine triangle t: that of two of its vertices if they agree, that of
// one otherwise. The metric hardly differs from one to the next.
inline std::uint32_t
Coarse_metric::owner_of(std::uint32_t t, const std::vector<std::uint32_t>& rank,
                        const std::vector<std::uint32_t>& owner_of_vertex) const
{
  const Triangle_indices& v = m_fine.mesh.triangles[t];
  const std::uint32_t a = owner_of_vertex[v[0]], b = owner_of_vertex[v[1]],
                      c = owner_of_vertex[v[2]];
  const std::uint32_t first = a != no_triangle ? a : c, other = b != no_triangle ? b : first;
  const std::uint32_t owner = a != no_triangle && (a == b || a == c) ? a : other;
  return owner != no_triangle ? owner : triangle_with({rank[v[0]], rank[v[1]], rank[v[2]]});
}

inline void Coarse_metric::find_owners(const Prolongation& prolongation,
                                       const std::vector<std::uint32_t>& triangles)
{
  const std::vector<std::uint32_t> rank
    = Indexed_mesh::ranks(m_kept, m_fine.mesh.points.size());
  std::vector<std::uint32_t> owner_of_vertex(rank.size(), no_triangle);
  const auto& stencils = prolongation.stencils();
  Blocked_execution::blocked_for(stencils.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const auto& s = stencils[i].source;
      owner_of_vertex[stencils[i].vertex]
        = !triangles.empty() ? triangles[i]
                             : triangle_with({rank[s[0]], rank[s[1]], rank[s[2]]});
    }
  });
  Blocked_execution::Uninitialized_vector<std::uint32_t> owner(
    m_fine.mesh.triangles.size());
  Blocked_execution::blocked_for(owner.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t)
      owner[t] = owner_of(std::uint32_t(t), rank, owner_of_vertex);
  });
  const auto for_each_owned = [&owner](const auto& use) {
    for(std::uint32_t t = 0; t < owner.size(); ++t) // `no_triangle` is no key
      use(owner[t], t);
  };
  m_begin = Blocked_execution::sort_by_key(
    m_coarse.mesh.triangles.size(), for_each_owned,
    [this](std::size_t count) { m_below.resize(count); },
    [this](std::uint32_t i, std::uint32_t t) { m_below[i] = t; });
}

// Asks for what the sums over the fine triangles after m_below[i] will read: triangles first and,
// when these are there, their points.
inline void Coarse_metric::prefetch(std::uint32_t i) const
{
  using Blocked_execution::prefetch;
  constexpr std::uint32_t distance = 8;
  if(i + 2 * distance >= m_below.size())
    return;
  const std::uint32_t later = m_below[i + 2 * distance];
  Blocked_execution::prefetch(&m_fine.mesh.triangles[later]);
  Blocked_execution::prefetch(&m_fine.cot.value[3 * later]);
  for(const std::uint32_t v : m_fine.mesh.triangles[m_below[i + distance]])
    Blocked_execution::prefetch(&m_fine.mesh.points[v]);
}

inline void Coarse_metric::add(std::uint32_t t, const Gradients& gradients, Sum& sum) const
{
  const auto& p = m_fine.mesh.points;
  const Triangle_indices& v = m_fine.mesh.triangles[t];
  // The differences of lambda_1 and lambda_2 along the edges, whose sum is 0
  const Vector w1 = p[v[0]] - p[v[2]], w2 = p[v[1]] - p[v[0]];
  std::array<double, 3> d1 = {0., gradients.g1 * w1, gradients.g1 * w2};
  std::array<double, 3> d2 = {0., gradients.g2 * w1, gradients.g2 * w2};
  d1[0] = -(d1[1] + d1[2]);
  d2[0] = -(d2[1] + d2[2]);
  for(int e = 0; e < 3; ++e) {
    const double cot = m_fine.cot.value[3 * t + e], d0 = -(d1[e] + d2[e]);
    sum.value[0] -= cot * d1[e] * d2[e];
    sum.value[1] -= cot * d2[e] * d0;
    sum.value[2] -= cot * d0 * d1[e];
  }
  sum.area += std::abs(d1[1] * d2[2] - d2[1] * d1[2]);
}

// The fine triangle at v that a direction points into, nearly at least.
inline std::uint32_t Coarse_metric::triangle_toward(std::uint32_t v, const Vector& direction) const
{
  const auto& p = m_fine.mesh.points;
  std::uint32_t best = no_triangle;
  double most = -0.2;
  for(const std::uint32_t* corner = m_fine.at.begin(v); corner != m_fine.at.end(v); ++corner) {
    const Indexed_mesh::Triangle_corner c(*corner);
    const Triangle_indices& t = m_fine.mesh.triangles[c.triangle];
    const Vector a = p[t[c.next]] - p[v], b = p[t[c.last]] - p[v];
    const double aa = a * a, ab = a * b, bb = b * b, ad = a * direction, bd = b * direction;
    const double x = bb * ad - ab * bd, y = aa * bd - ab * ad; // times a positive number
    const double inside = (std::min)(x, y), size = std::abs(x) + std::abs(y);
    if(inside > most * size) { // false for what is not a number
      most = inside / size;
      best = c.triangle;
    }
  }
  return best;
}

inline Half_cotangents Coarse_metric::cotangents() const
{
  constexpr double enough = 0.05; // what covers less of a triangle says nothing about it
  // c_1 c_2 + c_2 c_3 + c_3 c_1 of half cotangents is 1/4 in a plane, and grows as the fine
  // triangles disagree about the angles; beyond this they are folded.
  constexpr double folded = 25.;
  const auto& triangles = m_coarse.mesh.triangles;
  Half_cotangents result;
  result.value.resize(3 * triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<Gradients> gradients;
    find_gradients(begin, end, gradients);
    for(std::size_t t = begin; t < end; ++t) {
      Sum sum;
      for(std::uint32_t i = m_begin[t]; i < m_begin[t + 1]; ++i) {
        prefetch(i);
        add(m_below[i], gradients[t - begin], sum);
      }
      if(sum.area < enough) { // no larger than a fine triangle: ask those that it begins in
        const auto& q = m_coarse.mesh.points;
        const Triangle_indices& v = triangles[t];
        for(int c = 0; c < 3; ++c) {
          const auto &next = q[v[(c + 1) % 3]], &last = q[v[(c + 2) % 3]];
          const Vector to_middle = ((next - q[v[c]]) + (last - q[v[c]])) / 3.;
          const std::uint32_t at_corner = triangle_toward(m_kept[v[c]], to_middle);
          if(at_corner != no_triangle)
            add(at_corner, gradients[t - begin], sum);
        }
      }
      const double a = sum.value[0] / sum.area, b = sum.value[1] / sum.area,
                   c = sum.value[2] / sum.area;
      if(sum.area > enough && a * b + b * c + c * a < folded)
        result.set(t, {a, b, c});
      else
        result.set(t, half_cotangents(conformal_triangle(m_coarse.mesh, t)));
    }
  });
  return result;
}

// The cotangents of a coarse level in the metric of a fine one. `triangles`: for each stencil the
// coarse triangle of its sources, if it is known. Linear time.
inline Half_cotangents
coarse_cotangents(const Metric_mesh& fine, const Connected_mesh& coarse,
                  const Surface_mesh_multiresolution::Prolongation& p,
                  const std::vector<std::uint32_t>& triangles = std::vector<std::uint32_t>())
{
  return Coarse_metric(fine, coarse, p, triangles).cotangents();
}

// The weights of the triangles of each level, from those of the finest; none if those are empty.
// Coarse triangles get the mean weight of the fine ones that they stand for, so that the energy of
// a level resembles that of the finest.
inline std::vector<std::vector<double>>
level_weights(const std::vector<Surface_mesh_multiresolution::Mesh_level>& levels,
              std::vector<double> finest)
{
  std::vector<std::vector<double>> weights(levels.size());
  if(finest.empty())
    return weights;
  weights.back() = std::move(finest);
  const auto& triangles = levels.back().mesh.triangles;
  // Weight and number of the triangles at each vertex
  Multigrid::Complex_vector<double> density(levels.back().vertices.size(), 0.), coarse;
  for(std::size_t t = 0; t < triangles.size(); ++t)
    for(const auto v : triangles[t])
      density[v] += std::complex<double>(weights.back()[t], 1.);
  for(std::size_t l = levels.size() - 1; l-- > 0;) {
    levels[l + 1].from_coarser.restrict_in_place(density, coarse);
    density.swap(coarse);
    for(const auto& t : levels[l].mesh.triangles) {
      const std::complex<double> sum = density[t[0]] + density[t[1]] + density[t[2]];
      weights[l].push_back(sum.real() / sum.imag());
    }
  }
  return weights;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSE_COTANGENTS_H
