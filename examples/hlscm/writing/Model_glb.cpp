// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Glb_builder.h"
#include "writing/Model_files.h"

#include <map>
#include <utility>

namespace hlscm {

namespace {

using CGAL::Surface_mesh_texturing::Tangent_frame;

class Model_glb
{
public:
  explicit Model_glb(const Textured_model& model) : m_model(model) {}

  std::string run(const std::string& name)
  {
    add_vertices();
    const auto& corners = m_model.has_tangents() ? m_model.frames.corners : m_model.mesh.wedges;
    std::vector<std::vector<std::array<std::uint32_t, 3>>> triangles(m_model.textures.size());
    for(std::size_t t = 0; t < corners.size(); ++t) {
      triangles[m_model.page[t]].push_back(corners[t]);
    }
    std::vector<tinygltf::Primitive> primitives;
    for(std::size_t page = 0; page < triangles.size(); ++page) {
      if(!triangles[page].empty()) {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.attributes = m_attributes;
        primitive.indices = m_glb.add_triangles(triangles[page]);
        primitive.material = add_material(page);
        primitives.push_back(std::move(primitive));
      }
    }
    m_glb.add_mesh(name, std::move(primitives));
    return m_glb.bytes({0});
  }

private:
  // One for each wedge, or for each frame.
  std::vector<Tangent_frame> vertices() const
  {
    if(m_model.has_tangents()) {
      return m_model.frames.frames;
    }
    std::vector<Tangent_frame> result;
    for(const std::uint32_t v : vertices_of_wedges(m_model.mesh)) {
      result.push_back({v, std::uint32_t(result.size()), {}, 1});
    }
    return result;
  }

  // The origin of glTF's textures is their upper left corner; directions stay as they are: green
  // is up in the picture on both sides.
  void add_vertices()
  {
    const Textured_triangle_mesh& mesh = m_model.mesh;
    std::vector<std::array<float, 3>> points, normals;
    std::vector<std::array<float, 2>> uv;
    std::vector<std::array<float, 4>> tangents;
    for(const Tangent_frame& v : vertices()) {
      points.push_back(floats(mesh.points[v.vertex]));
      normals.push_back(floats(m_model.frames.normals[v.vertex]));
      uv.push_back({float(mesh.uv[v.wedge].x()), float(1 - mesh.uv[v.wedge].y())});
      const auto t = floats(v.tangent);
      tangents.push_back({t[0], t[1], t[2], float(v.sign)});
    }
    const std::size_t n = points.size();
    m_attributes["POSITION"] = m_glb.add_position_accessor(m_glb.add_vertices(points), points, n);
    m_attributes["NORMAL"]
        = m_glb.add_vertex_accessor(m_glb.add_vertices(normals), n, TINYGLTF_TYPE_VEC3);
    m_attributes["TEXCOORD_0"]
        = m_glb.add_vertex_accessor(m_glb.add_vertices(uv), n, TINYGLTF_TYPE_VEC2);
    if(m_model.has_tangents()) {
      m_attributes["TANGENT"]
          = m_glb.add_vertex_accessor(m_glb.add_vertices(tangents), n, TINYGLTF_TYPE_VEC4);
    }
  }

  template <typename Vector>
  static std::array<float, 3> floats(const Vector& v)
  {
    return {float(v.x()), float(v.y()), float(v.z())};
  }

  int add_material(std::size_t page)
  {
    const Page_textures& textures = m_model.textures[page];
    const int number = m_glb.add_material("page_" + std::to_string(page + 1));
    tinygltf::Material& material = m_glb.model.materials[std::size_t(number)];
    material.pbrMetallicRoughness.baseColorTexture.index = texture(textures.colour);
    material.normalTexture.index = texture(textures.normal_map);
    return number;
  }

  // Each picture is stored once.
  int texture(const Texture_file* file)
  {
    if(file == nullptr) {
      return -1;
    }
    const auto [found, is_new] = m_textures.insert({file, 0});
    if(is_new) {
      found->second = m_glb.add_texture(file->png);
    }
    return found->second;
  }

  const Textured_model& m_model;
  Glb_builder m_glb;
  std::map<std::string, int> m_attributes;
  std::map<const Texture_file*, int> m_textures;
};

} // namespace

std::string to_glb(const Textured_model& model, const std::string& name)
{
  return Model_glb(model).run(name);
}

} // namespace hlscm
