// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same bad inputs at every door: an error and a sentence, never a signal.
//
// To add a door, write a struct with `what_is_wrong(input)`, which returns the sentence ("" if all
// went well), and with what it `needs`, and add it to `Doors`. To add a bad input, add a row to
// `bad_inputs()`: every door that needs as much meets it.

#include <support/bad_arrays.h>
#include <support/conformal_maps.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/face_distortion.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace bad_input_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_outcome;
using CGAL::Indexed_mesh::Mesh_status;

// How the halfedge is chosen that a door of a mesh with halfedges asks for.
enum class Border { ITS_OWN, NONE, INSIDE, FOREIGN };

// What a door needs, each more than the one before; a mesh that lacks it is bad input for the door:
// arrays that can be read, triangles with three vertices, a manifold with lengths, a border and no
// handle.
enum class Needs { ARRAYS, TRIANGLES, SURFACE, CHART };

struct Input
{
  std::string name;
  Indexed_triangle_mesh mesh;
  Border border;
  Needs lacks;
  std::string named; // what the sentence must name
};

Indexed_triangle_mesh with_triangle(Indexed_triangle_mesh mesh, const Triangle_indices& t)
{
  mesh.triangles[7] = t;
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
  std::vector<Input> result;
  for(const auto& [name, mesh] : bad_arrays(good_arrays())) {
    const bool is_empty = mesh.triangles.empty();
    const bool is_of_points = name == "NaN" || name == "infinite";
    result.push_back({name, mesh, is_empty ? Border::NONE : Border::ITS_OWN, Needs::ARRAYS,
                      is_empty ? "" : is_of_points ? "vertex 5 " : "triangle 7 "});
  }
  const Triangle_indices first = good_arrays().triangles[0];
  const std::vector<Input> others = {
    {"vertex twice", with_triangle(good_arrays(), {first[0], first[1], first[1]}), Border::ITS_OWN,
     Needs::TRIANGLES, ""},
    {"triangle twice", with_triangle(good_arrays(), first), Border::ITS_OWN, Needs::SURFACE, "vertex "},
    {"all in one point", in_one_point(good_arrays()), Border::ITS_OWN, Needs::SURFACE, ""},
    {"closed, null halfedge", sphere(2), Border::NONE, Needs::CHART, ""},
    {"closed, some halfedge", sphere(2), Border::INSIDE, Needs::CHART, ""},
    {"null halfedge", good_arrays(), Border::NONE, Needs::CHART, ""},
    {"halfedge inside", good_arrays(), Border::INSIDE, Needs::CHART, ""},
    {"halfedge of a larger mesh", good_arrays(), Border::FOREIGN, Needs::CHART, ""},
    {"genus 1", with_holes(torus(20, 10), 2, 1), Border::ITS_OWN, Needs::CHART, ""}};
  result.insert(result.end(), others.begin(), others.end());
  return result;
}

// Whether there is such a mesh with halfedges.
bool has_halfedges(const Indexed_triangle_mesh& mesh)
{
  using namespace CGAL::Indexed_mesh;
  return mesh.triangles.empty()
      || (index_error(mesh.triangles, mesh.points.size()).empty()
          && repeated_vertex_error(mesh.triangles).empty()
          && Vertex_rings(mesh).defect() == Ring_defect::NONE);
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
  static constexpr Needs needs = Needs::CHART;
  static bool concerns(const Input& input) { return has_halfedges(input.mesh); }

  static std::string
  sentence_of(const SMP::Low_stretch_parameterizer_3<Surface_mesh>& parameterizer)
  {
    return parameterizer.outcome().error;
  }
  template <class Parameterizer_3>
  static std::string sentence_of(const Parameterizer_3& parameterizer)
  {
    return parameterizer.report().message;
  }

  // The sentence of a parameterizer; its error must go with it.
  template <class Parameterizer_3>
  static std::string message_of(Parameterizer_3 parameterizer, const Input& input)
  {
    Surface_mesh mesh = to_surface_mesh(input.mesh);
    const Uv_map uvmap = new_uv_map(mesh);
    const SMP::Error_code error
      = parameterizer.parameterize(mesh, chosen_halfedge(mesh, input.border), uvmap);
    EXPECT_EQ(error == SMP::OK, sentence_of(parameterizer).empty());
    if(error != SMP::OK) {
      for(const std::complex<double>& z : parameters(mesh, uvmap))
        EXPECT_EQ(z, std::complex<double>(untouched, untouched)) << "written in spite of an error";
    }
    return sentence_of(parameterizer);
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

struct Low_stretch_parameterizer_door
  : public Mesh_door
{
  static std::string what_is_wrong(const Input& input)
  {
    return message_of(SMP::Low_stretch_parameterizer_3<Surface_mesh>(), input);
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

// Doors that have no halfedge to choose: a struct with `outcome_of(mesh)`.
template <class Door>
struct Without_halfedge
{
  static constexpr Needs needs = Door::needs;
  static bool concerns(const Input& input)
  {
    return (input.border == Border::ITS_OWN || input.mesh.triangles.empty()
            || input.name == "closed, null halfedge")
        && (!Door::has_halfedges || has_halfedges(input.mesh));
  }
  static std::string what_is_wrong(const Input& input)
  {
    const Mesh_outcome outcome = Door::outcome_of(input.mesh);
    EXPECT_EQ(outcome.status, outcome.is_ok() ? Mesh_status::OK : Mesh_status::BAD_MESH);
    return outcome.error;
  }
};

template <Needs Needed, bool Has_halfedges = false>
struct Door
{
  static constexpr Needs needs = Needed;
  static constexpr bool has_halfedges = Has_halfedges;

  typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;

  // A parameter for each vertex.
  static Uv some_uv(const Indexed_triangle_mesh& mesh)
  {
    Uv uv;
    for(const Point_3& p : mesh.points)
      uv.emplace_back(std::isfinite(p.x()) ? p.x() : 0., std::isfinite(p.y()) ? p.y() : 0.);
    return uv;
  }
  static SMT::Textured_triangle_mesh textured(const Indexed_triangle_mesh& mesh)
  {
    return {mesh.points, mesh.triangles, some_uv(mesh), mesh.triangles};
  }
};

// The result, if it has as much as it says.
template <class Result>
Result with_uv(const Result& map)
{
  EXPECT_EQ(map.is_ok(), !map.uv.empty());
  return map;
}

struct Conformal_map_door : Door<Needs::CHART>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMP::Conformal_map map = with_uv(SMP::conformal_map(mesh));
    EXPECT_EQ(map.code == SMP::OK, map.is_ok());
    EXPECT_EQ(map.report.message, map.error);
    return map;
  }
};

struct Pinned_map_door : Door<Needs::CHART>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return with_uv(SMP::conformal_map(mesh, {{0, 0., 0.}, {3, 1., 0.}}));
  }
};

struct Border_first_door : Door<Needs::CHART>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return with_uv(SMP::border_first_map(mesh));
  }
};

struct Low_stretch_door : Door<Needs::CHART>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return with_uv(SMP::low_stretch_map(mesh));
  }
};

struct Live_low_stretch_door : Door<Needs::CHART>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    SMP::Live_low_stretch_map<> map(mesh);
    const Mesh_outcome result = map.outcome();
    EXPECT_EQ(map.has_map(), result.is_ok());
    EXPECT_EQ(map.uv().empty(), !result.is_ok());
    EXPECT_EQ(map.solve(), result.is_ok());
    map.set_pin(std::size_t(-1), Point_2(0., 0.));
    EXPECT_FALSE(map.solve());
    return result;
  }
};

struct Surface_map_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::map_surface(mesh);
  }
};

struct Atlas_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMT::build_texture_atlas(mesh, small_texture());
  }
};

struct Mesh_atlas_door : Door<Needs::SURFACE, true>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    const auto uv = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;
    const auto chart
      = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:chart").first;
    return SMT::build_texture_atlas(mesh, uv, chart, small_texture());
  }
};

struct Decimation_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(Indexed_triangle_mesh mesh)
  {
    const Indexed_triangle_mesh before = mesh;
    SMM::Decimation_options options;
    options.target_vertices = 20;
    const SMM::Decimation_result result = SMM::decimate(mesh, options);
    EXPECT_EQ(result.is_ok(), mesh.triangles != before.triangles);
    return result;
  }
};

struct Mesh_decimation_door : Door<Needs::SURFACE, true>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    SMM::Decimation_options options;
    options.target_vertices = 20;
    const SMM::Decimation_result result = SMM::decimate(mesh, options);
    EXPECT_EQ(result.is_ok(), mesh.number_of_faces() < arrays.triangles.size());
    return result;
  }
};

struct Progressive_mesh_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMM::Progressive_surface result = SMM::build_progressive_mesh(mesh);
    EXPECT_EQ(result.is_ok(), !result.progressive_mesh.collapses.empty());
    return result;
  }
};

struct Mesh_progressive_mesh_door : Door<Needs::SURFACE, true>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    return SMM::build_progressive_mesh(to_surface_mesh(mesh));
  }
};

struct Hierarchy_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    CGAL::Surface_mesh_multigrid::Surface_multigrid_solver<> solver(mesh);
    std::vector<double> distance;
    const Mesh_outcome result
      = CGAL::Surface_mesh_multigrid::heat_distances(solver, mesh, 0, distance);
    EXPECT_EQ(result.is_ok(), !distance.empty());
    EXPECT_EQ(solver.hierarchy()->error, result.error);
    return result;
  }
};

struct Signal_metric_door : Door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const std::vector<double> importance(mesh.triangles.size(), 1.);
    EXPECT_EQ(SMP::importance_metric(mesh, importance).is_ok(),
              CGAL::Indexed_mesh::mesh_error(mesh).empty());
    return SMP::signal_metric(mesh, SMT::normal_signal(mesh));
  }
};

struct Distortion_door : Door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    SMP::measure_face_distortion(textured(mesh)); // no signal
    return SMP::measure_distortion(textured(mesh));
  }
};

struct Certificate_door : Door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMP::Map_certificate result = SMP::certify_map(mesh, some_uv(mesh));
    EXPECT_TRUE(result.is_ok() || !result.is_one_to_one());
    const Uv uv = some_uv(mesh); // no signal:
    SMP::has_global_overlap(SMP::Uv_arrays(mesh, uv));
    return result;
  }
};

struct Repair_door : Door<Needs::TRIANGLES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    Uv uv = some_uv(mesh);
    for(std::size_t v = 0; v < uv.size(); v += 7) // so that there is something to do
      uv[v] = Point_2(-uv[v].y(), uv[v].x());
    const Uv before = uv;
    const SMP::Flip_repair_report result = SMP::repair_flipped_faces(mesh, uv);
    EXPECT_EQ(result.is_ok(), uv != before);
    return result;
  }
};

template <class Door>
class Bad_input
  : public testing::Test
{};

typedef testing::Types<Parameterizer_door<SMP::Conformal_method::HLSCM>,
                       Parameterizer_door<SMP::Conformal_method::CASCADIC>,
                       Parameterizer_door<SMP::Conformal_method::LSCM>,
                       Parameterizer_door<SMP::Conformal_method::DIRECT>, Spectral_door,
                       Low_stretch_parameterizer_door, Live_door,
                       Without_halfedge<Conformal_map_door>, Without_halfedge<Pinned_map_door>,
                       Without_halfedge<Border_first_door>, Without_halfedge<Low_stretch_door>,
                       Without_halfedge<Live_low_stretch_door>, Without_halfedge<Surface_map_door>,
                       Without_halfedge<Atlas_door>, Without_halfedge<Mesh_atlas_door>,
                       Without_halfedge<Decimation_door>, Without_halfedge<Mesh_decimation_door>,
                       Without_halfedge<Progressive_mesh_door>,
                       Without_halfedge<Mesh_progressive_mesh_door>,
                       Without_halfedge<Hierarchy_door>, Without_halfedge<Signal_metric_door>,
                       Without_halfedge<Distortion_door>, Without_halfedge<Certificate_door>,
                       Without_halfedge<Repair_door>>
  Doors;
TYPED_TEST_SUITE(Bad_input, Doors);

TYPED_TEST(Bad_input, gives_an_error_and_a_sentence)
{
  for(const Input& input : bad_inputs()) {
    if(!TypeParam::concerns(input) || input.lacks > TypeParam::needs)
      continue;
    SCOPED_TRACE(input.name);
    const std::string sentence = TypeParam::what_is_wrong(input);
    EXPECT_GT(sentence.size(), 10u);
    EXPECT_NE((sentence + " ").find(input.named), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(' '), std::string::npos);
  }
}

// So that the doors are not simply shut.
TYPED_TEST(Bad_input, is_not_seen_in_a_good_one)
{
  EXPECT_EQ(TypeParam::what_is_wrong({"good", good_arrays(), Border::ITS_OWN, Needs::CHART, ""}), "");
}

} // namespace bad_input_test
