// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_BATCHED_COLLAPSES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_BATCHED_COLLAPSES_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/Collapse_worker.h>
#include <CGAL/Surface_mesh_multiresolution/internal/decimation/stop_conditions.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
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

// The highest bits of a number, ordered as the numbers are.
inline std::uint32_t class_of_cost(float cost)
{
  std::uint32_t bits;
  std::memcpy(&bits, &cost, sizeof(bits));
  return ((bits >> 31) != 0 ? ~bits : bits | (1u << 31)) >> 19;
}

// How many costs of a block there are in each class.
typedef std::array<std::uint32_t, 8192> Cost_histogram;

// The cost of the members that is at the place `rank(n)` of the n finite ones in their order;
// infinity if none is finite. Counts classes of costs first, so that few remain to be compared.
template <class Rank>
float nth_cost(const std::vector<Vertex_index>& members, const std::vector<float>& cost,
               const Rank& rank)
{
  constexpr float infinity = (std::numeric_limits<float>::infinity)();
  constexpr std::size_t block = 65536;
  std::vector<Cost_histogram> counts(
    Blocked_execution::number_of_blocks(members.size(), block));
  Blocked_execution::blocked_for(members.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      if(cost[members[i]] < infinity)
        ++counts[begin / block][class_of_cost(cost[members[i]])];
  });
  Cost_histogram total = {};
  std::size_t number = 0;
  for(const Cost_histogram& of_block : counts)
    for(std::size_t c = 0; c < total.size(); ++c) {
      total[c] += of_block[c];
      number += of_block[c];
    }
  if(number == 0)
    return infinity;
  std::size_t place = rank(number);
  std::uint32_t its_class = 0;
  while(place >= total[its_class])
    place -= total[its_class++];
  std::vector<float> candidates;
  candidates.reserve(total[its_class]);
  for(const Vertex_index v : members)
    if(cost[v] < infinity && class_of_cost(cost[v]) == its_class)
      candidates.push_back(cost[v]);
  std::nth_element(candidates.begin(), candidates.begin() + place, candidates.end());
  return candidates[place];
}

// Decimates a `Decimated_surface` by passes over the cheapest part of its vertices in the order of
// memory.
//
// Passes go over blocks of equal numbers of living vertices; a vertex whose ring leaves its block
// waits for the next pass, whose blocks are shifted by half their size. Blocks do not depend on the
// number of threads.
//
// In the spread order a pass takes any vertex none of whose neighbours has gone in it: only the
// stars of those that go are measured.
template <class Surface, class Stop>
class Batched_collapses
{
public:
  // All of these must outlive this.
  Batched_collapses(Surface& surface, const Flat_collapse_options& options, Stop& stop)
    : m_surface(surface), m_options(options), m_stop(stop), m_progress(options.progress)
  {}

  // Appends the collapses and the ends of the passes.
  Decimation_end run(Progressive_mesh& pm);

private:
  typedef Collapse_worker<Surface> Worker;
  static constexpr float no_cost = Surface::no_cost;

  // Smaller ones spoil the levels: with an eighth, solvers need up to half as many iterations more.
  static constexpr std::size_t block_size = 16384;
  static constexpr std::size_t blocks_between_reports = 32;

  // A stretch of the living vertices [begin, end) and of all vertex indices [low, high).
  struct Block
  {
    std::size_t begin, end;
    Vertex_index low, high;
    std::size_t wanted; // collapses at most
    typename Worker::Collapses collapses;
  };

  void evaluate_stale(const Progressive_mesh& pm);
  float pass_threshold(std::size_t wanted) const;
  std::vector<Block> cut_into_blocks(std::size_t wanted, bool is_shifted) const;
  void run_block(float threshold, Block& block);
  bool is_candidate(Vertex_index v, float threshold) const
  {
    return is_spread() ? !m_surface.state[v].is_stale : m_surface.best_cost[v] <= threshold;
  }
  bool is_spread() const { return m_options.order == Collapse_order::SPREAD; }
  void run_pass(float threshold, std::size_t wanted, Progressive_mesh& pm);
  void remove_dead();

  Surface& m_surface;
  const Flat_collapse_options& m_options;
  Stop& m_stop;
  Collapse_progress m_progress;
  std::vector<Vertex_index> m_alive; // ascending
};

// Brings all costs up to date. Costs fall, too, where long thin triangles give way to better ones:
// vertices that would be passed over would spoil the levels.
template <class Surface, class Stop>
void Batched_collapses<Surface, Stop>::evaluate_stale(const Progressive_mesh& pm)
{
  constexpr std::size_t size = block_size / 8, stretch = block_size * blocks_between_reports;
  for(std::size_t first = 0; first < m_alive.size() && m_progress(pm); first += stretch) {
    const std::size_t count = (std::min)(stretch, m_alive.size() - first);
    Blocked_execution::blocked_for(count, size, [&](std::size_t begin, std::size_t end) {
      Worker worker(m_surface);
      for(std::size_t i = first + begin; i < first + end; ++i) {
        m_surface.prefetch(m_alive, i, first + end);
        if(m_surface.state[m_alive[i]].is_stale)
          worker.evaluate(m_alive[i], false);
      }
    });
  }
}

// The cost that the cheapest part of the vertices, but not many more than `wanted`, have.
template <class Surface, class Stop>
float Batched_collapses<Surface, Stop>::pass_threshold(std::size_t wanted) const
{
  return nth_cost(m_alive, m_surface.best_cost, [&](std::size_t number_of_costs) {
    // About three in five of those below the threshold are collapsed: the others become dearer.
    const double part = (std::min)(m_options.pass_fraction * double(number_of_costs),
                                   1.6 * double(wanted));
    return (std::min)(number_of_costs - 1, std::size_t(part));
  });
}

// One block if there are few vertices; blocks of equal numbers of living vertices otherwise.
template <class Surface, class Stop>
std::vector<typename Batched_collapses<Surface, Stop>::Block>
Batched_collapses<Surface, Stop>::cut_into_blocks(std::size_t wanted, bool is_shifted) const
{
  const Vertex_index end = Vertex_index(m_surface.number_of_vertices());
  const std::size_t n = m_alive.size();
  std::vector<Block> blocks;
  if(n < 4 * block_size)
    blocks.push_back({0, n, 0, end, wanted, {}});
  else
    for(std::size_t first = 0; first < n;) {
      const std::size_t size = (first == 0 && is_shifted) ? block_size / 2 : block_size;
      const std::size_t last = (std::min)(first + size, n);
      const std::size_t share = wanted * last / n - wanted * first / n;
      blocks.push_back({first, last, m_alive[first], last == n ? end : m_alive[last], share, {}});
      first = last;
    }
  return blocks;
}

// Vertices whose cost was not above the threshold when the pass began are removed if the same
// collapse still costs no more. The others wait for the next pass, where all their targets are
// compared again.
template <class Surface, class Stop>
void Batched_collapses<Surface, Stop>::run_block(float threshold, Block& block)
{
  Worker worker(m_surface, block.low, block.high);
  for(std::size_t i = block.begin; i < block.end && block.collapses.size() < block.wanted; ++i) {
    const Vertex_index v = m_alive[i];
    m_surface.prefetch(m_alive, i, block.end);
    if(!is_candidate(v, threshold))
      continue;
    const Vertex_index* r = m_surface.rings.ring(v);
    if(!std::all_of(r, r + m_surface.rings.degree(v), [&block](Vertex_index w) {
         return block.low <= w && w < block.high;
       }))
      continue;
    if(is_spread())
      worker.collapse_into_best(v, block.collapses);
    else
      worker.try_collapse(v, threshold, block.collapses);
  }
}

template <class Surface, class Stop>
void Batched_collapses<Surface, Stop>::run_pass(float threshold, std::size_t wanted,
                                          Progressive_mesh& pm)
{
  std::vector<Block> blocks = cut_into_blocks(wanted, pm.batch_ends.size() % 2 == 1);
  const std::size_t before = pm.collapses.size();
  m_surface.begin_pass();
  for(std::size_t first = 0; first < blocks.size() && m_progress(pm);
      first += blocks_between_reports) {
    const std::size_t last = (std::min)(first + blocks_between_reports, blocks.size());
    Blocked_execution::blocked_for(last - first, 1, [&](std::size_t begin, std::size_t) {
      run_block(threshold, blocks[first + begin]);
    });
    for(std::size_t b = first; b < last; ++b)
      pm.collapses.insert(pm.collapses.end(), blocks[b].collapses.begin(),
                          blocks[b].collapses.end());
  }
  if(pm.collapses.size() > before)
    pm.batch_ends.push_back(pm.collapses.size());
}

// Takes out the vertices that are gone.
template <class Surface, class Stop>
void Batched_collapses<Surface, Stop>::remove_dead()
{
  const std::vector<std::uint32_t> places = Blocked_execution::select(
    m_alive.size(), [&](std::uint32_t i) { return m_surface.state[m_alive[i]].is_gone == 0; });
  for(std::size_t i = 0; i < places.size(); ++i)
    m_alive[i] = m_alive[places[i]];
  m_alive.resize(places.size());
}

template <class Surface, class Stop>
Decimation_end Batched_collapses<Surface, Stop>::run(Progressive_mesh& pm)
{
  const std::size_t n = m_surface.number_of_vertices();
  if constexpr(!Stop::asks_for_costs) {
    pm.collapses.reserve(m_stop.left(pm));
    m_progress.expect(m_stop.left(pm));
  }
  m_alive.resize(n);
  for(Vertex_index v = 0; v < n; ++v)
    m_alive[v] = v;
  bool is_exhausted = false;
  int empty_passes = 0;
  while(!is_exhausted && !m_stop.is_over(pm) && !m_progress.is_cancelled()) {
    if(is_spread())
      for(const Vertex_index v : m_alive)
        m_surface.state[v].is_stale = 0;
    else
      evaluate_stale(pm);
    const std::size_t wanted = m_stop.wanted(m_surface, m_alive, pm);
    if(wanted == 0)
      break;
    if constexpr(Stop::asks_for_costs)
      m_progress.expect(pm.collapses.size() + wanted);
    const float threshold = is_spread() ? 0.f : pass_threshold(wanted);
    if(threshold == no_cost) {
      is_exhausted = true;
      break;
    }
    const std::size_t before = m_alive.size();
    run_pass(is_spread() ? 0.f : m_stop.limit(m_surface, m_alive, threshold), wanted, pm);
    remove_dead();
    const std::size_t done = before - m_alive.size();
    empty_passes = done == 0 ? empty_passes + 1 : 0;
    // What is left cannot be removed; a pass with few candidates may have found no way for these
    is_exhausted = m_stop.is_limited() ? empty_passes == 4
                                       : 2 * done < wanted && 500 * done < before;
  }
  const bool is_cancelled = m_progress.is_cancelled();
  return {is_exhausted && !is_cancelled && !m_stop.is_over(pm), is_cancelled};
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_BATCHED_COLLAPSES_H
