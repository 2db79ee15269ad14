// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_WORKER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_WORKER_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_profile.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A mesh that collapses change, with the policies of the collapses, and of each vertex the cheapest
// collapse, as far as it is known. Several threads use it at the same time, for vertices that have
// no neighbour in common.
template <class Cost_, class Filter_, class Layer_>
struct Decimated_surface
{
  typedef Cost_ Cost;
  typedef Layer_ Layer;
  typedef Surface_mesh_simplification::Vertex_star Vertex_star;

  static constexpr float no_cost = (std::numeric_limits<float>::infinity)();
  static constexpr bool needs_update
    = Surface_mesh_simplification::Needs_update<Cost>::value;

  struct State // of a vertex
  {
    std::uint8_t is_gone : 1, is_locked : 1, is_stale : 1;
  };

  // `is_locked`: for each vertex whether it must stay; empty for none
  Decimated_surface(const Indexed_triangle_mesh& mesh, Vertex_rings mesh_rings,
                    const std::vector<bool>& is_locked, const Cost_& cost, const Filter_& filter,
                    const Layer_& layer);

  std::size_t number_of_vertices() const { return mesh.points.size(); }
  Flat_surface view() const { return Flat_surface(mesh, rings); }

  // To be called before each pass, by one thread.
  void begin_pass()
  {
    if constexpr(Layer::is_active)
      layer.begin_pass();
  }

  // Asks for what the vertices between alive[i] and alive[end] will need.
  void prefetch(const std::vector<Vertex_index>& alive, std::size_t i, std::size_t end) const;

  const Indexed_triangle_mesh& mesh;
  Vertex_rings rings;
  Cost_ cost;
  Filter_ filter;
  Layer_ layer;
  std::vector<float> best_cost;          // of each vertex; `no_cost` if it stays
  std::vector<Vertex_index> best_target; // any vertex if it stays
  std::vector<State> state;
  std::atomic<std::size_t> evaluations{0}; // of costs, one a vertex and its ring
};

template <class Cost, class Filter, class Layer>
Decimated_surface<Cost, Filter, Layer>::
Decimated_surface(const Indexed_triangle_mesh& m, Vertex_rings mesh_rings,
                  const std::vector<bool>& is_locked, const Cost& c, const Filter& f,
                  const Layer& l)
  : mesh(m), rings(std::move(mesh_rings)), cost(c), filter(f), layer(l)
  , best_cost(m.points.size(), no_cost)
  , best_target(m.points.size(), no_vertex)
  , state(m.points.size())
{
  for(std::size_t v = 0; v < state.size(); ++v)
    state[v] = {0, std::uint8_t(!is_locked.empty() && is_locked[v]), 1};
  if constexpr(Layer::is_active) {
    layer.set_rings(rings);
    for(Vertex_index v = 0; v < state.size(); ++v)
      state[v].is_locked |= std::uint8_t(layer.is_fixed(v));
  }
  if constexpr(needs_update) {
    const Flat_collapse_profile profile(view());
    cost.initialize(profile.surface_mesh(), profile.vertex_point_map(), profile.geom_traits());
  }
}

// Their lines first and, when these are there, the points of their rings and the lines that a
// collapse changes. Beyond `end` another thread may be changing the rings.
template <class Cost, class Filter, class Layer>
void Decimated_surface<Cost, Filter, Layer>::prefetch(const std::vector<Vertex_index>& alive,
                                                        std::size_t i, std::size_t end) const
{
  constexpr std::size_t distance = 4; // vertices ahead of use: about the latency of the memory
  if(i + 2 * distance >= end)
    return;
  const Vertex_index next = alive[i + distance];
  const Vertex_index later = alive[i + 2 * distance];
  rings.prefetch(later);
  Blocked_execution::prefetch(&best_cost[later]);
  Blocked_execution::prefetch(&mesh.points[later]);
  const std::uint32_t d = rings.degree(next);
  if(d > std::uint32_t(Vertex_star::max_degree)) // it stays
    return;
  const Vertex_index* r = rings.ring(next);
  for(std::uint32_t k = 0; k < d; ++k) {
    const char* point = reinterpret_cast<const char*>(&mesh.points[r[k]]);
    Blocked_execution::prefetch(point);
    Blocked_execution::prefetch(point + sizeof(mesh.points[0]) - 1); // in the same line or the next
    rings.prefetch(r[k]);
  }
}

// What one thread does to one vertex after the other of a `Decimated_surface`: looks for the
// cheapest collapse, and makes it.
template <class Surface>
class Collapse_worker
{
public:
  typedef std::vector<Halfedge_collapse> Collapses;

  // In this pass it alone may remove the vertices from `low` to `high`.
  explicit Collapse_worker(Surface& surface, Vertex_index low = 0, Vertex_index high = no_vertex)
    : m_surface(surface), m_low(low), m_high(high), m_profile(surface.view())
  {}

  // Adds its evaluations to those of the surface.
  ~Collapse_worker() { m_surface.evaluations += m_evaluations; }
  Collapse_worker(const Collapse_worker&) = delete;
  Collapse_worker& operator=(const Collapse_worker&) = delete;

  // Notes the best target of v.
  void evaluate(Vertex_index v, bool check_topology);

  // Collapses v into its best target if that still costs at most `limit`. If topology forbids it,
  // v gets the best target that it allows, and stays for now.
  bool try_collapse(Vertex_index v, float limit, Collapses& collapses);

  // Collapses v into the best target that the policies and topology allow, if there is one.
  bool collapse_into_best(Vertex_index v, Collapses& collapses);

private:
  typedef typename Surface::Layer Layer;
  typedef typename Surface::Vertex_star Vertex_star;
  static constexpr float no_cost = Surface::no_cost;

  struct Target // of a collapse; any vertex if the cost is `no_cost`
  {
    Vertex_index vertex;
    float cost;
  };

  // Whether topology and the size of a ring allow the collapse of v into its ring vertex k.
  bool is_possible(Vertex_index v, std::uint32_t k) const
  {
    const Vertex_rings& rings = m_surface.rings;
    if(!rings.is_collapse_valid(v, k) || rings.needs_new_spill(v, k))
      return false;
    if constexpr(Layer::is_active)
      return m_surface.layer.is_possible(v, k, m_low, m_high);
    return true;
  }

  // Where w is in the ring of v: the degree of v if it is not.
  std::uint32_t position(Vertex_index v, Vertex_index w) const
  {
    const Vertex_index* r = m_surface.rings.ring(v);
    return std::uint32_t(std::find(r, r + m_surface.rings.degree(v), w) - r);
  }

  bool load_star(Vertex_index v);
  void set_profile(Vertex_index v, std::uint32_t k);
  float cost_of_profile() const;
  float cost_of(Vertex_index v, std::uint32_t k);
  Target best_target(Vertex_index v, bool check_topology);
  void collapse(Vertex_index v, std::uint32_t k, Collapses& collapses);

  Surface& m_surface;
  Vertex_index m_low, m_high;
  Flat_collapse_profile m_profile;
  Vertex_star m_star;
  std::size_t m_evaluations = 0;
};

// Returns false if v has to stay.
template <class Surface>
bool Collapse_worker<Surface>::load_star(Vertex_index v)
{
  const Vertex_rings& rings = m_surface.rings;
  const auto& points = m_surface.mesh.points;
  const std::uint32_t d = rings.degree(v);
  if(m_surface.state[v].is_locked || d > std::uint32_t(Vertex_star::max_degree))
    return false;
  const Vertex_index* r = rings.ring(v);
  const auto& p = points[v];
  m_star.reset(int(d), rings.is_border(v));
  for(std::uint32_t i = 0; i < d; ++i) {
    const auto& q = points[r[i]];
    m_star.set_ring_point(int(i), float(q.x() - p.x()), float(q.y() - p.y()),
                          float(q.z() - p.z()));
  }
  m_star.prepare();
  auto& collapse = m_profile.collapse();
  collapse.is_valid = true;
  collapse.is_border = rings.is_border(v);
  collapse.removed_degree = int(d);
  collapse.angle_sum = m_star.angle_sum();
  collapse.min_squared_quality = m_star.min_squared_quality();
  return true;
}

// Lets the profile describe the collapse of v, whose star is loaded, into its ring vertex k.
template <class Surface>
void Collapse_worker<Surface>::set_profile(Vertex_index v, std::uint32_t k)
{
  m_profile.set(v, k);
  auto& collapse = m_profile.collapse();
  collapse.kept_degree = m_surface.rings.small_degree(m_profile.v1());
  collapse.measure = m_star.measure(int(k));
}

// The cost of the collapse that the profile describes, or `no_cost` if the policies forbid it.
// Declared inline because it is what the loop over the targets does.
template <class Surface>
inline float Collapse_worker<Surface>::cost_of_profile() const
{
  if(!m_surface.filter(m_profile, m_profile.placement()))
    return no_cost;
  const auto cost = m_surface.cost(m_profile, m_profile.placement());
  return cost && float(*cost) < no_cost ? float(*cost) : no_cost; // not a number: no cost
}

// The cost of collapsing v, whose star is loaded, into its ring vertex k.
template <class Surface>
inline float Collapse_worker<Surface>::cost_of(Vertex_index v, std::uint32_t k)
{
  if constexpr(Layer::is_active)
    if(!m_surface.layer.is_target(v, m_surface.rings.ring(v)[k]))
      return no_cost;
  set_profile(v, k);
  float cost = cost_of_profile();
  if constexpr(Layer::is_active)
    if(cost < no_cost)
      cost += m_surface.layer.cost(v, k);
  return cost;
}

// The cheapest target of v that the policies, and if asked topology, allow; the smaller vertex
// index on a tie. Precondition: the star of v is loaded.
template <class Surface>
typename Collapse_worker<Surface>::Target
Collapse_worker<Surface>::best_target(Vertex_index v, bool check_topology)
{
  const Vertex_index* r = m_surface.rings.ring(v);
  const std::uint32_t d = m_surface.rings.degree(v);
  const std::uint32_t step = m_surface.rings.is_border(v) ? d - 1 : 1; // the two ends only
  float costs[Vertex_star::max_degree];
  std::fill_n(costs, d, no_cost);
  for(std::uint32_t k = 0; k < d; k += step) {
    costs[k] = cost_of(v, k);
  }
  while(true) {
    // Loops without branches: which target is the best is nothing that a processor can predict.
    Target best{no_vertex, no_cost};
    for(std::uint32_t k = 0; k < d; ++k)
      best.cost = (std::min)(best.cost, costs[k]);
    for(std::uint32_t k = 0; k < d; ++k)
      best.vertex = (std::min)(best.vertex, costs[k] == best.cost ? r[k] : no_vertex);
    if(best.cost == no_cost || !check_topology)
      return best;
    const std::uint32_t k = position(v, best.vertex);
    if(is_possible(v, k))
      return best;
    costs[k] = no_cost;
  }
}

template <class Surface>
void Collapse_worker<Surface>::evaluate(Vertex_index v, bool check_topology)
{
  m_surface.state[v].is_stale = 0;
  m_surface.best_cost[v] = no_cost;
  ++m_evaluations;
  if(!load_star(v))
    return;
  const Target target = best_target(v, check_topology);
  m_surface.best_cost[v] = target.cost;
  m_surface.best_target[v] = target.vertex;
}

template <class Surface>
bool Collapse_worker<Surface>::try_collapse(Vertex_index v, float limit, Collapses& collapses)
{
  const std::uint32_t k = position(v, m_surface.best_target[v]);
  if(k == m_surface.rings.degree(v) || !load_star(v))
    return false;
  if(!(cost_of(v, k) <= limit))
    return false;
  if(!is_possible(v, k)) {
    evaluate(v, true);
    return false;
  }
  collapse(v, k, collapses);
  return true;
}

template <class Surface>
bool Collapse_worker<Surface>::collapse_into_best(Vertex_index v, Collapses& collapses)
{
  ++m_evaluations;
  if(!load_star(v))
    return false;
  const Target target = best_target(v, true);
  if(target.cost == no_cost)
    return false;
  const std::uint32_t k = position(v, target.vertex);
  set_profile(v, k);
  collapse(v, k, collapses);
  return true;
}

// Makes the collapse that the profile describes, of v into its ring vertex k.
template <class Surface>
void Collapse_worker<Surface>::collapse(Vertex_index v, std::uint32_t k, Collapses& collapses)
{
  Vertex_rings& rings = m_surface.rings;
  const Vertex_index* r = rings.ring(v);
  const std::uint32_t d = rings.degree(v);
  if constexpr(Surface::needs_update)
    m_surface.cost.update_before_collapse(m_profile, m_profile.placement());
  collapses.push_back({v, r[k]});
  if constexpr(Layer::is_active)
    m_surface.layer.collapse(v, k);
  rings.collapse(v, k);
  m_surface.state[v].is_gone = 1;
  for(std::uint32_t i = 0; i < d; ++i)
    m_surface.state[r[i]].is_stale = 1;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_WORKER_H
