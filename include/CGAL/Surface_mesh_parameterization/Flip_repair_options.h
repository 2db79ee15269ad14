// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMMeasures
/// What `repair_flipped_faces()` did, or why it did nothing. Flips are counted by an exact
/// predicate.
struct Flip_repair_report
  : Indexed_mesh::Mesh_outcome
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
  /// The steps of Newton's method, times the vertices that move in them, for each hundred flipped
  /// faces or part of a hundred: with the default about half a second on a usual machine. They
  /// are counted, so that the result is the same on any machine. Then there is one more try with the
  /// smallest patches; if flipped faces are left, `Flip_repair_report::stopped_early` says so.
  double effort = 2e5;
  unsigned int threads = 0; ///< with a parallel tag; 0: as many as there are processors
  /// Told between patches which part of them is done, in [0, 1], in rounds of larger and larger
  /// patches; returning `false` stops: what is mended by then stays so.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMMeasures
/// A map of triangles as arrays, for a function that moves its vertices.
struct Map_to_repair
{
  /// Returns the shape of a face on the surface, and the weight of its energy.
  typedef std::function<std::pair<Conformal_triangle, double>(std::uint32_t)> Shape_of_face;

  /// The faces, by indices of vertices.
  const std::vector<Indexed_mesh::Triangle_indices>& faces;
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

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_FLIP_REPAIR_OPTIONS_H
