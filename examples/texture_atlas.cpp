// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a closed surface into charts and packs their maps into one texture.
//
// Usage: texture_atlas [MESH]

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <iostream>

namespace SMT = CGAL::Surface_mesh_texturing;

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
  } else { // a smooth closed surface
    CGAL::make_icosahedron(mesh, Kernel::Point_3(0., 0., 0.), 1.);
    const auto iterations = CGAL::parameters::number_of_iterations(4);
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, iterations);
  }

  // The texture coordinate of the corner at the target of each halfedge, and the chart of each face
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  SMT::Texture_atlas_options options;
  options.bound.area_scale = 4.;
  options.packing.width = options.packing.height = 1024;
  options.packing.padding = 2;
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, uv, chart, options);
  if(!result.error.empty()) {
    std::cerr << result.error << "\n";
    return 1;
  }
  const SMT::Texture_atlas_report& report = result.report;
  std::cout << num_faces(mesh) << " faces in " << report.charts.size() << " charts, "
            << report.texels_per_unit << " texels a unit of length, "
            << 100. * report.utilisation << " % of the texture used\n";

  // Each chart is a disk whose map is one-to-one
  bool is_good = report.distortion.flipped_faces == 0;
  for(const SMT::Chart_report& c : report.charts)
    is_good = is_good && c.is_one_to_one && (c.faces == 1 || c.distortion.is_within(options.bound));
  for(const auto h : halfedges(mesh))
    if(!is_border(h, mesh))
      is_good = is_good && uv[h].x() >= 0. && uv[h].x() <= 1. && uv[h].y() >= 0. && uv[h].y() <= 1.;
  return is_good ? 0 : 1;
}
