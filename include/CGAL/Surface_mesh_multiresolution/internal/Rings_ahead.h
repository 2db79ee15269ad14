// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RINGS_AHEAD_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RINGS_AHEAD_H

#include <CGAL/Surface_mesh_multiresolution/internal/Corner_rings.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Asks for what splits to come will need of the memory. Rings are lists, whose next corner is known
// only when the one before is there: so each of the splits to come goes one corner on.
class Rings_ahead
{
public:
  // To be called before split i. parent_of(j) is the parent of split j, or `no_vertex` if it is not
  // known or not there; prefetch_values(w) asks for what belongs to a wedge.
  template <class ParentOf, class PrefetchValues>
  void prefetch(const Corner_rings& rings, std::size_t i, const ParentOf& parent_of,
                const PrefetchValues& prefetch_values)
  {
    const Vertex_index parent = parent_of(i + corners_ahead + 4);
    if(parent != no_vertex) {
      rings.prefetch(parent);
      prefetch_values(parent);
    }
    for(std::size_t j = 0; j < corners_ahead; ++j)
      m_cursors[j] = rings.prefetch_next(m_cursors[j + 1], prefetch_values);
    const Vertex_index next = parent_of(i + corners_ahead + 1);
    m_cursors[corners_ahead] = next != no_vertex ? rings.prefetch_first(next) : 0;
  }

private:
  // The corners of a ring that are asked for one after the other: about as many as splits pass.
  static constexpr std::size_t corners_ahead = 4;

  // That of split i + 1 + j.
  std::array<Corner_rings::Corner, corners_ahead + 1> m_cursors = {};
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RINGS_AHEAD_H
