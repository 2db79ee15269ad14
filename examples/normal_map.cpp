// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a closed surface to a light model with a tenth of its faces and a normal map in which the
// detail of the surface is seen.
//
// Usage: normal_map

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <vector>

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// A ball with dimples.
Mesh dimpled_ball()
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0., 0., 0.), 1.);
  const auto iterations = CGAL::parameters::number_of_iterations(5);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, iterations);
  for(const auto v : vertices(mesh)) {
    const Kernel::Vector_3 d = mesh.point(v) - CGAL::ORIGIN;
    const double depth = std::sin(12. * d.x()) * std::sin(12. * d.y()) * std::sin(12. * d.z());
    mesh.point(v) = CGAL::ORIGIN + (1. + 0.02 * depth) / std::sqrt(d * d) * d;
  }
  return mesh;
}

int main()
{
  Mesh mesh = dimpled_ball();
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto chart = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
  const SMT::Texture_atlas_result atlas = SMT::build_texture_atlas(mesh, uv, chart);
  if(!atlas.error.empty()) {
    std::cerr << atlas.error << "\n";
    return 1;
  }

  // A level of detail shares the texture coordinates
  const SMT::Textured_triangle_mesh& fine = atlas.atlas.mesh;
  const auto built = SMM::build_textured_progressive_mesh(fine);
  if(!built.error.empty()) {
    std::cerr << built.error << "\n";
    return 1;
  }
  const SMM::Level_extractor levels(built.mesh);
  const SMT::Textured_triangle_mesh light
    = levels.mesh(levels.position_of_triangles(num_faces(mesh) / 10));

  // What is at equal texture coordinates belongs together
  const SMT::Tangent_frames frames = SMT::tangent_frames(light, SMT::vertex_normals(light));
  const SMT::Baked_map map
    = SMT::bake_normal_map(fine, SMT::vertex_normals(fine), light, frames);
  if(!map.error.empty()) {
    std::cerr << map.error << "\n";
    return 1;
  }
  const std::vector<std::uint8_t> pixels = SMT::encode_unit_vectors<std::uint8_t>(map.image);
  const SMT::Rendering_error error
    = SMT::rendering_error(fine, light, frames, map.image, SMT::Normal_space::TANGENT);
  std::cout << num_faces(mesh) << " faces, light model " << light.triangles.size()
            << " faces, normal map of " << pixels.size() << " bytes; normals off by "
            << error.mean_angle << " degrees, without the map by " << error.mean_angle_without_map
            << "\n";
  return error.mean_angle < 0.5 * error.mean_angle_without_map ? 0 : 1;
}
