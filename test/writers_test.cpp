// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the writers write is what CGAL, stb_image and tinygltf read.

#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>
#ifndef HLSCM_WITHOUT_PNG
#include <CGAL/Surface_mesh_texturing/IO/PNG.h>
#endif

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/boost/graph/IO/OBJ.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/property_map.h>

#include <gtest/gtest.h>

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

#ifdef HLSCM_WITH_STB
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop
#endif

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace writers_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_2 Point_2;
typedef Kernel::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;

// A curved sheet whose numbers have all their digits.
Mesh sheet(std::size_t n)
{
  Mesh mesh;
  const auto wave = [](std::size_t i, std::size_t j) {
    return Point_3(double(i) / 7., double(j) / 9. - 1e-17, std::sin(double(i + 2 * j)) * 1e5);
  };
  CGAL::make_grid(n, n, mesh, wave, true);
  return mesh;
}

Mesh::Property_map<Mesh::Vertex_index, Point_2> add_uv(Mesh& mesh)
{
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv").first;
  for(const auto v : vertices(mesh))
    uv[v] = Point_2(mesh.point(v).x() / 3., 1. - mesh.point(v).y() / 11.);
  return uv;
}

// A sheet cut in two by the texture: the faces of its second half have coordinates of their own.
Mesh::Property_map<Mesh::Halfedge_index, Point_2> add_cut_uv(Mesh& mesh)
{
  const auto vertex_uv = add_uv(mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv").first;
  for(const auto f : faces(mesh))
    for(const auto h : halfedges_around_face(halfedge(f, mesh), mesh)) {
      const Point_2 p = vertex_uv[target(h, mesh)];
      const double shift = 2 * f.idx() < num_faces(mesh) ? 0. : 0.5;
      uv[h] = Point_2(p.x() + shift, p.y());
    }
  return uv;
}

template <class... Input>
std::string obj_of(const Input&... input)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_OBJ(os, input...));
  return os.str();
}

template <class... Input>
std::string ply_of(const Input&... input)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_PLY(os, input...));
  return os.str();
}

template <class... Input>
std::string glb_of(const Input&... input)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_GLB(os, input...));
  return os.str();
}

// An OBJ file, read without the library.
SMT::Textured_triangle_mesh read_obj(const std::string& text)
{
  SMT::Textured_triangle_mesh mesh;
  std::istringstream lines(text);
  for(std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    double x = 0., y = 0., z = 0.;
    if(keyword == "v" && words >> x >> y >> z)
      mesh.points.emplace_back(x, y, z);
    if(keyword == "vt" && words >> x >> y)
      mesh.uv.emplace_back(x, y);
    if(keyword != "f")
      continue;
    SMT::Triangle_indices vertices, wedges;
    for(int c = 0; c < 3; ++c) {
      std::string corner;
      words >> corner;
      unsigned int v = 0, w = 0;
      EXPECT_GE(std::sscanf(corner.c_str(), "%u/%u", &v, &w), 2) << line;
      vertices[c] = v - 1;
      wedges[c] = w - 1;
    }
    mesh.triangles.push_back(vertices);
    mesh.wedges.push_back(wedges);
  }
  return mesh;
}

// Empty if a mesh has the points, faces and texture coordinates of another.
template <class CornerUv>
std::string difference(const SMT::Textured_triangle_mesh& read, const Mesh& mesh, CornerUv corner_uv)
{
  if(read.points.size() != num_vertices(mesh) || read.triangles.size() != num_faces(mesh))
    return "other numbers of vertices or faces";
  for(const auto v : vertices(mesh))
    if(read.points[v] != mesh.point(v))
      return "another point";
  std::size_t t = 0;
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    for(int c = 0; c < 3; ++c, h = next(h, mesh))
      if(read.triangles[t][c] != target(h, mesh) || read.uv[read.wedges[t][c]] != corner_uv(h))
        return "another corner";
    ++t;
  }
  return "";
}

TEST(Writers, obj_holds_texture_coordinates_of_vertices_exactly)
{
  Mesh mesh = sheet(6);
  const auto uv = add_uv(mesh);
  const std::string text = obj_of(mesh, uv);
  const SMT::Textured_triangle_mesh read = read_obj(text);
  EXPECT_EQ(difference(read, mesh, [&](auto h) { return uv[target(h, mesh)]; }), "");
  EXPECT_EQ(read.uv.size(), num_vertices(mesh));

  // The arrays, and all other kinds of meshes, give the same text.
  SMT::Indexed_triangle_mesh arrays;
  arrays.points = read.points;
  arrays.triangles = read.triangles;
  EXPECT_EQ(obj_of(arrays, read.uv), text);
  EXPECT_EQ(obj_of(read), text);
}

TEST(Writers, obj_holds_texture_coordinates_of_corners_exactly)
{
  Mesh mesh = sheet(6);
  const auto uv = add_cut_uv(mesh);
  const SMT::Textured_triangle_mesh read = read_obj(obj_of(mesh, uv));
  EXPECT_EQ(difference(read, mesh, [&](auto h) { return uv[h]; }), "");
  EXPECT_GT(read.uv.size(), num_vertices(mesh)); // the seam has two a vertex
  EXPECT_LT(read.uv.size(), num_vertices(mesh) + 10);
}

// CGAL reads the same surface that its own writer writes.
TEST(Writers, obj_is_read_by_cgal)
{
  Mesh mesh = sheet(6), read;
  std::istringstream is(obj_of(mesh, add_cut_uv(mesh)));
  ASSERT_TRUE(CGAL::IO::read_OBJ(is, read));
  ASSERT_EQ(num_vertices(read), num_vertices(mesh));
  ASSERT_EQ(num_faces(read), num_faces(mesh));
  for(const auto v : vertices(mesh))
    EXPECT_EQ(read.point(v), mesh.point(v));
}

TEST(Writers, take_other_meshes_and_points)
{
  Mesh mesh = sheet(4);
  const auto uv = add_uv(mesh);
  const std::string text = obj_of(mesh, uv);

  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  typedef boost::graph_traits<CGAL::Polyhedron_3<Kernel>>::vertex_descriptor Vertex;
  std::map<Vertex, Point_2> map;
  for(const Vertex v : vertices(polyhedron))
    map[v] = Point_2(v->point().x() / 3., 1. - v->point().y() / 11.);
  EXPECT_EQ(read_obj(obj_of(polyhedron, boost::make_assoc_property_map(map))).uv.size(),
            num_vertices(mesh));

  const auto flat = mesh.add_property_map<Mesh::Vertex_index, Point_3>("v:flat").first;
  for(const auto v : vertices(mesh))
    flat[v] = Point_3(mesh.point(v).x(), mesh.point(v).y(), 0.);
  const std::string other = obj_of(mesh, uv, CGAL::parameters::vertex_point_map(flat));
  EXPECT_NE(other, text);
  for(const Point_3& p : read_obj(other).points)
    EXPECT_EQ(p.z(), 0.);
}

TEST(Writers, take_seam_meshes_with_the_map_of_their_vertices)
{
  typedef CGAL::Seam_mesh<Mesh, Mesh::Property_map<Mesh::Edge_index, bool>,
                          Mesh::Property_map<Mesh::Vertex_index, bool>> Seam_mesh;
  Mesh mesh = sheet(4);
  const auto on_seam = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
  const auto v_on_seam = mesh.add_property_map<Mesh::Vertex_index, bool>("v:seam", false).first;
  Seam_mesh seams(mesh, on_seam, v_on_seam);
  // Along the inner vertices of a row of the grid, from border to border
  for(Mesh::size_type v = 10; v < 14; ++v)
    ASSERT_TRUE(seams.add_seam(Mesh::Vertex_index(v), Mesh::Vertex_index(v + 1)));
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv").first;
  double u = 0.;
  for(const auto v : vertices(seams))
    put(uv, v, Point_2(u += 1. / 64., 0.5));
  const SMT::Textured_triangle_mesh read = read_obj(obj_of(seams, uv));
  EXPECT_EQ(read.points.size(), num_vertices(mesh) + 5); // those of the seam twice
  EXPECT_EQ(read.triangles.size(), num_faces(mesh));
  for(std::size_t v = 0; v < read.uv.size(); ++v)
    EXPECT_EQ(read.uv[v], Point_2(double(v + 1) / 64., 0.5));
}

// Neither the stream's locale nor its precision decides what is written.
TEST(Writers, obj_does_not_depend_on_the_stream)
{
  struct Comma : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\1"; }
  };
  Mesh mesh = sheet(5);
  const auto uv = add_uv(mesh);
  std::ostringstream os;
  os.imbue(std::locale(std::locale::classic(), new Comma));
  os.precision(2);
  EXPECT_TRUE(SMT::IO::write_OBJ(os, mesh, uv));
  EXPECT_EQ(os.str(), obj_of(mesh, uv));
}

TEST(Writers, ply_is_read_by_cgal_with_both_pairs_of_coordinates)
{
  Mesh mesh = sheet(6), read;
  const auto uv = add_uv(mesh);
  std::istringstream is(ply_of(mesh, uv), std::ios::binary);
  std::string comments;
  ASSERT_TRUE(CGAL::IO::read_PLY(is, read, comments));
  // Returns what is there already, with CGAL 5 and 6
  const auto [u, no_u] = read.add_property_map<Mesh::Vertex_index, double>("v:texture_u");
  const auto [v_map, no_v] = read.add_property_map<Mesh::Vertex_index, double>("v:texture_v");
  const auto [s, no_s] = read.add_property_map<Mesh::Vertex_index, float>("v:s");
  const auto [t, no_t] = read.add_property_map<Mesh::Vertex_index, float>("v:t");
  ASSERT_FALSE(no_u || no_v || no_s || no_t);
  ASSERT_EQ(num_vertices(read), num_vertices(mesh));
  ASSERT_EQ(num_faces(read), num_faces(mesh));
  for(const auto v : vertices(mesh)) {
    EXPECT_EQ(read.point(v), mesh.point(v));
    EXPECT_EQ(u[v], uv[v].x());
    EXPECT_EQ(v_map[v], uv[v].y());
    EXPECT_EQ(s[v], float(uv[v].x()));
    EXPECT_EQ(t[v], float(uv[v].y()));
  }
  for(const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    EXPECT_TRUE(read.halfedge(target(h, mesh), target(next(h, mesh), mesh)).is_valid());
  }
}

TEST(Writers, ply_has_a_vertex_for_each_side_of_a_seam)
{
  Mesh mesh = sheet(6), read;
  const auto uv = add_cut_uv(mesh);
  const SMT::Textured_triangle_mesh obj = read_obj(obj_of(mesh, uv));
  std::istringstream is(ply_of(mesh, uv), std::ios::binary);
  std::string comments;
  ASSERT_TRUE(CGAL::IO::read_PLY(is, read, comments));
  ASSERT_EQ(num_vertices(read), obj.uv.size());
  const std::vector<SMT::Vertex_index> vertex = SMT::vertices_of_wedges(obj);
  for(const auto v : vertices(read))
    EXPECT_EQ(read.point(v), obj.points[vertex[v]]);
  EXPECT_EQ(num_faces(read), num_faces(mesh));
}

TEST(Writers, keep_isolated_vertices_in_their_places)
{
  SMT::Indexed_triangle_mesh mesh;
  mesh.points = {{0, 0, 0}, {7, 7, 7}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 2, 3}};
  const std::vector<Point_2> uv = {{0, 0}, {0, 0}, {1, 0}, {0, 1}};
  std::istringstream is(ply_of(mesh, uv), std::ios::binary);
  Mesh read;
  std::string comments;
  ASSERT_TRUE(CGAL::IO::read_PLY(is, read, comments));
  ASSERT_EQ(num_vertices(read), 4u);
  EXPECT_EQ(read.point(Mesh::Vertex_index(1)), Point_3(7, 7, 7));
}

// ---------------------------------------------------------------------------------------------
// Models with materials

// Two triangles on two pages, the first with a normal map.
SMT::Textured_model two_pages()
{
  SMT::Textured_model model;
  model.name = "two";
  model.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  model.mesh.wedges = {{0, 1, 2}, {3, 4, 5}};
  model.page = {0, 1};
  model.textures = {{"color.png", "the colors"}, {"normal.png", "the normals"}};
  model.materials.resize(2);
  model.materials[0] = {0, 1};
  model.materials[1].color = 0;
  model.frames.normals.assign(4, SMT::Vector_3(0, 0, 1));
  return model;
}

TEST(Writers, make_a_model_of_an_atlas)
{
  const SMT::Textured_model two = two_pages();
  SMT::Texture_atlas atlas;
  atlas.mesh = two.mesh;
  atlas.charts.chart = {1, 0};
  atlas.page = {1, 0};
  atlas.number_of_pages = 2;
  const SMT::Textured_model model = SMT::textured_model(atlas, "name");
  EXPECT_EQ(model.name, "name");
  EXPECT_EQ(model.page, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.frames.normals.size(), 4u);
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_MTL(os, model));
  EXPECT_EQ(os.str().find("map_"), std::string::npos);
  EXPECT_NE(glb_of(model), "");
}

TEST(Writers, obj_names_the_material_of_each_page)
{
  const SMT::Textured_model model = two_pages();
  const std::string text = obj_of(model);
  EXPECT_EQ(text.rfind("mtllib two.mtl\n", 0), 0u);
  EXPECT_NE(text.find("usemtl page_1\nf 1/1/1 2/2/2 3/3/3\nusemtl page_2\nf 1/4/1 3/5/3 4/6/4\n"),
            std::string::npos)
    << text;
  EXPECT_NE(text.find("vn 0.000000 0.000000 1.000000\n"), std::string::npos);
  std::ostringstream os;
  ASSERT_TRUE(SMT::IO::write_MTL(os, model));
  const std::string materials = os.str();
  const std::size_t second = materials.find("newmtl page_2\n");
  ASSERT_NE(second, std::string::npos);
  EXPECT_EQ(materials.rfind("newmtl page_1\n", 0), 0u);
  EXPECT_LT(materials.find("map_Kd color.png\n"), second);
  EXPECT_LT(materials.find("norm normal.png\n"), second);
  EXPECT_LT(materials.find("map_Bump normal.png\n"), second);
  EXPECT_EQ(materials.find("normal.png", second), std::string::npos);
  EXPECT_NE(materials.find("map_Kd color.png\n", second), std::string::npos);
}

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

#endif // HLSCM_WITH_TINYGLTF

// ---------------------------------------------------------------------------------------------
// Errors

// Takes so many bytes and no more.
class Full_disk : public std::streambuf
{
public:
  explicit Full_disk(std::streamsize room) : m_room(room) {}

private:
  std::streamsize xsputn(const char*, std::streamsize size) override
  {
    const std::streamsize taken = (std::min)(size, m_room);
    m_room -= taken;
    return taken;
  }
  int_type overflow(int_type) override { return traits_type::eof(); }

  std::streamsize m_room;
};

TEST(Writers, say_that_a_stream_did_not_take_all)
{
  Mesh mesh = sheet(6);
  const auto uv = add_uv(mesh);
  typedef std::function<bool(std::ostream&)> Write;
  for(const Write& write : {Write([&](std::ostream& os) { return SMT::IO::write_OBJ(os, mesh, uv); }),
                            Write([&](std::ostream& os) { return SMT::IO::write_PLY(os, mesh, uv); }),
                            Write([&](std::ostream& os) { return SMT::IO::write_GLB(os, mesh, uv); })}) {
    std::ostringstream all;
    ASSERT_TRUE(write(all));
    const std::streamsize size = std::streamsize(all.str().size());
    for(const std::streamsize room : {std::streamsize(0), size / 2, size - 1}) {
      Full_disk buffer(room);
      std::ostream os(&buffer);
      EXPECT_FALSE(write(os)) << room << " of " << size;
    }
    Full_disk buffer(size);
    std::ostream os(&buffer);
    EXPECT_TRUE(write(os));
  }
}

// Nothing is written of a mesh that a format cannot hold.
TEST(Writers, refuse_bad_meshes)
{
  const SMT::Textured_model good = two_pages();
  std::vector<SMT::Textured_triangle_mesh> bad(5, good.mesh);
  bad[0].triangles[1][2] = 4;
  bad[1].wedges[1][2] = 6;
  bad[2].wedges.pop_back();
  bad[3].points[0] = Point_3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  bad[4].uv[3] = Point_2(std::numeric_limits<double>::infinity(), 0);
  for(const SMT::Textured_triangle_mesh& mesh : bad) {
    std::ostringstream os;
    EXPECT_FALSE(SMT::IO::write_OBJ(os, mesh));
    EXPECT_FALSE(SMT::IO::write_PLY(os, mesh));
    EXPECT_FALSE(SMT::IO::write_GLB(os, mesh));
    EXPECT_EQ(os.str(), "");
  }
  std::vector<SMT::Textured_model> models(5, good);
  models[0].page[1] = 2;
  models[1].page.pop_back();
  models[2].materials[0].color = 2;
  models[3].frames.normals.pop_back();
  models[4].frames.corners = {{0, 1, 2}, {0, 2, 3}}; // there are no frames
  for(const SMT::Textured_model& model : models) {
    std::ostringstream os;
    EXPECT_FALSE(SMT::IO::write_OBJ(os, model));
    EXPECT_FALSE(SMT::IO::write_MTL(os, model));
    EXPECT_FALSE(SMT::IO::write_GLB(os, model));
    EXPECT_EQ(os.str(), "");
  }
  SMT::Textured_triangle_mesh huge = good.mesh;
  huge.points[0] = Point_3(1e39, 0, 0); // no float
  std::ostringstream os;
  EXPECT_FALSE(SMT::IO::write_GLB(os, huge));
  EXPECT_TRUE(SMT::IO::write_OBJ(os, huge));
}

TEST(Writers, refuse_polygons_and_empty_meshes)
{
  Mesh quads, none;
  CGAL::make_grid(2, 2, quads);
  for(Mesh* mesh : {&quads, &none}) {
    const auto uv = mesh->add_property_map<Mesh::Vertex_index, Point_2>("v:uv").first;
    std::ostringstream os;
    EXPECT_FALSE(SMT::IO::write_OBJ(os, *mesh, uv));
    EXPECT_FALSE(SMT::IO::write_PLY(os, *mesh, uv));
    EXPECT_FALSE(SMT::IO::write_GLB(os, *mesh, uv));
    EXPECT_EQ(os.str(), "");
  }
}

TEST(Writers, write_files)
{
  Mesh mesh = sheet(5);
  const auto uv = add_uv(mesh);
  const std::string folder = ::testing::TempDir(), name = folder + "hlscm_writers_test";
  const auto bytes_of = [](const std::string& file) {
    std::ifstream is(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(is), {});
  };
  ASSERT_TRUE(SMT::IO::write_OBJ(name + ".obj", mesh, uv));
  EXPECT_EQ(bytes_of(name + ".obj"), obj_of(mesh, uv));
  ASSERT_TRUE(SMT::IO::write_PLY(name + ".ply", mesh, uv));
  EXPECT_EQ(bytes_of(name + ".ply"), ply_of(mesh, uv));
  ASSERT_TRUE(SMT::IO::write_GLB(name + ".glb", mesh, uv));
  EXPECT_EQ(bytes_of(name + ".glb"), glb_of(mesh, uv));
  ASSERT_TRUE(SMT::IO::write_MTL(name + ".mtl", two_pages()));
  EXPECT_NE(bytes_of(name + ".mtl"), "");
  for(const char* extension : {".obj", ".ply", ".glb", ".mtl"})
    std::remove((name + extension).c_str());
  EXPECT_FALSE(SMT::IO::write_OBJ(folder + "no/such/folder.obj", mesh, uv));
  EXPECT_FALSE(SMT::IO::write_GLB(folder, mesh, uv));
}

// ---------------------------------------------------------------------------------------------
// Pictures

#if !defined(HLSCM_WITHOUT_PNG) && defined(HLSCM_WITH_STB)

SMT::Texture_image ramp(std::size_t channels)
{
  SMT::Texture_image image = {7, 5, channels, {}};
  for(std::size_t i = 0; i < 35 * channels; ++i)
    image.texels.push_back(float(i) / float(35 * channels - 1));
  return image;
}

std::string png_of(const SMT::Texture_image& image, const SMT::PNG_options& options)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_PNG(os, image, options));
  return os.str();
}

// Calls `check` with the samples that stb_image reads.
template <class Sample>
void expect_samples(const std::string& png, const SMT::Texture_image& image,
                    const std::vector<Sample>& expected)
{
  const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
  int width = 0, height = 0, channels = 0;
  void* read = nullptr;
  if(sizeof(Sample) == 2)
    read = stbi_load_16_from_memory(bytes, int(png.size()), &width, &height, &channels, 0);
  else
    read = stbi_load_from_memory(bytes, int(png.size()), &width, &height, &channels, 0);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(stbi_is_16_bit_from_memory(bytes, int(png.size())), int(sizeof(Sample) == 2));
  ASSERT_EQ(std::size_t(width), image.width);
  ASSERT_EQ(std::size_t(height), image.height);
  ASSERT_EQ(std::size_t(channels), image.channels);
  std::vector<Sample> samples(expected.size());
  std::memcpy(samples.data(), read, samples.size() * sizeof(Sample));
  stbi_image_free(read);
  EXPECT_EQ(samples, expected);
}

TEST(Writers, png_holds_8_and_16_bits_of_all_channels)
{
  for(std::size_t channels = 1; channels <= 4; ++channels) {
    const SMT::Texture_image image = ramp(channels);
    SMT::PNG_options options;
    expect_samples(png_of(image, options), image, SMT::encode_values<std::uint8_t>(image, 0., 1.));
    options.bits = 16;
    expect_samples(png_of(image, options), image, SMT::encode_values<std::uint16_t>(image, 0., 1.));
    options.lowest = -1.; // as for a normal map
    expect_samples(png_of(image, options), image,
                   SMT::encode_unit_vectors<std::uint16_t>(image));
  }
}

TEST(Writers, png_compresses_as_told_without_loss)
{
  const std::vector<std::uint8_t> samples(3 * 64 * 64, 77);
  const std::string stored = SMT::IO::encode_PNG(samples, 64, 3, 0);
  const std::string packed = SMT::IO::encode_PNG(samples, 64, 3, 9);
  EXPECT_GT(stored.size(), samples.size());
  EXPECT_LT(packed.size(), samples.size() / 20);
  const SMT::Texture_image image = {64, 64, 3, {}};
  expect_samples(stored, image, samples);
  expect_samples(packed, image, samples);
}

TEST(Writers, png_refuses_bad_images)
{
  SMT::PNG_options bits, range, compression;
  bits.bits = 12;
  range.lowest = 2.;
  compression.compression = 10;
  const SMT::Texture_image good = ramp(3);
  SMT::Texture_image cut = good;
  cut.texels.pop_back();
  std::ostringstream os;
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, bits));
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, range));
  EXPECT_FALSE(SMT::IO::write_PNG(os, good, compression));
  EXPECT_FALSE(SMT::IO::write_PNG(os, cut));
  EXPECT_FALSE(SMT::IO::write_PNG(os, SMT::Texture_image()));
  EXPECT_FALSE(SMT::IO::write_PNG(os, ramp(5)));
  EXPECT_EQ(os.str(), "");
  EXPECT_EQ(SMT::IO::encode_PNG(std::vector<std::uint8_t>(10), 3, 3), "");
  EXPECT_EQ(SMT::IO::encode_PNG(std::vector<std::uint8_t>(), 3, 3), "");
}

#endif

} // namespace writers_test
