// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_UV_WALK_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_UV_WALK_H

#include <CGAL/Indexed_mesh/aabb_tree.h>
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Textured_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The way of a segment through the triangles of a chart.
enum class Way
{
  ARRIVED, // at its end
  LEFT,    // the chart, over its border
  LOST     // where triangles are folded, or have no area
};

// Walks from triangle to triangle in the texture. Triangles may lie over each other: what is found
// is what a walk finds that starts on the right sheet. Where it starts is up to the caller.
class Uv_walk
{
public:
  explicit Uv_walk(const Textured_view& surface) : m_surface(surface) {}

  // The point of the chart that has the texture coordinate p, or, if a search around the end of the
  // walk finds none, the nearest one.
  Nearest_surface_point locate(const Real_vector<2>& p, Triangle_index start) const;

  // Calls cross(t, w, s) where the segment (a, b) leaves a triangle t: there its point a + s (b -
  // a) has the weights w. Starts at `start`, which has a, or in its star if a is a corner of it,
  // and stops in `end`, or in another triangle that has b; `end` is no triangle if none has b. A
  // way that leaves the chart although `end` is one may come back, which is not followed.
  template <class Cross>
  Way follow(const Real_vector<2>& a, const Real_vector<2>& b, Triangle_index start,
             Triangle_index end, const Cross& cross) const;

  // The barycentric coordinates of p; not finite for a triangle without area.
  Weights weights(Triangle_index t, const Real_vector<2>& p) const
  {
    const Triangle_indices& abc = m_surface.triangles()[t];
    const Real_vector<2> a = minus(m_surface.uv(abc[0]), p), b = minus(m_surface.uv(abc[1]), p),
                         c = minus(m_surface.uv(abc[2]), p);
    const double wa = b[0] * c[1] - b[1] * c[0], wb = c[0] * a[1] - c[1] * a[0],
                 wc = a[0] * b[1] - a[1] * b[0], inverse = 1. / (wa + wb + wc);
    return {wa * inverse, wb * inverse, wc * inverse};
  }

private:
  // Barycentric coordinates differ by about this much from rounding, in triangles 1e5 times as long
  // as high at 1e-3 of the size of the map.
  static constexpr double rounding = 1e-8;

  Nearest_surface_point search(const Real_vector<2>& p, Triangle_index start) const;

  Triangle_index towards(const Real_vector<2>& a, const Real_vector<2>& b,
                          Triangle_index start) const;

  const Textured_view& m_surface;
};

inline Nearest_surface_point Uv_walk::locate(const Real_vector<2>& p, Triangle_index start) const
{
  constexpr int longest_walk = 200;
  Triangle_index t = start, from = no_triangle;
  for(int step = 0; step < longest_walk; ++step) {
    const Weights w = weights(t, p);
    if(!std::isfinite(w[0] + w[1] + w[2]))
      break;
    if(w[0] >= 0. && w[1] >= 0. && w[2] >= 0.)
      return {{t, w}, 0.};
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&w](int i, int j) { return w[i] < w[j]; });
    Triangle_index next = no_triangle;
    for(const int c : order)
      if(w[c] < 0. && next == no_triangle) {
        next = m_surface.neighbor(t, c);
        next = next == from ? no_triangle : next;
      }
    if(next == no_triangle)
      break;
    from = t;
    t = next;
  }
  return search(p, t);
}

// Visits the triangles around `start`, those nearest to p first, as long as they come nearer.
inline Nearest_surface_point Uv_walk::search(const Real_vector<2>& p, Triangle_index start) const
{
  constexpr int patience = 32; // visits without success
  const auto farther = [](const Nearest_surface_point& a, const Nearest_surface_point& b) {
    return a.squared_distance > b.squared_distance
           || (a.squared_distance == b.squared_distance && a.triangle > b.triangle);
  };
  std::vector<Triangle_index> seen(1, start);
  std::vector<Nearest_surface_point> front(1, nearest_in(m_surface, start, p)); // a heap
  Nearest_surface_point best = front[0]; // it stays if all distances are infinite
  best.squared_distance = (std::numeric_limits<double>::infinity)();
  for(int failures = 0; !front.empty() && failures < patience && best.squared_distance > 0.;) {
    std::pop_heap(front.begin(), front.end(), farther);
    const Nearest_surface_point here = front.back();
    front.pop_back();
    failures = here.squared_distance < best.squared_distance ? 0 : failures + 1;
    if(failures == 0)
      best = here;
    for(int c = 0; c < 3; ++c) {
      const Triangle_index next = m_surface.neighbor(here.triangle, c);
      if(next == no_triangle || std::find(seen.begin(), seen.end(), next) != seen.end())
        continue;
      seen.push_back(next);
      front.push_back(nearest_in(m_surface, next, p));
      std::push_heap(front.begin(), front.end(), farther);
    }
  }
  return best;
}

// The triangle where the segment (a, b) starts: `start`, or, if a is a corner of it, that triangle
// of its star between whose sides at the corner b is seen.
inline Triangle_index Uv_walk::towards(const Real_vector<2>& a, const Real_vector<2>& b,
                                        Triangle_index start) const
{
  const Weights w = weights(start, a);
  const auto heaviest = std::max_element(w.begin(), w.end());
  if(!(*heaviest > 1. - rounding))
    return start;
  const Vertex_index v = m_surface.triangles()[start][std::size_t(heaviest - w.begin())];
  Triangle_index best = start;
  double most = -(std::numeric_limits<double>::infinity)();
  for(const std::uint32_t* at = m_surface.at().begin(v); at != m_surface.at().end(v); ++at) {
    const int corner = int(corner_of(*at));
    const Weights seen = weights(triangle_of(*at), b);
    const double l = seen[std::size_t((corner + 1) % 3)], r = seen[std::size_t((corner + 2) % 3)];
    const double least = (std::min)(l, r) / (std::abs(l) + std::abs(r));
    if(least > most) {
      most = least;
      best = triangle_of(*at);
    }
  }
  return best;
}

template <class Cross>
Way Uv_walk::follow(const Real_vector<2>& a, const Real_vector<2>& b, Triangle_index start,
                    Triangle_index end, const Cross& cross) const
{
  constexpr int longest_way = 100000; // triangles; only rounding could send a way around in circles
  Triangle_index t = towards(a, b, start), from = no_triangle;
  double s = 0.;
  for(int step = 0; step < longest_way; ++step) {
    const Weights wa = weights(t, a), wb = weights(t, b);
    if(!std::isfinite(wa[0] + wa[1] + wa[2]))
      return Way::LOST;
    if(t == end || (wb[0] >= -rounding && wb[1] >= -rounding && wb[2] >= -rounding))
      return Way::ARRIVED;
    // The first of the sides that the segment crosses outwards
    const auto parameter = [&](int c) { return wa[c] / (wa[c] - wb[c]); };
    int side = -1;
    Triangle_index beyond = no_triangle;
    for(int c = 0; c < 3; ++c) {
      if(!(wb[c] < 0. && wb[c] < wa[c]) || (side >= 0 && parameter(c) >= parameter(side)))
        continue;
      const Triangle_index next = m_surface.neighbor(t, c);
      const bool grazes = next == no_triangle && end != no_triangle && wb[c] >= -rounding;
      if(grazes || (next != no_triangle && next == from))
        continue;
      side = c;
      beyond = next;
    }
    if(side < 0)
      return Way::LOST;
    s = (std::max)(s, parameter(side));
    const Weights w = between<3>(wa, wb, s);
    // Outside of the triangle that it crosses: the next one lies over this one.
    if(!(s <= 1.) || *std::min_element(w.begin(), w.end()) < -100. * rounding)
      return Way::LOST;
    cross(t, w, s);
    if(beyond == no_triangle)
      return Way::LEFT;
    from = t;
    t = beyond;
  }
  return Way::LOST;
}

// Where the points of wedges are on a surface that is known as triangles alone: nearby in space.
class Nearest_start
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef Aabb_triangle_primitive<Kernel, Triangles::const_iterator> Primitive;
  typedef Aabb_tree<Kernel, Primitive> Tree;

public:
  // `from` has the wedges, `to` is the surface, with at least one triangle that has an area.
  Nearest_start(const Textured_view& from, const Textured_view& to) : m_from(from), m_to(to)
  {
    for(Triangle_index t = 0; t < to.triangles().size(); ++t) {
      const Triangle_indices& abc = to.triangles()[t];
      const Kernel::Triangle_3 triangle(point(to.point(abc[0])), point(to.point(abc[1])),
                                        point(to.point(abc[2])));
      if(triangle.is_degenerate())
        continue;
      m_triangles.push_back(triangle);
      m_number.push_back(t);
    }
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
    m_tree.accelerate_distance_queries();
  }

  Nearest_start(const Nearest_start&) = delete;
  Nearest_start& operator=(const Nearest_start&) = delete;

  bool is_kept(Vertex_index) const { return false; }
  bool is_common_edge(Vertex_index, Vertex_index) const { return false; }

  // Nearest to a place within the triangles of w, lest the walk start beyond a seam.
  Triangle_index start(Vertex_index w) const
  {
    constexpr double inwards = 1. / 3.;
    return nearest_triangle(between(m_from.point(w), middle_of_star(w), inwards));
  }

  double squared_distance(Vertex_index w, const Nearest_surface_point& nearest) const
  {
    const Triangle_index t = nearest_triangle(m_from.point(w));
    return (std::min)(nearest_in(m_to, t, m_from.point(w)).squared_distance,
                      nearest.squared_distance);
  }

private:
  static Kernel::Point_3 point(const Real_vector<3>& p)
  {
    return Kernel::Point_3(p[0], p[1], p[2]);
  }

  Triangle_index nearest_triangle(const Real_vector<3>& p) const
  {
    const auto found = m_tree.closest_point_and_primitive(point(p)).second;
    return m_number[std::size_t(found - m_triangles.cbegin())];
  }

  Real_vector<3> middle_of_star(Vertex_index w) const
  {
    Real_vector<3> sum = {0., 0., 0.};
    const double number = 3. * m_from.at().number(w);
    for(const std::uint32_t* at = m_from.at().begin(w); at != m_from.at().end(w); ++at)
      for(const Vertex_index v : m_from.triangles()[triangle_of(*at)])
        for(std::size_t c = 0; c < 3; ++c)
          sum[c] += m_from.point(v)[c] / number;
    return number > 0. ? sum : m_from.point(w);
  }

  const Textured_view &m_from, &m_to;
  Triangles m_triangles;
  std::vector<Triangle_index> m_number; // of each of them
  Tree m_tree;
};

// A level of a progressive mesh, where the points that belong to a wedge are at its ancestor.
class Level_start
{
public:
  Level_start(const Textured_progressive_mesh& mesh, std::size_t k)
    : m_mesh(mesh), m_ancestor(wedge_ancestors(mesh, 0, k))
    , m_triangles(level_triangles(mesh, k, m_ancestor)), m_kept(mesh.number_of_wedges_after(k))
    , m_view(mesh.points, mesh.vertex, mesh.uv, m_triangles, m_kept)
  {
    if(mesh.points.size() < mesh.number_of_wedges())
      join_charts();
  }

  Level_start(const Level_start&) = delete;
  Level_start& operator=(const Level_start&) = delete;

  const Textured_view& view() const { return m_view; }

  bool is_kept(Vertex_index w) const { return w < m_kept; }

  bool is_common_edge(Vertex_index v, Vertex_index w) const
  {
    if(!is_kept(v) || !is_kept(w))
      return false;
    for(const std::uint32_t* at = m_view.at().begin(v); at != m_view.at().end(v); ++at) {
      const Triangle_indices& t = m_triangles[triangle_of(*at)];
      if(t[0] == w || t[1] == w || t[2] == w)
        return true;
    }
    return false;
  }

  Triangle_index start(Vertex_index w) const { return m_view.triangle_at(m_ancestor[w]); }

  // Beyond a seam, the descent goes on in other charts.
  double squared_distance(Vertex_index w, const Nearest_surface_point& nearest) const
  {
    return m_joined ? descend_to_nearest(*m_joined, nearest.triangle, m_view.point(w))
                        .squared_distance
                    : nearest.squared_distance;
  }

private:
  // The same triangles as a mesh of the vertices
  void join_charts()
  {
    m_joined_triangles.reserve(m_triangles.size());
    for(const Triangle_indices& t : m_triangles)
      m_joined_triangles.push_back(replaced(t, m_mesh.vertex));
    m_identity.resize(m_mesh.points.size());
    std::iota(m_identity.begin(), m_identity.end(), Vertex_index(0));
    m_joined = std::make_unique<Textured_view>(m_mesh.points, m_identity, m_mesh.uv,
                                               m_joined_triangles, m_identity.size());
  }

  const Textured_progressive_mesh& m_mesh;
  std::vector<Vertex_index> m_ancestor;
  std::vector<Triangle_indices> m_triangles;
  std::size_t m_kept;
  Textured_view m_view;
  std::vector<Triangle_indices> m_joined_triangles;
  std::vector<Vertex_index> m_identity;
  std::unique_ptr<Textured_view> m_joined; // none if there are no seams
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_UV_WALK_H
