// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/internal/select.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Texture_layer.h>
#include <CGAL/Surface_mesh_multiresolution/internal/nth_cost.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The order in which the flat engine takes the collapses.
enum class Collapse_order
{
  BATCHED, ///< passes over the cheapest part in memory order: as good for a hierarchy, faster
  STRICT   ///< always the cheapest collapse of all (Ray and Lévy 2003, algorithm 2)
};

/// \ingroup PkgHLSCMMultiresolution
/// The options of `Flat_collapse_engine`.
struct Flat_collapse_options
{
  std::size_t target_vertices = 2000; ///< where to stop
  Collapse_order order = Collapse_order::BATCHED; ///< which collapse comes next
  /// The part of the vertices, the cheapest, that a pass of the batched order may remove.
  double pass_fraction = 0.7;
  /// Told the part done in [0, 1] from time to time; returning false stops early.
  std::function<bool(double)> progress;
};

/*!
\ingroup PkgHLSCMMultiresolution

The class `Flat_collapse_engine` decimates an `Indexed_triangle_mesh` by halfedge collapses and
records them as a `Progressive_mesh`. It runs the same cost and filter policies as CGAL's
`edge_collapse()`, on flat 32-bit arrays.

A vertex is removed only if topology allows it: the mesh stays a manifold with the same Euler
characteristic and the same border components. A border vertex leaves only along the border; locked
vertices and vertices of more than 14 neighbours never leave; a vertex that has at most 14
neighbours never gets more. The result depends on the input alone,
not on the number of threads (`Blocked_execution::Thread_scope`).

\tparam Cost a model of `GetCost`; called by several threads at the same time for vertices that have
        no neighbour in common
\tparam Filter a model of `PlacementFilter`; the same holds
\tparam Texture what the engine knows of a texture; see `build_textured_progressive_mesh()`

Expected linear time in the number of vertices (batched), O(n log n) (strict); 85 bytes a vertex.
*/
template <class Cost = Hierarchy_collapse_cost<>, class Filter = Hierarchy_collapse_filter,
          class Texture = internal::No_texture_layer>
class Flat_collapse_engine
{
public:
  /// Constructs the engine on a mesh whose vertices should be in spatial order and whose mean edge
  /// length should be near 1 (`sort_spatially()`, `normalize()`). The mesh must live as long as
  /// the engine.
  ///
  /// \param is_locked for each vertex whether it must stay; empty for none
  Flat_collapse_engine(const Indexed_triangle_mesh& mesh, internal::Vertex_rings rings,
                       const std::vector<bool>& is_locked,
                       const Cost& cost = hierarchy_collapse_cost(),
                       const Filter& filter = hierarchy_collapse_filter(),
                       const Texture& texture = Texture());

  /// Collapses until the target is reached or nothing more can be collapsed.
  Progressive_mesh run(const Flat_collapse_options& options);

  /// Returns the number of costs computed so far, one a vertex and its ring.
  std::size_t number_of_evaluations() const { return m_evaluations; }

  /// Returns what has become of the texture.
  const Texture& texture() const { return m_texture; }

private:
  typedef Surface_mesh_simplification::internal::Vertex_star Vertex_star;
  typedef Flat_collapse_profile::Placement Placement;
  typedef std::vector<Halfedge_collapse> Collapses;

  static constexpr float no_cost = (std::numeric_limits<float>::infinity)();

  // Passes go over blocks of this many living vertices; a vertex whose ring leaves its block waits
  // for the next pass, whose blocks are shifted by half their size. Blocks do not depend on the
  // number of threads. Smaller ones spoil the levels: with an eighth, solvers need up to half as
  // many iterations more.
  static constexpr std::size_t block_size = 16384;
  static constexpr std::size_t blocks_between_reports = 32;

  // How many vertices ahead of their use data are asked for: about the latency of the memory.
  static constexpr std::size_t prefetch_distance = 4;

  struct State // of a vertex
  {
    std::uint8_t is_gone : 1, is_locked : 1, is_stale : 1;
  };

  struct Target // of a collapse; any vertex if the cost is `no_cost`
  {
    Vertex_index vertex;
    float cost;
  };

  // What one thread needs to look at collapses.
  struct Worker
  {
    explicit Worker(const Flat_surface& surface) : profile(surface) {}

    // The vertices that it alone may remove for now
    Vertex_index low = 0, high = no_vertex;
    Flat_collapse_profile profile;
    Vertex_star star;
    std::size_t evaluations = 0;
  };

  // A stretch of the living vertices [begin, end) and of all vertex indices [low, high).
  struct Block
  {
    std::size_t begin, end;
    Vertex_index low, high;
    std::size_t wanted; // collapses at most
    Collapses collapses;
  };

  // Asks the user's function whether to go on.
  class Progress
  {
  public:
    Progress(const Flat_collapse_options& options, std::size_t n)
      : m_function(options.progress)
      , m_whole(n > options.target_vertices ? double(n - options.target_vertices) : 1.)
    {}

    bool operator()(const Progressive_mesh& pm)
    {
      if(m_function && !m_is_cancelled)
        m_is_cancelled = !m_function((std::min)(1., double(pm.collapses.size()) / m_whole));
      return !m_is_cancelled;
    }

    bool is_cancelled() const { return m_is_cancelled; }

  private:
    const std::function<bool(double)>& m_function;
    double m_whole;
    bool m_is_cancelled = false;
  };

  Flat_surface surface() const { return Flat_surface(m_mesh, m_rings); }
  // Whether topology and the size of a ring allow the collapse of v into its ring vertex k.
  bool is_possible(const Worker& worker, Vertex_index v, std::uint32_t k) const
  {
    if(!m_rings.is_collapse_valid(v, k) || m_rings.needs_new_spill(v, k))
      return false;
    if constexpr(Texture::is_textured)
      return m_texture.is_possible(v, k, worker.low, worker.high);
    (void)worker;
    return true;
  }
  void begin_pass()
  {
    if constexpr(Texture::is_textured)
      m_texture.begin_pass();
  }
  // Where w is in the ring of v: the degree of v if it is not.
  std::uint32_t position(Vertex_index v, Vertex_index w) const
  {
    const Vertex_index* r = m_rings.ring(v);
    return std::uint32_t(std::find(r, r + m_rings.degree(v), w) - r);
  }
  void prefetch(const std::vector<Vertex_index>& alive, std::size_t i, std::size_t end) const;
  bool load_star(Worker& worker, Vertex_index v) const;
  void set_profile(Worker& worker, Vertex_index v, std::uint32_t k) const;
  float cost_of(const Flat_collapse_profile& profile) const;
  float cost_of(Worker& worker, Vertex_index v, std::uint32_t k) const;
  Target best_target(Worker& worker, Vertex_index v, bool check_topology) const;
  void evaluate(Worker& worker, Vertex_index v, bool check_topology);
  bool try_collapse(Worker& worker, Vertex_index v, float limit, Collapses& collapses);
  float pass_threshold(const std::vector<Vertex_index>& alive, std::size_t wanted,
                       double fraction) const;
  void evaluate_stale(const std::vector<Vertex_index>& alive, Progress& progress,
                      const Progressive_mesh& pm);
  std::vector<Block> cut_into_blocks(const std::vector<Vertex_index>& alive, std::size_t wanted,
                                     bool is_shifted) const;
  void run_block(const std::vector<Vertex_index>& alive, float threshold, Block& block);
  void run_pass(const std::vector<Vertex_index>& alive, float threshold, std::size_t wanted,
                Progress& progress, Progressive_mesh& pm);
  void remove_dead(std::vector<Vertex_index>& alive) const;
  void run_batched(const Flat_collapse_options& options, Progressive_mesh& pm);
  void run_strict(const Flat_collapse_options& options, Progressive_mesh& pm);

  const Indexed_triangle_mesh& m_mesh;
  internal::Vertex_rings m_rings;
  Cost m_cost;
  Filter m_filter;
  Texture m_texture;
  std::vector<float> m_best_cost;
  std::vector<Vertex_index> m_best_target;
  std::vector<State> m_state;
  std::atomic<std::size_t> m_evaluations{0};
};

template <class Cost, class Filter, class Texture>
Flat_collapse_engine<Cost, Filter, Texture>::
Flat_collapse_engine(const Indexed_triangle_mesh& mesh, internal::Vertex_rings rings,
                     const std::vector<bool>& is_locked, const Cost& cost, const Filter& filter,
                     const Texture& texture)
  : m_mesh(mesh), m_rings(std::move(rings)), m_cost(cost), m_filter(filter), m_texture(texture)
  , m_best_cost(mesh.points.size(), no_cost)
  , m_best_target(mesh.points.size(), no_vertex)
  , m_state(mesh.points.size())
{
  for(std::size_t v = 0; v < mesh.points.size(); ++v)
    m_state[v] = {0, std::uint8_t(!is_locked.empty() && is_locked[v]), 1};
  if constexpr(Texture::is_textured) {
    m_texture.set_rings(m_rings);
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      m_state[v].is_locked |= std::uint8_t(m_texture.is_fixed(v));
  }
  if constexpr(Surface_mesh_simplification::internal::Needs_update<Cost>::value) {
    const Flat_collapse_profile profile(surface());
    m_cost.initialize(profile.surface_mesh(), profile.vertex_point_map(), profile.geom_traits());
  }
}

template <class Cost, class Filter, class Texture>
bool Flat_collapse_engine<Cost, Filter, Texture>::load_star(Worker& worker, Vertex_index v) const
{
  const std::uint32_t d = m_rings.degree(v);
  if(m_state[v].is_locked || d > std::uint32_t(Vertex_star::max_degree))
    return false;
  const Vertex_index* r = m_rings.ring(v);
  const auto& p = m_mesh.points[v];
  Vertex_star& star = worker.star;
  star.reset(int(d), m_rings.is_border(v));
  for(std::uint32_t i = 0; i < d; ++i) {
    const auto& q = m_mesh.points[r[i]];
    star.set_ring_point(int(i), float(q.x() - p.x()), float(q.y() - p.y()), float(q.z() - p.z()));
  }
  star.prepare();
  auto& collapse = worker.profile.collapse();
  collapse.is_valid = true;
  collapse.is_border = m_rings.is_border(v);
  collapse.removed_degree = int(d);
  collapse.angle_sum = star.angle_sum();
  collapse.min_squared_quality = star.min_squared_quality();
  return true;
}

// Lets the profile describe the collapse of v, whose star is loaded, into its ring vertex k.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::set_profile(Worker& worker, Vertex_index v,
                                                     std::uint32_t k) const
{
  Flat_collapse_profile& profile = worker.profile;
  profile.set(v, k);
  auto& collapse = profile.collapse();
  collapse.kept_degree = m_rings.small_degree(profile.v1());
  collapse.measure = worker.star.measure(int(k));
}

// The cost of the collapse that the profile describes, or `no_cost` if the policies forbid it.
// Declared inline because it is what the loop over the targets does.
template <class Cost, class Filter, class Texture>
inline float Flat_collapse_engine<Cost, Filter, Texture>::
cost_of(const Flat_collapse_profile& profile) const
{
  if(!m_filter(profile, profile.placement()))
    return no_cost;
  const auto cost = m_cost(profile, profile.placement());
  return cost && float(*cost) < no_cost ? float(*cost) : no_cost; // not a number: no cost
}

// The cost of collapsing v, whose star is loaded, into its ring vertex k.
template <class Cost, class Filter, class Texture>
inline float Flat_collapse_engine<Cost, Filter, Texture>::cost_of(Worker& worker, Vertex_index v,
                                                                  std::uint32_t k) const
{
  if constexpr(Texture::is_textured)
    if(!m_texture.is_target(v, m_rings.ring(v)[k]))
      return no_cost;
  set_profile(worker, v, k);
  float cost = cost_of(worker.profile);
  if constexpr(Texture::is_textured)
    if(cost < no_cost)
      cost += m_texture.cost(v, k);
  return cost;
}

// Asks for what the vertices between alive[i] and alive[end] will need: their lines first and, when
// these are there, the points of their rings and the lines that a collapse changes. Beyond `end`
// another thread may be changing the rings.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::prefetch(const std::vector<Vertex_index>& alive,
                                                  std::size_t i, std::size_t end) const
{
  if(i + 2 * prefetch_distance >= end)
    return;
  const Vertex_index next = alive[i + prefetch_distance];
  const Vertex_index later = alive[i + 2 * prefetch_distance];
  m_rings.prefetch(later);
  internal::prefetch(&m_best_cost[later]);
  internal::prefetch(&m_mesh.points[later]);
  const std::uint32_t d = m_rings.degree(next);
  if(d > std::uint32_t(Vertex_star::max_degree)) // it stays
    return;
  const Vertex_index* r = m_rings.ring(next);
  for(std::uint32_t k = 0; k < d; ++k) {
    const char* point = reinterpret_cast<const char*>(&m_mesh.points[r[k]]);
    internal::prefetch(point);
    internal::prefetch(point + sizeof(m_mesh.points[0]) - 1); // in the same line or the next
    m_rings.prefetch(r[k]);
  }
}

// The cheapest target of v that the policies, and if asked topology, allow; the smaller vertex
// index on a tie. Precondition: the star of v is loaded.
template <class Cost, class Filter, class Texture>
typename Flat_collapse_engine<Cost, Filter, Texture>::Target
Flat_collapse_engine<Cost, Filter, Texture>::best_target(Worker& worker, Vertex_index v,
                                                bool check_topology) const
{
  const Vertex_index* r = m_rings.ring(v);
  const std::uint32_t d = m_rings.degree(v);
  const std::uint32_t step = m_rings.is_border(v) ? d - 1 : 1; // the two ends only
  float costs[Vertex_star::max_degree];
  std::fill_n(costs, d, no_cost);
  for(std::uint32_t k = 0; k < d; k += step) {
    costs[k] = cost_of(worker, v, k);
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
    if(is_possible(worker, v, k))
      return best;
    costs[k] = no_cost;
  }
}

// Notes the best target of v.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::evaluate(Worker& worker, Vertex_index v,
                                                  bool check_topology)
{
  m_state[v].is_stale = 0;
  m_best_cost[v] = no_cost;
  ++worker.evaluations;
  if(!load_star(worker, v))
    return;
  const Target target = best_target(worker, v, check_topology);
  m_best_cost[v] = target.cost;
  m_best_target[v] = target.vertex;
}

// Collapses v into its best target if that still costs at most `limit`. If topology forbids it, v
// gets the best target that it allows, and stays for now.
template <class Cost, class Filter, class Texture>
bool Flat_collapse_engine<Cost, Filter, Texture>::
try_collapse(Worker& worker, Vertex_index v, float limit, Collapses& collapses)
{
  const Vertex_index* r = m_rings.ring(v);
  const std::uint32_t d = m_rings.degree(v);
  const std::uint32_t k = position(v, m_best_target[v]);
  if(k == d || !load_star(worker, v))
    return false;
  if(!(cost_of(worker, v, k) <= limit))
    return false;
  if(!is_possible(worker, v, k)) {
    evaluate(worker, v, true);
    return false;
  }
  if constexpr(Surface_mesh_simplification::internal::Needs_update<Cost>::value)
    m_cost.update_before_collapse(worker.profile, worker.profile.placement());
  collapses.push_back({v, r[k]});
  if constexpr(Texture::is_textured)
    m_texture.collapse(v, k);
  m_rings.collapse(v, k);
  m_state[v].is_gone = 1;
  for(std::uint32_t i = 0; i < d; ++i)
    m_state[r[i]].is_stale = 1;
  return true;
}

// The cost that the cheapest `fraction` of the vertices, but not many more than `wanted`, have.
template <class Cost, class Filter, class Texture>
float Flat_collapse_engine<Cost, Filter, Texture>::
pass_threshold(const std::vector<Vertex_index>& alive, std::size_t wanted, double fraction) const
{
  return internal::nth_cost(alive, m_best_cost, [&](std::size_t number_of_costs) {
    // About three in five of those below the threshold are collapsed: the others become dearer.
    const double part = (std::min)(fraction * double(number_of_costs), 1.6 * double(wanted));
    return (std::min)(number_of_costs - 1, std::size_t(part));
  });
}

// Brings all costs up to date. Costs fall, too, where long thin triangles give way to better ones:
// vertices that would be passed over would spoil the levels.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::
evaluate_stale(const std::vector<Vertex_index>& alive, Progress& progress,
               const Progressive_mesh& pm)
{
  constexpr std::size_t size = block_size / 8, stretch = block_size * blocks_between_reports;
  for(std::size_t first = 0; first < alive.size() && progress(pm); first += stretch) {
    const std::size_t count = (std::min)(stretch, alive.size() - first);
    Blocked_execution::blocked_for(count, size, [&](std::size_t begin, std::size_t end) {
      Worker worker(surface());
      for(std::size_t i = first + begin; i < first + end; ++i) {
        prefetch(alive, i, first + end);
        if(m_state[alive[i]].is_stale)
          evaluate(worker, alive[i], false);
      }
      m_evaluations += worker.evaluations;
    });
  }
}

// One block if there are few vertices; blocks of equal numbers of living vertices otherwise.
template <class Cost, class Filter, class Texture>
std::vector<typename Flat_collapse_engine<Cost, Filter, Texture>::Block>
Flat_collapse_engine<Cost, Filter, Texture>::
cut_into_blocks(const std::vector<Vertex_index>& alive, std::size_t wanted, bool is_shifted) const
{
  const Vertex_index end = Vertex_index(m_mesh.points.size());
  std::vector<Block> blocks;
  if(alive.size() < 4 * block_size)
    blocks.push_back({0, alive.size(), 0, end, wanted, {}});
  else
    for(std::size_t first = 0; first < alive.size();) {
      const std::size_t size = (first == 0 && is_shifted) ? block_size / 2 : block_size;
      const std::size_t last = (std::min)(first + size, alive.size());
      const std::size_t share = wanted * last / alive.size() - wanted * first / alive.size();
      blocks.push_back({first, last, alive[first], last == alive.size() ? end : alive[last],
                        share, {}});
      first = last;
    }
  return blocks;
}

// Vertices whose cost was not above the threshold when the pass began are removed if the same
// collapse still costs no more. The others wait for the next pass, where all their targets are
// compared again.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::run_block(const std::vector<Vertex_index>& alive,
                                                   float threshold, Block& block)
{
  Worker worker(surface());
  worker.low = block.low;
  worker.high = block.high;
  for(std::size_t i = block.begin; i < block.end && block.collapses.size() < block.wanted; ++i) {
    const Vertex_index v = alive[i];
    prefetch(alive, i, block.end);
    if(!(m_best_cost[v] <= threshold))
      continue;
    const Vertex_index* r = m_rings.ring(v);
    if(std::all_of(r, r + m_rings.degree(v), [&block](Vertex_index w) {
         return block.low <= w && w < block.high;
       }))
      try_collapse(worker, v, threshold, block.collapses);
  }
  m_evaluations += worker.evaluations;
}

template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::
run_pass(const std::vector<Vertex_index>& alive, float threshold, std::size_t wanted,
         Progress& progress, Progressive_mesh& pm)
{
  std::vector<Block> blocks = cut_into_blocks(alive, wanted, pm.batch_ends.size() % 2 == 1);
  const std::size_t before = pm.collapses.size();
  begin_pass();
  for(std::size_t first = 0; first < blocks.size() && progress(pm);
      first += blocks_between_reports) {
    const std::size_t last = (std::min)(first + blocks_between_reports, blocks.size());
    Blocked_execution::blocked_for(last - first, 1, [&](std::size_t begin, std::size_t) {
      run_block(alive, threshold, blocks[first + begin]);
    });
    for(std::size_t b = first; b < last; ++b)
      pm.collapses.insert(pm.collapses.end(), blocks[b].collapses.begin(),
                          blocks[b].collapses.end());
  }
  if(pm.collapses.size() > before)
    pm.batch_ends.push_back(pm.collapses.size());
}

// Takes out the vertices that are gone.
template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::
remove_dead(std::vector<Vertex_index>& alive) const
{
  const std::vector<std::uint32_t> places = Blocked_execution::internal::select(
    alive.size(), [&](std::uint32_t i) { return m_state[alive[i]].is_gone == 0; });
  for(std::size_t i = 0; i < places.size(); ++i)
    alive[i] = alive[places[i]];
  alive.resize(places.size());
}

template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::
run_batched(const Flat_collapse_options& options, Progressive_mesh& pm)
{
  const std::size_t n = m_mesh.points.size();
  Progress progress(options, n);
  pm.collapses.reserve(n > options.target_vertices ? n - options.target_vertices : 0);
  std::vector<Vertex_index> alive(n);
  for(Vertex_index v = 0; v < n; ++v)
    alive[v] = v;
  while(alive.size() > options.target_vertices && !progress.is_cancelled()) {
    evaluate_stale(alive, progress, pm);
    const std::size_t wanted = alive.size() - options.target_vertices;
    const float threshold = pass_threshold(alive, wanted, options.pass_fraction);
    if(threshold == no_cost)
      break;
    const std::size_t before = alive.size();
    run_pass(alive, threshold, wanted, progress, pm);
    remove_dead(alive);
    const std::size_t done = before - alive.size();
    if(2 * done < wanted && 500 * done < before) // what is left cannot be removed
      break;
  }
}

template <class Cost, class Filter, class Texture>
void Flat_collapse_engine<Cost, Filter, Texture>::
run_strict(const Flat_collapse_options& options, Progressive_mesh& pm)
{
  typedef std::pair<float, Vertex_index> Entry; // smallest cost first, then smallest index
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  Worker worker(surface());
  std::size_t steps = 0;
  const std::size_t n = m_mesh.points.size();
  Progress progress(options, n);
  const auto goes_on = [&] { return ++steps % block_size != 0 || progress(pm); };
  const auto enqueue = [&](Vertex_index v) {
    evaluate(worker, v, true);
    if(m_best_cost[v] < no_cost)
      queue.push({m_best_cost[v], v});
  };
  for(Vertex_index v = 0; v < n && goes_on(); ++v)
    enqueue(v);
  std::size_t next_pass = n / 2; // vertices left
  while(!queue.empty() && n - pm.collapses.size() > options.target_vertices
        && !progress.is_cancelled() && goes_on()) {
    if(n - pm.collapses.size() <= next_pass) {
      begin_pass();
      next_pass /= 2;
    }
    const auto [cost, v] = queue.top();
    queue.pop();
    if(m_state[v].is_gone || cost != m_best_cost[v]) // an entry that a later one replaced
      continue;
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t d = m_rings.degree(v);
    if(!try_collapse(worker, v, cost, pm.collapses)) { // the degree of the target has changed, or
      enqueue(v);                                      // topology forbids it
      continue;
    }
    m_best_cost[v] = no_cost;
    for(std::uint32_t i = 0; i < d; ++i)
      enqueue(r[i]);
  }
  m_evaluations += worker.evaluations;
}

template <class Cost, class Filter, class Texture>
Progressive_mesh
Flat_collapse_engine<Cost, Filter, Texture>::run(const Flat_collapse_options& options)
{
  Progressive_mesh pm;
  pm.number_of_vertices = m_mesh.points.size();
  Blocked_execution::internal::resize_blocked(pm.triangles, m_mesh.triangles.size());
  Blocked_execution::blocked_for(pm.triangles.size(), block_size,
                                 [&](std::size_t begin, std::size_t end) {
    std::copy(m_mesh.triangles.begin() + begin, m_mesh.triangles.begin() + end,
              pm.triangles.begin() + begin);
  });
  if(options.order == Collapse_order::STRICT)
    run_strict(options, pm);
  else
    run_batched(options, pm);
  return pm;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_ENGINE_H
