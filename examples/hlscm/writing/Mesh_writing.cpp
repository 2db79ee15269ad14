// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Mesh_writing.h"

#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>

#include <cctype>
#include <filesystem>

namespace hlscm {

namespace IO = CGAL::Surface_mesh_texturing::IO;

namespace {

constexpr double obj_bytes_of_vertex = 104, obj_bytes_of_face = 40; // about, for the progress bar
constexpr double ply_bytes_of_vertex = 48, ply_bytes_of_face = 13;

} // namespace

void write_obj(const Read_mesh& mesh, Output_file& file,
               const std::function<void(std::size_t)>& written)
{
  IO::OBJ_details details;
  for(const Polygon_soup::Point_3& n : mesh.normals) {
    details.normals.emplace_back(n.x(), n.y(), n.z());
  }
  details.normal_corners = mesh.normal_corners;
  for(const Mesh_line& line : mesh.lines) {
    details.lines.emplace_back(line.face, line.text);
  }
  file.write([&](std::ostream& stream) { return IO::write_OBJ(stream, mesh.soup, details); },
             written);
}

void write_mesh(const Read_mesh& mesh, const std::string& name, Output_file& file,
                Progress_bar& progress)
{
  progress.start_stage("writing");
  const std::string extension = std::filesystem::path(name).extension().string();
  const bool is_ply = extension.size() == 4 && std::tolower((unsigned char)(extension[1])) == 'p';
  const double vertices = double(mesh.soup.number_of_vertices()),
               faces = double(mesh.soup.number_of_faces());
  const double all = is_ply ? ply_bytes_of_vertex * vertices + ply_bytes_of_face * faces
                            : obj_bytes_of_vertex * vertices + obj_bytes_of_face * faces;
  const auto written = [&](std::size_t bytes) { progress.advance(double(bytes) / all); };
  if(is_ply) {
    file.write([&](std::ostream& stream) { return IO::write_PLY(stream, mesh.soup); }, written);
  } else {
    write_obj(mesh, file, written);
  }
}

} // namespace hlscm
