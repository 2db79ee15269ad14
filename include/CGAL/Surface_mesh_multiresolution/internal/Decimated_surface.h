// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATED_SURFACE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATED_SURFACE_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_profile.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/prefetch.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/internal/Halfedge_collapse.h>

#include <atomic>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What the flat engine knows of the texture if there is none.
struct No_texture_layer
{
  static constexpr bool is_textured = false;
};

// A mesh that collapses change, with the policies of the collapses, and of each vertex the cheapest
// collapse, as far as it is known. Several threads use it at the same time, for vertices that have
// no neighbour in common.
template <class Cost_, class Filter_, class Texture_>
struct Decimated_surface
{
  typedef Cost_ Cost;
  typedef Texture_ Texture;
  typedef Surface_mesh_simplification::internal::Vertex_star Vertex_star;

  static constexpr float no_cost = (std::numeric_limits<float>::infinity)();
  static constexpr bool needs_update
    = Surface_mesh_simplification::internal::Needs_update<Cost>::value;

  struct State // of a vertex
  {
    std::uint8_t is_gone : 1, is_locked : 1, is_stale : 1;
  };

  // `is_locked`: for each vertex whether it must stay; empty for none
  Decimated_surface(const Indexed_triangle_mesh& mesh, Vertex_rings mesh_rings,
                    const std::vector<bool>& is_locked, const Cost_& cost, const Filter_& filter,
                    const Texture_& texture);

  std::size_t number_of_vertices() const { return mesh.points.size(); }
  Flat_surface view() const { return Flat_surface(mesh, rings); }

  // To be called before each pass, by one thread.
  void begin_pass()
  {
    if constexpr(Texture::is_textured)
      texture.begin_pass();
  }

  // Asks for what the vertices between alive[i] and alive[end] will need.
  void prefetch(const std::vector<Vertex_index>& alive, std::size_t i, std::size_t end) const;

  const Indexed_triangle_mesh& mesh;
  Vertex_rings rings;
  Cost_ cost;
  Filter_ filter;
  Texture_ texture;
  std::vector<float> best_cost;          // of each vertex; `no_cost` if it stays
  std::vector<Vertex_index> best_target; // any vertex if it stays
  std::vector<State> state;
  std::atomic<std::size_t> evaluations{0}; // of costs, one a vertex and its ring
};

template <class Cost, class Filter, class Texture>
Decimated_surface<Cost, Filter, Texture>::
Decimated_surface(const Indexed_triangle_mesh& m, Vertex_rings mesh_rings,
                  const std::vector<bool>& is_locked, const Cost& c, const Filter& f,
                  const Texture& t)
  : mesh(m), rings(std::move(mesh_rings)), cost(c), filter(f), texture(t)
  , best_cost(m.points.size(), no_cost)
  , best_target(m.points.size(), no_vertex)
  , state(m.points.size())
{
  for(std::size_t v = 0; v < state.size(); ++v)
    state[v] = {0, std::uint8_t(!is_locked.empty() && is_locked[v]), 1};
  if constexpr(Texture::is_textured) {
    texture.set_rings(rings);
    for(Vertex_index v = 0; v < state.size(); ++v)
      state[v].is_locked |= std::uint8_t(texture.is_fixed(v));
  }
  if constexpr(needs_update) {
    const Flat_collapse_profile profile(view());
    cost.initialize(profile.surface_mesh(), profile.vertex_point_map(), profile.geom_traits());
  }
}

// Their lines first and, when these are there, the points of their rings and the lines that a
// collapse changes. Beyond `end` another thread may be changing the rings.
template <class Cost, class Filter, class Texture>
void Decimated_surface<Cost, Filter, Texture>::prefetch(const std::vector<Vertex_index>& alive,
                                                        std::size_t i, std::size_t end) const
{
  constexpr std::size_t distance = 4; // vertices ahead of use: about the latency of the memory
  if(i + 2 * distance >= end)
    return;
  const Vertex_index next = alive[i + distance];
  const Vertex_index later = alive[i + 2 * distance];
  rings.prefetch(later);
  internal::prefetch(&best_cost[later]);
  internal::prefetch(&mesh.points[later]);
  const std::uint32_t d = rings.degree(next);
  if(d > std::uint32_t(Vertex_star::max_degree)) // it stays
    return;
  const Vertex_index* r = rings.ring(next);
  for(std::uint32_t k = 0; k < d; ++k) {
    const char* point = reinterpret_cast<const char*>(&mesh.points[r[k]]);
    internal::prefetch(point);
    internal::prefetch(point + sizeof(mesh.points[0]) - 1); // in the same line or the next
    rings.prefetch(r[k]);
  }
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATED_SURFACE_H
