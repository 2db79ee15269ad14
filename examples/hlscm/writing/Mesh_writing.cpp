// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Mesh_writing.h"

#include "writing/Mesh_items.h"

#include <cctype>
#include <filesystem>

namespace hlscm {

namespace {

// The elements pass the bar from one fraction of the file to another.
template <typename Elements, typename Write>
void write_all(const Elements& elements, double begin, double end, Progress_bar& progress,
               Write write)
{
  const double each = (end - begin) / double(elements.size());
  for(const auto element : elements) {
    if(element % 16384 == 0) {
      progress.advance(begin + each * double(element));
    }
    write(element);
  }
}

void write_obj(const Mesh& mesh, const Uv_map& uv, Output_file& file, Progress_bar& progress)
{
  write_all(mesh.vertices(), 0, 0.4, progress, [&](Mesh::Vertex_index v) {
    const auto& p = mesh.point(v);
    put_numbers(file, "v", {p.x(), p.y(), p.z()});
  });
  write_all(mesh.vertices(), 0.4, 0.7, progress, [&](Mesh::Vertex_index v) {
    put_numbers(file, "vt", {uv[v].x(), uv[v].y()});
  });
  write_all(mesh.faces(), 0.7, 1, progress, [&](Mesh::Face_index f) {
    file.put("f");
    for(std::size_t v : corners(mesh, f)) {
      file.put(" ");
      file.put(v + 1);
      file.put("/");
      file.put(v + 1);
    }
    file.put("\n");
  });
}

void write_ply(const Mesh& mesh, const Uv_map& uv, Output_file& file, Progress_bar& progress)
{
  put_ply_header(file, mesh.number_of_vertices(), mesh.number_of_faces());
  write_all(mesh.vertices(), 0, 0.6, progress, [&](Mesh::Vertex_index v) {
    put_ply_vertex(file, mesh.point(v), uv[v]);
  });
  write_all(mesh.faces(), 0.6, 1, progress,
            [&](Mesh::Face_index f) { put_ply_face(file, corners(mesh, f)); });
}

} // namespace

void write_mesh(const Mesh& mesh, const Uv_map& uv, const std::string& name, Output_file& file,
                Progress_bar& progress)
{
  progress.start_stage("writing");
  const std::string extension = std::filesystem::path(name).extension().string();
  const bool is_ply = extension.size() == 4 && std::tolower((unsigned char)(extension[1])) == 'p';
  (is_ply ? write_ply : write_obj)(mesh, uv, file, progress);
}

} // namespace hlscm
