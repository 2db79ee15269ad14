// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMMeasures
/// The options of `repair_flipped_faces()`.
struct Flip_repair_options
{
  /// Which energy the mended map keeps low.
  Conformal_weights weights = Conformal_weights::EXACT;
  /// The weight of the term that keeps areas away from 0, in parts of the conformal energy of a
  /// face whose area scale is the mean one of its patch. A smaller one means less energy and
  /// flatter faces.
  double barrier = 1e-2;
  /// The patch of flipped faces is that of the vertices within so many edges.
  int first_rings = 2;
  /// Where that is not enough it is doubled, up to this.
  int last_rings = 256;
  /// Patches with more vertices are left as they are.
  std::size_t largest_patch = 20000;
  /// Told between patches which part of them is done, in [0, 1], in rounds of larger and larger
  /// patches; returning `false` stops: what is mended by then stays so.
  std::function<bool(double)> progress;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H
