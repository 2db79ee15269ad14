// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Glb_file.h"

#include "writing/Checkerboard.h"
#include "writing/Glb_builder.h"

#include <CGAL/Surface_mesh_texturing/vertex_normals.h>

#include <algorithm>
#include <utility>

namespace hlscm {

namespace {

constexpr double screen_pixels = 1920. * 1080., pixels_of_a_triangle = 8;
constexpr std::size_t texture_size = 256, squares = 32; // squares in each direction

using Vector = std::array<float, 3>;

// Of the fine surface, whatever the level: coarse models look smoother than they are.
auto fine_normals(const Progressive_model& model)
{
  auto triangles = model.progressive_mesh.triangles;
  for(auto& t : triangles) {
    for(auto& w : t) {
      w = model.vertex[w];
    }
  }
  return CGAL::Surface_mesh_texturing::vertex_normals(model.points, triangles);
}

class Level_builder
{
public:
  Level_builder(const Progressive_model& model, const std::vector<Level_of_detail>& levels)
    : m_model(model), m_levels(levels)
  {}

  std::string run()
  {
    const int material = m_glb.add_material("checkerboard");
    m_glb.model.materials[0].pbrMetallicRoughness.baseColorTexture.index
        = m_glb.add_texture(checkerboard_png(texture_size, squares));
    add_vertices();
    for(const Level_of_detail& level : m_levels) {
      add_level(level, material);
    }
    link_levels();
    return m_glb.bytes({0});
  }

private:
  // Those of the finest level. The origin of glTF's textures is their upper left corner.
  void add_vertices()
  {
    const auto all_normals = fine_normals(m_model);
    std::vector<Vector> normals;
    std::vector<std::array<float, 2>> uv;
    for(std::size_t w = 0; w < m_levels[0].wedges; ++w) {
      const auto& p = m_model.points[m_model.vertex[w]];
      m_points.push_back({float(p.x()), float(p.y()), float(p.z())});
      const auto& n = all_normals[m_model.vertex[w]];
      normals.push_back({float(n.x()), float(n.y()), float(n.z())});
      uv.push_back({float(m_model.uv[w].x()), float(1 - m_model.uv[w].y())});
    }
    m_point_view = m_glb.add_vertices(m_points);
    m_normal_view = m_glb.add_vertices(normals);
    m_uv_view = m_glb.add_vertices(uv);
  }

  void add_level(const Level_of_detail& level, int material)
  {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    primitive.attributes["POSITION"]
        = m_glb.add_position_accessor(m_point_view, m_points, level.wedges);
    primitive.attributes["NORMAL"]
        = m_glb.add_vertex_accessor(m_normal_view, level.wedges, TINYGLTF_TYPE_VEC3);
    primitive.attributes["TEXCOORD_0"]
        = m_glb.add_vertex_accessor(m_uv_view, level.wedges, TINYGLTF_TYPE_VEC2);
    primitive.indices = m_glb.add_triangles(level.triangles);
    m_glb.add_mesh(std::to_string(level.triangles.size()) + " triangles", {primitive});
  }

  void link_levels()
  {
    if(m_levels.size() < 2) {
      return;
    }
    tinygltf::Value::Array ids, coverages;
    for(std::size_t i = 1; i < m_levels.size(); ++i) {
      ids.emplace_back(int(i));
      const double seen = double(m_levels[i].triangles.size()) / 2; // half face away
      coverages.emplace_back(std::min(1., seen * pixels_of_a_triangle / screen_pixels));
    }
    coverages.emplace_back(0.); // the last one is never hidden
    m_glb.model.nodes[0].extensions["MSFT_lod"]
        = tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(ids)}});
    m_glb.model.nodes[0].extras
        = tinygltf::Value(tinygltf::Value::Object{{"MSFT_screencoverage",
                                                   tinygltf::Value(coverages)}});
    m_glb.model.extensionsUsed.emplace_back("MSFT_lod");
  }

  const Progressive_model& m_model;
  const std::vector<Level_of_detail>& m_levels;
  Glb_builder m_glb;
  std::vector<Vector> m_points;
  int m_point_view = -1, m_normal_view = -1, m_uv_view = -1;
};

} // namespace

std::string levels_as_glb(const Progressive_model& model,
                          const std::vector<Level_of_detail>& levels)
{
  return Level_builder(model, levels).run();
}

} // namespace hlscm
