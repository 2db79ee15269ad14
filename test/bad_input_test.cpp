// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same bad inputs at every door: an error and a sentence, never a signal.
//
// To add a door, write a struct with `what_is_wrong(input)`, which returns the sentence ("" if all
// went well), and add it to `Doors`; if a bad input means nothing to it, it says so by
// `concerns(input)`. To add a bad input, add a row to `bad_inputs()`: every door meets it.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace bad_input_test {

using namespace test_support;

// How the halfedge is chosen that a door of a mesh with halfedges asks for.
enum class Border { ITS_OWN, NONE, INSIDE, FOREIGN };

struct Input
{
  std::string name;
  Indexed_triangle_mesh mesh;
  Border border;
};

Indexed_triangle_mesh hills() { return with_hills(irregular_grid(12, 9, 1), 3., 2); }

Indexed_triangle_mesh with_point(Indexed_triangle_mesh mesh, double x)
{
  mesh.points[5] = Point_3(0., x, 0.);
  return mesh;
}

Indexed_triangle_mesh with_index(Indexed_triangle_mesh mesh, Vertex_index v)
{
  mesh.triangles[7][1] = v;
  return mesh;
}

Indexed_triangle_mesh in_one_point(Indexed_triangle_mesh mesh)
{
  for(Point_3& p : mesh.points)
    p = Point_3(1., 2., 3.);
  return mesh;
}

std::vector<Input> bad_inputs()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  return {
    {"no vertices", Indexed_triangle_mesh(), Border::NONE},
    {"no faces", {hills().points, {}}, Border::NONE},
    {"closed, null halfedge", sphere(2), Border::NONE},
    {"closed, some halfedge", sphere(2), Border::INSIDE},
    {"null halfedge", hills(), Border::NONE},
    {"halfedge inside", hills(), Border::INSIDE},
    {"halfedge of a larger mesh", hills(), Border::FOREIGN},
    {"index out of range", with_index(hills(), 10000), Border::ITS_OWN},
    {"greatest index", with_index(hills(), Vertex_index(-1)), Border::ITS_OWN},
    {"NaN", with_point(hills(), nan), Border::ITS_OWN},
    {"infinite", with_point(hills(), infinity), Border::ITS_OWN},
    {"genus 1", with_holes(torus(20, 10), 2, 1), Border::ITS_OWN},
    {"all in one point", in_one_point(hills()), Border::ITS_OWN},
  };
}

bool has_valid_indices(const Indexed_triangle_mesh& mesh)
{
  for(const auto& t : mesh.triangles)
    for(const Vertex_index v : t)
      if(v >= mesh.points.size())
        return false;
  return true;
}

Surface_mesh::Halfedge_index chosen_halfedge(const Surface_mesh& mesh, Border border)
{
  if(border == Border::FOREIGN)
    return Surface_mesh::Halfedge_index(100000);
  for(const auto h : mesh.halfedges())
    if(border != Border::NONE && mesh.is_border(h) == (border == Border::ITS_OWN))
      return h;
  return Surface_mesh::null_halfedge();
}

// Doors of meshes with halfedges, which cannot have wrong indices.
struct Mesh_door
{
  static bool concerns(const Input& input) { return has_valid_indices(input.mesh); }

  // The sentence of a parameterizer; its error must go with it.
  template <class Parameterizer_3>
  static std::string message_of(Parameterizer_3 parameterizer, const Input& input)
  {
    Surface_mesh mesh = to_surface_mesh(input.mesh);
    const Uv_map uvmap = new_uv_map(mesh);
    const SMP::Error_code error
      = parameterizer.parameterize(mesh, chosen_halfedge(mesh, input.border), uvmap);
    EXPECT_EQ(error == SMP::OK, parameterizer.report().message.empty());
    if(error != SMP::OK) {
      for(const std::complex<double>& z : parameters(mesh, uvmap))
        EXPECT_EQ(z, std::complex<double>(untouched, untouched)) << "written in spite of an error";
    }
    return parameterizer.report().message;
  }
};

template <SMP::Conformal_method Method>
struct Parameterizer_door
  : public Mesh_door
{
  static std::string what_is_wrong(const Input& input)
  {
    return message_of(Parameterizer(with_method(Method, 1e-2)), input);
  }
};

struct Spectral_door
  : public Mesh_door
{
  static std::string what_is_wrong(const Input& input)
  {
    return message_of(SMP::Spectral_conformal_parameterizer_3<Surface_mesh>(), input);
  }
};

// Everything that can be asked of a live map is asked, too.
struct Live_door
  : public Mesh_door
{
  static std::string what_is_wrong(const Input& input)
  {
    Surface_mesh mesh = to_surface_mesh(input.mesh);
    SMP::Hierarchical_conformal_map<Surface_mesh> map(mesh, chosen_halfedge(mesh, input.border));
    const std::string message = map.report().message;
    EXPECT_EQ(map.error() == SMP::OK, message.empty());
    const auto weights
      = mesh.add_property_map<Surface_mesh::Face_index, double>("f:weight", 1.).first;
    map.update_positions();
    map.set_face_weights(weights);
    EXPECT_EQ(map.preview().uv == nullptr, !message.empty());
    EXPECT_EQ(map.solve() == SMP::OK, message.empty()) << map.report().message;
    EXPECT_EQ(map.has_map(), message.empty());
    map.get_uv(new_uv_map(mesh));
    EXPECT_NE(map.set_pin(Surface_mesh::null_vertex(), Point_2(0., 0.)), SMP::OK);
    EXPECT_NE(map.set_pin(Surface_mesh::Vertex_index(100000), Point_2(0., 0.)), SMP::OK);
    EXPECT_NE(map.release_pin(Surface_mesh::Vertex_index(100000)), SMP::OK);
    return message;
  }
};

// Doors of arrays, which have no halfedge to choose.
struct Array_door
{
  static bool concerns(const Input& input)
  {
    return input.border == Border::ITS_OWN || input.mesh.triangles.empty()
        || input.name == "closed, null halfedge";
  }
};

struct Conformal_map_door
  : public Array_door
{
  static std::string what_is_wrong(const Input& input)
  {
    const SMP::Conformal_map map = SMP::conformal_map(input.mesh);
    EXPECT_EQ(map.error == SMP::OK, map.report.message.empty());
    EXPECT_EQ(map.error == SMP::OK, !map.uv.empty());
    return map.report.message;
  }
};

struct Pinned_map_door
  : public Array_door
{
  static std::string what_is_wrong(const Input& input)
  {
    const SMP::Conformal_map map = SMP::conformal_map(input.mesh, {{0, 0., 0.}, {3, 1., 0.}});
    EXPECT_EQ(map.error == SMP::OK, map.report.message.empty());
    return map.report.message;
  }
};

struct Border_first_door
  : public Array_door
{
  static std::string what_is_wrong(const Input& input)
  {
    const SMP::Border_first_map map = SMP::border_first_map(input.mesh);
    EXPECT_EQ(map.is_ok(), !map.uv.empty());
    EXPECT_EQ(map.status, map.is_ok() ? CGAL::Indexed_mesh::Mesh_status::OK
                                      : CGAL::Indexed_mesh::Mesh_status::BAD_MESH);
    return map.error;
  }
};

template <class Door>
class Bad_input
  : public testing::Test
{};

typedef testing::Types<Parameterizer_door<SMP::Conformal_method::HLSCM>,
                       Parameterizer_door<SMP::Conformal_method::CASCADIC>,
                       Parameterizer_door<SMP::Conformal_method::LSCM>,
                       Parameterizer_door<SMP::Conformal_method::DIRECT>, Spectral_door, Live_door,
                       Conformal_map_door, Pinned_map_door, Border_first_door>
  Doors;
TYPED_TEST_SUITE(Bad_input, Doors);

TYPED_TEST(Bad_input, gives_an_error_and_a_sentence)
{
  for(const Input& input : bad_inputs()) {
    if(!TypeParam::concerns(input))
      continue;
    SCOPED_TRACE(input.name);
    const std::string sentence = TypeParam::what_is_wrong(input);
    EXPECT_GT(sentence.size(), 10u);
    EXPECT_NE(sentence.find(' '), std::string::npos);
  }
}

// So that the doors are not simply shut.
TYPED_TEST(Bad_input, is_not_seen_in_a_good_one)
{
  EXPECT_EQ(TypeParam::what_is_wrong({"good", hills(), Border::ITS_OWN}), "");
}

TEST(Bad_pins, of_arrays)
{
  const auto message = [](const std::vector<SMP::HLSCM_pin>& pins) {
    const SMP::Conformal_map map = SMP::conformal_map(hills(), pins);
    EXPECT_EQ(map.error, SMP::ERROR_WRONG_PARAMETER);
    EXPECT_TRUE(map.uv.empty());
    return map.report.message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message({}).find("fewer than two"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}}).find("fewer than two"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {std::size_t(-1), 1., 0.}}).find("does not belong"),
            std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {0, 1., 0.}}).find("twice"), std::string::npos);
  EXPECT_NE(message({{0, 0., 0.}, {3, nan, 0.}}).find("not a finite number"), std::string::npos);
}

// The pins of arrays do what those of a mesh do.
TEST(Pins_of_arrays, are_met_and_give_the_map_of_the_parameterizer)
{
  const std::vector<SMP::HLSCM_pin> pins = {{3, 0., 0.}, {40, 2., 1.}, {77, -1., 3.}};
  const SMP::Conformal_map map = SMP::conformal_map(hills(), pins);
  ASSERT_EQ(map.error, SMP::OK) << map.report.message;
  Surface_mesh mesh = to_surface_mesh(hills());
  Pins same;
  for(const SMP::HLSCM_pin& pin : pins) {
    same.push_back({pin.vertex, {pin.u, pin.v}});
    EXPECT_EQ(map.uv[pin.vertex], Point_2(pin.u, pin.v));
  }
  const Outcome run = parameterize(mesh, SMP::HLSCM_options(), same);
  ASSERT_EQ(run.uv.size(), map.uv.size());
  for(std::size_t v = 0; v < map.uv.size(); ++v)
    EXPECT_EQ(run.uv[v], std::complex<double>(map.uv[v].x(), map.uv[v].y()));
}

TEST(Chart_of_another_mesh, gives_no_levels)
{
  SMP::HLSCM_options options;
  options.keep_progressive_mesh = true;
  Parameterizer parameterizer(options);
  Surface_mesh mesh = to_surface_mesh(hills()), other = to_surface_mesh(grid(2, 2));
  const Uv_map uvmap = new_uv_map(mesh);
  ASSERT_EQ(parameterizer.parameterize(mesh, border_halfedge(mesh), uvmap), SMP::OK);
  const SMP::Chart_progressive_mesh& chart = parameterizer.progressive_mesh();
  EXPECT_EQ(SMP::build_textured_progressive_mesh(mesh, uvmap, chart).error, "");
  for(const auto& result :
      {SMP::build_textured_progressive_mesh(other, new_uv_map(other), chart),
       SMP::build_textured_progressive_mesh(mesh, uvmap, SMP::Chart_progressive_mesh())}) {
    EXPECT_NE(result.error, "");
    EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::BAD_OPTIONS);
  }
}

// CGAL's table of texts has one too few.
TEST(Error_texts, are_there_for_all_codes)
{
  for(int error = SMP::OK; error <= SMP::ERROR_WRONG_PARAMETER; ++error) {
    ASSERT_NE(SMP::internal::text_of(SMP::Error_code(error)), nullptr);
    EXPECT_NE(std::string(SMP::internal::text_of(SMP::Error_code(error))), "unknown error");
  }
}

} // namespace bad_input_test
