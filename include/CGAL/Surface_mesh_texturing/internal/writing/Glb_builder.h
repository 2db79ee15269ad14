// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_BUILDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_BUILDER_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A finite number in JSON: the shortest text that reads back as the same, with a point.
inline std::string json_number(double number)
{
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, number);
  std::string result(text, end.ptr);
  if(result.find_first_of(".e") == std::string::npos)
    result += ".0";
  return result;
}

inline std::string json_text(const std::string& text)
{
  std::string result = "\"";
  for(const char c : text) {
    if((unsigned char)(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", unsigned(c));
      result += escape;
    } else {
      if(c == '"' || c == '\\')
        result += '\\';
      result += c;
    }
  }
  return result + '"';
}

inline std::string json_list(const std::vector<std::string>& items)
{
  std::string result = "[";
  for(const std::string& item : items)
    result += (result.size() > 1 ? "," : "") + item;
  return result + ']';
}

// Composes a glTF 2.0 file with one binary buffer (GLB): JSON, and the data of its accessors.
class Glb_builder
{
public:
  // Adds the data of vertices, which the accessors of several primitives may share; returns the
  // number of the view.
  template <std::size_t N>
  int add_vertices(const std::vector<std::array<float, N>>& items)
  {
    const std::size_t begin = m_data.size();
    for(const std::array<float, N>& item : items)
      for(const float x : item)
        put_32(bits_of(x));
    return add_view(begin, ",\"byteStride\":" + std::to_string(4 * N) + ",\"target\":34962");
  }

  // Adds an accessor to the first `count` items, of floats, of a view of vertices; returns its
  // number. `type` is such as VEC3.
  int add_vectors(int view, std::size_t count, const std::string& type)
  {
    return add_accessor(view, 5126, count, "", type);
  }

  // The same for positions, whose bounds are added.
  int add_positions(int view, const std::vector<std::array<float, 3>>& points, std::size_t count)
  {
    std::vector<std::string> lowest, highest;
    for(std::size_t k = 0; k < 3; ++k) {
      float lo = std::numeric_limits<float>::infinity(), hi = -lo;
      for(std::size_t v = 0; v < count; ++v) {
        lo = (std::min)(lo, points[v][k]);
        hi = (std::max)(hi, points[v][k]);
      }
      lowest.push_back(json_number(double(lo)));
      highest.push_back(json_number(double(hi)));
    }
    const std::string bounds = ",\"max\":" + json_list(highest) + ",\"min\":" + json_list(lowest);
    return add_accessor(view, 5126, count, bounds, "VEC3");
  }

  // Adds triangles, and returns the number of their accessor.
  int add_triangles(const std::vector<Indexed_mesh::Triangle_indices>& triangles)
  {
    const std::size_t begin = m_data.size();
    for(const Indexed_mesh::Triangle_indices& t : triangles)
      for(const Indexed_mesh::Vertex_index v : t)
        put_32(v);
    const int view = add_view(begin, ",\"target\":34963");
    return add_accessor(view, 5125, 3 * triangles.size(), "", "SCALAR");
  }

  // Adds a texture, a PNG file, and returns its number. It repeats beyond [0, 1].
  int add_texture(const std::string& png)
  {
    const std::size_t begin = m_data.size();
    m_data += png;
    const int view = add_view(begin, "");
    m_images.push_back("{\"bufferView\":" + std::to_string(view)
                       + ",\"mimeType\":\"image/png\"}");
    return int(m_images.size()) - 1;
  }

  // Adds a material of a rough, white surface that is seen from both sides, with textures or -1, by
  // the texture coordinates of the set `uv_set`; returns its number.
  int add_material(const std::string& name, int color, int normal_map, int uv_set = 0)
  {
    const std::string set = uv_set == 0 ? "" : ",\"texCoord\":" + std::to_string(uv_set);
    const auto texture = [&set](const std::string& key, int number) {
      return number < 0 ? "" : '"' + key + "\":{\"index\":" + std::to_string(number) + set + "},";
    };
    m_materials.push_back("{\"doubleSided\":true,\"name\":" + json_text(name) + ','
                          + texture("normalTexture", normal_map) + "\"pbrMetallicRoughness\":{"
                          + texture("baseColorTexture", color)
                          + "\"metallicFactor\":0.0,\"roughnessFactor\":0.8}}");
    return int(m_materials.size()) - 1;
  }

  // The triangles of an accessor with the accessors of their vertices and a material.
  std::string primitive(const std::map<std::string, int>& attributes, int indices,
                        int material) const
  {
    std::string list;
    for(const auto& [key, accessor] : attributes)
      list += (list.empty() ? "\"" : ",\"") + key + "\":" + std::to_string(accessor);
    return "{\"attributes\":{" + list + "},\"indices\":" + std::to_string(indices)
         + ",\"material\":" + std::to_string(material) + ",\"mode\":4}";
  }

  // Adds a mesh, and returns its number.
  int add_mesh(const std::string& name, const std::vector<std::string>& primitives)
  {
    m_meshes.push_back("{\"name\":" + json_text(name) + ",\"primitives\":" + json_list(primitives)
                       + '}');
    return int(m_meshes.size()) - 1;
  }

  // Adds a node that shows a mesh; the first one is the scene. `more` are further members, each
  // before a comma, and `placement` those of its place, each after one.
  void add_node(const std::string& name, int mesh, const std::string& placement,
                const std::string& more = std::string())
  {
    m_nodes.push_back('{' + more + "\"mesh\":" + std::to_string(mesh) + ",\"name\":"
                      + json_text(name) + placement + '}');
  }

  void use_extension(const std::string& name) { m_extensions.push_back(json_text(name)); }

  // Writes the file; false if it is longer than the format allows, or the stream did not take all.
  bool write(std::ostream& os) const
  {
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size = 28 + std::uint64_t(text.size()) + m_data.size();
    if(size > (std::numeric_limits<std::uint32_t>::max)())
      return false;
    Byte_output out(os);
    out.put("glTF");
    for(const std::uint64_t number : {std::uint64_t(2), size, std::uint64_t(text.size())})
      out.put_bytes(std::uint32_t(number));
    out.put("JSON" + text);
    out.put_bytes(std::uint32_t(m_data.size()));
    out.put(std::string("BIN\0", 4));
    out.put(m_data);
    return out.finish();
  }

private:
  static std::uint32_t bits_of(float x)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }

  // The lowest byte first
  void put_32(std::uint32_t bits)
  {
    const char bytes[] = {char(bits), char(bits >> 8), char(bits >> 16), char(bits >> 24)};
    m_data.append(bytes, sizeof bytes);
  }

  // Of the data from `begin` on.
  int add_view(std::size_t begin, const std::string& more)
  {
    const std::string place = begin == 0 ? "" : ",\"byteOffset\":" + std::to_string(begin);
    m_views.push_back("{\"buffer\":0,\"byteLength\":" + std::to_string(m_data.size() - begin)
                      + place + more + '}');
    m_data.resize((m_data.size() + 3) / 4 * 4, '\0'); // accessors begin at multiples of four
    return int(m_views.size()) - 1;
  }

  int add_accessor(int view, int component, std::size_t count, const std::string& bounds,
                   const std::string& type)
  {
    m_accessors.push_back("{\"bufferView\":" + std::to_string(view) + ",\"componentType\":"
                          + std::to_string(component) + ",\"count\":" + std::to_string(count)
                          + bounds + ",\"type\":" + json_text(type) + '}');
    return int(m_accessors.size()) - 1;
  }

  std::string json() const
  {
    std::vector<std::string> textures;
    for(std::size_t i = 0; i < m_images.size(); ++i)
      textures.push_back("{\"sampler\":0,\"source\":" + std::to_string(i) + '}');
    const auto member = [](const std::string& key, const std::vector<std::string>& items) {
      return items.empty() ? "" : '"' + key + "\":" + json_list(items) + ',';
    };
    const std::string samplers
      = m_images.empty() ? "" : "\"samplers\":[{\"wrapS\":10497,\"wrapT\":10497}],";
    const std::string last = m_images.empty() ? "" : ",\"textures\":" + json_list(textures);
    return '{' + member("accessors", m_accessors)
         + "\"asset\":{\"generator\":\"hlscm\",\"version\":\"2.0\"},"
         + member("bufferViews", m_views)
         + "\"buffers\":[{\"byteLength\":" + std::to_string(m_data.size()) + "}],"
         + member("extensionsUsed", m_extensions) + member("images", m_images)
         + member("materials", m_materials) + member("meshes", m_meshes)
         + member("nodes", m_nodes) + samplers + "\"scene\":0,\"scenes\":[{\"nodes\":[0]}]" + last
         + '}';
  }

  std::string m_data;
  std::vector<std::string> m_accessors, m_views, m_images, m_materials, m_meshes, m_nodes,
    m_extensions;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_WRITING_GLB_BUILDER_H
