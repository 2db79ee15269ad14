// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs `hlscm atlas` and `hlscm bake` on generated files: light models and what is baked for them.

#include <support/program_atlases.h>
#include <support/textured_soups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace program_test {

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

} // namespace program_test
