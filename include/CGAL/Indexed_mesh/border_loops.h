// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_BORDER_LOOPS_H
#define CGAL_INDEXED_MESH_BORDER_LOOPS_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the border cycles, each with the surface on its left. Linear time.
inline std::vector<std::vector<Vertex_index>> border_loops(const Vertex_rings& rings)
{
  std::vector<std::vector<Vertex_index>> loops;
  std::vector<bool> is_seen(rings.size(), false);
  for(Vertex_index start = 0; start < rings.size(); ++start) {
    if(!rings.is_border(start) || is_seen[start])
      continue;
    loops.emplace_back();
    for(Vertex_index v = start; !is_seen[v]; v = rings.ring(v)[0]) {
      is_seen[v] = true;
      loops.back().push_back(v);
    }
  }
  return loops;
}

/// \ingroup PkgHLSCMIndexedMesh
/// Returns for each vertex whether it can be reached from `seed` along edges. Linear time.
inline std::vector<bool> component_of(const Vertex_rings& rings, Vertex_index seed)
{
  // Every vertex points to its smallest neighbour; few trees result, and only edges between trees
  // are looked at one by one
  constexpr std::size_t block = 16384;
  const std::size_t n = rings.size();
  std::vector<Vertex_index> parent(n);
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      const Vertex_index* r = rings.ring(Vertex_index(v));
      const std::uint32_t d = rings.degree(Vertex_index(v));
      parent[v] = (std::min)(Vertex_index(v), *std::min_element(r, r + d));
    }
  });
  for(std::size_t v = 0; v < n; ++v) // parents are smaller, and settled
    parent[v] = parent[parent[v]];
  std::vector<std::vector<std::pair<Vertex_index, Vertex_index>>> links(
    Blocked_execution::number_of_blocks(n, block));
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    auto& found = links[begin / block];
    for(std::size_t v = begin; v < end; ++v)
      for(std::uint32_t i = 0; i < rings.degree(Vertex_index(v)); ++i) {
        const Vertex_index w = rings.ring(Vertex_index(v))[i];
        if(parent[w] < parent[v]
           && (found.empty() || found.back() != std::make_pair(parent[v], parent[w])))
          found.push_back({parent[v], parent[w]});
      }
  });
  Disjoint_sets sets(std::move(parent));
  for(const auto& block_links : links)
    for(const auto& [a, b] : block_links)
      sets.join(a, b);
  const Vertex_index root = sets.find(seed);
  std::vector<bool> is_reached(n);
  for(std::size_t v = 0; v < n; ++v)
    is_reached[v] = sets.find(Vertex_index(v)) == root;
  return is_reached;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_BORDER_LOOPS_H
