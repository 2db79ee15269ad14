// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CHART_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CHART_PROGRESSIVE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// The collapses with which a chart was parameterized, in an order of its vertices of its own.
struct Chart_progressive_mesh
{
  /// The collapses; empty if they were not kept.
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh;
  /// For each vertex of the chart its position in `vertices(mesh)`.
  std::vector<std::uint32_t> vertices;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CHART_PROGRESSIVE_MESH_H
