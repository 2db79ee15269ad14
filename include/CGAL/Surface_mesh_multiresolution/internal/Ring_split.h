// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_SPLIT_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_SPLIT_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What a new vertex takes of the ring of its parent: corners INSIDE a ring, or as a border vertex
// the BEGIN or the END of an open one.
enum class Split_kind : std::uint8_t { INSIDE, BEGIN, END };

// A vertex split in terms of the ring of its parent.
struct Ring_split
{
  Vertex_index parent; // `no_vertex`: there is no such split
  Split_kind kind;
  // Where the corners that move begin: in an open ring the number of corners before them, in a
  // closed one that number less one. 0 for BEGIN.
  std::uint32_t skipped;
  std::uint32_t moved; // the corners that move; 0 for END, which moves all that follow
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_SPLIT_H
