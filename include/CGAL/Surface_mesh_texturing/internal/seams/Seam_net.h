// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_NET_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_NET_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/Crease_weights.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Linked_triangles.h>

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
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;
  typedef Indexed_mesh::Vertex_index Vertex_index;

  // The points must live as long as the metric.
  Crease_metric(const std::vector<Point_3>& points, const Crease_weights& weights)
    : m_points(points), m_weights(weights)
  {
    std::array<double, 3> lo, hi;
    lo.fill((std::numeric_limits<double>::infinity)());
    hi.fill(-(std::numeric_limits<double>::infinity)());
    for(const Point_3& p : points)
      for(int c = 0; c < 3; ++c) {
        lo[c] = (std::min)(lo[c], p[c]);
        hi[c] = (std::max)(hi[c], p[c]);
      }
    m_extent = (std::max)({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
    if(!(m_extent > 0.) || !(m_extent < (std::numeric_limits<double>::infinity)()))
      m_extent = 1.;
    m_cos_flat = std::cos(weights.flat_angle * pi / 180.);
    m_cos_sharp = std::cos(weights.sharp_angle * pi / 180.);
  }

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
      return to_units(length);
    return to_units(length * factor(dot, squares, left, to_r));
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
};

// A mesh that vertex splits refine, with the graph of its seams and their lengths.
//
// Edges on the border of the surface are seams. Triangles that are not there at present have none.
class Seam_net
{
public:
  typedef Crease_metric::Length Length;
  typedef Crease_metric::Point_3 Point_3;

  Seam_net(const std::vector<Triangle_indices>& triangles, const std::vector<Point_3>& points,
             const Crease_weights& weights)
    : m_mesh(triangles, points.size()), m_metric(points, weights)
    , m_seams(triangles.size(), 0), m_degree(points.size(), 0), m_is_border(points.size(), 0)
    , m_is_pinned(points.size(), 0)
  {
    for(Halfedge h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.opposite(h) == no_halfedge)
        m_is_border[m_mesh.source(h)] = m_is_border[m_mesh.target(h)] = 1;
  }

  const Linked_triangles& mesh() const { return m_mesh; }
  Linked_triangles& mesh() { return m_mesh; }

  const std::vector<std::uint8_t>& seams() const { return m_seams; }

  // Gives each triangle its seams, which must be symmetric.
  void set_seams(std::vector<std::uint8_t> seams);

  bool is_seam(Halfedge h) const { return (m_seams[h / 3] >> h % 3 & 1) != 0; }
  bool is_border(Vertex_index v) const { return m_is_border[v] != 0; }

  // The number of seams at v, border edges included.
  std::uint32_t degree(Vertex_index v) const { return m_degree[v]; }

  // Whether seams that pass v are to stay there.
  bool is_pinned(Vertex_index v) const { return m_is_pinned[v] != 0; }

  // Pins the vertices on seams inside the surface the angles around which differ from a full turn
  // by at least `defect` degrees: tips and saddles, around which a chart would be much distorted if
  // its border did not reach them.
  void pin_curved(double defect);

  void add_seam(Halfedge h)
  {
    mark(h, true);
    ++m_degree[m_mesh.source(h)];
    ++m_degree[m_mesh.target(h)];
  }

  void remove_seam(Halfedge h)
  {
    mark(h, false);
    --m_degree[m_mesh.source(h)];
    --m_degree[m_mesh.target(h)];
  }

  // The length of an edge, shorter on creases. At least 1, and an integer, so that sums do not
  // depend on their order and equal paths are equal.
  Length length(Halfedge h) const
  {
    const Halfedge o = m_mesh.opposite(h);
    const Vertex_index v = m_mesh.source(h), w = m_mesh.target(h);
    if(o == no_halfedge)
      return m_metric.length(v, w);
    return m_metric.length(v, w, m_mesh.source(previous_halfedge(h)),
                           m_mesh.source(previous_halfedge(o)));
  }

  // The length of all seams, of those inside the surface only.
  Length length_inside() const
  {
    Length sum = 0;
    for(Halfedge h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(is_seam(h) && m_mesh.opposite(h) != no_halfedge && m_mesh.opposite(h) > h)
        sum += length(h);
    return sum;
  }

  const Crease_metric& metric() const { return m_metric; }

  // Undoes the collapse of r into k that left e. The graph keeps its homotopy type.
  void split(Halfedge e, Vertex_index r, Vertex_index k);

private:
  void mark(Halfedge h, bool is_seam)
  {
    set(h, is_seam);
    if(m_mesh.opposite(h) != no_halfedge)
      set(m_mesh.opposite(h), is_seam);
  }

  void set(Halfedge h, bool is_seam)
  {
    const std::uint8_t bit = std::uint8_t(1u << h % 3);
    m_seams[h / 3] = std::uint8_t(is_seam ? m_seams[h / 3] | bit : m_seams[h / 3] & ~bit);
  }

  // What a split does to the two sides of a triangle that it makes, which were one edge before.
  struct Doubled_edge
  {
    Halfedge side_of_r, side_of_k;
    bool is_free; // a seam that may become one or the other
  };

  struct Star;

  Star star_after_split(Halfedge e, Vertex_index r, Vertex_index k);

  Linked_triangles m_mesh;
  Crease_metric m_metric;
  std::vector<std::uint8_t> m_seams; // of each triangle, as in `Face_charts`
  std::vector<std::uint32_t> m_degree;
  std::vector<std::uint8_t> m_is_border, m_is_pinned;
};

// The seams at both ends of a new edge but for those that are yet to be placed.
struct Seam_net::Star
{
  std::uint32_t at_r = 0, at_k = 0;
  bool is_leaf = false; // the seams ended at k
  Doubled_edge doubled[2];
  int number_doubled = 0;
  bool is_border = false; // the new edge has one triangle
};

inline void Seam_net::set_seams(std::vector<std::uint8_t> seams)
{
  CGAL_precondition(seams.size() == m_seams.size());
  m_seams = std::move(seams);
  std::fill(m_degree.begin(), m_degree.end(), 0);
  for(Halfedge h = 0; h < m_mesh.number_of_halfedges(); ++h)
    if(is_seam(h) && (m_mesh.opposite(h) == no_halfedge || m_mesh.opposite(h) > h)) {
      ++m_degree[m_mesh.source(h)];
      ++m_degree[m_mesh.target(h)];
    }
}

inline void Seam_net::pin_curved(double defect)
{
  for(Vertex_index v = 0; v < m_degree.size(); ++v) {
    m_is_pinned[v] = 0;
    if(m_degree[v] == 0 || is_border(v))
      continue;
    double angles = 0.;
    m_mesh.for_each_outgoing(m_mesh.outgoing(v), [&](Halfedge h) {
      angles += m_metric.angle(v, m_mesh.target(h), m_mesh.source(previous_halfedge(h)));
      return true;
    });
    m_is_pinned[v] = std::abs(360. - angles) >= defect;
  }
}

// Marks the border, and lets the other sides of the new triangles be no seams for the moment.
inline Seam_net::Star Seam_net::star_after_split(Halfedge e, Vertex_index r, Vertex_index k)
{
  Star star;
  star.at_k = m_degree[k];
  star.is_leaf = m_degree[k] == 1;
  star.is_border = m_mesh.opposite(e) == no_halfedge;
  m_mesh.for_each_dying(e, r, [&](const Linked_triangles::Dying& d) {
    const Halfedge a = m_mesh.opposite(d.side_of_r), b = m_mesh.opposite(d.side_of_k);
    Doubled_edge& doubled = star.doubled[star.number_doubled++];
    doubled = {d.side_of_r, d.side_of_k, false};
    if(a != no_halfedge && b != no_halfedge) {
      doubled.is_free = is_seam(a);
      star.at_k -= doubled.is_free ? 1 : 0;
    }
    mark(d.side_of_r, a == no_halfedge);
    mark(d.side_of_k, b == no_halfedge);
  });
  std::uint32_t moved = 0; // seams that r takes from k
  m_mesh.for_each_outgoing(m_mesh.outgoing(r), [&](Halfedge h) {
    moved += is_seam(h) ? 1 : 0;
    const Halfedge last = previous_halfedge(h); // an edge with no halfedge from r
    moved += m_mesh.opposite(last) == no_halfedge && is_seam(last) ? 1 : 0;
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
inline void Seam_net::split(Halfedge e, Vertex_index r, Vertex_index k)
{
  m_mesh.split(e, r);
  if(m_degree[k] == 0)
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
    mark(best_way & 1 ? star.doubled[0].side_of_r : star.doubled[0].side_of_k, true);
  if(free_1)
    mark(best_way & 2 ? star.doubled[1].side_of_r : star.doubled[1].side_of_k, true);
  mark(e, (best_way & 4) != 0);
  const std::uint32_t joins = best_way >> 2;
  m_degree[r] = star.at_r + (best_way & 1) + (best_way >> 1 & 1) + joins;
  m_degree[k] = star.at_k + (free_0 && !(best_way & 1)) + (free_1 && !(best_way & 2)) + joins;
  if(m_degree[k] == 0) // all seams have gone with r
    std::swap(m_is_pinned[k], m_is_pinned[r]);
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_NET_H
