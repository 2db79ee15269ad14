// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Surface_reading.h"

#include "reading/Diagnosis.h"
#include "reading/Mesh_reading.h"

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;

namespace {

void drop_isolated_vertices(Polygon_soup& soup)
{
  std::vector<std::uint32_t> number(soup.points.size(), 0);
  for(const std::uint32_t v : soup.corners) {
    number[v] = 1;
  }
  std::uint32_t kept = 0;
  for(std::size_t v = 0; v < number.size(); ++v) {
    if(number[v] != 0) {
      soup.points[kept] = soup.points[v];
      number[v] = kept++;
    }
  }
  soup.points.resize(kept);
  for(std::uint32_t& v : soup.corners) {
    v = number[v];
  }
}

template <typename Mesh>
void copy_triangles(const Polygon_soup& soup, Mesh& mesh)
{
  mesh.points = soup.points;
  for(std::size_t c = 0; c < soup.corners.size(); c += 3) {
    mesh.triangles.push_back({soup.corners[c], soup.corners[c + 1], soup.corners[c + 2]});
  }
}

} // namespace

Polygon_soup read_surface(const std::string& input, Progress_bar& progress,
                          std::vector<std::string>& warnings)
{
  Read_mesh read = read_mesh(input, progress);
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  const Diagnosis diagnosis = diagnose(read.soup, progress);
  refuse_obstacles(input, atlas_obstacles(diagnosis));
  refuse_beyond_floats(input, read.soup.points);
  if(diagnosis.isolated) {
    drop_isolated_vertices(read.soup);
    warnings.push_back("vertices of no face are left out: "
                       + std::to_string(diagnosis.isolated.count));
  }
  return std::move(read.soup);
}

CGAL::Indexed_mesh::Indexed_triangle_mesh to_indexed(const Polygon_soup& soup)
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  copy_triangles(soup, mesh);
  return mesh;
}

SMM::Textured_triangle_mesh to_textured(const Polygon_soup& soup)
{
  SMM::Textured_triangle_mesh mesh;
  copy_triangles(soup, mesh);
  mesh.uv = soup.uv;
  for(std::size_t c = 0; c < soup.uv_corners.size(); c += 3) {
    mesh.wedges.push_back({soup.uv_corners[c], soup.uv_corners[c + 1], soup.uv_corners[c + 2]});
  }
  return mesh;
}

} // namespace hlscm
