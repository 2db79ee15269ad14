// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs `hlscm atlas` and `hlscm bake` on generated files.

#include <support/textured_soups.h>

#include <stb/stb_image.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>

#include <sys/resource.h>

namespace program_test {

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

double area(const Soup& soup, std::size_t f)
{
  const auto& face = soup.faces[f];
  const Point x = soup.points[face[1]] - soup.points[face[0]],
              y = soup.points[face[2]] - soup.points[face[0]];
  return length({x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]})
         / 2;
}

// A torus with waves on it, finer than a light model can show.
Soup wavy_torus(std::size_t n)
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

Soup tetrahedron()
{
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

Soup cube()
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

Obj_model read_model(const fs::path& path)
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
std::string error_in_texture(const Obj_model& model, std::size_t side)
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

// Charts of a model: parts that are connected across edges with the same texture coordinates.
std::vector<std::size_t> charts_of(const Textured_soup& soup)
{
  std::vector<std::size_t> parent(soup.uv.size());
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto find = [&](std::size_t i) {
    while(parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  for(const auto& face : soup.uv_faces) {
    parent[find(face[1])] = find(face[0]);
    parent[find(face[2])] = find(face[0]);
  }
  std::vector<std::size_t> charts;
  for(const auto& face : soup.uv_faces) {
    charts.push_back(find(face[0]));
  }
  return charts;
}

// The texels of a page, for a raster with this side, in which samples of the edges of a chart lie,
// and that chart.
using Texel_owners = std::map<std::array<std::size_t, 3>, std::size_t>;

// Empty if samples of the edges of two charts never lie in one texel, nor with fewer than `padding`
// between them, of a raster with this side.
std::string error_in_padding(const Obj_model& model, std::size_t side, std::size_t padding)
{
  const std::vector<std::size_t> chart = charts_of(model.soup);
  Texel_owners owners;
  for(std::size_t i = 0; i < 3 * chart.size(); ++i) {
    const auto& face = model.soup.uv_faces[i / 3];
    const auto &a = model.soup.uv[face[i % 3]], &b = model.soup.uv[face[(i + 1) % 3]];
    const double steps
        = 1 + std::ceil(4 * double(side) * std::hypot(b[0] - a[0], b[1] - a[1]));
    for(double k = 0; k <= steps; ++k) {
      const double u = a[0] + k / steps * (b[0] - a[0]), v = a[1] + k / steps * (b[1] - a[1]);
      const auto owner = owners.insert({{model.material[i / 3], std::size_t(u * double(side)),
                                         std::size_t(v * double(side))}, chart[i / 3]}).first;
      if(owner->second != chart[i / 3]) {
        return "two charts in one texel";
      }
    }
  }
  for(const auto& [texel, owner] : owners) {
    for(std::size_t i = 0; i <= 2 * padding; ++i) {
      for(std::size_t j = 0; j <= 2 * padding; ++j) {
        const auto other = owners.find({texel[0], texel[1] + i - padding, texel[2] + j - padding});
        if(other != owners.end() && other->second != owner) {
          return "two charts near texel " + std::to_string(texel[1]) + ", "
                 + std::to_string(texel[2]);
        }
      }
    }
  }
  return "";
}

// The length of the edges at which the texture coordinates of two faces differ.
double seam_length(const Textured_soup& soup)
{
  std::map<std::array<std::size_t, 2>, std::array<std::size_t, 2>> sides;
  const auto& faces = soup.surface.faces;
  for(std::size_t f = 0; f < faces.size(); ++f) {
    for(std::size_t c = 0; c < 3; ++c) {
      sides[{faces[f][c], faces[f][(c + 1) % 3]}]
          = {soup.uv_faces[f][c], soup.uv_faces[f][(c + 1) % 3]};
    }
  }
  double sum = 0;
  for(const auto& [edge, uv] : sides) {
    const auto other = sides.find({edge[1], edge[0]});
    if(edge[0] < edge[1] && other != sides.end()
       && other->second != std::array<std::size_t, 2>{uv[1], uv[0]}) {
      sum += length(soup.surface.points[edge[1]] - soup.surface.points[edge[0]]);
    }
  }
  return sum;
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

Picture read_picture(const std::string& png)
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

// Empty if a GLB file holds a model with that many faces, its tangents if it shall have some, and
// its pictures.
std::string error_in_glb(const std::string& glb, std::size_t faces, bool has_tangents)
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

// The picture of a texture of a GLB file.
Picture picture_of(const std::string& glb, const Json& gltf, const Json& texture)
{
  const Json& image = gltf["images"][gltf["textures"][texture["index"].get<std::size_t>()]["source"]
                                         .get<std::size_t>()];
  const Json& view = gltf["bufferViews"][image["bufferView"].get<std::size_t>()];
  std::uint32_t json_size;
  std::memcpy(&json_size, glb.data() + 12, 4);
  return read_picture(glb.substr(28 + json_size + view["byteOffset"].get<std::size_t>(),
                                 view["byteLength"].get<std::size_t>()));
}

double degrees_between(const Point& a, const Point& b)
{
  const double cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (length(a) * length(b));
  return 57.29577951308232 * std::acos(std::clamp(cosine, -1., 1.));
}

// The mean angles, with and without the normal map, between the normals of a torus and those that
// glTF's rules give in the middles of the triangles of a light model of it.
std::array<double, 2> normal_errors(const std::string& glb)
{
  const Json gltf = json_of_glb(glb);
  std::array<double, 2> sums{};
  std::size_t number = 0;
  for(const Json& primitive : gltf["meshes"][0]["primitives"]) {
    const Json& attributes = primitive["attributes"];
    const auto indices = numbers_of<std::uint32_t>(glb, gltf, primitive["indices"]);
    const auto points = numbers_of<float>(glb, gltf, attributes["POSITION"]);
    const auto normals = numbers_of<float>(glb, gltf, attributes["NORMAL"]);
    const auto tangents = numbers_of<float>(glb, gltf, attributes["TANGENT"]);
    const auto uv = numbers_of<float>(glb, gltf, attributes["TEXCOORD_0"]);
    const Json& material = gltf["materials"][primitive["material"].get<std::size_t>()];
    const Picture map = picture_of(glb, gltf, material["normalTexture"]);
    for(std::size_t i = 0; i < indices.size(); i += 3) {
      const auto mean = [&](const std::vector<float>& values, std::size_t each, std::size_t k) {
        return (values[indices[i] * each + k] + values[indices[i + 1] * each + k]
                + values[indices[i + 2] * each + k])
               / 3.;
      };
      Point p, n, t, sample;
      for(std::size_t k = 0; k < 3; ++k) {
        p[k] = mean(points, 3, k);
        n[k] = mean(normals, 3, k);
        t[k] = mean(tangents, 4, k);
      }
      const double w = mean(tangents, 4, 3), ring = std::hypot(p[0], p[1]);
      const Point b{w * (n[1] * t[2] - n[2] * t[1]), w * (n[2] * t[0] - n[0] * t[2]),
                    w * (n[0] * t[1] - n[1] * t[0])};
      const std::size_t x = std::size_t(mean(uv, 2, 0) * map.width),
                        y = std::size_t(mean(uv, 2, 1) * map.height); // from the top
      for(std::size_t k = 0; k < 3; ++k) {
        sample[k] = 2 * map.samples[3 * (y * std::size_t(map.width) + x) + k] / 65535. - 1;
      }
      Point mapped;
      for(std::size_t k = 0; k < 3; ++k) {
        mapped[k] = sample[0] * t[k] + sample[1] * b[k] + sample[2] * n[k];
      }
      const Point exact{p[0] - 2 * p[0] / ring, p[1] - 2 * p[1] / ring, p[2]};
      sums[0] += degrees_between(mapped, exact);
      sums[1] += degrees_between(n, exact);
      ++number;
    }
  }
  return {sums[0] / double(number), sums[1] / double(number)};
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

TEST_F(Atlas, is_what_the_report_says)
{
  const Soup surface = wavy_torus(40);
  const Json report = call_well("atlas", write("in.off", off(surface)), "out",
                                {"--ply", "--texture", "512", "--pictures", path("pictures")});
  ASSERT_TRUE(report.is_object());
  for(const char* name : {"out/atlas.obj", "out/atlas.mtl", "out/atlas.glb", "out/atlas.ply",
                          "out/checker.png", "pictures/charts.png", "pictures/checkerboard.png"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  const Obj_model model = read_model(folder / "out/atlas.obj");
  EXPECT_TRUE(model.soup.surface.points == surface.points);
  EXPECT_TRUE(model.soup.surface.faces == surface.faces);
  EXPECT_EQ(error_in_texture(model, 512), "");
  EXPECT_EQ(error_in_glb(read_file(folder / "out/atlas.glb"), surface.faces.size(), false), "");

  EXPECT_EQ(report["faces"], surface.faces.size());
  EXPECT_EQ(report["vertices"], surface.points.size());
  EXPECT_EQ(report["texture_vertices"], model.soup.uv.size());
  EXPECT_EQ(report["flips"], 0);
  EXPECT_EQ(report["overlapping_texels"], 0);
  EXPECT_NEAR(report["seam_length"], seam_length(model.soup), 1e-6);
  EXPECT_GT(report["distortion"]["stretch_L2"], 0.999);
  std::multiset<std::size_t> faces_there, faces_said;
  std::map<std::size_t, std::pair<std::size_t, double>> charts; // faces and area
  const std::vector<std::size_t> chart = charts_of(model.soup);
  double all = 0, in_charts = 0, uv_area = 0;
  for(std::size_t f = 0; f < chart.size(); ++f) {
    ++charts[chart[f]].first;
    all += area(surface, f);
    Soup flat_face{{}, {{0, 1, 2}}};
    for(const std::size_t w : model.soup.uv_faces[f]) {
      flat_face.points.push_back({model.soup.uv[w][0], model.soup.uv[w][1], 0});
    }
    uv_area += area(flat_face, 0);
  }
  for(const auto& entry : charts) {
    faces_there.insert(entry.second.first);
  }
  for(const Json& entry : report["charts"]) {
    faces_said.insert(entry["faces"].get<std::size_t>());
    in_charts += entry["area"].get<double>();
    EXPECT_EQ(entry["page"], 0);
    EXPECT_TRUE(entry["one_to_one"].get<bool>());
  }
  EXPECT_EQ(faces_there, faces_said);
  EXPECT_EQ(report["number_of_charts"], charts.size());
  EXPECT_NEAR(in_charts, all, 1e-6 * all);
  EXPECT_NEAR(report["utilisation"], uv_area, 1e-6);
  for(const Json& file : report["files"]) {
    EXPECT_EQ(fs::file_size(file["name"].get<std::string>()), file["bytes"]);
  }
}

TEST_F(Atlas, is_within_the_bound_that_is_asked_for)
{
  const std::string in = write("in.off", off(wavy_torus(16)));
  const Json usual = call_well("atlas", in, "usual", {"--texture", "256"});
  const Json strict = call_well("atlas", in, "strict",
                                {"--texture", "256", "--max-area-scale", "1.5",
                                 "--max-quasi-conformal", "1.25"});
  const Json few = call_well("atlas", in, "few",
                             {"--texture", "256", "--max-area-scale", "1.5", "--max-charts", "4"});
  ASSERT_TRUE(usual.is_object() && strict.is_object() && few.is_object());
  for(const auto& [report, area_scale, quasi_conformal] :
      {std::make_tuple(usual, 4., 2.), std::make_tuple(strict, 1.5, 1.25)}) {
    for(const Json& chart : report["charts"]) {
      EXPECT_LE(chart["area_scale"].get<double>(), area_scale);
      EXPECT_LE(chart["quasi_conformal"].get<double>(), quasi_conformal);
    }
  }
  EXPECT_GT(strict["number_of_charts"], usual["number_of_charts"]);
  EXPECT_LE(few["number_of_charts"], 4);
  for(const char* name : {"usual", "strict", "few"}) {
    EXPECT_EQ(error_in_texture(read_model(folder / name / "atlas.obj"), 256), "") << name;
  }
}

TEST_F(Atlas, is_mapped_and_packed_as_is_asked_for)
{
  const std::string in = write("in.off", off(wavy_torus(16)));
  std::map<std::string, Json> reports;
  for(Texts options : std::vector<Texts>{
          {"--packer", "raster"}, {"--packer", "horizon"}, {"--packing-time", "0.05"},
          {"--method", "border-first"}, {"--method", "spectral"}, {"--method", "hlscm"},
          {"--method", "cascadic"}}) {
    const std::string name = options[0] + " " + options[1];
    options.insert(options.end(), {"--texture", "256"});
    const Json report = call_well("atlas", in, "out", options);
    ASSERT_TRUE(report.is_object()) << name;
    const Obj_model model = read_model(folder / "out/atlas.obj");
    EXPECT_EQ(error_in_texture(model, 256), "") << name;
    EXPECT_EQ(error_in_padding(model, 256, 2), "") << name; // by default
    for(const Json& chart : report["charts"]) {
      EXPECT_TRUE(chart["one_to_one"].get<bool>()) << name;
      EXPECT_LE(chart["area_scale"].get<double>(), 4) << name;
    }
    reports[name] = report;
  }
  const Json& usual = reports["--packer raster"];
  EXPECT_EQ(usual["charts"], reports["--method border-first"]["charts"]);
  EXPECT_NE(usual["charts"], reports["--method spectral"]["charts"]);
  EXPECT_NE(usual["charts"], reports["--method hlscm"]["charts"]);
  const auto used = [&reports](const char* options) {
    return reports[options]["utilisation"].get<double>();
  };
  constexpr double rounding = 1e-9;
  EXPECT_LE(used("--packer horizon"), used("--packer raster") + rounding);
  EXPECT_GE(used("--packing-time 0.05"), used("--packer raster") - rounding);
}

TEST_F(Atlas, keeps_charts_apart_on_smaller_copies_of_the_texture)
{
  const std::string in = write("in.off", off(wavy_torus(12)));
  ASSERT_TRUE(call_well("atlas", in, "padded", {"--texture", "256", "--padding", "9"}).is_object());
  EXPECT_EQ(error_in_padding(read_model(folder / "padded/atlas.obj"), 256, 9), "");
  ASSERT_TRUE(call_well("atlas", in, "mip",
                        {"--texture", "256", "--padding", "1", "--mip-levels", "3"}).is_object());
  EXPECT_EQ(error_in_padding(read_model(folder / "mip/atlas.obj"), 256 / 8, 1), "");
  const Outcome full = call("atlas", in, "none", {"--texture", "16", "--padding", "9"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(error_in_message(full.err, in, {"do not fit on 1 page"}), "");
}

TEST_F(Atlas, fills_several_pages)
{
  const Soup surface = wavy_torus(16);
  const std::string in = write("in.off", off(surface));
  const Texts bound{"--texture", "128", "--max-area-scale", "1.5", "--pages"};
  const auto with_pages = [&](const std::string& pages) {
    Texts options = bound;
    options.push_back(pages);
    return call_well("atlas", in, "out_" + pages, options);
  };
  const Json one = with_pages("1"), report = with_pages("3");
  ASSERT_TRUE(one.is_object() && report.is_object());
  EXPECT_EQ(report["pages"], 3);
  EXPECT_GT(report["texels_per_unit"], one["texels_per_unit"]);
  std::set<std::size_t> pages;
  for(const Json& chart : report["charts"]) {
    pages.insert(chart["page"].get<std::size_t>());
  }
  EXPECT_EQ(pages, (std::set<std::size_t>{0, 1, 2}));
  const Obj_model model = read_model(folder / "out_3/atlas.obj");
  EXPECT_EQ(std::set<std::size_t>(model.material.begin(), model.material.end()), pages);
  EXPECT_EQ(error_in_texture(model, 128), "");
  EXPECT_EQ(error_in_padding(model, 128, 2), "");
  const std::string mtl = read_file(folder / "out_3/atlas.mtl");
  for(const char* material : {"newmtl page_1\n", "newmtl page_2\n", "newmtl page_3\n"}) {
    EXPECT_NE(mtl.find(material), std::string::npos) << mtl;
  }
  const std::string glb = read_file(folder / "out_3/atlas.glb");
  EXPECT_EQ(error_in_glb(glb, surface.faces.size(), false), "");
  const Json gltf = json_of_glb(glb);
  EXPECT_EQ(gltf["materials"].size(), 3u);
  EXPECT_EQ(gltf["images"].size(), 1u); // one checkerboard for all
}

TEST_F(Atlas, takes_charts_that_are_given)
{
  // Upper and lower half of a torus are rings, which are cut to disks
  const Soup surface = wavy_torus(20);
  std::string patches;
  for(const auto& face : surface.faces) {
    double z = 0;
    for(const std::size_t v : face) {
      z += surface.points[v][2];
    }
    patches += z > 0 ? "7\n" : " -3\r\n";
  }
  const std::string in = write("in.off", off(surface));
  const Json halves = call_well("atlas", in, "halves", {"--charts", write("patches", patches)});
  const Obj_model model = read_model(folder / "halves/atlas.obj");
  EXPECT_EQ(error_in_texture(model, 512), "");
  const std::vector<std::size_t> chart = charts_of(model.soup);
  std::map<std::size_t, std::set<char>> labels;
  std::istringstream lines(patches);
  for(std::size_t f = 0; f < chart.size(); ++f) {
    int label;
    lines >> label;
    labels[chart[f]].insert(label > 0 ? '+' : '-');
  }
  for(const auto& entry : labels) {
    EXPECT_EQ(entry.second.size(), 1u); // no chart crosses a border of patches
  }
  // The seams of the atlas are charts for the same surface
  const Json again
      = call_well("atlas", path("halves/atlas.obj"), "again", {"--charts", "uv"});
  EXPECT_NEAR(again["seam_length"], halves["seam_length"], 1e-9);
  const Json disk = call_well("atlas", in, "disk", {"--one-disk"});
  EXPECT_GE(disk["number_of_charts"], 1);
  EXPECT_EQ(error_in_texture(read_model(folder / "disk/atlas.obj"), 512), "");

  const std::size_t n = surface.faces.size();
  for(const auto& [bytes, what] : std::map<std::string, std::string>{
          {patches.substr(0, patches.rfind("\n", patches.size() - 2) + 1),
           std::to_string(n - 1) + " numbers for " + std::to_string(n) + " faces"},
          {"1\ntwo\n", "line 2 is not a whole number"},
          {"1\n\n", "line 2 is not a whole number"}}) {
    const std::string bad = write("bad", bytes);
    const Outcome outcome = call("atlas", in, "none", {"--charts", bad});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, bad, {what}), "");
  }
  const Outcome no_uv = call("atlas", in, "none", {"--charts", "uv"});
  EXPECT_EQ(error_in_message(no_uv.err, in, {"no texture coordinates"}), "");
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST_F(Atlas, takes_small_and_broken_up_surfaces)
{
  Soup parts = cube();
  for(const Soup& other : {moved(tetrahedron(), 1, 5), moved(grid(6, hilly), 1, -5)}) {
    const std::size_t first = parts.points.size();
    parts.points.insert(parts.points.end(), other.points.begin(), other.points.end());
    for(auto face : other.faces) {
      for(std::size_t& v : face) {
        v += first;
      }
      parts.faces.push_back(face);
    }
  }
  Soup triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for(const Soup& soup : {triangle, tetrahedron(), cube(), parts, band(12, false),
                          moved(torus(8, true), 1e-12, 0), moved(torus(8, false), 1e12, 0)}) {
    const std::string in = write("in.off", off(soup));
    const Json report = call_well("atlas", in, "out", {"--texture", "128"});
    ASSERT_TRUE(report.is_object()) << soup.faces.size();
    const Obj_model model = read_model(folder / "out/atlas.obj");
    EXPECT_EQ(model.soup.surface.faces.size(), soup.faces.size());
    EXPECT_EQ(error_in_texture(model, 128), "") << soup.faces.size();
    EXPECT_EQ(report["flips"], 0);
    const Json light = call_well("bake", in, "light", {"--texture", "64", "--faces", "6"});
    ASSERT_TRUE(light.is_object()) << soup.faces.size();
    EXPECT_LE(light["light"]["faces"], report["faces"]);
  }
}

TEST_F(Atlas, leaves_isolated_vertices_out)
{
  Soup soup = cube();
  soup.points.insert(soup.points.begin() + 3, {9, 9, 9});
  for(auto& face : soup.faces) {
    for(std::size_t& v : face) {
      v += v >= 3 ? 1 : 0;
    }
  }
  const Outcome outcome = call("atlas", write("in.off", off(soup)), "out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("vertices of no face are left out: 1"), std::string::npos);
  const Obj_model model = read_model(folder / "out/atlas.obj");
  EXPECT_TRUE(model.soup.surface.points == cube().points);
  EXPECT_TRUE(model.soup.surface.faces == cube().faces);
}

TEST_F(Atlas, of_a_light_model_shows_the_detail_in_its_normal_map)
{
  const Soup surface = wavy_torus(60);
  const std::string in = write("in.off", off(surface));
  const Json report = call_well("bake", in, "out",
                                {"--faces", "1500", "--texture", "512", "--displacement",
                                 "--pictures", path("pictures")});
  ASSERT_TRUE(report.is_object());
  for(const char* name : {"out/atlas.obj", "out/light.mtl", "pictures/charts.png",
                          "pictures/bake.png", "pictures/closeup.png"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  const Json& light = report["light"];
  const Obj_model model = read_model(folder / "out/light.obj");
  EXPECT_EQ(light["faces"], model.soup.surface.faces.size());
  EXPECT_EQ(light["vertices"], model.soup.surface.points.size());
  EXPECT_EQ(light["texture_vertices"], model.soup.uv.size());
  EXPECT_LE(light["faces"], 1500);
  EXPECT_GE(light["faces"], 1498);
  // Its corners are corners of the atlas
  const Textured_soup atlas = read_model(folder / "out/atlas.obj").soup;
  std::set<std::array<double, 5>> corners;
  const auto corner = [](const Textured_soup& soup, std::size_t f, std::size_t c) {
    const Point& p = soup.surface.points[soup.surface.faces[f][c]];
    const auto& uv = soup.uv[soup.uv_faces[f][c]];
    return std::array<double, 5>{p[0], p[1], p[2], uv[0], uv[1]};
  };
  for(std::size_t i = 0; i < 3 * atlas.uv_faces.size(); ++i) {
    corners.insert(corner(atlas, i / 3, i % 3));
  }
  for(std::size_t i = 0; i < 3 * model.soup.uv_faces.size(); ++i) {
    EXPECT_EQ(corners.count(corner(model.soup, i / 3, i % 3)), 1u);
  }
  const std::string glb = read_file(folder / "out/light.glb");
  EXPECT_EQ(error_in_glb(glb, model.soup.surface.faces.size(), true), "");
  const Json gltf = json_of_glb(glb);
  EXPECT_TRUE(gltf["materials"][0].contains("normalTexture"));
  const Picture normals = read_picture(read_file(folder / "out/normal.png"));
  EXPECT_EQ(normals.width, 512);
  EXPECT_EQ(normals.height, 512);
  EXPECT_EQ(normals.channels, 3);
  EXPECT_FALSE(normals.has_16_bits);
  for(std::size_t i = 0; i < normals.samples.size(); i += 3) {
    Point n;
    for(std::size_t k = 0; k < 3; ++k) {
      n[k] = 2 * normals.samples[i + k] / 65535. - 1;
    }
    ASSERT_NEAR(length(n), 1, 0.02);
  }
  const Picture heights = read_picture(read_file(folder / "out/displacement.png"));
  EXPECT_EQ(heights.channels, 1);
  EXPECT_TRUE(heights.has_16_bits);
  EXPECT_EQ(*std::min_element(heights.samples.begin(), heights.samples.end()), 0);
  EXPECT_EQ(*std::max_element(heights.samples.begin(), heights.samples.end()), 65535);
  const Json& angles = light["normal_error_degrees"];
  EXPECT_LT(angles["with_map"]["mean"].get<double>(),
            0.5 * angles["without_map"]["mean"].get<double>());
  EXPECT_LT(angles["with_map"]["quantile_95"], angles["without_map"]["quantile_95"]);
  EXPECT_GE(light["distance"]["max"], light["distance"]["mean"]);
}

// A viewer sees the torus itself where the light model has edges.
TEST_F(Atlas, of_a_light_model_is_lit_by_the_rules_of_gltf)
{
  const Soup surface = torus(90, false);
  for(const char* pages : {"1", "2"}) {
    const Json report = call_well("bake", write("in.off", off(surface)), "out",
                                  {"--faces", "300", "--texture", "512", "--pages", pages});
    ASSERT_TRUE(report.is_object());
    const std::string glb = read_file(folder / "out/light.glb");
    const auto [mapped, plain] = normal_errors(glb);
    EXPECT_LT(mapped, 0.4 * plain) << pages;
    EXPECT_LT(mapped, 3) << pages;
    // The same model in both formats; v goes down in glTF
    const Obj_model model = read_model(folder / "out/light.obj");
    EXPECT_EQ(error_in_texture(model, 512), "");
    std::set<std::array<float, 5>> in_obj, in_glb;
    for(std::size_t f = 0; f < model.soup.uv_faces.size(); ++f) {
      for(std::size_t c = 0; c < 3; ++c) {
        const Point& p = model.soup.surface.points[model.soup.surface.faces[f][c]];
        const auto& uv = model.soup.uv[model.soup.uv_faces[f][c]];
        in_obj.insert({float(p[0]), float(p[1]), float(p[2]), float(uv[0]), float(1 - uv[1])});
      }
    }
    const Json gltf = json_of_glb(glb);
    const Json& attributes = gltf["meshes"][0]["primitives"][0]["attributes"];
    const auto points = numbers_of<float>(glb, gltf, attributes["POSITION"]);
    const auto uv = numbers_of<float>(glb, gltf, attributes["TEXCOORD_0"]);
    for(std::size_t v = 0; 2 * v < uv.size(); ++v) {
      in_glb.insert({points[3 * v], points[3 * v + 1], points[3 * v + 2], uv[2 * v],
                     uv[2 * v + 1]});
    }
    EXPECT_TRUE(in_obj == in_glb) << pages;
    const std::size_t number = report["pages"];
    EXPECT_EQ(gltf["materials"].size(), number);
    EXPECT_EQ(fs::exists(folder / "out/normal_2.png"), number == 2);
  }
}

TEST_F(Atlas, is_the_same_for_any_number_of_threads)
{
  const std::string in = write("in.off", off(wavy_torus(24)));
  std::map<std::string, std::string> first;
  for(const char* threads : {"1", "2"}) {
    ASSERT_TRUE(call_well("bake", in, "out", {"--error", "0.5%", "--texture", "256", "--threads",
                                              threads, "--pictures", path("out")}).is_object());
    for(const char* name : {"atlas.obj", "atlas.glb", "light.obj", "light.glb", "normal.png",
                            "charts.png", "checkerboard.png", "bake.png", "closeup.png"}) {
      const std::string bytes = read_file(folder / "out" / name);
      EXPECT_FALSE(bytes.empty()) << name;
      EXPECT_TRUE(first.emplace(name, bytes).first->second == bytes) << name;
    }
  }
}

TEST_F(Atlas, of_a_light_model_has_the_formats_that_are_asked_for)
{
  const std::string in = write("in.obj", obj(cut_torus(20, 2)));
  ASSERT_EQ(call("atlas", in, "first", {"--texture", "128"}).exit_code, 0);
  const Outcome outcome = call(
      "bake", in, "out",
      {"--faces", "300", "--texture", "128", "--bits", "16", "--space", "object", "--colors",
       path("first/checker.png"), "--ply", "--samples", "1", "--report", path("other.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(Json::parse(read_file(folder / "other.json")).is_object());
  EXPECT_FALSE(fs::exists(folder / "out/report.json"));
  const Picture normals = read_picture(read_file(folder / "out/normal.png"));
  EXPECT_TRUE(normals.has_16_bits);
  for(std::size_t i = 0; i < normals.samples.size(); i += 3) {
    Point n;
    for(std::size_t k = 0; k < 3; ++k) {
      n[k] = 2 * normals.samples[i + k] / 65535. - 1;
    }
    ASSERT_NEAR(length(n), 1, 1e-4);
  }
  const Json gltf = json_of_glb(read_file(folder / "out/light.glb"));
  EXPECT_FALSE(gltf["materials"][0].contains("normalTexture")); // glTF has no such space
  EXPECT_TRUE(gltf["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
  const Picture colours = read_picture(read_file(folder / "out/color.png"));
  EXPECT_EQ(colours.channels, 3);
  EXPECT_FALSE(colours.has_16_bits);
  EXPECT_TRUE(fs::exists(folder / "out/light.ply"));
  const std::string mtl = read_file(folder / "out/light.mtl");
  EXPECT_NE(mtl.find("map_Kd color.png"), std::string::npos) << mtl;
  EXPECT_EQ(mtl.find("norm"), std::string::npos) << mtl;
}

TEST_F(Atlas, bakes_for_a_model_of_any_origin)
{
  // The light model is an atlas of a coarser mesh of the same torus
  const std::string light = write("light.off", off(wavy_torus(20)));
  ASSERT_EQ(call("atlas", light, "coarse", {"--texture", "256"}).exit_code, 0);
  const std::string in = write("in.off", off(wavy_torus(60)));
  const Json report
      = call_well("bake", in, "out",
                  {"--target", path("coarse/atlas.obj"), "--texture", "256", "--displacement",
                   "--pictures", path("out")});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["light"]["faces"], 2 * 20 * 40);
  EXPECT_FALSE(report.contains("charts"));
  EXPECT_FALSE(fs::exists(folder / "out/atlas.obj"));
  EXPECT_EQ(error_in_glb(read_file(folder / "out/light.glb"), 2 * 20 * 40, true), "");
  const Json& angles = report["light"]["normal_error_degrees"];
  EXPECT_LT(angles["with_map"]["mean"], angles["without_map"]["mean"]);
  const Outcome no_uv = call("bake", in, "none", {"--target", light});
  EXPECT_EQ(no_uv.exit_code, 1);
  EXPECT_EQ(error_in_message(no_uv.err, light, {"no texture coordinates"}), "");
  const std::string far = write("far.off", off(moved(wavy_torus(20), 1, 1000)));
  const Outcome elsewhere = call("bake", far, "none", {"--target", path("coarse/atlas.obj")});
  EXPECT_EQ(elsewhere.exit_code, 1);
  EXPECT_EQ(error_in_message(elsewhere.err, far, {"no point of it is where the light model is"}),
            "");
  EXPECT_FALSE(fs::exists(folder / "none"));
}

// What options do is in the other tests; here, that each that is listed is known.
TEST_F(Atlas, has_the_options_that_help_lists)
{
  const std::string in = write("in.obj", obj(cut_torus(8, 2)));
  ASSERT_EQ(call("atlas", in, "first", {"--texture", "64"}).exit_code, 0);
  const std::vector<Texts> of_both{
      {"--texture", "32", "--padding", "0", "--mip-levels", "1", "--max-area-scale", "2",
       "--max-quasi-conformal", "1.5", "--max-charts", "3", "--pages", "2", "--packer", "horizon",
       "--method", "spectral", "--threads", "1", "--ply", "--pictures", path("pictures")},
      {"--texture", "64", "--charts", "uv", "--packer", "raster", "--packing-time", "0.001",
       "--method", "border-first", "--report", path("other.json")},
      {"--texture", "64", "--one-disk", "--method", "cascadic", "--quiet"}};
  const std::vector<Texts> of_bake{
      {"--faces", "50", "--samples", "3", "--space", "object", "--bits", "16", "--displacement"},
      {"--error", "1%", "--space", "tangent", "--bits", "8", "--colors", path("first/checker.png")},
      {"--target", path("first/atlas.obj")}};
  for(const std::string command : {"atlas", "bake"}) {
    std::set<std::string> listed, known{"--help", "--output"};
    for(std::size_t i = 0; i < of_both.size(); ++i) {
      Texts options = of_both[i];
      if(command == "bake") {
        options.insert(options.end(), of_bake[i].begin(), of_bake[i].end());
      }
      const Outcome outcome = call(command, in, "out", options);
      EXPECT_EQ(outcome.exit_code, 0) << command << " " << i << ": " << outcome.err;
      EXPECT_EQ(outcome.out.empty(), options[2] == "--one-disk") << outcome.out;
      std::copy_if(options.begin(), options.end(), std::inserter(known, known.end()),
                   [](const std::string& text) { return text.rfind("--", 0) == 0; });
    }
    std::istringstream help(run({command, "--help"}).out);
    for(std::string line; std::getline(help, line);) {
      const std::size_t option = line.find("--");
      if(line.rfind("  -", 0) == 0 && option != std::string::npos) {
        listed.insert(line.substr(option, line.find_first_of(" \n", option) - option));
      }
    }
    EXPECT_EQ(listed, known) << command;
  }
}

TEST_F(Atlas, refuses_what_it_cannot_do)
{
  const std::string good = write("in.off", off(cube()));
  const std::vector<std::pair<std::string, Texts>> all_wrong
      = {{"atlas", {"--texture", "0"}},       {"atlas", {"--texture", "x"}},
         {"atlas", {"--pages", "0"}},         {"atlas", {"--max-area-scale", "1"}},
         {"atlas", {"--method", "best"}},     {"atlas", {"--one-disk", "--charts", "uv"}},
         {"atlas", {"--faces", "7"}},         {"bake", {}},
         {"bake", {"--faces", "0"}},          {"bake", {"--faces", "7", "--error", "1%"}},
         {"bake", {"--error", "-1"}},         {"bake", {"--faces", "7", "--bits", "12"}},
         {"bake", {"--faces", "7", "--space", "world"}},
         {"bake", {"--faces", "7", "--samples", "0"}}};
  for(const auto& [command, options] : all_wrong) {
    const Outcome outcome = call(command, good, "none", options);
    EXPECT_EQ(outcome.exit_code, 2) << command << (options.empty() ? "" : " " + options[0]);
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
  }
  EXPECT_EQ(run({"atlas", good}).exit_code, 2);
  const Soup square = grid(3, flat);
  const std::map<std::string, std::string> bad
      = {{off(with_face(square, {0, 3, 4})), "same vertices"},
         {off(with_face(with_face(cube(), {0, 1, 7}), {1, 0, 6})), "more than two faces"},
         {off(with_face(Soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                             {{0, 1, 2}}}, {0, 3, 4})), "separate fans"},
         {off(band(7, true)), "one side only"},
         {off(moved(cube(), 1e39, 0)), "too large for the numbers of 32 bits"},
         {off(Soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}}), "corners"},
         {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "not finite"},
         {"", "empty"}};
  for(const auto& [bytes, what] : bad) {
    for(const char* command : {"atlas", "bake"}) {
      const std::string in = write("bad.off", bytes);
      const Outcome outcome
          = call(command, in, "none",
                 std::string(command) == "bake" ? Texts{"--faces", "2"} : Texts{});
      EXPECT_EQ(outcome.exit_code, 1) << what;
      EXPECT_EQ(error_in_message(outcome.err, in, {}), "") << what;
    }
  }
  EXPECT_EQ(call("bake", good, "none", {"--faces", "2", "--colors", good}).exit_code, 1);
  const std::string textured = write("textured.obj", obj(cut_torus(6, 2)));
  const Outcome no_picture
      = call("bake", textured, "none", {"--faces", "50", "--colors", good, "--texture", "64"});
  EXPECT_EQ(no_picture.exit_code, 1);
  EXPECT_EQ(error_in_message(no_picture.err, good, {"cannot be read as a picture"}), "");
  const Outcome missing = call("atlas", path("missing.off"), "none");
  EXPECT_EQ(error_in_message(missing.err, path("missing.off"), {"no such file"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"bad.off", "in.off", "textured.obj"}));
}

TEST_F(Atlas, loses_no_file_when_it_fails)
{
  fs::create_directory(folder / "out");
  write("out/atlas.obj", "was here before");
  write("out/mine", "and so was this");
  const Outcome failed = call("bake", write("bad.off", off(band(7, true))), "out",
                              {"--faces", "3"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_EQ(read_file(folder / "out/atlas.obj"), "was here before");
  EXPECT_EQ(names(), (std::set<std::string>{"bad.off", "out", "out/atlas.obj", "out/mine"}));
  // The input is never an output
  const std::string in = write("out/light.obj", obj(cube()));
  const Outcome over_itself = call("bake", in, "out", {"--faces", "3"});
  EXPECT_EQ(over_itself.exit_code, 1);
  EXPECT_EQ(error_in_message(over_itself.err, in, {"the output is the input"}), "");
  EXPECT_EQ(read_file(in), obj(cube()));
  EXPECT_EQ(call("atlas", in, "out").exit_code, 0);
  EXPECT_NE(read_file(folder / "out/atlas.obj"), "was here before");
  EXPECT_EQ(read_file(folder / "out/mine"), "and so was this");
}

TEST_F(Atlas, refuses_unwritable_outputs_before_it_begins)
{
  const std::string in = write("in.off", off(cube()));
  const std::string file = write("file", "was here before");
  const std::string patches = write("out.patches", std::string(24, '1'));
  struct Case
  {
    std::string folder;
    Texts options;
    std::string name, words;
  };
  const std::vector<Case> cases{
      {file, {}, file, "this is a file"},
      {path("file/out"), {}, path("file/out"), "cannot be created"},
      {"/proc/none", {}, "/proc/none", "cannot be created"},
      {path("out"), {"--report", path("no/r.json")}, path("no/r.json"), "cannot be written"},
      {path("out"), {"--report", path("out/atlas.obj")}, path("out/atlas.obj"), "two outputs"},
      {path("out"), {"--report", in}, in, "the output is the input"},
      {path("out"), {"--charts", patches, "--report", patches}, patches, "the output is the input"},
      {path("out"), {"--pictures", file}, file, "this is a file"},
      {path("out"), {"--pictures", path("file/p")}, path("file/p"), "cannot be created"}};
  for(const Case& c : cases) {
    for(const std::string command : {"atlas", "bake"}) {
      Texts arguments{command, in, "-o", c.folder};
      arguments.insert(arguments.end(), c.options.begin(), c.options.end());
      if(command == "bake") {
        arguments.insert(arguments.end(), {"--faces", "4"});
      }
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 1) << c.name;
      EXPECT_EQ(error_in_message(outcome.err, c.name, {c.words}), "");
    }
  }
  EXPECT_EQ(names(), (std::set<std::string>{"file", "in.off", "out.patches"}));
  EXPECT_EQ(read_file(in), off(cube()));
  EXPECT_EQ(read_file(file), "was here before");
}

TEST_F(Atlas, leaves_nothing_when_the_disk_is_full)
{
  const std::string in = write("in.off", off(wavy_torus(20)));
  const auto limit_file_size = [] {
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  for(Texts arguments : {Texts{"atlas"}, Texts{"bake", "--faces", "400"}}) {
    arguments.insert(arguments.end(), {in, "-o", path("out"), "--texture", "128"});
    const Outcome outcome = finish(start(arguments, limit_file_size));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, path("out/atlas.obj"), {"writing failed"}), "");
    EXPECT_EQ(names(), std::set<std::string>{"in.off"});
  }
}

TEST_F(Atlas, leaves_nothing_when_it_is_interrupted)
{
  const std::string in = write("in.off", off(wavy_torus(250)));
  for(const Texts& command : {Texts{"atlas"}, Texts{"bake", "--faces", "2000"}}) {
    for(const int milliseconds : {20, 300, 1500}) {
      Texts arguments = command;
      arguments.insert(arguments.end(), {in, "-o", path("out"), "--pictures", path("pictures")});
      const pid_t child = start(arguments);
      usleep(useconds_t(1000 * milliseconds));
      kill(child, milliseconds == 300 ? SIGTERM : SIGINT);
      const Outcome outcome = finish(child);
      if(outcome.exit_code == -SIGINT) {
        continue; // before the program listened
      }
      EXPECT_EQ(outcome.exit_code, 1) << milliseconds;
      EXPECT_EQ(outcome.err, "hlscm: cancelled\n");
      EXPECT_LT(outcome.seconds, 1.5);
      EXPECT_EQ(names(), std::set<std::string>{"in.off"}) << command[0] << " " << milliseconds;
    }
  }
}

} // namespace program_test
