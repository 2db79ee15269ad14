// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the multigrid layer with real numbers and with blocks, against the dense matrix of
// their numbers.

#include <support/dense_multigrid.h>
#include <support/mesh_generators.h>

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Patch_corrections.h>
#include <CGAL/Multigrid/Smoothers.h>
#include <CGAL/Multigrid/Split_matrix.h>
#include <CGAL/Surface_mesh_multigrid/galerkin_rows.h>

#include <gtest/gtest.h>

#include <array>
#include <type_traits>

namespace multigrid_values_test {

using namespace CGAL::Multigrid;
using namespace test_support;

// A definite matrix whose entries are blocks of N x N numbers (N = 1: numbers), and its vectors.
template <class Value>
class Real_values : public ::testing::Test
{
protected:
  typedef Value_traits<Value> Traits;
  typedef typename Traits::Double Double;
  typedef Value_vector<Value> Vector;
  static constexpr int rows = Traits::rows;
  static constexpr int size = 70; // rows of blocks
  static constexpr double tolerance
    = std::is_same_v<typename Traits::Real, float> ? 1e-4 : 1e-11;
  static constexpr int pin = 11;

  Random_numbers random = Random_numbers(30);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(rows * size, rows * size);

  // Row and column of the pin are 0.
  Real_values()
  {
    for(int i = 0; i < size; ++i)
      for(int j = 0; j < i; ++j)
        if(i != pin && j != pin && random.chance(0.1))
          for(int k = 0; k < rows * rows; ++k) {
            const int r = rows * i + k / rows, c = rows * j + k % rows;
            dense(r, c) = dense(c, r) = random.real();
          }
    const Eigen::VectorXd sums = dense.cwiseAbs().rowwise().sum();
    for(int i = 0; i < rows * size; ++i)
      dense(i, i) = i / rows == pin ? 0. : sums(i) + 0.2;
    if(rows > 1) // blocks on the diagonal are not diagonal
      for(int i = 0; i < size; ++i)
        if(i != pin)
          dense(rows * i, rows * i + 1) = dense(rows * i + 1, rows * i) = 0.1;
  }

  static Double block(const Eigen::MatrixXd& a, int i, int j)
  {
    std::array<double, rows * rows> p; // by columns
    for(int k = 0; k < rows * rows; ++k)
      p[k] = a(rows * i + k % rows, rows * j + k / rows);
    return Value_traits<Double>::from_coefficients(p.data());
  }

  Self_adjoint_matrix<Value> sparse() const
  {
    return Matrix_builder::build_matrix<Value>(
      std::vector<std::uint32_t>(size, size), [&](std::uint32_t i, auto& row) {
        row.diagonal = block(dense, int(i), int(i));
        for(std::uint32_t j = 0; j < size; ++j)
          if(j != i && !Value_traits<Double>::is_zero(block(dense, int(i), int(j))))
            row.entries.push_back({j, block(dense, int(i), int(j))});
      });
  }

  template <class V>
  static Eigen::MatrixXd to_real_dense(const Self_adjoint_matrix<V>& h)
  {
    const std::uint32_t n = std::uint32_t(h.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows * n, rows * n);
    const auto put = [&a](std::uint32_t i, std::uint32_t j, const auto& value) {
      for(int k = 0; k < rows * rows; ++k)
        a(rows * i + k / rows, rows * j + k % rows)
          = Value_traits<V>::coefficient(value, k / rows, k % rows);
    };
    const auto slot = h.slot_of_row();
    for(std::uint32_t i = 0; i < n; ++i) {
      put(i, i, h.diagonal()[i]);
      h.for_each_entry(slot[i], [&](std::uint32_t j, const V& value) { put(i, j, value); });
    }
    return a;
  }

  template <class Rest>
  static Eigen::MatrixXd to_real_dense(const Split_matrix<Value, Rest>& h)
  {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows * size, rows * size);
    const auto put = [&a](std::uint32_t i, std::uint32_t j, const auto& value) {
      for(int k = 0; k < rows * rows; ++k)
        a(rows * i + k / rows, rows * j + k % rows)
          = Value_traits<Value>::coefficient(value, k / rows, k % rows);
    };
    for(std::uint32_t i = 0; i < size; ++i) {
      put(i, i, h.diagonal(i));
      h.for_each_entry(h.slot_of_row(i), [&](std::uint32_t j, const Value& value) { put(i, j, value); });
    }
    return a;
  }

  // Builds a split matrix by its rows.
  template <class Split>
  void expect_rows_make(const Split& expected)
  {
    Split split(std::vector<std::uint32_t>(size, size), [&](std::uint32_t i, auto& row) {
      std::vector<std::uint32_t> columns;
      std::vector<Double> values;
      for(std::uint32_t j = 0; j < size; ++j)
        if(j != i && !Value_traits<Double>::is_zero(block(dense, int(i), int(j)))) {
          columns.push_back(j);
          values.push_back(block(dense, int(i), int(j)));
        }
      row.set(block(dense, int(i), int(i)), columns.size(), columns.data(), values.data());
    });
    ASSERT_EQ(split.size(), expected.size());
    EXPECT_EQ(to_real_dense(split), to_real_dense(expected));
    EXPECT_EQ(to_real_dense(split.single()), to_real_dense(expected.single()));
    const Vector x = to_values(random_numbers());
    Vector y(size), z(size);
    split(x, y);
    expected(x, z);
    EXPECT_EQ(to_numbers(y), to_numbers(z));
    std::size_t entries = 0;
    for(std::uint32_t i = 0; i < size; ++i) {
      std::size_t in_row = 0;
      split.for_each_entry(split.slot_of_row()[i], [&](std::uint32_t, const Value&) { ++in_row; });
      EXPECT_LE(in_row, split.width(split.slot_of_row(i)));
      entries += in_row;
    }
    EXPECT_GT(entries, std::size_t(size));
    const auto single = split.take_single();
    EXPECT_EQ(to_real_dense(single), to_real_dense(expected.single()));
    EXPECT_EQ(split.size(), 0u);
    EXPECT_EQ(split.memory(), 0u);
  }

  // Whether each entry is right up to `error`, a part of it.
  static bool is_nearly(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double error)
  {
    return ((a - b).array().abs() <= error * b.array().abs()).all();
  }

  static Vector to_values(const Eigen::VectorXd& x)
  {
    Vector result;
    for(int i = 0; i < size; ++i)
      result.push_back(Value_traits<typename Vector::value_type>::from_coefficients(
        x.data() + rows * i));
    return result;
  }

  static Eigen::VectorXd to_numbers(const Vector& x)
  {
    Eigen::VectorXd result(rows * size);
    for(int i = 0; i < rows * size; ++i)
      result(i) = Value_traits<typename Vector::value_type>::coefficient(x[i / rows], i % rows, 0);
    return result;
  }

  Eigen::VectorXd random_numbers()
  {
    Eigen::VectorXd x(rows * size);
    for(int i = 0; i < x.size(); ++i)
      x(i) = random.real();
    return x;
  }

  // What is 0 at the pin.
  Eigen::VectorXd random_free_numbers()
  {
    Eigen::VectorXd x = random_numbers();
    x.segment(rows * pin, rows).setZero();
    return x;
  }

  // The matrix with the identity at the pin.
  Eigen::MatrixXd regular() const
  {
    Eigen::MatrixXd a = dense;
    for(int r = 0; r < rows; ++r)
      a(rows * pin + r, rows * pin + r) = 1.;
    return a;
  }
};

// Each precision and each size of blocks, which take long to compile
typedef std::conditional_t<
  is_sanitized, ::testing::Types<double, Eigen::Matrix2f, Eigen::Matrix3d>,
  ::testing::Types<float, double, Eigen::Matrix2f, Eigen::Matrix3d>> Real_value_types;
TYPED_TEST_SUITE(Real_values, Real_value_types);

TYPED_TEST(Real_values, make_the_matrix_and_its_product)
{
  const auto h = this->sparse();
  EXPECT_LE((this->to_real_dense(h) - this->dense).norm(), this->tolerance * this->dense.norm());
  EXPECT_EQ(h.number_of_nonzeros(), [&] {
    std::size_t count = 0;
    for(int i = 0; i < this->size; ++i)
      for(int j = 0; j < this->size; ++j)
        count += (this->dense.block(this->rows * i, this->rows * j, this->rows, this->rows).array()
                  != 0.).any();
    return count;
  }());
  const Eigen::VectorXd x = this->random_numbers();
  typename TestFixture::Vector y(this->size);
  h.multiply(this->to_values(x), y);
  const Eigen::VectorXd expected = this->dense * x;
  EXPECT_LE((this->to_numbers(y) - expected).norm(), this->tolerance * expected.norm());
}

TYPED_TEST(Real_values, take_rows_and_precisions)
{
  auto h = this->sparse();
  const auto row = h.take_row(3);
  Eigen::MatrixXd without = this->dense;
  without.middleRows(3 * this->rows, this->rows).setZero();
  EXPECT_LE((this->to_real_dense(h) - without).norm(), this->tolerance * without.norm());
  h.put_row(3, row);
  Self_adjoint_matrix<typename TestFixture::Double> in_double;
  in_double.assign(h);
  EXPECT_EQ(this->to_real_dense(h), this->to_real_dense(in_double));
  EXPECT_LE((this->to_real_dense(h) - this->dense).norm(), this->tolerance * this->dense.norm());
}

TYPED_TEST(Real_values, have_the_vector_operations)
{
  const Eigen::VectorXd x = this->random_numbers(), y = this->random_numbers();
  const auto a = this->to_values(x);
  auto b = this->to_values(y);
  EXPECT_NEAR(inner_product(a, b), x.dot(y), this->tolerance * x.norm() * y.norm());
  EXPECT_NEAR(squared_norm(a), x.squaredNorm(), this->tolerance * x.squaredNorm());
  double largest = 0.;
  for(int i = 0; i < this->size; ++i)
    largest = (std::max)(largest, x.segment(this->rows * i, this->rows).norm());
  EXPECT_NEAR(largest_entry(a), largest, this->tolerance);
  add_scaled(3, a, b);
  EXPECT_LE((this->to_numbers(b) - (3. * x + y)).norm(), this->tolerance * x.norm());
  set_zero(this->size, b);
  EXPECT_EQ(squared_norm(b), 0.);
}

// D^-1 H has no eigenvalue above 2, and the Chebyshev smoother lowers the energy.
TYPED_TEST(Real_values, are_smoothed)
{
  typedef Value_traits<typename TestFixture::Traits::Diagonal> Diagonal_traits;
  const auto h = this->sparse();
  const auto inverse = l1_inverse_diagonal(h);
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(this->dense.rows(), this->dense.rows());
  for(int i = 0; i < this->size; ++i)
    for(int k = 0; k < this->rows * this->rows; ++k)
      d(this->rows * i + k / this->rows, this->rows * i + k % this->rows)
        = Diagonal_traits::coefficient(inverse[i], k / this->rows, k % this->rows);
  EXPECT_EQ(d.middleRows(this->rows * this->pin, this->rows).norm(), 0.);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> root_of(d);
  const Eigen::MatrixXd root = root_of.eigenvectors()
    * root_of.eigenvalues().cwiseMax(0.).cwiseSqrt().asDiagonal()
    * root_of.eigenvectors().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(root * this->dense * root);
  EXPECT_LE(spectrum.eigenvalues().maxCoeff(), 2. + 1e-4);
  EXPECT_GT(spectrum.eigenvalues().maxCoeff(), 0.5);
  Chebyshev_smoother<TypeParam> smoother;
  smoother.set_matrix(h);
  const Eigen::VectorXd error = this->random_free_numbers();
  auto u = this->to_values(0. * error), r = this->to_values(this->dense * error), z = u;
  smoother.smooth(h, 3, u, r, z);
  const Eigen::VectorXd after = error - this->to_numbers(u);
  EXPECT_LT(after.dot(this->dense * after), 0.9 * error.dot(this->dense * error));
  const Eigen::VectorXd residual = this->dense * after;
  EXPECT_LE((this->to_numbers(r) - this->dense * this->to_numbers(z) - residual).norm(),
            1e-4 * (this->dense * error).norm());
}

TYPED_TEST(Real_values, have_preconditioners_and_a_factorization)
{
  const auto h = this->sparse();
  const Eigen::VectorXd f = this->random_free_numbers();
  typename TestFixture::Vector z;
  Sparse_cholesky<Real_factorization> cholesky;
  EXPECT_FALSE(cholesky.is_factorized());
  ASSERT_TRUE(cholesky.factorize(h));
  EXPECT_TRUE(cholesky.is_factorized());
  cholesky.solve(this->to_values(f), z);
  EXPECT_LE((this->dense * this->to_numbers(z) - f).norm(), this->tolerance * f.norm());

  // The block diagonal and what is below it
  Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(f.size(), f.size()), lower = diagonal;
  const Eigen::MatrixXd a = this->regular();
  for(int i = 0; i < this->size; ++i) {
    const int at = this->rows * i, rows = this->rows;
    diagonal.block(at, at, rows, rows) = a.block(at, at, rows, rows);
    lower.block(at, 0, rows, at) = a.block(at, 0, rows, at);
  }
  lower += diagonal;
  const Diagonal_preconditioner<TypeParam> by_diagonal(h);
  by_diagonal(this->to_values(f), z);
  Eigen::VectorXd expected = diagonal.inverse() * f;
  EXPECT_LE((this->to_numbers(z) - expected).norm(), this->tolerance * expected.norm());
  const Gauss_seidel_preconditioner<TypeParam> sweeps(h);
  sweeps(this->to_values(f), z);
  expected = lower.transpose().inverse() * (diagonal * (lower.inverse() * f));
  EXPECT_LE((this->to_numbers(z) - expected).norm(), this->tolerance * expected.norm());
}

// What is split is the matrix, to the bits of two floats, and its first part the matrix in floats.
TYPED_TEST(Real_values, are_split)
{
  typedef TestFixture Test;
  typedef typename Split_matrix<TypeParam>::Single Single;
  const auto h = this->sparse();
  const Split_matrix<TypeParam> split(h);
  EXPECT_EQ(this->to_real_dense(split.single()),
            Eigen::MatrixXd(this->to_real_dense(h).template cast<float>().template cast<double>()));
  EXPECT_EQ(split.size(), h.size());
  constexpr double two_floats = 1e-14; // 48 bits
  EXPECT_TRUE(Test::is_nearly(Test::to_real_dense(split), Test::to_real_dense(h), two_floats));
  const Eigen::VectorXd x = this->random_numbers();
  typename Test::Vector y(Test::size);
  split(Test::to_values(x), y);
  EXPECT_LE((Test::to_numbers(y) - this->dense * x).norm(), Test::tolerance * x.norm());
  EXPECT_EQ(split.memory(), split.single().memory() - split.single().pattern().memory());
  static_assert(std::is_same_v<typename Value_traits<typename Single::Vector_value>::Real, float>);
}

// The same with 16 bits beside a float: in half the memory, each entry to 39 bits.
TYPED_TEST(Real_values, are_split_in_less_memory)
{
  typedef TestFixture Test;
  const auto h = this->sparse();
  const Split_matrix<TypeParam> longer(h);
  const Split_matrix<TypeParam, std::int16_t> split(h);
  EXPECT_EQ(Test::to_real_dense(split.single()), Test::to_real_dense(longer.single()));
  EXPECT_TRUE(Test::is_nearly(Test::to_real_dense(split), Test::to_real_dense(h), 0x1p-39));
  const Eigen::VectorXd x = this->random_numbers();
  typename Test::Vector y(Test::size);
  split(Test::to_values(x), y);
  EXPECT_LE((Test::to_numbers(y) - this->dense * x).norm(), Test::tolerance * x.norm());
  EXPECT_EQ(2 * split.memory(), longer.memory());
}

// The same row by row, without the whole in double precision; what is taken from it is gone.
TYPED_TEST(Real_values, are_split_row_by_row)
{
  this->expect_rows_make(Split_matrix<TypeParam>(this->sparse()));
  this->expect_rows_make(Split_matrix<TypeParam, std::int16_t>(this->sparse()));
}

// Numbers of any size, those that are rounded to a power of 2, or by the most, too.
TEST(Split_number, is_the_number_to_39_bits)
{
  typedef CGAL::Multigrid::internal::Split_number<std::int16_t> Split;
  Random_numbers random(31);
  const auto expect_split = [](double number) {
    const float rounded = float(number);
    const double sum = Split::sum(rounded, Split::rest(number, rounded));
    EXPECT_LE(std::abs(sum - number), 0x1p-39 * std::abs(number)) << number;
  };
  for(int i = 0; i < 100000; ++i)
    expect_split(std::ldexp(random.real() + (random.chance(0.5) ? 1. : -2.), int(random.below(200)) - 100));
  for(const int exponent : {-60, 0, 1, 90})
    for(const double sign : {-1., 1.})
      for(const double part : {0., 0x1p-24, 0x1p-25, 0x1p-26, 0x1p-23 + 0x1p-24, 0x1p-40})
        for(const double off : {-1., 1.})
          expect_split(sign * std::ldexp(1. + off * part, exponent));
  EXPECT_EQ(Split::sum(0.f, Split::rest(0., 0.f)), 0.);
}

// The product P^T A P by the definition, from rows and from a matrix that was split; the pin takes no
// part.
TYPED_TEST(Real_values, have_products_with_a_prolongation)
{
  typedef TestFixture Test;
  typedef typename Test::Double Double;
  typedef CGAL::Surface_mesh_multiresolution::Prolongation Prolongation;
  constexpr int rows = Test::rows, coarse = Test::size / 2;
  std::vector<std::uint32_t> kept;
  std::vector<Prolongation::Stencil> stencils;
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(rows * Test::size, rows * coarse);
  for(std::uint32_t j = 0; j < std::uint32_t(coarse); ++j) {
    kept.push_back(2 * j);
    const std::array<std::uint32_t, 3> source = {j, (j + 5) % coarse, (j + 9) % coarse};
    const std::array<float, 3> weight = {0.5f, 0.375f, 0.125f};
    stencils.push_back({2 * j + 1, {2 * source[0], 2 * source[1], 2 * source[2]}, weight});
    for(int r = 0; r < rows; ++r) {
      p(rows * 2 * j + r, rows * j + r) = 1.;
      for(int c = 0; c < 3 && int(2 * j + 1) != Test::pin; ++c)
        p(rows * (2 * j + 1) + r, rows * source[c] + r) = weight[c];
    }
  }
  const Prolongation prolongation(kept, stencils);
  const Eigen::MatrixXd expected = p.transpose() * this->dense * p;
  const auto difference = [&](const Sparse_rows<Double>& product) {
    const Eigen::MatrixXd a = Test::to_real_dense(product.template matrix<Double>());
    return (a - expected).norm() / expected.norm();
  };
  const Sparse_rows<Double> fine(this->sparse());
  const Split_matrix<TypeParam> split(this->sparse());
  EXPECT_LE(difference(CGAL::Surface_mesh_multigrid::galerkin_rows(fine, prolongation)), Test::tolerance);
  EXPECT_LE(difference(CGAL::Surface_mesh_multigrid::galerkin_rows(split, prolongation)), Test::tolerance);
}

// One patch after the other, by the definition; patches overlap, and some have a pin.
TYPED_TEST(Real_values, are_corrected_on_patches)
{
  typedef TestFixture Test;
  constexpr int rows = Test::rows;
  std::vector<std::array<std::uint32_t, 3>> patches = {{3, 4, 5}, {5, 3, 9}, {11, 0, 69}, {11, 12, 1}};
  for(std::uint32_t i = 20; i < 40; i += 2)
    patches.push_back({i, i + 3, i + 1});
  const auto h = this->sparse();
  Patch_corrections<TypeParam> corrections;
  EXPECT_TRUE(corrections.empty());
  for(const auto& patch : patches)
    corrections.add(h, patch);
  EXPECT_FALSE(corrections.empty());
  const auto correct = [&](const std::array<std::uint32_t, 3>& patch, const Eigen::VectorXd& f,
                           Eigen::VectorXd& x) {
    std::vector<int> numbers;
    for(const std::uint32_t i : patch)
      for(int r = 0; r < rows && int(i) != Test::pin; ++r)
        numbers.push_back(rows * int(i) + r);
    const Eigen::VectorXd residual = f - this->dense * x;
    x(numbers) += this->dense(numbers, numbers).inverse() * residual(numbers);
  };
  const Eigen::VectorXd f = this->random_free_numbers();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(f.size());
  for(const auto& patch : patches)
    correct(patch, f, x);
  typename Test::Vector r = Test::to_values(f), y;
  corrections.correct_forward(h, r, y);
  EXPECT_LE((Test::to_numbers(y) - x).norm(), Test::tolerance * x.norm());
  EXPECT_LE((Test::to_numbers(r) - (f - this->dense * x)).norm(), Test::tolerance * f.norm());
  x = this->random_free_numbers();
  y = Test::to_values(x);
  for(std::size_t k = patches.size(); k-- > 0;)
    correct(patches[k], f, x);
  corrections.correct_backward(h, Test::to_values(f), y);
  EXPECT_LE((Test::to_numbers(y) - x).norm(), Test::tolerance * x.norm());
}

// A component of a block that no entry concerns stays 0, where a diagonal has no inverse.
TEST(Block_values, inverse_of_a_singular_block)
{
  typedef Value_traits<Eigen::Matrix2d> Traits;
  const Eigen::Matrix2d d = (Eigen::Matrix2d() << 4., 0., 0., 0.).finished();
  EXPECT_LE((Traits::inverse(d) - (Eigen::Matrix2d() << 0.25, 0., 0., 0.).finished()).norm(), 1e-15);
  EXPECT_EQ(Traits::inverse(0. * d), Traits::zero());
  const Eigen::Matrix2d b = (Eigen::Matrix2d() << 1., 2., -3., 4.).finished();
  EXPECT_LE((Traits::modulus(b) * Traits::modulus(b) - b * b.transpose()).norm(), 1e-12);
}

} // namespace multigrid_values_test
