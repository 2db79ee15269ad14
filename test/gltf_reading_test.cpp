// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the program reads of .glb and .gltf files.

#include <support/gltf_in_the_making.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace gltf_reading_test {

using namespace read_meshes;
std::vector<std::pair<std::string, Gltf>> variants()
{
  std::vector<double> soup, behind(9, 5.), shifted;
  for(const double v : two_triangles) {
    soup.insert(soup.end(), square.begin() + 3 * int(v), square.begin() + 3 * int(v) + 3);
    shifted.push_back(v + 3);
  }
  behind.insert(behind.end(), square.begin(), square.end());
  const Json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  return {
      {"indices of 8 bits", mesh_of(square, two_triangles, UBYTE)},
      {"indices of 16 bits", mesh_of(square, two_triangles, USHORT)},
      {"no indices", mesh_of(soup, {})},
      {"vertices that nothing uses", mesh_of(behind, shifted)},
      {"a fan", changed([](Gltf& file) {
         file = mesh_of(square, {0, 1, 2, 3});
         file.primitive()["mode"] = 6;
       })},
      {"mode 4", changed([](Gltf& file) { file.primitive()["mode"] = 4; })},
      {"interleaved", interleaved()},
      {"sparse", sparse(false)},
      {"sparse over others", sparse(true)},
      {"bytes", with_positions_of(BYTE, 1, false)},
      {"bytes that are fractions", with_positions_of(BYTE, 127, true)},
      {"unsigned bytes that are fractions", with_positions_of(UBYTE, 255, true)},
      {"unsigned bytes", with_positions_of(UBYTE, 1, false)},
      {"shorts", with_positions_of(SHORT, 1, false)},
      {"shorts that are fractions", with_positions_of(SHORT, 32767, true)},
      {"unsigned shorts that are fractions", with_positions_of(USHORT, 65535, true)},
      {"no scene", changed([](Gltf& file) {
         file.json.erase("scenes");
         file.json.erase("scene");
       })},
      {"no default scene", changed([](Gltf& file) { file.json.erase("scene"); })},
      {"no nodes", changed([](Gltf& file) {
         file.json.erase("scenes");
         file.json.erase("scene");
         file.json.erase("nodes");
       })},
      {"an identity", changed([&](Gltf& file) { file.json["nodes"][0]["matrix"] = identity; })},
      {"a node that undoes its parent", changed([&](Gltf& file) {
         file.json["nodes"] = {{{"children", {1}}, {"scale", {2, 4, 8}}},
                               {{"mesh", 0}, {"scale", {0.5, 0.25, 0.125}}}};
       })},
      {"another scene", changed([&](Gltf& file) {
         file.json["scenes"] = {{{"nodes", {7}}}, {{"nodes", {0}}}};
         file.json["scene"] = 1;
       })},
      {"compressed as well as not", changed([](Gltf& file) {
         file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 9}};
       })},
      {"deeply nested extras", changed([](Gltf& file) { file.json["extras"] = "HERE"; })},
  };
}

TEST(Gltf_reading, takes_any_variant_for_the_same_mesh)
{
  const Outcome expected = read("m.glb", clean().glb());
  ASSERT_TRUE(expected.mesh) << expected.error;
  EXPECT_TRUE(expected.mesh->warnings.empty());
  EXPECT_TRUE(expected.mesh->lines.empty());
  EXPECT_EQ(expected.mesh->soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(expected.mesh->soup.points.back(), Polygon_soup::Point_3(0., 1., 1.));
  for(auto& [what, file] : variants()) {
    SCOPED_TRACE(what);
    const std::string bytes = file.glb();
    std::string text = file.gltf();
    const std::string nested = std::string(200000, '[') + std::string(200000, ']');
    const std::size_t here = text.find("\"HERE\"");
    if(here != std::string::npos) {
      text.replace(here, 6, nested);
    }
    for(const Outcome& outcome :
        {read("m.glb", bytes), read("m.gltf", text), read("m.glb", text), read("m.gltf", bytes),
         read("-", bytes), read("-", "\xef\xbb\xbf \r\n" + text), read("m.glb.gz", packed(bytes)),
         read("m.glb", bytes + "x")})
    {
      ASSERT_TRUE(outcome.mesh) << outcome.error;
      EXPECT_EQ(difference(outcome.mesh->soup, expected.mesh->soup), "");
    }
  }
}

TEST(Gltf_reading, takes_buffers_from_files_beside_it)
{
  std::string pattern = (std::filesystem::temp_directory_path() / "hlscm-test-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  Gltf file = clean();
  std::ofstream(folder / "a b.bin", std::ios::binary) << file.buffer;
  std::filesystem::create_directory(folder / "sub");
  const std::string name = (folder / "m.gltf").string();
  for(const std::string uri : {"a%20b.bin", "a b.bin", "sub/../a%20b.bin"}) {
    const Outcome outcome = read(name, file.gltf(uri));
    ASSERT_TRUE(outcome.mesh) << outcome.error;
    EXPECT_EQ(outcome.mesh->soup.number_of_faces(), 2u);
  }
  const std::vector<std::pair<std::string, std::string>> bad{
      {"none.bin", "none.bin: there is no such file"},
      {"sub", "this is a folder"},
      {(folder / "a b.bin").string(), "no file beside it"},
      {"http://x/a.bin", "no file beside it"},
      {"data:;base64,AAAA", "buffer 0 promises"},
      {"data:text/plain,AAAA", "not in base64"},
      {"data:;base64,A?==", "not in base64"}};
  for(const auto& [uri, words] : bad) {
    const Outcome outcome = read(name, file.gltf(uri));
    EXPECT_NE(outcome.error.find(words), std::string::npos) << words << ": " << outcome.error;
    EXPECT_EQ(outcome.error.rfind(name + ": ", 0), 0u) << outcome.error;
  }
  std::filesystem::remove_all(folder);
}

TEST(Gltf_reading, makes_triangles_of_strips)
{
  Gltf file = mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, {0, 1, 2, 3, 3, 2, 2, 3, 4});
  file.primitive()["mode"] = 5;
  const Outcome outcome = read("m.glb", file.glb());
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  EXPECT_EQ(outcome.mesh->soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4}));
}

TEST(Gltf_reading, puts_meshes_in_their_places)
{
  Gltf file = mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  const double half = std::sqrt(0.5);
  file.json["nodes"] = {
      {{"children", {1, 2}}, {"translation", {10, 0, 0}}, {"name", "root"}},
      {{"mesh", 0},
       {"name", " a\nb "},
       {"rotation", {0, 0, half, half}},
       {"scale", {2, 3, 4}}}, // a quarter turn
      {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}}}; // a mirror
  const Outcome outcome = read("m.glb", file.glb());
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  const auto& soup = outcome.mesh->soup;
  const std::vector<Polygon_soup::Point_3> expected{{10., 0., 0.}, {10., 2., 0.}, {7., 0., 0.},
                                                    {10., 0., 5.}, {9., 0., 5.},  {10., 1., 5.}};
  ASSERT_EQ(soup.points.size(), expected.size());
  for(std::size_t v = 0; v < expected.size(); ++v) {
    EXPECT_LT(CGAL::squared_distance(soup.points[v], expected[v]), 1e-24) << v;
  }
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4}));
  ASSERT_EQ(outcome.mesh->lines.size(), 2u);
  EXPECT_EQ(outcome.mesh->lines[0].text, "o a b");
  EXPECT_EQ(outcome.mesh->lines[1].text, "o mesh_0");
  EXPECT_EQ(outcome.mesh->lines[1].face, 1u);
}

TEST(Gltf_reading, welds_points_and_keeps_texture_coordinates_and_materials)
{
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
  Gltf file = mesh_of(points, {0, 1, 2, 3, 4, 5});
  file.primitive()["attributes"]["TEXCOORD_0"] =
      file.add_accessor({0, 0, 51, 0, 51, 255, 0, 102, 51, 102, 0, 204}, "VEC2", UBYTE);
  file.accessor("TEXCOORD_0")["normalized"] = true;
  file.primitive()["material"] = 1;
  Json second = file.primitive();
  second.erase("material");
  file.json["meshes"][0]["primitives"].push_back(second);
  file.json["meshes"][0]["name"] = "thing";
  file.json["materials"] = {{{"name", "red"}}, Json::object()};
  const Outcome outcome = read("m.glb", file.glb());
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  const auto& soup = outcome.mesh->soup;
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}));
  ASSERT_TRUE(soup.has_uv());
  const auto uv = [&soup](std::size_t corner) { return soup.uv[soup.uv_corners[corner]]; };
  EXPECT_EQ(uv(0), Polygon_soup::Point_2(0., 1.));
  EXPECT_EQ(uv(2), Polygon_soup::Point_2(0.2, 0.));
  EXPECT_EQ(uv(3), Polygon_soup::Point_2(0., 1 - 0.4)); // the same point, another coordinate
  EXPECT_EQ(uv(11), Polygon_soup::Point_2(0., 1 - 0.8));
  ASSERT_EQ(outcome.mesh->lines.size(), 3u);
  EXPECT_EQ(outcome.mesh->lines[0].text, "o thing");
  EXPECT_EQ(outcome.mesh->lines[1].text, "usemtl material_1");
  EXPECT_EQ(outcome.mesh->lines[2].text, "usemtl None");
  EXPECT_EQ(outcome.mesh->lines[2].face, 2u);
}

TEST(Gltf_reading, warns_of_what_is_left_out)
{
  const std::vector<std::pair<Gltf, std::string>> files{
      {changed([](Gltf& file) {
         file.json["meshes"][0]["primitives"].push_back(file.primitive());
         file.json["meshes"][0]["primitives"][1]["mode"] = 1;
       }),
       "points or lines are left out: 1"},
      {changed([](Gltf& file) {
         file.json["nodes"][0]["skin"] = 0;
         file.json["nodes"][0]["scale"] = {2, 2, 2};
       }),
       "skeleton"},
      {changed([](Gltf& file) { file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"}; }),
       "EXT_mesh_gpu_instancing"},
      {changed([](Gltf& file) {
         file.json["meshes"][0]["primitives"].push_back(file.primitive());
         file.primitive()["attributes"]["TEXCOORD_0"] =
             file.add_accessor(std::vector<double>(8, 0.), "VEC2");
       }),
       "not all corners have texture coordinates"}};
  for(auto [file, words] : files) {
    const Outcome outcome = read("m.glb", file.glb());
    ASSERT_TRUE(outcome.mesh) << outcome.error;
    ASSERT_EQ(outcome.mesh->warnings.size(), 1u) << words;
    EXPECT_NE(outcome.mesh->warnings[0].find(words), std::string::npos)
        << outcome.mesh->warnings[0];
  }
}

TEST(Gltf_reading, does_not_place_meshes_without_end)
{
  std::vector<double> indices;
  for(std::size_t i = 0; i < 300000; ++i) {
    indices.push_back(double(i % 3));
  }
  Gltf file = mesh_of(square, indices, UBYTE);
  for(std::size_t n = 1; n < 500; ++n) {
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"].push_back(n);
  }
  const Outcome outcome = read("m.glb", file.glb());
  EXPECT_NE(outcome.error.find("134217728 corners in all"), std::string::npos) << outcome.error;
}

TEST(Gltf_reading, names_what_it_cannot_read)
{
  const std::string good = clean().glb();
  std::string old = good, longer = good;
  old[4] = 1;
  ++longer[8];
  const std::size_t json_at = 20;
  std::string damaged = good;
  damaged[json_at + 5] = '\x01';
  const std::vector<std::pair<Gltf, std::string>> files{
      {changed(
           [](Gltf& file) { file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
       "compressed by Draco (KHR_draco_mesh_compression), which cannot be read, export the mesh "
       "without"},
      {changed([](Gltf& file) {
         file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
         file.json["accessors"][0].erase("bufferView");
       }),
       "compressed by Draco"},
      {changed([](Gltf& file) { file.json["extensionsRequired"] = {"EXT_meshopt_compression"}; }),
       "compressed by meshopt"},
      {changed([](Gltf& file) {
         file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
       }),
       "compressed by meshopt"},
      {changed([](Gltf& file) {
         file.json["meshes"] = {{"a", 1}};
       }),
       "of glTF 1.0"},
      {changed([](Gltf& file) { file.json["asset"]["version"] = "1.0"; }), "of glTF 1.0"},
      {changed([](Gltf& file) { file.json["accessors"][0]["count"] = 5; }),
       "accessor 0 reaches up to byte 60 of a buffer view of 48 bytes"},
      {changed([](Gltf& file) { file.json["accessors"][0]["count"] = 3; }),
       "primitive 0 of mesh 0 names vertex 3 in its index 5"},
      {changed([](Gltf& file) { file.json["accessors"][0]["byteOffset"] = 1000000; }),
       "accessor 0 reaches"},
      {changed([](Gltf& file) { file.json["accessors"][0]["byteOffset"] = -4; }),
       "accessor 0 has a bad number for byteOffset"},
      {changed([](Gltf& file) { file.json["accessors"][0]["count"] = 1e18; }),
       "accessor 0 has a bad number for count"},
      {changed([](Gltf& file) { file.json["accessors"][0]["componentType"] = 5124; }),
       "unknown type 5124"},
      {changed([](Gltf& file) { file.json["accessors"][0]["type"] = "VEC2"; }),
       "should have the type VEC3"},
      {changed([](Gltf& file) {
         file.json["accessors"][0].erase("bufferView");
         file.json["accessors"][0]["count"] = 1000000;
       }),
       "promises 1000000 elements without bytes"},
      {changed([](Gltf& file) { file.json["accessors"][1]["componentType"] = int(SHORT); }),
       "no unsigned whole numbers"},
      {changed([](Gltf& file) { file.json["accessors"][1]["count"] = 5; }),
       "5 corners, no multiple of three"},
      {changed([](Gltf& file) { file.json["bufferViews"][0]["byteLength"] = 1000; }),
       "buffer view 0 reaches up to byte 1000 of a buffer of 72 bytes"},
      {changed([](Gltf& file) { file.json["bufferViews"][0]["byteStride"] = 3; }),
       "stride of 3 bytes"},
      {changed([](Gltf& file) { file.json["bufferViews"][0]["buffer"] = 1; }),
       "buffer 1 is named but is not there"},
      {changed([](Gltf& file) { file.primitive()["attributes"].erase("POSITION"); }),
       "primitive 0 of mesh 0 has no POSITION"},
      {changed([](Gltf& file) { file.primitive()["mode"] = 7; }), "unknown mode 7"},
      {changed([](Gltf& file) { file.json["nodes"][0]["children"] = {0}; }),
       "node 0 is the child of two nodes"},
      {changed([](Gltf& file) { file.json["nodes"][0]["children"] = {9}; }),
       "node 9 is named but is not there"},
      {changed([](Gltf& file) {
         file.json["nodes"][0]["matrix"] = {1, 2};
       }),
       "matrix should be 16 numbers"},
      {changed([](Gltf& file) { file.json["meshes"][0]["primitives"] = Json::array(); }),
       "there is no face in it"}};
  for(auto [file, words] : files) {
    const Outcome outcome = read("m.glb", file.glb());
    EXPECT_FALSE(outcome.mesh) << words;
    EXPECT_NE(outcome.error.find(words), std::string::npos) << words << ": " << outcome.error;
  }
  const std::vector<std::pair<std::string, std::string>> bytes{
      {old, "GLB file of version 1"},
      {longer, "the file ends after"},
      {good.substr(0, 15), "15 bytes, too few"},
      {good.substr(0, good.size() - 4), "at byte " + std::to_string(good.size() - 4)},
      {damaged, "JSON cannot be read at byte 26"},
      {"[1, 2]", "its JSON is no object"},
      {"{\"a\": 1e999}", "number out of range"},
      {"{", "JSON cannot be read at byte"},
      {std::string(100000, '['), "JSON cannot be read at byte"}};
  for(const auto& [file, words] : bytes) {
    const Outcome outcome = read("m.gltf", file);
    EXPECT_FALSE(outcome.mesh) << words;
    EXPECT_NE(outcome.error.find(words), std::string::npos) << words << ": " << outcome.error;
  }
}

// Each number, text, array and object of the JSON by turns becomes something else: then the file is
// read or refused by a sentence, and no byte outside of it is looked at.
TEST(Gltf_reading, survives_any_change_of_one_value)
{
  const std::vector<Json> others{nullptr,
                                 true,
                                 -1,
                                 0,
                                 1,
                                 3,
                                 4,
                                 5,
                                 65535,
                                 4294967295u,
                                 1099511627776,
                                 9007199254740993,
                                 1e300,
                                 0.5,
                                 "x",
                                 Json::array(),
                                 {0},
                                 Json::object()};
  for(Gltf file : {clean(), sparse(true), interleaved(), with_positions_of(SHORT, 32767, true)}) {
    file.json["nodes"][0]["scale"] = {1, 2, 3};
    file.primitive()["attributes"]["TEXCOORD_0"] =
        file.add_accessor(std::vector<double>(8, 0.5), "VEC2");
    file.glb();
    const Json flat = file.json.flatten();
    std::size_t read_well = 0;
    for(auto entry = flat.begin(); entry != flat.end(); ++entry) {
      for(Json::json_pointer place(entry.key()); !place.empty(); place = place.parent_pointer()) {
        for(const Json& other : others) {
          Json json = file.json;
          json[place] = other;
          const Outcome outcome = read("m.glb", Gltf::glb_of(json.dump(), file.buffer));
          read_well += outcome.mesh.has_value();
          ASSERT_TRUE(outcome.mesh || outcome.error.size() > 10) << place << other;
        }
      }
    }
    EXPECT_GT(read_well, 50u);
  }
}

} // namespace gltf_reading_test
