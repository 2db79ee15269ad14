// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_SOUP_SIDES_H
#define CGAL_INDEXED_MESH_INTERNAL_SOUP_SIDES_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/internal/Edge_table.h>
#include <CGAL/Indexed_mesh/internal/Parity_sets.h>
#include <CGAL/Indexed_mesh/internal/Soup_triangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// What stays joined at edges of more than two sides.
enum class Crossing_joints { NONE, DIAGONALS, ALL };

// Which sides of the triangles of a soup stay joined, and which triangles are to be turned so that
// joined ones agree.
class Soup_sides
{
public:
  Soup_sides(const Polygon_soup& soup, const Soup_triangles& triangles, Crossing_joints joints)
    : m_soup(soup), m_all(triangles), m_triangles(triangles.vertices)
    , m_opposite(3 * m_triangles.size(), no_halfedge)
  {
    Edge_table table(m_triangles, soup.points.size());
    table.for_each_edge([&](Vertex_index v, const Side* first, const Side* last) {
      if(last - first == 2)
        join(first[0].corner, first[1].corner);
      if(last - first < 3)
        return;
      separated.add(v, first->other_end);
      m_crossings.push_back(m_crossing_sides.size());
      for(const Side* side = first; side != last; ++side)
        m_crossing_sides.push_back(side->corner);
      if(joints != Crossing_joints::NONE)
        join_diagonals(first, last);
    });
    m_crossings.push_back(m_crossing_sides.size());
    orient();
    for(std::size_t i = 0; joints == Crossing_joints::ALL && i + 1 < m_crossings.size(); ++i)
      join_crossing(m_crossing_sides.data() + m_crossings[i],
                    m_crossing_sides.data() + m_crossings[i + 1]);
  }

  // Turns as few triangles as possible in each component until all agree.
  void turn(Soup_triangles& triangles)
  {
    std::vector<std::size_t> faces(m_sign.size()), turned(m_sign.size());
    for(Triangle_index t = 0; t < m_sign.size(); ++t) {
      const std::uint32_t set = m_sets.find_with_parity(m_component[t]);
      m_sign[t] ^= std::uint8_t(set & 1);
      ++faces[set >> 1];
      turned[set >> 1] += m_sign[t] ^ triangles.is_turned[t];
    }
    for(Triangle_index t = 0; t < m_sign.size(); ++t) {
      const std::size_t set = m_sets.find(m_component[t]);
      m_sign[t] ^= std::uint8_t(2 * turned[set] > faces[set]);
    }
    const auto moved = [this](Halfedge h) { // where the side is once its triangle is turned
      return m_sign[triangle_of(h)] ? 3 * triangle_of(h) + 2 - corner_of(h) : h;
    };
    std::vector<Halfedge> opposite(m_opposite.size());
    for(Halfedge h = 0; h < m_opposite.size(); ++h)
      opposite[moved(h)] = m_opposite[h] == no_halfedge ? no_halfedge : moved(m_opposite[h]);
    m_opposite.swap(opposite);
    for(Triangle_index t = 0; t < m_sign.size(); ++t)
      if(m_sign[t])
        triangles.turn(t);
  }

  // Whether the triangles at a diagonal are joined.
  bool is_within_face(Halfedge h) const
  {
    const Halfedge o = m_opposite[h];
    return o != no_halfedge && m_all.face[triangle_of(h)] == m_all.face[triangle_of(o)]
        && is_diagonal(h) && is_diagonal(o);
  }

  // The side joined to side h, or `no_halfedge`.
  Halfedge opposite(Halfedge h) const { return m_opposite[h]; }

  Soup_finding cut, separated; // see Soup_repairs

private:
  static constexpr std::uint32_t none = std::uint32_t(-1);

  typedef Edge_table::Side Side;
  typedef std::array<double, 3> Vector;

  void join(Halfedge h, Halfedge o)
  {
    m_opposite[h] = o;
    m_opposite[o] = h;
  }

  bool is_same_direction(Halfedge h, Halfedge o) const
  {
    return vertex_of(m_triangles, h) == vertex_of(m_triangles, o);
  }

  // Component by component, from each face to its neighbours, nearest first, so that the edges where
  // this fails lie together, and none of them is a diagonal.
  void orient()
  {
    std::uint32_t number = 0;
    m_sign.assign(m_triangles.size(), 0);
    m_component.assign(m_triangles.size(), none);
    for(Triangle_index seed = 0; seed < m_triangles.size(); ++seed) {
      if(m_component[seed] != none)
        continue;
      std::vector<Triangle_index> queue;
      reach(seed, 0, number, queue);
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(Halfedge h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
          const Halfedge o = m_opposite[h];
          if(o == no_halfedge)
            continue;
          const std::uint8_t sign = sign_across(h, o);
          if(m_component[triangle_of(o)] == none) {
            reach(triangle_of(o), sign, number, queue);
          } else if(m_sign[triangle_of(o)] != sign) {
            cut.add(vertex_of(m_triangles, h), vertex_of(m_triangles, next_halfedge(h)));
            m_opposite[h] = m_opposite[o] = no_halfedge;
          }
        }
      ++number;
    }
    m_sets = Parity_sets(number);
  }

  std::uint8_t sign_across(Halfedge h, Halfedge o) const
  {
    return m_sign[triangle_of(h)] ^ std::uint8_t(is_same_direction(h, o));
  }

  // A triangle, and those of its face across diagonals.
  void reach(Triangle_index t, std::uint8_t sign, std::uint32_t component,
             std::vector<Triangle_index>& queue)
  {
    m_component[t] = component;
    m_sign[t] = sign;
    queue.push_back(t);
    for(std::size_t i = queue.size() - 1; i < queue.size(); ++i)
      for(Halfedge h = 3 * queue[i]; m_all.diagonals[queue[i]] != 0 && h < 3 * queue[i] + 3; ++h) {
        const Halfedge o = m_opposite[h];
        if(o == no_halfedge || !is_diagonal(h)
           || m_all.face[triangle_of(o)] != m_all.face[queue[i]]
           || m_component[triangle_of(o)] != none)
          continue;
        m_component[triangle_of(o)] = component;
        m_sign[triangle_of(o)] = sign_across(h, o);
        queue.push_back(triangle_of(o));
      }
  }

  bool is_diagonal(Halfedge h) const
  {
    return (m_all.diagonals[triangle_of(h)] >> corner_of(h) & 1) != 0;
  }

  // Joins the triangles of one face; their sides follow one another.
  void join_diagonals(const Side* first, const Side* last)
  {
    for(const Side* side = first + 1; side != last; ++side) {
      const Halfedge h = side[-1].corner, o = side->corner;
      if(m_opposite[h] == no_halfedge && is_diagonal(h) && is_diagonal(o)
         && m_all.face[triangle_of(h)] == m_all.face[triangle_of(o)])
        join(h, o);
    }
  }

  // Pairs the sides at an edge, the flattest first.
  void join_crossing(const Halfedge* begin, const Halfedge* end)
  {
    constexpr std::ptrdiff_t most = 16; // sides that are worth a look
    constexpr double flattest = -0.7071; // cosine of the angle between faces: 135 degrees
    struct Pair
    {
      double cosine;
      Halfedge h, o;
    };
    std::vector<Pair> pairs;
    for(const Halfedge* h = begin; end - begin <= most && h != end; ++h)
      for(const Halfedge* o = h + 1; o != end; ++o) {
        const double cosine = cosine_between(*h, *o);
        if(cosine < flattest)
          pairs.push_back({cosine, *h, *o});
      }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.cosine < b.cosine; });
    for(const Pair& p : pairs) {
      if(m_opposite[p.h] != no_halfedge || m_opposite[p.o] != no_halfedge)
        continue;
      const Triangle_index t = triangle_of(p.h), u = triangle_of(p.o);
      if(!m_sets.unite(m_component[t], m_component[u],
                       (m_sign[t] ^ m_sign[u] ^ std::uint8_t(is_same_direction(p.h, p.o))) != 0))
        continue;
      join(p.h, p.o);
    }
  }

  // Of the angle between two triangles at their edge: -1 if they continue each other.
  double cosine_between(Halfedge h, Halfedge o) const
  {
    const Vector a = into(h), b = into(o);
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  // The unit vector into the triangle, orthogonal to the edge; 0 if there is none.
  Vector into(Halfedge h) const
  {
    const auto &p = m_soup.points[vertex_of(m_triangles, h)],
               &q = m_soup.points[vertex_of(m_triangles, next_halfedge(h))],
               &r = m_soup.points[vertex_of(m_triangles, previous_halfedge(h))];
    const Vector e = unit({q.x() - p.x(), q.y() - p.y(), q.z() - p.z()});
    Vector f = unit({r.x() - p.x(), r.y() - p.y(), r.z() - p.z()});
    const double along = e[0] * f[0] + e[1] * f[1] + e[2] * f[2];
    for(std::size_t k = 0; k < 3; ++k)
      f[k] -= along * e[k];
    return unit(f);
  }

  static Vector unit(Vector v)
  {
    const double length = std::hypot(v[0], v[1], v[2]);
    for(double& x : v)
      x = length > 0. && std::isfinite(length) ? x / length : 0.;
    return v;
  }

  const Polygon_soup& m_soup;
  const Soup_triangles& m_all;
  const std::vector<Triangle_indices>& m_triangles; // their vertices
  std::vector<Halfedge> m_opposite;
  std::vector<std::uint8_t> m_sign; // whether a triangle is to be turned, in its component
  std::vector<std::uint32_t> m_component;
  Parity_sets m_sets{0}; // of components that have been joined
  std::vector<std::size_t> m_crossings; // the begin of each edge of more than two sides
  std::vector<Halfedge> m_crossing_sides;
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_SOUP_SIDES_H
