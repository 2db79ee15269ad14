// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs `hlscm levels` on generated files.

#include <support/textured_soups.h>

#include <map>

namespace program_test {

// Empty if the corners of `level` are corners of `fine`, to the bit, and if each edge is used once
// in each direction, or `border_edges` of them in one only.
std::string error_in_level(const Textured_soup& level, const Textured_soup& fine,
                           std::size_t border_edges)
{
  typedef std::array<double, 5> Corner;
  const auto corner = [](const Textured_soup& soup, std::size_t f, std::size_t c) {
    const auto& p = soup.surface.points[soup.surface.faces[f][c]];
    const auto& q = soup.uv[soup.uv_faces[f][c]];
    return Corner{p[0], p[1], p[2], q[0], q[1]};
  };
  std::set<Corner> corners;
  for(std::size_t f = 0; f < fine.surface.faces.size(); ++f) {
    for(std::size_t c = 0; c < 3; ++c) {
      corners.insert(corner(fine, f, c));
    }
  }
  std::set<std::array<std::size_t, 2>> edges;
  for(std::size_t f = 0; f < level.surface.faces.size(); ++f) {
    for(std::size_t c = 0; c < 3; ++c) {
      if(corners.count(corner(level, f, c)) == 0) {
        return "a corner of face " + std::to_string(f) + " is not one of the fine mesh";
      }
      const auto& face = level.surface.faces[f];
      if(!edges.insert({face[c], face[(c + 1) % 3]}).second) {
        return "an edge is used twice in one direction";
      }
    }
  }
  std::size_t single = 0;
  for(const auto& edge : edges) {
    single += edges.count({edge[1], edge[0]}) == 0;
  }
  return single == border_edges ? "" : std::to_string(single) + " edges have one face only";
}

class Levels : public Program
{
protected:
  Outcome levels(const std::string& input, const std::string& folder_name,
                 const Texts& options = {}) const
  {
    Texts arguments{"levels", input, "-o", path(folder_name)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }

  Json levels_report(const std::string& input, const std::string& folder_name,
                     const Texts& options = {}) const
  {
    Texts all{"--report", path("report.json")};
    all.insert(all.end(), options.begin(), options.end());
    const Outcome outcome = levels(input, folder_name, all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(read_file(folder / "report.json")) : Json();
  }
};

std::string name_of(const Json& level)
{
  return "level_" + std::to_string(level["faces"].get<std::size_t>());
}

TEST_F(Levels, share_the_map_of_a_chart)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  const Json json = levels_report(in, "out", {"--faces", "2000,400"});
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["faces"], 2 * 59 * 59);
  EXPECT_EQ(json["method"], "hlscm");
  ASSERT_EQ(parameterize(in, "all.obj").exit_code, 0);
  const Textured_soup fine = read_textured_obj(folder / "all.obj");
  ASSERT_EQ(json["levels"].size(), 2u);
  for(const Json& level : json["levels"]) {
    const fs::path file = folder / "out" / (name_of(level) + ".obj");
    const Textured_soup soup = read_textured_obj(file);
    EXPECT_EQ(soup.surface.faces.size(), level["faces"]);
    EXPECT_EQ(soup.surface.points.size(), level["vertices"]);
    const std::size_t border = 2 * soup.surface.points.size() - 2 - soup.surface.faces.size();
    EXPECT_EQ(error_in_level(soup, fine, border), ""); // Euler's formula for a disk
    EXPECT_LT(level["texture_deviation"]["mean"], 0.02);
    EXPECT_LE(level["distance"]["mean"], level["texture_deviation"]["mean"]);
  }
  for(const auto& [level, wanted] : {std::pair(0, 2000), std::pair(1, 400)}) {
    EXPECT_LE(json["levels"][level]["faces"], wanted);
    EXPECT_GE(json["levels"][level]["faces"], wanted - 2); // a collapse removes one or two
  }
  for(const char* name : {"out/levels.glb", "out/mesh.pm"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
}

TEST_F(Levels, keep_the_seams_of_a_textured_mesh)
{
  const Textured_soup torus = cut_torus(30, 4);
  const std::string in = write("in.obj", obj(torus));
  const Json json = levels_report(in, "out", {"--faces", "1500,600", "--format", "obj,ply"});
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json.count("method"), 0u); // nothing was parameterized
  EXPECT_EQ(json["texture_vertices"], torus.uv.size());
  for(const Json& level : json["levels"]) {
    const Textured_soup soup = read_textured_obj(folder / "out" / (name_of(level) + ".obj"));
    EXPECT_EQ(soup.surface.faces.size(), level["faces"]);
    EXPECT_EQ(error_in_level(soup, torus, 0), "");
    EXPECT_EQ(2 * soup.surface.points.size(), soup.surface.faces.size()); // genus 1
    EXPECT_GT(soup.uv.size(), soup.surface.points.size());
  }
  // PLY has one vertex a texture coordinate: the charts apart
  const std::string ply = (folder / "out" / (name_of(json["levels"][0]) + ".ply")).string();
  const Json again = levels_report(ply, "again", {"--faces", "900"});
  ASSERT_TRUE(again.is_object());
  EXPECT_EQ(again.count("method"), 0u);
  EXPECT_EQ(again["faces"], json["levels"][0]["faces"]);
  EXPECT_EQ(again["vertices"], json["levels"][0]["texture_vertices"]);
}

TEST_F(Levels, are_the_same_from_the_file_of_the_progressive_mesh)
{
  const std::string in = write("in.obj", obj(cut_torus(30, 4)));
  const Texts options{"--faces", "1500,600", "--format", "obj,pm,glb", "--lossless"};
  ASSERT_EQ(levels(in, "first", options).exit_code, 0);
  ASSERT_EQ(levels(path("first/mesh.pm"), "second", options).exit_code, 0);
  for(const auto& entry : fs::directory_iterator(folder / "first")) {
    const fs::path other = folder / "second" / entry.path().filename();
    EXPECT_TRUE(read_file(entry.path()) == read_file(other)) << other;
  }
  const Outcome over_itself = levels(path("first/mesh.pm"), "first", {"--format", "pm"});
  EXPECT_EQ(over_itself.exit_code, 1);
  EXPECT_EQ(error_in_message(over_itself.err, path("first/mesh.pm"), {"the output is the input"}),
            "");
}

TEST_F(Levels, of_a_file_that_was_cut_short_are_coarser)
{
  const std::string in = write("in.off", off(grid(120, hilly)));
  ASSERT_EQ(levels(in, "whole", {"--format", "pm"}).exit_code, 0);
  const std::string bytes = read_file(folder / "whole/mesh.pm");
  const std::string cut = write("cut.pm", bytes.substr(0, bytes.size() * 3 / 4));
  const Outcome outcome = levels(cut, "part", {"--faces", "500"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: " + cut), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "part/levels.glb"));
  const std::string start = write("start.pm", bytes.substr(0, 20));
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = char(flipped[bytes.size() / 2] ^ 4);
  for(const std::string& bad : {start, write("flipped.pm", flipped), write("empty.pm", ""),
                                write("other.pm", off(grid(4, flat)))}) {
    const Outcome failed = levels(bad, "none");
    EXPECT_EQ(failed.exit_code, 1) << bad;
    EXPECT_EQ(error_in_message(failed.err, bad, {}), "");
    EXPECT_FALSE(fs::exists(folder / "none")) << bad;
  }
}

TEST_F(Levels, keep_within_an_error)
{
  const std::string in = write("in.off", off(grid(80, hilly)));
  for(const std::string kind : {"", "texture-"}) {
    const std::string what = kind.empty() ? "distance" : "texture_deviation";
    std::size_t faces = 0;
    for(const std::string bound : {"0.5%", "0.002"}) {
      const Json json
          = levels_report(in, "out", {"--" + kind + "error", bound, "--format", "glb"});
      ASSERT_EQ(json["levels"].size(), 1u);
      const Json& level = json["levels"][0];
      const double length
          = bound.back() == '%' ? 0.005 * json["diagonal"].get<double>() : 0.002;
      EXPECT_LE(level[what]["max"].get<double>(), length);
      EXPECT_LT(level["faces"], json["faces"]);
      EXPECT_GT(level["faces"], faces);
      faces = level["faces"];
    }
  }
}

TEST_F(Levels, stand_in_one_glb_file)
{
  const std::string in = write("in.obj", obj(cut_torus(30, 4)));
  const Json report = levels_report(in, "out", {"--faces", "2000,1000,500", "--format", "glb"});
  const Json gltf = json_of_glb(read_file(folder / "out/levels.glb"));
  ASSERT_EQ(gltf["meshes"].size(), 3u);
  EXPECT_EQ(gltf["extensionsUsed"], Json({"MSFT_lod"}));
  EXPECT_EQ(gltf["scenes"][0]["nodes"], Json({0}));
  EXPECT_EQ(gltf["nodes"][0]["extensions"]["MSFT_lod"]["ids"], Json({1, 2}));
  const Json& coverage = gltf["nodes"][0]["extras"]["MSFT_screencoverage"];
  ASSERT_EQ(coverage.size(), 3u);
  EXPECT_GT(coverage[0], coverage[1]);
  EXPECT_EQ(coverage[2], 0.);
  EXPECT_EQ(gltf["images"][0]["mimeType"], "image/png");
  Json primitive_indices;
  const auto check_accessor = [&](const Json& index, std::size_t count, std::size_t item_size) {
    const Json& accessor = gltf["accessors"][index.get<std::size_t>()];
    EXPECT_EQ(accessor["count"], count);
    const Json& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_LE(count * item_size, view["byteLength"].get<std::size_t>());
    if(index != primitive_indices) { // required where accessors share a view
      EXPECT_EQ(view["byteStride"], item_size);
    }
    const std::size_t begin = view.value("byteOffset", std::size_t(0));
    EXPECT_EQ(begin % 4, 0u);
    EXPECT_LE(begin + view["byteLength"].get<std::size_t>(),
              gltf["buffers"][0]["byteLength"].get<std::size_t>());
  };
  for(std::size_t i = 0; i < 3; ++i) {
    const Json& level = report["levels"][i];
    const Json& primitive = gltf["meshes"][i]["primitives"][0];
    const std::size_t wedges = level["texture_vertices"];
    primitive_indices = primitive["indices"];
    check_accessor(primitive["indices"], 3 * level["faces"].get<std::size_t>(), 4);
    check_accessor(primitive["attributes"]["POSITION"], wedges, 12);
    check_accessor(primitive["attributes"]["NORMAL"], wedges, 12);
    check_accessor(primitive["attributes"]["TEXCOORD_0"], wedges, 8);
    EXPECT_EQ(gltf["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["min"]
                  .size(), 3u);
  }
}

TEST_F(Levels, are_drawn_and_repeat_themselves_exactly)
{
  const std::string in = write("in.off", off(grid(60, hilly)));
  std::map<std::string, std::string> first;
  for(const char* threads : {"1", "2"}) {
    ASSERT_EQ(levels(in, "out", {"--pictures", path("pictures"), "--threads", threads}).exit_code, 0);
    for(const char* name : {"out/levels.glb", "out/mesh.pm", "pictures/levels.png",
                            "pictures/swimming.png"}) {
      const std::string bytes = read_file(folder / name);
      EXPECT_FALSE(bytes.empty());
      EXPECT_TRUE(first.emplace(name, bytes).first->second == bytes) << name;
    }
  }
}

TEST_F(Levels, refuse_what_they_cannot_do)
{
  const std::string good = write("in.off", off(grid(8, hilly)));
  for(const Texts& wrong : std::vector<Texts>{{"--faces", "10,x"}, {"--faces", "0"},
                                              {"--error", "-1"}, {"--error", "5%%"},
                                              {"--texture-error", "x"},
                                              {"--format", "stl"}, {"--format", ""}}) {
    EXPECT_EQ(levels(good, "out", wrong).exit_code, 2) << wrong[0] << " " << wrong[1];
  }
  EXPECT_EQ(run({"levels", good}).exit_code, 2);
  write("closed.off", off(torus(8, false)));
  Textured_soup broken = cut_torus(6, 2);
  broken.surface.faces.pop_back();
  broken.surface.faces.push_back(broken.surface.faces[0]);
  const Outcome twice = levels(write("twice.obj", obj(broken)), "out", {"--strict"});
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_EQ(error_in_message(twice.err, path("twice.obj"), {"same vertices"}), "");
  broken = cut_torus(6, 2);
  broken.uv[3][1] = std::nan("");
  const Outcome not_finite = levels(write("nan.obj", obj(broken)), "out");
  EXPECT_EQ(not_finite.exit_code, 1);
  EXPECT_EQ(error_in_message(not_finite.err, path("nan.obj"), {"not a finite number"}), "");
  write("file", "was here before");
  EXPECT_EQ(levels(good, "file").exit_code, 1);
  EXPECT_EQ(levels(good, "file/below").exit_code, 1);
  const Outcome report_over_input = levels(good, "out", {"--report", good});
  EXPECT_EQ(report_over_input.exit_code, 1);
  EXPECT_EQ(error_in_message(report_over_input.err, good, {"the output is the input"}), "");
  EXPECT_EQ(names(), (std::set<std::string>{"closed.off", "file", "in.off", "nan.obj", "twice.obj"}));
  // A GLB file has numbers of 32 bits
  const std::string huge = write("huge.off", off(moved(grid(8, hilly), 1e39, 0)));
  const Outcome beyond_floats = levels(huge, "out");
  EXPECT_EQ(beyond_floats.exit_code, 1);
  EXPECT_EQ(error_in_message(beyond_floats.err, huge, {"numbers of 32 bits"}), "");
  EXPECT_EQ(levels(huge, "out", {"--format", "obj"}).exit_code, 0);
  // More than can be removed is a warning
  const std::string genus_1 = write("torus.obj", obj(cut_torus(6, 2)));
  const Outcome few = levels(genus_1, "out", {"--faces", "1"});
  EXPECT_EQ(few.exit_code, 0);
  EXPECT_NE(few.err.find("no level has fewer than"), std::string::npos) << few.err;
}

} // namespace program_test
