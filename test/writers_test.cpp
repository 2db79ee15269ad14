// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the writers write is what CGAL reads; errors.

#include <support/written_meshes.h>

#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/boost/graph/IO/OBJ.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/property_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

namespace writers_test {

using namespace written_meshes;

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

// The lists are so long that each is cut into blocks; a page and lines of a file begin in the midst of these.
TEST(Writers, obj_is_the_same_for_any_number_of_threads)
{
  Mesh mesh = sheet(120);
  SMT::Textured_model model;
  model.name = "sheet";
  model.mesh = read_obj(obj_of(mesh, add_cut_uv(mesh)));
  const std::size_t faces = model.mesh.triangles.size();
  ASSERT_GT(faces, 25000u);
  for(std::size_t t = 0; t < faces; ++t)
    model.page.push_back(t < 4999 || t > 20001 ? 0 : 1);
  model.materials.resize(2);
  for(const Point_3& p : model.mesh.points)
    model.frames.normals.emplace_back(std::sin(p.z()), 0., std::cos(p.z()));
  CGAL::Indexed_mesh::Polygon_soup soup;
  soup.points = model.mesh.points;
  for(const SMT::Triangle_indices& t : model.mesh.triangles) {
    soup.corners.insert(soup.corners.end(), t.begin(), t.end());
    soup.first_corner.push_back(std::uint32_t(soup.corners.size()));
  }
  SMT::IO::OBJ_details details;
  details.normals = model.frames.normals;
  details.normal_corners = soup.corners;
  details.lines = {{0, "mtllib a.mtl"}, {0, "g one"}, {9000, "g two"}, {9000, "# three"}, {faces, "# end"}};
  const auto texts = [&](unsigned int threads) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    return std::vector<std::string>{obj_of(model.mesh), obj_of(model), obj_of(soup, details)};
  };
  const std::vector<std::string> expected = texts(1);
  EXPECT_EQ(std::count(expected[1].begin(), expected[1].end(), '\n'),
            std::ptrdiff_t(1 + 2 * soup.points.size() + model.mesh.uv.size() + 3 + faces));
  EXPECT_LT(expected[2].find("\ng two\n# three\nf "), expected[2].find("\n# end\n"));
  for(const unsigned int threads : {2u, 3u, 8u})
    EXPECT_EQ(texts(threads), expected) << threads << " threads";
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

} // namespace writers_test
