// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_PROGRAM_ATLASES_H
#define HLSCM_TEST_SUPPORT_PROGRAM_ATLASES_H

// What `hlscm atlas` and `hlscm bake` write, read and judged, and the surfaces that they are given.

#include <support/textured_soups.h>

#include <stb/stb_image.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace program_test {

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

// A torus with waves on it, finer than a light model can show.
inline Soup wavy_torus(std::size_t n)
{
  Soup soup;
  const std::size_t m = 2 * n;
  for(std::size_t i = 0; i < m; ++i) {
    for(std::size_t j = 0; j < n; ++j) {
      const double a = 6.283185307179586 * double(i) / double(m);
      const double b = 6.283185307179586 * double(j) / double(n);
      const double tube = 1 + 0.03 * std::sin(20 * a) * std::sin(8 * b), r = 2 + tube * std::cos(b);
      soup.points.push_back({r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
      const std::size_t i1 = (i + 1) % m, j1 = (j + 1) % n;
      soup.faces.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      soup.faces.push_back({i * n + j, i1 * n + j1, i * n + j1});
    }
  }
  return soup;
}

inline Soup cube()
{
  Soup soup;
  for(std::size_t i = 0; i < 8; ++i) {
    soup.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  }
  for(const auto& q : std::vector<std::array<std::size_t, 4>>{
          {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    soup.faces.push_back({q[0], q[1], q[2]});
    soup.faces.push_back({q[0], q[2], q[3]});
  }
  return soup;
}

// An OBJ file with `v`, `vt`, `vn`, `f v/vt/vn`, and the material of each face.
struct Obj_model
{
  Textured_soup soup;
  std::vector<std::size_t> material; ///< of each face
  std::size_t normals = 0;
};

inline Obj_model read_model(const fs::path& path)
{
  Obj_model result;
  std::map<std::string, std::size_t> materials;
  std::size_t material = 0;
  std::ifstream file(path);
  for(std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword, name;
    words >> keyword;
    if(keyword == "v") {
      auto& p = result.soup.surface.points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if(keyword == "vt") {
      auto& p = result.soup.uv.emplace_back();
      words >> p[0] >> p[1];
    } else if(keyword == "vn") {
      Point n;
      words >> n[0] >> n[1] >> n[2];
      EXPECT_NEAR(length(n), 1, 1e-5);
      ++result.normals;
    } else if(keyword == "usemtl") {
      words >> name;
      material = materials.insert({name, materials.size()}).first->second;
    } else if(keyword == "f") {
      auto& face = result.soup.surface.faces.emplace_back();
      auto& uv_face = result.soup.uv_faces.emplace_back();
      std::size_t v, t, n;
      char slash;
      while(words >> v >> slash >> t >> slash >> n) {
        EXPECT_LE(n, result.normals);
        face.push_back(v - 1);
        uv_face.push_back(t - 1);
      }
      result.material.push_back(material);
    }
  }
  return result;
}

// Empty if all texture coordinates lie in the unit square, and no sample of a raster with this side
// lies in two triangles of a material, and none is flipped.
inline std::string error_in_texture(const Obj_model& model, std::size_t side)
{
  for(const auto& uv : model.soup.uv) {
    if(!(uv[0] >= 0 && uv[0] <= 1 && uv[1] >= 0 && uv[1] <= 1)) {
      return "a texture coordinate lies outside of the unit square";
    }
  }
  std::map<std::array<std::size_t, 3>, std::size_t> owner; // of page and sample
  for(std::size_t f = 0; f < model.material.size(); ++f) {
    std::array<std::array<double, 2>, 3> p;
    for(std::size_t c = 0; c < 3; ++c) {
      const auto& uv = model.soup.uv[model.soup.uv_faces[f][c]];
      p[c] = {uv[0] * double(side), uv[1] * double(side)};
    }
    const auto cross = [](const auto& a, const auto& b, double x, double y) {
      return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    };
    if(!(cross(p[0], p[1], p[2][0], p[2][1]) > 0)) {
      return "face " + std::to_string(f) + " is flipped";
    }
    const auto x = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto y = std::minmax({p[0][1], p[1][1], p[2][1]});
    for(std::size_t i = std::size_t(x.first); double(i) < x.second; ++i) {
      for(std::size_t j = std::size_t(y.first); double(j) < y.second; ++j) {
        const double u = double(i) + 0.5, v = double(j) + 0.5;
        if(cross(p[0], p[1], u, v) > 1e-6 && cross(p[1], p[2], u, v) > 1e-6
           && cross(p[2], p[0], u, v) > 1e-6
           && !owner.insert({{model.material[f], i, j}, f}).second) {
          return "face " + std::to_string(f) + " lies over another one";
        }
      }
    }
  }
  return "";
}

// The numbers of an accessor of a GLB file, whose place in the file is checked.
template <typename Number>
std::vector<Number> numbers_of(const std::string& glb, const Json& gltf, const Json& index)
{
  static const std::map<std::string, std::size_t> sizes
      = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const Json& accessor = gltf["accessors"][index.get<std::size_t>()];
  const std::size_t each = sizes.at(accessor["type"]) * sizeof(Number);
  const std::size_t bytes = accessor["count"].get<std::size_t>() * each;
  const Json& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  EXPECT_LE(bytes, view["byteLength"].get<std::size_t>());
  EXPECT_EQ(view.value("byteStride", each), each);
  const std::size_t begin = view.value("byteOffset", std::size_t(0));
  EXPECT_EQ(begin % 4, 0u);
  EXPECT_LE(begin + bytes, gltf["buffers"][0]["byteLength"].get<std::size_t>());
  std::uint32_t json_size;
  std::memcpy(&json_size, glb.data() + 12, 4);
  std::vector<Number> result(bytes / sizeof(Number));
  std::memcpy(result.data(), glb.data() + 28 + json_size + begin, bytes);
  return result;
}

struct Picture
{
  int width = 0, height = 0, channels = 0;
  bool has_16_bits = false;
  std::vector<std::uint16_t> samples;
};

inline Picture read_picture(const std::string& png)
{
  const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
  Picture result;
  stbi_us* samples = stbi_load_16_from_memory(bytes, int(png.size()), &result.width,
                                              &result.height, &result.channels, 0);
  EXPECT_NE(samples, nullptr) << stbi_failure_reason();
  if(samples != nullptr) {
    result.samples.assign(samples, samples + result.width * result.height * result.channels);
    stbi_image_free(samples);
  }
  result.has_16_bits = stbi_is_16_bit_from_memory(bytes, int(png.size())) != 0;
  return result;
}

// How far the boxes of the charts of a texture are from ones of whole texels.
inline double boxes_off_whole_texels(const Textured_soup& atlas, double texels)
{
  std::vector<std::size_t> chart(atlas.uv.size());
  std::iota(chart.begin(), chart.end(), std::size_t(0));
  for(bool has_changed = true; has_changed;) { // the smallest index goes around
    has_changed = false;
    for(const auto& face : atlas.uv_faces) {
      std::size_t least = chart[face[0]];
      for(const std::size_t v : face) {
        least = std::min(least, chart[v]);
      }
      for(const std::size_t v : face) {
        has_changed = has_changed || chart[v] != least;
        chart[v] = least;
      }
    }
  }
  double off = 0;
  for(std::size_t c = 0; c < chart.size(); ++c) {
    for(int k = 0; k < 2; ++k) {
      double low = atlas.uv[chart[c]][k], high = low;
      for(std::size_t v = 0; v < chart.size(); ++v) {
        if(chart[v] == chart[c]) {
          low = std::min(low, atlas.uv[v][k]);
          high = std::max(high, atlas.uv[v][k]);
        }
      }
      for(const double side : {texels * low, texels * high}) {
        off = std::max(off, std::abs(side - std::round(side)));
      }
    }
  }
  return off;
}

// Empty if a GLB file holds a model with that many faces, its tangents if it shall have some, and
// its pictures.
inline std::string error_in_glb(const std::string& glb, std::size_t faces, bool has_tangents)
{
  const Json gltf = json_of_glb(glb);
  std::size_t triangles = 0;
  for(const Json& primitive : gltf["meshes"][0]["primitives"]) {
    const Json& attributes = primitive["attributes"];
    const auto indices = numbers_of<std::uint32_t>(glb, gltf, primitive["indices"]);
    const auto points = numbers_of<float>(glb, gltf, attributes["POSITION"]);
    const auto normals = numbers_of<float>(glb, gltf, attributes["NORMAL"]);
    const auto uv = numbers_of<float>(glb, gltf, attributes["TEXCOORD_0"]);
    triangles += indices.size() / 3;
    const std::size_t n = points.size() / 3;
    if(normals.size() != 3 * n || uv.size() != 2 * n) {
      return "attributes of different lengths";
    }
    if(*std::max_element(indices.begin(), indices.end()) >= n) {
      return "an index out of range";
    }
    if(attributes.contains("TANGENT") != has_tangents) {
      return has_tangents ? "no tangents" : "tangents";
    }
    if(has_tangents) {
      const auto tangents = numbers_of<float>(glb, gltf, attributes["TANGENT"]);
      for(std::size_t v = 0; v < n; ++v) {
        const float *t = &tangents[4 * v], *m = &normals[3 * v];
        if(std::abs(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1) > 1e-4
           || std::abs(t[0] * m[0] + t[1] * m[1] + t[2] * m[2]) > 1e-4 || std::abs(t[3]) != 1) {
          return "tangent " + std::to_string(v) + " is no unit vector across the normal";
        }
      }
    }
  }
  for(const Json& image : gltf["images"]) {
    const Json& view = gltf["bufferViews"][image["bufferView"].get<std::size_t>()];
    std::uint32_t json_size;
    std::memcpy(&json_size, glb.data() + 12, 4);
    const std::string png = glb.substr(28 + json_size + view["byteOffset"].get<std::size_t>(),
                                       view["byteLength"].get<std::size_t>());
    if(image["mimeType"] != "image/png" || read_picture(png).width == 0) {
      return "an image that is no PNG file";
    }
  }
  return triangles == faces ? "" : std::to_string(triangles) + " triangles";
}

class Atlas : public Program
{
protected:
  Outcome call(const std::string& command, const std::string& input,
               const std::string& folder_name, const Texts& options = {}) const
  {
    Texts arguments{command, input, "-o", path(folder_name)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }

  Json call_well(const std::string& command, const std::string& input,
                 const std::string& folder_name, const Texts& options = {}) const
  {
    const Outcome outcome = call(command, input, folder_name, options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0
               ? Json::parse(read_file(folder / folder_name / "report.json"))
               : Json();
  }
};

} // namespace program_test

#endif // HLSCM_TEST_SUPPORT_PROGRAM_ATLASES_H
