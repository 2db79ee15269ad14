// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a closed surface of genus 0 along a path of edges and maps it to the plane: that of a file,
// or an ellipsoid. The parameters belong to halfedges, since a vertex on the seam has two.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <boost/graph/breadth_first_search.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef Mesh::Vertex_index Vertex;
typedef CGAL::Seam_mesh<Mesh, Mesh::Property_map<Mesh::Edge_index, bool>,
                        Mesh::Property_map<Vertex, bool>> Seam_mesh;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if(argc < 2) {
    CGAL::make_icosahedron(mesh, Kernel::Point_3(0., 0., 0.), 1.);
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(5));
    for(const Vertex v : vertices(mesh))
      mesh.point(v) = Kernel::Point_3(mesh.point(v).x(), mesh.point(v).y(), 2. * mesh.point(v).z());
  } else if(!CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "cannot read " << argv[1] << "\n";
    return EXIT_FAILURE;
  }
  if(num_vertices(mesh) == 0) {
    std::cerr << "there are no vertices\n";
    return EXIT_FAILURE;
  }
  // The seam: a shortest path from the lowest vertex to the highest
  const auto is_seam_edge = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
  const auto is_seam_vertex = mesh.add_property_map<Vertex, bool>("v:seam", false).first;
  const auto is_lower = [&](Vertex a, Vertex b) { return mesh.point(a).z() < mesh.point(b).z(); };
  const auto ends = std::minmax_element(vertices(mesh).begin(), vertices(mesh).end(), is_lower);
  const auto before = mesh.add_property_map<Vertex, Vertex>("v:before").first;
  boost::breadth_first_search(mesh, *ends.first, boost::visitor(boost::make_bfs_visitor(
    boost::record_predecessors(before, boost::on_tree_edge()))));
  if(*ends.first == *ends.second || before[*ends.second] == Mesh::null_vertex()) {
    std::cerr << "there is no path from the lowest vertex to the highest\n";
    return EXIT_FAILURE;
  }
  Seam_mesh seam_mesh(mesh, is_seam_edge, is_seam_vertex);
  for(Vertex v = *ends.second; v != *ends.first; v = before[v])
    seam_mesh.add_seam(v, before[v]);

  const auto uvmap = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto on_seam = halfedge(*ends.second, before[*ends.second], mesh).first;
  const Seam_mesh::halfedge_descriptor border = opposite(
    Seam_mesh::halfedge_descriptor(on_seam), seam_mesh);
  SMP::HLSCM_parameterizer_3<Seam_mesh> parameterizer;
  if(parameterizer.parameterize(seam_mesh, border, uvmap) != SMP::OK) {
    std::cerr << parameterizer.report().message << "\n";
    return EXIT_FAILURE;
  }
  const SMP::Distortion_measures distortion = SMP::measure_distortion(seam_mesh, uvmap);
  std::cout << num_vertices(mesh) << " vertices, cut open " << num_vertices(seam_mesh) << "; "
            << distortion.flipped_faces << " flipped faces, quasi-conformal ratio "
            << distortion.quasi_conformal_mean << " on average\n";
  const bool is_good = distortion.flipped_faces == 0 && distortion.quasi_conformal_mean < 1.1;
  return argc > 1 || is_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
