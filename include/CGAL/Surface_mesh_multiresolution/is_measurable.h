// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_IS_MEASURABLE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_IS_MEASURABLE_H

#include <cmath>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns whether a coordinate is a finite number, and so are squared distances of points with such
/// coordinates: it is smaller than 1e153.
inline bool is_measurable(double coordinate) { return std::abs(coordinate) < 1e153; }

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_IS_MEASURABLE_H
