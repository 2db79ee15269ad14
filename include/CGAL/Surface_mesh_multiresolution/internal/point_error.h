// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_POINT_ERROR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_POINT_ERROR_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <cmath>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The first of these vertices that has no place, as a sentence.
inline std::string point_error(const std::vector<Indexed_triangle_mesh::Point_3>& points)
{
  for(std::size_t v = 0; v < points.size(); ++v)
    for(int c = 0; c < 3; ++c)
      if(!std::isfinite(points[v][c]))
        return "vertex " + std::to_string(v) + " has a coordinate that is not a finite number";
  return {};
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_POINT_ERROR_H
