// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_LEVEL_WEIGHTS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_LEVEL_WEIGHTS_H

#include <CGAL/Multigrid/vector_operations.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The weights of the triangles of each level, from those of the finest; none if those are empty.
// Coarse triangles get the mean weight of the fine ones that they stand for, so that the energy of
// a level resembles that of the finest.
inline std::vector<std::vector<double>>
level_weights(const std::vector<Surface_mesh_multiresolution::Mesh_level>& levels,
              std::vector<double> finest)
{
  std::vector<std::vector<double>> weights(levels.size());
  if(finest.empty())
    return weights;
  weights.back() = std::move(finest);
  const auto& triangles = levels.back().mesh.triangles;
  // Weight and number of the triangles at each vertex
  Multigrid::Complex_vector<double> density(levels.back().vertices.size(), 0.), coarse;
  for(std::size_t t = 0; t < triangles.size(); ++t)
    for(const auto v : triangles[t])
      density[v] += std::complex<double>(weights.back()[t], 1.);
  for(std::size_t l = levels.size() - 1; l-- > 0;) {
    levels[l + 1].from_coarser.restrict_in_place(density, coarse);
    density.swap(coarse);
    for(const auto& t : levels[l].mesh.triangles) {
      const std::complex<double> sum = density[t[0]] + density[t[1]] + density[t[2]];
      weights[l].push_back(sum.real() / sum.imag());
    }
  }
  return weights;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_LEVEL_WEIGHTS_H
