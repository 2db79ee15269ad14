// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_REFINABLE_SEAM_GRAPH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_REFINABLE_SEAM_GRAPH_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Lengths of edges in units of a part of the extent of the points, shorter on creases.
class Crease_metric
{
public:
  typedef std::uint64_t Length;
  typedef Indexed_triangle_mesh::Point_3 Point_3;

  // The points must live as long as the metric.
  Crease_metric(const std::vector<Point_3>& points, const Crease_weights& weights)
    : m_points(points), m_weights(weights)
  {
    m_extent = Indexed_mesh::longest_side(Indexed_mesh::bounding_box(points));
    if(!(m_extent > 0.) || !(m_extent < (std::numeric_limits<double>::infinity)()))
      m_extent = 1.;
    m_cos_flat = std::cos(weights.flat_angle * pi / 180.);
    m_cos_sharp = std::cos(weights.sharp_angle * pi / 180.);
  }

  // Lets edges be shorter where vertices have ambient occlusion; empty for none.
  void set_occlusion(std::vector<float> occlusion) { m_occlusion = std::move(occlusion); }

  // The length of an edge v w on the border.
  Length length(Vertex_index v, Vertex_index w) const { return to_units(norm(vector(v, w))); }

  // The length of the edge v w with a triangle on its left, whose other vertex is l, and one on its
  // right.
  Length length(Vertex_index v, Vertex_index w, Vertex_index l, Vertex_index r) const
  {
    const Vector e = vector(v, w), to_l = vector(v, l), to_r = vector(v, r);
    const Vector left = cross(e, to_l), right = cross(to_r, e);
    const double dot = left[0] * right[0] + left[1] * right[1] + left[2] * right[2];
    const double left_2 = squared(left), right_2 = squared(right), e_2 = squared(e);
    const double squares = left_2 * right_2, length = std::sqrt(e_2);
    if((dot > 0. && dot * dot >= m_cos_flat * m_cos_flat * squares)
       || !(left_2 > least_sine_2 * e_2 * squared(to_l))
       || !(right_2 > least_sine_2 * e_2 * squared(to_r)))
      return to_units(part_seen(v, w) * length);
    return to_units(part_seen(v, w) * length * factor(dot, squares, left, to_r));
  }

  // The angle at v between the edges to u and w, in degrees.
  double angle(Vertex_index v, Vertex_index u, Vertex_index w) const
  {
    const Vector a = vector(v, u), b = vector(v, w);
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return std::atan2(norm(cross(a, b)), dot) * 180. / pi;
  }

  // A length in the units of the points.
  double to_length(Length length) const { return double(length) * m_extent / units; }

private:
  typedef std::array<double, 3> Vector;

  static constexpr double pi = 3.14159265358979323846;

  // Units per extent: an edge of a mesh of 10^8 triangles has some 10^4, and rounding errors of the
  // coordinates reach half a unit once in 10^7 edges.
  static constexpr double units = double(1u << 28);

  // Triangles with a smaller sine, squared, have no normal but that of their rounding errors.
  static constexpr double least_sine_2 = 1e-12;

  // What a length is multiplied by across an edge between normals with this product.
  double factor(double dot, double squares, const Vector& left, const Vector& to_r) const
  {
    double sharpness = (m_cos_flat - dot / std::sqrt(squares)) / (m_cos_flat - m_cos_sharp);
    // The right triangle rises above the plane of the left one
    if(left[0] * to_r[0] + left[1] * to_r[1] + left[2] * to_r[2] > 0.)
      sharpness *= m_weights.concave_gain;
    return 1. - (1. - m_weights.crease_length) * (std::min)(1., (std::max)(0., sharpness));
  }

  double part_seen(Vertex_index v, Vertex_index w) const
  {
    return m_occlusion.empty() ? 1. : m_weights.part_seen(m_occlusion[v], m_occlusion[w]);
  }

  Vector vector(Vertex_index v, Vertex_index w) const
  {
    const Point_3 &p = m_points[v], &q = m_points[w];
    return {(q.x() - p.x()) / m_extent, (q.y() - p.y()) / m_extent, (q.z() - p.z()) / m_extent};
  }

  static Vector cross(const Vector& a, const Vector& b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  static double squared(const Vector& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }
  static double norm(const Vector& a) { return std::sqrt(squared(a)); }

  static Length to_units(double length)
  {
    return (std::max)(Length(1), Length(length * units + 0.5));
  }

  const std::vector<Point_3>& m_points;
  Crease_weights m_weights;
  double m_extent, m_cos_flat, m_cos_sharp;
  std::vector<float> m_occlusion; // of each vertex, or none
};

// The seams of a mesh that vertex splits refine, with their lengths.
//
// Edges on the border of the surface are seams. Triangles that are not there at present have none.
class Refinable_seam_graph
  : public Seam_graph
{
public:
  typedef Crease_metric::Length Length;
  typedef Crease_metric::Point_3 Point_3;

  // A graph without seams of a mesh without collapses; mesh and points must live as long.
  Refinable_seam_graph(Halfedge_triangles& mesh, const std::vector<Point_3>& points,
                       const Crease_weights& weights)
    : Seam_graph(mesh, std::vector<std::uint8_t>(mesh.number_of_halfedges() / 3, 0))
    , m_refined(mesh), m_metric(points, weights), m_is_on_border(points.size(), 0)
    , m_is_pinned(points.size(), 0)
  {
    for(Halfedge h = 0; h < mesh.number_of_halfedges(); ++h)
      if(is_border(h))
        m_is_on_border[source(h)] = m_is_on_border[target(h)] = 1;
  }

  // Whether a vertex is on the border of the surface.
  bool is_on_border(Vertex_index v) const { return m_is_on_border[v] != 0; }

  // Whether seams that pass v are to stay there.
  bool is_pinned(Vertex_index v) const { return m_is_pinned[v] != 0; }

  // Whether arcs of seams end at v: a junction, an end of a seam, a pinned vertex, or one on the
  // border of the surface.
  bool is_node(Vertex_index v) const
  {
    return degree(v) != 2 || is_on_border(v) || is_pinned(v);
  }

  // Pins the vertices on seams inside the surface the angles around which differ from a full turn
  // by at least `defect` degrees: tips and saddles, around which a chart would be much distorted if
  // its border did not reach them.
  void pin_curved(double defect);

  // The length of an edge, shorter on creases. At least 1, and an integer, so that sums do not
  // depend on their order and equal paths are equal.
  Length length(Halfedge h) const
  {
    const Halfedge o = opposite(h);
    const Vertex_index v = source(h), w = target(h);
    if(o == no_halfedge)
      return m_metric.length(v, w);
    const Length detour = m_avoided.empty() || !is_marked(m_avoided, h) ? 0 : longest_detour;
    return detour
         + m_metric.length(v, w, source(previous_halfedge(h)), source(previous_halfedge(o)));
  }

  // Takes edges inside the surface, marked at both of their triangles as in `Face_charts`, to be
  // longer than any way around. For a mesh that is not refined.
  void avoid(std::vector<std::uint8_t> sides) { m_avoided = std::move(sides); }

  const Crease_metric& metric() const { return m_metric; }

  // Lets edges be shorter where vertices have ambient occlusion; empty for none.
  void set_occlusion(std::vector<float> occlusion)
  {
    m_metric.set_occlusion(std::move(occlusion));
  }

  // Undoes the collapse of r into k that left e. The graph keeps its homotopy type.
  void split(Halfedge e, Vertex_index r, Vertex_index k);

private:
  static constexpr Length longest_detour = Length(1) << 40; // 4096 times the extent of the mesh

  // What a split does to the two sides of a triangle that it makes, which were one edge before.
  struct Doubled_edge
  {
    Halfedge side_of_r, side_of_k;
    bool is_free; // a seam that may become one or the other
  };

  struct Star;

  Star star_after_split(Halfedge e, Vertex_index r, Vertex_index k);

  Halfedge_triangles& m_refined;
  Crease_metric m_metric;
  std::vector<std::uint8_t> m_is_on_border, m_is_pinned, m_avoided;
};

// The seams at both ends of a new edge but for those that are yet to be placed.
struct Refinable_seam_graph::Star
{
  std::uint32_t at_r = 0, at_k = 0;
  bool is_leaf = false; // the seams ended at k
  Doubled_edge doubled[2];
  int number_doubled = 0;
  bool is_border = false; // the new edge has one triangle
};

inline void Refinable_seam_graph::pin_curved(double defect)
{
  for(Vertex_index v = 0; v < mesh().number_of_vertices(); ++v) {
    m_is_pinned[v] = 0;
    if(degree(v) == 0 || is_on_border(v))
      continue;
    double angles = 0.;
    mesh().for_each_outgoing(mesh().outgoing(v), [&](Halfedge h) {
      angles += m_metric.angle(v, target(h), source(previous_halfedge(h)));
      return true;
    });
    m_is_pinned[v] = std::abs(360. - angles) >= defect;
  }
}

// Marks the border, and lets the other sides of the new triangles be no seams for the moment.
inline Refinable_seam_graph::Star
Refinable_seam_graph::star_after_split(Halfedge e, Vertex_index r, Vertex_index k)
{
  Star star;
  star.at_k = degree(k);
  star.is_leaf = degree(k) == 1;
  star.is_border = is_border(e);
  mesh().for_each_dying(e, r, [&](const Halfedge_triangles::Dying& d) {
    const Halfedge a = opposite(d.side_of_r), b = opposite(d.side_of_k);
    Doubled_edge& doubled = star.doubled[star.number_doubled++];
    doubled = {d.side_of_r, d.side_of_k, false};
    if(a != no_halfedge && b != no_halfedge) {
      doubled.is_free = is_seam(a);
      star.at_k -= doubled.is_free ? 1 : 0;
    }
    mark_edge(d.side_of_r, a == no_halfedge);
    mark_edge(d.side_of_k, b == no_halfedge);
  });
  std::uint32_t moved = 0; // seams that r takes from k
  mesh().for_each_outgoing(mesh().outgoing(r), [&](Halfedge h) {
    moved += is_seam(h) ? 1 : 0;
    const Halfedge last = previous_halfedge(h); // an edge with no halfedge from r
    moved += is_border(last) && is_seam(last) ? 1 : 0;
    return true;
  });
  star.at_r = moved;
  star.at_k -= moved;
  return star;
}

//        L           L        A seam at L may go on one of two edges, so may one at R: of the up to
//        |         /   \      four ways the shortest is taken. The new edge must be a seam if both
//   .. - k - ..   r --- k     of its ends have seams, which were connected at k; an end of a seam
//        |         \   /      stays at k.
//        R           R
inline void Refinable_seam_graph::split(Halfedge e, Vertex_index r, Vertex_index k)
{
  m_refined.split(e, r);
  if(degree(k) == 0)
    return;
  const Star star = star_after_split(e, r, k);
  const bool free_0 = star.doubled[0].is_free;
  const bool free_1 = star.number_doubled == 2 && star.doubled[1].is_free;
  Length best = 0;
  int best_way = -1;
  for(int way = 0; way < 4; ++way) { // bits: whether the seam of that side goes to r
    if(((way & 1) && !free_0) || ((way & 2) && !free_1))
      continue;
    const std::uint32_t at_r = star.at_r + (way & 1) + (way >> 1);
    const std::uint32_t at_k = star.at_k + (free_0 && !(way & 1)) + (free_1 && !(way & 2));
    const bool joins = star.is_border || (at_r > 0 && (at_k > 0 || star.is_leaf));
    Length sum = joins ? length(e) : 0;
    if(free_0)
      sum += length(way & 1 ? star.doubled[0].side_of_r : star.doubled[0].side_of_k);
    if(free_1)
      sum += length(way & 2 ? star.doubled[1].side_of_r : star.doubled[1].side_of_k);
    if(best_way < 0 || sum < best) {
      best = sum;
      best_way = way | (joins ? 4 : 0);
    }
  }
  if(free_0)
    mark_edge(best_way & 1 ? star.doubled[0].side_of_r : star.doubled[0].side_of_k, true);
  if(free_1)
    mark_edge(best_way & 2 ? star.doubled[1].side_of_r : star.doubled[1].side_of_k, true);
  mark_edge(e, (best_way & 4) != 0);
  const std::uint32_t joins = best_way >> 2;
  degree_of(r) = star.at_r + (best_way & 1) + (best_way >> 1 & 1) + joins;
  degree_of(k) = star.at_k + (free_0 && !(best_way & 1)) + (free_1 && !(best_way & 2)) + joins;
  if(degree(k) == 0) // all seams have gone with r
    std::swap(m_is_pinned[k], m_is_pinned[r]);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_REFINABLE_SEAM_GRAPH_H
