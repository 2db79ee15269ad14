// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Half the length of the two border edges of each border vertex of a level: the integral over the
// border of the squared map, its mass lumped to the vertices (Mullen et al. 2008, section 4, count
// vertices, which depends on how finely the border is divided). The loops are those of the finest
// level; coarser ones have some of their vertices, in the same order.
inline Multigrid::Diagonal_mass
border_mass(const Surface_mesh_multiresolution::Mesh_level& level,
            const std::vector<std::vector<Surface_mesh_multiresolution::Vertex_index>>& loops)
{
  std::vector<Multigrid::Diagonal_mass::Entry> entries;
  for(const auto& loop : loops) {
    const std::size_t first = entries.size();
    for(const auto v : loop) {
      const std::size_t position = level.position(v);
      if(position < level.vertices.size() && level.vertices[position] == v)
        entries.push_back({std::uint32_t(position), 0.});
    }
    for(std::size_t i = first; i < entries.size(); ++i) {
      auto& a = entries[i];
      auto& b = entries[i + 1 < entries.size() ? i + 1 : first];
      const auto& points = level.mesh.points;
      const double half = 0.5 * std::sqrt(squared_distance(points[a.row], points[b.row]));
      a.value += half;
      b.value += half;
    }
  }
  return Multigrid::Diagonal_mass(std::move(entries));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H
