// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_DEFECT_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_DEFECT_H

#include <cstdint>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What can be wrong with the connectivity at a vertex.
enum class Ring_defect : std::uint8_t { NONE, ISOLATED, REPEATED_HALFEDGE, SEVERAL_FANS };

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_RING_DEFECT_H
