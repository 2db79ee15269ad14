// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smooth function on a surface through given values at a few vertices: the one of the least
// squared Laplacian, of the matrix K M^-1 K. The solver takes any matrix on the vertices. Writes
// smooth_function.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>

#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

typedef Eigen::SparseMatrix<double> Matrix;

// The cotangent Laplacian or, without stiffness, the lumped mass.
Matrix matrix_of(const Surface_hierarchy& surface, const Laplace_element& element)
{
  std::vector<Eigen::Triplet<double>> entries;
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
  Matrix result(surface.number_of_vertices(), surface.number_of_vertices());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::hills(100), mesh))
    return EXIT_FAILURE;
  const std::size_t n = mesh.points.size();
  Surface_multigrid_solver<> solver(mesh);
  if(!solver.hierarchy()->is_ok()) {
    std::cerr << solver.hierarchy()->error << "\n";
    return EXIT_FAILURE;
  }
  const Matrix K = matrix_of(*solver.hierarchy(), {1., 0.}), M = matrix_of(*solver.hierarchy(), {0., 1.});
  std::vector<bool> is_fixed(n, false);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  const std::size_t given = 12;
  for(std::size_t i = 0; i < given; ++i) {
    const std::size_t v = (i * n) / given + (37 * i) % (n / given);
    is_fixed[v] = true;
    x[v] = i % 2 == 0 ? 1. : -1.;
  }
  Matrix inverse = M;
  inverse.diagonal() = M.diagonal().cwiseInverse();
  auto report = solver.set_matrix(Matrix(K * inverse * K), is_fixed);
  solver.options().schedule = CGAL::Multigrid::Schedule::k_cycle(4, 4); // of fourth order
  solver.options().tolerance = 1e-8;
  if(report.is_ok())
    report = solver.solve(Eigen::VectorXd(Eigen::VectorXd::Zero(n)), x);
  std::cout << report.error << (report.is_ok() ? "" : "\n") << report.iterations << " iterations, "
            << report.seconds << " s\n";
  return report.is_ok() && surface_pictures::draw("smooth_function.png", mesh, {x.begin(), x.end()}, 20)
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
