// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad input at the doors of texturing: each gives a sentence, no result and no signal.

#include <support/bad_arrays.h>
#include <support/chart_generators.h>
#include <support/textured_meshes.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/boost/graph/generators.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace bad_texturing_input_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_outcome;
using CGAL::Indexed_mesh::Mesh_status;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// A sentence, and the status that it goes with.
void expect_error(const Mesh_outcome& result, Mesh_status status, const std::string& where)
{
  EXPECT_EQ(result.status, status) << where << ": " << result.error;
  EXPECT_GT(result.error.size(), 8u) << where;
  EXPECT_FALSE(result.is_ok()) << where;
}

void expect_bad_mesh(const Mesh_outcome& result, const std::string& where)
{
  expect_error(result, Mesh_status::BAD_MESH, where);
}

void expect_bad_options(const Mesh_outcome& result, const std::string& where = {})
{
  expect_error(result, Mesh_status::BAD_OPTIONS, where);
}

void expect_good(const Mesh_outcome& result, const std::string& where)
{
  EXPECT_EQ(result.status, Mesh_status::OK) << where;
  EXPECT_EQ(result.error, "") << where;
  EXPECT_TRUE(result.is_ok()) << where;
}

// Meshes that no door takes.
std::vector<Named_mesh> bad_meshes() { return bad_arrays(grid(4, 4)); }

// These, and those that have no charts.
std::vector<Named_mesh> meshes_without_charts()
{
  std::vector<Named_mesh> result = bad_meshes();
  const Indexed_triangle_mesh good = grid(4, 4);
  result.push_back({"isolated vertex", good});
  result.back().mesh.points.emplace_back(0., 0., 1.);
  result.push_back({"vertex twice", good});
  result.back().mesh.triangles[3][1] = result.back().mesh.triangles[3][0];
  result.push_back({"three triangles at an edge", good});
  result.back().mesh.points.emplace_back(0., 0., 1.);
  result.back().mesh.triangles.push_back({good.triangles[6][0], good.triangles[6][1],
                                          Vertex_index(good.points.size())});
  return result;
}

Textured_triangle_mesh textured(const Indexed_triangle_mesh& mesh)
{
  Textured_triangle_mesh result;
  result.points = mesh.points;
  result.triangles = result.wedges = mesh.triangles;
  for(const auto& p : grid(4, 4).points)
    result.uv.emplace_back(p.x() / 4., p.y() / 4.);
  result.uv.resize((std::max)(mesh.points.size(), result.uv.size()));
  return result;
}

// The meshes above, and such with bad texture coordinates.
std::vector<Named_textured_mesh> bad_textured_meshes()
{
  std::vector<Named_textured_mesh> result;
  for(const auto& [name, mesh] : bad_meshes())
    result.push_back({name, textured(mesh)});
  const Textured_triangle_mesh good = textured(grid(4, 4));
  for(const std::string name : {"uv NaN", "wedge out of range", "no wedges", "too few wedges"})
    result.push_back({name, good});
  const std::size_t n = result.size();
  result[n - 4].mesh.uv[3] = Textured_triangle_mesh::Point_2(nan, 0.);
  result[n - 3].mesh.wedges[3][2] = Vertex_index(good.uv.size());
  result[n - 2].mesh.wedges.clear();
  result[n - 1].mesh.wedges.pop_back();
  return result;
}

SMT::Given_charts_segmenter one_chart(std::size_t triangles)
{
  SMT::Face_charts charts;
  charts.chart.assign(triangles, 0);
  charts.seams.assign(triangles, 0);
  charts.number_of_charts = 1;
  return SMT::Given_charts_segmenter(charts);
}

typedef std::pair<std::string, std::function<Mesh_outcome(const Indexed_triangle_mesh&)>> Mesh_door;

// What takes a mesh and finds charts.
std::vector<Mesh_door> charting_doors()
{
  return {
    {"build_texture_atlas",
     [](const auto& m) { return SMT::build_texture_atlas(m, small_texture()); }},
    {"build_texture_atlas with given charts",
     [](const auto& m) {
       return SMT::build_texture_atlas(m, small_texture(), one_chart(m.triangles.size()));
     }},
    {"build_texture_atlas with components",
     [](const auto& m) {
       return SMT::build_texture_atlas(m, small_texture(), SMT::Component_segmenter());
     }},
    {"build_texture_atlas with constrained edges",
     [](const auto& m) {
       const SMT::Constrained_segmenter<> segmenter(
         std::vector<std::uint8_t>(m.triangles.size(), 0));
       return SMT::build_texture_atlas(m, small_texture(), segmenter);
     }},
    {"grow_charts", [](const auto& m) { return SMT::grow_charts(m); }},
    {"segment_into_charts", [](const auto& m) { return SMT::segment_into_charts(m); }},
    {"segment_coarse_to_fine",
     [](const auto& m) {
       return SMT::segment_coarse_to_fine(m, {}, [](const Indexed_triangle_mesh& coarse) {
                return SMT::one_disk_per_component(coarse);
              });
     }}};
}

TEST(Bad_texturing_input, meshes_without_charts_give_a_sentence)
{
  for(const auto& [mesh_name, mesh] : meshes_without_charts())
    for(const auto& [door_name, door] : charting_doors())
      expect_bad_mesh(door(mesh), door_name + ", " + mesh_name);
  for(const auto& [door_name, door] : charting_doors())
    expect_good(door(grid(4, 4)), door_name);
}

TEST(Bad_texturing_input, rays_need_a_length)
{
  const Textured_triangle_mesh light = textured(grid(4, 4));
  for(const double distance : {0., -1., nan, infinity}) {
    SMT::Baking_by_rays_options options = small_image();
    options.max_distance = distance;
    expect_bad_options(
      SMT::bake_normal_map_by_rays<SMT::AABB_tree_ray_caster>(grid(4, 4), light, options),
      std::to_string(distance));
  }
}

TEST(Bad_texturing_input, texture_deviation_needs_a_texture)
{
  const SMM::Textured_progressive_mesh untextured
    = SMM::coarse_first(SMM::build_progressive_mesh(grid(4, 4)));
  const SMM::Textured_progressive_mesh good
    = SMM::build_textured_progressive_mesh(textured(grid(4, 4))).mesh;
  ASSERT_GT(good.number_of_collapses(), 0u);
  expect_good(SMM::measure_texture_deviation(good, 0), "textured");
  expect_bad_options(SMM::measure_texture_deviation(good, good.number_of_collapses() + 1));
  for(const SMM::Textured_progressive_mesh& mesh : {untextured, SMM::Textured_progressive_mesh()}) {
    expect_bad_mesh(SMM::measure_texture_deviation(mesh, 0), "untextured");
    EXPECT_FALSE(SMM::is_within_texture_deviation(mesh, 0, 1.));
    EXPECT_FALSE(SMM::is_within_distance(mesh, 0, 1.));
    for(const auto kind : {SMM::Level_error::TEXTURE_DEVIATION, SMM::Level_error::DISTANCE})
      EXPECT_EQ(SMM::coarsest_level_within(mesh, kind, 1.), 0u);
  }
  const SMM::Wedge_mesh whole = SMM::textured_level(good, 0);
  expect_good(SMM::measure_texture_deviation(whole, whole), "two meshes");
  std::vector<SMM::Wedge_mesh> bad(7, whole);
  bad[0].uv.clear();
  bad[1].triangles.clear();
  bad[2].triangles[3][1] = Vertex_index(whole.vertex.size());
  bad[3].vertex[3] = Vertex_index(-1);
  bad[4].points[3] = SMM::Wedge_mesh::Point_3(0., nan, 0.);
  bad[5].uv[3] = SMM::Wedge_mesh::Point_2(infinity, 0.);
  for(auto& p : bad[6].points)
    p = SMM::Wedge_mesh::Point_3(1., 2., 3.);
  for(const SMM::Wedge_mesh& mesh : bad) {
    expect_bad_mesh(SMM::measure_texture_deviation(mesh, whole), "fine");
    expect_bad_mesh(SMM::measure_texture_deviation(whole, mesh), "coarse");
  }
}

TEST(Bad_texturing_input, levels_need_their_own_arrays)
{
  const Textured_triangle_mesh mesh = textured(grid(4, 4));
  SMM::Textured_progressive_mesh_options options;
  options.is_locked.assign(3, true);
  expect_bad_options(SMM::build_textured_progressive_mesh(mesh, options));
  expect_bad_options(SMM::build_progressive_mesh(grid(4, 4), options));
  const SMM::Progressive_mesh pm = SMM::build_progressive_mesh(grid(4, 4)).progressive_mesh;
  expect_good(SMM::build_textured_progressive_mesh(pm, mesh.points, mesh.uv), "collapses");
  expect_bad_options(SMM::build_textured_progressive_mesh(pm, mesh.points, mesh.uv, options));
  expect_bad_mesh(SMM::build_textured_progressive_mesh(pm, {}, mesh.uv), "points");
  expect_bad_mesh(SMM::build_textured_progressive_mesh(pm, mesh.points, {}), "uv");
  SMM::Progressive_mesh wrong = pm;
  wrong.collapses.push_back({1000, 0});
  expect_bad_mesh(SMM::build_textured_progressive_mesh(wrong, mesh.points, mesh.uv), "collapse");
  SMM::Textured_progressive_mesh_options cancelled;
  cancelled.progress = [](double) { return false; };
  expect_error(SMM::build_progressive_mesh(grid(40, 40), cancelled), Mesh_status::CANCELLED, "");
  Textured_triangle_mesh square;
  square.points = grid(40, 40).points;
  square.triangles = square.wedges = grid(40, 40).triangles;
  for(const auto& p : square.points)
    square.uv.emplace_back(p.x() / 40., p.y() / 40.);
  const auto levels = SMM::build_textured_progressive_mesh(square, cancelled);
  expect_error(levels, Mesh_status::CANCELLED, "textured");
  EXPECT_EQ(levels.mesh.points.size(), square.points.size()); // as far as it came
}

TEST(Bad_texturing_input, arrays_of_another_length_give_a_sentence)
{
  const Textured_triangle_mesh mesh = textured(grid(4, 4));
  const std::vector<SMT::Vector_3> normals = SMT::vertex_normals(mesh);
  const SMT::Tangent_frames frames = SMT::tangent_frames(mesh, normals);
  const std::vector<SMT::Vector_3> few(normals.begin(), normals.end() - 1);
  std::vector<SMT::Tangent_frames> bad_frames = {{}, frames, frames, frames};
  bad_frames[1].normals.pop_back();
  bad_frames[2].corners.pop_back();
  bad_frames[3].corners[0][0] = Vertex_index(frames.frames.size());
  const SMT::Baking_by_rays_options options = small_image();
  expect_bad_options(SMT::bake_normal_map(mesh, few, mesh, frames, options));
  expect_bad_options(SMT::bake_displacement(mesh, mesh, few, options).map);
  for(const SMT::Tangent_frames& bad : bad_frames) {
    expect_bad_options(SMT::bake_normal_map(mesh, normals, mesh, bad, options));
    expect_bad_options(
      SMT::bake_normal_map_by_rays<SMT::AABB_tree_ray_caster>(grid(4, 4), normals, mesh, bad,
                                                              options));
  }
  expect_bad_options(SMT::bake_vertex_colors(mesh, {1.f}, 3, mesh, options));
  expect_bad_options(SMT::bake_vertex_colors(mesh, {}, 0, mesh, options));
  expect_bad_options(SMT::bake_image(mesh, mesh, {2, 2, 3, {1.f}}, mesh, options));
  expect_bad_options(SMT::bake_image(mesh, mesh, {}, mesh, options));
  Textured_triangle_mesh former = mesh;
  former.triangles.pop_back();
  former.wedges.pop_back();
  expect_bad_options(SMT::bake_image(mesh, former, {1, 1, 1, {1.f}}, mesh, options));
}

TEST(Bad_texturing_input, options_without_sense_give_a_sentence)
{
  const Textured_triangle_mesh mesh = textured(grid(4, 4));
  const auto bake = [&mesh](std::size_t width, std::size_t height, std::size_t samples) {
    SMT::Baking_options options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    return SMT::bake_normal_map(mesh, mesh, options);
  };
  expect_bad_options(bake(0, 16, 1));
  expect_bad_options(bake(16, 0, 1));
  expect_bad_options(bake(16, 16, 0));
  expect_bad_options(bake(16, 16, std::size_t(-1)));
  const auto expect_error = [](const std::string& name, auto change) {
    SMT::Texture_atlas_options options = small_texture();
    change(options);
    const SMT::Texture_atlas_result result = SMT::build_texture_atlas(grid(4, 4), options);
    expect_bad_options(result, name);
    EXPECT_TRUE(result.atlas.mesh.uv.empty()) << name;
  };
  expect_error("width", [](auto& o) { o.packing.width = 0; });
  expect_error("padding", [](auto& o) { o.packing.padding = 1000; });
  expect_error("mip levels", [](auto& o) { o.packing.mip_levels = 100; });
  expect_error("rotations", [](auto& o) { o.packing.rotations = -1; });
  expect_error("texels", [](auto& o) { o.packing.texels_per_unit = nan; });
  expect_error("bound", [](auto& o) { o.bound.area_scale = nan; });
  expect_error("ratio", [](auto& o) { o.bound.quasi_conformal = 0.; });
  expect_error("densities", [](auto& o) { o.density = {1.f}; });
  expect_error("negative density", [](auto& o) { o.density.assign(32, -1.f); });
  expect_error("NaN density", [](auto& o) { o.density.assign(32, float(nan)); });
  for(const std::size_t faces : {std::size_t(0), std::size_t(1)}) { // as coarse as can be
    SMT::Texture_atlas_options options = small_texture();
    options.coarse_faces = options.trial_faces = faces;
    EXPECT_EQ(SMT::build_texture_atlas(grid(4, 4), options).error, "") << faces;
  }
}

TEST(Bad_texturing_input, charts_of_another_mesh_give_a_sentence)
{
  for(const std::size_t triangles : {0, 1, 31, 33}) {
    expect_bad_options(
      SMT::build_texture_atlas(grid(4, 4), small_texture(), one_chart(triangles)));
    const SMT::Constrained_segmenter<> segmenter(std::vector<std::uint8_t>(triangles, 7));
    expect_bad_options(SMT::build_texture_atlas(grid(4, 4), small_texture(), segmenter));
  }
  SMT::Face_charts charts; // whose numbers make no sense: their seams count
  charts.seams.assign(32, 0xff);
  charts.chart.assign(5, 77);
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(grid(4, 4), small_texture(), SMT::Given_charts_segmenter(charts));
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.atlas.charts.number_of_charts, 32u);
}

// Functions of charts have no place for a sentence: they return none, and charts_error() has it.
void expect_no_charts(const Indexed_triangle_mesh& mesh, const SMT::Face_charts& charts,
                      Mesh_status status, const std::string& where)
{
  expect_error(SMT::charts_error(mesh, charts), status, where);
  EXPECT_EQ(SMT::straighten_charts(mesh, charts).number_of_charts, 0u) << where;
  EXPECT_EQ(SMT::cut_to_disks(mesh, charts).number_of_charts, 0u) << where;
  EXPECT_EQ(SMT::measure_seams(mesh, charts).edges, 0u) << where;
  EXPECT_TRUE(SMT::chart_meshes(mesh, charts).empty()) << where;
}

TEST(Bad_texturing_input, functions_of_charts_return_none)
{
  const Indexed_triangle_mesh good = grid(4, 4);
  for(const auto& [name, mesh] : meshes_without_charts()) {
    const std::size_t n = mesh.triangles.size();
    const SMT::Face_charts charts
      = SMT::charts_between(mesh.triangles, std::vector<std::uint8_t>(n, 0)); // no signal
    EXPECT_EQ(SMT::charts_of_labels(mesh.triangles, std::vector<std::uint32_t>(n, 0)).seams,
              charts.seams) << name;
    EXPECT_EQ(SMT::straighten_charts(mesh, charts).number_of_charts, 0u) << name;
    // Charts know no vertices, and two triangles with one direction of an edge are no neighbours
    if(name == "isolated vertex" || name == "three triangles at an edge")
      expect_good(SMT::charts_error(mesh, charts), name);
    else
      expect_no_charts(mesh, charts, Mesh_status::BAD_MESH, name);
  }
  Indexed_triangle_mesh thrice = good;
  thrice.triangles.push_back(good.triangles[9]);
  expect_no_charts(thrice,
                   SMT::charts_between(thrice.triangles, std::vector<std::uint8_t>(33, 0)),
                   Mesh_status::BAD_MESH, "edges of three triangles");
  for(const auto& [name, mesh] : bad_textured_meshes())
    EXPECT_EQ(SMT::charts_of_texture(mesh).number_of_charts, 0u) << name;
  const SMT::Face_charts charts
    = SMT::charts_between(good.triangles, std::vector<std::uint8_t>(32, 0));
  expect_good(SMT::charts_error(good, charts), "one chart");
  EXPECT_EQ(SMT::straighten_charts(good, charts).seams, charts.seams);
  EXPECT_EQ(SMT::cut_to_disks(good, charts).seams, charts.seams);
  std::vector<SMT::Face_charts> bad(6, charts);
  bad[0].seams.pop_back();
  bad[1].chart.pop_back();
  bad[2].chart[3] = 1;
  bad[3].number_of_charts = 2;
  bad[3].chart[3] = 1;                           // in spite of what is no seam
  bad[4].seams.assign(32, 0);                    // not even the border
  bad[5].seams[10] = std::uint8_t(~bad[5].seams[10] & 7); // on one side
  for(std::size_t i = 0; i < bad.size(); ++i)
    expect_no_charts(good, bad[i], Mesh_status::BAD_OPTIONS, "bad charts " + std::to_string(i));
  EXPECT_EQ(SMT::charts_between(good.triangles, {}).number_of_charts, 0u);
  EXPECT_EQ(SMT::charts_of_labels(good.triangles, {1, 2}).number_of_charts, 0u);
  EXPECT_TRUE(SMT::chart_topologies(good.triangles, SMT::Face_charts()).empty());
  expect_bad_options(SMT::segment_coarse_to_fine(
    good, {}, [](const Indexed_triangle_mesh&) { return SMT::Face_charts(); }));
}

TEST(Bad_texturing_input, charts_that_cannot_be_packed_give_a_sentence)
{
  const SMT::Chart_shape good = {{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 1, 2}}};
  std::vector<SMT::Chart_shape> bad(4, good);
  bad[0].uv[1] = SMT::Chart_shape::Point_2(nan, 0.);
  bad[1].uv[1] = SMT::Chart_shape::Point_2(infinity, 0.);
  bad[2].uv[1] = SMT::Chart_shape::Point_2(1e308, -1e308);
  bad[2].uv[2] = SMT::Chart_shape::Point_2(-1e308, 1e308);
  bad[3].triangles[0][2] = 3;
  for(const SMT::Chart_shape& chart : bad) {
    expect_bad_mesh(SMT::pack_charts({good, chart}), "Raster_packer");
    expect_bad_mesh(SMT::pack_charts<SMT::Horizon_packer>({good, chart}), "Horizon_packer");
  }
  SMT::Packing_options too_dense;
  too_dense.texels_per_unit = 1e4;
  expect_error(SMT::pack_charts({good}, too_dense), Mesh_status::FAILED, "too dense");
  expect_error(SMT::pack_charts<SMT::Horizon_packer>({good}, too_dense), Mesh_status::FAILED,
               "too dense");
  EXPECT_EQ(SMT::pack_charts({}).error, "");
  EXPECT_EQ(SMT::pack_charts({SMT::Chart_shape()}).error, "");
  EXPECT_EQ(SMT::pack_charts<SMT::Horizon_packer>({SMT::Chart_shape()}).error, "");
}

TEST(Bad_texturing_input, meshes_of_any_type_give_a_sentence)
{
  typedef CGAL::Simple_cartesian<double> Kernel;
  typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
  Mesh empty, quad;
  CGAL::make_quad(Kernel::Point_3(0., 0., 0.), Kernel::Point_3(1., 0., 0.),
                  Kernel::Point_3(1., 1., 0.), Kernel::Point_3(0., 1., 0.), quad);
  for(Mesh* mesh : {&empty, &quad}) {
    const auto uv = mesh->add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
    const auto chart = mesh->add_property_map<Mesh::Face_index, std::size_t>("f:chart").first;
    const auto color
      = mesh->add_property_map<Mesh::Vertex_index, std::array<float, 3>>("v:color").first;
    expect_bad_mesh(SMT::build_texture_atlas(*mesh, uv, chart), "any type");
    expect_bad_mesh(SMT::segment_into_charts(*mesh, chart), "any type");
    expect_bad_mesh(SMT::bake_normal_map(*mesh, uv, *mesh, uv), "any type");
    expect_bad_mesh(SMT::bake_displacement(*mesh, uv, *mesh, uv).map, "any type");
    const SMT::Texture_image image = {1, 1, 1, {1.f}};
    expect_bad_mesh(SMT::bake_image(*mesh, uv, uv, image, *mesh, uv), "any type");
    expect_bad_mesh(SMT::bake_vertex_colors(*mesh, uv, color, 3, *mesh, uv), "any type");
    expect_bad_mesh(SMT::bake_normal_map_by_rays<SMT::AABB_tree_ray_caster>(*mesh, *mesh, uv),
                    "any type");
    EXPECT_FALSE(SMT::mark_seams(*mesh, SMT::Face_charts{{7, 7}, {0, 0}, 1},
                                 mesh->add_property_map<Mesh::Edge_index, bool>("e:seam").first));
  }
}

} // namespace bad_texturing_input_test
