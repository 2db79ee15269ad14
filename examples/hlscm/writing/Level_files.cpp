// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Level_files.h"

#include "writing/Mesh_items.h"

namespace hlscm {

void write_level_obj(const Progressive_model& model, const Level_of_detail& level,
                     Output_file& file)
{
  for(std::size_t v = 0; v < level.vertices; ++v) {
    const auto& p = model.points[v];
    put_numbers(file, "v", {p.x(), p.y(), p.z()});
  }
  for(std::size_t w = 0; w < level.wedges; ++w) {
    put_numbers(file, "vt", {model.uv[w].x(), model.uv[w].y()});
  }
  for(const auto& t : level.triangles) {
    file.put("f");
    for(const std::size_t w : t) {
      file.put(" ");
      file.put(std::size_t(model.vertex[w]) + 1);
      file.put("/");
      file.put(w + 1);
    }
    file.put("\n");
  }
}

void write_level_ply(const Progressive_model& model, const Level_of_detail& level,
                     Output_file& file)
{
  put_ply_header(file, level.wedges, level.triangles.size());
  for(std::size_t w = 0; w < level.wedges; ++w) {
    put_ply_vertex(file, model.points[model.vertex[w]], model.uv[w]);
  }
  for(const auto& t : level.triangles) {
    put_ply_face(file, t);
  }
}

} // namespace hlscm
