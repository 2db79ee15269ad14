// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate on maps made by hand.

#include <support/conformal_maps.h>
#include <support/repaired_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace map_certificate_test {

using namespace test_support;
using namespace repaired_maps;

// --- Certificate

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

} // namespace map_certificate_test
