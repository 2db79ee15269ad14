// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs the program hlscm, whose path is HLSCM_PROGRAM, on generated files and a real one: maps with low
// stretch, and maps adapted to a signal.

#include <support/real_meshes.h>
#include <support/textured_soups.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace low_stretch_program_test {

using namespace program_test;

// Lengths are kept better than by a conformal map, and no triangle is flipped.
TEST_F(Program, maps_with_low_stretch)
{
  const std::string in = write("in.off", off(wall(40)));
  const double conformal = report(in)["distortion"]["area_scale_range"];
  for(const char* energy : {"symmetric-dirichlet", "area", "arap", "mips"}) {
    const Json json = report(in, {"--method", "low-stretch", "--energy", energy});
    ASSERT_TRUE(json.is_object()) << energy;
    EXPECT_EQ(json["method"], "low-stretch");
    EXPECT_EQ(json["converged"], true) << energy;
    EXPECT_EQ(json["flips"], 0) << energy;
    EXPECT_EQ(json["degenerate_faces"], 0) << energy;
    EXPECT_LT(json["stretch"]["energy_gap_estimate"].get<double>(), 1e-3) << energy;
    if(std::string(energy) != "mips") { // which is conformal itself
      EXPECT_LT(json["distortion"]["area_scale_range"].get<double>(), conformal) << energy;
    }
  }
  const Texts pins{"--method", "low-stretch", "--pin", "0=0,0", "--pin", "39=0,5"};
  ASSERT_EQ(parameterize(in, "out.obj", pins).exit_code, 0);
  const Textured_soup result = read_textured_obj(folder / "out.obj");
  EXPECT_EQ(result.uv[0], (std::array<double, 2>{0, 0}));
  EXPECT_EQ(result.uv[39], (std::array<double, 2>{0, 5}));
}

// As text, red in one half of the columns.
std::string coloured_ply(const Soup& soup)
{
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(soup.points.size())
                   + "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                     "property uchar green\nproperty uchar blue\nelement face "
                   + std::to_string(soup.faces.size())
                   + "\nproperty list uchar int vertex_indices\nend_header\n";
  for(const auto& p : soup.points) {
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2])
          + (p[0] < 0.5 ? " 255 0 0\n" : " 0 0 0\n");
  }
  for(const auto& face : soup.faces) {
    text += std::to_string(face.size());
    for(const std::size_t v : face) {
      text += " " + std::to_string(v);
    }
    text += "\n";
  }
  return text;
}

TEST_F(Program, adapts_maps_to_a_signal)
{
  const Soup soup = grid(30, hilly);
  const std::string in = write("in.ply", coloured_ply(soup));
  std::string numbers;
  for(std::size_t f = 0; f < soup.faces.size(); ++f) {
    numbers += f % 7 == 0 ? "1 " : "0\n";
  }
  const std::string importance = write("importance.txt", numbers);
  const Json without = report(in, {"--method", "low-stretch"});
  EXPECT_FALSE(without.contains("signal"));
  for(const std::string& signal : {std::string("normals"), std::string("colors"), importance}) {
    const Json json = report(in, {"--method", "low-stretch", "--signal", signal});
    ASSERT_TRUE(json.is_object()) << signal;
    EXPECT_EQ(json["signal"]["of"], signal);
    EXPECT_EQ(json["signal"]["weight"], 4);
    EXPECT_EQ(json["flips"], 0) << signal;
    EXPECT_NE(json["distortion"]["stretch_L2"], without["distortion"]["stretch_L2"]) << signal;
  }
  const Json none
      = report(in, {"--method", "low-stretch", "--signal", "normals", "--signal-weight", "0"});
  EXPECT_EQ(none["distortion"], without["distortion"]);
  const Json conformal = report(in, {"--signal", "colors", "--signal-weight", "9"});
  EXPECT_GT(conformal["distortion"]["quasi_conformal_max"].get<double>(), 1.5);
}

TEST_F(Program, says_what_is_wrong_with_a_signal)
{
  const std::string in = write("in.off", off(grid(6, hilly)));
  const auto expect = [&](const std::string& signal, const std::string& file, const Texts& words) {
    const Outcome outcome
        = parameterize(in, "out.obj", {"--method", "low-stretch", "--signal", signal});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(error_in_message(outcome.err, file, words), "");
  };
  expect("colors", in, {"no colours at its vertices"});
  expect(path("missing.png"), in, {"no texture coordinates"});
  expect(path("missing"), path("missing"), {"cannot be opened"});
  const std::string few = write("few.txt", "1 2 3"), words = write("words.txt", "1 two 3");
  expect(few, few, {"it has 3 numbers"});
  expect(words, words, {"word 2 is not a number"});
  const Outcome conformal = parameterize(in, "out.obj", {"--signal", few});
  EXPECT_EQ(error_in_message(conformal.err, few, {"--method low-stretch"}), "");
  EXPECT_EQ(parameterize(in, "out.obj", {"--signal-weight", "2"}).exit_code, 2);
}

// The border goes to a circle or a square of the area of the surface, in which all uv lie then; a map
// can begin with that of a file, and be one-to-one.
TEST_F(Program, maps_with_low_stretch_and_a_border)
{
  const std::string in = write("in.off", off(wall(40)));
  const Texts stretch{"--method", "low-stretch"};
  const auto with = [&stretch](Texts more) {
    more.insert(more.begin(), stretch.begin(), stretch.end());
    return more;
  };
  const double free = report(in, stretch)["stretch"]["energy"];
  for(const Texts& more : {Texts{"--border", "circle"}, Texts{"--one-to-one"}}) {
    const Json json = report(in, with(more));
    ASSERT_TRUE(json.is_object()) << more[0];
    EXPECT_EQ(json["converged"], true) << more[0];
    EXPECT_EQ(json["flips"], 0) << more[0];
    EXPECT_GE(json["stretch"]["energy"].get<double>(), 0.999 * free) << more[0];
  }
  ASSERT_EQ(parameterize(in, "circle.obj", with({"--border", "circle"})).exit_code, 0);
  const Textured_soup circle = read_textured_obj(folder / "circle.obj");
  double largest = 0;
  for(const auto& uv : circle.uv)
    largest = std::max(largest, std::hypot(uv[0] - 0.5, uv[1] - 0.5));
  EXPECT_NEAR(largest, 0.5, 1e-3);
  const Json from = report(path("circle.obj"), with({"--from-uv"}));
  ASSERT_TRUE(from.is_object());
  EXPECT_EQ(from["flips"], 0);
  EXPECT_NEAR(from["stretch"]["energy"].get<double>(), free, 3e-3 * free);
  EXPECT_NE(parameterize(in, "out.obj", with({"--from-uv"})).err.find("no texture coordinates"),
            std::string::npos);
  for(const Texts& more : {Texts{"--border", "circle"}, Texts{"--one-to-one"}, Texts{"--from-uv"}})
    EXPECT_EQ(parameterize(in, "out.obj", more).exit_code, 2) << more[0];
}

// Five borders that are kept apart cost little energy; where coarse levels end too early they block each
// other for good.
TEST_F(Program, keeps_the_borders_of_a_lion_apart_for_little)
{
  const std::string in = test_support::debian_mesh("lion.off");
  const double free = report(in, {"--method", "low-stretch"})["stretch"]["energy"];
  const Json json = report(in, {"--method", "low-stretch", "--one-to-one"});
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["converged"], true);
  EXPECT_LT(json["stretch"]["energy"].get<double>(), 1.25 * free);
}

// The border of the map lies on the polygon, which is scaled to the area of the surface and then fitted to
// the unit square; faces that count more are stretched less.
TEST_F(Program, maps_with_low_stretch_to_a_polygon_and_with_weights)
{
  Soup soup = grid(24, hilly);
  for(const std::size_t a : {22, 22 * 24}) { // no face has three corners on a side
    const std::size_t first = 2 * (a / 24 * 23 + a % 24), b = a + 24;
    soup.faces[first] = {a, b, a + 1};
    soup.faces[first + 1] = {b, b + 1, a + 1};
  }
  const std::string in = write("in.off", off(soup));
  const std::string polygon = write("l.txt", "0 0\n4 0\n4 2\n2 2\n2 4\n0 4\n");
  ASSERT_EQ(parameterize(in, "l.obj", {"--method", "low-stretch", "--border", polygon}).exit_code, 0);
  const Textured_soup map = read_textured_obj(folder / "l.obj");
  std::size_t corners = 0;
  for(const auto& uv : map.uv) {
    EXPECT_TRUE(uv[0] < 0.5 + 1e-5 || uv[1] < 0.5 + 1e-5) << uv[0] << " " << uv[1];
    for(const auto& c : {std::array<double, 2>{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}) {
      corners += std::hypot(uv[0] - c[0], uv[1] - c[1]) < 1e-5;
    }
  }
  EXPECT_EQ(corners, 6u);

  // The symmetric Dirichlet energy of the first half of the faces, in the unit of length that makes it least
  const auto energy_of_first_half = [&](double weight) {
    std::string weights;
    for(std::size_t f = 0; f < soup.faces.size(); ++f) {
      weights += f < soup.faces.size() / 2 ? std::to_string(weight) + "\n" : "1\n";
    }
    EXPECT_EQ(parameterize(in, "heavy.obj", {"--method", "low-stretch", "--face-weights",
                                             write("weights.txt", weights)}).exit_code, 0);
    const Textured_soup heavy = read_textured_obj(folder / "heavy.obj");
    const auto dot = [](const auto& o, const auto& p, const auto& q) {
      double sum = 0;
      for(std::size_t i = 0; i < o.size(); ++i) {
        sum += (p[i] - o[i]) * (q[i] - o[i]);
      }
      return sum;
    };
    double out = 0, back = 0; // of the map, of its inverse
    for(std::size_t f = 0; f < soup.faces.size() / 2; ++f) {
      const auto& t = soup.faces[f];
      const auto &p = soup.points[t[0]], &q = soup.points[t[1]], &r = soup.points[t[2]];
      const auto &u = heavy.uv[t[0]], &v = heavy.uv[t[1]], &w = heavy.uv[t[2]];
      const double e = dot(p, q, q), g = dot(p, r, r), fg = dot(p, q, r);
      const double area = std::sqrt(e * g - fg * fg);
      const double norm = (g * dot(u, v, v) - 2 * fg * dot(u, v, w) + e * dot(u, w, w)) / (area * area);
      const double det = ((v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0])) / area;
      out += area * norm;
      back += area * norm / (det * det);
    }
    return std::sqrt(out * back);
  };
  EXPECT_LT(energy_of_first_half(100), 0.999 * energy_of_first_half(1));
}

// Each component has the weights of its own faces: alone it has the same energy.
TEST_F(Program, maps_components_with_weights_of_their_own)
{
  const Soup soup = grid(12, hilly);
  Soup twice = soup;
  for(auto p : soup.points) {
    p[0] += 4;
    twice.points.push_back(p);
  }
  for(auto face : soup.faces) {
    for(std::size_t& v : face) {
      v += soup.points.size();
    }
    twice.faces.push_back(face);
  }
  std::string first, second;
  for(std::size_t f = 0; f < soup.faces.size(); ++f) {
    first += f < soup.faces.size() / 2 ? "1\n" : "50\n";
    second += f % 22 < 11 ? "1\n" : "50\n";
  }
  const auto energy = [&](const Soup& in, const std::string& weights) {
    const Json json = report(write("in.off", off(in)), {"--method", "low-stretch", "--tolerance", "1e-6",
                                                        "--face-weights", write("weights.txt", weights)});
    return json.is_object() ? json["stretch"]["energy"].get<double>() : 0;
  };
  const double of_first = energy(soup, first), of_second = energy(soup, second);
  EXPECT_GT(std::abs(of_first - of_second), 1e-3);
  EXPECT_NEAR(energy(twice, first + second), (of_first + of_second) / 2, 1e-5);
}

TEST_F(Program, says_what_is_wrong_with_polygons_and_weights)
{
  const std::string in = write("in.off", off(grid(6, hilly)));
  const auto expect = [&](const char* option, const std::string& value, const std::string& file, const Texts& words) {
    const Outcome outcome = parameterize(in, "out.obj", {"--method", "low-stretch", option, value});
    EXPECT_EQ(outcome.exit_code, 1) << option << " " << value;
    EXPECT_EQ(error_in_message(outcome.err, file, words), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.obj"));
  };
  const std::string odd = write("odd.txt", "0 0 1 0 1"), words = write("words.txt", "0 0 1 x"),
                    crossing = write("crossing.txt", "0 0 1 1 1 0 0 1"), few = write("few.txt", "1 2 3");
  expect("--border", path("missing"), path("missing"), {"cannot be opened", "two numbers"});
  expect("--border", odd, odd, {"5 numbers"});
  expect("--border", words, words, {"word 4 is not a number"});
  expect("--border", crossing, crossing, {"crosses"});
  expect("--face-weights", few, few, {"3 numbers"});
  std::string zero = "0";
  for(int f = 1; f < 2 * 5 * 5; ++f) {
    zero += " 1";
  }
  const std::string zeros = write("zero.txt", zero);
  expect("--face-weights", zeros, zeros, {"face 0"});
  EXPECT_EQ(parameterize(in, "out.obj", {"--face-weights", few}).exit_code, 2);
  EXPECT_EQ(parameterize(in, "out.obj", {"--border", few}).exit_code, 2);
}

} // namespace low_stretch_program_test
