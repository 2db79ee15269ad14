// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_GLTF_IN_THE_MAKING_H
#define HLSCM_TEST_SUPPORT_GLTF_IN_THE_MAKING_H

// Files in glTF that are put together and changed piece by piece.

#include <support/read_meshes.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace read_meshes {

using Json = nlohmann::json;

enum Type { BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126 };

inline std::string encoded(const std::vector<double>& numbers, int type)
{
  std::string bytes;
  for(const double number : numbers) {
    switch(type) {
    case BYTE:
      put(bytes, std::int8_t(number));
      break;
    case UBYTE:
      put(bytes, std::uint8_t(number));
      break;
    case SHORT:
      put(bytes, std::int16_t(number));
      break;
    case USHORT:
      put(bytes, std::uint16_t(number));
      break;
    case UINT:
      put(bytes, std::uint32_t(number));
      break;
    default:
      put(bytes, float(number));
    }
  }
  return bytes;
}

inline std::string base64(const std::string& bytes)
{
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for(std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for(std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    }
    for(int k = 0; k < 4; ++k) {
      text += i + std::size_t(k) > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

inline const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1};
inline const std::vector<double> two_triangles = {0, 1, 2, 0, 2, 3};

// A file in the making: one mesh of one primitive at first.
struct Gltf
{
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  std::size_t add_view(const std::string& bytes)
  {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    return json["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(const std::vector<double>& numbers, const std::string& type,
                           int component_type = FLOAT)
  {
    const std::size_t components = type == "SCALAR" ? 1 : std::size_t(type[3] - '0');
    const std::size_t view = add_view(encoded(numbers, component_type));
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"type", type},
                                 {"count", numbers.size() / components}});
    return json["accessors"].size() - 1;
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  Json& accessor(const char* attribute)
  {
    return json["accessors"][primitive()["attributes"][attribute].get<std::size_t>()];
  }

  std::string glb()
  {
    json["buffers"] = {{{"byteLength", buffer.size()}}};
    return glb_of(json.dump(), buffer);
  }

  static std::string glb_of(std::string text, std::string bin)
  {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4);
    std::string bytes = "glTF";
    put(bytes, std::uint32_t(2));
    put(bytes, std::uint32_t(28 + text.size() + bin.size()));
    put(bytes, std::uint32_t(text.size()));
    bytes += "JSON" + text;
    put(bytes, std::uint32_t(bin.size()));
    return bytes + std::string("BIN\0", 4) + bin;
  }

  std::string gltf(const std::string& uri)
  {
    json["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
    return json.dump(1);
  }

  std::string gltf() { return gltf("data:application/octet-stream;base64," + base64(buffer)); }
};

inline Gltf mesh_of(const std::vector<double>& points, const std::vector<double>& indices,
             int index_type = UINT)
{
  Gltf file;
  file.primitive()["attributes"]["POSITION"] = file.add_accessor(points, "VEC3");
  if(!indices.empty()) {
    file.primitive()["indices"] = file.add_accessor(indices, "SCALAR", index_type);
  }
  file.json["nodes"] = {{{"mesh", 0}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  file.json["scene"] = 0;
  return file;
}

inline Gltf clean() { return mesh_of(square, two_triangles); }

// The mesh with positions of another type; 1 is `one` there.
inline Gltf with_positions_of(int type, double one, bool is_normalized)
{
  Gltf file;
  std::vector<double> points = square;
  for(double& x : points) {
    x *= one;
  }
  file.primitive()["attributes"]["POSITION"] = file.add_accessor(points, "VEC3", type);
  file.primitive()["indices"] = file.add_accessor(two_triangles, "SCALAR", UBYTE);
  file.accessor("POSITION")["normalized"] = is_normalized;
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return file;
}

inline Gltf interleaved()
{
  Gltf file = clean();
  std::string bytes = "abcd";
  for(std::size_t v = 0; v < 4; ++v) {
    bytes += encoded({square[3 * v], square[3 * v + 1], square[3 * v + 2]}, FLOAT)
             + (v < 3 ? "12345678" : "");
  }
  file.json["accessors"][0]["bufferView"] = file.add_view(bytes);
  file.json["accessors"][0]["byteOffset"] = 4;
  file.json["bufferViews"].back()["byteStride"] = 20;
  return file;
}

inline Gltf sparse(bool has_base)
{
  Gltf file = clean();
  Json& accessor = file.json["accessors"][0];
  if(has_base) {
    accessor["bufferView"] = file.add_view(encoded(std::vector<double>(12, 7.), FLOAT));
  } else {
    accessor.erase("bufferView");
  }
  const std::vector<double> all = {3, 2, 1, 0}, some = {3, 2, 1};
  std::vector<double> values = {0, 1, 1, 1, 1, 0, 1, 0, 0};
  if(has_base) {
    values.insert(values.end(), 3, 0.);
  }
  const std::size_t indices = file.add_view(encoded(has_base ? all : some, USHORT));
  accessor["sparse"] = {{"count", has_base ? 4 : 3},
                        {"indices", {{"bufferView", indices}, {"componentType", int(USHORT)}}},
                        {"values", {{"bufferView", file.add_view(encoded(values, FLOAT))}}}};
  return file;
}

inline Gltf changed(const std::function<void(Gltf&)>& change)
{
  Gltf file = clean();
  change(file);
  return file;
}

} // namespace read_meshes

#endif // HLSCM_TEST_SUPPORT_GLTF_IN_THE_MAKING_H
