// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_TO_REPAIR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_TO_REPAIR_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>
#include <CGAL/Surface_mesh_parameterization/Flip_repair_report.h>

#include <complex>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMMeasures
/// A map of triangles as arrays, for a function that moves its vertices.
struct Map_to_repair
{
  /// Returns the shape of a face on the surface, and the weight of its energy.
  typedef std::function<std::pair<Conformal_triangle, double>(std::uint32_t)> Shape_of_face;

  /// The faces, by indices of vertices.
  const std::vector<Surface_mesh_multiresolution::Triangle_indices>& faces;
  const std::vector<bool>& is_fixed;    ///< the vertices that must not move
  Shape_of_face shape_of_face;          ///< the surface
  std::vector<std::complex<double>>& z; ///< the parameter \f$ u + iv \f$ of each vertex
};

/// \ingroup PkgHLSCMMeasures
/// Moves vertices of a map so that fewer faces are flipped. `progress(part)` is told from time to
/// time the part that is done, in [0, 1]; if it returns `false`, the map stays as it is then. Of the
/// energies in the report only their difference counts.
typedef std::function<Flip_repair_report(Map_to_repair& map,
                                         const std::function<bool(double)>& progress)>
  Flip_repair_function;

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_MAP_TO_REPAIR_H
