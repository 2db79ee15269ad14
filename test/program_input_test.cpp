// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on generated files: bad files, and meshes that are hardly
// any.

#include <support/program_runs.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace program_input_test {

using namespace program_test;

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
       {"face 0", "vertex -2"}},
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
    const Texts outputs{"--report", path("report.json"), "--pictures", path("pictures"), "--strict"};
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
          outcome.exit_code == 1 || outcome.err.find("no line feed") != std::string::npos
          || outcome.err.find("in no face") != std::string::npos;
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

// What makes `parameterize --strict` refuse a mesh is an obstacle of `info`, in the same words; and
// both commands take what `info` says that they do.
TEST_F(Program, agrees_with_itself)
{
  for(const Bad_file& bad : bad_files()) {
    const std::string in = write(bad.name, bad.bytes);
    const Outcome info = run({"info", in, "--json"});
    const Outcome text = run({"info", in});
    EXPECT_EQ(info.exit_code, text.exit_code);
    const Outcome refused = parameterize(in, "out.obj", {"--strict"}), taken = parameterize(in, "out.obj");
    if(info.exit_code != 0) { // the file could not be read
      EXPECT_EQ(info.err, refused.err);
      continue;
    }
    const Json json = Json::parse(info.out), first = json["obstacles"][0];
    const Outcome atlas = run({"atlas", in, "-o", path("atlas"), "--texture", "256"});
    EXPECT_EQ(taken.exit_code == 0, json["can_be_parameterized"].get<bool>()) << in << taken.err;
    EXPECT_EQ(atlas.exit_code == 0, json["can_have_an_atlas"].get<bool>()) << in << atlas.err;
    EXPECT_EQ(refused.err, "hlscm: error: " + in + ": " + first["what"].get<std::string>() + ", "
                               + first["remedy"].get<std::string>() + "\n");
    EXPECT_NE(text.out.find(first["what"].get<std::string>()), std::string::npos);
  }
}

} // namespace program_input_test
