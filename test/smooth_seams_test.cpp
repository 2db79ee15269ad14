// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seams that are led through triangles.

#include <support/bad_surfaces.h>
#include <support/chart_generators.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/Chart_segmenters.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/segment_into_charts.h>
#include <CGAL/Surface_mesh_texturing/smooth_seams.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace smooth_seams_test {

namespace SMT = CGAL::Surface_mesh_texturing;
namespace IM = CGAL::Indexed_mesh;
using namespace test_support;

constexpr std::uint64_t seed = 23170;
const std::string seed_text = ", seed " + std::to_string(seed);

double area(const Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  return std::sqrt(CGAL::squared_area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
}

double seam_length(const Indexed_triangle_mesh& mesh, const SMT::Face_charts& charts)
{
  return SMT::measure_seams(mesh, IM::Triangle_adjacency(mesh.triangles), charts).length;
}

// Disks: a patch around each of some random triangles, what is no disk then being cut.
SMT::Face_charts random_charts(const Indexed_triangle_mesh& mesh, std::size_t number, Random& random)
{
  const IM::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> label(mesh.triangles.size(), std::uint32_t(-1));
  std::vector<std::size_t> front;
  for(std::size_t i = 0; i < number; ++i) {
    front.push_back(uniform_index(random, label.size()));
    label[front.back()] = std::uint32_t(i);
  }
  while(!front.empty()) { // in random order: ragged
    std::swap(front[uniform_index(random, front.size())], front.back());
    const std::size_t t = front.back();
    bool is_done = true;
    for(int c = 0; c < 3; ++c) {
      const auto o = adjacency.opposite(IM::Triangle_index(t), std::uint32_t(c));
      if(o != IM::no_halfedge && label[o / 3] == std::uint32_t(-1)) {
        label[o / 3] = label[t];
        front.push_back(o / 3);
        is_done = false;
        break;
      }
    }
    if(is_done)
      front.erase(std::find(front.begin(), front.end(), t));
  }
  return SMT::cut_to_disks(mesh, SMT::charts_of_labels(mesh.triangles, label));
}

// What is wrong with smooth seams of a mesh and charts.
std::string error_in(const SMT::Smooth_seams_result& result, const Indexed_triangle_mesh& mesh,
                     const SMT::Face_charts& charts)
{
  if(!result.is_ok())
    return result.error;
  const std::size_t n = mesh.points.size(), new_vertices = result.new_vertices.size();
  if(!IM::manifold_error(result.mesh).empty())
    return IM::manifold_error(result.mesh);
  if(!SMT::charts_error(result.mesh, result.charts).is_ok())
    return SMT::charts_error(result.mesh, result.charts).error;
  if(result.charts.number_of_charts != charts.number_of_charts)
    return "another number of charts";
  if(!error_in_charts(result.mesh, result.charts).empty())
    return error_in_charts(result.mesh, result.charts);
  if(result.mesh.points.size() != n + new_vertices
     || !std::equal(mesh.points.begin(), mesh.points.end(), result.mesh.points.begin()))
    return "other vertices";
  // Pieces lie in their triangle, whose area they have, and have its orientation
  if(!std::is_sorted(result.triangle.begin(), result.triangle.end()))
    return "another order of triangles";
  std::vector<double> pieces(mesh.triangles.size(), 0.);
  for(std::size_t t = 0; t < result.triangle.size(); ++t) {
    const auto& source = mesh.triangles[result.triangle[t]];
    pieces[result.triangle[t]] += area(result.mesh, t);
    for(const Vertex_index v : result.mesh.triangles[t]) {
      const auto has = [&source](Vertex_index w) {
        return std::find(source.begin(), source.end(), w) != source.end();
      };
      if(v < n ? !has(v) : !has(result.new_vertices[v - n].from) || !has(result.new_vertices[v - n].to))
        return "a piece has a vertex that is not on its triangle";
    }
  }
  for(std::size_t t = 0; t < pieces.size(); ++t)
    if(std::abs(pieces[t] - area(mesh, t)) > 1e-9 * area(mesh, t))
      return "the pieces of triangle " + std::to_string(t) + " have another area";
  for(std::size_t i = 0; i < new_vertices; ++i) {
    const SMT::Edge_vertex& v = result.new_vertices[i];
    const auto &p = mesh.points[v.from], &q = mesh.points[v.to];
    if(!(v.part > 0. && v.part < 1.)
       || std::sqrt(CGAL::squared_distance(p + v.part * (q - p), result.mesh.points[n + i]))
            > 1e-12 * std::sqrt(CGAL::squared_distance(p, q)))
      return "a new vertex is not on its edge";
  }
  std::vector<int> seams(result.mesh.points.size(), 0);
  for(std::size_t t = 0; t < result.triangle.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(result.charts.is_seam(t, c))
        for(const int end : {c, (c + 1) % 3})
          ++seams[result.mesh.triangles[t][end]];
  for(std::size_t v = n; v < seams.size(); ++v)
    if(seams[v] != 4) // two edges, each seen from both sides
      return "a new vertex is not on one seam";
  if(seam_length(result.mesh, result.charts) > (1. + 1e-9) * seam_length(mesh, charts))
    return "longer seams";
  return {};
}

std::vector<Named_mesh> surfaces()
{
  std::vector<Named_mesh> result = {{"plane", irregular_grid(25, 25, seed)}, {"torus", torus(40, 20)}};
  if(is_sanitized)
    return result;
  result.push_back({"hills", with_noise(with_hills(irregular_grid(40, 30, seed), 8., seed), 0.2, seed)});
  result.push_back({"sphere", sphere(4)});
  result.push_back({"holes", with_holes(on_sphere(round_disk(18), 2.), 6, seed)});
  result.push_back({"slivers", with_slivers(irregular_grid(20, 20, seed), 1e-3)});
  return result;
}

TEST(Smooth_seams, surface_and_charts_stay_and_seams_are_shorter)
{
  Random random(seed);
  for(const Named_mesh& surface : surfaces()) {
    double before = 0., after = 0.;
    for(int i = 0; i < (is_sanitized ? 2 : 20); ++i) {
      const SMT::Face_charts charts = random_charts(surface.mesh, 2 + uniform_index(random, 12), random);
      SMT::Smooth_seams_options options;
      options.rings = 1 + int(uniform_index(random, 6));
      options.crease_angle = i % 2 == 0 ? 30. : 180.; // no edge is a crease then
      options.pinned_defect = i % 3 == 0 ? 25. : 360.;
      const auto result = SMT::smooth_seams(surface.mesh, charts, options);
      ASSERT_EQ(error_in(result, surface.mesh, charts), "") << surface.name << " " << i << seed_text;
      before += seam_length(surface.mesh, charts);
      after += seam_length(result.mesh, result.charts);
    }
    EXPECT_LT(after, 0.97 * before) << surface.name << seed_text;
  }
}

// A ragged seam from side to side of a plane becomes straight if it may move far enough.
TEST(Smooth_seams, are_straight_in_the_plane)
{
  const Indexed_triangle_mesh mesh = irregular_grid(40, 20, seed);
  std::vector<std::uint32_t> label;
  for(const auto& t : mesh.triangles) {
    const Point_3 c = CGAL::centroid(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    label.push_back(c.x() < 19.3 + 0.35 * c.y() ? 0 : 1);
  }
  const SMT::Face_charts charts = SMT::charts_of_labels(mesh.triangles, label);
  ASSERT_EQ(charts.number_of_charts, 2u) << seed_text;
  const auto smooth = SMT::smooth_seams(mesh, charts);
  ASSERT_EQ(error_in(smooth, mesh, charts), "") << seed_text;
  std::vector<Point_3> ends;
  const std::vector<bool> is_on_border = border_vertices_of(mesh);
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = mesh.triangles[t][c], w = mesh.triangles[t][(c + 1) % 3];
      if(charts.is_seam(t, c) && is_on_border[v] != is_on_border[w])
        ends.push_back(mesh.points[is_on_border[v] ? v : w]);
    }
  ASSERT_EQ(ends.size(), 4u) << seed_text; // each seen from both sides
  const double straight = std::sqrt((std::max)({CGAL::squared_distance(ends[0], ends[1]),
                                                CGAL::squared_distance(ends[0], ends[2]),
                                                CGAL::squared_distance(ends[0], ends[3])}));
  EXPECT_GT(seam_length(mesh, charts), 1.1 * straight) << seed_text;
  EXPECT_LT(seam_length(smooth.mesh, smooth.charts), 1.003 * straight) << seed_text;
  EXPECT_GE(seam_length(smooth.mesh, smooth.charts), (1. - 1e-12) * straight) << seed_text;
  SMT::Smooth_seams_options still;
  still.rings = 0;
  const auto same = SMT::smooth_seams(mesh, charts, still);
  EXPECT_EQ(same.mesh.triangles, mesh.triangles);
  EXPECT_EQ(same.charts.seams, charts.seams);
}

TEST(Smooth_seams, bad_input_is_named)
{
  const Indexed_triangle_mesh mesh = grid(5, 5);
  SMT::Face_charts charts = SMT::charts_of_labels(
    mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0));
  SMT::Smooth_seams_options options;
  options.rings = -1;
  EXPECT_NE(SMT::smooth_seams(mesh, charts, options).error.find("rings"), std::string::npos);
  charts.seams.pop_back();
  EXPECT_NE(SMT::smooth_seams(mesh, charts).error.find("the charts have seams for"), std::string::npos);
  Indexed_triangle_mesh bad = mesh;
  bad.triangles[3][1] = 1000;
  EXPECT_NE(SMT::smooth_seams(bad, charts).error, "");
}

TEST(Smooth_seams, an_atlas_has_them)
{
  std::vector<Named_mesh> all = {{"torus", torus(24, 12)}};
  for(std::uint64_t s = seed; s < seed + (is_sanitized ? 0 : 3); ++s)
    all.push_back({"hills", with_noise(with_hills(irregular_grid(40, 30, s), 8., s), 0.2, s)});
  constexpr double smooth_already = 1.05; // of jaggedness: such seams may only become shorter
  double less_jagged = 0.;
  for(const Named_mesh& surface : all) {
    SMT::Texture_atlas_options options;
    options.packing.width = options.packing.height = 256;
    options.coarse_faces = 500;
    options.bound.area_scale = 1.5;
    options.may_stretch = false; // one chart would have no seams
    const auto found = SMT::Chart_growth_segmenter()(surface.mesh, options);
    ASSERT_EQ(found.error, "") << surface.name << seed_text;
    const SMT::Given_charts_segmenter segmenter(found.charts); // the same charts for both
    const auto plain = SMT::build_texture_atlas<>(surface.mesh, options, segmenter);
    options.has_smooth_seams = true;
    options.density.assign(surface.mesh.triangles.size(), 1.f);
    const auto smooth = SMT::build_texture_atlas<>(surface.mesh, options, segmenter);
    ASSERT_EQ(plain.error + smooth.error, "") << surface.name << seed_text;
    const SMT::Texture_atlas& atlas = smooth.atlas;
    const Indexed_triangle_mesh mesh = {atlas.mesh.points, atlas.mesh.triangles};
    EXPECT_EQ(error_in_atlas(mesh, atlas), "") << surface.name << seed_text;
    EXPECT_EQ(IM::manifold_error(mesh), "") << surface.name << seed_text;
    EXPECT_EQ(smooth.report.charts.size(), plain.report.charts.size()) << surface.name << seed_text;
    EXPECT_LT(smooth.report.seam_length, plain.report.seam_length) << surface.name << seed_text;
    EXPECT_LT(smooth.report.seams.jaggedness,
              (std::max)(plain.report.seams.jaggedness, smooth_already))
      << surface.name << seed_text;
    less_jagged += plain.report.seams.jaggedness - smooth.report.seams.jaggedness;
    EXPECT_EQ(mesh.points.size(), surface.mesh.points.size() + atlas.new_vertices.size());
    ASSERT_EQ(atlas.source_triangle.size(), mesh.triangles.size());
    EXPECT_EQ(atlas.source_triangle.back(), surface.mesh.triangles.size() - 1);
    EXPECT_TRUE(plain.atlas.source_triangle.empty());
  }
  EXPECT_GT(less_jagged, 0.) << seed_text;
  SMT::Texture_atlas_options options;
  options.has_smooth_seams = true;
  Surface_mesh graph = to_surface_mesh(grid(5, 5));
  typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
  auto uv = graph.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;
  auto chart = graph.add_property_map<Surface_mesh::Face_index, std::size_t>("f:chart").first;
  EXPECT_NE(SMT::build_texture_atlas(graph, uv, chart, options).error.find("through triangles"),
            std::string::npos);
  options.no_seams.assign(grid(5, 5).triangles.size(), 0);
  EXPECT_NE(SMT::build_texture_atlas(grid(5, 5), options).error.find("through triangles"),
            std::string::npos);
}

// A long strip is one chart, which is cut across to fill the page.
TEST(Smooth_seams, cuts_that_fill_the_page_are_smooth)
{
  const Indexed_triangle_mesh strip
    = with_noise(with_hills(irregular_grid(120, 15, seed), 3., seed), 0.2, seed);
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 256;
  const auto plain = SMT::build_texture_atlas(strip, options);
  options.has_smooth_seams = true;
  const auto smooth = SMT::build_texture_atlas(strip, options);
  ASSERT_EQ(plain.error + smooth.error, "") << seed_text;
  const Indexed_triangle_mesh mesh = {smooth.atlas.mesh.points, smooth.atlas.mesh.triangles};
  EXPECT_EQ(error_in_atlas(mesh, smooth.atlas), "") << seed_text;
  EXPECT_GT(plain.report.page_cuts, 0u) << seed_text;
  EXPECT_EQ(smooth.report.page_cuts, plain.report.page_cuts) << seed_text;
  EXPECT_EQ(smooth.report.charts.size(), plain.report.charts.size()) << seed_text;
  EXPECT_LT(smooth.report.seams.jaggedness, plain.report.seams.jaggedness) << seed_text;
  EXPECT_LT(smooth.report.seams.jaggedness, 1.02) << seed_text;
  EXPECT_GT(smooth.report.utilisation, 0.97 * plain.report.utilisation) << seed_text;
}

} // namespace smooth_seams_test
