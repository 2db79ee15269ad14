// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The derivatives of the untangling energy by differences, and the repair of tangled maps: what it
// promises, as a function that returns what is wrong.

#include <support/conformal_maps.h>
#include <support/repaired_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/Patch_energy.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/turns_of_border.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace flip_repair_test {

using namespace test_support;
using namespace repaired_maps;

// --- The energy, by differences

TEST(Untangling_energy, has_its_derivatives)
{
  Random random(1);
  const SMP::internal::Energy_terms all_terms[]
    = {{1., 0., 0., 1.}, {0., 1., 0., 1.}, {0., 1., 0., 0.01}, {0., 1., 0.1, 0.1}, {0., 0., 1., 1.},
       {1., 0.1, 0., 0.}};
  for(const auto& terms : all_terms)
    for(int trial = 0; trial < 100; ++trial) {
      const double y = uniform(random, 0.1, 2.);
      const double x = terms.epsilon == 0. ? y + uniform(random, 0.1, 2.) : uniform(random, 0.1, 2.);
      const auto value = [&terms](double x, double y) {
        const double d = 0.25 * (x * x - y * y);
        const double chi = 0.5 * (d + std::sqrt(d * d + terms.epsilon * terms.epsilon));
        return 0.5 * (y * y * (terms.conformal + terms.barrier / chi)
                      + terms.area * (1. + d * d) / chi);
      };
      const SMP::internal::Triangle_energy e(x, y, 0.25 * (x * x - y * y), terms);
      const double h = 1e-5;
      const double f_x = (value(x + h, y) - value(x - h, y)) / (2. * h);
      const double f_y = (value(x, y + h) - value(x, y - h)) / (2. * h);
      EXPECT_NEAR(e.f, value(x, y), 1e-9 * e.f);
      const double tolerance = 1e-4 * (std::fabs(f_x) + std::fabs(f_y));
      EXPECT_NEAR(e.f_x, f_x, tolerance);
      EXPECT_NEAR(e.f_y, f_y, tolerance);
      // Semidefinite, and unchanged if it already was
      EXPECT_GE(e.f_xx * e.f_yy - e.f_xy * e.f_xy, -1e-9 * (e.f_xx + e.f_yy) * (e.f_xx + e.f_yy));
      const double k = 1e-4;
      const double f_xx = (value(x + k, y) - 2. * value(x, y) + value(x - k, y)) / (k * k);
      const double f_yy = (value(x, y + k) - 2. * value(x, y) + value(x, y - k)) / (k * k);
      const double f_xy = (value(x + k, y + k) - value(x + k, y - k) - value(x - k, y + k)
                           + value(x - k, y - k)) / (4. * k * k);
      const double size = std::fabs(f_xx) + std::fabs(f_yy) + std::fabs(f_xy);
      if(f_xx > 0. && f_xx * f_yy - f_xy * f_xy > 1e-3 * size * size) {
        EXPECT_NEAR(e.f_xx, f_xx, 1e-3 * size);
        EXPECT_NEAR(e.f_xy, f_xy, 1e-3 * size);
        EXPECT_NEAR(e.f_yy, f_yy, 1e-3 * size);
      }
    }
}

// --- Repair

// Repairs, and expects no flips; returns the new map.
Parameters expect_mended(const Indexed_triangle_mesh& mesh, const Parameters& uv,
                         const std::vector<std::size_t>& pins = {})
{
  const Repaired repaired = repair(mesh, uv, pins);
  EXPECT_EQ(error_in_repair(mesh, uv, pins, repaired), "");
  EXPECT_TRUE(repaired.report.unmended_faces.empty());
  return repaired.uv;
}

TEST(Repair, leaves_a_map_without_flips_alone)
{
  for(const auto& [name, mesh] : planar_charts(2)) {
    const Repaired repaired = repair(mesh, identity(mesh));
    EXPECT_EQ(repaired.uv, identity(mesh)) << name;
    EXPECT_EQ(repaired.report.moved_vertices, 0u) << name;
  }
}

TEST(Repair, of_one_triangle)
{
  const auto mesh = without_vertices(grid(1, 1), {true, true, false, true});
  const Parameters uv = expect_mended(mesh, {0., {1., 1.}, 1.});
  EXPECT_LT(energy_of_map(mesh, uv), 1e-9); // it can be made similar
}

TEST(Repair, of_a_fold_along_an_edge)
{
  const auto mesh = grid(1, 1);
  expect_mended(mesh, {0., 1., {1., 0.2}, {1., 1.}});
  expect_mended(mesh, {0., 1., {1., 0.2}, {1., 1.}}, {0, 1});
  expect_mended(mesh, {0., 1., {1., 0.2}, {1., 1.}}, {0, 3});
}

TEST(Repair, of_an_inverted_star)
{
  const auto mesh = fan(12);
  std::vector<std::size_t> link(12);
  std::iota(link.begin(), link.end(), std::size_t(1));
  Parameters uv = identity(mesh);
  uv[0] = {3., 0.1};
  const Parameters mended = expect_mended(mesh, uv, link);
  EXPECT_LT(std::abs(mended[0]), 1e-6); // by symmetry
}

TEST(Repair, of_a_border_triangle)
{
  const auto mesh = irregular_grid(12, 10, 3);
  Parameters uv = identity(mesh);
  uv[5] += Complex(0., 3.); // drawn from the border across the row behind it
  ASSERT_GT(bad_faces(mesh, uv).size(), 0u);
  const Parameters mended = expect_mended(mesh, uv, {0, 12});
  const auto distance = distances_from(mesh, bad_faces(mesh, uv));
  for(std::size_t v = 0; v < uv.size(); ++v) {
    EXPECT_TRUE(distance[v] <= 4 || mended[v] == uv[v]) << v;
  }
}

TEST(Repair, of_faces_collapsed_to_a_point)
{
  const auto mesh = irregular_grid(12, 10, 4);
  Parameters uv = identity(mesh);
  const auto neighbors = neighbors_of(mesh);
  for(const Vertex_index v : neighbors[6 * 13 + 6])
    uv[v] = uv[6 * 13 + 6];
  ASSERT_GT(bad_faces(mesh, uv).size(), 3u);
  expect_mended(mesh, uv, {0, 12});
}

// The energy of the identity is 0; the repair must find nearly that again, whatever the
// perturbation.
TEST(Repair, finds_the_conformal_map)
{
  const auto mesh = irregular_grid(20, 15, 5);
  Parameters uv = identity(mesh);
  uv[7 * 21 + 10] += Complex(3.5, 0.5);
  const Parameters mended = expect_mended(mesh, uv, {0, 20});
  EXPECT_LT(difference(mended, identity(mesh)), 1e-3);
}

// What cannot be mended is listed and stays as it was; the rest is mended.
TEST(Repair, lists_what_is_pinned)
{
  const auto mesh = irregular_grid(30, 20, 6);
  Parameters uv = identity(mesh);
  const std::vector<std::size_t> pins(mesh.triangles[100].begin(), mesh.triangles[100].end());
  std::swap(uv[pins[0]], uv[pins[1]]);
  uv[15 * 31 + 25] += Complex(2., 0.);
  const Repaired repaired = repair(mesh, uv, pins);
  EXPECT_EQ(error_in_repair(mesh, uv, pins, repaired), "");
  const auto& unmended = repaired.report.unmended_faces;
  EXPECT_TRUE(std::binary_search(unmended.begin(), unmended.end(), std::size_t(100)));
  const auto distance = distances_from(mesh, {100});
  for(const std::size_t f : unmended)
    for(const Vertex_index v : mesh.triangles[f])
      EXPECT_LE(distance[v], 1);
}

TEST(Repair, leaves_patches_that_are_too_large)
{
  const auto mesh = irregular_grid(30, 20, 6);
  Parameters uv = identity(mesh);
  uv[10 * 31 + 15] += Complex(2., 0.);
  Flip_repair_options options;
  options.largest_patch = 5;
  const Repaired repaired = repair(mesh, uv, {}, options);
  EXPECT_EQ(repaired.uv, uv);
  EXPECT_EQ(repaired.report.unmended_faces, bad_faces(mesh, uv));
}

TEST(Repair, works_without_pins_and_with_faces_that_are_not_numbers)
{
  const auto mesh = fan(8);
  Surface_mesh surface_mesh = to_surface_mesh(mesh);
  Parameters uv = identity(mesh);
  uv[0] = {2., 0.1};
  Uv_map uvmap = to_uv_map(surface_mesh, uv);
  EXPECT_TRUE(SMP::repair_flipped_faces(surface_mesh, uvmap).unmended_faces.empty());
  EXPECT_TRUE(SMP::certify_map(surface_mesh, uvmap).is_one_to_one());
  uv[0] = {std::numeric_limits<double>::quiet_NaN(), 0.};
  uvmap = to_uv_map(surface_mesh, uv);
  EXPECT_EQ(SMP::repair_flipped_faces(surface_mesh, uvmap, Flip_repair_options())
              .unmended_faces.size(), 8u);
}

TEST(Repair, of_arrays_is_that_of_meshes)
{
  const auto mesh = irregular_grid(30, 20, 6);
  Parameters uv = identity(mesh);
  const std::vector<std::size_t> pins(mesh.triangles[100].begin(), mesh.triangles[100].end());
  std::swap(uv[pins[0]], uv[pins[1]]);
  uv[15 * 31 + 25] += Complex(2., 0.);
  uv[3 * 31 + 3] = {std::numeric_limits<double>::quiet_NaN(), 0.};
  for(const bool has_pins : {true, false}) {
    const Repaired repaired = repair(mesh, uv, has_pins ? pins : std::vector<std::size_t>());
    std::vector<bool> is_pinned(uv.size(), false);
    for(const std::size_t v : pins)
      is_pinned[v] = true;
    auto points = to_points(uv);
    const auto report = has_pins ? SMP::repair_flipped_faces(mesh, points, is_pinned)
                                 : SMP::repair_flipped_faces(mesh, points);
    EXPECT_EQ(report.flipped_before, repaired.report.flipped_before);
    EXPECT_EQ(report.unmended_faces, repaired.report.unmended_faces);
    for(std::size_t v = 0; v < uv.size(); ++v) {
      const Complex z(points[v].x(), points[v].y());
      EXPECT_TRUE(z == repaired.uv[v] || (z != z && repaired.uv[v] != repaired.uv[v])) << v;
    }
  }
}

TEST(Repair, takes_the_points_that_are_given_and_does_to_arrays_what_it_does_to_meshes)
{
  const auto arrays = with_hills(irregular_grid(16, 12, 7), 1., 8);
  Parameters uv = identity(arrays);
  uv[100] = uv[40];
  Surface_mesh mesh = to_surface_mesh(arrays);
  const auto place
    = mesh.add_property_map<Surface_mesh::Vertex_index, Surface_mesh::Point>("v:place").first;
  for(const auto v : mesh.vertices()) {
    place[v] = mesh.point(v);
    mesh.point(v) = Surface_mesh::Point(0., 0., 0.);
  }
  const Uv_map uvmap = to_uv_map(mesh, uv);
  auto points = to_points(uv);
  const Flip_repair_report of_mesh = SMP::repair_flipped_faces(
    mesh, uvmap, Flip_repair_options(), CGAL::parameters::vertex_point_map(place));
  const Flip_repair_report of_arrays = SMP::repair_flipped_faces(arrays, points);
  EXPECT_GT(of_arrays.flipped_before, 0u);
  EXPECT_EQ(of_arrays.flipped_after, 0u);
  EXPECT_EQ(of_mesh.energy_after, of_arrays.energy_after);
  EXPECT_EQ(to_points(parameters(mesh, uvmap)), points);
}

// The position and the unit of map and surface do not matter.
TEST(Repair, works_at_all_scales)
{
  const auto mesh = with_hills(irregular_grid(16, 12, 7), 1., 8);
  for(const double unit : {1e-20, 1., 1e20})
    for(const double uv_unit : {1e-20, 1., 1e20}) {
      Parameters uv = identity(mesh);
      uv[6 * 17 + 8] += Complex(2.5, 0.);
      for(Complex& z : uv)
        z *= uv_unit;
      const Repaired repaired = repair(scaled(mesh, unit), uv, {0, 16});
      EXPECT_EQ(error_in_repair(scaled(mesh, unit), uv, {0, 16}, repaired), "");
      EXPECT_TRUE(repaired.report.unmended_faces.empty()) << unit << " " << uv_unit;
    }
}

// Vertices inside thrown about, the border kept: a flip-free map exists, the unperturbed one.
TEST(Repair, untangles_random_maps)
{
  for(std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const auto plane = irregular_grid(18, 14, seed);
    const auto mesh = seed % 3 == 0 ? with_holes(plane, 4, seed)
                    : seed % 3 == 1 ? plane : with_slivers(plane, 10.);
    const std::vector<bool> is_border = border_vertices_of(mesh);
    const double amplitude = uniform(random, 0.3, 2.), share = uniform(random, 0.01, 0.5);
    Parameters uv = identity(mesh);
    std::vector<std::size_t> pins;
    for(std::size_t v = 0; v < uv.size(); ++v) {
      if(is_border[v])
        pins.push_back(v);
      else if(uniform(random, 0., 1.) < share)
        uv[v] += Complex(uniform(random, -amplitude, amplitude),
                         uniform(random, -amplitude, amplitude));
    }
    const Repaired repaired = repair(mesh, uv, pins);
    EXPECT_EQ(error_in_repair(mesh, uv, pins, repaired), "") << "seed " << seed;
    EXPECT_TRUE(certify(mesh, repaired.uv).certificate.is_one_to_one())
      << "seed " << seed << ": " << repaired.report.flipped_before << " flips, "
      << repaired.report.unmended_faces.size() << " left";
  }
}

TEST(Repair, is_the_same_in_every_run)
{
  const auto mesh = irregular_grid(40, 30, 9);
  Random random(9);
  Parameters uv = identity(mesh);
  for(Complex& z : uv)
    if(uniform(random, 0., 1.) < 0.05)
      z += Complex(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5));
  const Parameters first = expect_mended(mesh, uv);
  EXPECT_EQ(repair(mesh, uv).uv, first);
  for(const unsigned int threads : {2u, 3u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    EXPECT_EQ(repair(mesh, uv).uv, first);
  }
}

// A grid of 96,800 triangles under a map that winds twice around two points, each within a face. No
// map without flips has these values around a patch, unless it winds twice around a vertex.
Parameters winding_twice(const Indexed_triangle_mesh& mesh, double side)
{
  const Complex c(0.2637, 0.15), d(-0.4551, 0.2078);
  return map_of(mesh, [&](Complex w) {
    const Complex z = 2. * w / side - Complex(1., 1.);
    return z * z * z / 3. - (c + d) * z * z / 2. + c * d * z; // the derivative is (z - c) (z - d)
  });
}

TEST(Repair, of_a_map_that_winds_twice_takes_the_smallest_patches)
{
  const Indexed_triangle_mesh mesh = grid(220, 220);
  const Parameters uv = winding_twice(mesh, 220.);
  ASSERT_EQ(bad_faces(mesh, uv).size(), 2u);
  // There is no try of larger ones, for which there would be no effort
  Flip_repair_options options;
  options.effort = 1e4;
  const Repaired repaired = repair(mesh, uv, {}, options);
  EXPECT_EQ(error_in_repair(mesh, uv, {}, repaired), "");
  EXPECT_EQ(repaired.report.branch_vertices, 2u);
  EXPECT_EQ(repaired.report.unmended_faces.size(), 0u);
  EXPECT_LT(repaired.report.moved_vertices, 100u);
  EXPECT_FALSE(repaired.report.stopped_early);
  EXPECT_EQ(repaired.uv, repair(mesh, uv).uv);
}

TEST(Turns_of_border, tell_whether_there_is_a_map_without_flips)
{
  namespace internal = SMP::internal;
  const Indexed_triangle_mesh mesh = grid(40, 40);
  const std::vector<bool> is_fixed(mesh.points.size(), false);
  internal::Flip_patch_finder finder(mesh.triangles, is_fixed);
  const auto turns = [&](const Complex& centre, int rings, const auto& map) {
    const Parameters uv = map_of(mesh, map);
    std::uint32_t nearest = 0;
    for(std::uint32_t v = 0; v < mesh.points.size(); ++v)
      if(std::abs(Complex(mesh.points[v].x(), mesh.points[v].y()) - centre)
         < std::abs(Complex(mesh.points[nearest].x(), mesh.points[nearest].y()) - centre))
        nearest = v;
    std::uint32_t face = 0;
    while(mesh.triangles[face][0] != nearest)
      ++face;
    return internal::turns_of_border(finder.patches_around({face}, rings).at(0), mesh.triangles, uv);
  };
  const Complex c(20.3, 19.6);
  const auto square = [&c](Complex w) { return (w - c) * (w - c); };
  EXPECT_EQ(turns(c, 2, square), 2);
  EXPECT_EQ(turns(c, 8, square), 2);
  EXPECT_EQ(turns({10., 30.}, 3, square), 1);
  EXPECT_EQ(turns(c, 3, [&](Complex w) { return (w - c) * (w - c) * (w - c); }), 3);
  EXPECT_EQ(turns(c, 3, [](Complex w) { return std::conj(w); }), -1);
  EXPECT_EQ(turns({1., 20.}, 2, square), std::nullopt); // on the border
}

// Around a hole the border of a patch tells nothing, so that larger and larger patches are tried.
TEST(Repair, has_a_bounded_effort)
{
  Indexed_triangle_mesh mesh = grid(220, 220);
  Parameters uv = winding_twice(mesh, 220.);
  std::vector<bool> is_kept(mesh.points.size(), true);
  for(const std::size_t bad : bad_faces(mesh, uv))
    is_kept[mesh.triangles[bad][0] + 5] = false; // a hole beside it
  Parameters kept;
  for(std::size_t v = 0; v < uv.size(); ++v)
    if(is_kept[v])
      kept.push_back(uv[v]);
  mesh = without_vertices(mesh, is_kept);
  ASSERT_EQ(bad_faces(mesh, kept).size(), 2u);
  const Repaired usual = repair(mesh, kept);
  EXPECT_EQ(error_in_repair(mesh, kept, {}, usual), "");
  EXPECT_EQ(usual.report.unmended_faces.size(), 0u);
  EXPECT_FALSE(usual.report.stopped_early);
  Flip_repair_options options;
  options.effort = 1.;
  const Repaired none = repair(mesh, kept, {}, options);
  EXPECT_EQ(error_in_repair(mesh, kept, {}, none), "");
  EXPECT_EQ(none.report.unmended_faces.size(), 2u);
  EXPECT_TRUE(none.report.stopped_early);
}

} // namespace flip_repair_test
