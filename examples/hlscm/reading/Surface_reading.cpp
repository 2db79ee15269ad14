// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Surface_reading.h"

#include <CGAL/Indexed_mesh/weld_points.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;

namespace {

using CGAL::Indexed_mesh::Surface_of_soup;
using CGAL::Indexed_mesh::Triangle_indices;

// Replaces faces by their triangles; `faces` are ascending.
void cut_into_triangles(Read_mesh& file, const Surface_of_soup& surface,
                        const std::vector<Triangle_indices>& wedges,
                        const std::vector<std::uint32_t>& faces)
{
  Read_mesh result;
  Polygon_soup& soup = result.soup;
  auto line = file.lines.begin();
  const auto add_corner = [&](std::uint32_t c, std::uint32_t uv) {
    soup.corners.push_back(file.soup.corners[c]);
    soup.uv_corners.push_back(uv);
    if(!file.normal_corners.empty()) {
      result.normal_corners.push_back(file.normal_corners[c]);
    }
  };
  for(std::uint32_t f = 0; f < file.soup.number_of_faces(); ++f) {
    for(; line != file.lines.end() && line->face <= f; ++line) {
      result.lines.push_back({soup.number_of_faces(), line->text});
    }
    if(!std::binary_search(faces.begin(), faces.end(), f)) {
      for(std::uint32_t c = file.soup.first_corner[f]; c < file.soup.first_corner[f + 1]; ++c) {
        add_corner(c, file.soup.uv_corners[c]);
      }
      soup.close_face();
      continue;
    }
    const auto range = std::equal_range(surface.face.begin(), surface.face.end(), f);
    for(auto t = std::size_t(range.first - surface.face.begin());
        t < std::size_t(range.second - surface.face.begin()); ++t)
    {
      for(std::size_t k = 0; k < 3; ++k) {
        add_corner(surface.corners[t][k], wedges[t][k]);
      }
      soup.close_face();
    }
  }
  for(; line != file.lines.end(); ++line) {
    result.lines.push_back({soup.number_of_faces(), line->text});
  }
  file.soup.corners.swap(soup.corners);
  file.soup.first_corner.swap(soup.first_corner);
  file.soup.uv_corners.swap(soup.uv_corners);
  file.normal_corners.swap(result.normal_corners);
  file.lines.swap(result.lines);
}

} // namespace

Read_mesh read_and_weld(const std::string& input, const Program_options& options,
                        Progress_bar& progress)
{
  Read_mesh mesh = read_mesh(input, progress);
  if(!options.weld) {
    return mesh;
  }
  const CGAL::Bbox_3 box = CGAL::Indexed_mesh::bounding_box(mesh.soup.points);
  const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(),
                                     box.zmax() - box.zmin());
  const double distance = options.weld->value * (options.weld->is_relative ? diagonal : 1);
  if(std::isfinite(distance)) {
    mesh.warnings.push_back(
        "vertices merged with others: "
        + std::to_string(CGAL::Indexed_mesh::weld_points(mesh.soup, distance)));
    mesh.colours.clear(); // which of the merged ones is not known
  }
  return mesh;
}

Input_surface read_surface(const std::string& input, const Program_options& options,
                           std::vector<Obstacle> (*obstacles)(const Diagnosis&),
                           Progress_bar& progress, std::vector<std::string>& warnings)
{
  Input_surface result;
  result.file = read_and_weld(input, options, progress);
  warnings.insert(warnings.end(), result.file.warnings.begin(), result.file.warnings.end());
  result.diagnosis = diagnose(result.file.soup, progress);
  if(options.is_strict || result.diagnosis.not_finite) {
    refuse_obstacles(input, obstacles(result.diagnosis));
  }
  result.surface = CGAL::Indexed_mesh::surface_of_soup(result.file.soup, result.diagnosis);
  if(!result.surface.is_ok()) {
    throw Program_error(input, result.surface.error
                                   + ", give a mesh with a surface instead of points, lines or a "
                                     "damaged file");
  }
  return result;
}

SMM::Textured_triangle_mesh to_textured(const Input_surface& input)
{
  SMM::Textured_triangle_mesh mesh;
  mesh.points = input.surface.mesh.points;
  mesh.triangles = input.surface.mesh.triangles;
  mesh.uv = input.file.soup.uv;
  mesh.wedges = input.surface.corners;
  for(Triangle_indices& wedge : mesh.wedges) {
    for(std::uint32_t& w : wedge) {
      w = input.file.soup.uv_corners[w];
    }
  }
  return mesh;
}

Read_mesh with_map(Read_mesh file, const Surface_of_soup& surface,
                   std::vector<Polygon_soup::Point_2> uv,
                   const std::vector<Triangle_indices>& wedges, std::vector<std::string>& warnings)
{
  file.soup.uv = std::move(uv);
  file.soup.uv_corners = CGAL::Indexed_mesh::uv_corners_of_soup(file.soup, surface, wedges);
  const std::vector<std::uint32_t> cut
      = CGAL::Indexed_mesh::cut_faces(file.soup, surface, wedges);
  if(!cut.empty()) {
    warnings.push_back("seams run across " + std::to_string(cut.size())
                       + (cut.size() == 1 ? " face" : " faces")
                       + " of more than three corners (the first is "
                       + std::to_string(cut.front()) + "), which became triangles");
    cut_into_triangles(file, surface, wedges, cut);
  }
  return file;
}

} // namespace hlscm
