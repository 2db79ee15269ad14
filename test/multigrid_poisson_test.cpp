// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid layer on equations of its own, with real and complex values and with blocks: the
// hierarchy of a surface, its matrices by rediscretization, the cycle as preconditioner, against
// Eigen's factorization of the finest matrix. And what hierarchies print.

#include <support/dense_multigrid.h>

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Multigrid/Smoothers.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace multigrid_poisson_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace CGAL::Multigrid;
using namespace test_support;

std::vector<SMM::Mesh_level> hierarchy_of(const Indexed_triangle_mesh& mesh,
                                          std::size_t coarsest_size)
{
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = coarsest_size;
  const auto pm = SMM::Flat_collapse_engine<>(mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), {})
                    .run(decimation);
  SMM::Hierarchy_options options;
  options.coarsest_size = coarsest_size;
  return SMM::build_hierarchy(mesh, pm, options);
}

//
// Matrices of linear finite elements
//

typedef Eigen::Vector3d Gradient; // of a hat function in a triangle

// The entry of the hat functions i and j, with gradients g and h, of a triangle of area 1. At the
// points p and q:
// - the Laplacian
double stiffness(double, const Gradient& g, const Gradient& h, const Point_3&, const Point_3&)
{
  return g.dot(h);
}

// - that of a connection: functions are compared after a turn by the angle x / 100
std::complex<double> stiffness(std::complex<double>, const Gradient& g, const Gradient& h,
                               const Point_3& p, const Point_3& q)
{
  return g.dot(h) * std::polar(1., 0.01 * (p.x() - q.x()));
}

// - an elastic energy of displacements in the plane, |grad u|^2 + 2 (div u)^2
typedef Eigen::Matrix2d Block;
Block stiffness(const Block&, const Gradient& g, const Gradient& h, const Point_3&, const Point_3&)
{
  return g.dot(h) * Block::Identity() + 2. * g.head<2>() * h.head<2>().transpose();
}

double times_identity(double mass, double) { return mass; }
std::complex<double> times_identity(double mass, std::complex<double>) { return mass; }
Block times_identity(double mass, const Block&) { return mass * Block::Identity(); }

// The rows of a matrix, by column.
template <class Double>
using Rows = std::vector<std::map<std::uint32_t, Double>>;

// Adds nothing to rows and columns of pins.
template <class Double>
Rows<Double> screened_rows(const Indexed_triangle_mesh& mesh, double screening,
                           const std::vector<bool>& is_pinned)
{
  Rows<Double> rows(mesh.points.size());
  const auto vector = [](const Point_3& p, const Point_3& q) {
    return Eigen::Vector3d(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
  };
  for(const auto& t : mesh.triangles) {
    const auto point = [&](int c) { return mesh.points[t[c % 3]]; };
    const Eigen::Vector3d normal = vector(point(0), point(1)).cross(vector(point(0), point(2)));
    const double area = 0.5 * normal.norm();
    std::array<Gradient, 3> g;
    for(int c = 0; c < 3; ++c)
      g[c] = normal.cross(vector(point(c + 1), point(c + 2))) / normal.squaredNorm();
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j)
        if(!is_pinned[t[i]] && !is_pinned[t[j]]) {
          Double entry = area * stiffness(Double(), g[i], g[j], point(i), point(j));
          if(i == j)
            entry += times_identity(screening * area / 3., Double());
          const auto place = rows[t[i]].emplace(t[j], Value_traits<Double>::zero()).first;
          place->second += entry;
        }
  }
  return rows;
}

template <class Value>
Self_adjoint_matrix<Value>
matrix_of_rows(const Rows<typename Value_traits<Value>::Double>& rows)
{
  typedef typename Value_traits<Value>::Double Double;
  std::vector<std::uint32_t> lengths;
  for(const auto& row : rows)
    lengths.push_back(std::uint32_t(row.size()));
  return Matrix_builder::build_matrix<Value>(lengths, [&](std::uint32_t i, auto& row) {
    for(const auto& [j, value] : rows[i])
      if constexpr(Value_traits<Value>::is_complex) {
        if(j == i)
          row.diagonal = value.real();
        else
          row.entries.push_back({j, value.real(), value.imag()});
      } else if(j == i)
        row.diagonal = value;
      else
        row.entries.push_back({j, Double(value)});
  });
}

// The numbers of an entry are `Traits::rows` rows and columns of this matrix; pins get a diagonal.
template <class Double>
auto eigen_matrix(const Rows<Double>& rows)
{
  typedef Value_traits<Double> Traits;
  typedef typename Traits::Inner Number;
  constexpr int n = Traits::rows;
  std::vector<Eigen::Triplet<Number>> triplets;
  for(int i = 0; i < int(rows.size()); ++i) {
    for(const auto& [j, value] : rows[i])
      for(int r = 0; r < n; ++r)
        for(int c = 0; c < n; ++c)
          triplets.emplace_back(n * i + r, n * int(j) + c, Traits::coefficient(value, r, c));
    for(int r = 0; rows[i].empty() && r < n; ++r)
      triplets.emplace_back(n * i + r, n * i + r, Number(1.));
  }
  Eigen::SparseMatrix<Number> result(n * rows.size(), n * rows.size());
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

template <class V>
auto eigen_vector(const std::vector<V>& x)
{
  typedef Value_traits<V> Traits;
  constexpr int n = Traits::rows;
  Eigen::Matrix<typename Traits::Inner, Eigen::Dynamic, 1> result(n * x.size());
  for(std::size_t i = 0; i < x.size(); ++i)
    for(int r = 0; r < n; ++r)
      result(n * i + r) = Traits::coefficient(x[i], r, 0);
  return result;
}

template <class V>
std::vector<V> random_values(const std::vector<bool>& is_pinned, Random_numbers& random)
{
  typedef Value_traits<V> Traits;
  std::vector<V> x(is_pinned.size(), Traits::zero());
  for(std::size_t i = 0; i < x.size(); ++i)
    if(!is_pinned[i]) {
      std::array<typename Traits::Inner, 4> number;
      for(auto& value : number)
        if constexpr(Traits::is_complex)
          value = random.complex();
        else
          value = random.real();
      x[i] = Traits::from_coefficients(number.data());
    }
  return x;
}

//
// Solutions
//

template <class Value>
using Cholesky
  = Sparse_cholesky<Eigen::SimplicialLDLT<Eigen::SparseMatrix<typename Value_traits<Value>::Inner>>>;

// A matrix of `Value`, and the same equation on the levels below by matrices of `Level_value`.
template <class Value, class Level_value>
struct Equation
{
  typedef typename Value_traits<Value>::Double Double;

  std::vector<SMM::Mesh_level> hierarchy;
  std::vector<bool> is_pinned; // of the finest level
  Rows<Double> rows;           // of the finest level
  Self_adjoint_matrix<Value> matrix;
  std::vector<Self_adjoint_matrix<Level_value>> matrices;
  Multigrid_levels<SMM::Prolongation, Cholesky<Value>, Level_value> levels;

  // With the vertices of the border pinned, or with none.
  Equation(const Indexed_triangle_mesh& mesh, double screening, bool has_pins)
    : hierarchy(hierarchy_of(mesh, 80)), is_pinned(border_vertices_of(mesh))
  {
    if(!has_pins)
      is_pinned.assign(mesh.points.size(), false);
    for(const SMM::Mesh_level& level : hierarchy) {
      std::vector<bool> is_pinned_here;
      for(const Vertex_index v : level.vertices)
        is_pinned_here.push_back(is_pinned[v]);
      rows = screened_rows<Double>(level.mesh, screening, is_pinned_here);
      matrices.push_back(matrix_of_rows<Level_value>(rows));
    }
    matrix = matrix_of_rows<Value>(rows);
    for(std::size_t l = 0; l < matrices.size(); ++l)
      levels.add_level(matrices[l], l == 0 ? nullptr : &hierarchy[l].from_coarser);
  }
};

template <class Pair>
class Multigrid_values : public ::testing::Test
{
protected:
  typedef typename Pair::first_type Value;
  typedef typename Pair::second_type Level_value;
  typedef Value_vector<Value> Vector;

  static constexpr bool is_block = Value_traits<Value>::rows > 1;
  static constexpr double precision = 1e-7;

  static Indexed_triangle_mesh mesh()
  {
    const auto plane = irregular_grid(50, 45, 3);
    return is_block ? plane : with_hills(plane, 4., 4);
  }

  static Energy_stop stop()
  {
    Energy_stop result;
    result.tolerance = 1e-18;
    result.maximal_iterations = 1000;
    return result;
  }
};

// Other values, single precision too, are in surface_multigrid_test.
typedef ::testing::Types<
  std::pair<double, double>, std::pair<std::complex<double>, std::complex<float>>,
  std::pair<Eigen::Matrix2d, Eigen::Matrix2f>> Value_pairs;
TYPED_TEST_SUITE(Multigrid_values, Value_pairs);

TYPED_TEST(Multigrid_values, solve_a_screened_poisson_equation)
{
  typedef typename TestFixture::Value Value;
  typedef typename TestFixture::Vector Vector;
  Random_numbers random(5);
  for(const bool has_pins : {false, true})
    for(const double screening : {1., 1e-2}) {
      Equation<Value, typename TestFixture::Level_value> equation(TestFixture::mesh(), screening,
                                                                  has_pins);
      ASSERT_GE(equation.levels.number_of_levels(), 3u);
      const Vector f = random_values<typename Vector::value_type>(equation.is_pinned, random);
      const Vector zero(f.size(), Value_traits<typename Vector::value_type>::zero());
      const auto run = [&](const auto& precondition, Vector& x) {
        return minimize_energy(equation.matrix, f, x = zero, precondition, TestFixture::stop(),
                               [](double) { return true; });
      };
      Vector x = zero, y = zero;
      const auto report = run([&](const Vector& r, Vector& z) {
        EXPECT_TRUE(equation.levels.precondition(Schedule(),
                                                 equation.levels.number_of_levels() - 1, r, z));
      }, x);
      EXPECT_TRUE(report.converged);
      const auto a = eigen_matrix(equation.rows);
      const Eigen::SimplicialLDLT<std::decay_t<decltype(a)>> ldlt(a);
      const auto expected = ldlt.solve(eigen_vector(f)).eval();
      EXPECT_LE((eigen_vector(x) - expected).norm(), TestFixture::precision * expected.norm());
      const double least = -0.5 * std::real(expected.dot(eigen_vector(f)));
      EXPECT_NEAR(report.energy, least, TestFixture::precision * std::abs(least));
      // That is what the levels are for.
      EXPECT_LE(report.iterations, 25u) << "screening " << screening;
      const auto plain = run(Diagonal_preconditioner<Value>(equation.matrix), y);
      EXPECT_LT(3 * report.iterations, plain.iterations);
      for(std::size_t i = 0; i < x.size(); ++i)
        if(equation.is_pinned[i]) {
          EXPECT_EQ(x[i], zero[i]);
        }
    }
}

// Without imaginary parts the complex model does the same as the real one.
TEST(Multigrid_values, of_real_and_of_complex_numbers_agree)
{
  Random_numbers random(6);
  Equation<double, float> real(with_hills(irregular_grid(30, 30, 7), 3., 8), 0.1, true);
  std::vector<Hermitian_matrix<float>> matrices;
  for(const auto& h : real.matrices) {
    const auto slot = h.slot_of_row();
    matrices.push_back(Matrix_builder::build<float>(
      std::vector<std::uint32_t>(h.size(), 20), [&](std::uint32_t i, Matrix_row& row) {
        row.diagonal = h.diagonal()[i];
        h.for_each_entry(slot[i], [&row](std::uint32_t j, float value) {
          row.entries.push_back({j, value, 0.});
        });
      }));
  }
  Multigrid_levels<SMM::Prolongation, Sparse_cholesky<>> levels;
  for(std::size_t l = 0; l < matrices.size(); ++l)
    levels.add_level(matrices[l], l == 0 ? nullptr : &real.hierarchy[l].from_coarser);
  const auto r = random_values<double>(real.is_pinned, random);
  const Complex_vector<double> r_complex(r.begin(), r.end());
  std::vector<double> z;
  Complex_vector<double> z_complex;
  real.levels.precondition(Schedule(), levels.number_of_levels() - 1, r, z);
  levels.precondition(Schedule(), levels.number_of_levels() - 1, r_complex, z_complex);
  const Complex_vector<double> expected(z.begin(), z.end());
  EXPECT_LE(relative_error(to_dense(z_complex), to_dense(expected)), 1e-5);
}

// The best combination of up to three vectors, and that of Eigen's dense solver.
template <class Value>
void test_best_coefficients()
{
  Random_numbers random(11);
  for(int n = 1; n <= 3; ++n)
    for(int i = 0; i < 200; ++i) {
      typedef Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic> Matrix;
      const Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic> a = Matrix::Random(n, n),
                                                                 b = Matrix::Random(1, n);
      const Matrix energy = std::pow(10., 6. * random.real()) * a * a.adjoint();
      const Matrix norm = b.adjoint() * b; // of rank 1: most of a mass is 0
      Small_matrix<Value, 3> e = {}, m = {};
      for(int r = 0; r < n; ++r)
        for(int c = 0; c < n; ++c) {
          e[r][c] = energy(r, c);
          m[r][c] = norm(r, c);
        }
      const std::vector<Value> found = internal::best_coefficients(n, e, m);
      const Matrix unit = energy.diagonal().real().cwiseSqrt().cwiseInverse().asDiagonal();
      const Eigen::SelfAdjointEigenSolver<Matrix> condition(unit * energy * unit);
      if(condition.eigenvalues()(0) < 1e-9) {
        EXPECT_LE(condition.eigenvalues()(0), found.empty() ? 2e-10 : 1e-9);
        continue;
      }
      ASSERT_EQ(found.size(), std::size_t(n));
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(norm, energy);
      const double largest = solver.eigenvalues()(n - 1);
      Eigen::Matrix<Value, Eigen::Dynamic, 1> y(n);
      for(int r = 0; r < n; ++r)
        y(r) = found[r];
      EXPECT_NEAR(std::real(y.dot(norm * y)) / std::real(y.dot(energy * y)), largest,
                  1e-6 * largest);
      EXPECT_NEAR(std::abs(std::imag(y(0))), 0., 1e-12 * std::abs(y(0)));
      EXPECT_GE(std::real(y(0)), 0.);
    }
}

TEST(Rayleigh_quotient, of_few_vectors_is_the_dense_one)
{
  test_best_coefficients<double>();
  test_best_coefficients<std::complex<double>>();
}

// The least eigenvalues of the Laplacian of a closed surface whose mass is that of some vertices,
// with the constants as kernel, and those of the dense problem.
TEST(Rayleigh_quotient, of_real_values_is_the_dense_one)
{
  Random_numbers random(9);
  const auto mesh = with_noise(sphere(3), 0.01, 10);
  const std::vector<bool> no_pins(mesh.points.size(), false);
  const auto rows = screened_rows<double>(mesh, 0., no_pins);
  const auto matrix = matrix_of_rows<double>(rows);
  std::vector<Diagonal_mass::Entry> entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(mesh.points.size());
  for(std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    diagonal(i) = 1. + 0.5 * random.real();
    entries.push_back({i, diagonal(i)});
  }
  const Eigen::MatrixXd dense = eigen_matrix(rows), mass = diagonal.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense, mass);
  Sparse_cholesky<Real_factorization> shifted;
  ASSERT_TRUE(shifted.factorize(matrix_of_rows<double>(screened_rows<double>(mesh, 1., no_pins))));
  auto x = random_values<double>(no_pins, random);
  Energy_stop stop;
  stop.tolerance = 1e-12;
  const auto precondition = [&](const std::vector<double>& r, std::vector<double>& z) {
    shifted.solve(r, z);
  };
  const auto report = minimize_rayleigh_quotient(matrix, Diagonal_mass(entries), x, precondition,
                                                 stop, [](double) { return true; });
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(2. * report.energy, solver.eigenvalues()(1), 1e-6 * solver.eigenvalues()(1));
  const Eigen::VectorXd y = eigen_vector(x);
  EXPECT_NEAR(y.dot(mass * y), 1., 1e-9);
  EXPECT_LE((dense * y - 2. * report.energy * mass * y).norm(), 1e-4 * (dense * y).norm());
}

//
// Printing
//

// The words of the line of a table that begins with `name`.
std::vector<std::string> line_of(const std::string& table, const std::string& name)
{
  std::istringstream lines(table);
  for(std::string line; std::getline(lines, line);) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for(std::string word; stream >> word;)
      words.push_back(word);
    if(!words.empty() && words[0] == name)
      return words;
  }
  return {};
}

template <class Hierarchy>
std::string printed(const Hierarchy& hierarchy)
{
  std::ostringstream out;
  out.precision(3);
  out << hierarchy << 1. / 3.; // the stream is left as it was
  EXPECT_NE(out.str().find("\n0.333"), std::string::npos) << out.str();
  return out.str();
}

TEST(Printing, of_a_hierarchy_of_meshes)
{
  const auto levels = hierarchy_of(with_hills(irregular_grid(40, 30, 1), 3., 2), 60);
  ASSERT_GE(levels.size(), 3u);
  const std::string table = printed(levels);
  std::size_t vertices = 0, triangles = 0;
  for(std::size_t l = 0; l < levels.size(); ++l) {
    const auto words = line_of(table, std::to_string(l));
    ASSERT_EQ(words.size(), l == 0 ? 4u : 5u) << table;
    EXPECT_EQ(words[1], std::to_string(levels[l].vertices.size()));
    EXPECT_EQ(words[2], std::to_string(levels[l].mesh.triangles.size()));
    EXPECT_NEAR(std::stod(words[3]), 1e-6 * double(levels[l].memory()), 0.005);
    if(l > 0) {
      const double ratio
        = double(levels[l].vertices.size()) / double(levels[l - 1].vertices.size());
      EXPECT_NEAR(std::stod(words[4]), ratio, 0.005);
    }
    vertices += levels[l].vertices.size();
    triangles += levels[l].mesh.triangles.size();
  }
  const auto complexity = line_of(table, "complexity:");
  ASSERT_EQ(complexity.size(), 5u) << table;
  EXPECT_NEAR(std::stod(complexity[2]),
              double(vertices) / double(levels.back().vertices.size()), 0.005);
  EXPECT_NEAR(std::stod(complexity[4]),
              double(triangles) / double(levels.back().mesh.triangles.size()), 0.005);
}

TEST(Printing, of_levels_of_matrices)
{
  Random_numbers random(2);
  const Chain_hierarchy chain(4, random);
  std::vector<Hermitian_matrix<float>> matrices;
  for(const Dense_matrix& h : chain.matrices)
    matrices.push_back(sparse_matrix<float>(h));
  Multigrid_levels<SMM::Prolongation, Sparse_cholesky<>> levels;
  EXPECT_EQ(line_of(printed(levels), "total")[1], "0");
  for(std::size_t l = 0; l < matrices.size(); ++l)
    levels.add_level(matrices[l], l == 0 ? nullptr : &chain.prolongations[l]);
  const std::string table = printed(levels);
  double all = 0., finest = 0.;
  for(std::size_t l = 0; l < matrices.size(); ++l) {
    const auto words = line_of(table, std::to_string(l));
    ASSERT_GE(words.size(), 4u) << table;
    EXPECT_EQ(words[1], std::to_string(matrices[l].size()));
    finest = double((chain.matrices[l].array().abs() > 0.).count());
    EXPECT_EQ(std::stod(words[2]), finest);
    all += finest;
  }
  EXPECT_NEAR(std::stod(line_of(table, "complexity:")[4]), all / finest, 0.005);
}

} // namespace multigrid_poisson_test
