// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances on a surface from its first vertex by the heat method (Crane, Weischedel, Wardetzky
// 2013): heat flows for a moment, its gradients point to the source, and the distance is the function
// whose gradients have these directions and the length 1. Writes heat_geodesics.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>
#include <CGAL/Surface_mesh_multigrid/surface_gradients.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::bumpy_torus(160), mesh))
    return EXIT_FAILURE;
  const std::size_t n = mesh.points.size();
  Surface_multigrid_solver<> solver(mesh);

  // Heat falls by a factor e every four edges: far away it must be right relative to what is there,
  // so the tolerance is that of rounding.
  const double reach = 4. * solver.hierarchy()->mean_edge();
  std::vector<double> source(n, 0.), heat(n, 0.), distance(n, 0.);
  source[0] = 1.;
  solver.options().tolerance = 1e-13;
  solver.set_element(Laplace_element{reach * reach, 1.});
  const auto flow = solver.solve(source, heat);

  std::vector<Surface_vector> directions = surface_gradients(mesh, heat);
  for(Surface_vector& g : directions) {
    const double length = std::sqrt(g.squared_length());
    g = length > 0. ? -g / length : g;
  }
  solver.options().tolerance = 1e-6;
  solver.set_element(Laplace_element());
  const auto report = solver.solve(weak_divergences(mesh, directions), distance);
  if(!report.is_ok()) {
    std::cerr << report.error << "\n";
    return EXIT_FAILURE;
  }
  for(std::size_t v = n; v-- > 0;)
    distance[v] -= distance[0];

  // Along an edge the distance does not change by more than its length.
  double steepest = 0.;
  for(const auto& t : mesh.triangles) {
    const double length = std::sqrt(squared_distance(mesh.points[t[0]], mesh.points[t[1]]));
    steepest = (std::max)(steepest, std::abs(distance[t[1]] - distance[t[0]]) / length);
  }
  std::cout << flow.iterations << " and " << report.iterations << " iterations, "
            << flow.seconds + report.seconds << " s, steepest " << steepest << "\n";
  return surface_pictures::draw("heat_geodesics.png", mesh, distance, 24) && steepest < 1.5
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
