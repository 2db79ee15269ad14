// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs `hlscm atlas` on generated files.

#include <support/program_atlases.h>
#include <support/textured_soups.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace program_test {

double area(const Soup& soup, std::size_t f)
{
  const auto& face = soup.faces[f];
  const Point x = soup.points[face[1]] - soup.points[face[0]],
              y = soup.points[face[2]] - soup.points[face[0]];
  return length({x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]})
         / 2;
}

Soup tetrahedron()
{
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
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

TEST_F(Atlas, fills_the_page_as_is_asked_for)
{
  const std::string in = write("in.off", off(wavy_torus(40)));
  const auto with = [&](const std::string& mesh, const Texts& options) {
    Texts all{"--texture", "256"};
    all.insert(all.end(), options.begin(), options.end());
    return call_well("atlas", mesh, "out", all);
  };
  const Json whole = with(in, {"--seam-price", "inf"}), cut = with(in, {"--seam-price", "0"});
  EXPECT_EQ(whole["page_cuts"], 0);
  EXPECT_EQ(whole["warnings"], Json::array());
  EXPECT_GT(cut["page_cuts"], 0);
  EXPECT_GT(cut["number_of_charts"], whole["number_of_charts"]);
  EXPECT_GT(cut["utilisation"], whole["utilisation"]);
  EXPECT_EQ(error_in_texture(read_model(folder / "out/atlas.obj"), 256), "");
  double area = 0;
  for(const Json& chart : cut["charts"]) {
    area += chart["area"].get<double>();
  }
  EXPECT_NEAR(cut["seams"]["relative_length"],
              cut["seam_length"].get<double>() / std::sqrt(area), 1e-6);
  EXPECT_GE(cut["seams"]["jaggedness"], 1);
  EXPECT_GE(cut["texels"]["density_range"], 1);
  EXPECT_GT(cut["texel_utilisation"], cut["utilisation"]); // texels are touched in part
  const std::string coarse = write("coarse.off", off(wavy_torus(12))); // of which too much is missing to try more
  const Json all = with(coarse, {"--min-used", "99"});
  ASSERT_EQ(all["warnings"].size(), 1u);
  EXPECT_NE(all["warnings"][0].get<std::string>().find("less than 99 %"), std::string::npos);
  EXPECT_GE(all["utilisation"], with(coarse, {})["utilisation"]);
  for(const char* bad : {"-1", "nan", "a", "1e999"}) {
    const Outcome outcome = call("atlas", in, "other", {std::string("--seam-price=") + bad});
    EXPECT_NE(outcome.exit_code, 0) << bad;
    EXPECT_NE(outcome.err.find("--seam-price"), std::string::npos) << outcome.err;
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
          {"--method", "border-first"}, {"--method", "low-stretch"}, {"--method", "spectral"}, {"--method", "hlscm"},
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
  EXPECT_EQ(usual["charts"], reports["--method low-stretch"]["charts"]);
  EXPECT_LE(usual["number_of_charts"], reports["--method border-first"]["number_of_charts"]);
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

TEST_F(Atlas, is_valid_when_its_time_is_up)
{
  const Soup surface = wavy_torus(40);
  const std::string in = write("in.off", off(surface)), warning = "the time was up";
  const Outcome early = call("atlas", in, "early", {"--time-limit", "1e-9", "--texture", "512"});
  EXPECT_EQ(early.exit_code, 0) << early.err;
  EXPECT_NE(early.err.find(warning), std::string::npos) << early.err;
  const Json report = Json::parse(read_file(folder / "early/report.json"), nullptr, false);
  EXPECT_EQ(report["flips"], 0);
  EXPECT_EQ(report["stopped_early"], true);
  EXPECT_EQ(error_in_texture(read_model(folder / "early/atlas.obj"), 512), "");
  const Outcome late = call("atlas", in, "late", {"--time-limit", "1e6", "--texture", "512"});
  EXPECT_EQ(late.err.find(warning), std::string::npos) << late.err;
  ASSERT_TRUE(call_well("atlas", in, "usual", {"--texture", "512"}).is_object());
  EXPECT_EQ(read_file(folder / "late/atlas.obj"), read_file(folder / "usual/atlas.obj"));
  EXPECT_EQ(call("atlas", in, "none", {"--time-limit", "0"}).exit_code, 2);
}

TEST_F(Atlas, is_baked_with_the_samples_that_there_is_time_for)
{
  const std::string in = write("in.off", off(wavy_torus(40)));
  const Texts options = {"--faces", "800", "--texture", "256", "--samples", "5"};
  const auto with_limit = [&](const std::string& limit) {
    Texts all = options;
    all.insert(all.end(), {"--time-limit", limit});
    return all;
  };
  const std::string warning = "samples of a texel";
  const Outcome early = call("bake", in, "early", with_limit("1e-9"));
  EXPECT_EQ(early.exit_code, 0) << early.err;
  EXPECT_NE(early.err.find(warning), std::string::npos) << early.err;
  const Json report = Json::parse(read_file(folder / "early/report.json"), nullptr, false);
  EXPECT_EQ(report["light"]["samples_each_way"], 1);
  EXPECT_EQ(report["light"]["stopped_early"], true);
  EXPECT_EQ(error_in_texture(read_model(folder / "early/light.obj"), 256), "");
  const Outcome late = call("bake", in, "late", with_limit("1e6"));
  EXPECT_EQ(late.err.find(warning), std::string::npos) << late.err;
  ASSERT_TRUE(call_well("bake", in, "usual", options).is_object());
  EXPECT_EQ(read_file(folder / "late/normal.png"), read_file(folder / "usual/normal.png"));
}

// Whenever the time is up: the image is that of a run without a limit and with so many samples. The
// light model has a texture of its own, so all else is the same.
TEST_F(Atlas, is_baked_as_with_fewer_samples_when_the_time_is_up)
{
  const std::string in = write("in.off", off(wavy_torus(40)));
  ASSERT_TRUE(call_well("bake", in, "target", {"--faces", "800", "--texture", "64"}).is_object());
  const auto bake = [&](const std::string& out, const Texts& more) {
    Texts options = {"--target", path("target/light.obj"), "--texture", "256", "--displacement"};
    options.insert(options.end(), more.begin(), more.end());
    return call_well("bake", in, out, options)["light"]["samples_each_way"].get<int>();
  };
  for(const std::string limit : {"1e-9", "0.2", "0.4", "0.8"}) {
    const int samples = bake("limited", {"--samples", "16", "--time-limit", limit});
    EXPECT_EQ(bake("usual", {"--samples", std::to_string(samples)}), samples);
    for(const std::string name : {"normal.png", "displacement.png", "light.obj"}) {
      EXPECT_EQ(read_file(folder / "limited" / name), read_file(folder / "usual" / name))
        << name << " " << limit << " " << samples;
    }
  }
}

// One part is too small for a texture beside the other
TEST_F(Atlas, tells_of_triangles_without_area_in_the_texture)
{
  Soup soup = grid(6, hilly);
  const Soup small = moved(grid(6, hilly), 1e-30, 0);
  const std::size_t first = soup.points.size();
  soup.points.insert(soup.points.end(), small.points.begin(), small.points.end());
  for(auto face : small.faces) {
    for(std::size_t& v : face) {
      v += first;
    }
    soup.faces.push_back(face);
  }
  const Outcome outcome = call("atlas", write("in.off", off(soup)), "out", {"--texture", "128"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("triangles without area in the texture: "), std::string::npos)
      << outcome.err;
}

TEST_F(Atlas, takes_vertices_of_no_face_along)
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
  EXPECT_NE(outcome.err.find("1 vertex is in no face: it is left out (3)"), std::string::npos);
  const Obj_model model = read_model(folder / "out/atlas.obj");
  EXPECT_TRUE(model.soup.surface.points == soup.points);
  EXPECT_TRUE(model.soup.surface.faces == soup.faces);
}

} // namespace program_test
