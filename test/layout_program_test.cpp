// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs `hlscm atlas` on what a person has already: texture coordinates and densities; and with wishes
// for the layout.

#include <support/program_atlases.h>
#include <support/textured_soups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace program_test {

// --- Surfaces and files

// Flat squares of n x n vertices, `count` of them apart from each other.
Soup squares(std::size_t n, std::size_t count)
{
  Soup result;
  for(std::size_t i = 0; i < count; ++i) {
    const Soup one = moved(grid(n, flat), 1, 2 * double(i));
    const std::size_t first = result.points.size();
    result.points.insert(result.points.end(), one.points.begin(), one.points.end());
    for(std::vector<std::size_t> face : one.faces) {
      for(std::size_t& v : face) {
        v += first;
      }
      result.faces.push_back(face);
    }
  }
  return result;
}

// The same with texture coordinates, the i-th square scaled by factor[i], all in one corner.
Textured_soup textured_squares(std::size_t n, const std::vector<double>& factor)
{
  Textured_soup result;
  result.surface = squares(n, factor.size());
  for(std::size_t v = 0; v < result.surface.points.size(); ++v) {
    const std::size_t square = v / (n * n);
    const double shift = 2 * double(square), scale = std::abs(factor[square]);
    const double x = result.surface.points[v][0] - shift, y = result.surface.points[v][1] - shift;
    result.uv.push_back({scale * (factor[square] < 0 ? 1 - x : x), scale * y});
  }
  result.uv_faces = result.surface.faces;
  return result;
}

// A picture of two columns, grey values from 0 to 255.
std::string tga(const std::vector<int>& columns)
{
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = char(columns.size());
  bytes[14] = 1;
  bytes[16] = 24;
  for(const int value : columns) {
    bytes += std::string(3, char(value));
  }
  return bytes;
}

// --- What is measured

double uv_length(const Textured_soup& soup, std::size_t f, std::size_t c)
{
  const auto &p = soup.uv[soup.uv_faces[f][c]], &q = soup.uv[soup.uv_faces[f][(c + 1) % 3]];
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

// By what factor the texture of a range of faces was scaled; 0 if it is no similarity.
double factor_of(const Textured_soup& before, const Textured_soup& after, std::size_t begin,
                 std::size_t end)
{
  const double factor = uv_length(after, begin, 0) / uv_length(before, begin, 0);
  for(std::size_t f = begin; f < end; ++f) {
    for(std::size_t c = 0; c < 3; ++c) {
      if(std::abs(uv_length(after, f, c) / uv_length(before, f, c) - factor) > 1e-6 * factor) {
        return 0;
      }
    }
    if(uv_area(before, f) * uv_area(after, f) <= 0) {
      return 0;
    }
  }
  return factor;
}

// --- Charts that are there already

TEST_F(Atlas, keeps_the_charts_of_the_input)
{
  constexpr std::size_t n = 6, faces = 2 * (n - 1) * (n - 1);
  const Textured_soup given = textured_squares(n, {0.3, 0.9, -0.6});
  const std::string in = write("in.obj", obj(given));
  for(const bool keeps_scale : {false, true}) {
    Texts options{"--repack", "--texture", "256"};
    if(keeps_scale) {
      options.push_back("--keep-scale");
    }
    const Json report = call_well("atlas", in, "out", options);
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["number_of_charts"], 3);
    EXPECT_EQ(report["overlapping_texels"], 0);
    EXPECT_EQ(report["flips"], 0);
    EXPECT_EQ(report["layout"]["repacked"]["keeps_scale"], keeps_scale);
    EXPECT_EQ(report["layout"]["repacked"]["mirrored_charts"], 1);
    const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
    std::vector<double> factors;
    for(std::size_t i = 0; i < 3; ++i) {
      factors.push_back(factor_of(given, after, i * faces, (i + 1) * faces));
      EXPECT_GT(factors.back(), 0) << i;
    }
    EXPECT_NEAR(factors[0] / factors[1], keeps_scale ? 1 : 3, 1e-6);
    EXPECT_NEAR(factors[0] / factors[2], keeps_scale ? 1 : 2, 1e-6);
    const Json& density = report["layout"]["texels_per_unit_of_charts"];
    EXPECT_NEAR(double(density["most"]) / double(density["least"]), keeps_scale ? 3 : 1, 1e-6);
  }
}

TEST_F(Atlas, bakes_in_the_charts_of_the_input)
{
  const std::string in = write("in.obj", obj(cut_torus(16, 4)));
  const Json report = call_well("bake", in, "out", {"--repack", "--align", "--faces", "200",
                                                    "--texture", "128"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["number_of_charts"], 4);
  EXPECT_EQ(report["light"]["samples_without"], 0);
  EXPECT_EQ(error_in_texture(read_model(folder / "out/atlas.obj"), 128), "");
}

TEST_F(Atlas, names_charts_that_are_not_one_to_one)
{
  Textured_soup soup = textured_squares(4, {0.3, 0.3});
  std::swap(soup.uv[20], soup.uv[21]);
  const std::string flipped = write("flipped.obj", obj(soup));
  const Outcome refused = call("atlas", flipped, "out", {"--repack", "--strict"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(error_in_message(refused.err, flipped, {"chart 1 of the texture has ",
                                                    " flipped triangles of 18",
                                                    "the first in face ", "--charts uv"}), "");
  const Json report = call_well("atlas", flipped, "out", {"--repack"});
  EXPECT_EQ(report["layout"]["repacked"]["charts_not_one_to_one"], 1);
  EXPECT_GT(report["flips"], 0);
  EXPECT_NE(report["warnings"].dump().find("chart 1 of the texture has "), std::string::npos);
  fs::remove_all(folder / "out");
  soup = textured_squares(4, {0.3});
  for(auto& p : soup.uv) {
    p[1] = 0;
  }
  const std::string line = write("line.obj", obj(soup));
  EXPECT_EQ(error_in_message(call("atlas", line, "out", {"--repack"}).err, line,
                             {"chart 0 of the texture with face 0 has no area"}), "");
  const std::string bare = write("bare.off", off(cube()));
  EXPECT_EQ(error_in_message(call("atlas", bare, "out", {"--repack"}).err, bare,
                             {"no texture coordinates", "--repack"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"bare.off", "flipped.obj", "line.obj"}));
}

TEST_F(Atlas, refuses_options_of_the_layout_that_contradict_each_other)
{
  const std::string in = write("in.obj", obj(textured_squares(3, {0.5})));
  for(const Texts& options : std::vector<Texts>{{"--repack", "--charts", "uv"},
                                                {"--repack", "--max-charts", "3"},
                                                {"--repack", "--method", "spectral"},
                                                {"--repack", "--limits", "groups"},
                                                {"--repack", "--signal", "normals"},
                                                {"--keep-scale"},
                                                {"--density", in, "--importance", in},
                                                {"--separate", "groups", "--stack"},
                                                {"--separate", "groups", "--symmetric"},
                                                {"--repack", "--symmetric"},
                                                {"--limits", "faces"}}) {
    const Outcome outcome = call("atlas", in, "out", options);
    EXPECT_EQ(outcome.exit_code, 2) << options[0];
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
  }
  EXPECT_EQ(names(), std::set<std::string>{"in.obj"});
}

// A chart that is kept as it is lies on one page.
TEST_F(Atlas, refuses_to_separate_the_parts_of_a_chart_that_it_keeps)
{
  std::string text = obj(textured_squares(3, {0.5}));
  const std::size_t first = text.find("\nf "), second = text.find("\nf ", first + 1);
  text.insert(second + 1, "g other\n");
  text.insert(first + 1, "g some\n");
  const std::string in = write("in.obj", text);
  const Texts options = {"--repack", "--separate", "groups"};
  EXPECT_EQ(error_in_message(call("atlas", in, "none", options).err, in,
                             {"face 0 and face 1 are in one chart", "groups", "--separate"}), "");
  EXPECT_EQ(call("atlas", in, "out", {"--charts", "uv", "--separate", "groups"}).exit_code, 0);
}

// --- Density

TEST_F(Atlas, has_the_density_of_a_file)
{
  const Soup surface = squares(4, 2);
  std::string numbers;
  for(std::size_t f = 0; f < surface.faces.size(); ++f) {
    numbers += f < surface.faces.size() / 2 ? "1\n" : "2.5\n";
  }
  const std::string in = write("in.obj", obj(surface));
  const std::string density = write("density.txt", numbers);
  const Json report = call_well("atlas", in, "out", {"--density", density, "--bend", "0"});
  ASSERT_TRUE(report.is_object());
  const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
  EXPECT_NEAR(std::abs(uv_area(after, surface.faces.size() - 1) / uv_area(after, 0)), 6.25, 1e-6);
  const Json& said = report["layout"]["texels_per_unit_of_charts"];
  EXPECT_NEAR(double(said["most"]) / double(said["least"]), 2.5, 1e-6);
  // One number less, and a word
  const std::string short_file = write("short.txt", numbers.substr(2));
  EXPECT_EQ(error_in_message(call("atlas", in, "none", {"--density", short_file}).err, short_file,
                             {"35 numbers", "36 faces"}), "");
  const std::string word = write("word.txt", "1 2 three");
  EXPECT_EQ(error_in_message(call("atlas", in, "none", {"--density", word}).err, word,
                             {"word 3", "three"}), "");
  EXPECT_EQ(error_in_message(call("atlas", in, "none", {"--density", path("no.txt")}).err,
                             path("no.txt"), {"cannot be opened"}), "");
}

TEST_F(Atlas, has_the_density_of_an_image)
{
  Textured_soup soup = textured_squares(5, {0.4, 0.4}); // in the left half, and in the right one
  for(std::size_t v = soup.uv.size() / 2; v < soup.uv.size(); ++v) {
    soup.uv[v][0] += 0.55;
  }
  const std::string in = write("in.obj", obj(soup));
  const std::string image = write("image.tga", tga({255, 0}));
  const Json report = call_well("atlas", in, "out", {"--importance", image, "--bend", "0"});
  ASSERT_TRUE(report.is_object());
  const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
  EXPECT_NEAR(std::sqrt(std::abs(uv_area(after, 0) / uv_area(after, after.uv_faces.size() - 1))), 16,
              1e-5);
  const std::string bare = write("bare.off", off(cube()));
  EXPECT_EQ(error_in_message(call("atlas", bare, "none", {"--importance", image}).err, bare,
                             {"no texture coordinates", "--importance"}), "");
}

// --- Shape of the texture

TEST_F(Atlas, has_a_lower_texture_for_a_strip)
{
  Soup strip = grid(9, flat);
  for(auto& p : strip.points) {
    p[0] *= 8;
  }
  const std::string in = write("in.off", off(strip));
  const Json report = call_well("atlas", in, "out", {"--texture", "256", "--aspect", "8"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["width"], 256);
  EXPECT_EQ(report["height"], 32);
  EXPECT_EQ(report["number_of_charts"], 1);
  EXPECT_EQ(report["overlapping_texels"], 0);
  EXPECT_GT(report["utilisation"], 0.75);
  const std::string png = read_file(folder / "out/checker.png");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\4\0\0\0\0\x80", 8)); // 1024 x 128
  const Json bake = call_well("bake", in, "light",
                              {"--texture", "256", "--aspect", "8", "--faces", "60"});
  ASSERT_TRUE(bake.is_object());
  EXPECT_EQ(read_file(folder / "light/normal.png").substr(16, 8),
            std::string("\0\0\1\0\0\0\0\x20", 8));
}

// --- Directions

TEST_F(Atlas, lays_straight_borders_along_the_axes)
{
  Soup triangle = grid(9, flat); // with steps in a corner
  triangle.faces.erase(
      std::remove_if(triangle.faces.begin(), triangle.faces.end(),
                     [&](const std::vector<std::size_t>& face) {
                       return std::any_of(face.begin(), face.end(), [&](std::size_t v) {
                         return triangle.points[v][0] + 2 * triangle.points[v][1] > 2.3;
                       });
                     }),
      triangle.faces.end());
  const std::string in = write("in.off", off(triangle));
  const Json report = call_well("atlas", in, "out", {"--align"});
  ASSERT_TRUE(report.is_object());
  EXPECT_GT(report["layout"]["axis_parallel"], 0.999);
  EXPECT_EQ(report["overlapping_texels"], 0);
  EXPECT_FALSE(call_well("atlas", in, "out").contains("layout"));
}

// --- Tiles

TEST_F(Atlas, makes_tiles_of_pages)
{
  const Soup surface = wavy_torus(24);
  const std::string in = write("in.off", off(surface));
  const Texts texture{"--texture", "128", "--pages", "3"};
  const auto with = [&texture](Texts more) {
    more.insert(more.end(), texture.begin(), texture.end());
    return more;
  };
  const Json plain = call_well("atlas", in, "plain", with({"--ply"}));
  const Json report = call_well("atlas", in, "out", with({"--ply", "--udim"}));
  ASSERT_TRUE(report.is_object());
  const std::size_t pages = report["pages"];
  ASSERT_GT(pages, 1u);
  EXPECT_EQ(plain["pages"], pages);
  EXPECT_EQ(report["layout"]["udim"]["first"], 1001);
  EXPECT_EQ(report["layout"]["udim"]["last"], 1000 + pages);
  EXPECT_EQ(report["overlapping_texels"], 0);
  EXPECT_FALSE(fs::exists(folder / "out/checker.png"));
  for(std::size_t tile = 1001; tile < 1001 + pages; ++tile) {
    EXPECT_TRUE(fs::exists(folder / ("out/checker." + std::to_string(tile) + ".png"))) << tile;
  }
  EXPECT_NE(read_file(folder / "out/atlas.mtl").find("map_Kd checker.<UDIM>.png\n"),
            std::string::npos);
  // One material; each coordinate in the tile of its page
  const Obj_model before = read_model(folder / "plain/atlas.obj"),
                  after = read_model(folder / "out/atlas.obj");
  ASSERT_EQ(before.soup.uv_faces, after.soup.uv_faces);
  EXPECT_EQ(*std::max_element(after.material.begin(), after.material.end()), 0u);
  std::set<std::pair<std::size_t, double>> tiles;
  for(std::size_t f = 0; f < after.soup.uv_faces.size(); ++f) {
    for(const std::size_t w : after.soup.uv_faces[f]) {
      const double u = after.soup.uv[w][0] - before.soup.uv[w][0];
      EXPECT_NEAR(u, std::round(u), 1e-9);
      EXPECT_NEAR(after.soup.uv[w][1], before.soup.uv[w][1], 1e-9);
      tiles.insert({before.material[f], std::round(u)});
    }
  }
  EXPECT_EQ(tiles.size(), pages); // each page is one tile
  EXPECT_EQ(error_in_glb(read_file(folder / "out/atlas.glb"), surface.faces.size(), false), "");
}

TEST_F(Atlas, bakes_tiles)
{
  const std::string in = write("in.off", off(wavy_torus(24)));
  const Json report = call_well("bake", in, "out", {"--texture", "128", "--pages", "2", "--udim",
                                                    "--faces", "600", "--displacement"});
  ASSERT_TRUE(report.is_object());
  ASSERT_EQ(report["pages"], 2);
  for(const char* name : {"normal.1001.png", "normal.1002.png", "displacement.1001.png",
                          "displacement.1002.png", "checker.1001.png", "checker.1002.png"}) {
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder / "out/normal.png"));
  EXPECT_NE(read_file(folder / "out/light.mtl").find("norm normal.<UDIM>.png\n"), std::string::npos);
  double most = 0;
  for(const auto& uv : read_model(folder / "out/light.obj").soup.uv) {
    most = std::max(most, uv[0]);
  }
  EXPECT_GT(most, 1);
  EXPECT_LE(most, 2);
}

// --- Equal parts

TEST_F(Atlas, lays_equal_parts_on_each_other)
{
  Soup surface;
  const Soup part = wavy_torus(8);
  for(int copy = 0; copy < 4; ++copy) { // moved; the last two mirrored
    const std::size_t first = surface.points.size();
    for(const auto& p : part.points) {
      const double x = p[0] + 0.1 * p[1] * p[1] + 0.2 * p[2]; // without symmetries
      surface.points.push_back({(copy > 1 ? -x : x) + 10 * copy, p[1] + copy, p[2]});
    }
    for(std::vector<std::size_t> face : part.faces) {
      if(copy > 1) {
        std::swap(face[0], face[2]);
      }
      for(std::size_t& v : face) {
        v += first;
      }
      surface.faces.push_back(face);
    }
  }
  const Soup other = moved(cube(), 1, 100);
  for(std::vector<std::size_t> face : other.faces) {
    for(std::size_t& v : face) {
      v += surface.points.size();
    }
    surface.faces.push_back(face);
  }
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  const std::string in = write("in.off", off(surface));
  const Json plain = call_well("atlas", in, "plain");
  const Json report = call_well("atlas", in, "out", {"--stack"});
  ASSERT_TRUE(report.is_object());
  const Json& stacked = report["layout"]["stacked"];
  EXPECT_EQ(stacked["components"], 5);
  EXPECT_EQ(stacked["copies"], 3);
  EXPECT_EQ(stacked["mirrored_copies"], 2);
  EXPECT_EQ(report["overlapping_texels"], 0); // of what is packed
  EXPECT_GT(report["texels_per_unit"], 1.5 * double(plain["texels_per_unit"]));
  const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
  const auto sorted_uv = [&after](std::size_t begin, std::size_t end) {
    std::vector<std::array<double, 2>> all;
    for(std::size_t f = begin; f < end; ++f) {
      for(const std::size_t w : after.uv_faces[f]) {
        all.push_back(after.uv[w]);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::size_t n = part.faces.size();
  for(std::size_t copy = 1; copy < 4; ++copy) {
    EXPECT_EQ(sorted_uv(copy * n, (copy + 1) * n), sorted_uv(0, n)) << copy;
    EXPECT_EQ(uv_area(after, copy * n) < 0, copy > 1);
  }
  const Outcome bake = call("bake", in, "none", {"--stack", "--faces", "100"});
  EXPECT_EQ(bake.exit_code, 2);
  EXPECT_NE(bake.err.find("--stack: parts that share texels"), std::string::npos) << bake.err;
}

TEST_F(Atlas, has_symmetric_charts)
{
  const Soup half = squares(12, 1);
  Soup surface = half;
  for(auto& p : surface.points) {
    p[2] += 0.03 * p[0] * p[0] + 0.1 * std::sin(p[1]);
  }
  const std::size_t n = surface.points.size();
  std::vector<std::size_t> image;
  for(std::size_t v = 0; v < n; ++v) {
    const auto p = surface.points[v];
    image.push_back(p[0] == 0 ? v : surface.points.size());
    if(p[0] != 0) {
      surface.points.push_back({-p[0], p[1], p[2]});
    }
  }
  for(const auto& face : half.faces) {
    surface.faces.push_back({image[face[0]], image[face[2]], image[face[1]]});
  }
  const std::string in = write("in.off", off(surface));
  const Json report = call_well("atlas", in, "out", {"--symmetric"});
  ASSERT_TRUE(report.is_object());
  const Json& symmetric = report["layout"]["symmetric"];
  EXPECT_EQ(symmetric["halved_components"], 1);
  EXPECT_EQ(symmetric["mirrored_copies"], 1);
  EXPECT_EQ(symmetric["charts_with_equals"], report["charts"].size());
  EXPECT_EQ(report["overlapping_texels"], 0);
  EXPECT_EQ(report["flips"], 0);
  const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
  for(std::size_t f = 0; f < half.faces.size(); ++f) { // OBJ has some digits
    EXPECT_NEAR(uv_area(after, f), uv_area(after, f + half.faces.size()), 1e-4 * uv_area(after, f));
  }
  const Json stacked = call_well("atlas", in, "stacked", {"--symmetric", "--stack"});
  EXPECT_GT(stacked["texels_per_unit"], 1.2 * double(report["texels_per_unit"]));
}

// --- Light maps

TEST_F(Atlas, is_a_second_set_of_texture_coordinates)
{
  const Textured_soup given = cut_torus(12, 3);
  const std::string in = write("in.obj", obj(given));
  const Json report = call_well("atlas", in, "out", {"--lightmap", "--texture", "128"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["layout"]["lightmap"]["texcoord"], 1);
  EXPECT_LT(boxes_off_whole_texels(read_model(folder / "out/atlas.obj").soup, 128), 1e-4);
  const std::string glb = read_file(folder / "out/atlas.glb");
  const Json gltf = json_of_glb(glb);
  const Json& primitive = gltf["meshes"][0]["primitives"][0];
  const auto indices = numbers_of<std::uint32_t>(glb, gltf, primitive["indices"]);
  const auto first = numbers_of<float>(glb, gltf, primitive["attributes"]["TEXCOORD_0"]);
  const auto second = numbers_of<float>(glb, gltf, primitive["attributes"]["TEXCOORD_1"]);
  const Textured_soup atlas = read_model(folder / "out/atlas.obj").soup;
  ASSERT_EQ(indices.size(), 3 * given.uv_faces.size());
  for(std::size_t i = 0; i < indices.size(); ++i) {
    const auto &p = given.uv[given.uv_faces[i / 3][i % 3]],
               &q = atlas.uv[atlas.uv_faces[i / 3][i % 3]];
    EXPECT_NEAR(first[2 * indices[i]], p[0], 1e-6);
    EXPECT_NEAR(first[2 * indices[i] + 1], 1 - p[1], 1e-6);
    EXPECT_NEAR(second[2 * indices[i]], q[0], 1e-6);
    EXPECT_NEAR(second[2 * indices[i] + 1], 1 - q[1], 1e-6);
  }
  const std::string bare = write("bare.off", off(cube()));
  EXPECT_EQ(error_in_message(call("atlas", bare, "none", {"--lightmap"}).err, bare,
                             {"no texture coordinates", "--lightmap"}), "");
  EXPECT_EQ(call("bake", in, "none", {"--lightmap", "--faces", "50"}).exit_code, 2);
}

} // namespace program_test
