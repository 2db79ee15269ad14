// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Drags a pin of a map that is kept up to date, as an editor of texture coordinates does: the map
// of a surface of a file, or of hills of 80,000 faces.

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef SMP::Hierarchical_conformal_map<Mesh> Conformal_map;

void make_hills(Mesh& mesh)
{
  const auto hill = [](std::size_t i, std::size_t j) {
    const double x = 0.05 * double(i), y = 0.05 * double(j);
    return Kernel::Point_3(x, y, std::sin(x) * std::cos(0.7 * y));
  };
  CGAL::make_grid(200, 200, mesh, hill, true);
}

void print_last_step(const char* what, const Conformal_map& map)
{
  const SMP::HLSCM_report& report = map.report();
  std::cout << what << ": " << report.iterations << " iterations, " << report.seconds_total
            << " s, energy " << report.energy << "\n";
}

int main(int argc, char* argv[])
{
  Mesh mesh;
  if(argc < 2) {
    make_hills(mesh);
  } else if(!CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "cannot read " << argv[1] << "\n";
    return EXIT_FAILURE;
  }
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  if(border == Mesh::null_halfedge()) {
    std::cerr << "the surface has no border; cut it open first\n";
    return EXIT_FAILURE;
  }
  Conformal_map map(mesh, border);
  if(map.solve() != SMP::OK) {
    std::cerr << map.report().message << "\n";
    return EXIT_FAILURE;
  }
  print_last_step("from nothing", map);

  // The user takes a vertex in the middle and pulls; two pins hold the rest.
  const Mesh::Vertex_index grip(Mesh::size_type(num_vertices(mesh) / 2));
  const Kernel::Vector_2 step(0.002, 0.001);
  for(int i = 0; i < 5; ++i) {
    map.set_pin(grip, map.uv(grip) + step);
    const SMP::Level_view coarse = map.preview(5000); // to be drawn at once
    std::cout << coarse.uv->size() << " vertices at once; ";
    map.solve();
    print_last_step("dragged", map);
  }
  map.release_pin(grip);
  map.solve();
  print_last_step("released", map);

  const auto uvmap = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  map.get_uv(uvmap);
  const double energy = SMP::measure_distortion(mesh, uvmap).conformal_energy;
  const bool is_right = map.report().converged && map.number_of_pins() == 2
                     && std::abs(energy - map.report().energy) <= 1e-6 * energy + 1e-12;
  return is_right ? EXIT_SUCCESS : EXIT_FAILURE;
}
