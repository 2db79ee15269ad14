// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BAD_INPUTS_H
#define HLSCM_TEST_SUPPORT_BAD_INPUTS_H

// The same bad inputs at every door: an error and a sentence, never a signal.
//
// To add a door, write a struct with `outcome_of(mesh)` that derives from `Door`, which says what it
// needs, and add it, as `Of_mesh<...>`, to the `Doors` of a test. To add a bad input, add a row to
// `bad_inputs()`: every door that needs as much meets it.

#include <support/bad_arrays.h>
#include <support/chart_generators.h>

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace test_support {

using CGAL::Indexed_mesh::Mesh_outcome;
using CGAL::Indexed_mesh::Mesh_status;
using CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh;

// How the halfedge is chosen that a door of a mesh with halfedges asks for.
enum class Border { ITS_OWN, NONE, INSIDE, FOREIGN };

// What is wrong with the texture of a mesh, for doors that take one.
enum class Texture { GOOD, NAN_UV, NO_SUCH_UV, NO_WEDGES, TOO_FEW_WEDGES };

// What a door needs, each more than the one before; a mesh that lacks it is bad input for the door:
// arrays that can be read, triangles with three vertices, a manifold with lengths, a border and no
// handle.
enum class Needs { ARRAYS, TRIANGLES, SURFACE, CHART };

struct Input
{
  std::string name;
  Indexed_triangle_mesh mesh;
  Needs lacks;
  std::string named; // what the sentence must name
  Border border = Border::ITS_OWN;
  Texture texture = Texture::GOOD;
};

inline Input good_input() { return {"good", good_arrays(), Needs::CHART, ""}; }

inline Indexed_triangle_mesh with_triangle(Indexed_triangle_mesh mesh, const Triangle_indices& t)
{
  mesh.triangles[7] = t;
  return mesh;
}

inline Indexed_triangle_mesh in_one_point(Indexed_triangle_mesh mesh)
{
  for(Point_3& p : mesh.points)
    p = Point_3(1., 2., 3.);
  return mesh;
}

inline std::vector<Input> bad_inputs()
{
  const Indexed_triangle_mesh good = good_arrays();
  std::vector<Input> result;
  for(const auto& [name, mesh] : bad_arrays(good)) {
    const bool is_empty = mesh.triangles.empty();
    const bool is_of_points = name == "NaN" || name == "infinite";
    result.push_back({name, mesh, Needs::ARRAYS,
                      is_empty ? "" : is_of_points ? "vertex 5 " : "triangle 7 ",
                      is_empty ? Border::NONE : Border::ITS_OWN});
  }
  const Triangle_indices first = good.triangles[0];
  const std::vector<Input> others = {
    {"vertex twice", with_triangle(good, {first[0], first[1], first[1]}), Needs::TRIANGLES, ""},
    {"triangle twice", with_triangle(good, first), Needs::SURFACE, "vertex "},
    {"all in one point", in_one_point(good), Needs::SURFACE, ""},
    {"closed, null halfedge", sphere(2), Needs::CHART, "", Border::NONE},
    {"closed, some halfedge", sphere(2), Needs::CHART, "", Border::INSIDE},
    {"null halfedge", good, Needs::CHART, "", Border::NONE},
    {"halfedge inside", good, Needs::CHART, "", Border::INSIDE},
    {"halfedge of a larger mesh", good, Needs::CHART, "", Border::FOREIGN},
    {"genus 1", with_holes(torus(20, 10), 2, 1), Needs::CHART, ""},
    {"texture NaN", good, Needs::ARRAYS, "", Border::ITS_OWN, Texture::NAN_UV},
    {"no such uv", good, Needs::ARRAYS, "triangle 7 ", Border::ITS_OWN, Texture::NO_SUCH_UV},
    {"no wedges", good, Needs::ARRAYS, "", Border::ITS_OWN, Texture::NO_WEDGES},
    {"too few wedges", good, Needs::ARRAYS, "", Border::ITS_OWN, Texture::TOO_FEW_WEDGES}};
  result.insert(result.end(), others.begin(), others.end());
  return result;
}

// The mesh with a texture that is good if the mesh is.
inline Textured_triangle_mesh with_texture(const Indexed_triangle_mesh& mesh,
                                           Texture texture = Texture::GOOD)
{
  const Indexed_triangle_mesh good = good_arrays();
  Textured_triangle_mesh result = {mesh.points, mesh.triangles, {}, good.triangles};
  for(const Point_3& p : good.points)
    result.uv.emplace_back(p.x() / 12., p.y() / 9.);
  result.wedges.resize(mesh.triangles.size());
  if(texture == Texture::NAN_UV)
    result.uv[3] = Textured_triangle_mesh::Point_2(std::numeric_limits<double>::quiet_NaN(), 0.);
  else if(texture == Texture::NO_SUCH_UV)
    result.wedges[7][2] = Vertex_index(result.uv.size());
  else if(texture == Texture::NO_WEDGES)
    result.wedges.clear();
  else if(texture == Texture::TOO_FEW_WEDGES)
    result.wedges.pop_back();
  return result;
}

// Whether there is such a mesh with halfedges.
inline bool has_halfedges(const Indexed_triangle_mesh& mesh)
{
  using namespace CGAL::Indexed_mesh;
  return mesh.triangles.empty()
      || (index_error(mesh.triangles, mesh.points.size()).empty()
          && repeated_vertex_error(mesh.triangles).empty()
          && Vertex_rings(mesh).defect() == Ring_defect::NONE);
}

// Whether a door takes arrays, or meshes with halfedges, which cannot have wrong indices.
enum class Takes { ARRAYS, HALFEDGES };

template <Needs Needed, Takes Taken = Takes::ARRAYS>
struct Door
{
  static constexpr Needs needs = Needed;
  static constexpr bool has_halfedges = Taken == Takes::HALFEDGES;
  static constexpr bool has_texture = false;

  typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;

  // A parameter for each vertex.
  static Uv some_uv(const Indexed_triangle_mesh& mesh)
  {
    Uv uv;
    for(const Point_3& p : mesh.points)
      uv.emplace_back(std::isfinite(p.x()) ? p.x() : 0., std::isfinite(p.y()) ? p.y() : 0.);
    return uv;
  }
};

// A door of a mesh with a texture: `outcome_of()` takes a `Textured_triangle_mesh`.
template <Needs Needed, Takes Taken = Takes::ARRAYS>
struct Textured_door : Door<Needed, Taken>
{
  static constexpr bool has_texture = true;

  static Textured_triangle_mesh good() { return with_texture(good_arrays()); }
};

// Doors that have no halfedge to choose: a struct with `outcome_of(mesh)`.
template <class Door>
struct Of_mesh
{
  static constexpr Needs needs = Door::needs;
  static bool concerns(const Input& input)
  {
    return (input.border == Border::ITS_OWN || input.mesh.triangles.empty()
            || input.name == "closed, null halfedge")
        && (!Door::has_halfedges || (has_halfedges(input.mesh) && has_corners(input.texture)))
        && (Door::has_texture || input.texture == Texture::GOOD);
  }
  static std::string what_is_wrong(const Input& input)
  {
    Mesh_outcome outcome;
    if constexpr(Door::has_texture)
      outcome = Door::outcome_of(with_texture(input.mesh, input.texture));
    else
      outcome = Door::outcome_of(input.mesh);
    EXPECT_EQ(outcome.status, outcome.is_ok() ? Mesh_status::OK : Mesh_status::BAD_MESH);
    return outcome.error;
  }

private:
  // Whether each halfedge can have its texture coordinate.
  static bool has_corners(Texture texture)
  {
    return texture == Texture::GOOD || texture == Texture::NAN_UV;
  }
};

// A door on what is bad about one of two meshes; the other one is good.
enum class Which { FINE, LIGHT };

template <class Door>
void expect_an_error_and_a_sentence()
{
  for(const Input& input : bad_inputs()) {
    if(!Door::concerns(input) || input.lacks > Door::needs)
      continue;
    SCOPED_TRACE(input.name);
    const std::string sentence = Door::what_is_wrong(input);
    EXPECT_GT(sentence.size(), 10u);
    EXPECT_NE((sentence + " ").find(input.named), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(' '), std::string::npos);
  }
}

// A mesh with halfedges, and the texture coordinate at the target of each.
struct Textured_surface
{
  explicit Textured_surface(const Textured_triangle_mesh& arrays)
    : mesh(to_surface_mesh(Indexed_triangle_mesh{arrays.points, arrays.triangles}))
    , uv(mesh.add_property_map<Surface_mesh::Halfedge_index, Uv>("h:uv").first)
  {
    std::size_t t = 0;
    for(const auto f : faces(mesh)) {
      auto h = halfedge(f, mesh); // towards the corner of the first vertex of the triangle
      while(target(h, mesh) != Surface_mesh::Vertex_index(arrays.triangles[t][0]))
        h = next(h, mesh);
      for(const Vertex_index w : arrays.wedges[t++]) {
        uv[h] = arrays.uv[w];
        h = next(h, mesh);
      }
    }
  }

  typedef Textured_triangle_mesh::Point_2 Uv;
  Surface_mesh mesh;
  Surface_mesh::Property_map<Surface_mesh::Halfedge_index, Uv> uv;
};

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_BAD_INPUTS_H
