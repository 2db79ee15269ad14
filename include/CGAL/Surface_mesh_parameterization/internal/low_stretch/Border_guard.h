// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_BORDER_GUARD_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_BORDER_GUARD_H

#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Border_barrier.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The border of a map while vertices are put into it: where one may go without crossing it. Other
// vertices of the border must stay meanwhile.
class Border_guard
{
public:
  typedef std::vector<Plane_point> Places;

  // `places` are those of all vertices, of which only those of the loops count.
  Border_guard(const Border_loops& loops, const Places& places)
    : m_places(places), m_next(places.size(), Indexed_mesh::no_vertex)
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

  // Whether v may go to z between the ends a and b of an edge of the border, which has the surface on its
  // left: on that side, where the triangles of v do not turn over, or where nothing is in between.
  bool allows(const Plane_point& z, Vertex_index a, Vertex_index b) const
  {
    const Plane_point &p = m_places[a], &q = m_places[b];
    if(is_surely_positive(p, q, z))
      return true;
    bool is_free = true;
    for_each_cell(lower(lower(p, q), z), upper(upper(p, q), z), [&](std::uint64_t cell) {
      const auto found = m_edges.find(cell);
      if(!is_free || found == m_edges.end())
        return;
      for(const Edge& e : found->second)
        if(m_next[e[0]] == e[1] && e[0] != a)
          is_free = is_free && !meet(z, a, e) && !meet(z, b, e);
    });
    return is_free;
  }

  // Puts v, which has its place, between the ends of an edge.
  void insert(Vertex_index v, Vertex_index a, Vertex_index b)
  {
    add(a, v);
    add(v, b);
  }

private:
  typedef std::array<Vertex_index, 2> Edge;

  static Plane_point lower(const Plane_point& a, const Plane_point& b)
  {
    return {(std::min)(a.x, b.x), (std::min)(a.y, b.y)};
  }
  static Plane_point upper(const Plane_point& a, const Plane_point& b)
  {
    return {(std::max)(a.x, b.x), (std::max)(a.y, b.y)};
  }

  // Whether the segment from z to v has a point of e that is not v itself, or hardly misses it.
  bool meet(const Plane_point& z, Vertex_index v, const Edge& e) const
  {
    const Plane_point &p = m_places[v], &a = m_places[e[0]], &b = m_places[e[1]];
    if(e[0] == v || e[1] == v) { // they meet if they go in nearly one direction
      const Plane_point along = (e[0] == v ? b : a) - p, way = z - p;
      return along.dot(way) > 0. && !is_surely_positive(p, p + along, z) && !is_surely_positive(p, z, p + along);
    }
    const auto side = [](const Plane_point& o, const Plane_point& r, const Plane_point& s) {
      return is_surely_positive(o, r, s) ? 1 : is_surely_positive(o, s, r) ? -1 : 0;
    };
    return side(p, z, a) * side(p, z, b) <= 0 && side(a, b, p) * side(a, b, z) <= 0;
  }

  void add(Vertex_index a, Vertex_index b)
  {
    m_next[a] = b;
    const Plane_point &p = m_places[a], &q = m_places[b];
    for_each_cell(lower(p, q), upper(p, q), [&](std::uint64_t cell) { m_edges[cell].push_back({a, b}); });
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
  std::vector<Vertex_index> m_next; // along the border; an edge that is not in it is gone
  std::unordered_map<std::uint64_t, std::vector<Edge>> m_edges; // by cells that they may have a part in
  Plane_point m_origin;
  double m_cells = 1.; // a unit of length
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_BORDER_GUARD_H
