// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_ASSEMBLE_MATRIX_H
#define CGAL_SURFACE_MESH_MULTIGRID_ASSEMBLE_MATRIX_H

#include <CGAL/Surface_mesh_multigrid/Element_matrix.h>
#include <CGAL/Surface_mesh_multigrid/Surface_hierarchy.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/*!
\ingroup PkgHLSCMSurfaceMultigrid

Returns the sum of the element matrices of all faces as a matrix of Eigen, for products of matrices
and other solvers; `Surface_multigrid_solver::set_element()` needs none. Row i is vertex i of the mesh.

\param surface the surface; its levels do not matter
\param element a model of `SurfaceElement` with entries `double`
*/
template <class Element>
Eigen::SparseMatrix<double> assemble_matrix(const Surface_hierarchy& surface,
                                            const Element& element)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * surface.triangles().size());
  for(std::size_t t = 0; t < surface.triangles().size(); ++t) {
    const Surface_triangle triangle = surface.triangle(t);
    Element_matrix<double> e;
    element(triangle, e);
    for(int j = 0; j < 3; ++j) {
      const auto v = triangle.vertices[j], next = triangle.vertices[(j + 1) % 3],
                 last = triangle.vertices[(j + 2) % 3];
      entries.emplace_back(v, v, e.diagonal[j]);
      entries.emplace_back(next, last, e.beside[j]);
      entries.emplace_back(last, next, e.beside[j]);
    }
  }
  Eigen::SparseMatrix<double> result(surface.number_of_vertices(), surface.number_of_vertices());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_ASSEMBLE_MATRIX_H
