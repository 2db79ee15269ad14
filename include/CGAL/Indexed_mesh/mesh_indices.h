// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_INDICES_H
#define CGAL_INDEXED_MESH_MESH_INDICES_H

// What the arrays of meshes consist of, without points: needs the standard library only, for what
// has to be compiled where CGAL is not, such as the reader of progressive meshes in a browser.

#include <array>
#include <cstdint>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// What can be wrong with the connectivity at a vertex.
enum class Ring_defect : std::uint8_t { NONE, ISOLATED, REPEATED_HALFEDGE, SEVERAL_FANS };

/// \ingroup PkgHLSCMIndexedMesh
/// The index of a vertex, 32 bits.
typedef std::uint32_t Vertex_index;

/// \ingroup PkgHLSCMIndexedMesh
/// The vertices of a triangle, counterclockwise.
typedef std::array<Vertex_index, 3> Triangle_indices;

/// \ingroup PkgHLSCMIndexedMesh
/// The index of a triangle, 32 bits.
typedef std::uint32_t Triangle_index;

/// \ingroup PkgHLSCMIndexedMesh
/// The number \f$ 3 t + c \f$ stands for corner \f$ c \f$ of triangle \f$ t \f$, and for the
/// halfedge from there to the next corner, which has the triangle on its left.
typedef std::uint32_t Halfedge;

/// \ingroup PkgHLSCMIndexedMesh
/// "No vertex".
constexpr Vertex_index no_vertex = Vertex_index(-1);

/// \ingroup PkgHLSCMIndexedMesh
/// "No triangle".
constexpr Triangle_index no_triangle = Triangle_index(-1);

/// \ingroup PkgHLSCMIndexedMesh
/// "No halfedge", what lies across the border of a surface.
constexpr Halfedge no_halfedge = Halfedge(-1);

} // namespace Indexed_mesh

// The packages on this kernel call its types by their short names.
namespace Surface_mesh_multiresolution {
using namespace Indexed_mesh;
} // namespace Surface_mesh_multiresolution
namespace Surface_mesh_parameterization {
using namespace Indexed_mesh;
} // namespace Surface_mesh_parameterization
namespace Surface_mesh_texturing {
using namespace Indexed_mesh;
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_MESH_INDICES_H
