// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Model_files.h"

#include "writing/Mesh_items.h"

#include <cstdio>

namespace hlscm {

namespace {

std::string material_name(std::size_t page) { return "page_" + std::to_string(page + 1); }

} // namespace

void write_obj(const Textured_model& model, const std::string& materials, Output_file& file)
{
  const Textured_triangle_mesh& mesh = model.mesh;
  file.put("mtllib " + materials + "\n");
  for(const auto& p : mesh.points) {
    put_numbers(file, "v", {p.x(), p.y(), p.z()});
  }
  for(const auto& p : mesh.uv) {
    put_numbers(file, "vt", {p.x(), p.y()});
  }
  for(const auto& n : model.frames.normals) {
    char line[64];
    std::snprintf(line, sizeof line, "vn %.6f %.6f %.6f\n", n.x(), n.y(), n.z());
    file.put(line);
  }
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if(t == 0 || model.page[t] != model.page[t - 1]) {
      file.put("usemtl " + material_name(model.page[t]) + "\n");
    }
    file.put("f");
    for(std::size_t c = 0; c < 3; ++c) {
      const std::size_t vertex = mesh.triangles[t][c] + std::size_t(1);
      file.put(" ");
      file.put(vertex);
      file.put("/");
      file.put(mesh.wedges[t][c] + std::size_t(1));
      file.put("/");
      file.put(vertex);
    }
    file.put("\n");
  }
}

void write_mtl(const Textured_model& model, Output_file& file)
{
  for(std::size_t page = 0; page < model.textures.size(); ++page) {
    const Page_textures& textures = model.textures[page];
    file.put("newmtl " + material_name(page) + "\nKd 0.8 0.8 0.8\nKs 0.2 0.2 0.2\nNs 40\n");
    if(textures.colour != nullptr) {
      file.put("map_Kd " + textures.colour->name + "\n");
    }
    if(textures.normal_map != nullptr) {
      file.put("norm " + textures.normal_map->name + "\nmap_Bump " + textures.normal_map->name
               + "\n");
    }
  }
}

void write_ply(const Textured_model& model, Output_file& file)
{
  const Textured_triangle_mesh& mesh = model.mesh;
  const std::vector<std::uint32_t> vertex = vertices_of_wedges(mesh);
  put_ply_header(file, mesh.uv.size(), mesh.triangles.size());
  for(std::size_t w = 0; w < mesh.uv.size(); ++w) {
    put_ply_vertex(file, mesh.points[vertex[w]], mesh.uv[w]);
  }
  for(const auto& t : mesh.wedges) {
    put_ply_face(file, t);
  }
}

} // namespace hlscm
