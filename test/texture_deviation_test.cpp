// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The errors of textured levels, against their definitions: the overlay of the two triangulations
// by all pairs of edges, dense samples, and cases that are known.

#include <support/mesh_generators.h>
#include <support/progressive_models.h>
#include <support/textured_levels.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace texture_deviation_test {

using namespace test_support;
using namespace textured_levels;
using SMM::Wedge_mesh;

// --- The definitions

// The weights of the triangles at p, for triangles in the plane.
std::array<double, 3> weights_of(const Wedge_mesh& mesh, const CGAL::Indexed_mesh::Triangle_indices& t,
                                 const Point_2& p)
{
  const Point_2 &a = mesh.uv[t[0]], &b = mesh.uv[t[1]], &c = mesh.uv[t[2]];
  const double area = CGAL::area(a, b, c);
  return {CGAL::area(p, b, c) / area, CGAL::area(a, p, c) / area, CGAL::area(a, b, p) / area};
}

CGAL::Simple_cartesian<double>::Vector_3
combination(const Wedge_mesh& mesh, const CGAL::Indexed_mesh::Triangle_indices& t,
            const std::array<double, 3>& w)
{
  const auto at = [&](int c) { return mesh.points[mesh.vertex[t[c]]] - CGAL::ORIGIN; };
  return w[0] * at(0) + w[1] * at(1) + w[2] * at(2);
}

// Whether p is clearly left or right, below or above of a triangle in the texture.
bool is_beside(const Wedge_mesh& mesh, const CGAL::Indexed_mesh::Triangle_indices& t, const Point_2& p)
{
  for(int i = 0; i < 2; ++i) {
    const auto [lo, hi] = std::minmax({mesh.uv[t[0]][i], mesh.uv[t[1]][i], mesh.uv[t[2]][i]});
    const double margin = 1e-6 * (hi - lo);
    if(p[i] < lo - margin || p[i] > hi + margin)
      return true;
  }
  return false;
}

// The point of the surface that has a texture coordinate: that of the first of the triangles where
// no weight is below -1e-9, by looking at all of them.
std::optional<Point_3> point_at(const Wedge_mesh& mesh, const Point_2& p)
{
  for(const CGAL::Indexed_mesh::Triangle_indices& t : mesh.triangles) {
    if(is_beside(mesh, t, p))
      continue;
    const auto w = weights_of(mesh, t, p);
    if(w[0] >= -1e-9 && w[1] >= -1e-9 && w[2] >= -1e-9)
      return CGAL::ORIGIN + combination(mesh, t, w);
  }
  return std::nullopt;
}

bool has_flips(const Wedge_mesh& mesh)
{
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return CGAL::area(mesh.uv[t[0]], mesh.uv[t[1]], mesh.uv[t[2]]) <= 0.;
  });
}

double deviation_at(const Wedge_mesh& fine, const Wedge_mesh& coarse,
                    const Point_2& p)
{
  const auto a = point_at(fine, p), b = point_at(coarse, p);
  return a && b ? std::sqrt(CGAL::squared_distance(*a, *b)) : 0.;
}

// The maximum over the vertices of the overlay, by all pairs of edges. For maps that are
// one-to-one.
double overlay_maximum(const Wedge_mesh& fine, const Wedge_mesh& coarse)
{
  double result = 0.;
  const auto use = [&](const Point_2& p) {
    result = (std::max)(result, deviation_at(fine, coarse, p));
  };
  for(const Point_2& p : fine.uv)
    use(p);
  for(const Point_2& p : coarse.uv)
    use(p);
  for(const auto& s : fine.triangles)
    for(const auto& t : coarse.triangles)
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j) {
          const Point_2 &a = fine.uv[s[i]], &b = fine.uv[s[(i + 1) % 3]];
          const Point_2 &c = coarse.uv[t[j]], &d = coarse.uv[t[(j + 1) % 3]];
          const double ac = CGAL::area(a, c, d), bc = CGAL::area(b, c, d);
          if(ac * bc >= 0. || CGAL::area(c, a, b) * CGAL::area(d, a, b) >= 0.)
            continue;
          use(a + (ac / (ac - bc)) * (b - a));
        }
  return result;
}

// The same at the middles of n^2 small triangles in each fine triangle, with the mean by area.
SMM::Surface_error sampled(const Wedge_mesh& fine, const Wedge_mesh& coarse,
                           int n)
{
  SMM::Surface_error result;
  double total = 0.;
  for(const auto& t : fine.triangles) {
    const auto at = [&](int c) { return fine.points[fine.vertex[t[c]]]; };
    const double area = std::sqrt(CGAL::squared_area(at(0), at(1), at(2)));
    total += area;
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j)
        for(int up = 0; up < (i + j + 1 < n ? 2 : 1); ++up) {
          const double third = up == 0 ? 1. / 3. : 2. / 3.;
          const double u = (i + third) / n, v = (j + third) / n;
          const Point_2 p = fine.uv[t[0]] + u * (fine.uv[t[1]] - fine.uv[t[0]])
                          + v * (fine.uv[t[2]] - fine.uv[t[0]]);
          const auto image = point_at(coarse, p);
          if(!image)
            continue;
          const Point_3 q = CGAL::ORIGIN + combination(fine, t, {1. - u - v, u, v});
          const double error = std::sqrt(CGAL::squared_distance(q, *image));
          result.maximum = (std::max)(result.maximum, error);
          result.mean += area * error / (n * n);
        }
  }
  result.mean /= total;
  return result;
}

// The greatest distance of a vertex of `fine` from `coarse`, by looking at all triangles.
double distance_maximum(const Wedge_mesh& fine, const Wedge_mesh& coarse)
{
  double result = 0.;
  for(const Point_3& p : fine.points) {
    double least = 1e300;
    for(const auto& t : coarse.triangles) {
      const auto at = [&](int c) { return coarse.points[coarse.vertex[t[c]]]; };
      least = (std::min)(least, CGAL::to_double(CGAL::squared_distance(
                                  p, CGAL::Simple_cartesian<double>::Triangle_3(at(0), at(1), at(2)))));
    }
    result = (std::max)(result, least);
  }
  return std::sqrt(result);
}

// --- Tests

TEST(Texture_deviation, of_the_finest_level_is_zero)
{
  for(const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Texture_deviation d = measure_texture_deviation(c.mesh, 0);
    for(const SMM::Surface_error& e : {d.deviation, d.uv_change, d.distance}) {
      EXPECT_EQ(e.maximum, 0.);
      EXPECT_EQ(e.mean, 0.);
    }
    EXPECT_EQ(d.outside, 0.);
    EXPECT_EQ(d.unresolved, 0.);
    EXPECT_EQ(d.triangles, c.mesh.progressive_mesh.triangles.size());
  }
}

TEST(Texture_deviation, of_a_plane_with_affine_coordinates_is_zero)
{
  const Indexed_triangle_mesh plane = irregular_grid(40, 30, seed);
  const auto affine = [](const Point_2& p) {
    return Point_2(3. * p.x() - p.y() + 7., 0.5 * p.x() + 2. * p.y() - 1.);
  };
  const Textured_progressive_mesh mesh
    = textured(plane, transformed(projection(plane), affine),
               decimate(plane, locked(plane.points.size(), grid_corners(40, 30))));
  EXPECT_GT(mesh.number_of_collapses(), 1000u);
  for(const std::size_t k : positions(mesh)) {
    SCOPED_TRACE("position " + std::to_string(k) + seed_text);
    const Texture_deviation d = measure_texture_deviation(mesh, k);
    EXPECT_LT(d.deviation.maximum, 1e-12 * d.diagonal);
    EXPECT_LT(d.distance.maximum, 1e-12 * d.diagonal);
    EXPECT_LT(d.uv_change.maximum, 1e-12 * d.diagonal);
    EXPECT_EQ(d.outside, 0.);
    EXPECT_EQ(d.unresolved, 0.);
  }
}

TEST(Texture_deviation, outside_of_the_border_it_is_the_way_back)
{
  // Of a square whose corner (4, 4) has been cut off; in the plane the way in the texture is that
  // in space.
  const Indexed_triangle_mesh square = grid(4, 4);
  Progressive_mesh pm = SMM::trivial_progressive_mesh(square.points.size());
  pm.collapses = {{24, 23}};
  const Texture_deviation d
    = measure_texture_deviation(textured(square, projection(square), pm), 1);
  EXPECT_NEAR(d.deviation.maximum, std::sqrt(0.5), 1e-12); // to the line from (3, 4) to (4, 3)
  EXPECT_NEAR(d.distance.maximum, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(d.uv_change.maximum, std::sqrt(0.5), 1e-12);
  // Both triangles at the corner have two of three edges outside, or half of them.
  EXPECT_GT(d.outside, 0.3 / 16.);
  EXPECT_LT(d.outside, 1. / 16.);
}

TEST(Texture_deviation, of_a_peak_that_is_cut_off)
{
  for(const double height : {0., 0.01, 1.}) {
    SCOPED_TRACE(height);
    Indexed_triangle_mesh peak = fan(12);
    const Uvs uv = projection(peak);
    peak.points[0] = Point_3(0., 0., height);
    Progressive_mesh pm = SMM::trivial_progressive_mesh(peak.points.size());
    pm.collapses = {{0, 1}};
    const Texture_deviation d = measure_texture_deviation(textured(peak, uv, pm), 1);
    EXPECT_NEAR(d.deviation.maximum, height, 1e-12);
    EXPECT_NEAR(d.deviation.mean, height / 3., 1e-12); // the volume of a cone
    EXPECT_NEAR(d.distance.maximum, height, 1e-12);
    EXPECT_NEAR(d.uv_change.maximum, 0., 1e-12);
    EXPECT_EQ(d.triangles, 10u);
    // The same with coordinates of the hub that are not those of the point below it
    Uvs moved = uv;
    moved[0] = Point_2(0.3, -0.4);
    const Texture_deviation swum = measure_texture_deviation(textured(peak, moved, pm), 1);
    EXPECT_NEAR(swum.deviation.maximum, std::hypot(height, 0.5), 1e-12);
    EXPECT_NEAR(swum.distance.maximum, height, 1e-12);
    EXPECT_NEAR(swum.uv_change.maximum, 0.5, 1e-12);
    EXPECT_NEAR(swum.uv_change.mean, 0.5 / 3., 1e-12); // a third of the area is the hub's
    EXPECT_NEAR(Texture_deviation::texels(swum.uv_change.maximum, 1024.), 512., 1e-9);
  }
}

// Over the projection, it is the vertical difference of two height fields.
TEST(Texture_deviation, of_height_fields_is_their_difference_over_the_overlay)
{
  for(const std::uint64_t s : {seed, seed + 100, seed + 200}) {
    const Case c = hills_over_rectangle(13, 9, s);
    const Wedge_mesh fine = SMM::textured_level(c.mesh, 0);
    double greatest = 0.;
    for(const std::size_t k : positions(c.mesh)) {
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      const Wedge_mesh coarse = SMM::textured_level(c.mesh, k);
      const Texture_deviation d = measure_texture_deviation(c.mesh, k);
      EXPECT_NEAR(d.deviation.maximum, overlay_maximum(fine, coarse), 1e-7);
      EXPECT_EQ(d.outside, 0.);
      EXPECT_EQ(d.unresolved, 0.);
      EXPECT_EQ(d.triangles, coarse.triangles.size());
      greatest = (std::max)(greatest, d.deviation.maximum);
    }
    EXPECT_GT(greatest, 0.5);
  }
}

TEST(Texture_deviation, of_dense_samples_is_less_but_not_much)
{
  int levels = 0;
  for(const Case& c : cases()) {
    const Wedge_mesh fine = SMM::textured_level(c.mesh, 0);
    for(const std::size_t k : positions(c.mesh)) {
      const Wedge_mesh coarse = SMM::textured_level(c.mesh, k);
      if(has_flips(fine) || has_flips(coarse))
        continue; // some points have several images
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      const Texture_deviation d = measure_texture_deviation(c.mesh, k);
      const SMM::Surface_error samples = sampled(fine, coarse, 6);
      ++levels;
      EXPECT_LE(samples.maximum, d.deviation.maximum + 1e-7);
      if(d.outside > 0.)
        continue; // where there are no samples
      EXPECT_GE(samples.maximum, 0.8 * d.deviation.maximum);
      EXPECT_NEAR(samples.mean, d.deviation.mean, 0.1 * d.deviation.mean + 1e-9);
    }
  }
  EXPECT_GT(levels, 20);
}

TEST(Texture_deviation, distance_is_that_from_the_nearest_triangle)
{
  for(const Case& c : {hills_over_rectangle(24, 17, seed), cases()[4]})
    for(const std::size_t k : positions(c.mesh)) {
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      const double expected = distance_maximum(SMM::textured_level(c.mesh, 0),
                                               SMM::textured_level(c.mesh, k));
      const Texture_deviation d = measure_texture_deviation(c.mesh, k);
      EXPECT_GE(d.distance.maximum, expected - 1e-9);
      EXPECT_LE(d.distance.maximum, 1.2 * expected + 1e-9); // a local minimum
    }
}

TEST(Texture_deviation, is_no_less_than_the_distance)
{
  for(const Case& c : cases())
    for(const std::size_t k : positions(c.mesh)) {
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      const Texture_deviation d = measure_texture_deviation(c.mesh, k);
      EXPECT_GE(d.deviation.maximum, d.distance.maximum * (1. - 1e-12));
      EXPECT_GE(d.deviation.maximum, d.deviation.mean);
      EXPECT_GE(d.uv_change.maximum, d.uv_change.mean);
      EXPECT_GE(d.distance.maximum, d.distance.mean);
      EXPECT_LE(d.deviation.maximum, d.diagonal * (1. + 1e-12));
      EXPECT_LE(d.outside, 1.);
      EXPECT_LE(d.outside + d.unresolved, 1. + 1e-12);
    }
}

TEST(Texture_deviation, scales_with_the_surface_and_with_the_map)
{
  // Powers of two, so that nothing is rounded otherwise
  for(const Case& c : cases())
    for(const std::size_t k : positions(c.mesh)) {
      SCOPED_TRACE(c.name + ", position " + std::to_string(k));
      Textured_progressive_mesh mesh = c.mesh;
      const Texture_deviation d = measure_texture_deviation(mesh, k);
      for(Point_3& p : mesh.points)
        p = Point_3(8. * p.x(), 8. * p.y(), 8. * p.z());
      for(Point_2& p : mesh.uv)
        p = Point_2(0.25 * p.x(), 0.25 * p.y());
      const Texture_deviation e = measure_texture_deviation(mesh, k);
      EXPECT_EQ(e.deviation.maximum, 8. * d.deviation.maximum);
      EXPECT_EQ(e.deviation.mean, 8. * d.deviation.mean);
      EXPECT_EQ(e.uv_change.maximum, 0.25 * d.uv_change.maximum);
      EXPECT_EQ(e.distance.mean, 8. * d.distance.mean);
      EXPECT_EQ(e.relative(e.deviation.maximum), d.relative(d.deviation.maximum));
      EXPECT_EQ(e.outside, d.outside);
    }
}

TEST(Texture_deviation, of_other_meshes)
{
  // Of two unrelated triangulations of a rectangle the vertices of both count.
  const auto hills = [](Vertex_index n, double scale, std::uint64_t s) {
    const Indexed_triangle_mesh plane = scaled(irregular_grid(n, n, s), scale);
    const Indexed_triangle_mesh mesh = with_hills(plane, 3., 99);
    Wedge_mesh result;
    result.points = mesh.points;
    result.triangles = mesh.triangles;
    result.uv = projection(plane);
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      result.vertex.push_back(v);
    return result;
  };
  const Wedge_mesh fine = hills(16, 1., seed), coarse = hills(5, 3.2, seed + 1);
  for(const auto& [a, b] : {std::pair(&fine, &coarse), std::pair(&coarse, &fine)}) {
    const Texture_deviation d = measure_texture_deviation(*a, *b);
    EXPECT_NEAR(d.deviation.maximum, overlay_maximum(*a, *b), 1e-7) << seed_text;
    EXPECT_NEAR(d.distance.maximum, distance_maximum(*a, *b), 1e-9) << seed_text;
    EXPECT_NEAR(d.outside, 0., 1e-9);
    EXPECT_EQ(d.unresolved, 0.);
  }
  const Texture_deviation same = measure_texture_deviation(fine, fine);
  EXPECT_LT(same.deviation.maximum, 1e-12);
  EXPECT_LT(same.uv_change.maximum, 1e-12);
  EXPECT_EQ(same.outside, 0.);
  EXPECT_EQ(same.unresolved, 0.);
  // Levels, as if they were other meshes
  const Case c = hills_over_rectangle(24, 17, seed);
  for(const std::size_t k : positions(c.mesh)) {
    SCOPED_TRACE(c.name + ", position " + std::to_string(k));
    const Texture_deviation known = measure_texture_deviation(c.mesh, k);
    const Texture_deviation other = measure_texture_deviation(SMM::textured_level(c.mesh, 0),
                                                              SMM::textured_level(c.mesh, k));
    EXPECT_NEAR(other.deviation.maximum, known.deviation.maximum, 1e-9);
    EXPECT_NEAR(other.deviation.mean, known.deviation.mean, 1e-9);
    EXPECT_LE(other.distance.maximum, known.distance.maximum + 1e-9);
  }
}

// A cylinder, cut along a line; the wedges at the cut stay.
Textured_progressive_mesh cut_cylinder(Vertex_index sectors, Vertex_index rows)
{
  const Indexed_triangle_mesh flat = grid(sectors, rows);
  Textured_progressive_mesh result;
  result.uv = projection(flat);
  Indexed_triangle_mesh round = flat;
  for(Vertex_index w = 0; w < flat.points.size(); ++w) {
    const Vertex_index i = w % (sectors + 1), j = w / (sectors + 1);
    const double a = 2. * CGAL_PI * (i % sectors) / sectors;
    round.points[w] = Point_3(std::cos(a), std::sin(a), 0.3 * j);
    result.vertex.push_back(j * sectors + i % sectors);
    if(i < sectors)
      result.points.push_back(round.points[w]);
  }
  std::vector<bool> is_locked(flat.points.size());
  for(std::size_t w = 0; w < is_locked.size(); ++w)
    is_locked[w] = flat.points[w].x() == 0. || flat.points[w].x() == double(sectors);
  result.progressive_mesh = decimate(round, is_locked);
  result.progressive_mesh.triangles = flat.triangles;
  return SMM::coarse_first(result);
}

TEST(Texture_deviation, across_seams)
{
  const Textured_progressive_mesh mesh = cut_cylinder(40, 20);
  EXPECT_GT(mesh.number_of_collapses(), 500u);
  const Wedge_mesh fine = SMM::textured_level(mesh, 0);
  for(const std::size_t k : positions(mesh)) {
    SCOPED_TRACE(k);
    const Wedge_mesh coarse = SMM::textured_level(mesh, k);
    const Texture_deviation d = measure_texture_deviation(mesh, k);
    if(d.outside < 1e-12) {
      EXPECT_NEAR(d.deviation.maximum, overlay_maximum(fine, coarse), 1e-7);
    }
    EXPECT_GE(d.distance.maximum, distance_maximum(fine, coarse) - 1e-9);
    EXPECT_GE(d.deviation.maximum, d.distance.maximum - 1e-12);
    if(coarse.triangles.size() > 200) { // where a nearest point nearby is the nearest of all
      EXPECT_NEAR(d.distance.maximum, distance_maximum(fine, coarse), 1e-9);
      EXPECT_LT(d.uv_change.maximum, 20.); // nothing crosses the cut, 40 wide
    }
  }
}

TEST(Texture_deviation, does_not_depend_on_the_number_of_threads)
{
  const auto numbers = [](const Texture_deviation& d) {
    return std::array<double, 9>{d.deviation.maximum, d.deviation.mean, d.uv_change.maximum,
                                 d.uv_change.mean, d.distance.maximum, d.distance.mean, d.outside,
                                 d.unresolved, d.diagonal};
  };
  const Case c = hills_over_rectangle(150, 120, seed);
  for(const std::size_t k : {c.mesh.number_of_collapses() / 2, c.mesh.number_of_collapses()}) {
    SCOPED_TRACE(c.name + ", position " + std::to_string(k));
    const Texture_deviation one = measure_texture_deviation(c.mesh, c.mesh.whole_position(k));
    for(const unsigned int threads : {2u, 3u, 8u}) {
      const CGAL::Blocked_execution::Thread_scope scope(threads);
      const Texture_deviation many = measure_texture_deviation(c.mesh, c.mesh.whole_position(k));
      EXPECT_EQ(std::memcmp(numbers(one).data(), numbers(many).data(), sizeof numbers(one)), 0)
        << threads << " threads";
      EXPECT_EQ(one.triangles, many.triangles);
    }
  }
}

} // namespace texture_deviation_test
