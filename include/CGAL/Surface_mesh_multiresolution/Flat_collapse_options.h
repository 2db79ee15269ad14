// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_OPTIONS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_OPTIONS_H

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The order in which the flat engine takes the collapses.
enum class Collapse_order
{
  BATCHED, ///< passes over the cheapest part in memory order: as good for a hierarchy, faster
  STRICT   ///< always the cheapest collapse of all (Ray and Lévy 2003, algorithm 2)
};

/// \ingroup PkgHLSCMMultiresolution
/// The options of `Flat_collapse_engine`.
struct Flat_collapse_options
{
  std::size_t target_vertices = 2000; ///< where to stop
  Collapse_order order = Collapse_order::BATCHED; ///< which collapse comes next
  /// The part of the vertices, the cheapest, that a pass of the batched order may remove.
  double pass_fraction = 0.7;
  /// Told the part done in [0, 1] from time to time; returning false stops early.
  std::function<bool(double)> progress;
};

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_OPTIONS_H
