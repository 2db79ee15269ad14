// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Poisson's equation on a surface: the heights of a skin under pressure that is held at its border,
// or, of a closed surface, of one that gains on one side what it loses on the other. Writes
// poisson.png.

#include "surface_pictures.h"

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>

#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::hills(200), mesh))
    return EXIT_FAILURE;
  std::vector<bool> is_fixed(mesh.points.size(), false);
  for(const auto& edge : CGAL::Indexed_mesh::border_edges(mesh.triangles))
    is_fixed[edge[0]] = true;

  Surface_multigrid_solver<> solver(mesh);
  auto report = solver.set_element(Laplace_element(), is_fixed);
  std::vector<double> b(mesh.points.size(), 1.), x(mesh.points.size(), 0.);
  if(report.is_ok())
    report = solver.solve(b, x);
  if(!report.is_ok()) {
    std::cerr << report.error << "\n";
    return EXIT_FAILURE;
  }

  std::cout << *solver.hierarchy() << solver << report.iterations << " iterations, "
            << report.seconds << " s, residual " << report.relative_residual << "\n";
  return surface_pictures::draw("poisson.png", mesh, x, 15) && report.relative_residual < 1e-5
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
