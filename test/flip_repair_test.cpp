// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate on maps made by hand, the derivatives of the untangling energy by differences,
// and the repair of tangled maps: what it promises, as a function that returns what is wrong.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace flip_repair_test {

using namespace test_support;
using SMP::Conformal_method;
using SMP::Conformal_weights;
using SMP::Flip_repair_options;
using SMP::Flip_repair_report;
using SMP::Map_certificate;

typedef std::complex<double> Complex;
typedef Surface_mesh::Face_index Face_index;

Parameters identity(const Indexed_triangle_mesh& mesh)
{
  return map_of(mesh, [](Complex w) { return w; });
}

// --- Certificate

struct Certified
{
  Map_certificate certificate;
  std::vector<Face_index> flipped, degenerate;
  std::vector<std::pair<Face_index, Face_index>> overlapping;
};

Certified certify(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  const Uv_map uvmap = to_uv_map(mesh, uv);
  Certified result;
  result.certificate = SMP::certify_map(mesh, uvmap);
  SMP::flipped_faces(mesh, uvmap, std::back_inserter(result.flipped));
  SMP::degenerate_faces(mesh, uvmap, std::back_inserter(result.degenerate));
  SMP::overlapping_faces(mesh, uvmap, std::back_inserter(result.overlapping));
  EXPECT_EQ(result.certificate.flipped_faces, result.flipped.size());
  EXPECT_EQ(result.certificate.degenerate_faces, result.degenerate.size());
  EXPECT_EQ(result.certificate.overlaps, !result.overlapping.empty());
  return result;
}

std::vector<Face_index> face_indices(const std::vector<Vertex_index>& positions)
{
  return std::vector<Face_index>(positions.begin(), positions.end());
}

TEST(Certificate, of_planar_charts)
{
  for(const auto& [name, mesh] : planar_charts(1)) {
    const Certified c = certify(mesh, identity(mesh));
    EXPECT_TRUE(c.certificate.is_one_to_one()) << name;
  }
}

TEST(Certificate, of_a_mirrored_map)
{
  const auto mesh = irregular_grid(6, 5, 1);
  const Certified c = certify(mesh, map_of(mesh, [](Complex w) { return std::conj(w); }));
  EXPECT_EQ(c.flipped.size(), mesh.triangles.size());
  EXPECT_TRUE(c.overlapping.empty()); // it does not meet itself
  EXPECT_FALSE(c.certificate.is_one_to_one());
}

TEST(Certificate, of_one_flipped_triangle)
{
  const auto mesh = without_vertices(grid(1, 1), {true, true, false, true});
  EXPECT_TRUE(certify(mesh, {0., 1., {1., 1.}}).certificate.is_one_to_one());
  const Certified c = certify(mesh, {0., {1., 1.}, 1.});
  EXPECT_EQ(c.flipped, face_indices({0}));
  EXPECT_TRUE(c.overlapping.empty());
  EXPECT_FALSE(c.certificate.is_one_to_one());
}

// The square's second triangle lies on the first one.
TEST(Certificate, of_a_fold_along_an_edge)
{
  const auto mesh = grid(1, 1); // (0, 1, 3), (0, 3, 2)
  const Certified c = certify(mesh, {0., 1., {1., 0.2}, {1., 1.}});
  EXPECT_EQ(c.flipped, face_indices({1}));
  ASSERT_EQ(c.overlapping.size(), 1u);
  EXPECT_EQ(c.overlapping[0], std::make_pair(Face_index(0u), Face_index(1u)));
}

TEST(Certificate, of_degenerate_faces)
{
  const auto mesh = grid(1, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(certify(mesh, {0., 1., {0.5, 0.5}, {1., 1.}}).degenerate, face_indices({1}));
  EXPECT_EQ(certify(mesh, {0., 1., {nan, 0.5}, {1., 1.}}).degenerate, face_indices({1}));
  EXPECT_EQ(certify(mesh, {0., 0., 0., 0.}).degenerate, face_indices({0, 1}));
  // By less than any rounded formula sees
  const double below = std::nextafter(0.5, 0.);
  EXPECT_TRUE(certify(mesh, {0., 1., {below, 0.5}, {1., 1.}}).certificate.is_one_to_one());
  EXPECT_EQ(certify(mesh, {0., 1., {0.5, below}, {1., 1.}}).flipped, face_indices({1}));
}

// A hub outside its link: the faces between are flipped.
TEST(Certificate, of_an_inverted_star)
{
  const auto mesh = fan(12);
  Parameters uv = identity(mesh);
  uv[0] = {1.5, 0.1};
  const Certified c = certify(mesh, uv);
  EXPECT_GT(c.flipped.size(), 0u);
  EXPECT_LT(c.flipped.size(), 12u);
  EXPECT_TRUE(c.certificate.overlaps);
}

// All faces positive, but the star winds twice: only overlap shows it.
TEST(Certificate, of_a_double_cover)
{
  const auto mesh = fan(12);
  const Certified c = certify(mesh, map_of(mesh, [](Complex w) { return w * w; }));
  EXPECT_TRUE(c.flipped.empty());
  EXPECT_TRUE(c.degenerate.empty());
  for(Vertex_index i = 0; i < 6; ++i) { // face i lies on face i + 6
    const std::pair<Face_index, Face_index> pair{Face_index(i), Face_index(i + 6)};
    EXPECT_TRUE(std::binary_search(c.overlapping.begin(), c.overlapping.end(), pair)) << i;
  }
}

TEST(Certificate, of_a_spiral)
{
  const auto ribbon = with_slivers(grid(100, 3), 3.);
  const auto spiral = [&](double growth) {
    return map_of(ribbon, [=](Complex w) {
      const double part = w.real() / 100.;
      return std::polar(5. - w.imag() + growth * 1.3 * part, 2.6 * CGAL_PI * part);
    });
  };
  EXPECT_TRUE(certify(ribbon, spiral(1.5)).certificate.is_one_to_one());
  const Certified c = certify(ribbon, spiral(0.9));
  EXPECT_TRUE(c.flipped.empty());
  EXPECT_TRUE(c.certificate.overlaps);
}

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

struct Repaired
{
  Flip_repair_report report;
  Parameters uv;
};

Repaired repair(const Indexed_triangle_mesh& arrays, const Parameters& uv,
                const std::vector<std::size_t>& pins = {},
                const Flip_repair_options& options = Flip_repair_options())
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  Uv_map uvmap = to_uv_map(mesh, uv);
  auto is_pinned = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("pinned", false).first;
  for(const std::size_t v : pins)
    is_pinned[Surface_mesh::Vertex_index(Vertex_index(v))] = true;
  Repaired result;
  result.report = SMP::repair_flipped_faces(mesh, uvmap, is_pinned, options);
  result.uv = parameters(mesh, uvmap);
  return result;
}

std::vector<std::size_t> bad_faces(const Indexed_triangle_mesh& mesh, const Parameters& uv)
{
  const Certified c = [&] {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Uv_map uvmap = to_uv_map(surface_mesh, uv);
    Certified result;
    SMP::flipped_faces(surface_mesh, uvmap, std::back_inserter(result.flipped));
    SMP::degenerate_faces(surface_mesh, uvmap, std::back_inserter(result.degenerate));
    return result;
  }();
  std::vector<std::size_t> result(c.flipped.begin(), c.flipped.end());
  result.insert(result.end(), c.degenerate.begin(), c.degenerate.end());
  std::sort(result.begin(), result.end());
  return result;
}

// For each vertex its number of edges from the nearest of the faces.
std::vector<int> distances_from(const Indexed_triangle_mesh& mesh,
                                const std::vector<std::size_t>& faces)
{
  constexpr int far = 1 << 20;
  std::vector<int> distance(mesh.points.size(), far);
  std::vector<Vertex_index> queue;
  const auto reach = [&](Vertex_index v, int d) {
    if(distance[v] == far) {
      distance[v] = d;
      queue.push_back(v);
    }
  };
  for(const std::size_t f : faces)
    for(const Vertex_index v : mesh.triangles[f])
      reach(v, 0);
  const auto neighbors = neighbors_of(mesh);
  for(std::size_t i = 0; i < queue.size(); ++i)
    for(const Vertex_index w : neighbors[queue[i]])
      reach(w, distance[queue[i]] + 1);
  return distance;
}

double energy_of_map(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  return energy_of(mesh, uv, Conformal_weights::EXACT);
}

// What is wrong with a repair, or an empty string.
std::string error_in_repair(const Indexed_triangle_mesh& mesh, const Parameters& before,
                            const std::vector<std::size_t>& pins, const Repaired& after)
{
  const auto bad_before = bad_faces(mesh, before), bad_after = bad_faces(mesh, after.uv);
  const Flip_repair_report& r = after.report;
  if(r.flipped_before + r.degenerate_before != bad_before.size())
    return "flips before are miscounted";
  if(r.flipped_after + r.degenerate_after != bad_after.size() || r.unmended_faces != bad_after)
    return "flips after are miscounted";
  if(!std::includes(bad_before.begin(), bad_before.end(), bad_after.begin(), bad_after.end()))
    return "a face was flipped";
  for(const std::size_t v : pins)
    if(after.uv[v] != before[v])
      return "a pin has moved";
  const auto distance = distances_from(mesh, bad_before);
  std::size_t moved = 0;
  for(std::size_t v = 0; v < before.size(); ++v) {
    moved += after.uv[v] != before[v] ? 1 : 0;
    if(after.uv[v] != before[v] && distance[v] > Flip_repair_options().last_rings)
      return "a vertex far away has moved";
  }
  if(moved != r.moved_vertices)
    return "moved vertices are miscounted";
  const double scale = r.energy_before + r.energy_after;
  if(std::fabs(r.energy_before - energy_of_map(mesh, before)) > 1e-9 * scale
     || std::fabs(r.energy_after - energy_of_map(mesh, after.uv)) > 1e-9 * scale)
    return "an energy is wrong";
  return {};
}

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

// --- As part of the parameterizer

// A rough surface: its least squares conformal map has flips.
Indexed_triangle_mesh rough_chart(std::uint64_t seed)
{
  return with_noise(with_hills(irregular_grid(40, 30, seed), 8., seed + 1), 0.45, seed + 2);
}

// Angles at inner vertices with sums of far more than 2 pi, around which a conformal map winds
// twice
TEST(Repair, makes_no_branch_points)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto mesh = with_noise(irregular_grid(30, 30, seed), 5., seed + 1);
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.repair_flips = SMP::Flip_repairer();
    const Outcome run = parameterize(surface_mesh, options);
    const Flip_repair_report& r = *run.report.flip_repair;
    std::cout << "seed " << seed << ": " << r.flipped_before << " -> " << r.flipped_after
              << ", energy +" << 100. * (r.energy_after / r.energy_before - 1.) << " %\n";
    EXPECT_GT(r.flipped_before, 20u); // or this test would not test anything
    EXPECT_TRUE(r.unmended_faces.empty());
    EXPECT_EQ(r.branch_vertices, 0u);
  }
}

// The border of the patch runs around twice: without flips the map must branch in it.
TEST(Repair, branches_where_it_must)
{
  const auto mesh = disk(6, 24);
  Parameters uv = map_of(mesh, [](Complex w) { return w * w / (1. + std::abs(w)); });
  const std::size_t inner = 24 + 1;
  std::vector<std::size_t> pins; // all but the innermost circles
  for(std::size_t v = 2 * inner; v < uv.size(); ++v)
    pins.push_back(v);
  std::swap(uv[3], uv[7]);
  ASSERT_GT(bad_faces(mesh, uv).size(), 0u);
  uv[0] += Complex(0.5, 0.);
  const Repaired repaired = repair(mesh, uv, pins);
  EXPECT_EQ(error_in_repair(mesh, uv, pins, repaired), "");
  EXPECT_TRUE(repaired.report.unmended_faces.empty());
  EXPECT_TRUE(certify(mesh, repaired.uv).certificate.overlaps);
  EXPECT_LE(repaired.report.branch_vertices, 1u);
}

// Against the limit that the mended map costs at most 5 % more energy than the least one.
TEST(Repair, mends_the_maps_of_all_methods)
{
  std::size_t mended = 0;
  for(const Conformal_method method :
      {Conformal_method::HLSCM, Conformal_method::SPECTRAL, Conformal_method::DIRECT})
    for(const Conformal_weights weights :
        {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
      if(method == Conformal_method::SPECTRAL && weights == Conformal_weights::CGAL_LSCM)
        continue;
      for(std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto mesh = rough_chart(seed);
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        SMP::HLSCM_options options = with_method(method, 1e-4);
        options.weights = weights;
        options.coarsest_size = 200;
        const Outcome plain = parameterize(surface_mesh, options);
        options.repair_flips = SMP::Flip_repairer();
        const Outcome run = parameterize(surface_mesh, options);
        ASSERT_EQ(run.error, SMP::OK);
        ASSERT_TRUE(run.report.flip_repair.has_value());
        const Flip_repair_report& r = *run.report.flip_repair;
        const std::string where = run.report.method + " seed " + std::to_string(seed);
        EXPECT_EQ(r.flipped_before + r.degenerate_before, bad_faces(mesh, plain.uv).size()) << where;
        EXPECT_EQ(bad_faces(mesh, run.uv).size(), 0u) << where;
        EXPECT_LE(r.energy_after, 1.05 * r.energy_before) << where;
        EXPECT_EQ(r.energy_after, run.report.energy) << where;
        const double energy = energy_of(surface_mesh, run.uv, weights);
        EXPECT_NEAR(run.report.energy, energy, 1e-6 * energy) << where;
        for(const auto& pin : run.report.pins)
          EXPECT_EQ(run.uv[pin.vertex], Complex(pin.u, pin.v)) << where;
        mended += r.flipped_before;
      }
    }
  EXPECT_GT(mended, 10u); // or this test would not test anything
}

// What is mended by then stays so, and everything else as it was.
TEST(Repair, can_be_stopped_between_patches)
{
  const auto mesh = rough_chart(1);
  Surface_mesh surface_mesh = to_surface_mesh(mesh);
  const Outcome plain = parameterize(surface_mesh, with_method(Conformal_method::DIRECT));
  const std::size_t before = bad_faces(mesh, plain.uv).size();
  for(const int calls : {0, 1, 2}) {
    std::vector<double> parts;
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.repair_flips = [&](SMP::Map_to_repair& map, const auto& progress) {
      const std::vector<Complex> old = map.z;
      const Flip_repair_report report = SMP::Flip_repairer()(map, [&](double part) {
        parts.push_back(part);
        return progress(part) && int(parts.size()) <= calls;
      });
      EXPECT_EQ(old != map.z, report.moved_vertices > 0);
      return report;
    };
    const Outcome run = parameterize(surface_mesh, options);
    ASSERT_EQ(run.error, SMP::OK);
    const Flip_repair_report& r = *run.report.flip_repair;
    EXPECT_EQ(r.stopped_early, int(parts.size()) == calls + 1);
    EXPECT_EQ(bad_faces(mesh, run.uv), r.unmended_faces);
    for(const double part : parts)
      EXPECT_TRUE(part >= 0. && part <= 1.);
    if(calls == 0) {
      EXPECT_EQ(r.moved_vertices, 0u);
      EXPECT_EQ(run.uv, plain.uv);
      EXPECT_EQ(r.unmended_faces.size(), before);
      EXPECT_FALSE(run.report.warnings.empty());
    } else
      EXPECT_LT(r.unmended_faces.size(), before);
  }
}

TEST(Repair, obeys_the_progress_function)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
  options.repair_flips = SMP::Flip_repairer();
  std::vector<double> parts;
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  ASSERT_EQ(parameterize(mesh, options).error, SMP::OK);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.back(), 1.);
  const auto in_repair = [](double part) { return part >= 0.9; };
  EXPECT_GT(std::count_if(parts.begin(), parts.end(), in_repair), 2);
  parts.clear();
  options.progress = [&](double part) {
    parts.push_back(part);
    return std::count_if(parts.begin(), parts.end(), in_repair) < 2;
  };
  const Outcome run = parameterize(mesh, options);
  EXPECT_NE(run.error, SMP::OK);
  EXPECT_TRUE(run.report.cancelled);
  EXPECT_EQ(run.report.message, "cancelled");
}

TEST(Repair, obeys_the_time_limit)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  for(const double limit : {0., 1e-9, 1e6}) {
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.time_limit = limit;
    bool goes_on = false;
    options.repair_flips = [&](SMP::Map_to_repair&, const auto& progress) {
      goes_on = progress(0.5);
      return Flip_repair_report();
    };
    const Outcome run = parameterize(mesh, options);
    EXPECT_EQ(run.error, SMP::OK);
    EXPECT_EQ(goes_on, limit != 1e-9);
    EXPECT_EQ(run.report.stopped_early, limit == 1e-9);
  }
}

TEST(Repair, is_off_by_default)
{
  Surface_mesh mesh = to_surface_mesh(rough_chart(1));
  const Outcome run = parameterize(mesh, with_method(Conformal_method::DIRECT));
  EXPECT_FALSE(run.report.flip_repair.has_value());
}

// Slivers, and faces without area in space
TEST(Repair, mends_the_maps_of_bad_meshes)
{
  std::size_t mended = 0;
  for(const std::uint64_t seed : {3, 4})
    for(const auto& [name, mesh] : curved_charts(seed))
      for(const Conformal_weights weights :
          {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
        Surface_mesh surface_mesh = to_surface_mesh(mesh);
        SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
        options.weights = weights;
        options.repair_flips = SMP::Flip_repairer();
        const Outcome run = parameterize(surface_mesh, options);
        ASSERT_TRUE(run.report.flip_repair.has_value()) << name;
        const Flip_repair_report& r = *run.report.flip_repair;
        const std::size_t bad = r.flipped_before + r.degenerate_before;
        if(bad > 0)
          std::cout << name << " " << seed << ": " << bad << " -> " << r.unmended_faces.size()
                    << ", energy +" << 100. * (r.energy_after / r.energy_before - 1.) << " %\n";
        EXPECT_EQ(bad_faces(mesh, run.uv), r.unmended_faces) << name << " " << seed;
        EXPECT_TRUE(r.unmended_faces.empty()) << name << " " << seed;
        // CGAL's weights hardly see the triangles without area, the barrier does
        const double limit = weights == Conformal_weights::EXACT ? 1.05 : 1.1;
        EXPECT_LE(r.energy_after, limit * r.energy_before) << name << " " << seed;
        mended += bad - r.unmended_faces.size();
      }
  EXPECT_GT(mended, 10u); // or this test would not test anything
}

} // namespace flip_repair_test
