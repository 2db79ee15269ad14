// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LEVEL_OF_DETAIL_H
#define HLSCM_PROGRAM_LEVEL_OF_DETAIL_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace hlscm {

using Progressive_model = CGAL::Surface_mesh_multiresolution::Textured_progressive_mesh;

/// One of the levels that a run makes.
struct Level_of_detail
{
  std::size_t vertices = 0, wedges = 0;
  std::vector<CGAL::Indexed_mesh::Triangle_indices> triangles; ///< of wedges
  std::optional<CGAL::Surface_mesh_multiresolution::Texture_deviation> deviation;
};

/// The arrays of a level.
inline CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh
to_mesh(const Progressive_model& model, const Level_of_detail& level)
{
  CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh mesh;
  mesh.points.assign(model.points.begin(), model.points.begin() + long(level.vertices));
  mesh.uv.assign(model.uv.begin(), model.uv.begin() + long(level.wedges));
  mesh.wedges = mesh.triangles = level.triangles;
  for(auto& t : mesh.triangles) {
    for(auto& v : t) {
      v = model.vertex[v];
    }
  }
  return mesh;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_LEVEL_OF_DETAIL_H
