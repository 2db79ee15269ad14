// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smooth function on a surface through given values at a few vertices: the one of the least
// squared Laplacian, of the matrix K M^-1 K. The solver takes any matrix on the vertices. Writes
// smooth_function.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>
#include <CGAL/Surface_mesh_multigrid/assemble_matrix.h>

#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

typedef Eigen::SparseMatrix<double> Matrix;

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
  const Matrix K = assemble_matrix(*solver.hierarchy(), Laplace_element{1., 0.}),
               M = assemble_matrix(*solver.hierarchy(), Laplace_element{0., 1.});
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
