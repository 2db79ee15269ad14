// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on generated files.

#include <support/textured_soups.h>

#include <CGAL/IO/PLY.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace program_test {

using Kernel = CGAL::Simple_cartesian<double>;

// A mesh with texture coordinates as the program writes it.
struct Result
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<double, 2>> uv;
  std::vector<std::vector<std::size_t>> faces;
};

Result read_obj(const fs::path& path)
{
  const Textured_soup soup = read_textured_obj(path);
  EXPECT_EQ(soup.surface.faces, soup.uv_faces);
  return {soup.surface.points, soup.uv, soup.surface.faces};
}

// Largest distance of corresponding texture coordinates.
double distance(const Result& a, const Result& b)
{
  double largest = a.uv.size() == b.uv.size() ? 0 : 1e300;
  for(std::size_t v = 0; v < std::min(a.uv.size(), b.uv.size()); ++v) {
    largest = std::max(largest, std::hypot(a.uv[v][0] - b.uv[v][0], a.uv[v][1] - b.uv[v][1]));
  }
  return largest;
}

// ---------------------------------------------------------------------------------------------
// Usage

TEST_F(Program, explains_itself)
{
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_NE(run({"parameterize", "--help"}).out.find("--tolerance"), std::string::npos);
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.rfind("hlscm ", 0), 0u);
}

TEST_F(Program, refuses_wrong_usage)
{
  const std::string in = write("in.off", off(grid(4, flat)));
  const std::string out = path("out.obj");
  const std::vector<Texts> wrong{
      {},
      {"frobnicate"},
      {"info"},
      {"parameterize", in},
      {"parameterize", in, "-o", path("out.txt")},
      {"parameterize", in, "-o", out, "--unknown"},
      {"parameterize", in, "-o", out, "--method", "magic"},
      {"parameterize", in, "-o", out, "--weights", "magic"},
      {"parameterize", in, "-o", out, "--engine", "magic"},
      {"parameterize", in, "-o", out, "--prolongation", "magic"},
      {"parameterize", in, "-o", out, "--tolerance", "0"},
      {"parameterize", in, "-o", out, "--tolerance", "-1"},
      {"parameterize", in, "-o", out, "--tolerance", "nan"},
      {"parameterize", in, "-o", out, "--schedule", "1,2"},
      {"parameterize", in, "-o", out, "--schedule", "0,0,1"},
      {"parameterize", in, "-o", out, "--schedule", "1,1,0"},
      {"parameterize", in, "-o", out, "--ratio", "1"},
      {"parameterize", in, "-o", out, "--coarsest", "-5"},
      {"parameterize", in, "-o", out, "--iterations", "0"},
      {"parameterize", in, "-o", out, "--pin", "0=0,0"},
      {"parameterize", in, "-o", out, "--pin", "0=0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "x=0,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "-1=0,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--pin", "0=nan,0", "--pin", "1=1,0"},
      {"parameterize", in, "-o", out, "--method", "spectral", "--pin", "0=0,0", "--pin", "1=1,0"}};
  for(const Texts& arguments : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << ::testing::PrintToString(arguments);
    EXPECT_EQ(outcome.err.rfind("hlscm: usage: ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
  }
  EXPECT_EQ(names(), std::set<std::string>{"in.off"});
}

// ---------------------------------------------------------------------------------------------
// Bad input

struct Bad_file
{
  std::string name;
  std::string bytes;
  Texts words; // of the message
};

std::vector<Bad_file> bad_files()
{
  const Soup good = grid(5, hilly);
  const std::string nan_vertex = "OFF\n3 1 0\n0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n";
  Soup two_parts = good, pinched = good, unmerged;
  for(const auto& face : grid(5, flat).faces) {
    two_parts.faces.push_back({face[0] + 25, face[1] + 25, face[2] + 25});
  }
  for(const auto& p : moved(good, 1, 3).points) {
    two_parts.points.push_back(p);
  }
  pinched.points.insert(pinched.points.end(), {{2, 2, 0}, {2, 3, 0}});
  pinched.faces.push_back({24, 25, 26}); // touches the grid in its last vertex
  for(const auto& face : good.faces) {
    for(std::size_t v : face) {
      unmerged.points.push_back(good.points[v]);
    }
    const std::size_t n = unmerged.points.size();
    unmerged.faces.push_back({n - 3, n - 2, n - 1});
  }
  Soup isolated = good;
  isolated.points.push_back({5, 5, 5});
  Soup third_face = good;
  third_face.points.push_back({0, 0, 9});
  third_face.faces.push_back({6, 7, 25}); // the edge 6-7 has two faces already
  Soup turned = good;
  std::swap(turned.faces[9][0], turned.faces[9][1]);
  const std::string binary = ply(good, "binary_little_endian");
  const std::string int_ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\n"
                              "property int y\nproperty list uchar int z\nend_header\n";
  return {
      {"empty.off", "", {"empty", "export"}},
      {"empty.obj", "", {"empty", "export"}},
      {"empty.ply", "", {"empty", "export"}},
      {"empty.stl", "", {"empty", "export"}},
      {"garbage.off", "\x7f\x01 what is this\n 7 7", {"OFF", "export"}},
      {"garbage.obj", std::string("\x7f\0garbage\n", 10), {"OBJ", "export"}},
      {"words.obj", "no mesh at all\n", {"no face"}},
      {"garbage.ply", "garbage\n", {"ply", "export"}},
      {"garbage.stl", std::string(300, '\x55'), {"cut short", "export"}},
      {"short.stl", "short", {"5 bytes", "export"}},
      {"mesh.xyz", "0 0 0\n", {"extension", ".off, .obj, .ply or .stl"}},
      {"mesh", "0 0 0\n", {"extension"}},
      {"cut.off", off(good).substr(0, 300), {"14 of 25 vertices", "cut short"}},
      {"cut.ply", binary.substr(0, binary.size() - 20), {"face 30", "cut short"}},
      {"cut.stl", stl(good, true).substr(0, 1000), {"18 of 32 triangles", "cut short"}},
      {"cut2.stl", stl(good, false).substr(0, 1000), {"triangle", "cut short"}},
      {"cut.obj", obj(good).substr(0, obj(good).size() - 6), {"corners"}},
      {"bomb.off", "OFF\n2000000000 1 0\n0 0 0\n", {"2000000000 vertices", "cut short"}},
      {"negative.off", "OFF\n-3 1 0\n0 0 0\n", {"line 2"}},
      {"bomb.ply",
       "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty int x\nend_header\n",
       {"99999999999"}},
      {"no_z.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n0\n",
       {"x, y and z"}},
      {"list.ply", int_ply + "0 0 1\n", {"z of vertex 0"}},
      {"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", {"header"}},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", {"face 0", "vertex 3"}},
      {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", {"face 0"}},
      {"index2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -7\n", {"face 0"}},
      {"index3.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967299\n", {"face 0"}},
      {"index.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\n"
       "element face 1\nproperty list uchar int vertex_index\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n",
       {"face 0", "vertex -1"}},
      {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"no face"}},
      {"nan.off", nan_vertex, {"vertex 2", "not finite", "repair"}},
      {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", {"vertex 1", "not finite"}},
      {"inf.obj", "v 0 0 0\nv 1 0 0\nv 0 1e999 0\nf 1 2 3\n", {"vertex 2", "not finite"}},
      {"nan.stl", "solid\nfacet\nvertex 0 0 nan\nendfacet\nendsolid\n", {"triangle 0", "finite"}},
      {"quad.off", off(with_face(good, {0, 1, 6, 5})), {"face 32", "4 corners", "triangulate"}},
      {"line.off", off(with_face(good, {0, 1})), {"face 32", "2 corners", "repair"}},
      {"folded.off", off(with_face(good, {0, 1, 1})), {"face 32", "twice", "remove"}},
      {"isolated.off", off(isolated), {"vertex 25", "no face", "remove"}},
      {"duplicate.off", off(with_face(good, good.faces[3])), {"faces 3 and 32", "remove"}},
      {"reversed.off",
       off(with_face(good, {good.faces[3][1], good.faces[3][0], good.faces[3][2]})),
       {"faces 3 and 32", "remove"}},
      {"edge.off", off(third_face), {"vertices 6 and 7", "more than two faces", "split"}},
      {"turned.off", off(turned), {"face", "9", "same direction", "orient"}},
      {"moebius.off", off(band(20, true)), {"faces 0 and 39", "one side", "cut"}},
      {"pinched.off", off(pinched), {"vertex 24", "2 separate fans"}},
      {"parts.off", off(two_parts), {"2 connected components", "split"}},
      {"unmerged.off", off(unmerged), {"32 connected components", "71 coinciding", "merge"}},
      {"torus.off", off(torus(8, false)), {"closed", "cut"}},
      {"genus.off", off(torus(8, true)), {"1 handle", "cut"}},
  };
}

TEST_F(Program, names_what_is_wrong_with_a_file)
{
  for(const Bad_file& bad : bad_files()) {
    SCOPED_TRACE(bad.name);
    const std::string in = write(bad.name, bad.bytes);
    write("out.obj", "was here before");
    const Texts outputs{"--report", path("report.json"), "--pictures", path("pictures")};
    const Outcome outcome = parameterize(in, "out.obj", outputs);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, in, bad.words), "");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names(), (std::set<std::string>{bad.name, "out.obj"}));
    EXPECT_EQ(read_file(folder / "out.obj"), "was here before");
    fs::remove(in);
  }
}

TEST_F(Program, misses_files_and_folders)
{
  const std::string in = path("missing.off");
  for(const Outcome& outcome : {parameterize(in, "out.obj"), run({"info", in})}) {
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, in, {"no such file", "check"}), "");
  }
  fs::create_directory(folder / "folder.off");
  const Outcome outcome = parameterize(path("folder.off"), "out.obj");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, path("folder.off"), {"folder"}), "");
}

// Every proper beginning of a file is refused, or it lacks nothing but white space, or there is a
// warning. In this strip each face has a vertex of its own.
TEST_F(Program, notices_files_that_were_cut_short)
{
  Soup strip;
  for(std::size_t i = 0; i < 5; ++i) {
    strip.points.push_back({double(i), double(i % 2), 0.25});
    if(i >= 2) {
      strip.faces.push_back({i - 2 + i % 2, i - 1 - i % 2, i});
    }
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.off", off(strip)},          {"a.obj", obj(strip)},
      {"a.ply", ply(strip, "ascii")}, {"b.ply", ply(strip, "binary_little_endian")},
      {"a.stl", stl(strip, true)},    {"b.stl", stl(strip, false)}};
  for(const auto& [name, bytes] : files) {
    ASSERT_EQ(parameterize(write(name, bytes), "out.obj", {"--quiet"}).exit_code, 0) << name;
    const bool is_text = bytes.back() == '\n';
    // All places near the end, every seventh before.
    for(std::size_t size = 0; size < bytes.size(); size += size + 60 < bytes.size() ? 7 : 1) {
      const Outcome outcome = parameterize(write(name, bytes.substr(0, size)), "out.obj");
      const bool is_noticed =
          outcome.exit_code == 1 || outcome.err.find("no line feed") != std::string::npos;
      const bool is_complete = is_text && size + 1 == bytes.size();
      const bool is_name_of_solid = name == "b.stl" && size + 6 >= bytes.size();
      ASSERT_TRUE(is_noticed || is_complete || is_name_of_solid) << name << " " << size;
    }
  }
}

TEST_F(Program, solves_degenerate_meshes)
{
  const Soup triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Json single = report(write("single.off", off(triangle)));
  EXPECT_NEAR(single["distortion"]["quasi_conformal_max"].get<double>(), 1, 1e-6);

  Soup sliver = grid(6, flat);
  for(auto& p : sliver.points) {
    p[0] = p[0] > 0.5 && p[0] < 0.7 ? 0.4 : p[0]; // two columns of vertices coincide
  }
  const std::string in = write("sliver.off", off(sliver));
  const Outcome outcome = parameterize(in, "out.obj", {"--report", path("report.json")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("hlscm: warning: " + in), std::string::npos) << outcome.err;
  const Json json = Json::parse(read_file(folder / "report.json"));
  EXPECT_EQ(json["mollified_faces"], 10);
  EXPECT_FALSE(json["warnings"].empty());
}

TEST_F(Program, solves_a_vertex_of_degree_10000)
{
  const Json json = report(write("fan.off", off(fan(10000))));
  EXPECT_EQ(json["vertices"], 10001);
  EXPECT_EQ(json["faces"], 10000);
  EXPECT_EQ(json["flips"], 0);
}

TEST_F(Program, solves_at_all_sizes_and_places)
{
  const Soup soup = grid(30, hilly);
  const Texts precise{"--tolerance", "1e-10"};
  ASSERT_EQ(parameterize(write("in.off", off(soup)), "out.obj", precise).exit_code, 0);
  const Result expected = read_obj(folder / "out.obj");
  for(double scale : {1e-30, 1e-6, 1e6, 1e30}) {
    const std::string in = write("scaled.off", off(moved(soup, scale, 0)));
    const Outcome outcome = parameterize(in, "out.obj", precise);
    EXPECT_EQ(outcome.exit_code, 0) << scale << outcome.err;
    EXPECT_LT(distance(read_obj(folder / "out.obj"), expected), 1e-5) << scale;
  }
  // The places of the vertices are rounded to 1e-16 of their distance from the origin, edges are
  // 1/29 long: what is left of their lengths bounds what the map can keep.
  for(const auto& [shift, tolerance] : {std::pair(1e6, 1e-5), std::pair(1e9, 1e-2)}) {
    const std::string in = write("far.off", off(moved(soup, 1, shift)));
    const Outcome outcome = parameterize(in, "out.obj", precise);
    EXPECT_EQ(outcome.exit_code, 0) << shift << outcome.err;
    EXPECT_LT(distance(read_obj(folder / "out.obj"), expected), tolerance) << shift;
  }
}

// ---------------------------------------------------------------------------------------------
// Pins

TEST_F(Program, keeps_pins_exactly)
{
  const std::string in = write("in.off", off(grid(20, hilly)));
  const Texts pins{"--pin", "0=0.1,0.25", "--pin", "399=-3.5,7e-1", "--pin", "210=0,0"};
  ASSERT_EQ(parameterize(in, "out.obj", pins).exit_code, 0);
  const Result result = read_obj(folder / "out.obj");
  EXPECT_EQ(result.uv[0], (std::array<double, 2>{0.1, 0.25}));
  EXPECT_EQ(result.uv[399], (std::array<double, 2>{-3.5, 0.7}));
  EXPECT_EQ(result.uv[210], (std::array<double, 2>{0, 0}));
  const Json json = report(in, pins);
  ASSERT_EQ(json["pins"].size(), 3u);
  for(const Json& pin : json["pins"]) {
    const auto& uv = result.uv[pin["index"].get<std::size_t>()];
    EXPECT_EQ(pin["uv"], Json({uv[0], uv[1]}));
  }
}

TEST_F(Program, refuses_pins_that_fix_nothing)
{
  const std::string in = write("in.off", off(grid(4, flat)));
  const std::vector<std::pair<Texts, std::string>> cases{
      {{"--pin", "3=0,0", "--pin", "3=1,0"}, "vertex 3 is pinned twice"},
      {{"--pin", "3=0.5,0", "--pin", "4=0.5,0"}, "same place"},
      {{"--pin", "3=0,0", "--pin", "16=1,0"}, "pin 16 is out of range"},
      {{"--pin", "3=0,0", "--pin", "99999999999999=1,0"}, "out of range"}};
  for(const auto& [pins, words] : cases) {
    const Outcome outcome = parameterize(in, "out.obj", pins);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, in, {words}), "");
    EXPECT_FALSE(fs::exists(folder / "out.obj"));
  }
}

TEST_F(Program, warns_of_adjacent_pins)
{
  const std::string in = write("in.off", off(grid(10, hilly)));
  const Outcome outcome = parameterize(in, "out.obj", {"--pin", "0=0,0", "--pin", "1=1,0"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("hlscm: warning: "), std::string::npos);
  EXPECT_NE(outcome.err.find("neighbours"), std::string::npos) << outcome.err;
}

// ---------------------------------------------------------------------------------------------
// Output

TEST_F(Program, writes_obj_in_the_order_of_the_input)
{
  const Soup soup = grid(12, hilly);
  ASSERT_EQ(parameterize(write("in.off", off(soup)), "out.obj").exit_code, 0);
  const Result result = read_obj(folder / "out.obj");
  EXPECT_EQ(result.points, soup.points);
  EXPECT_EQ(result.faces, soup.faces);
  ASSERT_EQ(result.uv.size(), soup.points.size());
  double low = 1, high = 0;
  for(const auto& uv : result.uv) {
    low = std::min({low, uv[0], uv[1]});
    high = std::max({high, uv[0], uv[1]});
  }
  EXPECT_EQ(low, 0);
  EXPECT_NEAR(high, 1, 1e-12);
  EXPECT_LE(high, 1);
}

TEST_F(Program, writes_ply_that_cgal_reads)
{
  const Soup soup = grid(12, hilly);
  const std::string in = write("in.off", off(soup));
  ASSERT_EQ(parameterize(in, "out.obj").exit_code, 0);
  ASSERT_EQ(parameterize(in, "out.ply").exit_code, 0);
  const Result expected = read_obj(folder / "out.obj");

  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh mesh;
  std::ifstream file(path("out.ply"), std::ios::binary);
  ASSERT_TRUE(CGAL::IO::read_PLY(file, mesh));
  ASSERT_EQ(mesh.number_of_vertices(), soup.points.size());
  ASSERT_EQ(mesh.number_of_faces(), soup.faces.size());
  const auto u = mesh.property_map<Mesh::Vertex_index, double>("v:texture_u");
  const auto v = mesh.property_map<Mesh::Vertex_index, double>("v:texture_v");
  const auto s = mesh.property_map<Mesh::Vertex_index, float>("v:s");
  ASSERT_TRUE(u.second && v.second && s.second);
  for(const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    EXPECT_EQ((std::array<double, 3>{p.x(), p.y(), p.z()}), soup.points[vertex]);
    EXPECT_EQ((std::array<double, 2>{u.first[vertex], v.first[vertex]}), expected.uv[vertex]);
    EXPECT_EQ(s.first[vertex], float(u.first[vertex]));
  }
}

// The same mesh in all formats: the same result; and CGAL's readers see the same.
TEST_F(Program, reads_all_formats)
{
  Soup soup = grid(9, hilly);
  for(auto& p : soup.points) {
    p = {float(p[0]), float(p[1]), float(p[2])}; // all that binary STL can hold
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.off", off(soup)},
      {"a.obj", obj(soup)},
      {"a.ply", ply(soup, "ascii")},
      {"b.ply", ply(soup, "binary_little_endian")},
      {"c.ply", ply(soup, "binary_big_endian")},
      {"A.OFF", off(soup)}};
  std::string expected;
  for(const auto& [name, bytes] : files) {
    const std::string in = write(name, bytes);
    ASSERT_EQ(parameterize(in, "out.obj").exit_code, 0) << name;
    const std::string result = read_file(folder / "out.obj");
    expected = expected.empty() ? result : expected;
    EXPECT_EQ(result, expected) << name;
  }
  for(const auto& [name, is_binary] : {std::pair("a.stl", true), std::pair("b.stl", false)}) {
    const std::string in = write(name, stl(soup, is_binary));
    ASSERT_EQ(parameterize(in, "out.obj").exit_code, 0) << name;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    ASSERT_TRUE(CGAL::IO::read_polygon_soup(in, points, faces));
    const Result result = read_obj(folder / "out.obj");
    EXPECT_EQ(result.faces, faces) << name;
    ASSERT_EQ(result.points.size(), points.size());
    for(std::size_t v = 0; v < points.size(); ++v) {
      EXPECT_EQ(Kernel::Point_3(result.points[v][0], result.points[v][1], result.points[v][2]),
                points[v]);
    }
  }
}

TEST_F(Program, reports_what_it_did)
{
  const Json json = report(write("in.off", off(wall(60))), {"--coarsest", "200"});
  EXPECT_EQ(json["method"], "hlscm");
  EXPECT_EQ(json["vertices"], 3600);
  EXPECT_EQ(json["faces"], 2 * 59 * 59);
  EXPECT_EQ(json["borders"], 1);
  EXPECT_EQ(json["pins"].size(), 2u);
  EXPECT_GE(json["levels"].get<int>(), 2);
  EXPECT_EQ(json["level_table"].size(), json["levels"].get<std::size_t>());
  EXPECT_GE(json["iterations"].get<int>(), 1);
  EXPECT_EQ(json["converged"], true);
  EXPECT_EQ(json["flips"], 0);
  const double energy = json["energy"], gap = json["energy_gap_estimate"];
  EXPECT_GT(energy, 0);
  EXPECT_LT(gap, 0.011 * energy);
  EXPECT_NEAR(json["distortion"]["conformal_energy"].get<double>(), energy, 1e-6 * energy);
  EXPECT_GT(json["peak_memory_mb"].get<double>(), 1);
  double sum = 0;
  for(const char* stage : {"hierarchy", "operators", "solve"}) {
    sum += json["seconds"][stage].get<double>();
  }
  EXPECT_LE(sum, json["seconds"]["total"].get<double>());
  EXPECT_GE(json["seconds"]["read"].get<double>(), 0);
  EXPECT_GE(json["seconds"]["write"].get<double>(), 0);
}

TEST_F(Program, prints_a_table_unless_quiet)
{
  const std::string in = write("in.off", off(grid(12, hilly)));
  const Outcome normal = parameterize(in, "out.obj");
  EXPECT_NE(normal.out.find("144 vertices, 242 faces, 1 border"), std::string::npos) << normal.out;
  EXPECT_EQ(normal.err, "");
  const Outcome quiet = parameterize(in, "out.obj", {"--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Program, shows_the_levels_if_verbose)
{
  const std::string in = write("in.off", off(grid(50, hilly)));
  const Outcome silent = parameterize(in, "out.obj", {"--quiet"});
  const Outcome verbose
    = parameterize(in, "out.obj", {"--quiet", "--verbose", "--coarsest", "200"});
  ASSERT_EQ(verbose.exit_code, 0);
  EXPECT_EQ(verbose.out, "");
  EXPECT_EQ(silent.err, "");
  EXPECT_NE(verbose.err.find("level    vertices       faces     entries"), std::string::npos);
  EXPECT_NE(verbose.err.find("2500"), std::string::npos); // vertices of the finest level
  EXPECT_NE(verbose.err.find("hlscm: converged"), std::string::npos);
}

TEST_F(Program, knows_all_its_options)
{
  const std::string in = write("in.off", off(grid(50, flat)));
  const std::vector<Texts> all{
      {"--method", "hlscm"},       {"--method", "lscm"},      {"--method", "direct"},
      {"--method", "spectral"},
      {"--weights", "cgal"},       {"--schedule", "1,1,2"},   {"--ratio", "6"},
      {"--engine", "flat-strict"}, {"--engine", "cgal"},      {"--prolongation", "vsplit"},
      {"--angular-defect", "30"},  {"--iterations", "100000"}};
  for(Texts options : all) {
    SCOPED_TRACE(options[0] + " " + options[1]);
    options.insert(options.end(), {"--coarsest", "100", "--tolerance", "1e-8"});
    const Json json = report(in, options);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["converged"], true);
    EXPECT_EQ(json["flips"], 0);
    EXPECT_LT(json["distortion"]["quasi_conformal_max"].get<double>(), 1.05); // planar: exact
  }
  const Json cascadic = report(in, {"--method", "cascadic", "--coarsest", "100"});
  EXPECT_EQ(cascadic["method"], "cascadic");
}

// A surface so rough that its least squares conformal map has flipped triangles.
TEST_F(Program, repairs_flipped_triangles)
{
  unsigned state = 1;
  const std::string in = write("in.off", off(grid(40, [&state](double, double) {
    state = state * 1664525u + 1013904223u;
    return 0.15 * double(state >> 8) / double(1 << 24);
  })));
  const Json plain = report(in), repaired = report(in, {"--repair-flips"});
  ASSERT_GT(plain["flips"].get<int>(), 0); // or this test would not test anything
  EXPECT_FALSE(plain.contains("flip_repair"));
  const Json& repair = repaired["flip_repair"];
  EXPECT_EQ(repair["flipped_before"], plain["flips"]);
  EXPECT_EQ(repair["flipped_after"], 0);
  EXPECT_TRUE(repair["unmended_faces"].empty());
  EXPECT_GT(repair["moved_vertices"].get<int>(), 0);
  EXPECT_EQ(repair["energy_after"], repaired["energy"]);
  EXPECT_EQ(repaired["flips"], 0);
  EXPECT_EQ(repaired["degenerate_faces"], 0);
  const Outcome outcome = parameterize(in, "out.obj", {"--repair-flips"});
  EXPECT_NE(outcome.out.find("repair "), std::string::npos) << outcome.out;
}

TEST_F(Program, says_so_when_it_does_not_converge)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const Outcome outcome = parameterize(in, "out.obj",
                                       {"--method", "lscm", "--iterations", "2", "--tolerance",
                                        "1e-9", "--report", path("report.json")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, in, {"not met after 2 iterations"}), "");
  EXPECT_EQ(names(), std::set<std::string>{"in.off"});
}

TEST_F(Program, maps_a_chart_with_two_borders)
{
  const Json json = report(write("band.off", off(band(40, false))));
  EXPECT_EQ(json["borders"], 2);
}

// ---------------------------------------------------------------------------------------------
// Pictures

// Empty if the file is a PNG picture with something on it.
std::string error_in_picture(const fs::path& path)
{
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if(pixels == nullptr) {
    return path.string() + " cannot be read";
  }
  std::set<std::array<unsigned char, 3>> colours;
  std::size_t drawn = 0;
  for(int i = 0; i < width * height; ++i) {
    const std::array<unsigned char, 3> c{pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]};
    drawn += c != std::array<unsigned char, 3>{255, 255, 255};
    colours.insert(c);
  }
  stbi_image_free(pixels);
  const double part = double(drawn) / (double(width) * double(height));
  if(width < 400 || height < 400 || part < 0.2 || part > 0.99 || colours.size() < 50) {
    return path.string() + " is " + std::to_string(width) + " x " + std::to_string(height)
           + ", drawn on " + std::to_string(part) + " of it in " + std::to_string(colours.size())
           + " colours";
  }
  return "";
}

TEST_F(Program, draws_pictures_and_repeats_itself_exactly)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const Texts names{"out.obj",          "out.ply",         "a/b/domain.png",
                    "a/b/isolines.png", "a/b/checker.png", "a/b/levels.png"};
  const Texts coarse{"--coarsest", "200"};
  Texts first;
  for(int i = 0; i < 2; ++i) {
    const Outcome outcome =
        parameterize(in, "out.obj", {"--pictures", path("a/b"), coarse[0], coarse[1]});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(parameterize(in, "out.ply", coarse).exit_code, 0);
    for(std::size_t k = 0; k < names.size(); ++k) {
      const std::string bytes = read_file(folder / names[k]);
      if(i == 0) {
        first.push_back(bytes);
        EXPECT_EQ(k < 2 ? "" : error_in_picture(folder / names[k]), "");
      }
      EXPECT_TRUE(first[k] == bytes) << names[k];
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Files that cannot be written, and interruptions

TEST_F(Program, refuses_unwritable_outputs_before_it_begins)
{
  const std::string in = write("in.off", off(grid(4, flat)));
  write("file", "was here before");
  fs::create_directory(folder / "folder.obj");
  const std::string good = path("out.obj");
  struct Case
  {
    Texts arguments;
    std::string file, words;
  };
  const std::vector<Case> cases{
      {{"-o", path("no/out.obj")}, path("no/out.obj"), "cannot be written"},
      {{"-o", path("file/out.obj")}, path("file/out.obj"), "cannot be written"},
      {{"-o", path("folder.obj")}, path("folder.obj"), "folder"},
      {{"-o", good, "--report", path("no/r.json")}, path("no/r.json"), "cannot be written"},
      {{"-o", good, "--report", path("./out.obj")}, good, "two outputs"},
      {{"-o", good, "--report", in}, in, "the output is the input"},
      {{"-o", good, "--pictures", path("file")}, path("file"), "file"},
      {{"-o", good, "--pictures", path("file/p")}, path("file/p"), "folder"}};
  for(const Case& c : cases) {
    Texts arguments{"parameterize", in};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, c.file, {c.words}), "");
  }
  const std::string over_itself = write("in.obj", obj(grid(4, flat)));
  const Outcome outcome = run({"parameterize", over_itself, "-o", over_itself});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, over_itself, {"the output is the input"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"file", "folder.obj", "in.obj", "in.off"}));
  EXPECT_EQ(read_file(folder / "in.obj"), obj(grid(4, flat)));
}

TEST_F(Program, leaves_nothing_when_the_disk_is_full)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  write("out.obj", "was here before");
  const auto limit_file_size = [] {
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  const Outcome outcome =
      finish(start({"parameterize", in, "-o", path("out.obj")}, limit_file_size));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(error_in_message(outcome.err, path("out.obj"), {"writing failed"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"in.off", "out.obj"}));
  EXPECT_EQ(read_file(folder / "out.obj"), "was here before");
}

TEST_F(Program, stops_within_a_second)
{
  const std::string in = write("in.off", off(grid(500, hilly)));
  write("out.ply", "was here before");
  std::size_t stopped = 0;
  for(const Texts& options : {Texts{}, Texts{"--method", "direct"}, Texts{"--engine", "cgal"}}) {
    for(int milliseconds : {1, 150, 400, 800}) {
      Texts arguments{
          "parameterize",     in, "-o", path("out.ply"), "--pictures", path("pictures"), "--report",
          path("report.json")};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const pid_t child = start(arguments);
      const Clock::time_point begin = Clock::now();
      while(!fs::exists(folder / "pictures") && Clock::now() - begin < std::chrono::seconds(5)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // until it has begun
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      kill(child, milliseconds == 150 ? SIGTERM : SIGINT);
      const Outcome outcome = finish(child);
      if(outcome.exit_code == 0) {
        continue; // it was faster
      }
      ++stopped;
      EXPECT_LT(outcome.seconds, 1) << milliseconds;
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_EQ(outcome.err, "hlscm: cancelled\n");
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(names(), (std::set<std::string>{"in.off", "out.ply"})) << milliseconds;
      EXPECT_EQ(read_file(folder / "out.ply"), "was here before");
    }
  }
  EXPECT_GE(stopped, 6u);
}

// ---------------------------------------------------------------------------------------------
// info

TEST_F(Program, knows_what_a_mesh_is)
{
  struct Case
  {
    std::string name;
    Soup soup;
    Json expected;
  };
  Soup two = grid(3, flat);
  two.points.push_back({9, 9, 9});
  two.faces.push_back({0, 1, 2});
  const std::vector<Case> cases{
      {"grid",
       grid(9, hilly),
       {{"components", 1},
        {"borders", 1},
        {"euler_characteristic", 1},
        {"genus", 0},
        {"orientable", true},
        {"manifold", true},
        {"can_be_parameterized", true},
        {"can_have_an_atlas", true}}},
      {"band",
       band(20, false),
       {{"components", 1},
        {"borders", 2},
        {"euler_characteristic", 0},
        {"genus", 0},
        {"can_be_parameterized", true}}},
      {"moebius",
       band(20, true),
       {{"components", 1},
        {"borders", 1},
        {"euler_characteristic", 0},
        {"genus", nullptr},
        {"orientable", false},
        {"can_be_parameterized", false},
        {"can_have_an_atlas", false}}},
      {"torus",
       torus(9, false),
       {{"components", 1},
        {"borders", 0},
        {"euler_characteristic", 0},
        {"genus", 1},
        {"can_be_parameterized", false},
        {"can_have_an_atlas", true}}},
      {"open_torus", torus(9, true), {{"borders", 1}, {"euler_characteristic", -1}, {"genus", 1}}},
      {"fan", fan(100), {{"vertices", 101}, {"edges", 200}, {"faces", 100}, {"borders", 1}}}};
  for(const Case& c : cases) {
    const Outcome outcome = run({"info", write(c.name + ".off", off(c.soup)), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    for(const auto& [key, value] : c.expected.items()) {
      EXPECT_EQ(json[key], value) << c.name << " " << key;
    }
    EXPECT_EQ(json["can_be_parameterized"].get<bool>(), json["obstacles"].empty());
  }
}

// What makes `parameterize` refuse a mesh is an obstacle of `info`, in the same words; and `atlas`
// takes what `info` says that it does.
TEST_F(Program, agrees_with_itself)
{
  for(const Bad_file& bad : bad_files()) {
    const std::string in = write(bad.name, bad.bytes);
    const Outcome info = run({"info", in, "--json"});
    const Outcome text = run({"info", in});
    EXPECT_EQ(info.exit_code, text.exit_code);
    const Outcome refused = parameterize(in, "out.obj");
    if(info.exit_code != 0) { // the file could not be read
      EXPECT_EQ(info.err, refused.err);
      continue;
    }
    const Json json = Json::parse(info.out), first = json["obstacles"][0];
    const Outcome atlas = run({"atlas", in, "-o", path("atlas"), "--texture", "256"});
    EXPECT_EQ(atlas.exit_code == 0, json["can_have_an_atlas"].get<bool>()) << in << atlas.err;
    EXPECT_EQ(refused.err, "hlscm: error: " + in + ": " + first["what"].get<std::string>() + ", "
                               + first["remedy"].get<std::string>() + "\n");
    EXPECT_NE(text.out.find(first["what"].get<std::string>()), std::string::npos);
  }
}

} // namespace program_test
