// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cuts through a chart, the maps of its parts, and when charts are packed once more.

#include <support/chart_generators.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Filled_packing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace chart_cuts_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

// The cuts of a strip that is flat in its map, 40 x 10, and on the surface folded along a line across it.
std::vector<SMT::internal::Chart_cut> cuts_of_folded(double fold, double angle, double noise,
                                                     SMT::internal::Mapped_chart& map)
{
  const Indexed_triangle_mesh flat = grid(40, 10);
  const Indexed_triangle_mesh folded = with_noise(moved(flat, [=](const Point_3& p) {
    const double beyond = (std::max)(0., p.x() - fold);
    return Point_3(p.x() - beyond * (1. - std::cos(angle)), p.y(), beyond * std::sin(angle));
  }), noise, 41);
  map.chart = SMT::chart_meshes(folded, SMT::charts_of_labels(
    folded.triangles, std::vector<std::uint32_t>(folded.triangles.size(), 0)))[0];
  map.uv.clear();
  for(const Vertex_index v : map.chart.vertices)
    map.uv.emplace_back(flat.points[v].x(), flat.points[v].y());
  map.report.distortion = SMT::measure_chart_distortion(map.chart.mesh, map.uv);
  return SMT::internal::Chart_cut_finder(map, {}, 1.).find();
}

// Cuts run along creases near to them, of which only a part counts. What is no sharper than the rest is no
// crease.
TEST(Chart_cuts, run_along_creases)
{
  constexpr double right = 1.5707963267948966;
  std::vector<double> on_folds;
  for(const auto& [angle, noise] :
      {std::pair<double, double>{0., 0.}, {0.3, 0.3}, {right, 0.}, {right, 0.02}}) {
    on_folds.push_back(0.);
    for(double fold = 5.; fold <= 35.; fold += 1.) {
      SMT::internal::Mapped_chart map;
      const auto cuts = cuts_of_folded(fold, angle, noise, map);
      ASSERT_FALSE(cuts.empty()) << angle;
      for(const SMT::internal::Chart_cut& cut : cuts) {
        double length = 0., on_fold = 0.;
        for(std::size_t i = 0; i + 1 < cut.path.size(); ++i) {
          const auto &p = map.uv[cut.path[i]], &q = map.uv[cut.path[i + 1]];
          const double edge = std::sqrt(CGAL::squared_distance(p, q));
          length += edge;
          on_fold += p.x() == fold && q.x() == fold ? edge : 0.;
        }
        // By the weights of right angles
        const double less = angle == right ? 1. - SMT::Crease_weights().crease_length : 0.;
        EXPECT_NEAR(cut.length, length - less * on_fold, 1e-6 * length) << angle << ", " << noise;
        on_folds.back() += on_fold;
      }
    }
  }
  for(int i = 0; i < 2; ++i)
    for(int k = 2; k < 4; ++k)
      EXPECT_GT(on_folds[k], 1.5 * on_folds[i]);
}

// A cut through a grid from border to border has on its left what is left of it, and the map of each side is
// scaled to the density of the whole.
TEST(Chart_cuts, the_sides_of_a_cut)
{
  const Vertex_index n = 12;
  SMT::internal::Mapped_chart whole;
  const Indexed_triangle_mesh& mesh = whole.chart.mesh = grid(n, n);
  for(const Point_3& p : mesh.points) // denser on the right
    whole.uv.emplace_back(p.x() * (1. + 0.3 * p.x()), 2. * p.y());
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  const auto vertex = [&](double x, double y) {
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      if(mesh.points[v].x() == x && mesh.points[v].y() == y)
        return v;
    return Vertex_index(-1);
  };
  const double width = mesh.points.back().x();
  const double density = 2. * (1. + 0.3 * width); // the area in the plane to that on the surface
  for(int at = 1; at < int(width); ++at) {
    SMT::internal::Chart_cut cut;
    for(int y = 0; y <= int(width); ++y) // upwards
      cut.path.push_back(vertex(at, y));
    const SMT::internal::Cut_sides sides = SMT::internal::sides_of(cut, whole, adjacency);
    ASSERT_TRUE(sides.are_valid()) << at;
    EXPECT_NEAR(sides.density, density, 1e-12 * density) << at;
    const double left = 2. * (1. + 0.3 * at); // the areas of strips
    const double right = (density * width - left * at) / (width - at);
    EXPECT_NEAR(sides.scale[1] * sides.scale[1] * left, density, 1e-12 * density) << at;
    EXPECT_NEAR(sides.scale[0] * sides.scale[0] * right, density, 1e-12 * density) << at;
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      double x = 0.;
      for(const Vertex_index v : mesh.triangles[t])
        x += mesh.points[v].x() / 3.;
      const auto& side = sides.triangles[x < at ? 1 : 0];
      EXPECT_TRUE(std::binary_search(side.begin(), side.end(), t)) << at << ", " << t;
    }
    EXPECT_EQ(sides.triangles[0].size() + sides.triangles[1].size(), mesh.triangles.size()) << at;
  }
}

// What a coarse mesh tells spares the map of the fine one, and more charts than may be are not mapped.
TEST(Chart_cuts, large_charts_are_mapped_only_if_there_is_hope)
{
  std::size_t large_maps = 0;
  SMT::internal::Chart_mapping mapping;
  mapping.parameterize = [&large_maps](const Indexed_triangle_mesh& chart) {
    large_maps += chart.triangles.size() > 50000 ? 1 : 0;
    return SMT::Border_first_chart_parameterizer()(chart);
  };
  const auto charts_of = [&mapping](const Indexed_triangle_mesh& mesh) {
    return SMT::internal::map_anew(SMT::chart_meshes(mesh, SMT::charts_of_labels(
      mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0)))[0], mapping);
  };
  const Indexed_triangle_mesh flat = grid(170, 170), cap = on_sphere(round_disk(100), 2.8);
  ASSERT_GT(cap.triangles.size(), 50000u);
  EXPECT_EQ(charts_of(flat).size(), 1u);
  EXPECT_EQ(large_maps, 1u);
  const auto parts = charts_of(cap);
  EXPECT_GT(parts.size(), 1u);
  std::size_t faces = 0;
  for(const auto& part : parts) {
    EXPECT_TRUE(part.is_valid);
    faces += part.chart.triangles.size();
  }
  EXPECT_EQ(faces, cap.triangles.size());
  EXPECT_EQ(large_maps, 1u);
  mapping.most_charts = parts.size() - 1;
  EXPECT_TRUE(charts_of(cap).empty());
  mapping.most_charts = parts.size();
  EXPECT_EQ(charts_of(cap).size(), parts.size());
  // What needs little stretch is not mapped conformally before, what does not need it is
  mapping.may_stretch = true;
  EXPECT_EQ(charts_of(flat).size(), 1u);
  EXPECT_EQ(large_maps, 2u);
  const auto stretched = charts_of(on_sphere(round_disk(100), 1.9));
  ASSERT_EQ(stretched.size(), 1u);
  EXPECT_TRUE(stretched[0].is_valid && stretched[0].report.distortion.is_within(mapping.bound));
  EXPECT_EQ(large_maps, 2u);
}

SMT::Packing_result packing_that_uses(double part, std::size_t charts)
{
  SMT::Packing_result result;
  result.pages = 1;
  result.placements.resize(charts);
  result.utilisation = part;
  return result;
}

// Where charts bend in vain a packing is searched for longer, and the best of all is taken. Here a usual
// packing uses 0.6 of the page and a longer search 0.7, and bending adds what it is said to.
TEST(Filled_packing, is_searched_for_longer_where_charts_bend_in_vain)
{
  struct Case
  {
    double usual_gain, close_gain; // by bending
    double used;
    std::size_t searched_for_longer;
  };
  SMT::Texture_atlas_options options;
  options.seam_price = std::numeric_limits<double>::infinity();
  options.min_used = 0.9;
  options.max_charts = 1; // no cuts
  const SMT::internal::Chart_mapping mapping;
  for(const Case& c : {Case{0.35, 0., 0.95, 0}, {0.25, 0., 0.85, 1}, {0.22, 0.15, 0.85, 1},
                       {0.21, 0.25, 0.95, 1}, {0.19, 0.25, 0.79, 0}}) { // the last one misses too much
    std::size_t longer = 0;
    const SMT::internal::Filled_packing::Pack pack
      = [&](const std::vector<SMT::Chart_shape>& shapes, const SMT::Packing_options& packing) {
          longer += packing.time_budget > 0. ? 1 : 0;
          return packing_that_uses(packing.time_budget > 0. ? 0.7 : 0.6, shapes.size());
        };
    const SMT::internal::Filled_packing::Bend bend
      = [&](std::vector<SMT::internal::Mapped_chart>&, SMT::Packing_result& packing, double, bool) {
          const bool is_close = longer > 0;
          packing.utilisation = is_close ? 0.7 + c.close_gain : 0.6 + c.usual_gain;
          return 0.;
        };
    std::vector<SMT::internal::Mapped_chart> charts(1);
    cuts_of_folded(20., 0., 0., charts[0]);
    SMT::internal::Filled_packing filled(options, options.packing, mapping, pack, bend, charts);
    EXPECT_DOUBLE_EQ(filled.run(true).utilisation, c.used);
    EXPECT_EQ(longer, c.searched_for_longer) << c.used;
    EXPECT_EQ(filled.why_not_used().empty(), c.used >= options.min_used) << c.used;
  }
}

// Charts that do not bend, or fill little of the pages, get a packing that is no draft, if it is denser then.
TEST(Filled_packing, is_no_draft_where_charts_do_not_bend_or_little_is_used)
{
  struct Case
  {
    double gain, in_full; // of bending a draft of 0.6; what a search in full finds
    double used;
    std::size_t searched_in_full;
  };
  SMT::Texture_atlas_options options;
  options.seam_price = std::numeric_limits<double>::infinity();
  const SMT::internal::Chart_mapping mapping;
  for(const bool is_draft : {true, false})
    for(const Case& c : {Case{0.2, 0.7, 0.8, 0}, {0., 0.7, 0.7, 1}, {0., 0.5, 0.6, 1}, {0.01, 0.7, 0.71, 1},
                         {0.01, 0.5, 0.61, 1}}) {
      options.packing.is_draft = is_draft;
      std::size_t in_full = 0;
      const SMT::internal::Filled_packing::Pack pack
        = [&](const std::vector<SMT::Chart_shape>& shapes, const SMT::Packing_options& packing) {
            const bool is_in_full = is_draft && !packing.is_draft;
            in_full += is_in_full ? 1 : 0;
            return packing_that_uses(is_in_full ? c.in_full : 0.6, shapes.size());
          };
      const SMT::internal::Filled_packing::Bend bend
        = [&](std::vector<SMT::internal::Mapped_chart>&, SMT::Packing_result& packing, double, bool) {
            packing.utilisation += c.gain;
            return 0.;
          };
      std::vector<SMT::internal::Mapped_chart> charts(1);
      cuts_of_folded(20., 0., 0., charts[0]);
      SMT::internal::Filled_packing filled(options, options.packing, mapping, pack, bend, charts);
      EXPECT_DOUBLE_EQ(filled.run(true).utilisation, is_draft ? c.used : 0.6 + c.gain);
      EXPECT_EQ(in_full, is_draft ? c.searched_in_full : 0u);
    }
}

// What is asked for is enough, however little the last bend added.
TEST(Filled_packing, is_bent_no_more_once_enough_is_used)
{
  SMT::Texture_atlas_options options;
  options.seam_price = std::numeric_limits<double>::infinity();
  options.min_used = 0.6505;
  const SMT::internal::Chart_mapping mapping;
  const SMT::internal::Filled_packing::Pack pack
    = [](const std::vector<SMT::Chart_shape>& shapes, const SMT::Packing_options&) {
        return packing_that_uses(0.6, shapes.size());
      };
  std::size_t bends = 0;
  const SMT::internal::Filled_packing::Bend bend
    = [&](std::vector<SMT::internal::Mapped_chart>&, SMT::Packing_result& packing, double, bool) {
        packing.utilisation += bends++ == 0 ? 0.05 : 0.0008;
        return 0.;
      };
  std::vector<SMT::internal::Mapped_chart> charts(1);
  cuts_of_folded(20., 0., 0., charts[0]);
  SMT::internal::Filled_packing filled(options, options.packing, mapping, pack, bend, charts);
  EXPECT_DOUBLE_EQ(filled.run(true).utilisation, 0.6508);
  EXPECT_EQ(bends, 2u);
}

// However much is asked for, charts are bent for so long only; with more time for packing, for longer.
TEST(Filled_packing, ends_when_charts_have_been_bent_for_long)
{
  SMT::Texture_atlas_options options;
  options.seam_price = std::numeric_limits<double>::infinity();
  options.min_used = 0.9;
  options.max_charts = 1; // no cuts
  const SMT::internal::Chart_mapping mapping;
  const SMT::internal::Filled_packing::Pack pack
    = [](const std::vector<SMT::Chart_shape>& shapes, const SMT::Packing_options&) {
        return packing_that_uses(0.6, shapes.size());
      };
  for(const double seconds : {0., 50.}) {
    std::size_t bends = 0;
    const SMT::internal::Filled_packing::Bend bend
      = [&](std::vector<SMT::internal::Mapped_chart>&, SMT::Packing_result& packing, double, bool) {
          packing.utilisation += 0.002;
          ++bends;
          return 1e6;
        };
    options.packing.time_budget = seconds;
    std::vector<SMT::internal::Mapped_chart> charts(1);
    cuts_of_folded(20., 0., 0., charts[0]);
    SMT::internal::Filled_packing filled(options, options.packing, mapping, pack, bend, charts);
    const double used = filled.run(true).utilisation;
    EXPECT_NEAR(used, 0.6 + 0.002 * double(bends), 1e-9);
    EXPECT_EQ(bends, seconds > 0. ? 5u : 3u);
    EXPECT_NE(filled.why_not_used().find("more time for packing"), std::string::npos) << filled.why_not_used();
  }
}

// Where no part of the pages is asked for, charts of larger pages are bent in finer detail, as the root of the
// side, and once more in the coarsest one if that does not help.
TEST(Filled_packing, bends_in_finer_detail_on_larger_pages)
{
  struct Case
  {
    std::size_t width, height;
    bool helps; // the finest detail
    std::vector<double> finenesses;
  };
  SMT::Texture_atlas_options options;
  options.seam_price = std::numeric_limits<double>::infinity();
  const SMT::internal::Chart_mapping mapping;
  const SMT::internal::Filled_packing::Pack pack
    = [](const std::vector<SMT::Chart_shape>& shapes, const SMT::Packing_options&) {
        return packing_that_uses(0.6, shapes.size());
      };
  for(const Case& c : {Case{512, 512, true, {1.}}, {1024, 256, false, {1.}}, {4096, 1024, true, {2.}},
                       {4096, 4096, false, {2., 1.}}, {512, 2048, false, {std::sqrt(2.), 1.}},
                       {65536, 65536, true, {4.}}}) {
    std::vector<double> finenesses;
    const SMT::internal::Filled_packing::Bend bend
      = [&](std::vector<SMT::internal::Mapped_chart>&, SMT::Packing_result& packing, double fineness, bool) {
          finenesses.push_back(fineness);
          packing.utilisation += c.helps || finenesses.size() > 1 ? 0.1 : 0.;
          return 0.;
        };
    SMT::Packing_options pages = options.packing;
    pages.width = c.width;
    pages.height = c.height;
    std::vector<SMT::internal::Mapped_chart> charts(1);
    SMT::internal::Filled_packing filled(options, pages, mapping, pack, bend, charts);
    const double used = filled.run(true).utilisation;
    EXPECT_DOUBLE_EQ(used, finenesses.size() == 2 || c.helps ? 0.7 : 0.6);
    EXPECT_EQ(finenesses, c.finenesses) << c.width << " x " << c.height;
  }
}

} // namespace chart_cuts_test
