// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_SURFACE_GRADIENTS_H
#define CGAL_SURFACE_MESH_MULTIGRID_SURFACE_GRADIENTS_H

#include <CGAL/Indexed_mesh/mesh_error.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/// \ingroup PkgHLSCMSurfaceMultigrid
/// A vector in space.
typedef Simple_cartesian<double>::Vector_3 Surface_vector;

namespace internal {

// The gradients of the hat functions at the corners of a triangle, 0 if it has no area, and this.
struct Hat_gradients
{
  std::array<Surface_vector, 3> at;
  double area;
};

inline Hat_gradients hat_gradients(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  const auto &p = mesh.points[v[0]], &q = mesh.points[v[1]], &r = mesh.points[v[2]];
  const Surface_vector normal = cross_product(q - p, r - p);
  const double square = normal.squared_length();
  if(!(square > 0.)) {
    const Surface_vector zero(0., 0., 0.);
    return {{zero, zero, zero}, 0.};
  }
  return {{cross_product(normal, r - q) / square, cross_product(normal, p - r) / square,
           cross_product(normal, q - p) / square},
          0.5 * std::sqrt(square)};
}

} // namespace internal

/// \ingroup PkgHLSCMSurfaceMultigrid
/// Returns the gradient, in each triangle, of the function that is linear there and has the values
/// `u` at the vertices; 0 in triangles without area. Linear time. Nothing is returned if an
/// index is out of range or `u` has not a value for each vertex.
template <class Values>
std::vector<Surface_vector> surface_gradients(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                              const Values& u)
{
  std::vector<Surface_vector> result;
  if(std::size_t(u.size()) != mesh.points.size()
     || !Indexed_mesh::index_error(mesh.triangles, mesh.points.size()).empty())
    return result;
  result.reserve(mesh.triangles.size());
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto g = internal::hat_gradients(mesh, t).at;
    const auto& v = mesh.triangles[t];
    // Differences first: a constant must not cost digits.
    result.push_back((u[v[1]] - u[v[0]]) * g[1] + (u[v[2]] - u[v[0]]) * g[2]);
  }
  return result;
}

/// \ingroup PkgHLSCMSurfaceMultigrid
/// Returns for each vertex the integral of the gradient of its hat function times `field`, a vector
/// in each triangle: the right-hand side of the function whose gradients are nearest to the field
/// (`Laplace_element` is the matrix), minus the integrated divergence. Linear time. Nothing
/// is returned if an index is out of range or `field` has not a vector for each triangle.
inline std::vector<double> weak_divergences(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                            const std::vector<Surface_vector>& field)
{
  if(field.size() != mesh.triangles.size()
     || !Indexed_mesh::index_error(mesh.triangles, mesh.points.size()).empty())
    return {};
  std::vector<double> result(mesh.points.size(), 0.);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto hats = internal::hat_gradients(mesh, t);
    const auto& v = mesh.triangles[t];
    for(int c = 0; c < 3; ++c)
      result[v[c]] += hats.area * (hats.at[c] * field[t]);
  }
  return result;
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_SURFACE_GRADIENTS_H
