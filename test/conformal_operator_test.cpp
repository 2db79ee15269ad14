// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The matrix of the conformal energy of a mesh.

#include <support/chart_generators.h>
#include <support/dense_multigrid.h>
#include <support/mesh_properties.h>
#include <support/operator_meshes.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace conformal_operator_test {

using namespace test_support;
using namespace operator_meshes;
using CGAL::Surface_mesh_parameterization::Conformal_operator;

//
// The matrix
//

// The bounds below hold for dense matrices, so the meshes are small.
std::vector<Named_mesh> operator_meshes()
{
  const Indexed_triangle_mesh plane = irregular_grid(9, 7, 1);
  const Indexed_triangle_mesh hills = with_hills(plane, 2., 2);
  std::vector<Named_mesh> result = {
    {"triangle", without_vertices(grid(1, 1), {true, true, false, true})},
    {"strip", grid(20, 1)},
    {"plane", plane},
    {"hills", hills},
    {"obtuse", with_slivers(hills, 8.)},
    {"slivers", with_slivers(hills, 1000.)},
    {"holes", with_holes(hills, 4, 3)},
    {"jagged", with_jagged_border(hills, 0.5, 4)},
    {"wheel", fan(30)},
    {"wheel of 8", fan(8)}, // rows of up to 8 and 16 entries are made in another way
    {"wheel of 9", fan(9)},
    {"wheel of 16", fan(16)},
    {"wheel of 17", fan(17)},
    {"cylinder", cylinder(9, 6)},
    {"zero-area triangles", with_zero_area_triangles(hills, 6, 5)},
    {"duplicate points", with_duplicate_points(hills, 6, 6)},
  };
  for(Named_mesh& m : result)
    normalize(m.mesh);
  return result;
}

bool has_slivers(const std::string& name)
{
  return name == "slivers" || name == "zero-area triangles" || name == "duplicate points";
}

// The whole matrix, the rows of pins put back.
template <class Real>
Dense_matrix whole_matrix(const Conformal_operator<Real>& op)
{
  Dense_matrix h = to_dense(op.matrix);
  for(const auto& pin : op.pinned) {
    h(pin.vertex, pin.vertex) = pin.row.diagonal;
    for(const auto& entry : pin.row.entries)
      h(pin.vertex, entry.column) = Complex(entry.re, entry.im);
  }
  return h;
}

// The matrix of a triangle from its edge vectors, (H_T)_jk = conj(W_j) W_k / 4A, which uses no
// cotangent.
Dense_matrix sum_of_triangles(const Indexed_triangle_mesh& mesh, const std::vector<double>& weights)
{
  const auto n = Eigen::Index(mesh.points.size());
  Dense_matrix h = Dense_matrix::Zero(n, n);
  for(std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle_indices& t = mesh.triangles[i];
    const Conformal_triangle triangle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    // |sum W z|^2 / 8A is |d|^2 A / 2 with d = sum W z / 2A: W_j / 2A is the derivative of unit j.
    Corner_values w;
    for(int j = 0; j < 3; ++j) {
      Corner_values unit = {};
      unit[j] = 1.;
      w[j] = triangle.antiholomorphic_derivative(unit);
    }
    for(int j = 0; j < 3; ++j)
      for(int k = 0; k < 3; ++k)
        h(t[j], t[k])
          += (weights.empty() ? 1. : weights[i]) * triangle.area() * std::conj(w[j]) * w[k];
  }
  return h;
}

std::vector<double> random_weights(const Indexed_triangle_mesh& mesh, Random_numbers& random)
{
  std::vector<double> weights;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    weights.push_back(0.5 + 0.4 * random.real());
  return weights;
}

TEST(Conformal_operator, is_the_sum_of_its_triangles)
{
  Random_numbers random(7);
  for(const auto& [name, mesh] : operator_meshes())
    for(const auto& weights : {std::vector<double>(), random_weights(mesh, random)}) {
      const Dense_matrix expected = sum_of_triangles(mesh, weights);
      const auto op = conformal_operator<double>(mesh, no_pins(mesh), weights);
      // What has hardly an area multiplies the last digit, which two calls of one function may not share
      // if compilers fuse products in one of them.
      const double rounding = has_slivers(name) ? 1e-9 : 1e-13;
      EXPECT_LE((to_dense(op.matrix) - expected).norm(), rounding * expected.norm()) << name;
      const auto rounded = conformal_operator<float>(mesh, no_pins(mesh), weights);
      EXPECT_LE((to_dense(rounded.matrix) - expected).norm(), 1e-6 * expected.norm()) << name;
    }
}

TEST(Conformal_operator, is_hermitian_with_row_sums_0)
{
  Random_numbers random(8);
  for(const auto& [name, mesh] : operator_meshes())
    for(const auto& weights : {std::vector<double>(), random_weights(mesh, random)}) {
      const Dense_matrix h
        = to_dense(conformal_operator<double>(mesh, no_pins(mesh), weights).matrix);
      const double size = h.cwiseAbs().maxCoeff();
      EXPECT_LE((h - h.adjoint()).cwiseAbs().maxCoeff(), 1e-15 * size) << name;
      EXPECT_LE(h.rowwise().sum().cwiseAbs().maxCoeff(), 1e-13 * size) << name;
    }
}

// Imaginary parts only between neighbours on the border, where they are 1/2
TEST(Conformal_operator, has_its_area_term_on_the_border)
{
  for(const auto& [name, mesh] : operator_meshes()) {
    const Dense_matrix h = to_dense(conformal_operator<double>(mesh, no_pins(mesh)).matrix);
    const std::vector<bool> is_border = border_vertices_of(mesh);
    for(Eigen::Index i = 0; i < h.rows(); ++i)
      for(Eigen::Index j = 0; j < h.cols(); ++j) {
        const double im = std::abs(h(i, j).imag());
        EXPECT_TRUE(im == 0. || im == 0.5) << name;
        EXPECT_TRUE(im == 0. || (is_border[i] && is_border[j])) << name;
      }
  }
}

// E = Dirichlet energy minus the area that the borders enclose.
TEST(Conformal_operator, energy_is_dirichlet_minus_the_area_within_the_border)
{
  Random_numbers random(9);
  for(const auto& [name, mesh] : operator_meshes()) {
    if(has_slivers(name))
      continue; // mollified triangles have other lengths
    const auto op = conformal_operator<double>(mesh, no_pins(mesh));
    const Dense_vector z = random_vector(int(mesh.points.size()), random);
    double dirichlet = 0., area = 0.;
    std::map<std::pair<Vertex_index, Vertex_index>, bool> halfedges;
    for(const Triangle_indices& t : mesh.triangles) {
      dirichlet
        += dirichlet_energy({name, {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}},
                            {z(t[0]), z(t[1]), z(t[2])});
      for(int c = 0; c < 3; ++c)
        halfedges[{t[c], t[(c + 1) % 3]}] = true;
    }
    for(const auto& [h, exists] : halfedges)
      if(halfedges.count({h.second, h.first}) == 0)
        area += 0.5 * std::imag(std::conj(z(h.first)) * z(h.second));
    EXPECT_NEAR(op.energy(to_vector<double>(z)), dirichlet - area, 1e-10 * dirichlet) << name;
  }
}

TEST(Conformal_operator, energy_of_similarities_of_a_planar_mesh_is_0)
{
  Random_numbers random(10);
  for(auto& [name, mesh] : planar_charts(11)) {
    normalize(mesh);
    const auto op = conformal_operator<double>(mesh, no_pins(mesh));
    const Complex a = random.complex(), b = random.complex();
    CGAL::Multigrid::Complex_vector<double> z, unlike;
    for(const Point_3& p : mesh.points) {
      z.push_back(a * Complex(p.x(), p.y()) + b);
      unlike.push_back(a * Complex(p.x(), 2. * p.y()) + b);
    }
    EXPECT_LE(std::abs(op.energy(z)), 1e-11 * op.energy(unlike)) << name;
  }
}

// Positive semi-definite, whatever the shapes of the triangles; definite with two pins.
TEST(Conformal_operator, is_positive)
{
  Random_numbers random(11);
  for(const auto& [name, mesh] : operator_meshes())
    for(const auto& weights : {std::vector<double>(), random_weights(mesh, random)}) {
      const auto op = conformal_operator<double>(mesh, no_pins(mesh), weights);
      const Dense_matrix h = to_dense(op.matrix);
      // Rows scaled to a diagonal of 1: otherwise slivers hide all else
      const Eigen::VectorXd root = h.diagonal().real().cwiseInverse().cwiseSqrt();
      const Dense_matrix scaled = root.asDiagonal() * h * root.asDiagonal();
      const auto spectrum = Eigen::SelfAdjointEigenSolver<Dense_matrix>(scaled).eigenvalues();
      EXPECT_GE(spectrum.minCoeff(), -1e-12) << name;
      const Eigen::Index n = h.rows();
      if(n < 4)
        continue;
      const Dense_matrix free = scaled.block(1, 1, n - 2, n - 2); // the first and the last pinned
      const auto free_spectrum = Eigen::SelfAdjointEigenSolver<Dense_matrix>(free).eigenvalues();
      EXPECT_GT(free_spectrum.minCoeff(), has_slivers(name) ? 1e-12 : 1e-6) << name;
    }
}

TEST(Conformal_operator, counts_mollified_triangles)
{
  for(const auto& [name, mesh] : operator_meshes()) {
    std::size_t flat = 0;
    for(const Triangle_indices& t : mesh.triangles)
      flat += CGAL::cross_product(mesh.points[t[1]] - mesh.points[t[0]],
                                  mesh.points[t[2]] - mesh.points[t[0]]).squared_length() < 1e-24;
    EXPECT_EQ(conformal_operator<double>(mesh, no_pins(mesh)).mollified_triangles, flat) << name;
    EXPECT_EQ(flat > 0, name == "zero-area triangles" || name == "duplicate points") << name;
  }
}

TEST(Conformal_operator, does_not_depend_on_the_position_of_the_mesh)
{
  const Indexed_triangle_mesh hills = with_hills(irregular_grid(9, 7, 1), 2., 2);
  const CGAL::Aff_transformation_3<CGAL::Simple_cartesian<double>> rotation(
    0.36, 0.48, -0.8, -0.8, 0.6, 0., 0.48, 0.64, 0.6);
  Indexed_triangle_mesh plain = hills;
  normalize(plain);
  const Dense_matrix expected = to_dense(conformal_operator<double>(plain, no_pins(plain)).matrix);
  for(const double scale : {1e-30, 1., 1e30})
    for(const double shift : {0., 1e3}) {
      Indexed_triangle_mesh mesh
        = moved(hills, [&](const Point_3& p) { return rotation.transform(p); });
      mesh = scaled(translated(mesh, shift, -2. * shift, shift), scale);
      normalize(mesh);
      const auto op = conformal_operator<double>(mesh, no_pins(mesh));
      EXPECT_LE((to_dense(op.matrix) - expected).norm(), 1e-11 * expected.norm());
    }
}

TEST(Conformal_operator, keeps_the_rows_of_pins_apart)
{
  Random_numbers random(12);
  for(const auto& [name, mesh] : operator_meshes()) {
    std::vector<bool> is_pinned = no_pins(mesh);
    is_pinned.front() = is_pinned.back() = true;
    const auto op = conformal_operator<double>(mesh, is_pinned);
    ASSERT_EQ(op.pinned.size(), 2u);
    const auto free = conformal_operator<double>(mesh, no_pins(mesh));
    EXPECT_EQ(whole_matrix(op), to_dense(free.matrix)) << name;
    const Dense_matrix h = to_dense(op.matrix);
    for(const auto& pin : op.pinned) {
      EXPECT_TRUE(is_pinned[pin.vertex]);
      EXPECT_EQ(h.row(pin.vertex).norm(), 0.) << name;
    }
    const auto z = to_vector<double>(random_vector(int(mesh.points.size()), random));
    EXPECT_NEAR(op.energy(z), free.energy(z), 1e-12 * std::abs(free.energy(z))) << name;
  }
}

// However vertices were pinned and released, the operator is that of the pins which remain.
TEST(Conformal_operator, pins_can_be_released)
{
  Random_numbers random(14);
  for(const auto& [name, mesh] : operator_meshes())
    for(const auto& weights : {std::vector<double>(), random_weights(mesh, random)}) {
      std::vector<bool> is_pinned = no_pins(mesh);
      auto op = conformal_operator<double>(mesh, is_pinned, weights);
      for(int step = 0; step < 60; ++step) {
        const std::uint32_t v = std::uint32_t(random.below(mesh.points.size()));
        if(is_pinned[v])
          op.release(v);
        else
          op.pin(v);
        is_pinned[v] = !is_pinned[v];
      }
      const auto expected = conformal_operator<double>(mesh, is_pinned, weights);
      EXPECT_EQ(to_dense(op.matrix), to_dense(expected.matrix)) << name;
      EXPECT_EQ(whole_matrix(op), whole_matrix(expected)) << name;
      ASSERT_EQ(op.pinned.size(), expected.pinned.size()) << name;
      for(std::size_t i = 0; i < op.pinned.size(); ++i)
        EXPECT_EQ(op.pinned[i].vertex, expected.pinned[i].vertex) << name;
    }
}

// The whole matrix and the energy function are the same thing.
TEST(Conformal_operator, energy_is_the_quadratic_form)
{
  Random_numbers random(13);
  for(const auto& [name, mesh] : operator_meshes()) {
    const auto op = conformal_operator<double>(mesh, no_pins(mesh));
    const Dense_vector z = random_vector(int(mesh.points.size()), random);
    const double expected = 0.5 * z.dot(to_dense(op.matrix) * z).real();
    EXPECT_NEAR(op.energy(to_vector<double>(z)), expected, 1e-12 * std::abs(expected)) << name;
  }
}

} // namespace conformal_operator_test
