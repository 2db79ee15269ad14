// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_TRIANGLE_STRIP_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_TRIANGLE_STRIP_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A place on the edge of a halfedge: 0 at its source, 1 at its target.
struct Edge_place
{
  Halfedge halfedge;
  double part;
};

// The shortest way through a strip of triangles, in which it keeps off the ends of the edges.
struct Strip_path
{
  std::vector<Edge_place> places; // one on each gate
  std::vector<Vertex_index> bends; // the vertices at which it turns
  double length = 0.;
};

// A strip of triangles from a vertex to another one. Its *gates* are the edges that it crosses, as
// halfedges of the triangles from which it comes; so their targets are on its left side. The first
// triangle has the first vertex opposite of the first gate, the last one likewise.
struct Triangle_strip
{
  Vertex_index first, last;
  std::vector<Halfedge> gates;
};

// Finds the shortest path in a strip: the triangles are laid out in the plane, and a funnel is pulled
// through the gates (Lee and Preparata 1984). Linear time, but for long thin funnels.
class Strip_unfolding
{
  struct Point
  {
    double x = 0., y = 0.;
  };

public:
  // The part of each end of a gate from which the path keeps off.
  static constexpr double margin = 0.1;

  // Mesh and strip must live as long; it has one gate or more.
  Strip_unfolding(const Indexed_triangle_mesh& mesh, const Triangle_strip& strip)
    : m_mesh(mesh), m_strip(strip)
  {
    const std::size_t n = strip.gates.size();
    m_left.resize(n + 1);
    m_right.resize(n + 1);
    std::vector<Point> left(n), right(n);
    for(std::size_t k = 0; k < n; ++k) {
      const Vertex_index l = target(strip.gates[k]), r = source(strip.gates[k]);
      if(k == 0) {
        right[0] = {distance(strip.first, r), 0.};
        left[0] = apex({0., 0.}, right[0], distance(strip.first, l), distance(r, l));
      } else {
        const bool keeps_left = l == target(strip.gates[k - 1]);
        const Point &a = left[k - 1], &b = right[k - 1]; // the new vertex is on the left of a b
        const Vertex_index fresh = keeps_left ? r : l;
        const Point p = apex(a, b, distance(target(strip.gates[k - 1]), fresh),
                             distance(source(strip.gates[k - 1]), fresh));
        left[k] = keeps_left ? a : p;
        right[k] = keeps_left ? p : b;
      }
      m_left[k] = between(left[k], right[k], margin);
      m_right[k] = between(right[k], left[k], margin);
    }
    const Vertex_index l = target(strip.gates[n - 1]), r = source(strip.gates[n - 1]);
    m_left[n] = m_right[n] = apex(left[n - 1], right[n - 1], distance(l, strip.last),
                                  distance(r, strip.last));
  }

  Strip_path path() const;

private:
  Vertex_index source(Halfedge h) const { return vertex_of(m_mesh.triangles, h); }
  Vertex_index target(Halfedge h) const { return source(next_halfedge(h)); }
  double distance(Vertex_index v, Vertex_index w) const
  {
    return std::sqrt(squared_distance(m_mesh.points[v], m_mesh.points[w]));
  }

  static Point between(const Point& a, const Point& b, double part)
  {
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
  }
  static double turn(const Point& a, const Point& b, const Point& c)
  {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  static double distance(const Point& a, const Point& b) { return std::hypot(b.x - a.x, b.y - a.y); }

  // The point on the left of a b at these distances from both.
  static Point apex(const Point& a, const Point& b, double from_a, double from_b)
  {
    const double base = distance(a, b);
    if(!(base > 0.))
      return {a.x + from_a, a.y};
    const double along = (base * base + from_a * from_a - from_b * from_b) / (2. * base);
    const double height = std::sqrt((std::max)(0., from_a * from_a - along * along));
    const Point u = {(b.x - a.x) / base, (b.y - a.y) / base};
    return {a.x + along * u.x - height * u.y, a.y + along * u.y + height * u.x};
  }

  const Indexed_triangle_mesh& m_mesh;
  const Triangle_strip& m_strip;
  std::vector<Point> m_left, m_right; // of the gates, without the margins; then the last vertex twice
};

inline Strip_path Strip_unfolding::path() const
{
  struct Corner
  {
    Point point;
    std::size_t gate;
    bool is_left;
  };
  const std::size_t n = m_strip.gates.size();
  Strip_path result;
  std::vector<Corner> corners;
  Corner left, right;
  Point apex;
  bool is_closed = true; // the funnel has no width at its apex yet
  for(std::size_t k = 0; k <= n; ++k) {
    const Corner next_left = {m_left[k], k, true}, next_right = {m_right[k], k, false};
    if(is_closed) {
      left = next_left;
      right = next_right;
      is_closed = false;
      continue;
    }
    const Corner* bend = nullptr;
    if(turn(apex, right.point, next_right.point) >= 0.) {
      if(turn(apex, left.point, next_right.point) < 0.)
        right = next_right;
      else
        bend = &left;
    }
    if(bend == nullptr && turn(apex, left.point, next_left.point) <= 0.) {
      if(turn(apex, right.point, next_left.point) > 0.)
        left = next_left;
      else
        bend = &right;
    }
    if(bend == nullptr || bend->gate == n)
      continue;
    corners.push_back(*bend);
    apex = bend->point;
    k = bend->gate; // and on with the next one
    is_closed = true;
  }
  for(const Corner& corner : corners) {
    const Halfedge gate = m_strip.gates[corner.gate];
    result.bends.push_back(corner.is_left ? target(gate) : source(gate));
  }
  corners.push_back({m_left[n], n, true});
  Point from;
  std::size_t gate = 0;
  for(const Corner& to : corners) {
    result.length += distance(from, to.point);
    for(; gate < n && gate <= to.gate; ++gate) {
      const double at_left = std::abs(turn(from, to.point, m_left[gate]));
      const double at_right = std::abs(turn(from, to.point, m_right[gate]));
      const double part = gate == to.gate ? (to.is_left ? 1. : 0.)
                        : at_left + at_right > 0. ? at_right / (at_left + at_right) : 0.5;
      result.places.push_back({m_strip.gates[gate], margin + (1. - 2. * margin) * part});
    }
    from = to.point;
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_TRIANGLE_STRIP_H
