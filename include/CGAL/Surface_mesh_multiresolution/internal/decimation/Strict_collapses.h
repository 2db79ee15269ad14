// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STRICT_COLLAPSES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STRICT_COLLAPSES_H

#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Collapse_worker.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/stop_conditions.h>

#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Decimates a `Decimated_surface` by the cheapest collapse of all, one at a time.
template <class Surface, class Stop>
class Strict_collapses
{
public:
  // All of these must outlive this.
  Strict_collapses(Surface& surface, const Flat_collapse_options& options, Stop& stop)
    : m_surface(surface), m_worker(surface), m_stop(stop), m_progress(options.progress)
  {}

  // Appends the collapses.
  Decimation_end run(Progressive_mesh& pm);

private:
  static constexpr std::size_t steps_between_reports = 16384;

  bool goes_on(const Progressive_mesh& pm)
  {
    return ++m_steps % steps_between_reports != 0 || m_progress(pm);
  }

  void enqueue(Vertex_index v)
  {
    m_worker.evaluate(v, true);
    if(m_surface.best_cost[v] < Surface::no_cost)
      m_queue.push({m_surface.best_cost[v], v});
  }

  typedef std::pair<float, Vertex_index> Entry; // smallest cost first, then smallest index

  // Whether the collapse of v, the next one, is one too many.
  bool stops_at(Vertex_index v, float cost, const Progressive_mesh& pm)
  {
    if constexpr(Stop::asks_for_costs)
      return m_stop.stops_at(v, m_surface.best_target[v], cost, pm);
    return false;
  }

  Surface& m_surface;
  Collapse_worker<Surface> m_worker;
  Stop& m_stop;
  Collapse_progress m_progress;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> m_queue;
  std::size_t m_steps = 0;
};

template <class Surface, class Stop>
Decimation_end Strict_collapses<Surface, Stop>::run(Progressive_mesh& pm)
{
  const std::size_t n = m_surface.number_of_vertices();
  if constexpr(Stop::asks_for_costs)
    m_progress.expect(n);
  else
    m_progress.expect(m_stop.left(pm));
  for(Vertex_index v = 0; v < n && goes_on(pm); ++v)
    enqueue(v);
  std::size_t next_pass = n / 2; // vertices left
  bool has_stopped = m_stop.is_over(pm);
  while(!m_queue.empty() && !has_stopped && !m_progress.is_cancelled() && goes_on(pm)) {
    if(n - pm.collapses.size() <= next_pass) {
      m_surface.begin_pass();
      next_pass /= 2;
    }
    const auto [cost, v] = m_queue.top();
    m_queue.pop();
    if(m_surface.state[v].is_gone || cost != m_surface.best_cost[v]) // a later entry replaced it
      continue;
    has_stopped = stops_at(v, cost, pm);
    if(has_stopped)
      break;
    const Vertex_index* r = m_surface.rings.ring(v);
    const std::uint32_t d = m_surface.rings.degree(v);
    if(!m_worker.try_collapse(v, cost, pm.collapses)) { // the degree of the target has changed, or
      enqueue(v);                                       // topology forbids it
      continue;
    }
    m_surface.best_cost[v] = Surface::no_cost;
    for(std::uint32_t i = 0; i < d; ++i)
      enqueue(r[i]);
    has_stopped = m_stop.is_over(pm);
  }
  const bool is_cancelled = m_progress.is_cancelled();
  return {!has_stopped && !is_cancelled, is_cancelled};
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_STRICT_COLLAPSES_H
