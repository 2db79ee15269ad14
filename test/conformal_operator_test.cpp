// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The conformal energy of a triangle and its matrix, by derivations that share no formula with the
// library: gradients from the metric, angles from the law of cosines, singular values by a matrix
// decomposition.

#include <support/dense_multigrid.h>

#include <support/chart_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/coarse_cotangents.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace conformal_operator_test {

using namespace test_support;
using CGAL::Indexed_mesh::normalize;
using CGAL::Surface_mesh_parameterization::Conformal_operator;
using CGAL::Surface_mesh_parameterization::conformal_operator;
using CGAL::Surface_mesh_parameterization::Conformal_triangle;

typedef std::complex<double> Complex;
typedef std::array<Complex, 3> Corner_values;

struct Spatial_triangle
{
  std::string kind;
  Point_3 p[3];
};

Point_3 random_point(Random_numbers& random)
{
  const double x = random.real(), y = random.real();
  return Point_3(x, y, random.real());
}

// Random ones, obtuse ones and needles of height 1e-5, in three dimensions
std::vector<Spatial_triangle> triangles()
{
  Random_numbers random(1);
  std::vector<Spatial_triangle> result;
  for(int i = 0; i < 50; ++i) {
    const Point_3 a = random_point(random), b = random_point(random), c = random_point(random);
    result.push_back({"random", {a, b, c}});
    const Point_3 middle = CGAL::barycenter(a, 0.45, b, 0.55);
    result.push_back({"obtuse", {a, middle + 0.02 * (c - a), b}});
    result.push_back({"cap", {middle + 1e-5 * (c - a), b, a}});
    result.push_back({"needle", {a, a + 1e-5 * (c - a), b}});
  }
  return result;
}

Corner_values random_values(Random_numbers& random)
{
  const Complex a = random.complex(), b = random.complex();
  return {a, b, random.complex()};
}

double signed_area(const Corner_values& z)
{
  return 0.5 * std::imag(std::conj(z[1] - z[0]) * (z[2] - z[0]));
}

// The metric of the triangle in the coordinates of its edges from corner 0.
Eigen::Matrix2d metric(const Spatial_triangle& t)
{
  const auto e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0];
  return (Eigen::Matrix2d() << e1 * e1, e1 * e2, e1 * e2, e2 * e2).finished();
}

// 1/2 of the integral of |grad u|^2 + |grad v|^2
double dirichlet_energy(const Spatial_triangle& t, const Corner_values& z)
{
  const Eigen::Matrix2d g = metric(t);
  const Eigen::Vector2cd d(z[1] - z[0], z[2] - z[0]);
  const Eigen::Matrix2d adjugate
    = (Eigen::Matrix2d() << g(1, 1), -g(0, 1), -g(1, 0), g(0, 0)).finished();
  return 0.25 * (d.adjoint() * adjugate * d).value().real() / std::sqrt(g.determinant());
}

// The Jacobian of the map from the plane of the triangle, in an orthonormal frame.
Eigen::Matrix2d jacobian(const Spatial_triangle& t, const Corner_values& z)
{
  const Eigen::Matrix2d frame = metric(t).llt().matrixU(); // columns: the edges
  Eigen::Matrix2d images;
  images << (z[1] - z[0]).real(), (z[2] - z[0]).real(), (z[1] - z[0]).imag(), (z[2] - z[0]).imag();
  return images * frame.inverse();
}

Conformal_triangle conformal(const Spatial_triangle& t)
{
  return Conformal_triangle(t.p[0], t.p[1], t.p[2]);
}

// How far formulas with differences of squares may be off: needles of aspect 1e5 lose 10 to 12
// digits of the metric's determinant.
double tolerance_of(const Spatial_triangle& t)
{
  return t.kind == "needle" || t.kind == "cap" ? 2e-4 : 1e-10;
}

TEST(Conformal_triangle, energy_is_dirichlet_minus_area)
{
  Random_numbers random(2);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const double dirichlet = dirichlet_energy(t, z);
    EXPECT_NEAR(conformal(t).energy(z), dirichlet - signed_area(z), tolerance_of(t) * dirichlet)
      << t.kind;
  }
}

TEST(Conformal_triangle, energy_is_that_of_the_singular_values)
{
  Random_numbers random(3);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const Eigen::Matrix2d j = jacobian(t, z);
    const Eigen::Vector2d sigma = j.jacobiSvd().singularValues();
    const double difference = sigma(0) - (j.determinant() < 0. ? -sigma(1) : sigma(1));
    const double area = 0.5 * std::sqrt(metric(t).determinant());
    EXPECT_NEAR(conformal(t).energy(z), 0.5 * difference * difference * area,
                tolerance_of(t) * sigma(0) * sigma(0) * area) << t.kind;
  }
}

// |sum W_j z_j|^2 / 8A with edge vectors that are laid out by lengths and angles
TEST(Conformal_triangle, energy_is_the_formula_of_ray_and_levy)
{
  Random_numbers random(4);
  for(const Spatial_triangle& t : triangles()) {
    const Corner_values z = random_values(random);
    const double a = std::sqrt(CGAL::squared_distance(t.p[0], t.p[1])),
                 b = std::sqrt(CGAL::squared_distance(t.p[0], t.p[2]));
    const double angle = angle_at_first({t.p[0], t.p[1], t.p[2]}, {0, 1, 2});
    const Complex q[3] = {0., a, std::polar(b, angle)};
    const double area = 0.5 * a * b * std::sin(angle);
    Complex sum = 0.;
    for(int j = 0; j < 3; ++j)
      sum += (q[(j + 2) % 3] - q[(j + 1) % 3]) * z[j];
    const double expected = std::norm(sum) / (8. * area);
    EXPECT_NEAR(conformal(t).energy(z), expected,
                tolerance_of(t) * (expected + std::abs(signed_area(z)))) << t.kind;
    EXPECT_NEAR(conformal(t).area(), area, 1e-9 * area) << t.kind;
  }
}

// For z = alpha w + beta conj(w) the derivatives are 2 |alpha| and 2 |beta|.
TEST(Conformal_triangle, derivatives)
{
  Random_numbers random(5);
  for(const Spatial_triangle& t : triangles()) {
    const Eigen::Matrix2d frame = metric(t).llt().matrixU();
    const Complex alpha = random.complex(), beta = random.complex(), shift = 10. * random.complex();
    Corner_values z = {shift, 0., 0.};
    for(int j : {0, 1}) {
      const Complex w(frame(0, j), frame(1, j));
      z[j + 1] = shift + alpha * w + beta * std::conj(w);
    }
    const double scale = std::abs(alpha) + std::abs(beta);
    const double tolerance = t.kind == "needle" || t.kind == "cap" ? 1e-3 : 1e-8;
    EXPECT_NEAR(std::abs(conformal(t).holomorphic_derivative(z)), 2. * std::abs(alpha),
                tolerance * scale) << t.kind;
    EXPECT_NEAR(std::abs(conformal(t).antiholomorphic_derivative(z)), 2. * std::abs(beta),
                tolerance * scale) << t.kind;
  }
}

TEST(Conformal_triangle, cotangents)
{
  for(const Spatial_triangle& t : triangles())
    for(int j = 0; j < 3; ++j) {
      const double angle = angle_at_first({t.p[j], t.p[(j + 1) % 3], t.p[(j + 2) % 3]}, {0, 1, 2});
      EXPECT_NEAR(conformal(t).cotangent(j) * std::tan(angle), 1., 1e-7) << t.kind;
    }
}

TEST(Conformal_triangle, energy_of_a_similarity_is_0)
{
  Random_numbers random(6);
  for(int trial = 0; trial < 50; ++trial) {
    const Complex a = random.complex(), b = random.complex();
    Corner_values z;
    Spatial_triangle t{"planar", {}};
    for(int j = 0; j < 3; ++j) {
      const Complex w = random.complex();
      t.p[j] = Point_3(w.real(), w.imag(), 0.);
      z[j] = a * w + b;
    }
    if(CGAL::cross_product(t.p[1] - t.p[0], t.p[2] - t.p[0]).z() < 0.) {
      std::swap(t.p[1], t.p[2]);
      std::swap(z[1], z[2]);
    }
    EXPECT_LE(conformal(t).energy(z), 1e-24 * std::norm(a)) << trial;
  }
}

TEST(Conformal_triangle, without_area_is_mollified)
{
  const Point_3 a(0, 0, 0), b(1, 0, 0), middle(0.4, 0, 0);
  for(const auto& t : {Conformal_triangle(a, b, middle), Conformal_triangle(a, a, b),
                       Conformal_triangle(b, a, a), Conformal_triangle(a, a, a)}) {
    EXPECT_TRUE(t.is_mollified());
    EXPECT_GT(t.area(), 0.);
    for(int j = 0; j < 3; ++j)
      EXPECT_TRUE(std::isfinite(t.cotangent(j)));
    // cot A cot B + cot B cot C + cot C cot A = 1 holds for every triangle and no other numbers.
    const double x = t.cotangent(0), y = t.cotangent(1), z = t.cotangent(2);
    const double largest = (std::max)({std::abs(x * y), std::abs(y * z), std::abs(z * x), 1.});
    EXPECT_NEAR((x * y + y * z + z * x) / largest, 1. / largest, 1e-9);
  }
  EXPECT_FALSE(Conformal_triangle(a, b, Point_3(0.4, 1e-8, 0)).is_mollified());
}

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

std::vector<bool> no_pins(const Indexed_triangle_mesh& mesh)
{
  return std::vector<bool>(mesh.points.size(), false);
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
      EXPECT_LE((to_dense(op.matrix) - expected).norm(), 1e-13 * expected.norm()) << name;
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

// --- The metric that coarse levels take from the finest

using CGAL::Surface_mesh_parameterization::internal::assemble_conformal_operator;
using CGAL::Surface_mesh_parameterization::internal::Half_cotangents;

// A hierarchy of a mesh and, for each of its levels, cotangents that begin with those of `metric`,
// a mesh of the same triangles.
struct Metric_hierarchy
{
  std::vector<CGAL::Surface_mesh_multiresolution::Mesh_level> levels;
  std::vector<Half_cotangents> cotangents;

  Metric_hierarchy(Indexed_triangle_mesh mesh, const Indexed_triangle_mesh& metric,
                   CGAL::Surface_mesh_multiresolution::Prolongation_rule rule)
  {
    namespace SMM = CGAL::Surface_mesh_multiresolution;
    namespace SMP = CGAL::Surface_mesh_parameterization;
    SMM::Flat_collapse_options decimation;
    decimation.target_vertices = mesh.points.size() / 40;
    const auto pm = SMM::Flat_collapse_engine<>(mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), {})
                      .run(decimation);
    SMM::Hierarchy_options options;
    options.coarsest_size = decimation.target_vertices;
    options.rule = rule;
    levels = SMM::build_hierarchy(std::move(mesh), pm, options);
    cotangents.resize(levels.size());
    cotangents.back() = Half_cotangents(metric);
    for(std::size_t l = levels.size() - 1; l > 0; --l)
      cotangents[l - 1] = SMP::internal::coarse_cotangents(
        {{levels[l].mesh, corners(l)}, cotangents[l]}, {levels[l - 1].mesh, corners(l - 1)},
        levels[l].from_coarser);
  }

  CGAL::Indexed_mesh::Triangles_at_vertices corners(std::size_t l) const
  {
    return {levels[l].mesh.triangles, levels[l].vertices.size()};
  }
};

const auto prolongation_rules = {CGAL::Surface_mesh_multiresolution::Prolongation_rule::WALK,
                                 CGAL::Surface_mesh_multiresolution::Prolongation_rule::VSPLIT};

// In a plane there is one metric, however the levels triangulate it: also one that is not that of
// the points.
TEST(Coarse_metric, is_exact_in_a_plane)
{
  for(const auto& [name, mesh] : planar_charts(21))
    for(const double stretch : {1., 3.})
      for(const auto rule : prolongation_rules) {
        const auto stretched = [stretch](const Indexed_triangle_mesh& m) {
          return moved(m, [stretch](const Point_3& p) {
            return Point_3(stretch * p.x(), p.y(), p.z());
          });
        };
        const Metric_hierarchy hierarchy(mesh, stretched(mesh), rule);
        for(std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
          const Half_cotangents expected(stretched(hierarchy.levels[l].mesh));
          ASSERT_EQ(hierarchy.cotangents[l].value.size(), expected.value.size());
          for(std::size_t i = 0; i < expected.value.size(); ++i)
            EXPECT_NEAR(hierarchy.cotangents[l].value[i], expected.value[i],
                        1e-8 * (1. + std::abs(expected.value[i]))) << name << ", level " << l;
        }
      }
}

// The energy of a triangle, D - |A|, is not negative if c_1 c_2 + c_2 c_3 + c_3 c_1 >= 1 for its
// cotangents; halves of them are stored. Equality holds for the angles of a triangle.
TEST(Coarse_metric, makes_no_energy_negative)
{
  for(const auto& [name, mesh] : curved_charts(22)) {
    Indexed_triangle_mesh normalized = mesh;
    normalize(normalized);
    for(const auto rule : prolongation_rules) {
      const Metric_hierarchy hierarchy(normalized, normalized, rule);
      for(const Half_cotangents& cot : hierarchy.cotangents)
        for(std::size_t i = 0; i < cot.value.size(); i += 3) {
          const double a = cot.value[i], b = cot.value[i + 1], c = cot.value[i + 2];
          const double rounding = 1e-12 * (a * a + b * b + c * c);
          EXPECT_GE(a * b + b * c + c * a, 0.25 - rounding) << name;
          EXPECT_GT(a + b + c, 0.) << name;
        }
    }
  }
}

// What the metric is for: on a noisy surface the minimiser of a coarse level is mostly a better
// start for the fine one.
TEST(Coarse_metric, brings_the_minimiser_of_a_coarse_level_closer_to_the_fine_one)
{
  double product = 1.;
  for(std::uint64_t seed = 31; seed < 41; ++seed) {
    const Indexed_triangle_mesh hills = with_hills(irregular_grid(70, 50, seed), 12., seed + 1);
    Indexed_triangle_mesh mesh = with_noise(hills, 0.3, seed + 2);
    normalize(mesh);
    const Metric_hierarchy hierarchy(mesh, mesh,
                                     CGAL::Surface_mesh_multiresolution::Prolongation_rule::WALK);
    const std::size_t l = hierarchy.levels.size() - 2;
    const auto& coarse = hierarchy.levels[l];
    const auto fine_energy_of_minimiser = [&](const Half_cotangents& cot) {
      auto op = assemble_conformal_operator<double>(coarse.mesh.triangles, hierarchy.corners(l),
                                                    cot, {});
      CGAL::Multigrid::Complex_vector<double> z(coarse.vertices.size()), f(z.size()), x, fine;
      z.back() = 1.;
      op.pin(0);
      op.pin(std::uint32_t(z.size() - 1));
      op.matrix.for_each_row_sum(z, [&](std::size_t i, Complex sum) { f[i] = -sum; });
      CGAL::Multigrid::Sparse_cholesky<> solver;
      EXPECT_TRUE(solver.factorize(op.matrix));
      solver.solve(f, x);
      x.back() = 1.;
      hierarchy.levels[l + 1].from_coarser.prolongate(x, fine);
      return conformal_operator<double>(mesh, no_pins(mesh)).energy(fine);
    };
    const double ratio = fine_energy_of_minimiser(hierarchy.cotangents[l])
                       / fine_energy_of_minimiser(Half_cotangents(coarse.mesh));
    EXPECT_LT(ratio, 1.1) << "seed " << seed;
    product *= ratio;
  }
  EXPECT_LT(std::pow(product, 0.1), 0.95);
}

} // namespace conformal_operator_test
