// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_EDGE_COLLAPSE_DECIMATION_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_EDGE_COLLAPSE_DECIMATION_H

#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// Lets CGAL's `edge_collapse()` decimate the mesh for a parameterizer, with the same policies as
/// the engines of the package: `options.decimate = Edge_collapse_decimation();`. Some thirty times
/// slower. Expected O(n log n) time.
struct Edge_collapse_decimation
{
  /// Returns the collapses; see `Surface_mesh_multiresolution::progressive_mesh_by_edge_collapse()`.
  Surface_mesh_multiresolution::Progressive_mesh
  operator()(const Indexed_mesh::Indexed_triangle_mesh& mesh, const std::vector<bool>& is_locked,
             const Decimation_goal& goal) const
  {
    Surface_mesh_multiresolution::Progressive_mesh_options options;
    options.is_locked = is_locked;
    options.target_vertices = goal.target_vertices;
    options.angular_defect_bound = goal.angular_defect_bound;
    options.progress = goal.progress;
    return Surface_mesh_multiresolution::progressive_mesh_by_edge_collapse(mesh, options);
  }
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_EDGE_COLLAPSE_DECIMATION_H
