// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Baking by rays.

#include <support/baked_models.h>
#include <support/textured_meshes.h>

#if __has_include(<embree3/rtcore.h>) && !defined(HLSCM_WITHOUT_EMBREE)
#define HLSCM_BAKING_TEST_EMBREE
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif
#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace baking_by_rays_test {

using namespace test_support;
using namespace baked_models;

// --- Rays

template <class RayCaster>
Texture_image baked_by_rays(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                            std::size_t size)
{
  SMT::Baking_by_rays_options options;
  options.width = options.height = size;
  options.max_distance = 0.3;
  const Baked_map map = SMT::bake_normal_map_by_rays<RayCaster>(
    Indexed_triangle_mesh{fine.points, fine.triangles}, light, options);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_samples_without, 0u);
  return map.image;
}

double largest_difference(const Texture_image& a, const Texture_image& b)
{
  EXPECT_EQ(a.texels.size(), b.texels.size());
  double result = 0.;
  for(std::size_t i = 0; i < a.texels.size(); ++i)
    result = (std::max)(result, std::abs(double(a.texels[i]) - double(b.texels[i])));
  return result;
}

template <class RayCaster>
class Rays : public testing::Test
{};

#ifdef HLSCM_BAKING_TEST_EMBREE
typedef testing::Types<SMT::AABB_tree_ray_caster, SMT::Embree_ray_caster> Ray_casters;
#else
typedef testing::Types<SMT::AABB_tree_ray_caster> Ray_casters;
#endif
TYPED_TEST_SUITE(Rays, Ray_casters);

TYPED_TEST(Rays, find_what_equal_texture_coordinates_find)
{
  // Along the normals of a plane lies what has the same coordinates in the plane.
  const Textured_triangle_mesh fine = over_square(40, bump), light = over_square(3, flat);
  const Texture_image image = bake_normal_map(fine, light, options_of(64, 2)).image;
  EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(fine, light, 64), image), 1e-4);
  // The same surface on both sides: rays begin where they hit
  const Textured_triangle_mesh ball = ball_in_cube(3);
  const Texture_image own = baked_by_rays<TypeParam>(ball, ball, 64);
  EXPECT_LT(largest_difference(own, bake_normal_map(ball, ball, options_of(64, 2)).image), 1e-4);
}

TYPED_TEST(Rays, do_not_depend_on_unit_and_place)
{
  const Textured_triangle_mesh fine = over_square(40, bump), light = over_square(3, flat);
  const Texture_image image = baked_by_rays<TypeParam>(fine, light, 32);
  for(const double unit : {1e-6, 1e6}) {
    const auto moved = [unit](Textured_triangle_mesh mesh) {
      for(Point_3& p : mesh.points)
        p = Point_3(unit * (p.x() + 100.), unit * p.y(), unit * (p.z() - 100.));
      return mesh;
    };
    EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(moved(fine), moved(light), 32), image),
              1e-4);
  }
}

TYPED_TEST(Rays, see_no_surface_from_behind)
{
  // A slab: its lower side is nearer, but looks the other way.
  const auto height = [](double x, double y) { return 0.05 + bump(x, y); };
  Textured_triangle_mesh slab = over_square(20, height);
  const Texture_image image
    = bake_normal_map(slab, over_square(3, flat), options_of(32, 2)).image;
  const Vertex_index n = Vertex_index(slab.points.size());
  const std::size_t triangles = slab.triangles.size();
  for(const double level : {-0.01, 0.02, 0.03}) {
    const Vertex_index first = Vertex_index(slab.points.size());
    for(Vertex_index v = 0; v < n; ++v)
      slab.points.push_back(Point_3(slab.points[v].x(), slab.points[v].y(), level));
    for(std::size_t t = 0; t < triangles; ++t) {
      const Triangle_indices s = slab.triangles[t];
      slab.triangles.push_back({first + s[0], first + s[2], first + s[1]});
    }
  }
  EXPECT_LT(largest_difference(baked_by_rays<TypeParam>(slab, over_square(3, flat), 32), image),
            1e-4);
}

TYPED_TEST(Rays, that_find_nothing_leave_the_texel_to_the_dilation)
{
  const Textured_triangle_mesh light = over_square(3, flat);
  Textured_triangle_mesh half = over_square(20, bump); // x < 0.5
  half.triangles.erase(std::remove_if(half.triangles.begin(), half.triangles.end(),
                                      [&](const Triangle_indices& t) {
                                        return half.points[t[0]].x() + half.points[t[1]].x()
                                               + half.points[t[2]].x() > 1.5;
                                      }),
                       half.triangles.end());
  SMT::Baking_by_rays_options options;
  options.width = options.height = 40;
  const Baked_map map = SMT::bake_normal_map_by_rays<TypeParam>(
    Indexed_triangle_mesh{half.points, half.triangles}, light, options);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.number_of_covered_texels, 800u);
  EXPECT_EQ(map.number_of_samples_without, 3200u);
  for(std::size_t x = 20; x < 40; ++x)
    for(int c = 0; c < 3; ++c)
      EXPECT_EQ(map.image.texel(x, 7)[c], map.image.texel(19, 7)[c]);
}

TYPED_TEST(Rays, have_errors_for_bad_data)
{
  const Textured_triangle_mesh light = over_square(3, flat);
  const auto error = [&](const Indexed_triangle_mesh& fine) {
    return SMT::bake_normal_map_by_rays<TypeParam>(fine, light).error;
  };
  EXPECT_NE(error({}), "");
  EXPECT_NE(error({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}), "");
  EXPECT_NE(error({{{1, 1, 1}, {0, std::nan(""), 0}, {0, 1, 0}}, {{0, 1, 2}}}), "");
}

#ifdef HLSCM_BAKING_TEST_EMBREE
TEST(Ray_casters, agree)
{
  // A light ball under a wavy one, whose charts are others
  Textured_triangle_mesh wavy = cut_torus(60, 30, 1, 1);
  for(Point_3& p : wavy.points)
    p = p + 0.02 * std::sin(11. * p.x() + 5. * p.z()) * (p - Point_3(0., 0., 0.));
  const Textured_triangle_mesh light = in_unit_square(cut_torus(24, 12, 4, 3));
  const Texture_image a = baked_by_rays<SMT::AABB_tree_ray_caster>(wavy, light, 80);
  const Texture_image b = baked_by_rays<SMT::Embree_ray_caster>(wavy, light, 80);
  EXPECT_LT(largest_difference(a, b), 1e-3); // floats find the triangle
  EXPECT_GT(largest_difference(a, bake_normal_map(light, light, options_of(80, 2)).image), 0.1);
}
#endif

} // namespace baking_by_rays_test
