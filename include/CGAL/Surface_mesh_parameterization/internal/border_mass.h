// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Triangles_at_vertices.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Half the length of the two border edges of each border vertex: the integral over the border of the
// squared map, its mass lumped to the vertices (Mullen et al. 2008, section 4, count vertices, which
// depends on how finely the border is divided).
inline Multigrid::Diagonal_mass
border_mass(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh,
            const Surface_mesh_multiresolution::internal::Triangles_at_vertices& at)
{
  std::vector<Multigrid::Diagonal_mass::Entry> entries;
  std::vector<std::uint32_t> successors, predecessors; // a and b of the triangles (v, a, b)
  const auto half_length_to_unmatched = [&](std::uint32_t v, const auto& some, const auto& others) {
    double sum = 0.;
    for(const std::uint32_t w : some)
      if(std::find(others.begin(), others.end(), w) == others.end())
        sum += 0.5 * std::sqrt(squared_distance(mesh.points[v], mesh.points[w]));
    return sum;
  };
  const std::vector<std::uint32_t> neighbors
    = numbers_of_neighbors(mesh.triangles, at, mesh.points.size());
  for(std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if(neighbors[v] == at.number(v)) // inside the surface
      continue;
    successors.clear();
    predecessors.clear();
    for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
      const auto& t = mesh.triangles[*corner / 3];
      successors.push_back(t[(*corner + 1) % 3]);
      predecessors.push_back(t[(*corner + 2) % 3]);
    }
    const double mass = half_length_to_unmatched(v, successors, predecessors)
                      + half_length_to_unmatched(v, predecessors, successors);
    if(mass > 0.)
      entries.push_back({v, mass});
  }
  return Multigrid::Diagonal_mass(std::move(entries));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_MASS_H
