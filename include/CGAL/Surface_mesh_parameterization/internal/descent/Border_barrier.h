// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_BARRIER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_BARRIER_H

#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/plane_geometry.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The borders of a map, as cycles of vertices with the surface on their left.
typedef std::vector<std::vector<Vertex_index>> Border_loops;

// The edges of borders.
inline std::vector<std::array<std::uint32_t, 2>> edges_of(const Border_loops& loops)
{
  std::vector<std::array<std::uint32_t, 2>> edges;
  for(const auto& loop : loops)
    for(std::size_t i = 0; i < loop.size(); ++i)
      edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  return edges;
}

// Whether only one of the borders is an outer one, that is runs counterclockwise. Then, if they are
// simple and disjoint, a map whose triangles are all positive is one-to-one: see `certify_map()`.
inline bool has_one_outer_border(const Border_loops& loops, const std::vector<Plane_point>& z)
{
  std::size_t outer = 0;
  for(const auto& loop : loops) {
    double twice_area = 0.;
    for(std::size_t i = 0; i < loop.size(); ++i)
      twice_area += (z[loop[i]] - z[loop[0]]).cross(z[loop[(i + 1) % loop.size()]] - z[loop[0]]);
    outer += twice_area > 0. ? 1 : 0;
  }
  return outer == 1;
}

// Whether that is so, and they are simple and disjoint by exact predicates.
inline bool are_apart(const Border_loops& loops, const std::vector<Plane_point>& z)
{
  std::vector<Uv_point> points;
  for(const Plane_point& p : z)
    points.emplace_back(p.x, p.y);
  return has_one_outer_border(loops, z) && is_simple_border(edges_of(loops), points);
}

// Keeps the borders of a map apart from each other and themselves: the energy of a vertex and an edge
// of the border at a distance d below epsilon is l^2 (epsilon / d - 1)^2 (Smith and Schaefer 2015,
// section 5), with the length l of the shortest edge involved when the barrier was built, and epsilon a
// part of it. So the sum is small compared with the area, the more so the finer the mesh.
//
// A map with borders that cross has an infinite energy: it is the state that is tested, not the way to
// it.
class Border_barrier
{
public:
  typedef std::vector<Plane_point> Places;

  static constexpr double reach = 0.25; // epsilon, in lengths

  // A vertex near an edge a, b, at the point a + s (b - a) of it; the direction from there has length 1.
  struct Contact
  {
    std::array<Vertex_index, 3> corner; // the vertex, a, b
    std::array<double, 3> share;        // of the change of the distance: 1, s - 1, -s
    Plane_point normal;
    double slope, curvature; // derivatives of the energy by the distance

    Plane_point gradient(int j) const { return normal * (slope * share[j]); }
    Plane_matrix<double> block(int j, int k) const
    {
      const double f = curvature * share[j] * share[k];
      return {f * normal.x * normal.x, f * normal.x * normal.y, f * normal.x * normal.y,
              f * normal.y * normal.y};
    }
  };

  // For a level with these borders, at a map in which no two edges cross.
  Border_barrier(Border_loops loops, const Places& z)
    : m_loops(std::move(loops)), m_edges(edges_of(m_loops))
  {
    for(const Edge& e : m_edges)
      m_length.push_back(std::sqrt((z[e[1]] - z[e[0]]).squared_length()));
    std::size_t i = 0; // an edge is as long as the shortest of itself and its neighbours
    const std::vector<double> length = m_length;
    for(const auto& loop : m_loops) {
      for(std::size_t k = 0; k < loop.size(); ++k) {
        const double before = length[i + (k + loop.size() - 1) % loop.size()];
        m_length[i + k] = (std::min)(length[i + k], before);
      }
      i += loop.size();
    }
  }

  // The energy of a map, infinity if borders cross.
  double energy_at(const Places& z) const
  {
    double sum = 0.;
    const auto add = [&](std::size_t i, std::size_t j) {
      return !cross(i, j, z) && add_energy(i, j, z, sum) && add_energy(j, i, z, sum);
    };
    return has_one_outer_border(m_loops, z) && for_each_near_pair(z, add) ? sum : infinity;
  }

  // Finds the contacts of a map of finite energy, with their derivatives.
  void linearize(const Places& z)
  {
    m_contacts.clear();
    for_each_near_pair(z, [&](std::size_t i, std::size_t j) {
      add_contact(i, j, z);
      add_contact(j, i, z);
      return true;
    });
    m_at.clear();
    for(std::uint32_t c = 0; c < m_contacts.size(); ++c)
      for(std::uint32_t k = 0; k < 3; ++k)
        m_at.push_back({m_contacts[c].corner[k], 3 * c + k});
    std::sort(m_at.begin(), m_at.end());
  }

  // Calls use(contact, k) for those of which v is corner k, after `linearize()`.
  template <class Use>
  void for_each_contact_of(Vertex_index v, const Use& use) const
  {
    for(auto at = std::lower_bound(m_at.begin(), m_at.end(), std::make_pair(v, std::uint32_t(0)));
        at != m_at.end() && at->first == v; ++at)
      use(m_contacts[at->second / 3], int(at->second % 3));
  }

  const Border_loops& loops() const { return m_loops; }

private:
  typedef std::array<std::uint32_t, 2> Edge;
  static constexpr double infinity = (std::numeric_limits<double>::infinity)();

  // Calls visit(i, j) for edges whose boxes, each grown by half of its reach, meet, until it returns
  // false; returns whether it never did. By a sweep, in an order that the places alone decide.
  template <class Visit>
  bool for_each_near_pair(const Places& z, const Visit& visit) const
  {
    struct Box
    {
      double left, right, low, high;
      std::uint32_t edge;
    };
    std::vector<Box> boxes;
    boxes.reserve(m_edges.size());
    for(std::uint32_t i = 0; i < m_edges.size(); ++i) {
      const Plane_point &a = z[m_edges[i][0]], &b = z[m_edges[i][1]];
      const double margin = 0.5 * reach * m_length[i];
      boxes.push_back({(std::min)(a.x, b.x) - margin, (std::max)(a.x, b.x) + margin,
                       (std::min)(a.y, b.y) - margin, (std::max)(a.y, b.y) + margin, i});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
      return std::make_pair(a.left, a.edge) < std::make_pair(b.left, b.edge);
    });
    std::vector<Box> active;
    for(const Box& box : boxes) {
      std::size_t kept = 0;
      for(std::size_t i = 0; i < active.size(); ++i) {
        const Box other = active[i];
        if(other.right < box.left)
          continue;
        active[kept++] = other;
        if(other.low <= box.high && box.low <= other.high && !visit(box.edge, other.edge))
          return false;
      }
      active.resize(kept);
      active.push_back(box);
    }
    return true;
  }

  bool cross(std::size_t i, std::size_t j, const Places& z) const
  {
    const Edge &e = m_edges[i], &f = m_edges[j];
    if(e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])
      return false;
    const auto side = [&z](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      return (z[b] - z[a]).cross(z[c] - z[a]);
    };
    const auto differ = [](double a, double b) { return (a >= 0. && b <= 0.) || (a <= 0. && b >= 0.); };
    return differ(side(e[0], e[1], f[0]), side(e[0], e[1], f[1]))
        && differ(side(f[0], f[1], e[0]), side(f[0], f[1], e[1]));
  }

  // The first vertex of edge i beside edge j: that of the shortest distance, if it counts.
  struct Distance
  {
    bool counts = false;
    double s = 0., d = 0., length = 0.;
    Plane_point difference;
  };
  Distance distance(std::size_t i, std::size_t j, const Places& z) const
  {
    Distance result;
    const Vertex_index v = m_edges[i][0], a = m_edges[j][0], b = m_edges[j][1];
    if(v == a || v == b)
      return result;
    const Nearest_on_segment nearest(z[a], z[b], z[v]);
    result.s = nearest.share;
    result.difference = nearest.way;
    result.d = std::sqrt(result.difference.squared_length());
    result.length = (std::min)(m_length[i], m_length[j]);
    result.counts = result.d < reach * result.length;
    return result;
  }

  bool add_energy(std::size_t i, std::size_t j, const Places& z, double& sum) const
  {
    const Distance d = distance(i, j, z);
    if(d.counts) {
      const double f = reach * d.length / d.d - 1.;
      sum += d.length * d.length * f * f;
    }
    return std::isfinite(sum);
  }

  void add_contact(std::size_t i, std::size_t j, const Places& z)
  {
    const Distance d = distance(i, j, z);
    if(!d.counts)
      return;
    const double q = reach * d.length / d.d, w = d.length * d.length / d.d;
    m_contacts.push_back({{m_edges[i][0], m_edges[j][0], m_edges[j][1]}, {1., d.s - 1., -d.s},
                          d.difference * (1. / d.d), -2. * w * (q - 1.) * q,
                          w / d.d * (6. * q - 4.) * q});
  }

  Border_loops m_loops;
  std::vector<Edge> m_edges;
  std::vector<double> m_length; // by edges: the shorter of it and that before it
  std::vector<Contact> m_contacts;
  std::vector<std::pair<Vertex_index, std::uint32_t>> m_at; // by vertices: 3 times a contact + corner
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_BORDER_BARRIER_H
