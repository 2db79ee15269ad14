// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLB files have the chunks of their format and are what tinygltf reads.

#include <support/written_meshes.h>

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_texturing/IO/GLB.h>

#include <CGAL/boost/graph/generators.h>
#include <CGAL/property_map.h>

#ifdef HLSCM_WITH_TINYGLTF
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace glb_writer_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace written_meshes;

// ---------------------------------------------------------------------------------------------
// Models with materials

// The chunks of a GLB file: its JSON and its data.
std::array<std::string, 2> chunks(const std::string& glb)
{
  const auto number = [&](std::size_t at) {
    std::size_t value = 0;
    for(std::size_t i = 4; i-- > 0;)
      value = 256 * value + (unsigned char)(glb[at + i]);
    return value;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(number(4), 2u);
  EXPECT_EQ(number(8), glb.size());
  const std::size_t json = number(12);
  EXPECT_EQ(json % 4, 0u);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(number(20 + json) % 4, 0u);
  EXPECT_EQ(glb.substr(24 + json, 4), std::string("BIN\0", 4));
  EXPECT_EQ(number(20 + json), glb.size() - 28 - json);
  return {glb.substr(20, json), glb.substr(28 + json)};
}

TEST(Writers, glb_has_the_chunks_of_its_format)
{
  const auto [json, data] = chunks(glb_of(two_pages()));
  EXPECT_EQ(json.front(), '{');
  EXPECT_EQ(json.substr(0, json.find_last_not_of(' ') + 1).back(), '}');
  EXPECT_NE(data.find("the colors"), std::string::npos);
  EXPECT_EQ(data.find("the colors"), data.rfind("the colors")); // stored once
  EXPECT_NE(data.find("the normals"), std::string::npos);
  SMT::Textured_model model = two_pages();
  model.name = "a \"name\"\n";
  EXPECT_NE(chunks(glb_of(model))[0].find("\"a \\\"name\\\"\\u000a\""), std::string::npos);
}

#ifdef HLSCM_WITH_TINYGLTF

bool take_any_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                    const unsigned char*, int, void*)
{
  return true;
}

tinygltf::Model read_glb(const std::string& glb)
{
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(take_any_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(
    &model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()),
    static_cast<unsigned int>(glb.size())));
  EXPECT_EQ(error, "");
  EXPECT_EQ(warning, "");
  return model;
}

// The numbers of an accessor.
template <class Number>
std::vector<Number> numbers(const tinygltf::Model& model, int accessor)
{
  const tinygltf::Accessor& a = model.accessors.at(std::size_t(accessor));
  const tinygltf::BufferView& view = model.bufferViews.at(std::size_t(a.bufferView));
  EXPECT_EQ(tinygltf::GetComponentSizeInBytes(std::uint32_t(a.componentType)),
            int(sizeof(Number)));
  std::vector<Number> result(a.count
                             * std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(a.type))));
  EXPECT_LE(result.size() * sizeof(Number), view.byteLength);
  std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset,
              result.size() * sizeof(Number));
  return result;
}

TEST(Writers, glb_is_read_by_tinygltf)
{
  const SMT::Textured_model model = two_pages();
  const tinygltf::Model read = read_glb(glb_of(model));
  ASSERT_EQ(read.meshes.size(), 1u);
  EXPECT_EQ(read.meshes[0].name, "two");
  ASSERT_EQ(read.meshes[0].primitives.size(), 2u);
  ASSERT_EQ(read.images.size(), 2u);
  for(std::size_t page = 0; page < 2; ++page) {
    const tinygltf::Primitive& primitive = read.meshes[0].primitives[page];
    const auto indices = numbers<std::uint32_t>(read, primitive.indices);
    const auto points = numbers<float>(read, primitive.attributes.at("POSITION"));
    const auto normals = numbers<float>(read, primitive.attributes.at("NORMAL"));
    const auto uv = numbers<float>(read, primitive.attributes.at("TEXCOORD_0"));
    ASSERT_EQ(indices.size(), 3u);
    for(std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = indices[c];
      const Point_3& p = model.mesh.points[model.mesh.triangles[page][c]];
      const Point_2& q = model.mesh.uv[model.mesh.wedges[page][c]];
      EXPECT_EQ(Point_3(points[3 * i], points[3 * i + 1], points[3 * i + 2]), p);
      EXPECT_EQ(Point_2(uv[2 * i], 1 - uv[2 * i + 1]), q);
      EXPECT_EQ(normals[3 * i + 2], 1.f);
    }
    const auto& accessor = read.accessors[std::size_t(primitive.attributes.at("POSITION"))];
    EXPECT_EQ(accessor.minValues, (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(accessor.maxValues, (std::vector<double>{1, 1, 0}));
    const tinygltf::Material& material = read.materials[std::size_t(primitive.material)];
    EXPECT_EQ(material.name, "page_" + std::to_string(page + 1));
    EXPECT_EQ(material.normalTexture.index, page == 0 ? 1 : -1);
    EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, 0);
  }
}

// Each corner of each triangle finds its point and both its coordinates, whatever the seams of both.
TEST(Writers, glb_has_two_sets_of_texture_coordinates)
{
  Mesh mesh = sheet(9);
  const auto cut = add_cut_uv(mesh);
  SMT::Textured_model model;
  model.mesh = SMM::with_wedges(SMM::textured_triangle_mesh(mesh, [&](auto h) { return cut[h]; }));
  const std::size_t n = model.mesh.triangles.size();
  for(std::size_t t = 0; t < n; ++t) { // the other one is cut elsewhere, into single triangles there
    for(int c = 0; c < 3; ++c) {
      const SMT::Vertex_index v = model.mesh.triangles[t][c];
      model.base_uv.emplace_back(double(v) / 128. + (t < n / 4 ? double(t) : 0.), double(c) / 2.);
    }
    model.base_wedges.push_back({SMT::Vertex_index(3 * t), SMT::Vertex_index(3 * t + 1),
                                 SMT::Vertex_index(3 * t + 2)});
  }
  model.textures = {{"color.png", "the colors"}};
  model.materials.resize(1);
  model.materials[0].color = 0;
  const tinygltf::Model read = read_glb(glb_of(model));
  const tinygltf::Primitive& primitive = read.meshes.at(0).primitives.at(0);
  const auto indices = numbers<std::uint32_t>(read, primitive.indices);
  const auto points = numbers<float>(read, primitive.attributes.at("POSITION"));
  const auto first = numbers<float>(read, primitive.attributes.at("TEXCOORD_0"));
  const auto second = numbers<float>(read, primitive.attributes.at("TEXCOORD_1"));
  ASSERT_EQ(indices.size(), 3 * n);
  for(std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t t = i / 3, k = indices[i];
    const Point_2& p = model.base_uv[model.base_wedges[t][i % 3]];
    const Point_2& q = model.mesh.uv[model.mesh.wedges[t][i % 3]];
    EXPECT_EQ(points[3 * k], float(model.mesh.points[model.mesh.triangles[t][i % 3]].x()));
    EXPECT_EQ(first[2 * k], float(p.x()));
    EXPECT_EQ(first[2 * k + 1], float(1 - p.y()));
    EXPECT_EQ(second[2 * k], float(q.x()));
    EXPECT_EQ(second[2 * k + 1], float(1 - q.y()));
  }
  const auto& texture = read.materials.at(0).pbrMetallicRoughness.baseColorTexture;
  EXPECT_EQ(texture.texCoord, 1);
  EXPECT_EQ(primitive.attributes.count("TANGENT"), 0u);
  std::ostringstream os; // what does not fit is not written
  model.base_wedges.back()[0] = SMT::Vertex_index(model.base_uv.size());
  EXPECT_FALSE(SMT::IO::write_GLB(os, model));
  model.base_wedges.pop_back();
  EXPECT_FALSE(SMT::IO::write_GLB(os, model));
  EXPECT_EQ(os.str(), "");
}

TEST(Writers, glb_of_a_mesh_has_its_normals)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point_3(0, 0, 0), 2.);
  const auto uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv", {0., 0.}).first;
  const tinygltf::Model read = read_glb(glb_of(mesh, uv));
  const auto& attributes = read.meshes.at(0).primitives.at(0).attributes;
  const auto points = numbers<float>(read, attributes.at("POSITION"));
  const auto normals = numbers<float>(read, attributes.at("NORMAL"));
  ASSERT_EQ(normals.size(), 36u);
  for(std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_NEAR(normals[i], points[i] / 2., 1e-6); // of a sphere
}

TEST(Writers, glb_of_levels_shares_its_vertices)
{
  Mesh mesh = sheet(20);
  const auto uv = add_cut_uv(mesh);
  const auto built = SMM::build_textured_progressive_mesh(
    SMM::textured_triangle_mesh(mesh, [&](auto h) { return uv[h]; }));
  ASSERT_EQ(built.error, "");
  const SMM::Level_extractor extractor(built.mesh);
  std::vector<std::vector<SMT::Triangle_indices>> levels;
  for(const std::size_t faces : {800u, 400u, 100u})
    levels.push_back(extractor.triangles(extractor.position_of_triangles(faces)));
  const tinygltf::Model read = read_glb(glb_of(built.mesh, levels, SMT::Texture_file{"plain", ""}));
  ASSERT_EQ(read.nodes.size(), 3u);
  ASSERT_EQ(read.scenes.at(0).nodes, std::vector<int>{0});
  EXPECT_EQ(read.nodes[0].extensions.at("MSFT_lod").Get("ids").ArrayLen(), 2u);
  const auto& coverages = read.nodes[0].extras.Get("MSFT_screencoverage");
  ASSERT_EQ(coverages.ArrayLen(), 3u);
  EXPECT_GT(coverages.Get(0).GetNumberAsDouble(), coverages.Get(1).GetNumberAsDouble());
  for(std::size_t i = 0; i < 3; ++i) {
    const tinygltf::Primitive& primitive = read.meshes[i].primitives.at(0);
    const auto indices = numbers<std::uint32_t>(read, primitive.indices);
    const auto points = numbers<float>(read, primitive.attributes.at("POSITION"));
    ASSERT_EQ(indices.size(), 3 * levels[i].size());
    for(std::size_t k = 0; k < indices.size(); ++k) {
      ASSERT_LT(3 * indices[k] + 2, points.size());
      EXPECT_EQ(indices[k], levels[i][k / 3][k % 3]);
      EXPECT_EQ(points[3 * indices[k]],
                float(built.mesh.points[built.mesh.vertex[indices[k]]].x()));
    }
  }
  std::swap(levels[0], levels[2]); // the coarsest first: there are not enough vertices
  std::ostringstream os;
  EXPECT_FALSE(SMT::IO::write_GLB(os, built.mesh, levels, SMT::Texture_file()));
  EXPECT_EQ(os.str(), "");
}

// A grid with steps of 1/30 of `unit`, its corner at `corner`, as a mesh with levels.
SMM::Textured_triangle_mesh grid_at(const Point_3& corner, double unit)
{
  constexpr SMT::Vertex_index n = 12;
  SMM::Textured_triangle_mesh mesh;
  for(SMT::Vertex_index j = 0; j <= n; ++j)
    for(SMT::Vertex_index i = 0; i <= n; ++i) {
      mesh.points.emplace_back(corner.x() + unit * i / 30., corner.y() + unit * j / 30.,
                               corner.z() + unit * (i % 3) / 90.);
      mesh.uv.emplace_back(double(i) / n, double(j) / n);
      const SMT::Vertex_index v = (n + 1) * j + i;
      if(i == n || j == n)
        continue;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  mesh.wedges = mesh.triangles;
  return mesh;
}

// How far positions are from where they should be, to the unit: node by node, `point_of(v)` is the
// place of vertex v.
template <class Point_of>
double distance_of_positions(const tinygltf::Model& model, const Point_of& point_of, double unit)
{
  double result = 0.;
  for(const tinygltf::Node& node : model.nodes) {
    const auto& primitive = model.meshes.at(std::size_t(node.mesh)).primitives.at(0);
    const auto positions = numbers<float>(model, primitive.attributes.at("POSITION"));
    for(std::size_t i = 0; i < positions.size(); ++i) {
      const double scale = node.scale.empty() ? 1. : node.scale[i % 3];
      const double shift = node.translation.empty() ? 0. : node.translation[i % 3];
      const double place = shift + scale * double(positions[i]);
      result = (std::max)(result, std::abs(place - point_of(i / 3)[int(i % 3)]) / unit);
    }
  }
  return result;
}

TEST(Writers, glb_has_its_place_in_the_node_where_floats_are_too_coarse)
{
  struct Place
  {
    Point_3 corner;
    double unit;
    bool is_placed, is_scaled;
  };
  const Place places[] = {{Point_3(0., 0., 0.), 1., false, false},
                          {Point_3(100., -50., 3.), 1., false, false},
                          {Point_3(0., 0., 0.), 1e-30, false, false},
                          {Point_3(1e6, -1e6, 0.), 1., true, false},
                          {Point_3(448262., 5411932., 100.), 6., true, false},
                          {Point_3(1e7, 1e7, 1e7), 1., true, false},
                          {Point_3(0., 0., 0.), 1e-45, true, true},
                          {Point_3(-3e-200, 0., 1e-200), 1e-200, true, true},
                          {Point_3(1e35, 0., 0.), 1e28, true, true}};
  for(const auto& [corner, unit, is_placed, is_scaled] : places) {
    const SMM::Textured_triangle_mesh mesh = grid_at(corner, unit);
    const auto built = SMM::build_textured_progressive_mesh(mesh);
    ASSERT_EQ(built.error, "") << corner;
    const SMM::Level_extractor extractor(built.mesh);
    std::vector<std::vector<SMT::Triangle_indices>> levels;
    for(const std::size_t faces : {288u, 100u})
      levels.push_back(extractor.triangles(extractor.position_of_triangles(faces)));
    const tinygltf::Model model = read_glb(glb_of(mesh));
    const tinygltf::Model of_levels
      = read_glb(glb_of(built.mesh, levels, SMT::Texture_file{"plain", ""}));
    for(const tinygltf::Model& read : {model, of_levels})
      for(const tinygltf::Node& node : read.nodes) {
        EXPECT_EQ(!node.translation.empty(), is_placed) << corner;
        EXPECT_EQ(!node.scale.empty(), is_scaled) << corner;
      }
    const double edge = unit / 30.;
    const double allowed = is_placed ? 1e-6 : 1e-3; // of an edge
    EXPECT_LE(distance_of_positions(model, [&](std::size_t v) { return mesh.points[v]; }, edge),
              allowed) << corner;
    EXPECT_LE(distance_of_positions(of_levels, [&](std::size_t w) {
                return built.mesh.points[built.mesh.vertex[w]];
              }, edge), allowed) << corner;
  }
}

#endif // HLSCM_WITH_TINYGLTF

} // namespace glb_writer_test
