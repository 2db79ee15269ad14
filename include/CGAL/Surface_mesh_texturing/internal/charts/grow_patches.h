// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROW_PATCHES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROW_PATCHES_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Cuts a surface into small patches between its features. A patch grows triangle by triangle, each
// across one edge; edges with the same patch on both sides are opened only where this closes a
// vertex (`Seam_graph::zip()`), so that a patch is a disk at any time.
class Patch_growth
{
  static constexpr double least_step = 1e-6; // the mean length of an edge is 1
  typedef std::vector<std::uint32_t> Seeds;

public:
  Patch_growth(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature)
    : m_surface(surface), m_step(3 * surface.size(), 0.)
  {
    double all = 0.;
    for(const double x : surface.length)
      all += x;
    for(std::uint32_t h = 0; h < m_step.size(); ++h) {
      const std::uint32_t g = surface.adjacency.opposite(h);
      if(g == no_halfedge)
        continue;
      const double length
        = std::sqrt(squared_distance(surface.centre[triangle_of(h)], surface.centre[triangle_of(g)]));
      m_step[h] = length * (1. + surface.angle[h]) + (is_feature[h] ? all : 0.) + least_step;
    }
  }

  // About `number` patches, at least `least` in each component that has enough triangles.
  void grow(std::size_t number, std::size_t least);

  // Cuts each of the given patches, if it has at least two triangles, by a seed in its part that is
  // farthest from its own; returns whether there was one.
  bool refine(const std::vector<std::uint32_t>& patches);

  const std::vector<std::uint32_t>& patch() const { return m_patch; } // of each triangle
  std::size_t number_of_patches() const { return m_seeds.size(); }

  // The seams that keep the patches apart, and make disks of them.
  Seam_graph seams() const;

private:
  // A triangle that waits for its patch: its distance, and the halfedge that leads into it.
  typedef std::tuple<double, std::uint32_t, std::uint32_t> Waiting;
  typedef std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> Queue;

  void spread(Queue& queue);

  // Whether the triangle that was reached through this halfedge is not in the patch that the one
  // before has come to: that is nearer to its seed now, but by so little that the sum is the same.
  bool is_left_behind(std::uint32_t h, std::uint32_t patch) const
  {
    const std::uint32_t t = triangle_of(h);
    return m_entry[t] == h && m_distance[t] > 0. && m_patch[t] != patch;
  }

  void add_seed(std::uint32_t t);
  void add_far_seeds(std::size_t number, std::size_t least);
  bool move_seeds_inward();

  const Growth_surface& m_surface;
  std::vector<double> m_step; // between the centres of the triangles of each halfedge
  Seeds m_seeds;
  std::vector<std::uint32_t> m_patch, m_entry; // m_entry: the halfedge that led to each triangle
  std::vector<double> m_distance;
};

// Takes what waits to its patch and goes on from there.
inline void Patch_growth::spread(Queue& queue)
{
  while(!queue.empty()) {
    const auto [distance, h, patch] = queue.top();
    queue.pop();
    const std::uint32_t t = triangle_of(h);
    if(m_patch[t] != patch || m_distance[t] != distance || m_entry[t] != h)
      continue;
    for(std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
      const std::uint32_t across = m_surface.adjacency.opposite(g);
      if(across == no_halfedge || !(distance + m_step[g] < m_distance[triangle_of(across)]
                                    || is_left_behind(across, patch)))
        continue;
      m_distance[triangle_of(across)] = distance + m_step[g];
      m_patch[triangle_of(across)] = patch;
      m_entry[triangle_of(across)] = across;
      queue.push({m_distance[triangle_of(across)], across, patch});
    }
  }
}

inline void Patch_growth::add_seed(std::uint32_t t)
{
  Queue queue;
  m_distance[t] = 0.;
  m_patch[t] = std::uint32_t(m_seeds.size());
  m_entry[t] = 3 * t;
  m_seeds.push_back(t);
  queue.push({0., 3 * t, m_patch[t]});
  spread(queue);
}

// The next seed is the triangle that is farthest from all seeds: one between any features first,
// because their edges count as very long. Components that miss seeds come first. A seed changes
// distances in its own component only.
inline void Patch_growth::add_far_seeds(std::size_t number, std::size_t least)
{
  std::vector<std::size_t> missing(m_surface.number_of_components, least);
  for(const std::uint32_t t : m_seeds)
    missing[m_surface.component[t]] -= missing[m_surface.component[t]] > 0 ? 1 : 0;
  std::vector<Seeds> triangles(m_surface.number_of_components);
  for(std::uint32_t t = 0; t < m_surface.size(); ++t)
    triangles[m_surface.component[t]].push_back(t);
  // Whether seeds are missing, the distance, the component from the last, the triangle
  typedef std::tuple<bool, double, std::uint32_t, std::uint32_t> Offer;
  std::priority_queue<Offer> offers;
  const auto look_at = [&](std::uint32_t c) {
    std::uint32_t farthest = triangles[c].front();
    for(const std::uint32_t t : triangles[c])
      if(m_distance[t] > m_distance[farthest])
        farthest = t;
    if(m_distance[farthest] > 0.)
      offers.push({missing[c] > 0, m_distance[farthest], ~c, farthest});
  };
  for(std::uint32_t c = 0; c < triangles.size(); ++c)
    look_at(c);
  while(!offers.empty()) {
    const auto [is_missing, distance, not_c, t] = offers.top();
    if(!is_missing && m_seeds.size() >= number)
      return;
    offers.pop();
    missing[~not_c] -= is_missing ? 1 : 0;
    add_seed(t);
    look_at(~not_c);
  }
}

// Moves each seed to the triangle of its patch that is farthest from the patch's border; returns
// whether any moved.
inline bool Patch_growth::move_seeds_inward()
{
  std::vector<double> depth(m_surface.size(), (std::numeric_limits<double>::max)());
  typedef std::pair<double, std::uint32_t> Item;
  std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
  for(std::uint32_t h = 0; h < m_step.size(); ++h) {
    const std::uint32_t g = m_surface.adjacency.opposite(h), t = triangle_of(h);
    if((g == no_halfedge || m_patch[triangle_of(g)] != m_patch[t]) && depth[t] > 0.)
      queue.push({depth[t] = 0., t});
  }
  while(!queue.empty()) {
    const auto [d, t] = queue.top();
    queue.pop();
    if(d != depth[t])
      continue;
    for(std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t g = m_surface.adjacency.opposite(h);
      if(g != no_halfedge && d + m_step[h] < depth[triangle_of(g)])
        queue.push({depth[triangle_of(g)] = d + m_step[h], triangle_of(g)});
    }
  }
  const Seeds old = m_seeds;
  for(std::uint32_t t = 0; t < m_surface.size(); ++t)
    if(depth[t] > depth[m_seeds[m_patch[t]]]
       && depth[t] < (std::numeric_limits<double>::max)())
      m_seeds[m_patch[t]] = t;
  return m_seeds != old;
}

inline void Patch_growth::grow(std::size_t number, std::size_t least)
{
  constexpr int rounds = 3; // of the seeds' move to the middle, in the manner of Lloyd
  const auto reset = [this] {
    m_distance.assign(m_surface.size(), (std::numeric_limits<double>::max)());
    m_patch.assign(m_surface.size(), std::uint32_t(-1));
    m_entry.assign(m_surface.size(), no_halfedge);
  };
  reset();
  m_seeds.clear();
  add_far_seeds(number, (std::max)(least, std::size_t(1)));
  for(int round = 0; round < rounds && move_seeds_inward(); ++round) {
    reset();
    Seeds seeds;
    seeds.swap(m_seeds);
    for(const std::uint32_t t : seeds)
      add_seed(t);
  }
}

inline bool Patch_growth::refine(const std::vector<std::uint32_t>& patches)
{
  std::vector<std::uint32_t> farthest = m_seeds;
  for(std::uint32_t t = 0; t < m_surface.size(); ++t)
    if(m_distance[t] > m_distance[farthest[m_patch[t]]])
      farthest[m_patch[t]] = t;
  const std::size_t before = m_seeds.size();
  for(const std::uint32_t p : patches)
    if(m_distance[farthest[p]] > 0.) // not a seed, which it may have become
      add_seed(farthest[p]);
  return m_seeds.size() > before;
}

inline Seam_graph Patch_growth::seams() const
{
  constexpr std::uint8_t all_three = 7; // edges, which are all seams to begin with
  Seam_graph graph(m_surface.adjacency, std::vector<std::uint8_t>(m_surface.size(), all_three));
  std::vector<std::uint32_t> order(m_surface.size()), zipped;
  for(std::uint32_t t = 0; t < order.size(); ++t)
    order[t] = t;
  std::stable_sort(order.begin(), order.end(), [this](std::uint32_t s, std::uint32_t t) {
    return m_distance[s] < m_distance[t];
  });
  for(const std::uint32_t t : order)
    if(m_distance[t] > 0.)
      graph.remove_seam(m_entry[t]);
  for(std::uint32_t v = 0; v < m_surface.mesh.points.size(); ++v)
    graph.zip(v, zipped);
  return graph;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROW_PATCHES_H
