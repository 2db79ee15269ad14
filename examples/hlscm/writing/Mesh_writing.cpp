// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Mesh_writing.h"

#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>

#include <cctype>
#include <filesystem>

namespace hlscm {

namespace {

constexpr double obj_bytes_of_vertex = 104, obj_bytes_of_face = 40; // about, for the progress bar
constexpr double ply_bytes_of_vertex = 48, ply_bytes_of_face = 13;

} // namespace

void write_mesh(const Mesh& mesh, const Uv_map& uv, const std::string& name, Output_file& file,
                Progress_bar& progress)
{
  namespace IO = CGAL::Surface_mesh_texturing::IO;
  progress.start_stage("writing");
  const std::string extension = std::filesystem::path(name).extension().string();
  const bool is_ply = extension.size() == 4 && std::tolower((unsigned char)(extension[1])) == 'p';
  const double vertices = double(mesh.number_of_vertices()), faces = double(mesh.number_of_faces());
  const double all = is_ply ? ply_bytes_of_vertex * vertices + ply_bytes_of_face * faces
                            : obj_bytes_of_vertex * vertices + obj_bytes_of_face * faces;
  file.write(
      [&](std::ostream& stream) {
        return is_ply ? IO::write_PLY(stream, mesh, uv) : IO::write_OBJ(stream, mesh, uv);
      },
      [&](std::size_t bytes) { progress.advance(double(bytes) / all); });
}

} // namespace hlscm
