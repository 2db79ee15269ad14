// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Overlaps against the areas of intersection of all pairs of triangles.

#include <support/conformal_maps.h>
#include <support/map_measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

namespace overlap_test {

using namespace test_support;
using namespace map_measures;

// --- Overlaps

TEST(Overlap, none_in_planar_charts)
{
  for(const auto& [name, mesh] : planar_charts(1)) {
    const Complex turn = std::polar(1., 0.3);
    EXPECT_FALSE(has_overlap(mesh, map_of(mesh, [&](Complex w) { return turn * w; }))) << name;
    EXPECT_FALSE(has_overlap(mesh, map_of(mesh, [&](Complex w) { return std::conj(turn * w); })))
      << name << ", mirrored";
  }
}

TEST(Overlap, of_a_fold)
{
  const auto mesh = plane();
  EXPECT_TRUE(has_overlap(mesh, map_of(mesh, [](Complex w) {
    return Complex(std::abs(w.real() - 10.5), w.imag());
  })));
}

// A ribbon around the origin whose radius grows by `growth` a turn; it is 1 wide.
Parameters spiral(const Indexed_triangle_mesh& ribbon, double turns, double growth)
{
  return map_of(ribbon, [=](Complex w) {
    const double part = w.real() / 100.;
    return std::polar(5. - w.imag() + growth * turns * part, 2. * CGAL_PI * turns * part);
  });
}

TEST(Overlap, of_a_spiral_without_flips)
{
  const auto ribbon = with_slivers(grid(100, 3), 3.);
  for(const double growth : {0.5, 0.9}) {
    EXPECT_EQ(number_of_flipped_faces(ribbon, spiral(ribbon, 1.3, growth)), 0u);
    EXPECT_TRUE(has_overlap(ribbon, spiral(ribbon, 1.3, growth))) << growth;
  }
  EXPECT_FALSE(has_overlap(ribbon, spiral(ribbon, 1.3, 1.5)));
  EXPECT_FALSE(has_overlap(ribbon, spiral(ribbon, 0.9, 0.)));
  EXPECT_TRUE(has_overlap(ribbon, spiral(ribbon, 1.001, 0.)));
  EXPECT_TRUE(has_overlap(ribbon, spiral(ribbon, 3., 0.2)));
}

// The ends of a ribbon meet exactly, as at a seam: they touch, and do not overlap.
TEST(Overlap, none_where_borders_touch)
{
  const Vertex_index columns = 100, rows = 3;
  const auto ribbon = with_slivers(grid(columns, rows), 3.);
  Parameters uv = spiral(ribbon, 1., 0.);
  for(Vertex_index j = 0; j <= rows; ++j)
    uv[j * (columns + 1) + columns] = uv[j * (columns + 1)];
  EXPECT_FALSE(has_overlap(ribbon, uv));
  uv[columns] = std::polar(1., 1e-9) * uv[0]; // a bit too far
  EXPECT_TRUE(has_overlap(ribbon, uv));
  uv[columns] = std::polar(1., -1e-9) * uv[0];
  EXPECT_FALSE(has_overlap(ribbon, uv));
}

// A tooth of the border that touches another part of the border with its tip
TEST(Overlap, none_where_a_tip_touches)
{
  Indexed_triangle_mesh mesh;
  mesh.points = {Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(4, 1, 0), Point_3(0, 1, 0),
                 Point_3(4, 2, 0), Point_3(2, 2, 0)};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 4, 5}};
  // The triangle (2, 4, 5) is bent over the edge (2, 3): its tip 5 touches it, or goes through.
  const auto uv_with_tip = [&](Complex tip) {
    Parameters uv = map_of(mesh, [](Complex w) { return w; });
    uv[4] = Complex(3., 2.);
    uv[2] = Complex(4., 1.);
    uv[5] = tip;
    return uv;
  };
  EXPECT_FALSE(has_overlap(mesh, uv_with_tip({2., 1.25})));
  EXPECT_FALSE(has_overlap(mesh, uv_with_tip({2., 1.})));
  EXPECT_TRUE(has_overlap(mesh, uv_with_tip({2., 0.75})));
}

// z^2, bent a bit so that the border crosses itself: every point near the middle is covered twice,
// by faces of which none is flipped.
TEST(Overlap, around_a_branch_point)
{
  const auto mesh = disk(4, 60);
  const Parameters uv = map_of(mesh, [](Complex w) { return w * w + 0.3 * w * std::abs(w); });
  EXPECT_EQ(number_of_flipped_faces(mesh, uv), 0u);
  EXPECT_TRUE(has_overlap(mesh, uv));
}

// Turning a ring inside out makes the inner border the outer one.
TEST(Overlap, none_in_a_ring_inside_out)
{
  Indexed_triangle_mesh ring = disk(8, 40);
  std::vector<bool> is_kept(ring.points.size(), true);
  is_kept[0] = false;
  ring = without_vertices(ring, is_kept);
  EXPECT_FALSE(has_overlap(ring, map_of(ring, [](Complex w) { return w; })));
  EXPECT_FALSE(has_overlap(ring, map_of(ring, [](Complex w) { return 1. / w; })));
}

TEST(Overlap, of_several_charts)
{
  const auto ring = [] {
    const Indexed_triangle_mesh mesh = disk(8, 40);
    std::vector<bool> is_kept(mesh.points.size(), true);
    is_kept[0] = false;
    return without_vertices(mesh, is_kept);
  }();
  const auto add = [](Indexed_triangle_mesh a, const Indexed_triangle_mesh& b) {
    const auto shift = Vertex_index(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for(const auto& t : b.triangles)
      a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return a;
  };
  const auto disk = round_disk(5); // of radius 1; the ring is from 1 to 8
  const auto identity = [](Complex w) { return w; };
  const auto overlaps = [&](const Indexed_triangle_mesh& mesh) {
    return has_overlap(mesh, map_of(mesh, identity));
  };
  EXPECT_FALSE(overlaps(add(ring, translated(disk, 20., 0., 0.))));     // beside
  EXPECT_FALSE(overlaps(add(ring, scaled(disk, 0.5))));                 // in the hole
  EXPECT_TRUE(overlaps(add(ring, translated(disk, 4., 0., 0.))));       // within the ring
  EXPECT_TRUE(overlaps(add(ring, translated(disk, 8., 0., 0.))));       // across its border
  EXPECT_TRUE(overlaps(add(ring, ring)));                               // on it
  // One of them mirrored
  const auto both = add(ring, disk);
  for(const double shift : {20., 3.}) {
    Parameters uv = map_of(both, identity);
    for(std::size_t v = ring.points.size(); v < uv.size(); ++v)
      uv[v] = std::conj(uv[v]) + shift;
    EXPECT_EQ(has_overlap(both, uv), shift < 10.);
  }
}

// The area that two triangles have in common, by clipping.
double common_area(std::vector<Complex> a, std::vector<Complex> b)
{
  const auto cross = [](Complex p, Complex q, Complex r) {
    return (std::conj(q - p) * (r - p)).imag();
  };
  for(auto* t : {&a, &b})
    if(cross((*t)[0], (*t)[1], (*t)[2]) < 0.)
      std::swap((*t)[1], (*t)[2]);
  for(int side = 0; side < 3; ++side) {
    const Complex p = b[side], q = b[(side + 1) % 3];
    std::vector<Complex> kept;
    for(std::size_t i = 0; i < a.size(); ++i) {
      const Complex r = a[i], s = a[(i + 1) % a.size()];
      const double dr = cross(p, q, r), ds = cross(p, q, s);
      if(dr >= 0.)
        kept.push_back(r);
      if((dr > 0.) != (ds > 0.) && dr != ds)
        kept.push_back(r + dr / (dr - ds) * (s - r));
    }
    a.swap(kept);
  }
  double twice = 0.;
  for(std::size_t i = 1; i + 1 < a.size(); ++i)
    twice += cross(a[0], a[i], a[i + 1]);
  return 0.5 * twice;
}

double greatest_common_area(const Indexed_triangle_mesh& mesh, const Parameters& uv)
{
  double greatest = 0.;
  for(std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for(std::size_t j = 0; j < i; ++j) {
      std::vector<Complex> corners[2];
      for(int c = 0; c < 3; ++c) {
        corners[0].push_back(uv[mesh.triangles[i][c]]);
        corners[1].push_back(uv[mesh.triangles[j][c]]);
      }
      greatest = (std::max)(greatest, common_area(corners[0], corners[1]));
    }
  return greatest;
}

// Random maps of small charts, of all kinds: with and without flips, bent until they meet
// themselves
TEST(Overlap, is_a_common_area_of_two_faces)
{
  Random random(5);
  int overlapping = 0, trials = 0, without_flips = 0;
  for(std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto mesh = with_jagged_border(with_holes(irregular_grid(12, 3, seed), seed % 3, seed),
                                         0.5, seed);
    const double bend = uniform(random, 0., 0.8), growth = uniform(random, 0., 0.3),
                 noise = seed % 2 == 0 ? 0. : uniform(random, 0., 0.3);
    const Parameters uv = map_of(mesh, [&](Complex w) {
      const Complex jump(uniform(random, -noise, noise), uniform(random, -noise, noise));
      return jump + (5. + growth * w.real() - w.imag()) * std::polar(1., bend * w.real());
    });
    const double area = greatest_common_area(mesh, uv);
    if(area > 1e-12 && area < 1e-9)
      continue; // too near to the rounding errors of clipping
    const bool is_overlap = area > 1e-12;
    ++trials;
    overlapping += is_overlap ? 1 : 0;
    without_flips += is_overlap && number_of_flipped_faces(mesh, uv) == 0 ? 1 : 0;
    EXPECT_EQ(has_overlap(mesh, uv), is_overlap) << "seed " << seed << " area " << area;
    // The definition alone, without the shortcuts
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const SMP::Uv_view<Surface_mesh, Uv_map> view(surface_mesh,
                                                            to_uv_map(surface_mesh, uv));
    EXPECT_EQ(SMP::has_overlapping_triangles(view), is_overlap) << "seed " << seed;
  }
  EXPECT_GE(trials, 90);
  EXPECT_GE(overlapping, 20);
  EXPECT_GE(without_flips, 5);
  EXPECT_LE(overlapping, 80);
}

} // namespace overlap_test
