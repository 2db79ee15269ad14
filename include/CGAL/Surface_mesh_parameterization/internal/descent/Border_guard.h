// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_GUARD_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_GUARD_H

#include <CGAL/Surface_mesh_parameterization/internal/descent/Border_barrier.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The border of a map while vertices are put into it, or moved one by one: where they may go without
// crossing it.
class Border_guard
{
public:
  typedef std::vector<Plane_point> Places;

  // `places` are those of all vertices, of which only those of the loops count. What moves stays
  // `distance` times the length of an edge off it.
  Border_guard(const Border_loops& loops, const Places& places, double distance)
    : m_places(places), m_distance(distance)
    , m_next(loops.empty() ? 0 : places.size(), Indexed_mesh::no_vertex), m_previous(m_next)
  {
    const auto edges = edges_of(loops);
    if(edges.empty())
      return;
    Plane_point low = places[edges[0][0]], high = low;
    for(const auto& e : edges) {
      low = lower(low, places[e[0]]);
      high = upper(high, places[e[0]]);
    }
    const double extent = (std::max)(high.x - low.x, high.y - low.y);
    m_origin = low;
    m_cells = std::sqrt(double(edges.size())) / extent;
    for(const auto& e : edges)
      add(e[0], e[1]);
  }

  // Whether v may go to z between the ends a and b of an edge of the border, which has the surface on
  // its left: on that side, where the triangles of v do not turn over, or where nothing is in between, and
  // nothing as near as `distance` times the length of an edge.
  bool allows(const Plane_point& z, Vertex_index a, Vertex_index b, double distance) const
  {
    const Plane_point &p = m_places[a], &q = m_places[b];
    if(is_surely_positive(p, q, z))
      return true;
    return is_free(z, nullptr, a, b, distance * longer_edge(z, p, q),
                   [a](const Edge& e) { return e[0] == a; });
  }

  // Whether v, which is on the border, may move to z.
  bool allows_move(const Plane_point& z, Vertex_index v) const
  {
    const Vertex_index a = m_previous[v], b = m_next[v];
    const Plane_point &p = m_places[a], &q = m_places[b];
    if(m_next[b] == a && (is_surely_positive(p, z, q) != is_surely_positive(p, m_places[v], q)
                          || is_surely_positive(p, q, z) != is_surely_positive(p, q, m_places[v])))
      return false; // a border of three vertices would turn over
    return is_free(z, &m_places[v], a, b, m_distance * longer_edge(z, p, q),
                   [v](const Edge& e) { return e[0] == v || e[1] == v; });
  }

  // Takes note that v, which is on the border, has moved.
  void move(Vertex_index v)
  {
    add(m_previous[v], v);
    add(v, m_next[v]);
  }

  // Puts v, which has its place, between the ends of an edge.
  void insert(Vertex_index v, Vertex_index a, Vertex_index b)
  {
    add(a, v);
    add(v, b);
  }

private:
  typedef std::array<Vertex_index, 2> Edge;

  // That from z to p or to q.
  static double longer_edge(const Plane_point& z, const Plane_point& p, const Plane_point& q)
  {
    return std::sqrt((std::max)((p - z).squared_length(), (q - z).squared_length()));
  }

  static Plane_point lower(const Plane_point& a, const Plane_point& b)
  {
    return {(std::min)(a.x, b.x), (std::min)(a.y, b.y)};
  }
  static Plane_point upper(const Plane_point& a, const Plane_point& b)
  {
    return {(std::max)(a.x, b.x), (std::max)(a.y, b.y)};
  }

  // Whether the border may go from a by z to b, where it goes by `before`, or straight on if that is null:
  // whether the segments keep off all edges but those of which `is_left_out`, or come no nearer to them, and
  // no border lies between both ways, as a hole that z goes across would.
  template <class Is_left_out>
  bool is_free(const Plane_point& z, const Plane_point* before, Vertex_index a, Vertex_index b,
               double distance, const Is_left_out& is_left_out) const
  {
    const Plane_point &p = m_places[a], &q = m_places[b], &o = before != nullptr ? *before : p;
    const Plane_point margin = {distance, distance};
    const std::array<Plane_point, 4> between = {p, o, q, z};
    bool result = true;
    const Plane_point low = lower(lower(p, q), lower(o, z)) - margin,
                      high = upper(upper(p, q), upper(o, z)) + margin;
    const auto is_too_near = [&](Vertex_index v, const Edge& e) {
      if(!(distance > 0.))
        return false;
      const double there = squared_distance(z, v, e);
      return there < distance * distance && !(before != nullptr && there > squared_distance(o, v, e));
    };
    for_each_cell(low, high, [&](std::uint64_t cell) {
      const auto found = m_edges.find(cell);
      if(!result || found == m_edges.end())
        return;
      for(const Edge& e : found->second)
        if(m_next[e[0]] == e[1] && !is_left_out(e))
          result = result && !meet(z, a, e) && !meet(z, b, e) && !is_too_near(a, e) && !is_too_near(b, e)
                && (e[0] == a || e[0] == b || !contains(between, m_places[e[0]]));
    });
    return result;
  }

  // Whether a polygon, which may cross itself, goes around z an odd number of times.
  static bool contains(const std::array<Plane_point, 4>& polygon, const Plane_point& z)
  {
    bool result = false;
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const Plane_point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if((a.y > z.y) != (b.y > z.y) && ((b - a).cross(z - a) > 0.) == (b.y > a.y))
        result = !result;
    }
    return result;
  }

  // Whether the segment from z to v has a point of e that is not v itself.
  bool meet(const Plane_point& z, Vertex_index v, const Edge& e) const
  {
    const Plane_point &p = m_places[v], &a = m_places[e[0]], &b = m_places[e[1]];
    if(e[0] == v || e[1] == v) { // they meet if they go in nearly one direction
      const Plane_point& other = e[0] == v ? b : a;
      return (other - p).dot(z - p) > 0. && !is_surely_positive(p, other, z)
          && !is_surely_positive(p, z, other);
    }
    const auto side = [](const Plane_point& o, const Plane_point& r, const Plane_point& s) {
      return is_surely_positive(o, r, s) ? 1 : is_surely_positive(o, s, r) ? -1 : 0;
    };
    return side(p, z, a) * side(p, z, b) <= 0 && side(a, b, p) * side(a, b, z) <= 0;
  }

  // Of the segment from z to v and an edge, which do not meet, but for that to v itself.
  double squared_distance(const Plane_point& z, Vertex_index v, const Edge& e) const
  {
    const Plane_point &p = m_places[v], &a = m_places[e[0]], &b = m_places[e[1]];
    double result = squared_distance_to(a, b, z);
    if(e[0] != v)
      result = (std::min)(result, squared_distance_to(p, z, a));
    if(e[1] != v)
      result = (std::min)(result, squared_distance_to(p, z, b));
    return result;
  }

  // Of z to the segment from a to b.
  static double squared_distance_to(const Plane_point& a, const Plane_point& b, const Plane_point& z)
  {
    return Nearest_on_segment(a, b, z).way.squared_length();
  }

  void add(Vertex_index a, Vertex_index b)
  {
    m_next[a] = b;
    m_previous[b] = a;
    const Plane_point &p = m_places[a], &q = m_places[b];
    for_each_cell(lower(p, q), upper(p, q), [&](std::uint64_t cell) {
      m_edges[cell].push_back({a, b});
    });
  }

  template <class Use>
  void for_each_cell(const Plane_point& low, const Plane_point& high, const Use& use) const
  {
    const auto cell = [this](double x, double o) { return std::int64_t(std::floor((x - o) * m_cells)); };
    for(std::int64_t i = cell(low.x, m_origin.x); i <= cell(high.x, m_origin.x); ++i)
      for(std::int64_t j = cell(low.y, m_origin.y); j <= cell(high.y, m_origin.y); ++j)
        use((std::uint64_t(std::uint32_t(i)) << 32) | std::uint32_t(j));
  }

  const Places& m_places;
  double m_distance;
  std::vector<Vertex_index> m_next; // along the border; an edge that is not in it is gone
  std::vector<Vertex_index> m_previous;
  std::unordered_map<std::uint64_t, std::vector<Edge>> m_edges; // by cells that they may have a part in
  Plane_point m_origin;
  double m_cells = 1.; // a unit of length
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_GUARD_H
