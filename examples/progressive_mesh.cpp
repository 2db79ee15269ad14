// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a progressive mesh of a surface and walks along it: to the coarsest mesh by halfedge
// collapses, and back by vertex splits, to exactly the mesh at the start. Then writes it as a file,
// reads the beginning of that, takes a level out, and makes the same level in one call.
//
// Usage: progressive_mesh [MESH]

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>

namespace SMM = CGAL::Surface_mesh_multiresolution;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if(argc > 1) {
    if(!CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
      std::cerr << "cannot read " << argv[1] << "\n";
      return 1;
    }
  } else { // waves
    const auto wave = [](std::size_t i, std::size_t j) {
      return Kernel::Point_3(0.1 * i, 0.1 * j, std::sin(0.1 * i) * std::cos(0.1 * j));
    };
    CGAL::make_grid(60, 60, mesh, wave, true);
  }

  const SMM::Progressive_surface surface = SMM::build_progressive_mesh(mesh);
  if(!surface.error.empty()) {
    std::cerr << surface.error << "\n";
    return 1;
  }
  const SMM::Progressive_mesh& pm = surface.progressive_mesh;
  SMM::Progressive_mesh_cursor cursor(pm);
  const auto print = [&] {
    std::cout << "after " << cursor.position() << " collapses: "
              << pm.number_of_vertices_after(cursor.position()) << " vertices, "
              << cursor.number_of_triangles() << " triangles\n";
  };

  print();
  for(const double part : {0.5, 0.9, 1.}) {
    cursor.move_to(std::size_t(part * double(pm.collapses.size())));
    print();
  }
  // The very same triangles, as a new mesh
  const bool is_same_level
    = SMM::triangles_after(pm, pm.collapses.size()).size() == cursor.number_of_triangles();
  while(cursor.position() > 0)
    cursor.split();
  print();
  const bool is_restored = cursor.triangles() == pm.triangles
                        && cursor.number_of_triangles() == pm.triangles.size();
  std::cout << (is_restored ? "the fine mesh is back exactly\n" : "the fine mesh is not back\n");
  const bool is_coarse = argc > 1 || pm.collapses.size() > pm.number_of_vertices / 2;

  // A file, of which any beginning will do
  std::ostringstream file;
  const bool is_written = SMM::write_progressive_mesh(file, surface).is_ok();
  const std::string beginning = file.str().substr(0, file.str().size() / 2);
  const SMM::Read_progressive_mesh read
    = SMM::decode_progressive_mesh(beginning.data(), beginning.size());
  std::cout << file.str().size() << " bytes; of half of them: " << read.message << "\n";

  // A level as a mesh, and the mesh itself brought down to as many vertices
  Mesh level;
  SMM::copy_level(surface, pm.collapses.size() / 2, level);
  SMM::Decimation_options options;
  options.target_vertices = num_vertices(level);
  const SMM::Decimation_result decimated = SMM::decimate(mesh, options);
  mesh.collect_garbage();
  std::cout << decimated.number_of_collapses << " vertices removed, " << num_faces(mesh)
            << " faces left\n";
  const bool is_decimated = argc > 1 || num_vertices(mesh) == num_vertices(level);
  return is_coarse && is_same_level && is_restored && is_written && decimated.is_ok()
           && is_decimated ? 0 : 1;
}
