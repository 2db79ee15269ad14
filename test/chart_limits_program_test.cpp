// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs `hlscm atlas` on meshes with groups and materials, and with seams that cut faces.

#include <support/program_atlases.h>
#include <support/textured_soups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace program_test {

// An OBJ file with a line before some faces.
std::string with_lines(const std::string& file, const std::vector<std::string>& before_faces)
{
  std::istringstream in(file);
  std::string result;
  std::size_t face = 0;
  for(std::string line; std::getline(in, line);) {
    if(line.rfind("f ", 0) == 0) {
      if(!before_faces[face].empty()) {
        result += before_faces[face] + "\n";
      }
      ++face;
    }
    result += line + "\n";
  }
  return result;
}

TEST_F(Atlas, has_seams_between_groups_and_materials)
{
  const Soup surface = grid(9, flat);
  std::vector<std::string> lines(surface.faces.size());
  lines[0] = "usemtl wood\ng left";
  lines[lines.size() / 4] = "g left";
  lines[lines.size() / 2] = "g right";
  lines[3 * lines.size() / 4] = "usemtl stone";
  const std::string in = write("in.obj", with_lines(obj(surface), lines));
  // Whether a texture coordinate belongs to faces on both sides of a limit.
  const auto have_common_uv = [&](std::size_t limit) {
    std::set<std::size_t> first, second;
    const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
    for(std::size_t f = 0; f < after.uv_faces.size(); ++f) {
      (f < limit ? first : second).insert(after.uv_faces[f].begin(), after.uv_faces[f].end());
    }
    std::vector<std::size_t> common;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                          std::back_inserter(common));
    return !common.empty();
  };
  const auto charts_of_parts = [&](const std::string& limits, std::size_t second) {
    call_well("atlas", in, "out");
    EXPECT_TRUE(have_common_uv(second)) << limits;
    const Json report = call_well("atlas", in, "out", {"--limits", limits});
    EXPECT_EQ(report["layout"]["limits"]["parts"], 2);
    EXPECT_GE(report["number_of_charts"], 2);
    EXPECT_FALSE(have_common_uv(second)) << limits;
  };
  charts_of_parts("groups", lines.size() / 2);
  charts_of_parts("materials", 3 * lines.size() / 4);
  const std::string bare = write("bare.obj", obj(surface));
  EXPECT_EQ(error_in_message(call("atlas", bare, "none", {"--limits", "groups"}).err, bare,
                             {"it has no groups"}), "");
  EXPECT_EQ(error_in_message(call("atlas", bare, "none", {"--limits", "materials"}).err, bare,
                             {"it has no materials"}), "");
}

TEST_F(Atlas, has_textures_for_each_material)
{
  const Soup surface = grid(9, flat);
  std::vector<std::string> lines(surface.faces.size());
  lines[0] = "usemtl wood";
  lines[lines.size() / 3] = "usemtl stone";
  lines[2 * lines.size() / 3] = "usemtl wood";
  const std::string in = write("in.obj", with_lines(obj(surface), lines));
  const Json report
      = call_well("atlas", in, "out", {"--separate", "materials", "--texture", "128", "--bend", "0"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["pages"], 2);
  EXPECT_EQ(report["layout"]["separate"]["by"], "materials");
  EXPECT_EQ(report["layout"]["separate"]["pages"], (Json{"wood", "stone"}));
  EXPECT_EQ(report["overlapping_texels"], 0);
  // Each fills its own page, stone with more texels to a face, since it has half as many
  const Textured_soup after = read_model(folder / "out/atlas.obj").soup;
  const double wood = std::abs(uv_area(after, 0));
  const double stone = std::abs(uv_area(after, surface.faces.size() / 2));
  EXPECT_NEAR(std::abs(uv_area(after, surface.faces.size() - 1)) / wood, 1, 1e-6);
  EXPECT_GT(stone / wood, 1.3);
  const Json& densities = report["layout"]["texels_per_unit_of_charts"];
  EXPECT_NEAR(std::pow(double(densities["most"]) / double(densities["least"]), 2), stone / wood,
              1e-5);
  std::ifstream text(folder / "out/atlas.obj");
  std::string last, line;
  for(std::size_t face = 0; std::getline(text, line);) {
    last = line.rfind("usemtl", 0) == 0 ? line : last;
    if(line.rfind("f ", 0) == 0) {
      const bool is_stone = face >= lines.size() / 3 && face < 2 * lines.size() / 3;
      EXPECT_EQ(last, is_stone ? "usemtl page_2" : "usemtl page_1") << face;
      ++face;
    }
  }
}

// --- Seams through faces

// Edges that do not have a face on each side.
std::size_t open_edges(const Textured_soup& soup)
{
  std::map<std::pair<std::size_t, std::size_t>, int> balance;
  for(const std::vector<std::size_t>& face : soup.surface.faces) {
    for(std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t v = face[c], w = face[(c + 1) % face.size()];
      balance[std::minmax(v, w)] += v < w ? 1 : -1;
    }
  }
  return std::size_t(std::count_if(balance.begin(), balance.end(),
                                   [](const auto& edge) { return edge.second != 0; }));
}

TEST_F(Atlas, leads_seams_through_faces)
{
  const Soup surface = wavy_torus(20);
  std::vector<std::string> lines(surface.faces.size());
  lines[0] = "g left";
  lines[lines.size() / 2] = "g right";
  const Texts usual{"--texture", "256", "--seam-price", "inf"};
  ASSERT_TRUE(call_well("atlas", write("bare.obj", with_lines(obj(surface), lines)), "charts", usual)
                .is_object());
  const std::string in = (folder / "charts/atlas.obj").string(); // the same charts for both
  Texts with_option{"--texture", "256", "--charts", "uv"};
  const Json plain = call_well("atlas", in, "plain", with_option);
  with_option.push_back("--smooth-seams");
  const Json smooth = call_well("atlas", in, "out", with_option);
  ASSERT_TRUE(plain.is_object() && smooth.is_object());
  EXPECT_LT(smooth["seams"]["jaggedness"], plain["seams"]["jaggedness"]);
  EXPECT_EQ(smooth["charts"].size(), plain["charts"].size());
  EXPECT_LT(smooth["seam_length"], plain["seam_length"]);
  EXPECT_EQ(smooth["overlapping_texels"], 0);
  const Obj_model model = read_model(folder / "out/atlas.obj");
  EXPECT_EQ(error_in_texture(model, 256), "");
  EXPECT_GT(model.soup.surface.faces.size(), surface.faces.size());
  EXPECT_EQ(open_edges(model.soup), 0u); // no vertex of a seam is on another edge
  const std::string text = read_file(folder / "out/atlas.obj");
  EXPECT_LT(text.find("g left"), text.find("g right"));
  EXPECT_NE(text.find("g right"), std::string::npos);
  with_option.insert(with_option.end(), {"--faces", "300"});
  ASSERT_TRUE(call_well("bake", in, "light", with_option).is_object());
  EXPECT_EQ(open_edges(read_model(folder / "light/light.obj").soup), 0u);
  const std::string quad = write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(error_in_message(call("atlas", quad, "none", {"--smooth-seams"}).err, quad,
                             {"more than three corners", "--smooth-seams"}), "");
  for(const Texts& other : {Texts{"--stack"}, {"--limits", "groups"}, {"--separate", "groups"}}) {
    Texts options = other;
    options.push_back("--smooth-seams");
    const Outcome outcome = call("atlas", in, "none", options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--smooth-seams: it moves seams and cuts faces"), std::string::npos)
        << outcome.err;
  }
  EXPECT_EQ(call("atlas", in, "none", {"--one-disk", "--method", "low-stretch"}).exit_code, 2);
}

} // namespace program_test
