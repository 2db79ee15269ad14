// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STOP_CONDITIONS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STOP_CONDITIONS_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_profile.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Stops at a number of vertices.
class Stop_at_vertices
{
public:
  static constexpr bool asks_for_costs = false;

  Stop_at_vertices(std::size_t n, std::size_t target) : m_n(n), m_target(target) {}

  // How many collapses are wanted.
  std::size_t left(const Progressive_mesh& pm) const
  {
    const std::size_t vertices = m_n - pm.collapses.size();
    return vertices > m_target ? vertices - m_target : 0;
  }

  // Whether the decimation is over, as far as is known before costs are up to date.
  bool is_over(const Progressive_mesh& pm) const { return left(pm) == 0; }

  // The same when they are.
  template <class Surface>
  std::size_t wanted(const Surface&, const std::vector<Vertex_index>&, const Progressive_mesh& pm)
  {
    return left(pm);
  }

  // The highest cost, not above the given one, that a collapse may have now.
  template <class Surface>
  float limit(const Surface&, const std::vector<Vertex_index>&, float threshold) const
  {
    return threshold;
  }
  bool is_limited() const { return false; }

private:
  std::size_t m_n, m_target;
};

// Stops when a stop predicate of CGAL says so.
//
// In the strict order it is asked for each collapse, as CGAL's engine does. For a pass, which makes
// many collapses, it is asked how many there may be until it stops, as if each took three edges and
// two faces away, and up to which cost. On the border a collapse takes less, so that a pass never
// goes beyond a number; another pass follows.
template <class StopPredicate>
class Stop_by_predicate
{
public:
  static constexpr bool asks_for_costs = true;

  // The predicate sees the points of `mesh`, and costs times `unit`. All must outlive this.
  Stop_by_predicate(const StopPredicate& predicate, const Indexed_triangle_mesh& mesh,
                    const Vertex_rings& rings, double unit)
    : m_predicate(predicate), m_rings(rings), m_profile(Flat_surface(mesh, rings)), m_unit(unit)
  {
    std::size_t ends = 0, corners = 0;
    for(Vertex_index v = 0; v < rings.size(); ++v) {
      ends += rings.degree(v);
      corners += rings.degree(v) - (rings.is_border(v) ? 1 : 0);
    }
    m_counts = {rings.size(), ends / 2, corners / 3};
    m_initial_edges = m_counts.edges;
  }

  // With the cheapest collapse of the last pass: what comes now is dearer, or about as cheap.
  bool is_over(const Progressive_mesh& pm)
  {
    count(pm);
    return m_is_known && stops(m_cheapest, 0);
  }

  template <class Surface>
  std::size_t wanted(const Surface& surface, const std::vector<Vertex_index>& alive,
                     const Progressive_mesh& pm)
  {
    count(pm);
    if(alive.empty())
      return 0;
    const Vertex_index v = *std::min_element(
      alive.begin(), alive.end(),
      [&surface](Vertex_index a, Vertex_index b) { return surface.best_cost[a] < surface.best_cost[b]; });
    m_cheapest = surface.best_cost[v];
    if(m_cheapest == Surface::no_cost)
      return alive.size();
    m_is_known = true;
    m_cheapest_vertex = v;
    describe(v, surface.best_target[v]);
    std::size_t goes_on = 0, over = alive.size();
    if(stops(m_cheapest, 0) || !stops(m_cheapest, over))
      return stops(m_cheapest, 0) ? 0 : over;
    while(over - goes_on > 1) {
      const std::size_t middle = goes_on + (over - goes_on) / 2;
      (stops(m_cheapest, middle) ? over : goes_on) = middle;
    }
    return over;
  }

  // That of the last vertex, in the order of costs, at whose collapse the predicate does not stop.
  template <class Surface>
  float limit(const Surface& surface, const std::vector<Vertex_index>& alive, float threshold)
  {
    const auto stops_there = [&](Vertex_index v) {
      describe(v, surface.best_target[v]);
      return stops(surface.best_cost[v], 0);
    };
    const auto is_cheaper = [&surface](Vertex_index a, Vertex_index b) {
      const float cost_a = surface.best_cost[a], cost_b = surface.best_cost[b];
      return cost_a < cost_b || (cost_a == cost_b && a < b);
    };
    std::vector<Vertex_index> order;
    for(const Vertex_index v : alive)
      if(surface.best_cost[v] <= threshold)
        order.push_back(v);
    m_is_limited = stops_there(*std::max_element(order.begin(), order.end(), is_cheaper));
    if(m_is_limited) {
      std::sort(order.begin(), order.end(), is_cheaper);
      const auto beyond = std::partition_point(
        order.begin(), order.end(), [&](Vertex_index v) { return !stops_there(v); });
      threshold = beyond == order.begin() ? m_cheapest : surface.best_cost[beyond[-1]];
    }
    describe(m_cheapest_vertex, surface.best_target[m_cheapest_vertex]); // for `is_over()`
    return threshold;
  }

  // Whether the last pass was ended by the cost.
  bool is_limited() const { return m_is_limited; }

  // Whether the collapse of v into t, the cheapest, is one too many.
  bool stops_at(Vertex_index v, Vertex_index t, float cost, const Progressive_mesh& pm)
  {
    count(pm);
    describe(v, t);
    return stops(cost, 0);
  }

private:
  // What the collapses since the last time have taken away. The ring of a vertex that is gone
  // still tells whether it was on the border.
  void count(const Progressive_mesh& pm)
  {
    for(; m_collapses < pm.collapses.size(); ++m_collapses) {
      const bool is_border = m_rings.is_border(pm.collapses[m_collapses].removed);
      --m_counts.vertices;
      m_counts.edges -= is_border ? 2 : 3;
      m_counts.faces -= is_border ? 1 : 2;
    }
  }

  void describe(Vertex_index v, Vertex_index t)
  {
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t d = m_rings.degree(v);
    const std::uint32_t k = std::uint32_t(std::find(r, r + d, t) - r);
    m_profile.set(v, k == d ? 0 : k);
  }

  // Whether the predicate stops at a collapse of this cost after `more` collapses.
  bool stops(float cost, std::size_t more)
  {
    const auto less = [](std::size_t n, std::size_t m) { return n > m ? n - m : 0; };
    const Mesh_counts counts = {less(m_counts.vertices, more), less(m_counts.edges, 3 * more),
                                less(m_counts.faces, 2 * more)};
    m_profile.set_counts(counts);
    return m_predicate(double(cost) * m_unit, m_profile, m_initial_edges, counts.edges);
  }

  const StopPredicate& m_predicate;
  const Vertex_rings& m_rings;
  Flat_collapse_profile m_profile; // of the cheapest collapse
  double m_unit;
  Mesh_counts m_counts;
  std::size_t m_initial_edges = 0, m_collapses = 0;
  float m_cheapest = 0.f; // cost, in the last pass
  Vertex_index m_cheapest_vertex = no_vertex;
  bool m_is_known = false, m_is_limited = false;
};

// Asks the user's function whether the decimation is to go on.
class Collapse_progress
{
public:
  explicit Collapse_progress(const std::function<bool(double)>& function) : m_function(function) {}

  // Tells how many collapses there will be in all.
  void expect(std::size_t collapses) { m_whole = collapses > 0 ? double(collapses) : 1.; }

  bool operator()(const Progressive_mesh& pm)
  {
    if(m_function && !m_is_cancelled) {
      m_part = (std::max)(m_part, (std::min)(1., double(pm.collapses.size()) / m_whole));
      m_is_cancelled = !m_function(m_part);
    }
    return !m_is_cancelled;
  }

  bool is_cancelled() const { return m_is_cancelled; }

private:
  const std::function<bool(double)>& m_function;
  double m_whole = 1., m_part = 0.;
  bool m_is_cancelled = false;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STOP_CONDITIONS_H
