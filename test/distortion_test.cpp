// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measures on maps whose distortion is known, flips against exact integers, and the distortion
// of each face.

#include <support/conformal_maps.h>
#include <support/map_measures.h>

#include <CGAL/Surface_mesh_parameterization/face_distortion.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <vector>

namespace distortion_test {

using namespace test_support;
using namespace map_measures;
using SMP::Distortion_measures;

Distortion_measures measure(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  return test_support::measure(mesh, uv);
}

double area_of(const Indexed_triangle_mesh& mesh)
{
  double sum = 0.;
  for(const auto& t : mesh.triangles)
    sum += 0.5 * std::sqrt(CGAL::cross_product(mesh.points[t[1]] - mesh.points[t[0]],
                                               mesh.points[t[2]] - mesh.points[t[0]])
                             .squared_length());
  return sum;
}

// A rotation and a similarity of the mesh: no measure but the energy knows of them, and the energy
// does not either.
std::vector<Indexed_triangle_mesh> in_various_places(const Indexed_triangle_mesh& mesh)
{
  const CGAL::Aff_transformation_3<CGAL::Simple_cartesian<double>> rotation(
    0.36, 0.48, -0.8, -0.8, 0.6, 0., 0.48, 0.64, 0.6);
  const auto rotated = moved(mesh, [&](const Point_3& p) { return rotation.transform(p); });
  return {mesh, rotated, scaled(rotated, 1e-30), scaled(rotated, 1e30),
          translated(rotated, 1e5, -2e5, 3e5)};
}

// --- Linear maps

// All measures of the map whose Jacobian is `j` everywhere.
void expect_measures_of(const Eigen::Matrix2d& j)
{
  const Eigen::Vector2d s = j.jacobiSvd().singularValues();
  const double det = j.determinant(), area = area_of(plane());
  const Parameters uv = map_of(plane(), [&](Complex w) {
    return Complex(j(0, 0) * w.real() + j(0, 1) * w.imag() + 3.,
                   j(1, 0) * w.real() + j(1, 1) * w.imag() - 1.);
  });
  for(const auto& mesh : in_various_places(plane())) {
    const Distortion_measures d = measure(mesh, uv);
    const double ratio = s(0) / s(1), tolerance = 1e-8 * ratio;
    EXPECT_NEAR(d.conformal_energy, 0.5 * area * std::pow(s(0) - s(1), 2),
                tolerance * area * s(0) * s(0));
    EXPECT_NEAR(d.quasi_conformal_mean, ratio, tolerance * ratio);
    EXPECT_NEAR(d.quasi_conformal_99, ratio, 1e-6 * ratio);
    EXPECT_NEAR(d.quasi_conformal_max, ratio, tolerance * ratio);
    EXPECT_NEAR(d.area_scale_range, 1., tolerance);
    const double mean_square = 0.5 * (1. / (s(0) * s(0)) + 1. / (s(1) * s(1)));
    EXPECT_NEAR(d.stretch_L2, std::sqrt(mean_square * det), tolerance * ratio);
    EXPECT_NEAR(d.stretch_Linf, std::sqrt(det) / s(1), tolerance * ratio);
    EXPECT_EQ(d.flipped_faces, 0u);
    EXPECT_EQ(d.degenerate_faces, 0u);
  }
}

TEST(Measures, of_a_similarity)
{
  expect_measures_of((Eigen::Matrix2d() << 1., 0., 0., 1.).finished());
  expect_measures_of((Eigen::Matrix2d() << 30., -40., 40., 30.).finished());
  expect_measures_of((Eigen::Matrix2d() << 3e-5, -4e-5, 4e-5, 3e-5).finished());
}

TEST(Measures, of_a_map_that_doubles_u)
{
  expect_measures_of((Eigen::Matrix2d() << 2., 0., 0., 1.).finished());
  const Distortion_measures d
    = measure(plane(), map_of(plane(), [](Complex w) { return w + w.real(); }));
  EXPECT_NEAR(d.conformal_energy, 0.5 * area_of(plane()), 1e-9);
  EXPECT_NEAR(d.quasi_conformal_mean, 2., 1e-12);
  EXPECT_NEAR(d.stretch_L2, std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(d.stretch_Linf, std::sqrt(2.), 1e-12);
}

TEST(Measures, of_random_linear_maps)
{
  Random random(1);
  for(int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix2d j;
    for(double& entry : j.reshaped())
      entry = uniform(random, -1., 1.);
    if(j.determinant() < 0.)
      j.row(0) *= -1.;
    expect_measures_of(j);
  }
}

TEST(Measures, of_a_mirrored_map)
{
  const Distortion_measures d
    = measure(plane(), map_of(plane(), [](Complex w) { return std::conj(w); }));
  EXPECT_EQ(d.flipped_faces, plane().triangles.size());
  EXPECT_NEAR(d.conformal_energy, 2. * area_of(plane()), 1e-9); // (1 - (-1))^2 / 2
  EXPECT_EQ(d.quasi_conformal_max, 0.); // no face is regular
  EXPECT_EQ(d.stretch_L2, 0.);
}

// --- Maps that differ from face to face

// Separate right triangles with the legs a, a in space and s1 a, s2 a in the plane.
struct Stretched
{
  double leg, sigma_1, sigma_2;
  int number;
};

Distortion_measures measure(const std::vector<Stretched>& groups)
{
  Indexed_triangle_mesh mesh;
  Parameters uv;
  for(const auto& [leg, sigma_1, sigma_2, number] : groups)
    for(int i = 0; i < number; ++i) {
      const auto v = Vertex_index(mesh.points.size());
      mesh.triangles.push_back({v, v + 1, v + 2});
      mesh.points.insert(mesh.points.end(),
                         {Point_3(7., i, 0.), Point_3(7., i + leg, 0.), Point_3(7., i, leg)});
      const Complex corner(0.3 * i, 0.1);
      uv.insert(uv.end(), {corner, corner + sigma_1 * leg, corner + Complex(0., sigma_2 * leg)});
    }
  return measure(mesh, uv);
}

TEST(Measures, are_weighted_by_area)
{
  // Areas 1/2, 2 and 8: together 50 + 20 + 8
  const Distortion_measures d
    = measure({{1., 1., 1., 100}, {2., 3., 1., 10}, {4., 1., 0.2, 1}});
  EXPECT_NEAR(d.quasi_conformal_mean, (50. * 1. + 20. * 3. + 8. * 5.) / 78., 1e-12);
  EXPECT_NEAR(d.quasi_conformal_max, 5., 1e-12);
  EXPECT_NEAR(d.area_scale_range, 3. / 0.2, 1e-10);
  EXPECT_NEAR(d.conformal_energy, 0.5 * (20. * 4. + 8. * 0.64), 1e-10);
  const double scale = (50. + 60. + 1.6) / 78.;
  const double squares = 50. + 20. * (1. / 9. + 1.) / 2. + 8. * 26. / 2.;
  EXPECT_NEAR(d.stretch_L2, std::sqrt(scale * squares / 78.), 1e-12);
  EXPECT_NEAR(d.stretch_Linf, 5. * std::sqrt(scale), 1e-12);
}

TEST(Measures, quantile_holds_99_percent_of_the_area)
{
  // The third group is 2 % of the faces, but 0.5 % of the area.
  EXPECT_NEAR(measure({{1., 1., 1., 92}, {1., 3., 1., 7}, {0.5, 9., 1., 2}}).quasi_conformal_99,
              3., 1e-6);
  // Here it is 1 % of the faces and 13 % of the area.
  EXPECT_NEAR(measure({{1., 1., 1., 92}, {1., 3., 1., 7}, {4., 9., 1., 1}}).quasi_conformal_99,
              9., 1e-6);
}

TEST(Measures, leave_faces_without_area_out)
{
  const std::vector<Stretched> good = {{1., 1.5, 1., 10}};
  const Distortion_measures expected = measure(good);
  Indexed_triangle_mesh mesh;
  Parameters uv;
  for(int i = 0; i < 10; ++i) {
    mesh.points.insert(mesh.points.end(),
                       {Point_3(i, 0, 0), Point_3(i + 1., 0, 0), Point_3(i, 1, 0)});
    uv.insert(uv.end(), {Complex(2. * i, 0.), Complex(2. * i + 1.5, 0.), Complex(2. * i, 1.)});
  }
  // One without area in space, one without area in the plane, one with a parameter missing
  mesh.points.insert(mesh.points.end(), {Point_3(0, 9, 0), Point_3(1, 9, 0), Point_3(2, 9, 0)});
  uv.insert(uv.end(), {Complex(0., 9.), Complex(1., 9.), Complex(0., 10.)});
  mesh.points.insert(mesh.points.end(), {Point_3(0, 7, 0), Point_3(1, 7, 0), Point_3(0, 8, 0)});
  uv.insert(uv.end(), {Complex(0., 7.), Complex(1., 7.), Complex(2., 7.)});
  mesh.points.insert(mesh.points.end(), {Point_3(0, 5, 0), Point_3(1, 5, 0), Point_3(0, 6, 0)});
  uv.insert(uv.end(), {Complex(0., 5.), Complex(1., 5.), Complex(0., std::nan(""))});
  for(Vertex_index v = 0; v < mesh.points.size(); v += 3)
    mesh.triangles.push_back({v, v + 1, v + 2});
  const Distortion_measures d = measure(mesh, uv);
  EXPECT_EQ(d.flipped_faces, 0u);
  EXPECT_EQ(d.degenerate_faces, 2u);
  EXPECT_NEAR(d.quasi_conformal_mean, expected.quasi_conformal_mean, 1e-12);
  EXPECT_NEAR(d.quasi_conformal_max, expected.quasi_conformal_max, 1e-12);
  EXPECT_NEAR(d.area_scale_range, expected.area_scale_range, 1e-12);
  EXPECT_NEAR(d.stretch_L2, expected.stretch_L2, 1e-12);
  EXPECT_NEAR(d.stretch_Linf, expected.stretch_Linf, 1e-12);
  EXPECT_FALSE(has_overlap(mesh, uv));
}

TEST(Measures, of_nothing)
{
  Surface_mesh mesh;
  const Uv_map uvmap = new_uv_map(mesh);
  EXPECT_EQ(SMP::measure_distortion(mesh, uvmap).stretch_L2, 0.);
  EXPECT_FALSE(SMP::has_global_overlap(mesh, uvmap));
}

// --- The energy, by gradients

TEST(Measures, take_the_points_that_are_given)
{
  const Indexed_triangle_mesh arrays = with_hills(irregular_grid(8, 6, 1), 1., 2);
  const Parameters uv = map_of(arrays, [](std::complex<double> w) { return w * w; });
  Surface_mesh mesh = to_surface_mesh(arrays), flat = mesh;
  typedef Surface_mesh::Vertex_index Vertex;
  const auto place = flat.add_property_map<Vertex, Surface_mesh::Point>("v:place").first;
  for(const Vertex v : flat.vertices()) {
    place[v] = flat.point(v);
    flat.point(v) = Surface_mesh::Point(0., 0., 0.);
  }
  const auto np = CGAL::parameters::vertex_point_map(place).geom_traits(
    CGAL::Simple_cartesian<double>());
  const Distortion_measures expected = SMP::measure_distortion(mesh, to_uv_map(mesh, uv));
  const Distortion_measures given = SMP::measure_distortion(flat, to_uv_map(flat, uv), np);
  EXPECT_GT(expected.stretch_L2, 1.);
  EXPECT_EQ(given.stretch_L2, expected.stretch_L2);
  EXPECT_EQ(given.conformal_energy, expected.conformal_energy);
  typedef Surface_mesh::Face_index Face;
  const auto map = mesh.add_property_map<Face, SMP::Face_distortion>("f:d").first;
  const auto of_flat = flat.add_property_map<Face, SMP::Face_distortion>("f:d").first;
  EXPECT_TRUE(SMP::measure_face_distortion(mesh, to_uv_map(mesh, uv), map));
  EXPECT_TRUE(SMP::measure_face_distortion(flat, to_uv_map(flat, uv), of_flat, np));
  for(const Face f : mesh.faces())
    EXPECT_EQ(map[f].quasi_conformal, of_flat[f].quasi_conformal);
}

TEST(Measures, of_polygons_are_an_error)
{
  Surface_mesh mesh = to_surface_mesh(grid(2, 2));
  CGAL::Euler::join_face(mesh.halfedge(Surface_mesh::Vertex_index(4)), mesh);
  const Parameters uv = map_of(grid(2, 2), [](std::complex<double> w) { return w; });
  const Distortion_measures measures = SMP::measure_distortion(mesh, to_uv_map(mesh, uv));
  EXPECT_EQ(measures.status, CGAL::Indexed_mesh::Mesh_status::BAD_MESH);
  EXPECT_EQ(measures.error, "not all faces are triangles; triangulate the mesh first");
}

TEST(Energy, is_dirichlet_minus_area)
{
  Random random(2);
  for(auto mesh : {with_hills(plane(), 5., 3), with_slivers(with_hills(plane(), 5., 3), 20.)}) {
    Parameters uv = map_of(mesh, [](Complex w) { return w; });
    for(Complex& z : uv)
      z += Complex(uniform(random, -1., 1.), uniform(random, -1., 1.)); // some faces flip
    double dirichlet = 0., area = 0.;
    for(const auto& t : mesh.triangles) {
      const auto e1 = mesh.points[t[1]] - mesh.points[t[0]],
                 e2 = mesh.points[t[2]] - mesh.points[t[0]];
      const Complex d1 = uv[t[1]] - uv[t[0]], d2 = uv[t[2]] - uv[t[0]];
      const double twice = std::sqrt(CGAL::cross_product(e1, e2).squared_length());
      dirichlet += 0.25 / twice * ((e2 * e2) * std::norm(d1) + (e1 * e1) * std::norm(d2)
                                   - 2. * (e1 * e2) * (std::conj(d1) * d2).real());
      area += 0.5 * (std::conj(d1) * d2).imag();
    }
    const Distortion_measures d = measure(mesh, uv);
    EXPECT_GT(d.flipped_faces, 0u);
    EXPECT_NEAR(d.conformal_energy, dirichlet - area, 1e-10 * dirichlet);
  }
}

// --- Flips

// Orientation tests of points that lie within 2^-47 of a line (Kettner et al. 2008, figure 2),
// against integers of 128 bits.
TEST(Flips, are_exact)
{
  const double unit = 0x1p-53;
  Indexed_triangle_mesh mesh;
  Parameters uv;
  std::size_t flipped = 0, degenerate = 0, wrong_if_rounded = 0;
  for(int i = 0; i < 64; ++i)
    for(int j = 0; j < 64; ++j) {
      const double p[6] = {0.5 + i * unit, 0.5 + j * unit, 12., 12., 24., 24.};
      __int128 n[6];
      for(int k = 0; k < 6; ++k)
        n[k] = __int128(std::ldexp(p[k], 53));
      const __int128 exact = (n[2] - n[0]) * (n[5] - n[1]) - (n[4] - n[0]) * (n[3] - n[1]);
      const double rounded = (p[2] - p[0]) * (p[5] - p[1]) - (p[4] - p[0]) * (p[3] - p[1]);
      flipped += exact < 0 ? 1 : 0;
      degenerate += exact == 0 ? 1 : 0;
      wrong_if_rounded += (exact < 0) != (rounded < 0.) ? 1 : 0;
      const auto v = Vertex_index(mesh.points.size());
      mesh.triangles.push_back({v, v + 1, v + 2});
      mesh.points.insert(mesh.points.end(),
                         {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0)});
      uv.insert(uv.end(), {Complex(p[0], p[1]), Complex(p[2], p[3]), Complex(p[4], p[5])});
    }
  EXPECT_GT(wrong_if_rounded, 100u); // or this test would not test anything
  EXPECT_EQ(measure(mesh, uv).flipped_faces, flipped);
  EXPECT_EQ(measure(mesh, uv).degenerate_faces, degenerate);
  EXPECT_EQ(number_of_flipped_faces(mesh, uv), flipped);
}

TEST(Flips, are_named)
{
  const auto arrays = plane();
  Surface_mesh mesh = to_surface_mesh(arrays);
  // An inner vertex drawn across one of its neighbours' links
  const std::size_t v = 10 * 21 + 10;
  Parameters uv = map_of(arrays, [](Complex w) { return w; });
  uv[v] += Complex(2.5, 0.);
  std::vector<Surface_mesh::Face_index> flipped, expected;
  SMP::flipped_faces(mesh, to_uv_map(mesh, uv), std::back_inserter(flipped));
  for(std::size_t t = 0; t < arrays.triangles.size(); ++t) {
    const auto [a, b, c] = arrays.triangles[t];
    if((std::conj(uv[b] - uv[a]) * (uv[c] - uv[a])).imag() < 0.)
      expected.push_back(Surface_mesh::Face_index(Vertex_index(t)));
  }
  EXPECT_GE(expected.size(), 1u);
  EXPECT_EQ(flipped, expected);
  EXPECT_TRUE(has_overlap(arrays, uv));
}

std::vector<CGAL::Simple_cartesian<double>::Point_2> points_2(const Parameters& uv)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_2> result;
  for(const auto& p : uv)
    result.emplace_back(p.real(), p.imag());
  return result;
}

// Each linear map x -> (a x + b y, c x + d y) has the same singular values on all faces.
TEST(Face_distortion, is_that_of_a_linear_map)
{
  for(const double unit : {1e-160, 1., 1e160}) {
    const Indexed_triangle_mesh mesh = scaled(plane(), unit);
    for(const double ratio : {1., 1.5, 100.})
      for(const double sign : {1., -1.}) {
        std::vector<CGAL::Simple_cartesian<double>::Point_2> uv;
        for(const auto& p : mesh.points) // turned, stretched, turned
          uv.emplace_back(0.6 * ratio * (0.8 * p.x() - 0.6 * p.y())
                            - 0.8 * sign * (0.6 * p.x() + 0.8 * p.y()),
                          0.8 * ratio * (0.8 * p.x() - 0.6 * p.y())
                            + 0.6 * sign * (0.6 * p.x() + 0.8 * p.y()));
        const auto faces = SMP::measure_face_distortion(mesh, uv);
        ASSERT_EQ(faces.size(), mesh.triangles.size());
        for(const SMP::Face_distortion& face : faces) {
          EXPECT_NEAR(face.quasi_conformal, ratio, 1e-6 * ratio);
          EXPECT_NEAR(face.area_scale, sign * ratio, 1e-9 * ratio);
        }
      }
  }
}

TEST(Face_distortion, is_infinite_for_faces_without_area)
{
  Indexed_triangle_mesh mesh = grid(1, 1);
  auto uv = SMP::measure_face_distortion(mesh, {{0., 0.}, {1., 0.}, {2., 0.}, {3., 0.}});
  for(const SMP::Face_distortion& face : uv) {
    EXPECT_TRUE(std::isinf(face.quasi_conformal));
    EXPECT_EQ(face.area_scale, 0.);
  }
  for(auto& p : mesh.points)
    p = Indexed_triangle_mesh::Point_3(p.x(), 0., 0.);
  uv = SMP::measure_face_distortion(mesh, {{0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}});
  for(const SMP::Face_distortion& face : uv)
    EXPECT_TRUE(std::isinf(face.quasi_conformal) && std::isinf(face.area_scale));
  mesh.triangles[1][2] = 4;
  EXPECT_TRUE(SMP::measure_face_distortion(mesh, {{0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}}).empty());
  EXPECT_TRUE(SMP::measure_face_distortion(grid(1, 1), {{0., 0.}}).empty());
}

// A map of faces, by parameters of vertices or halfedges, whose extremes are those of all faces.
TEST(Face_distortion, is_a_map_of_the_faces_of_any_mesh)
{
  const Indexed_triangle_mesh arrays = with_hills(grid(9, 7), 1., 3);
  Surface_mesh mesh = to_surface_mesh(arrays);
  Parameters uv;
  for(const auto& p : arrays.points)
    uv.emplace_back(p.x(), p.y());
  const auto of_vertices = to_uv_map(mesh, uv);
  typedef boost::property_traits<decltype(of_vertices)>::value_type Point_2;
  const auto of_halfedges
    = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;
  for(const auto h : halfedges(mesh))
    of_halfedges[h] = get(of_vertices, target(h, mesh));
  const auto a
    = mesh.add_property_map<Surface_mesh::Face_index, SMP::Face_distortion>("f:a").first;
  const auto b
    = mesh.add_property_map<Surface_mesh::Face_index, SMP::Face_distortion>("f:b").first;
  ASSERT_TRUE(SMP::measure_face_distortion(mesh, of_vertices, a));
  ASSERT_TRUE(SMP::measure_face_distortion(mesh, of_halfedges, b));
  const auto expected = SMP::measure_face_distortion(arrays, points_2(uv));
  double worst = 1., smallest = 1e9, largest = 0.;
  for(const auto f : faces(mesh)) {
    EXPECT_EQ(a[f].quasi_conformal, b[f].quasi_conformal);
    EXPECT_EQ(a[f].area_scale, b[f].area_scale);
    EXPECT_NEAR(a[f].quasi_conformal, expected[std::size_t(f)].quasi_conformal, 1e-9);
    worst = (std::max)(worst, a[f].quasi_conformal);
    smallest = (std::min)(smallest, a[f].area_scale);
    largest = (std::max)(largest, a[f].area_scale);
  }
  const Distortion_measures all = measure(arrays, uv);
  EXPECT_NEAR(worst, all.quasi_conformal_max, 1e-9 * worst);
  EXPECT_NEAR(largest / smallest, all.area_scale_range, 1e-9 * all.area_scale_range);
}

} // namespace distortion_test
