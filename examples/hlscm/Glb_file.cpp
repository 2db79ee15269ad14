// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Glb_file.h"

#include "Canvas.h"

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace hlscm {

namespace {

constexpr double screen_pixels = 1920. * 1080., pixels_of_a_triangle = 8;
constexpr std::size_t texture_size = 256, squares = 32; // squares in each direction

using Vector = std::array<float, 3>;

// Of the fine surface, whatever the level: coarse models look smoother than they are.
std::vector<Vector> vertex_normals(const Progressive_model& model)
{
  std::vector<std::array<double, 3>> sums(model.points.size(), std::array<double, 3>{});
  for(const auto& t : model.progressive_mesh.triangles) {
    const auto &a = model.points[model.vertex[t[0]]], &b = model.points[model.vertex[t[1]]],
               &c = model.points[model.vertex[t[2]]];
    const auto n = CGAL::cross_product(b - a, c - a);
    for(const auto w : t) {
      for(int k = 0; k < 3; ++k) {
        sums[model.vertex[w]][std::size_t(k)] += n[k];
      }
    }
  }
  std::vector<Vector> normals;
  for(const auto& n : sums) {
    const double length = std::hypot(n[0], n[1], n[2]);
    normals.push_back(length > 0 ? Vector{float(n[0] / length), float(n[1] / length),
                                          float(n[2] / length)}
                                 : Vector{0, 0, 1});
  }
  return normals;
}

std::string checkerboard()
{
  std::vector<std::uint8_t> rgb;
  for(std::size_t y = 0; y < texture_size; ++y) {
    for(std::size_t x = 0; x < texture_size; ++x) {
      const bool is_dark = (x * squares / texture_size + y * squares / texture_size) % 2 == 1;
      for(const int value : is_dark ? std::array<int, 3>{56, 102, 158}
                                    : std::array<int, 3>{250, 247, 242}) {
        rgb.push_back(std::uint8_t(value));
      }
    }
  }
  return encode_png(rgb, texture_size);
}

class Builder
{
public:
  Builder(const Progressive_model& model, const std::vector<Level_of_detail>& levels)
    : m_model(model), m_levels(levels)
  {}

  std::string run()
  {
    m_gltf.asset.generator = "hlscm";
    m_gltf.buffers.emplace_back();
    add_material();
    add_vertices();
    for(const Level_of_detail& level : m_levels) {
      add_level(level);
    }
    link_levels();
    m_gltf.scenes.emplace_back();
    m_gltf.scenes[0].nodes = {0};
    m_gltf.defaultScene = 0;
    std::ostringstream stream;
    if(!tinygltf::TinyGLTF().WriteGltfSceneToStream(&m_gltf, stream, false, true)) {
      throw std::runtime_error("the GLB file could not be composed");
    }
    return stream.str();
  }

private:
  // `stride` is that of vertices, which the accessors of several levels share; else 0.
  int add_view(const void* data, std::size_t size, int target, std::size_t stride = 0)
  {
    std::vector<unsigned char>& bytes = m_gltf.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = size;
    view.byteStride = stride;
    view.target = target;
    const auto* begin = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
    bytes.resize((bytes.size() + 3) / 4 * 4); // accessors begin at multiples of four
    m_gltf.bufferViews.push_back(std::move(view));
    return int(m_gltf.bufferViews.size()) - 1;
  }

  template <typename Item>
  int add_vertex_view(const std::vector<Item>& items)
  {
    return add_view(items.data(), sizeof(Item) * items.size(), TINYGLTF_TARGET_ARRAY_BUFFER,
                    sizeof(Item));
  }

  int add_accessor(int view, std::size_t count, int component, int type)
  {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.count = count;
    accessor.componentType = component;
    accessor.type = type;
    m_gltf.accessors.push_back(std::move(accessor));
    return int(m_gltf.accessors.size()) - 1;
  }

  void add_material()
  {
    const std::string png = checkerboard();
    tinygltf::Image image;
    image.mimeType = "image/png";
    image.bufferView = add_view(png.data(), png.size(), 0);
    m_gltf.images.push_back(std::move(image));
    m_gltf.samplers.emplace_back(); // repeats
    tinygltf::Texture texture;
    texture.source = 0;
    texture.sampler = 0;
    m_gltf.textures.push_back(std::move(texture));
    tinygltf::Material material;
    material.name = "checkerboard";
    material.doubleSided = true;
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    m_gltf.materials.push_back(std::move(material));
  }

  // Those of the finest level. The origin of glTF's textures is their upper left corner.
  void add_vertices()
  {
    const std::vector<Vector> all_normals = vertex_normals(m_model);
    std::vector<Vector> normals;
    std::vector<std::array<float, 2>> uv;
    for(std::size_t w = 0; w < m_levels[0].wedges; ++w) {
      const auto& p = m_model.points[m_model.vertex[w]];
      m_points.push_back({float(p.x()), float(p.y()), float(p.z())});
      normals.push_back(all_normals[m_model.vertex[w]]);
      uv.push_back({float(m_model.uv[w].x()), float(1 - m_model.uv[w].y())});
    }
    m_point_view = add_vertex_view(m_points);
    m_normal_view = add_vertex_view(normals);
    m_uv_view = add_vertex_view(uv);
  }

  void add_level(const Level_of_detail& level)
  {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    const int points = add_accessor(m_point_view, level.wedges, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                    TINYGLTF_TYPE_VEC3);
    set_bounds(m_gltf.accessors[std::size_t(points)], level.wedges);
    primitive.attributes["POSITION"] = points;
    primitive.attributes["NORMAL"] = add_accessor(
        m_normal_view, level.wedges, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    primitive.attributes["TEXCOORD_0"]
        = add_accessor(m_uv_view, level.wedges, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2);
    const int view = add_view(level.triangles.data(), 12 * level.triangles.size(),
                              TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.indices = add_accessor(view, 3 * level.triangles.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    tinygltf::Mesh mesh;
    mesh.name = std::to_string(level.triangles.size()) + " triangles";
    mesh.primitives.push_back(std::move(primitive));
    m_gltf.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.mesh = int(m_gltf.meshes.size()) - 1;
    node.name = m_gltf.meshes.back().name;
    m_gltf.nodes.push_back(std::move(node));
  }

  void set_bounds(tinygltf::Accessor& accessor, std::size_t count) const
  {
    accessor.minValues.assign(3, std::numeric_limits<double>::infinity());
    accessor.maxValues.assign(3, -std::numeric_limits<double>::infinity());
    for(std::size_t w = 0; w < count; ++w) {
      for(std::size_t k = 0; k < 3; ++k) {
        accessor.minValues[k] = std::min(accessor.minValues[k], double(m_points[w][k]));
        accessor.maxValues[k] = std::max(accessor.maxValues[k], double(m_points[w][k]));
      }
    }
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
    m_gltf.nodes[0].extensions["MSFT_lod"]
        = tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(ids)}});
    m_gltf.nodes[0].extras
        = tinygltf::Value(tinygltf::Value::Object{{"MSFT_screencoverage",
                                                   tinygltf::Value(coverages)}});
    m_gltf.extensionsUsed.emplace_back("MSFT_lod");
  }

  const Progressive_model& m_model;
  const std::vector<Level_of_detail>& m_levels;
  tinygltf::Model m_gltf;
  std::vector<Vector> m_points;
  int m_point_view = -1, m_normal_view = -1, m_uv_view = -1;
};

} // namespace

std::string levels_as_glb(const Progressive_model& model,
                          const std::vector<Level_of_detail>& levels)
{
  return Builder(model, levels).run();
}

} // namespace hlscm
