// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <support/indexed_mesh_files.h>
#include <support/real_meshes.h>

#include <CGAL/IO/polygon_soup_io.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>

namespace test_support {

Indexed_triangle_mesh read_indexed_mesh(const std::string& file)
{
  Indexed_triangle_mesh mesh;
  std::vector<std::vector<std::size_t>> polygons;
  if(!CGAL::IO::read_polygon_soup(file, mesh.points, polygons))
    throw std::runtime_error("cannot read " + file);
  std::vector<bool> is_used(mesh.points.size(), false);
  for(const auto& polygon : polygons) {
    if(polygon.size() != 3)
      throw std::runtime_error(file + " has a face that is not a triangle");
    mesh.triangles.push_back(
      {Vertex_index(polygon[0]), Vertex_index(polygon[1]), Vertex_index(polygon[2])});
    for(const std::size_t v : polygon)
      is_used[v] = true;
  }
  return without_vertices(mesh, is_used);
}

std::vector<Named_mesh> real_meshes_if_any(const std::vector<std::string>& names)
{
  std::vector<Named_mesh> result;
  for(const auto& folder : {folder_of_environment("HLSCM_DATA_DIR"), extra_meshes()})
    for(const std::string& name : names)
      if(!folder.empty() && std::filesystem::is_regular_file(folder / name))
        result.push_back({name, read_indexed_mesh((folder / name).string())});
  return result;
}

} // namespace test_support
