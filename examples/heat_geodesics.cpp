// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances on a surface from its first vertex by the heat method. Writes heat_geodesics.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>

#include <algorithm>
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
  Surface_multigrid_solver<> solver(mesh);
  std::vector<double> distance;
  const auto report = heat_distances(solver, mesh, 0, distance);
  if(!report.is_ok()) {
    std::cerr << report.error << "\n";
    return EXIT_FAILURE;
  }

  // Along an edge the distance does not change by more than its length.
  double steepest = 0.;
  for(const auto& t : mesh.triangles) {
    const double length = std::sqrt(squared_distance(mesh.points[t[0]], mesh.points[t[1]]));
    steepest = (std::max)(steepest, std::abs(distance[t[1]] - distance[t[0]]) / length);
  }
  std::cout << report.iterations << " iterations, steepest " << steepest << "\n";
  return surface_pictures::draw("heat_geodesics.png", mesh, distance, 24) && steepest < 1.5
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
