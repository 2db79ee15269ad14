// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CREASE_WEIGHTS_H
#define CGAL_SURFACE_MESH_TEXTURING_CREASE_WEIGHTS_H

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

How much shorter than flat edges creases are taken to be, so that short seams lie on creases, where
they are least seen. Angles are those between the normals of the two triangles at an edge.
*/
struct Crease_weights
{
  double flat_angle = 25.;    ///< up to which an edge counts in full; degrees
  double sharp_angle = 70.;   ///< from which an edge is a crease; degrees
  double crease_length = 0.2; ///< what a crease counts for each unit of its length, in (0, 1]
  double concave_gain = 1.5;  ///< how much faster the length of concave edges falls with the angle
};

/// \ingroup PkgHLSCMTexturing
/// The options of `cut_to_disks()`.
struct Disk_cut_options
{
  /// The number of extremities, vertices far from each other, that the cut of a closed chart goes
  /// to at most: the tips of limbs, which would be tiny in the plane otherwise.
  std::size_t extremities = 8;
  /// The distance of an extremity from the cut, as a part of that of the first, below which no more
  /// are added.
  double least_distance = 0.3;
  /// What is taken to be short.
  Crease_weights creases;
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CREASE_WEIGHTS_H
