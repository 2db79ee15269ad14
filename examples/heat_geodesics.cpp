// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances on a surface from its first vertex by the heat method (Crane, Weischedel, Wardetzky
// 2013): heat flows for a moment, its gradients point to the source, and the distance is the function
// whose gradients have these directions and the length 1. Writes heat_geodesics.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>
#include <CGAL/Surface_mesh_multigrid/surface_gradients.h>

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
  const std::size_t n = mesh.points.size();
  Surface_multigrid_solver<> solver(mesh);

  // Heat falls by a factor e over the length `reach`. Gradients count where it is above rounding;
  // farther away they are those of heat that reaches twice as far.
  std::vector<double> source(n, 0.), heat(n, 0.), distance(n, 0.);
  std::vector<Surface_vector> directions(mesh.triangles.size(), Surface_vector(0., 0., 0.));
  source[0] = 1.;
  solver.options().tolerance = 1e-13;
  bool is_everywhere = false;
  for(int i = 2; i < 12 && !is_everywhere; ++i) {
    const double reach = std::ldexp(solver.hierarchy()->mean_edge(), i);
    if(!solver.set_element(Laplace_element{reach * reach, 1.}).is_ok())
      break;
    solver.solve(source, heat);
    const auto gradients = surface_gradients(mesh, heat);
    is_everywhere = true;
    for(std::size_t t = 0; t < directions.size(); ++t) {
      const auto& v = mesh.triangles[t];
      if((std::min)({heat[v[0]], heat[v[1]], heat[v[2]]}) < 1e-10 * heat[0])
        is_everywhere = false;
      else if(directions[t].squared_length() == 0. && gradients[t].squared_length() > 0.)
        directions[t] = -gradients[t] / std::sqrt(gradients[t].squared_length());
    }
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
  std::cout << report.iterations << " iterations, steepest " << steepest << "\n";
  return surface_pictures::draw("heat_geodesics.png", mesh, distance, 24) && steepest < 1.5
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
