// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad input at the doors of maps, levels and matrices; see support/bad_inputs.h.

#include <support/bad_inputs.h>
#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/Polygonal_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/face_distortion.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace bad_input_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;

Surface_mesh::Halfedge_index chosen_halfedge(const Surface_mesh& mesh, Border border)
{
  if(border == Border::FOREIGN)
    return Surface_mesh::Halfedge_index(100000);
  for(const auto h : mesh.halfedges())
    if(border != Border::NONE && mesh.is_border(h) == (border == Border::ITS_OWN))
      return h;
  return Surface_mesh::null_halfedge();
}

// Doors of meshes with halfedges, one of which is chosen.
struct Mesh_door
{
  static constexpr Needs needs = Needs::CHART;
  static bool concerns(const Input& input)
  {
    return has_halfedges(input.mesh) && input.texture == Texture::GOOD;
  }

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

struct Mesh_decimation_door : Door<Needs::SURFACE, Takes::HALFEDGES>
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
    SMM::level_after(result, 0); // no signal
    SMM::coarse_first(result);
    return result;
  }
};

struct Mesh_progressive_mesh_door : Door<Needs::SURFACE, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMM::Progressive_surface result = SMM::build_progressive_mesh(to_surface_mesh(mesh));
    Surface_mesh level;
    const Mesh_outcome copied = SMM::copy_level(result, 0, level);
    EXPECT_EQ(copied.error, result.error);
    EXPECT_EQ(level.is_empty(), !result.is_ok());
    EXPECT_EQ(SMM::copy_level(result, 100000, level).is_ok(), false);
    return result;
  }
};

// Levels of a mesh with seams, as arrays and as meshes with halfedges.
SMM::Textured_progressive_mesh_result
with_levels(const SMM::Textured_progressive_mesh_result& result)
{
  EXPECT_EQ(result.is_ok(), !result.mesh.points.empty());
  const SMM::Level_extractor extractor(result.mesh);
  for(const std::size_t k : {std::size_t(0), result.mesh.number_of_collapses()}) {
    EXPECT_EQ(result.is_ok(), !extractor.mesh(k).triangles.empty());
    EXPECT_EQ(result.is_ok(), !SMM::textured_level(result.mesh, k).triangles.empty());
    Surface_mesh level;
    EXPECT_EQ(SMM::copy_level(result.mesh, extractor.triangles(k), level).error, "");
    EXPECT_EQ(level.number_of_faces(), extractor.number_of_triangles(k));
  }
  return result;
}

struct Levels_door : Textured_door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    return with_levels(SMM::build_textured_progressive_mesh(mesh));
  }
};

struct Mesh_levels_door : Textured_door<Needs::SURFACE, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& arrays)
  {
    const Textured_surface surface(arrays);
    return with_levels(SMM::build_textured_progressive_mesh(
      surface.mesh, surface.uv, SMM::Textured_progressive_mesh_options()));
  }
};

// Levels from collapses, here none.
struct Collapses_door : Door<Needs::SURFACE>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    SMM::Progressive_mesh pm = SMM::trivial_progressive_mesh(mesh.points.size());
    pm.triangles = mesh.triangles;
    return with_levels(SMM::build_textured_progressive_mesh(pm, mesh.points, some_uv(mesh)));
  }
};

// The levels of a chart whose mesh has become another.
struct Chart_levels_door : Door<Needs::ARRAYS, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    SMP::HLSCM_options options;
    options.keep_progressive_mesh = true;
    Parameterizer parameterizer(options);
    Surface_mesh good = to_surface_mesh(good_arrays());
    const Uv_map good_uv = new_uv_map(good);
    EXPECT_EQ(parameterizer.parameterize(good, border_halfedge(good), good_uv), SMP::OK);
    Surface_mesh mesh = to_surface_mesh(arrays);
    const Uv_map uv = new_uv_map(mesh);
    for(const auto v : vertices(mesh))
      uv[v] = good_uv[v];
    return with_levels(
      SMP::build_textured_progressive_mesh(mesh, uv, parameterizer.progressive_mesh()));
  }
};

// Its triangles are those of the chart.
struct Of_mesh_of_chart : Of_mesh<Chart_levels_door>
{
  static bool concerns(const Input& input)
  {
    return !input.mesh.triangles.empty() && Of_mesh<Chart_levels_door>::concerns(input);
  }
};

template <Which Bad>
struct Deviation_door : Door<Needs::ARRAYS>
{
  static SMM::Wedge_mesh wedge_mesh(const Indexed_triangle_mesh& mesh)
  {
    SMM::Wedge_mesh result = {mesh.points, {}, some_uv(mesh), mesh.triangles};
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      result.vertex.push_back(v);
    return result;
  }
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& mesh)
  {
    const SMM::Wedge_mesh bad = wedge_mesh(mesh), good = wedge_mesh(good_arrays());
    return Bad == Which::FINE ? SMM::measure_texture_deviation(bad, good)
                              : SMM::measure_texture_deviation(good, bad);
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
    const SMP::Face_tensors signal = SMP::vertex_signal(
      mesh, std::vector<double>(3 * mesh.points.size(), 1.), 3);
    EXPECT_EQ(signal.is_ok(), !signal.tensors.empty());
    return SMP::signal_metric(mesh, signal);
  }
};

struct Distortion_door : Textured_door<Needs::ARRAYS>
{
  static Mesh_outcome outcome_of(const Textured_triangle_mesh& mesh)
  {
    SMP::measure_face_distortion(mesh); // no signal
    SMM::with_wedges(mesh);
    SMM::vertices_of_wedges(mesh);
    return SMP::measure_distortion(mesh);
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

struct Mesh_measures_door : Door<Needs::ARRAYS, Takes::HALFEDGES>
{
  static Mesh_outcome outcome_of(const Indexed_triangle_mesh& arrays)
  {
    Surface_mesh mesh = to_surface_mesh(arrays);
    const Uv_map uv = new_uv_map(mesh);
    for(const auto v : vertices(mesh))
      uv[v] = Point_2(mesh.point(v).x(), mesh.point(v).y());
    const auto distortion
      = mesh.add_property_map<Surface_mesh::Face_index, SMP::Face_distortion>("f:d").first;
    EXPECT_TRUE(SMP::measure_face_distortion(mesh, uv, distortion));
    SMP::certify_map(mesh, uv); // no signal
    const SMP::Flip_repair_report repaired = SMP::repair_flipped_faces(mesh, uv);
    const Mesh_outcome result = SMP::measure_distortion(mesh, uv);
    EXPECT_EQ(repaired.error, result.error);
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
                       Low_stretch_parameterizer_door, Live_door, Of_mesh<Conformal_map_door>,
                       Of_mesh<Pinned_map_door>, Of_mesh<Border_first_door>,
                       Of_mesh<Low_stretch_door>, Of_mesh<Live_low_stretch_door>,
                       Of_mesh<Decimation_door>, Of_mesh<Mesh_decimation_door>,
                       Of_mesh<Progressive_mesh_door>, Of_mesh<Mesh_progressive_mesh_door>,
                       Of_mesh<Levels_door>, Of_mesh<Mesh_levels_door>, Of_mesh<Collapses_door>,
                       Of_mesh_of_chart, Of_mesh<Deviation_door<Which::FINE>>,
                       Of_mesh<Deviation_door<Which::LIGHT>>, Of_mesh<Hierarchy_door>,
                       Of_mesh<Signal_metric_door>, Of_mesh<Distortion_door>,
                       Of_mesh<Mesh_measures_door>, Of_mesh<Certificate_door>, Of_mesh<Repair_door>>
  Doors;
TYPED_TEST_SUITE(Bad_input, Doors);

TYPED_TEST(Bad_input, gives_an_error_and_a_sentence)
{
  expect_an_error_and_a_sentence<TypeParam>();
}

// So that the doors are not simply shut.
TYPED_TEST(Bad_input, is_not_seen_in_a_good_one)
{
  EXPECT_EQ(TypeParam::what_is_wrong(good_input()), "");
}

// What has an error code alone, as CGAL's concept of it has none for sentences.
TEST(Polygonal_border, needs_a_border_with_a_length)
{
  const SMP::Polygonal_border_parameterizer_3<Surface_mesh> square({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto error_of = [&square](const Input& input) {
    Surface_mesh mesh = to_surface_mesh(input.mesh);
    const auto is_set = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("v:set", false).first;
    return square.parameterize(mesh, chosen_halfedge(mesh, input.border), new_uv_map(mesh), 0, is_set);
  };
  EXPECT_EQ(error_of(good_input()), SMP::OK);
  for(const Input& input : bad_inputs())
    if(has_halfedges(input.mesh) && input.texture == Texture::GOOD && input.name != "genus 1") {
      EXPECT_NE(error_of(input), SMP::OK) << input.name;
    }
}

} // namespace bad_input_test
