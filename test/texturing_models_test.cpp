// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of the concepts of texturing that users may write, and the least that a model may have.

#include <support/chart_generators.h>
#include <support/texture_atlas_properties.h>
#include <support/textured_meshes.h>
#include <support/texturing_options.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace texturing_models_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;

// What has nothing but what a concept asks for: it is neither made without arguments nor copied.
class Archetype
{
public:
  explicit Archetype(int) {}
  Archetype(const Archetype&) = delete;
  Archetype& operator=(const Archetype&) = delete;
};

// Charts of the octants of space.
class Octant_segmenter : Archetype
{
public:
  typedef CGAL::Tag_true Is_bounded;
  typedef CGAL::Tag_true Is_for_any_mesh;
  using Archetype::Archetype;
  SMT::Segmentation_result operator()(const Indexed_triangle_mesh& mesh,
                                      const SMT::Texture_atlas_options&) const
  {
    std::vector<std::uint32_t> label;
    for(const Triangle_indices& t : mesh.triangles) {
      const Point_3& p = mesh.points[t[0]];
      label.push_back((p.x() > 0. ? 1 : 0) + (p.y() > 0. ? 2 : 0) + (p.z() > 0. ? 4 : 0));
    }
    SMT::Segmentation_result result;
    result.charts = SMT::charts_of_labels(mesh.triangles, label);
    return result;
  }
};

// The projection along the mean normal.
class Projecting_parameterizer : Archetype
{
public:
  using Archetype::Archetype;
  std::vector<Point_2> operator()(const Indexed_triangle_mesh& chart) const
  {
    SMT::Vector_3 n(0., 0., 0.);
    for(const Triangle_indices& t : chart.triangles)
      n = n + CGAL::cross_product(chart.points[t[1]] - chart.points[t[0]],
                                  chart.points[t[2]] - chart.points[t[0]]);
    const SMT::Vector_3 axis = std::abs(n.x()) <= std::abs(n.y()) ? SMT::Vector_3(1., 0., 0.)
                                                                  : SMT::Vector_3(0., 1., 0.);
    const SMT::Vector_3 v = CGAL::cross_product(n, axis) / std::sqrt(n * n);
    const SMT::Vector_3 u = CGAL::cross_product(v, n) / std::sqrt(n * n);
    std::vector<Point_2> result;
    for(const Point_3& p : chart.points)
      result.emplace_back(u * (p - CGAL::ORIGIN), v * (p - CGAL::ORIGIN));
    return result;
  }
};

// Charts in the cells of a square of cells.
class Cell_packer : Archetype
{
public:
  using Archetype::Archetype;
  SMT::Packing_result operator()(const std::vector<SMT::Chart_shape>& charts,
                                 const SMT::Packing_options& options) const
  {
    const std::size_t cells = std::size_t(std::ceil(std::sqrt(double(charts.size()))));
    const double cell = double((std::min)(options.width, options.height) / cells);
    const double room = cell - double(options.padding) - 2.;
    std::vector<CGAL::Bbox_2> boxes;
    double largest = 0.;
    for(const SMT::Chart_shape& chart : charts) {
      boxes.push_back(CGAL::bbox_2(chart.uv.begin(), chart.uv.end()));
      largest = (std::max)({largest, boxes.back().x_span(), boxes.back().y_span()});
    }
    SMT::Packing_result result;
    result.pages = 1;
    result.texels_per_unit = room / largest;
    for(std::size_t i = 0; i < charts.size(); ++i) {
      SMT::Chart_placement place;
      place.scale = result.texels_per_unit;
      const double corner = 1. + 0.5 * double(options.padding);
      place.offset = Point_2(corner + cell * double(i % cells) - place.scale * boxes[i].xmin(),
                             corner + cell * double(i / cells) - place.scale * boxes[i].ymin());
      result.placements.push_back(place);
    }
    return result;
  }
};

TEST(Texturing_models, models_of_the_user_build_an_atlas)
{
  const Indexed_triangle_mesh mesh = sphere(3);
  const Octant_segmenter segmenter(0);
  const Projecting_parameterizer parameterizer(0);
  const Cell_packer packer(0);
  SMT::Texture_atlas_options options = small_texture();
  options.bound.quasi_conformal = 3.; // an octant reaches 55 degrees from its centre
  options.seam_price = std::numeric_limits<double>::infinity(); // charts stay as they are
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(mesh, options, segmenter, parameterizer, packer);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "");
  EXPECT_GE(result.report.charts.size(), 8u); // triangles across a plane may be alone
  EXPECT_EQ(result.report.recut_charts, 0u);
  EXPECT_EQ(result.atlas.charts.chart, segmenter(mesh, options).charts.chart);
}

TEST(Texturing_models, each_model_goes_with_the_defaults)
{
  const Indexed_triangle_mesh mesh = sphere(3);
  const auto expect_atlas = [&mesh](const SMT::Texture_atlas_result& result) {
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(error_in_atlas(mesh, result.atlas), "");
  };
  const CGAL::Default none;
  const SMT::Texture_atlas_options options = small_texture();
  const Octant_segmenter segmenter(0);
  const Projecting_parameterizer parameterizer(0);
  const Cell_packer packer(0);
  expect_atlas(SMT::build_texture_atlas(mesh, options, segmenter));
  expect_atlas(SMT::build_texture_atlas(mesh, options, none, parameterizer));
  expect_atlas(SMT::build_texture_atlas(mesh, options, none, none, packer));
  expect_atlas(SMT::build_texture_atlas(mesh, options, SMT::Component_segmenter()));
  expect_atlas(SMT::build_texture_atlas(mesh, options, none, none, SMT::Horizon_packer()));
  expect_atlas(SMT::build_texture_atlas<CGAL::Sequential_tag>(mesh, options));
}

// 20,480 triangles, for which the segmenter is first tried on a level of 1,000
TEST(Texturing_models, a_segmenter_of_the_user_is_tried_on_a_coarser_level)
{
  const Indexed_triangle_mesh mesh = sphere(5);
  SMT::Texture_atlas_options options = small_texture();
  options.trial_faces = 1000;
  const SMT::Texture_atlas_result result
    = SMT::build_texture_atlas(mesh, options, Octant_segmenter(0));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "");
}

TEST(Texturing_models, the_default_is_what_its_name_says)
{
  const Indexed_triangle_mesh mesh = torus(30, 15);
  const SMT::Texture_atlas one = SMT::build_texture_atlas(mesh, small_texture()).atlas;
  const SMT::Texture_atlas other
    = SMT::build_texture_atlas(mesh, small_texture(), SMT::Chart_growth_segmenter(),
                               SMT::Border_first_chart_parameterizer(), SMT::Raster_packer())
        .atlas;
  EXPECT_EQ(one.charts.seams, other.charts.seams);
  ASSERT_EQ(one.mesh.uv.size(), other.mesh.uv.size());
  EXPECT_EQ(std::memcmp(one.mesh.uv.data(), other.mesh.uv.data(),
                        one.mesh.uv.size() * sizeof(one.mesh.uv[0])), 0);
}

// A parameterizer that fails: charts are cut until they are single triangles.
TEST(Texturing_models, an_atlas_of_single_triangles_if_no_map_is_any_good)
{
  const Indexed_triangle_mesh mesh = grid(4, 4);
  for(const std::size_t kind : {0, 1, 2}) {
    const auto parameterizer = [kind](const Indexed_triangle_mesh& chart) {
      std::vector<Point_2> uv(chart.points.size(), Point_2(0., 0.));
      if(kind == 0)
        uv.clear(); // there is none
      if(kind == 1)
        uv.pop_back(); // not as many
      return uv;       // a point, and no more
    };
    const SMT::Texture_atlas_result result
      = SMT::build_texture_atlas(mesh, small_texture(), CGAL::Default(), parameterizer);
    ASSERT_EQ(result.error, "") << kind;
    EXPECT_EQ(result.report.charts.size(), mesh.triangles.size()) << kind;
  }
}

TEST(Texturing_models, models_of_the_user_that_are_wrong_give_a_sentence)
{
  const Indexed_triangle_mesh mesh = grid(4, 4);
  const CGAL::Default none;
  const auto no_places = [](const auto&, const SMT::Packing_options&) {
    return SMT::Packing_result();
  };
  const auto no_page = [](const std::vector<SMT::Chart_shape>& charts,
                          const SMT::Packing_options&) {
    SMT::Packing_result result;
    result.placements.resize(charts.size());
    return result;
  };
  const auto sentence_only = [](const auto&, const SMT::Packing_options&) {
    SMT::Packing_result result;
    result.error = "there is no room";
    return result;
  };
  for(const SMT::Texture_atlas_result& result :
      {SMT::build_texture_atlas(mesh, small_texture(), none, none, no_places),
       SMT::build_texture_atlas(mesh, small_texture(), none, none, no_page),
       SMT::build_texture_atlas(mesh, small_texture(), none, none, sentence_only)}) {
    EXPECT_NE(result.error, "");
    EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::FAILED);
  }
}

// A ray caster that tries all triangles.
class Brute_force_ray_caster : Archetype
{
public:
  Brute_force_ray_caster(const std::vector<Point_3>& points,
                         const std::vector<Triangle_indices>& triangles)
    : Archetype(0), m_points(points), m_triangles(triangles)
  {}
  std::string error() const { return {}; }
  SMT::Ray_hit cast(const Point_3& origin, const SMT::Vector_3& direction, double nearest,
                    double farthest) const
  {
    SMT::Ray_hit first;
    for(std::uint32_t t = 0; t < m_triangles.size(); ++t) {
      const Point_3& a = m_points[m_triangles[t][0]];
      const SMT::Vector_3 ab = m_points[m_triangles[t][1]] - a, ac = m_points[m_triangles[t][2]] - a;
      const SMT::Vector_3 n = CGAL::cross_product(ab, ac), to_a = a - origin;
      const double distance = (to_a * n) / (direction * n);
      const SMT::Vector_3 p = distance * direction - to_a;
      const double v = (CGAL::cross_product(p, ac) * n) / (n * n);
      const double w = (CGAL::cross_product(ab, p) * n) / (n * n);
      if(v >= -1e-12 && w >= -1e-12 && v + w <= 1. + 1e-12 && distance >= nearest
         && distance <= farthest && distance < first.distance) {
        first.point.triangle = t;
        first.point.weights = {1. - v - w, v, w};
        first.distance = distance;
      }
    }
    return first;
  }

private:
  const std::vector<Point_3>& m_points;
  const std::vector<Triangle_indices>& m_triangles;
};

TEST(Texturing_models, a_ray_caster_of_the_user)
{
  const Indexed_triangle_mesh fine = with_hills(grid(8, 8), 0.2, 7);
  const Textured_triangle_mesh light = textured(grid(8, 8), [](std::size_t, Vertex_index v) {
    return Point_2(double(v % 9) / 8., double(v / 9) / 8.);
  });
  const SMT::Baking_by_rays_options options = small_image();
  const SMT::Baked_map map
    = SMT::bake_normal_map_by_rays<Brute_force_ray_caster>(fine, light, options);
  const SMT::Baked_map expected
    = SMT::bake_normal_map_by_rays<SMT::AABB_tree_ray_caster>(fine, light, options);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_samples_without, expected.number_of_samples_without);
  ASSERT_EQ(map.image.texels.size(), expected.image.texels.size());
  for(std::size_t i = 0; i < map.image.texels.size(); ++i)
    EXPECT_NEAR(map.image.texels[i], expected.image.texels[i], 1e-6);
}

// The triangle of the light model, whatever the fine surface; and its number.
class Same_triangle : Archetype
{
public:
  using Archetype::Archetype;
  void find(std::size_t, std::vector<SMT::Baking_sample>& samples) const
  {
    for(SMT::Baking_sample& sample : samples)
      sample.fine = sample.light;
  }
};

class Number_shader : Archetype
{
public:
  using Archetype::Archetype;
  std::size_t channels() const { return 1; }
  void shade(const SMT::Surface_point& fine, const SMT::Surface_point&, double* value) const
  {
    *value = double(fine.triangle);
  }
  void finish(double* mean) const { *mean += 10.; }
};

TEST(Texturing_models, a_correspondence_and_a_shader_of_the_user)
{
  const Textured_triangle_mesh light = textured(grid(1, 1), [](std::size_t, Vertex_index v) {
    return Point_2(double(v % 2), double(v / 2));
  });
  SMT::Baking_options options;
  options.width = options.height = 8;
  options.samples = 1;
  const SMT::Baked_map map = SMT::bake(light, Same_triangle(0), Number_shader(0), options);
  ASSERT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_covered_texels, 64u);
  const std::set<float> values(map.image.texels.begin(), map.image.texels.end());
  EXPECT_EQ(values, (std::set<float>{10.f, 11.f}));
}

// A dome beyond a hemisphere is one chart with little stretch, within the bound; it is not where all
// maps are conformal, and another parameterizer than the default one maps every chart.
TEST(Texturing_models, charts_are_stretched_beside_the_default_parameterizer_only)
{
  const Indexed_triangle_mesh mesh = on_sphere(round_disk(14), 1.7);
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = 256;
  options.seam_price = std::numeric_limits<double>::infinity();
  const SMT::Texture_atlas_result stretched = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(stretched.error, "");
  EXPECT_EQ(error_in_atlas(mesh, stretched.atlas), "");
  ASSERT_EQ(stretched.report.charts.size(), 1u);
  EXPECT_TRUE(stretched.report.charts[0].distortion.is_within(options.bound));
  std::size_t mapped = 0; // triangles of the charts that the parameterizer is asked to map last
  const auto parameterizer = [&mapped](const Indexed_triangle_mesh& chart) {
    mapped += chart.triangles.size();
    return SMT::Border_first_chart_parameterizer()(chart);
  };
  const SMT::Texture_atlas_result by_another
    = SMT::build_texture_atlas<CGAL::Sequential_tag>(mesh, options, CGAL::Default(), parameterizer);
  options.may_stretch = false;
  const SMT::Texture_atlas_result conformal = SMT::build_texture_atlas(mesh, options);
  ASSERT_EQ(by_another.error + conformal.error, "");
  EXPECT_GT(conformal.report.charts.size(), 1u);
  EXPECT_EQ(by_another.atlas.charts.chart, conformal.atlas.charts.chart);
  EXPECT_GE(mapped, mesh.triangles.size());
  for(const SMT::Chart_report& chart : by_another.report.charts)
    EXPECT_LT(chart.distortion.quasi_conformal, 1.1);
}

} // namespace texturing_models_test
