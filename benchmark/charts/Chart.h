// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_CHART_H
#define HLSCM_BENCHMARK_CHARTS_CHART_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace charts {

using Index = std::uint32_t;
using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>;

constexpr Index none = ~Index(0);

// An indexed, oriented, manifold triangle mesh.
// Halfedge 3t + c leads from corner c of triangle t to the next corner.
struct Chart
{
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  Index number_of_halfedges() const { return Index(3 * triangles.size()); }
  Index source(Index h) const { return triangles[h / 3][h % 3]; }
  Index target(Index h) const { return triangles[h / 3][(h % 3 + 1) % 3]; }
};

inline Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

inline Point operator+(const Point& p, const Point& q)
{
  return {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
}
inline Point operator-(const Point& p, const Point& q)
{
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
inline Point operator*(double s, const Point& p) { return {s * p[0], s * p[1], s * p[2]}; }
inline Point cross(const Point& p, const Point& q)
{
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
inline double norm(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

// The opposite of each halfedge, `none` on the border. Throws if an edge is not manifold or if two
// triangles disagree about its direction.
inline std::vector<Index> opposite_halfedges(const Chart& chart)
{
  const Index n = chart.number_of_halfedges();
  const auto low = [&](Index h) { return std::min(chart.source(h), chart.target(h)); };
  const auto high = [&](Index h) { return std::max(chart.source(h), chart.target(h)); };

  // buckets by the smaller end (counting sort), then sorted by the greater one
  std::vector<Index> begin(chart.points.size() + 2, 0), bucketed(n), opposite(n, none);
  for(Index h = 0; h < n; ++h)
    ++begin[low(h) + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for(Index h = 0; h < n; ++h)
    bucketed[begin[low(h) + 1]++] = h;

  for(std::size_t v = 0; v < chart.points.size(); ++v) {
    const auto first = bucketed.begin() + begin[v], last = bucketed.begin() + begin[v + 1];
    std::sort(first, last, [&](Index g, Index h) {
      return std::make_pair(high(g), g) < std::make_pair(high(h), h);
    });
    for(auto it = first; it != last; ++it) {
      const auto following = it + 1;
      if(following == last || high(*following) != high(*it))
        continue;
      if(chart.source(*it) == chart.source(*following))
        throw std::runtime_error("two triangles run along an edge in the same direction");
      if(following + 1 != last && high(*(following + 1)) == high(*it))
        throw std::runtime_error("an edge has more than two triangles");
      opposite[*it] = *following;
      opposite[*following] = *it;
      it = following;
    }
  }
  return opposite;
}

inline std::vector<char> border_vertices(const Chart& chart, const std::vector<Index>& opposite)
{
  std::vector<char> is_border(chart.points.size(), 0);
  for(Index h = 0; h < chart.number_of_halfedges(); ++h)
    if(opposite[h] == none)
      is_border[chart.source(h)] = is_border[chart.target(h)] = 1;
  return is_border;
}

// Removes the vertices no triangle uses; the others keep their order.
inline void remove_isolated_vertices(Chart& chart)
{
  std::vector<Index> position(chart.points.size(), none);
  for(const Triangle& t : chart.triangles)
    for(Index v : t)
      position[v] = 0;
  Index kept = 0;
  for(std::size_t v = 0; v < position.size(); ++v) {
    if(position[v] == none)
      continue;
    chart.points[kept] = chart.points[v];
    position[v] = kept++;
  }
  chart.points.resize(kept);
  for(Triangle& t : chart.triangles)
    for(Index& v : t)
      v = position[v];
}

struct Topology
{
  std::size_t components, borders;
  long euler_characteristic;
  bool is_disk() const { return components == 1 && borders == 1 && euler_characteristic == 1; }
  bool is_sphere() const { return components == 1 && borders == 0 && euler_characteristic == 2; }
};

class Union_find
{
public:
  explicit Union_find(std::size_t n) : m_parent(n)
  {
    std::iota(m_parent.begin(), m_parent.end(), Index(0));
  }
  Index find(Index i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }
  // returns false if the two were one already; the smaller index represents the union
  bool unite(Index i, Index j)
  {
    i = find(i);
    j = find(j);
    m_parent[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

private:
  std::vector<Index> m_parent;
};

inline Topology measure_topology(const Chart& chart, const std::vector<Index>& opposite)
{
  const Index n = chart.number_of_halfedges();
  Topology result{chart.points.size(), 0, 0};
  Union_find vertices(chart.points.size()), border(chart.points.size());
  std::size_t edges = 0, border_vertices = 0;
  std::vector<char> on_border(chart.points.size(), 0);
  for(Index h = 0; h < n; ++h) {
    const Index v = chart.source(h), w = chart.target(h);
    result.components -= vertices.unite(v, w);
    edges += opposite[h] == none || h < opposite[h];
    if(opposite[h] != none)
      continue;
    border_vertices += !on_border[v];
    on_border[v] = 1;
    result.borders -= border.unite(v, w);
  }
  result.borders += border_vertices;
  result.euler_characteristic =
      long(chart.points.size()) - long(edges) + long(chart.triangles.size());
  return result;
}

} // namespace charts
#endif
