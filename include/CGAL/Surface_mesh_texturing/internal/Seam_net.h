// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAM_NET_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAM_NET_H

#include <CGAL/Surface_mesh_texturing/internal/Crease_metric.h>
#include <CGAL/Surface_mesh_texturing/internal/Linked_triangles.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

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

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAM_NET_H
