// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CROSSING_EDGES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CROSSING_EDGES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Whether the segments pq and rs have a point in common, up to rounding; `certify_map()` is exact.
template <class Point>
bool rounded_segments_meet(const Point& p, const Point& q, const Point& r, const Point& s)
{
  const auto side = [](const Point& a, const Point& b, const Point& c) {
    const double d = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    return (d > 0.) - (d < 0.);
  };
  return side(p, q, r) * side(p, q, s) <= 0 && side(r, s, p) * side(r, s, q) <= 0
      && (std::max)(p.x(), q.x()) >= (std::min)(r.x(), s.x())
      && (std::max)(r.x(), s.x()) >= (std::min)(p.x(), q.x())
      && (std::max)(p.y(), q.y()) >= (std::min)(r.y(), s.y())
      && (std::max)(r.y(), s.y()) >= (std::min)(p.y(), q.y());
}

// Calls visit(e, f) for each two edges that share no vertex and meet in the plane, up to rounding,
// until it returns false. Found by a sweep.
template <class Point, class Visitor>
void visit_crossing_edges(std::vector<std::array<std::uint32_t, 2>> edges,
                          const std::vector<Point>& points, const Visitor& visit)
{
  typedef std::array<std::uint32_t, 2> Edge;
  const auto left = [&points](const Edge& e) {
    return (std::min)(points[e[0]].x(), points[e[1]].x());
  };
  const auto right = [&points](const Edge& e) {
    return (std::max)(points[e[0]].x(), points[e[1]].x());
  };
  std::sort(edges.begin(), edges.end(), [&](const Edge& e, const Edge& f) {
    return std::make_pair(left(e), e) < std::make_pair(left(f), f);
  });
  std::vector<Edge> active;
  for(const Edge& e : edges) {
    std::size_t kept = 0;
    for(std::size_t i = 0; i < active.size(); ++i) {
      const Edge f = active[i];
      if(right(f) < left(e))
        continue;
      active[kept++] = f;
      if(e[0] != f[0] && e[0] != f[1] && e[1] != f[0] && e[1] != f[1]
         && rounded_segments_meet(points[e[0]], points[e[1]], points[f[0]], points[f[1]])
         && !visit(e, f))
        return;
    }
    active.resize(kept);
    active.push_back(e);
  }
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_CROSSING_EDGES_H
