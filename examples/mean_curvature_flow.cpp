// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ten implicit steps of mean-curvature flow (Desbrun et al. 1999): the matrix is another one in each
// step, on the same hierarchy. Writes mean_curvature_flow.png, the surface after the last step.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

double area_of(const surface_pictures::Mesh& mesh)
{
  double area = 0.;
  for(const auto& t : mesh.triangles)
    area += 0.5 * std::sqrt(CGAL::cross_product(mesh.points[t[1]] - mesh.points[t[0]],
                                                mesh.points[t[2]] - mesh.points[t[0]]).squared_length());
  return area;
}

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::bumpy_torus(120), mesh))
    return EXIT_FAILURE;
  const double area = area_of(mesh), step = 2e-4 * area;
  Surface_multigrid_solver<CGAL::Multigrid::Columns<double, 3>> solver(mesh);
  std::vector<Eigen::RowVector3d> x(mesh.points.size()), b = x; // the three coordinates at once
  std::size_t iterations = 0;
  for(int i = 0; i < 10; ++i) {
    // (M + step K) x = M x, with the mass and the Laplacian of the present surface
    std::vector<double> mass(mesh.points.size(), 0.);
    for(const auto& t : mesh.triangles)
      for(const auto v : t)
        mass[v] += std::sqrt(CGAL::cross_product(mesh.points[t[1]] - mesh.points[t[0]],
                               mesh.points[t[2]] - mesh.points[t[0]]).squared_length()) / 6.;
    for(std::size_t v = 0; v < mass.size(); ++v) {
      x[v] = {mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z()};
      b[v] = mass[v] * x[v];
    }
    auto report = solver.set_points(mesh.points);
    if(report.is_ok())
      report = solver.set_element(Laplace_element{step, 1.});
    if(report.is_ok())
      report = solver.solve(b, x);
    if(!report.is_ok()) {
      std::cerr << report.error << "\n";
      return EXIT_FAILURE;
    }
    iterations = (std::max)(iterations, report.iterations);
    for(std::size_t v = 0; v < mass.size(); ++v)
      mesh.points[v] = {x[v][0], x[v][1], x[v][2]};
  }
  std::vector<double> height;
  for(const auto& p : mesh.points)
    height.push_back(p.z());
  std::cout << "the area is " << area_of(mesh) / area << " of what it was; at most " << iterations
            << " iterations\n";
  return surface_pictures::draw("mean_curvature_flow.png", mesh, height, 12) && area_of(mesh) < area
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
