// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BORDER_LOOPS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BORDER_LOOPS_H

#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The border cycles, each with the surface on its left.
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

// The vertices that can be reached from `seed` along edges, as a flag for each vertex.
inline std::vector<bool> component_of(const Vertex_rings& rings, Vertex_index seed)
{
  std::vector<bool> is_reached(rings.size(), false);
  std::vector<Vertex_index> stack(1, seed);
  is_reached[seed] = true;
  while(!stack.empty()) {
    const Vertex_index v = stack.back();
    stack.pop_back();
    for(std::uint32_t i = 0; i < rings.degree(v); ++i) {
      const Vertex_index w = rings.ring(v)[i];
      if(!is_reached[w]) {
        is_reached[w] = true;
        stack.push_back(w);
      }
    }
  }
  return is_reached;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_BORDER_LOOPS_H
