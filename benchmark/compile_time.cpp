// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What compile_time.py compiles: a mesh that is cut along seams is mapped by least squares, with
// CGAL's own parameterizer or, if WITH_HLSCM is defined, with that of the library. All else is the same.

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/IO/File_off.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#ifdef WITH_HLSCM
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#else
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#endif

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Seam_mesh<Mesh, Mesh::Property_map<Mesh::Edge_index, bool>,
                        Mesh::Property_map<Mesh::Vertex_index, bool>> Seam_mesh;
#ifdef WITH_HLSCM
typedef SMP::HLSCM_parameterizer_3<Seam_mesh> Parameterizer;
#else
typedef SMP::LSCM_parameterizer_3<Seam_mesh> Parameterizer;
#endif

int main(int argc, char* argv[])
{
  Mesh mesh;
  std::ifstream input(argc > 1 ? argv[1] : "mesh.off");
  if(!(input >> mesh)) {
    std::cerr << "cannot read the mesh\n";
    return EXIT_FAILURE;
  }
  Seam_mesh seam_mesh(mesh, mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first,
                      mesh.add_property_map<Mesh::Vertex_index, bool>("v:seam", false).first);
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(seam_mesh).first;
  if(border == boost::graph_traits<Seam_mesh>::null_halfedge()) {
    std::cerr << "the mesh has no border\n";
    return EXIT_FAILURE;
  }
  if(SMP::parameterize(seam_mesh, Parameterizer(), border, uv) != SMP::OK) {
    std::cerr << "there is no map\n";
    return EXIT_FAILURE;
  }
  std::ofstream out("result.off");
  SMP::IO::output_uvmap_to_off(seam_mesh, border, uv, out);
  return EXIT_SUCCESS;
}
