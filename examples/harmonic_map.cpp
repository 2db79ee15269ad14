// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The harmonic map of a disk to the unit disk, its longest border to the circle: complex unknowns
// that are fixed at the border. Writes harmonic_map.png, the surface with the distance from the
// middle of the disk.

#include "surface_pictures.h"

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>

#include <complex>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace CGAL::Surface_mesh_multigrid;

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::hills(200), mesh))
    return EXIT_FAILURE;
  std::vector<CGAL::Indexed_mesh::Vertex_index> border;
  for(const auto& loop : CGAL::Indexed_mesh::border_loops(CGAL::Indexed_mesh::Vertex_rings(mesh)))
    border = loop.size() > border.size() ? loop : border;
  if(border.empty()) {
    std::cerr << "the surface has no border\n";
    return EXIT_FAILURE;
  }
  std::vector<double> length(1, 0.);
  for(std::size_t i = 0; i < border.size(); ++i)
    length.push_back(length.back() + std::sqrt(squared_distance(
      mesh.points[border[i]], mesh.points[border[(i + 1) % border.size()]])));
  std::vector<std::complex<double>> b(mesh.points.size(), 0.), z(mesh.points.size(), 0.);
  std::vector<bool> is_fixed(mesh.points.size(), false);
  for(std::size_t i = 0; i < border.size(); ++i) {
    is_fixed[border[i]] = true;
    z[border[i]] = std::polar(1., 2. * CGAL_PI * length[i] / length.back());
  }

  Surface_multigrid_solver<std::complex<double>> solver(mesh);
  auto report = solver.set_element(Laplace_element(), is_fixed);
  if(report.is_ok())
    report = solver.solve(b, z);
  if(!report.is_ok()) {
    std::cerr << report.error << "\n";
    return EXIT_FAILURE;
  }
  // By the maximum principle the map stays in the disk, and covers it once.
  double area = 0., farthest = 0.;
  std::vector<double> radius;
  for(const auto& t : mesh.triangles)
    area += 0.5 * (std::conj(z[t[1]] - z[t[0]]) * (z[t[2]] - z[t[0]])).imag();
  for(const auto& value : z) {
    radius.push_back(std::abs(value));
    farthest = (std::max)(farthest, std::abs(value));
  }
  std::cout << report.iterations << " iterations, " << report.seconds << " s, area " << area << "\n";
  return surface_pictures::draw("harmonic_map.png", mesh, radius, 10) && farthest < 1.001
             && std::abs(std::abs(area) - CGAL_PI) < 0.01
         ? EXIT_SUCCESS
         : EXIT_FAILURE;
}
