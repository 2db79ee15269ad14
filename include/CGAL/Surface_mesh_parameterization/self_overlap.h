// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_SELF_OVERLAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_SELF_OVERLAP_H

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// Whether the segments pq and rs have a point in common, up to rounding; `certify_map()` is exact.
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

/// Calls visit(e, f) for each two edges that share no vertex and meet in the plane, up to rounding,
/// until it returns false. Found by a sweep. For maps that are tried and thrown away, and for hints
/// where to repair; what a map is accepted by is exact (`is_simple_border()`, `certify_map()`).
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

/// Parameters as pairs of double, with exact predicates.
typedef Exact_predicates_inexact_constructions_kernel Uv_kernel;
/// A point of the plane.
typedef Uv_kernel::Point_2 Uv_point;
/// A triangle of the plane, by its corners.
typedef std::array<Uv_point, 3> Uv_triangle;

// The parameters of a mesh, by vertex.
template <class TriangleMesh, class VertexUVMap>
class Uv_view
{
public:
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

  Uv_view(const TriangleMesh& mesh, VertexUVMap uvmap) : m_mesh(mesh), m_uvmap(uvmap) {}

  const TriangleMesh& mesh() const { return m_mesh; }

  Uv_point point(vertex_descriptor v) const
  {
    const auto uv = get(m_uvmap, v);
    return Uv_point(to_double(uv.x()), to_double(uv.y()));
  }

  Uv_triangle triangle(face_descriptor f) const
  {
    const halfedge_descriptor h = halfedge(f, m_mesh), h1 = next(h, m_mesh);
    return {point(target(h, m_mesh)), point(target(h1, m_mesh)),
            point(target(next(h1, m_mesh), m_mesh))};
  }

private:
  const TriangleMesh& m_mesh;
  VertexUVMap m_uvmap;
};

/// Returns whether all coordinates are finite numbers.
inline bool is_finite(const Uv_triangle& t)
{
  double sum = 0.; // times 0: not a number as soon as one term is not finite
  for(const Uv_point& p : t)
    sum += 0. * p.x() + 0. * p.y();
  return sum == 0.;
}

/// The exact sign of the area; 0 if a parameter is not a finite number.
inline Orientation orientation_of(const Uv_triangle& t)
{
  return is_finite(t) ? orientation(t[0], t[1], t[2]) : COLLINEAR;
}

/// Calls visit(a, b) for each two items whose boxes intersect, until it returns false. Returns
/// whether it never did.
template <class Item, class Visit>
bool visit_pairs_of_boxes(const std::vector<std::pair<Bbox_2, Item>>& items, const Visit& visit)
{
  typedef Box_intersection_d::Box_with_info_d<double, 2, const Item*> Box;
  struct Stopped {}; // the only way out of box_self_intersection_d()
  std::vector<Box> boxes;
  boxes.reserve(items.size());
  for(const auto& [box, item] : items)
    boxes.push_back(Box(box, &item));
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      if(!visit(*a.info(), *b.info()))
        throw Stopped();
    });
  } catch(const Stopped&) {
    return false;
  }
  return true;
}

/// Whether a line along a side of the counterclockwise triangle `a` has `b` on its right side.
inline bool is_separated_by_side(const Uv_triangle& a, const Uv_triangle& b)
{
  for(int i = 0; i < 3; ++i) {
    const Uv_point &p = a[i], &q = a[(i + 1) % 3];
    if(std::none_of(b.begin(), b.end(),
                    [&](const Uv_point& r) { return orientation(p, q, r) == LEFT_TURN; }))
      return true;
  }
  return false;
}

// A face with an area in the plane, counterclockwise.
struct Uv_face
{
  std::size_t position; // in faces(mesh)
  Uv_triangle triangle;

  // Whether the interiors intersect.
  bool overlaps(const Uv_face& other) const
  {
    return !is_separated_by_side(triangle, other.triangle)
        && !is_separated_by_side(other.triangle, triangle);
  }
};

/// Calls visit(a, b) for each two faces whose images have interiors that intersect, by definition,
/// until it returns false. Returns whether it never did.
template <class View, class Visit>
bool visit_overlapping_faces(const View& view, const Visit& visit)
{
  std::vector<std::pair<Bbox_2, Uv_face>> items;
  items.reserve(num_faces(view.mesh()));
  std::size_t position = 0;
  for(const auto f : faces(view.mesh())) {
    Uv_triangle t = view.triangle(f);
    const Orientation sign = orientation_of(t);
    if(sign == RIGHT_TURN)
      std::swap(t[1], t[2]);
    if(sign != COLLINEAR)
      items.push_back({t[0].bbox() + t[1].bbox() + t[2].bbox(), {position, t}});
    ++position;
  }
  return visit_pairs_of_boxes(items, [&visit](const Uv_face& a, const Uv_face& b) {
    return !a.overlaps(b) || visit(a, b);
  });
}

/// Returns whether two triangles of a view of a map have a common area.
template <class View>
bool has_overlapping_triangles(const View& view)
{
  return !visit_overlapping_faces(view, [](const Uv_face&, const Uv_face&) { return false; });
}

/// Whether a face that lies on its back has a neighbour that does not: they overlap.
/// `count` gets the number of faces of each orientation: -1, 0, 1.
template <class View>
bool has_fold(const View& view, std::array<std::size_t, 3>& count)
{
  const auto& mesh = view.mesh();
  count = {0, 0, 0};
  for(const auto f : faces(mesh)) {
    const Orientation sign = orientation_of(view.triangle(f));
    ++count[int(sign) + 1];
    if(sign != RIGHT_TURN)
      continue;
    for(const auto h : halfedges_around_face(halfedge(f, mesh), mesh)) {
      const auto g = opposite(h, mesh);
      if(!is_border(g, mesh) && orientation_of(view.triangle(face(g, mesh))) == LEFT_TURN)
        return true;
    }
  }
  return false;
}

/// Whether the segments ab and bc have more than b in common.
inline bool successive_segments_meet(const Uv_point& a, const Uv_point& b, const Uv_point& c)
{
  return collinear(a, b, c) && !collinear_are_strictly_ordered_along_line(a, b, c);
}

/// Whether the segments ab and cd, whose boxes intersect, have a point in common.
inline bool segments_meet(const Uv_point& a, const Uv_point& b, const Uv_point& c,
                          const Uv_point& d)
{
  const auto separates = [](const Uv_point& p, const Uv_point& q, const Uv_point& r,
                            const Uv_point& s) {
    const Orientation sign = orientation(p, q, r);
    return sign != COLLINEAR && sign == orientation(p, q, s);
  };
  return !separates(a, b, c, d) && !separates(c, d, a, b);
}

/// Whether the images of two border edges, each given by its ends in order, have a point in common,
/// the vertex between two successive ones aside. `point` gives the image of an end.
template <class Edge, class PointOf>
bool border_edges_meet(const Edge& e, const Edge& f, const PointOf& point)
{
  if(e[0] == f[1] && e[1] != f[0])
    return successive_segments_meet(point(f[0]), point(f[1]), point(e[1]));
  if(e[1] == f[0] && e[0] != f[1])
    return successive_segments_meet(point(e[0]), point(e[1]), point(f[1]));
  return segments_meet(point(e[0]), point(e[1]), point(f[0]), point(f[1]));
}

/// Whether the images of no two border edges of a mesh, all of which are given by the indices of
/// their ends, meet. Then a map of a disk whose triangles all have a positive area is one-to-one:
/// see `certify_map()`.
template <class Point>
bool is_simple_border(const std::vector<std::array<std::uint32_t, 2>>& border,
                      const std::vector<Point>& uv)
{
  typedef std::array<std::uint32_t, 2> Edge;
  const auto point = [&uv](std::uint32_t v) { return Uv_point(uv[v].x(), uv[v].y()); };
  std::vector<std::pair<Bbox_2, Edge>> items;
  for(const Edge& e : border)
    items.push_back({point(e[0]).bbox() + point(e[1]).bbox(), e});
  return visit_pairs_of_boxes(items, [&point](const Edge& e, const Edge& f) {
    return !border_edges_meet(e, f, point);
  });
}

/// The orientation of the border cycle of `h`, whose image is simple: that at its leftmost vertex.
/// `visited` gets the cycle's halfedges.
template <class View, class Visited>
Orientation orientation_of_border(const View& view, typename View::halfedge_descriptor h,
                                  Visited& visited)
{
  const auto& mesh = view.mesh();
  auto leftmost = h;
  for(const auto g : halfedges_around_face(h, mesh)) {
    visited.insert(g);
    if(view.point(target(g, mesh)) < view.point(target(leftmost, mesh)))
      leftmost = g;
  }
  return orientation(view.point(source(leftmost, mesh)), view.point(target(leftmost, mesh)),
                     view.point(target(next(leftmost, mesh), mesh)));
}

/// Whether the map covers no point twice because of its border. Precondition: all faces have the
/// orientation `sign`. Then a point outside the image of the border is covered as often as the
/// border winds around it. If the border cycles are simple and disjoint and one of them is an outer
/// one, that is 0 or 1 times.
template <class View>
bool is_one_to_one_by_border(const View& view, Orientation sign)
{
  typedef typename View::halfedge_descriptor halfedge_descriptor;
  const auto& mesh = view.mesh();
  std::vector<std::pair<Bbox_2, halfedge_descriptor>> items;
  for(const halfedge_descriptor h : halfedges(mesh))
    if(is_border(h, mesh))
      items.push_back({view.point(source(h, mesh)).bbox() + view.point(target(h, mesh)).bbox(), h});
  const auto ends = [&mesh](halfedge_descriptor h) {
    return std::array<typename View::vertex_descriptor, 2>{source(h, mesh), target(h, mesh)};
  };
  const auto point = [&view](typename View::vertex_descriptor v) { return view.point(v); };
  if(!visit_pairs_of_boxes(items, [&](halfedge_descriptor g, halfedge_descriptor h) {
       return !border_edges_meet(ends(g), ends(h), point);
     }))
    return false;
  std::size_t outer_cycles = 0;
  std::set<halfedge_descriptor> visited;
  for(const auto& [box, h] : items)
    if(visited.count(h) == 0 && orientation_of_border(view, h, visited) != sign)
      ++outer_cycles; // border halfedges run with the surface on their right
  return outer_cycles <= 1;
}

/// Returns whether a view of a map covers a part of the plane twice.
template <class View>
bool has_global_overlap(const View& view)
{
  std::array<std::size_t, 3> count;
  if(has_fold(view, count))
    return true;
  if(count[1] == 0 && (count[0] == 0 || count[2] == 0)
     && is_one_to_one_by_border(view, count[0] == 0 ? LEFT_TURN : RIGHT_TURN))
    return false;
  return has_overlapping_triangles(view);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_SELF_OVERLAP_H
