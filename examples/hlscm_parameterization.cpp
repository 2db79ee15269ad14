// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps a surface with a border to the plane: that of a file, or hills of 80,000 faces. Writes it with
// the map as its texture coordinates to hlscm_parameterization.obj.

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

void make_hills(Mesh& mesh)
{
  const auto hill = [](std::size_t i, std::size_t j) {
    const double x = 0.05 * double(i), y = 0.05 * double(j);
    return Kernel::Point_3(x, y, std::sin(x) * std::cos(0.7 * y) + 0.1 * std::sin(3. * x + y));
  };
  CGAL::make_grid(200, 200, mesh, hill, true);
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
  const auto uvmap = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>(
    "v:uv", Kernel::Point_2(0., 0.)).first;

  SMP::HLSCM_options options;
  options.tolerance = 1e-4; // of the energy
  SMP::HLSCM_parameterizer_3<Mesh> parameterizer(options);
  // The member function takes the null halfedge of a closed surface for an error, and says so;
  // CGAL's free function would follow it.
  const SMP::Error_code error = parameterizer.parameterize(mesh, border, uvmap);

  const SMP::HLSCM_report& report = parameterizer.report();
  if(error != SMP::OK) {
    std::cerr << report.message << "\n"; // never get_error_message(): it has no text for some codes
    return EXIT_FAILURE;
  }
  const SMP::Distortion_measures distortion = SMP::measure_distortion(mesh, uvmap);
  std::cout << report.faces << " faces, " << report.levels.size() << " levels, "
            << report.iterations << " iterations, " << report.seconds_total << " s\nenergy "
            << report.energy << ", quasi-conformal ratio " << distortion.quasi_conformal_mean
            << " on average, " << distortion.flipped_faces << " flipped faces\n";
  const bool is_written
    = CGAL::Surface_mesh_texturing::IO::write_OBJ("hlscm_parameterization.obj", mesh, uvmap);

  // The solver and the measures agree on the energy; the hills come out without a flipped face.
  const double difference = std::abs(report.energy - distortion.conformal_energy);
  const bool is_right
    = is_written && report.converged && difference <= 1e-6 * report.energy + 1e-12;
  return is_right && (argc > 1 || distortion.flipped_faces == 0) ? EXIT_SUCCESS : EXIT_FAILURE;
}
