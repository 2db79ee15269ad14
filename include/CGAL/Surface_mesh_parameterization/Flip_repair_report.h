// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_REPORT_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_REPORT_H

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMMeasures
/// What `repair_flipped_faces()` did. Flips are counted by an exact predicate.
struct Flip_repair_report
{
  std::size_t flipped_before = 0;    ///< faces with negative area in the plane
  std::size_t degenerate_before = 0; ///< faces without area in the plane
  std::size_t flipped_after = 0;     ///< faces with negative area after the repair
  std::size_t degenerate_after = 0;  ///< faces without area after the repair
  std::size_t patches = 0;           ///< patches that were mended
  std::size_t moved_vertices = 0;    ///< vertices that have another parameter than before
  /// Vertices around which the faces wind more than once since then: where the map did so around a
  /// patch already, nothing else can be had without flips.
  std::size_t branch_vertices = 0;
  double energy_before = 0.;         ///< conformal energy before, with the weights of the options
  double energy_after = 0.;          ///< and after the repair
  bool stopped_early = false;        ///< whether it was stopped before all patches were tried
  double seconds = 0.;               ///< time of the repair
  /// The faces that are still flipped or degenerate, by their positions in `faces(mesh)`,
  /// ascending.
  std::vector<std::size_t> unmended_faces;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_REPORT_H
