// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_STRETCH_LEVELS_H
#define HLSCM_TEST_SUPPORT_STRETCH_LEVELS_H

// Maps of one level, as Newton's method takes them.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/internal/descent/Stretch_level.h>

#include <utility>
#include <vector>

namespace test_support {

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef SMP::internal::Stretch_level<SMP::Symmetric_dirichlet_energy> Dirichlet_level;

// The points without their z.
inline std::vector<SMP::internal::Plane_point> projection(const Indexed_triangle_mesh& mesh)
{
  std::vector<SMP::internal::Plane_point> places;
  for(const Point_3& p : mesh.points)
    places.push_back({p.x(), p.y()});
  return places;
}

// The mesh must live as long as the level.
inline Dirichlet_level level_of(const Indexed_triangle_mesh& mesh,
                                std::vector<SMP::internal::Plane_point> places,
                                std::vector<bool> is_fixed = {})
{
  const auto reference = [&mesh](std::size_t t) {
    const auto& v = mesh.triangles[t];
    return SMP::Reference_triangle<double>::of_points(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
  };
  return Dirichlet_level(mesh.triangles, reference, std::move(places), std::move(is_fixed),
                         SMP::Symmetric_dirichlet_energy());
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_STRETCH_LEVELS_H
