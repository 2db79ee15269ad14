// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the readers of the program make of the bytes of files, but for glTF: see gltf_reading_test.

#include <support/mesh_file_variants.h>

#include <formats/Text_scanner.h>
#include <reading/File_bytes.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <random>

namespace reading_test {

using namespace read_meshes;

void expect_same(const std::vector<Variant>& variants, const Read_mesh& clean)
{
  for(const Variant& variant : variants) {
    SCOPED_TRACE(variant.what);
    const Outcome outcome = read(variant.name, variant.bytes);
    ASSERT_TRUE(outcome.mesh) << outcome.error;
    EXPECT_EQ(difference(outcome.mesh->soup, clean.soup), "");
  }
}

TEST(Reading, takes_any_variant_of_a_file_for_the_same_mesh)
{
  const Outcome clean = read("m.obj", clean_obj);
  ASSERT_TRUE(clean.mesh) << clean.error;
  EXPECT_EQ(clean.mesh->soup.number_of_faces(), 2u);
  EXPECT_EQ(clean.mesh->soup.number_of_vertices(), 5u);
  EXPECT_TRUE(clean.mesh->warnings.empty());
  expect_same(obj_variants(), *clean.mesh);
  expect_same(off_variants(), *clean.mesh);
  expect_same(ply_variants(), *clean.mesh);
}

TEST(Reading, takes_any_variant_of_stl)
{
  const Outcome clean = read("m.stl", stl_text());
  ASSERT_TRUE(clean.mesh) << clean.error;
  EXPECT_EQ(clean.mesh->soup.number_of_vertices(), 4u);
  EXPECT_EQ(clean.mesh->soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  std::string capitals = stl_text();
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  expect_same({{"capitals", "m.stl", capitals},
               {"a byte order mark", "m.stl", bom + stl_text()},
               {"CR", "m.stl", replaced(stl_text(), "\n", "\r")},
               {"one line", "m.stl", replaced(stl_text(), "\n", " ")},
               {"-0", "m.stl", replaced(stl_text(), "vertex 0 0 0", "vertex -0 -0.0 0")},
               {"the standard input", "-", stl_text()},
               {"binary", "m.stl", stl_binary("some header")},
               {"binary on the standard input", "-", stl_binary("solid OFF")},
               {"binary with bytes behind on the standard input", "-", stl_binary("header") + "ab"},
               {"binary with a byte order mark in its comment", "m.stl", stl_binary(bom)},
               {"binary with solid", "m.stl", stl_binary("solid of a program")},
               {"binary with solid and bytes behind", "m.stl", stl_binary("solid x") + "ab"},
               {"binary with bytes behind", "m.stl", stl_binary("x") + std::string(60, 'x')},
               {"binary, packed", "m.stl.gz", packed(stl_binary("x"))}},
              *clean.mesh);
}

// ---------------------------------------------------------------------------------------------
// What is said about it

TEST(Reading, warns_of_what_is_left_out)
{
  const std::string binary_ply = ply_variants()[7].bytes;
  const std::vector<std::tuple<std::string, std::string, std::string>> files{
      {"m.obj", clean_obj + "l 1 2\nl 2 3\n", "(l) are left out: 2"},
      {"m.obj", clean_obj + "p 1\n", "(p) are left out: 1"},
      {"m.obj", clean_obj + "\nfoo\nbar 7\nfoo\n",
       "1 with bar (the first in line 10), 2 with foo (the first in line 9)"},
      {"m.obj", clean_obj + "a\nb\nc\nd\ne\nf1\ng1\n", "and 2 further words"},
      {"m.obj", "v 0 0 0 1 0 0\n" + clean_obj, "colours, weights"},
      {"m.obj", "vt 0 0\nf 1/1 2/1 3/1\n" + clean_obj, "not all corners have texture coordinates"},
      {"m.obj", "vn 0 0 1\nf 1//1 2//1 3//1\n" + clean_obj, "not all corners have normals"},
      {"m.obj", "v 0 0 0\nf 1/1 1/1 1/7\n", "a texture coordinate that is not among the 0"},
      {"m.obj", clean_obj + "f 1 2 3", "no line feed"},
      {"m.off", clean_off + "3 0 1 2\n", "line 10 and what follows"},
      {"m.off", clean_off.substr(4), "OFF is missing"},
      {"m.off", "geom\n" + clean_off, "before the word OFF in line 2"},
      {"m.ply", binary_ply + "abc", "3 bytes from byte " + std::to_string(binary_ply.size())},
      {"m.stl", stl_binary("solid x") + "ab", "2 bytes from byte 184"}};
  for(const auto& [name, bytes, warning] : files) {
    const Outcome outcome = read(name, bytes);
    ASSERT_TRUE(outcome.mesh) << warning << outcome.error;
    ASSERT_EQ(outcome.mesh->warnings.size(), 1u) << warning;
    EXPECT_NE(outcome.mesh->warnings[0].find(warning), std::string::npos)
        << outcome.mesh->warnings[0];
  }
}

TEST(Reading, names_the_place_of_what_it_cannot_read)
{
  const std::string strips =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\n"
      "property int z\nelement tristrips 1\n";
  const std::string corners =
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  const std::string pack = packed(clean_obj);
  std::string damaged = pack;
  damaged[damaged.size() - 6] ^= 1; // of the checksum
  std::string short_ply = ply_variants()[7].bytes, far_ply = short_ply;
  short_ply.pop_back();
  far_ply[far_ply.size() - 4] = 9;
  const std::vector<std::tuple<std::string, std::string, std::string>> files{
      {"m.obj", std::string("v 0\0", 4), "byte 3 is zero, this is no OBJ text"},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "1/x 2 3 4"),
       "line 6 should hold the corners of face 0"},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "1/1/1/1 2 3 4"), "line 6 "},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "1/0 2 3 4"), "line 6 "},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "0 2 3 4"), "line 6 "},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "/1 2 3 4"), "line 6 "},
      {"m.obj", replaced(clean_obj, "1 2 3 4", "1.5 2 3 4"), "line 6 "},
      {"m.obj", replaced(clean_obj, "2 5 3", "2 6 3"),
       "face 1 in line 7 names a vertex that is not among the 5"},
      {"m.obj", replaced(clean_obj, "2 5 3", "2 \\\n 6 3 \n #"), "face 1 in line 7 "},
      {"m.obj", replaced(clean_obj, "\n", "\r") + "v 1 2\r",
       "line 8 should hold the coordinates of vertex 5"},
      {"m.obj", "v 0 0 0\\\n\nv 1 2 \\\n x\n", "line 3 "},
      {"m.off", replaced(clean_off, "1 4 2", "1 5 2"), "face 1 in line 9 names vertex 5"},
      {"m.off", replaced(clean_off, "1 0 0.5", "1 0"),
       "line 4 should hold the coordinates of vertex 1"},
      {"m.off", replaced(clean_off, "1 0 0.5", "1 0 x"), "line 4 "},
      {"m.off", replaced(clean_off, "OFF", "STOFF"),
       "line 3 should hold the texture coordinates of vertex 0"},
      {"m.off", clean_off.substr(0, clean_off.size() - 9), "1 of 2 faces, at byte 64"},
      {"m.off", "n" + clean_off, "n-dimensional"},
      {"m.off", "OFF BINARY\n" + clean_off, "binary OFF"},
      {"m.ply", replaced(ply_variants()[0].bytes, "3 1 4 2", "3 1 4.5 2"),
       "face 1 names vertex 4.500000 in line 17, which is no whole number"},
      {"m.ply", replaced(ply_variants()[0].bytes, "3 1 4 2", "3 1 -4 2"),
       "face 1 names vertex -4 in line 17"},
      {"m.ply", replaced(ply_variants()[0].bytes, "3 1 4 2", "3 1 x 2"),
       "face 1 of 2 cannot be read in line 17"},
      {"m.ply", short_ply,
       "face 1 of 2 cannot be read at byte " + std::to_string(short_ply.size())},
      {"m.ply", far_ply, "face 1 names vertex 9 at byte " + std::to_string(far_ply.size())},
      {"m.ply", strips + corners + "4 0 1 2 3\n", "face 0 names vertex 3"},
      {"m.ply", strips + "property int x\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
       "no list of vertex_indices"},
      {"m.stl", replaced(stl_text(), "vertex 1 1 0", "vertex 1 x 0"),
       "triangle 0 has a corner without three coordinates in line 6"},
      {"m.stl", replaced(stl_text(), "vertex 1 1 0\n", ""), "triangle 0 has 2 corners in line 7"},
      {"m.stl", stl_text().substr(0, 80), "the file ends within triangle 0 in line 7"},
      {"m.stl", stl_binary("solid x").substr(0, 150), "endsolid is missing"},
      {"m.obj.gz", pack.substr(0, pack.size() - 9),
       "ends too early, after " + std::to_string(pack.size() - 9) + " bytes"},
      {"m.obj.gz", damaged, "damaged near byte"},
      {"m.obj.gz", packed(""), "empty"},
      {"m.obj", bom, "byte order mark and nothing else"},
      {"-", std::string("\0\1\2", 3), "no format known"},
      {"-", "", "standard input: the file is empty"},
      {"m.xyz.gz", pack, "extension \".xyz\""}};
  for(const auto& [name, bytes, words] : files) {
    const Outcome outcome = read(name, bytes);
    EXPECT_FALSE(outcome.mesh) << words;
    EXPECT_NE(outcome.error.find(words), std::string::npos) << words << "\n" << outcome.error;
    EXPECT_EQ(outcome.error.find('\n'), std::string::npos) << outcome.error;
  }
}

// Every proper beginning of a file is refused, or it lacks nothing but white space, or there is a
// warning.
TEST(Reading, notices_files_that_were_cut_short)
{
  std::vector<Variant> files = ply_variants();
  const std::vector<Variant> off_files = off_variants();
  files.insert(files.end(), off_files.begin(), off_files.end());
  files.push_back({"obj", "m.obj", clean_obj});
  files.push_back({"packed obj", "m.obj.gz", packed(clean_obj)});
  files.push_back({"binary stl", "m.stl", stl_binary("solid")});
  files.push_back({"stl", "m.stl", stl_text().substr(0, stl_text().size() - 3)});
  for(const Variant& file : files) {
    const std::string& bytes = file.bytes;
    const std::size_t end = file.what == "binary with bytes behind" ? bytes.size() - 2
                            : file.what == "stl"                    ? bytes.size() - 1
                                                                    : bytes.size();
    for(std::size_t size = 0; size < end; ++size) {
      const Outcome outcome = read(file.name, bytes.substr(0, size));
      const bool is_complete = bytes.find_first_not_of(" \n\r#7", size) == std::string::npos;
      // Between two faces of OBJ nothing tells that more should follow.
      const bool is_between = file.what == "obj" && size > 0 && bytes[size - 1] == '\n';
      EXPECT_TRUE(!outcome.mesh || !outcome.mesh->warnings.empty() || is_complete || is_between)
          << file.what << " " << size;
    }
  }
}

// ---------------------------------------------------------------------------------------------
// More than points and faces

TEST(Reading, keeps_normals_and_lines_of_obj)
{
  const Outcome outcome =
      read("m.obj", "mtllib a b.mtl\r\no  thing # 1 \nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 "
                    "0\nvt 0 0\nvt 1 0\n"
                    "s off\nf 1/1/1 2/2/-2 3/-1/2\ng\nusemtl x\\y\nf 3/2/-1 2/1/2 1/1/1\ns 1\n");
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  const Read_mesh& mesh = *outcome.mesh;
  EXPECT_TRUE(mesh.warnings.empty());
  ASSERT_EQ(mesh.normals.size(), 2u);
  EXPECT_EQ(mesh.normals[1].y(), 1);
  EXPECT_EQ(mesh.normal_corners, (std::vector<std::uint32_t>{0, 0, 1, 1, 1, 0}));
  EXPECT_EQ(mesh.soup.uv_corners, (std::vector<std::uint32_t>{0, 1, 1, 1, 0, 0}));
  std::vector<std::pair<std::size_t, std::string>> lines;
  for(const auto& line : mesh.lines) {
    lines.emplace_back(line.face, line.text);
  }
  EXPECT_EQ(lines, (std::vector<std::pair<std::size_t, std::string>>{{0, "mtllib a b.mtl"},
                                                                     {0, "o thing # 1"},
                                                                     {0, "s off"},
                                                                     {1, "g"},
                                                                     {1, "usemtl x\\y"},
                                                                     {2, "s 1"}}));
}

TEST(Reading, takes_texture_coordinates_of_stoff)
{
  const Outcome outcome = read("m.off", "STCNOFF\n3 1 0\n0 0 0  0 0 1  1 1 1 1  0.25 0.5\n"
                                        "1 0 0  0 0 1  1 1 1 1  1 0\n0 1 0  0 0 1  1 1 1  0 -1\n"
                                        "3 2 1 0\n");
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  const auto& soup = outcome.mesh->soup;
  ASSERT_TRUE(soup.has_uv());
  EXPECT_EQ(soup.uv_corners, soup.corners);
  EXPECT_EQ(soup.uv[0], Polygon_soup::Point_2(0.25, 0.5));
  EXPECT_EQ(soup.uv[2], Polygon_soup::Point_2(0, -1));
}

TEST(Reading, makes_triangles_of_strips)
{
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty int x\nproperty int y\n"
      "property int z\nproperty float s\nproperty float t\nelement tristrips 2\n"
      "property list int int vertex_indices\nend_header\n"
      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n0 2 0 0 2\n1 2 0 1 2\n"
      "9 0 1 2 3 -1 2 3 4 5\n6 0 1 1 2 2 3\n";
  const Outcome outcome = read("m.ply", text);
  ASSERT_TRUE(outcome.mesh) << outcome.error;
  const auto& soup = outcome.mesh->soup;
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}));
  EXPECT_EQ(soup.number_of_faces(), 4u);
  EXPECT_EQ(soup.uv_corners, soup.corners);
}

// As the C library reads them.
TEST(Reading, takes_numbers_for_what_they_are)
{
  std::mt19937_64 random(4);
  std::vector<std::string> texts{"0",
                                 "-0",
                                 "1e22",
                                 "1e23",
                                 "9007199254740993",
                                 "123456789012345678",
                                 "0.1",
                                 "1e-22",
                                 "1e-23",
                                 "5e-324",
                                 "1.7976931348623157e308",
                                 "1e309",
                                 "-1e999",
                                 "1e-999",
                                 "00000000000000000000000001.5",
                                 "0.000000000000000000000000015",
                                 "1.",
                                 ".5",
                                 "-.5e1",
                                 "1e+5",
                                 "8.5e-17",
                                 "3.14159265358979323846264338327950288",
                                 "inf",
                                 "-nan",
                                 "infinity",
                                 "1e99999999999",
                                 "1e-99999999999"};
  for(int i = 0; i < 20000; ++i) {
    char text[64];
    const int precision = int(random() % 20);
    double value;
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof value);
    std::snprintf(text, sizeof text, "%.*g", precision, i % 2 ? value : double(bits) * 1e-20);
    texts.push_back(text);
  }
  for(const std::string& text : texts) {
    hlscm::Text_scanner scanner(text.data(), text.data() + text.size());
    ASSERT_TRUE(scanner.next_line());
    const auto value = scanner.number();
    const double expected = std::strtod(text.c_str(), nullptr);
    ASSERT_TRUE(value) << text;
    if(!std::isnan(expected)) {
      EXPECT_EQ(std::memcmp(&*value, &expected, sizeof expected), 0) << text << " " << *value;
    }
  }
  for(const std::string text :
      {"", ".", "-", "+", "+-1", "e5", "1e", "1e+", "1x", "1.5.5", "0x10", "--1", "1,5"})
  {
    hlscm::Text_scanner scanner(text.data(), text.data() + text.size());
    scanner.next_line();
    EXPECT_FALSE(scanner.number()) << text;
  }
}

TEST(Reading, does_not_unpack_more_than_a_mesh_would_be)
{
  const std::string zeros = packed(std::string(1 << 20, '\0'));
  EXPECT_EQ(hlscm::unpack("m", zeros.data(), zeros.data() + zeros.size(), {1 << 20, 1}).size(),
            std::size_t(1) << 20);
  EXPECT_EQ(hlscm::unpack("m", zeros.data(), zeros.data() + zeros.size(), {0, 2000}).size(),
            std::size_t(1) << 20);
  try {
    hlscm::unpack("m", zeros.data(), zeros.data() + zeros.size(), {1 << 19, 200});
    FAIL();
  } catch(const hlscm::Program_error& error) {
    EXPECT_NE(std::string(error.what()).find("unpacks to more than 524288 bytes"),
              std::string::npos)
        << error.what();
  }
}

} // namespace reading_test
