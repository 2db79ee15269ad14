// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on generated files: the maps that it makes, their files and
// their report.

#include <support/textured_soups.h>

#include <CGAL/IO/PLY.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace program_maps_test {

using namespace program_test;

using Kernel = CGAL::Simple_cartesian<double>;

// A property map that was looked for: with a flag in CGAL 5, optional in CGAL 6.
template <class Map>
bool is_found(const std::pair<Map, bool>& map) { return map.second; }
template <class Optional_map>
bool is_found(const Optional_map& map) { return bool(map); }
template <class Map>
const Map& found(const std::pair<Map, bool>& map) { return map.first; }
template <class Optional_map>
const auto& found(const Optional_map& map) { return *map; }

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
  ASSERT_TRUE(is_found(u) && is_found(v) && is_found(s));
  for(const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    EXPECT_EQ((std::array<double, 3>{p.x(), p.y(), p.z()}), soup.points[vertex]);
    EXPECT_EQ((std::array<double, 2>{found(u)[vertex], found(v)[vertex]}), expected.uv[vertex]);
    EXPECT_EQ(found(s)[vertex], float(found(u)[vertex]));
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

} // namespace program_maps_test
