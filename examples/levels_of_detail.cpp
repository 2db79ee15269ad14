// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes levels of detail of a surface that share its map as their texture coordinates: levels with
// given numbers of faces, a geomorph between two of them, and a mesh that is finer where one looks.
//
// Usage: levels_of_detail [MESH]

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Selectively_refined_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;

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
    CGAL::make_grid(80, 80, mesh, wave, true);
  }

  // The map, whose hierarchy is kept
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  SMP::HLSCM_options options;
  options.keep_progressive_mesh = true;
  SMP::HLSCM_parameterizer_3<Mesh> hlscm(options);
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  if(hlscm.parameterize(mesh, border, uv) != SMP::OK) {
    std::cerr << hlscm.report().message << "\n";
    return 1;
  }
  const auto built = SMP::build_textured_progressive_mesh(mesh, uv, hlscm.progressive_mesh());
  if(!built.error.empty()) {
    std::cerr << built.error << "\n";
    return 1;
  }
  const SMM::Textured_progressive_mesh& pm = built.mesh;

  // Levels by their number of faces, and how far their texture is from its place
  const SMM::Level_extractor levels(pm);
  bool is_good = true;
  for(const std::size_t faces : {num_faces(mesh) / 4, num_faces(mesh) / 20}) {
    const std::size_t k = levels.position_of_triangles(faces);
    const SMM::Texture_deviation error = SMM::measure_texture_deviation(pm, k);
    std::cout << levels.number_of_triangles(k) << " faces: texture deviation "
              << 100. * error.relative(error.deviation.mean) << " % of the diagonal\n";
    Mesh level;
    const auto level_uv
      = level.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
    SMM::copy_level(pm, levels.triangles(k), level, level_uv);
    is_good = is_good && num_faces(level) <= faces && error.relative(error.deviation.mean) < 0.01;
  }

  // Half way between two levels: the triangles of the finer one, its vertices half way to those
  // into which they collapse
  const std::size_t fine = levels.position_of_triangles(num_faces(mesh) / 4);
  const std::size_t coarse = levels.position_of_triangles(num_faces(mesh) / 8);
  const std::vector<CGAL::Indexed_mesh::Vertex_index> ancestors = levels.ancestors(fine, coarse);
  std::vector<Kernel::Point_3> morphed;
  for(CGAL::Indexed_mesh::Vertex_index w = 0; w < ancestors.size(); ++w)
    morphed.push_back(CGAL::midpoint(pm.points[pm.vertex[w]], pm.points[pm.vertex[ancestors[w]]]));
  std::cout << "a geomorph of " << morphed.size() << " vertices\n";

  // All vertices near the first point, and few elsewhere
  SMM::Selectively_refined_mesh selective(pm);
  const Kernel::Point_3 eye = mesh.point(*vertices(mesh).begin());
  selective.adapt([&](CGAL::Indexed_mesh::Vertex_index v) {
    return CGAL::squared_distance(pm.points[v], eye) < 4.;
  });
  std::cout << "finer near the eye: " << selective.number_of_triangles() << " faces\n";
  return is_good && selective.number_of_triangles() < num_faces(mesh) ? 0 : 1;
}
