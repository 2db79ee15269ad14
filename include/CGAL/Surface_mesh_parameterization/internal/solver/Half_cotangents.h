// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_HALF_COTANGENTS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_HALF_COTANGENTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/memory.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

inline Conformal_triangle
conformal_triangle(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  return Conformal_triangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

inline std::array<double, 3> half_cotangents(const Conformal_triangle& t)
{
  return {0.5 * t.cotangent(0), 0.5 * t.cotangent(1), 0.5 * t.cotangent(2)};
}

// Half the cotangents of all triangles, three each: all that the energy needs to know of a metric.
struct Half_cotangents
{
  // 3 t + c: of the angle at corner c of triangle t
  Blocked_execution::Uninitialized_vector<double> value;
  std::size_t mollified = 0;

  Half_cotangents() {}

  // Those of the triangles as they lie in space.
  explicit Half_cotangents(const Indexed_mesh::Indexed_triangle_mesh& mesh)
    : value(3 * mesh.triangles.size())
  {
    const auto fill = [&](std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for(std::size_t t = begin; t < end; ++t) {
        const Conformal_triangle triangle = conformal_triangle(mesh, t);
        set(t, half_cotangents(triangle));
        count += triangle.is_mollified() ? 1 : 0;
      }
      return count;
    };
    mollified = Blocked_execution::blocked_sum<std::size_t>(mesh.triangles.size(), 16384, fill);
  }

  void set(std::size_t t, const std::array<double, 3>& c)
  {
    std::copy(c.begin(), c.end(), value.begin() + 3 * t);
  }
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_HALF_COTANGENTS_H
