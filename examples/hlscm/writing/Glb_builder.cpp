// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include "writing/Glb_builder.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace hlscm {

namespace {

constexpr double roughness = 0.8;

} // namespace

Glb_builder::Glb_builder()
{
  model.asset.generator = "hlscm";
  model.buffers.emplace_back();
}

int Glb_builder::add_view(const void* data, std::size_t size, int target, std::size_t stride)
{
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = size;
  view.byteStride = stride;
  view.target = target;
  const auto* begin = static_cast<const unsigned char*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
  bytes.resize((bytes.size() + 3) / 4 * 4); // accessors begin at multiples of four
  model.bufferViews.push_back(std::move(view));
  return int(model.bufferViews.size()) - 1;
}

int Glb_builder::add_accessor(int view, std::size_t count, int component, int type)
{
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.count = count;
  accessor.componentType = component;
  accessor.type = type;
  model.accessors.push_back(std::move(accessor));
  return int(model.accessors.size()) - 1;
}

int Glb_builder::add_vertex_accessor(int view, std::size_t count, int type)
{
  return add_accessor(view, count, TINYGLTF_COMPONENT_TYPE_FLOAT, type);
}

int Glb_builder::add_position_accessor(int view, const std::vector<std::array<float, 3>>& points,
                                       std::size_t count)
{
  const int number = add_vertex_accessor(view, count, TINYGLTF_TYPE_VEC3);
  tinygltf::Accessor& accessor = model.accessors[std::size_t(number)];
  accessor.minValues.assign(3, std::numeric_limits<double>::infinity());
  accessor.maxValues.assign(3, -std::numeric_limits<double>::infinity());
  for(std::size_t v = 0; v < count; ++v) {
    for(std::size_t k = 0; k < 3; ++k) {
      accessor.minValues[k] = std::min(accessor.minValues[k], double(points[v][k]));
      accessor.maxValues[k] = std::max(accessor.maxValues[k], double(points[v][k]));
    }
  }
  return number;
}

int Glb_builder::add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles)
{
  const int view = add_view(triangles.data(), 12 * triangles.size(),
                            TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return add_accessor(view, 3 * triangles.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                      TINYGLTF_TYPE_SCALAR);
}

int Glb_builder::add_texture(const std::string& png)
{
  tinygltf::Image image;
  image.mimeType = "image/png";
  image.bufferView = add_view(png.data(), png.size(), 0);
  model.images.push_back(std::move(image));
  if(model.samplers.empty()) {
    model.samplers.emplace_back(); // repeats
  }
  tinygltf::Texture texture;
  texture.source = int(model.images.size()) - 1;
  texture.sampler = 0;
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
}

int Glb_builder::add_material(const std::string& name)
{
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = roughness;
  model.materials.push_back(std::move(material));
  return int(model.materials.size()) - 1;
}

void Glb_builder::add_mesh(const std::string& name, std::vector<tinygltf::Primitive> primitives)
{
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives = std::move(primitives);
  model.meshes.push_back(std::move(mesh));
  tinygltf::Node node;
  node.mesh = int(model.meshes.size()) - 1;
  node.name = name;
  model.nodes.push_back(std::move(node));
}

std::string Glb_builder::bytes(const std::vector<int>& nodes)
{
  model.scenes.emplace_back();
  model.scenes[0].nodes = nodes;
  model.defaultScene = 0;
  std::ostringstream stream;
  if(!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true)) {
    throw std::runtime_error("the GLB file could not be composed");
  }
  return stream.str();
}

} // namespace hlscm
