// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the program makes of meshes as people have them: polygons, several parts, closed surfaces,
// edges with many faces, and all that; and that people get their own mesh back.

#include <support/polygon_soups.h>
#include <support/program_runs.h>

#include <CGAL/Indexed_mesh/surface_of_soup.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace program_test {

namespace {

using test_support::Polygon_soup;
using test_support::Random;

// As an OBJ file.
std::string obj_of(const Polygon_soup& soup)
{
  std::string text;
  const auto add = [&text](auto number) {
    char digits[40];
    text += " ";
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  };
  for(const auto& p : soup.points) {
    text += "v";
    for(int k = 0; k < 3; ++k) {
      add(p[k]);
    }
    text += "\n";
  }
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    text += "f";
    for(const std::uint32_t v : soup.face(f)) {
      add(v + 1u);
    }
    text += "\n";
  }
  return text;
}

// The lines of an OBJ file without texture coordinates and normals, of corners, too; numbers in their
// shortest form.
std::string without_texture(const std::string& obj, const Texts& dropped = {})
{
  std::istringstream lines(obj);
  std::string result, vertices;
  for(std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword, word;
    words >> keyword;
    if(keyword.empty() || keyword[0] == '#' || keyword == "vt" || keyword == "vn"
       || std::find(dropped.begin(), dropped.end(), keyword) != dropped.end())
    {
      continue;
    }
    std::string& to = keyword == "v" || keyword == "mtllib" ? vertices : result;
    to += keyword;
    while(words >> word) {
      char digits[40];
      if(keyword == "v") {
        char* end = std::to_chars(digits, digits + sizeof digits, std::stod(word)).ptr;
        word = std::string(digits, end);
      }
      to += " " + (keyword == "f" ? word.substr(0, word.find('/')) : word);
    }
    to += "\n";
  }
  return vertices + result;
}

// What is wrong with the texture coordinates of a file: each corner has one, in the unit square, or of
// a face without three different vertices none has.
std::string texture_error_of(const std::string& obj)
{
  std::istringstream lines(obj);
  std::size_t coordinates = 0, corners = 0;
  for(std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword, word;
    words >> keyword;
    double u = -1, v = -1;
    if(keyword == "vt" && (++coordinates, !(words >> u >> v) || !(u >= 0 && u <= 1 && v >= 0 && v <= 1))) {
      return "not in the unit square: " + line;
    }
    std::set<int> vertices;
    std::size_t bare = 0, corners_before = corners;
    while(keyword == "f" && words >> word) {
      ++corners;
      vertices.insert(std::atoi(word.c_str()));
      if(word.find('/') == std::string::npos) {
        ++bare;
        continue;
      }
      const std::size_t slash = word.find('/');
      const std::size_t vt = slash == std::string::npos ? 0 : std::size_t(std::atoll(word.c_str() + slash + 1));
      if(vt < 1 || vt > coordinates) {
        return "no texture coordinate: " + line;
      }
    }
    if(bare > 0 && (bare < corners - corners_before || vertices.size() > 2)) {
      return "without texture coordinates: " + line;
    }
  }
  return corners > 0 ? "" : "there are no faces";
}

Polygon_soup soup_of(const Soup& soup)
{
  return CGAL::Indexed_mesh::polygon_soup(soup.points, soup.faces);
}

struct Defect
{
  std::string name;
  Polygon_soup soup;
  std::string note; // on stderr
  std::string key;  // of "repairs"
};

std::vector<Defect> defects()
{
  using namespace test_support;
  Random random(1);
  const Polygon_soup good = soup_of(grid(5, hilly));
  const auto spoilt = [&](const auto& spoil) {
    Polygon_soup soup = good;
    spoil(soup);
    return soup;
  };
  return {
      {"quads", quadrangles(4), "more than three corners", "triangulated_faces"},
      {"line", spoilt([](Polygon_soup& s) { add_face(s, {0, 1}); }), "left out", "collapsed_faces"},
      {"folded", spoilt([](Polygon_soup& s) { add_face(s, {0, 1, 1}); }), "left out", "collapsed_faces"},
      {"repeated", spoilt([&](Polygon_soup& s) { repeat_corners(s, random, 2); }), "vertex twice", "folded_faces"},
      {"isolated", spoilt([](Polygon_soup& s) { add_point(s, 9, 9, 9); }), "in no face", "isolated_vertices"},
      {"duplicate", spoilt([&](Polygon_soup& s) { duplicate_faces(s, random, 2); }), "same vertices", "duplicate_faces"},
      {"fin", spoilt([](Polygon_soup& s) { add_face(s, {6, 12, add_point(s, 0.3, 0.3, 1)}); }), "more than two faces", "separated_edges"},
      {"turned", spoilt([&](Polygon_soup& s) { turn_faces(s, random, 6); }), "other way round", "turned_faces"},
      {"moebius", twisted_band(20, 1), "one side only", "cut_edges"},
      {"flag", spoilt([&](Polygon_soup& s) { add_flags(s, random, 1); }), "separate fans", "split_vertices"},
      {"klein", klein_bottle(12, 10), "one side only", "cut_edges"}};
}

} // namespace

TEST_F(Program, mends_a_mesh_and_says_what_it_did)
{
  for(const Defect& defect : defects()) {
    SCOPED_TRACE(defect.name);
    const std::string text = obj_of(defect.soup), in = write("in.obj", text);
    const Outcome outcome = run({"parameterize", in, "-o", path("out.obj"), "--report", path("report.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("hlscm: note: " + in + ": "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(defect.note), std::string::npos) << outcome.err;
    const Json report = Json::parse(read_file(folder / "report.json"));
    EXPECT_GT(report["repairs"][defect.key]["count"], 0) << report["repairs"];
    const std::string result = read_file(folder / "out.obj");
    EXPECT_EQ(without_texture(result), without_texture(text));
    EXPECT_EQ(texture_error_of(result), "");
    const Json info = Json::parse(run({"info", in, "--json"}).out);
    EXPECT_EQ(info["repairs"], report["repairs"]);
    EXPECT_EQ(info["can_be_parameterized"], true);
    const Outcome strict = run({"parameterize", in, "-o", path("out.obj"), "--strict"});
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_EQ(read_file(folder / "out.obj"), result);
  }
}

TEST_F(Program, gives_people_their_own_file_back)
{
  const std::string text = "mtllib wood.mtl\no table\nv 0 0 0\nv 1 0 0\nv 2 0 0.5\nv 0 1 0\nv 1 1 0.1\n"
                           "v 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\nvn 0 0 1\nvn 0.6 0 0.8\ng left\nusemtl oak\ns 1\n"
                           "f 1//1 2//1 5//1 4//2\nf 4//1 5//1 8//1 7//1\ng right\nusemtl ash\n"
                           "f 2//2 3//2 6//2\nf 2//2 6//2 5//2\ns off\nf 5//1 6//1 9//1 8//1\no behind\n";
  const std::string in = write("in.obj", text);
  ASSERT_EQ(run({"parameterize", in, "-o", path("out.obj"), "--quiet"}).exit_code, 0);
  const std::string result = read_file(folder / "out.obj");
  EXPECT_EQ(without_texture(result), without_texture(text));
  EXPECT_EQ(texture_error_of(result), "");
  EXPECT_NE(result.find("f 4/4/1 5/5/1 8/8/1 7/7/1\n"), std::string::npos) << result;
  EXPECT_NE(result.find("vn 0.6 0 0.8\n"), std::string::npos) << result;
  // The atlas has materials of its own.
  ASSERT_EQ(run({"atlas", in, "-o", path("atlas"), "--quiet"}).exit_code, 0);
  const std::string atlas = read_file(folder / "atlas" / "atlas.obj");
  const Texts materials = {"mtllib", "usemtl"};
  EXPECT_EQ(without_texture(atlas, materials), without_texture(text, materials));
  EXPECT_EQ(texture_error_of(atlas), "");
  EXPECT_NE(atlas.find("mtllib atlas.mtl\n"), std::string::npos);
  EXPECT_NE(atlas.find("usemtl page_1\n"), std::string::npos);
}

TEST_F(Program, writes_polygons_as_ply)
{
  using namespace test_support;
  Polygon_soup two = quadrangles(3);
  append(two, klein_bottle(8, 8), 20);
  for(const Polygon_soup& soup : {quadrangles(3), two}) {
    const std::string in = write("in.obj", obj_of(soup));
    ASSERT_EQ(run({"parameterize", in, "-o", path("out.ply"), "--quiet"}).exit_code, 0);
    const Json info = Json::parse(run({"info", path("out.ply"), "--json"}).out);
    EXPECT_EQ(info["vertices"], soup.number_of_vertices());
    EXPECT_EQ(info["faces"], soup.number_of_faces());
    EXPECT_EQ(info["non_triangular_faces"]["count"], soup.number_of_faces());
    const Outcome levels = run({"levels", path("out.ply"), "-o", path("levels"), "--format", "obj"});
    EXPECT_EQ(levels.exit_code, 0) << levels.err;
  }
}

TEST_F(Program, maps_one_component_if_that_is_wanted)
{
  using namespace test_support;
  Polygon_soup soup = quadrangles(3);
  append(soup, to_soup(sphere(1)), 20);
  const std::size_t others = soup.number_of_faces() - 9;
  const std::string in = write("in.obj", obj_of(soup));
  const auto lines_with_uv = [&] {
    std::istringstream lines(read_file(folder / "out.obj"));
    std::size_t number = 0;
    for(std::string line; std::getline(lines, line);) {
      number += line.rfind("f ", 0) == 0 && line.find('/') != std::string::npos;
    }
    return number;
  };
  const Texts arguments = {"parameterize", in, "-o", path("out.obj"), "--quiet", "--component"};
  for(const auto& [component, faces] : {std::pair("0", std::size_t(9)), std::pair("1", others)}) {
    Texts with = arguments;
    with.push_back(component);
    ASSERT_EQ(run(with).exit_code, 0);
    EXPECT_EQ(lines_with_uv(), faces);
    EXPECT_EQ(without_texture(read_file(folder / "out.obj")), without_texture(obj_of(soup)));
  }
  Texts with = arguments;
  with.push_back("2");
  const Outcome outcome = run(with);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, in, {"no component 2", "has 2"}), "");
}

TEST_F(Program, merges_vertices_within_a_length)
{
  using namespace test_support;
  Polygon_soup soup; // two squares with a gap between them
  for(const double x : {0., 1., 1.01, 2.}) {
    for(const double y : {0., 1.}) {
      add_point(soup, x, y, 0);
    }
  }
  add_face(soup, {0, 2, 3, 1});
  add_face(soup, {4, 6, 7, 5});
  const std::string in = write("in.obj", obj_of(soup));
  for(const auto& [weld, components] : {std::pair("0.005", 2), std::pair("0.02", 1), std::pair("1%", 1)}) {
    const Json info = Json::parse(run({"info", in, "--json", "--weld", weld}).out);
    EXPECT_EQ(info["components"], components);
    const Outcome outcome = run({"parameterize", in, "-o", path("out.obj"), "--weld", weld});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("vertices merged with others: " + std::to_string(2 * (2 - components))),
              std::string::npos) << outcome.err;
  }
}

TEST_F(Program, makes_levels_and_light_models_of_any_mesh)
{
  using namespace test_support;
  Polygon_soup soup = quadrangles(12);
  append(soup, to_soup(sphere(3)), 30);
  Random random(3);
  turn_faces(soup, random, 5);
  add_flags(soup, random, 2);
  const std::string in = write("in.obj", obj_of(soup));
  const Outcome levels = run({"levels", in, "-o", path("levels"), "--faces", "400"});
  EXPECT_EQ(levels.exit_code, 0) << levels.err;
  const Outcome bake = run({"bake", in, "-o", path("bake"), "--faces", "400", "--texture", "256"});
  EXPECT_EQ(bake.exit_code, 0) << bake.err;
}

// Valid output, whatever comes: no signal, and no hang.
TEST_F(Program, survives_any_mesh)
{
  for(std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::string text = obj_of(test_support::any_soup(random)), in = write("in.obj", text);
    const auto expect_model = [&](const std::string& command, const std::string& to,
                                  const fs::path& obj, const Texts& dropped, Texts options = {}) {
      options.insert(options.begin(), {command, in, "-o", path(to)});
      const Outcome outcome = run(options);
      ASSERT_EQ(outcome.exit_code, 0) << command << ": " << outcome.err;
      const std::string result = read_file(folder / obj);
      EXPECT_EQ(texture_error_of(result), "") << command;
      if(outcome.err.find("which became triangles") == std::string::npos) {
        EXPECT_EQ(without_texture(result, dropped), without_texture(text, dropped)) << command;
      }
    };
    expect_model("parameterize", "out.obj", "out.obj", {});
    if(seed % 20 == 0) { // it takes much longer
      expect_model("atlas", "atlas", "atlas/atlas.obj", {"mtllib", "usemtl"}, {"--texture", "256"});
    }
    if(seed % 10 == 0) {
      const Json info = Json::parse(run({"info", in, "--json"}).out, nullptr, false);
      EXPECT_EQ(info["can_be_parameterized"], true);
    }
    if(HasFailure()) {
      return;
    }
  }
}

} // namespace program_test
