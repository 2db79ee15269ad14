// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the multigrid layer against dense linear algebra: every sparse kernel against the
// formula in its documentation.

#include <support/dense_multigrid.h>

#include <CGAL/Multigrid/Smoothers.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>

#include <CGAL/Eigen_solver_traits.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <type_traits>

namespace multigrid_matrix_test {

using namespace CGAL::Multigrid;
using namespace test_support;
using CGAL::Surface_mesh_multiresolution::Prolongation;

//
// Matrices
//

template <class Real>
class Matrices : public ::testing::Test
{
protected:
  // Rounding errors of a sum of a few hundred terms of size 1
  static constexpr double tolerance() { return std::is_same_v<Real, float> ? 1e-4 : 1e-12; }
};

typedef ::testing::Types<float, double> Reals;
TYPED_TEST_SUITE(Matrices, Reals);

// Sizes around those of slices (8) and of the windows in which rows are sorted (256)
const std::vector<int> sizes = {1, 2, 7, 8, 9, 16, 17, 255, 256, 257, 300};

TYPED_TEST(Matrices, product_is_the_dense_one)
{
  Random_numbers random(1);
  for(const int n : sizes)
    for(const double density : {0., 0.02, 0.3}) {
      const Dense_matrix a = random_hermitian_matrix(n, density, random);
      const Dense_vector x = random_vector(n, random);
      const auto h = sparse_matrix<TypeParam>(a);
      Complex_vector<TypeParam> y(n);
      h.multiply(to_vector<TypeParam>(x), y);
      EXPECT_LE(relative_error(to_dense(y), a * x), this->tolerance()) << n << " " << density;
    }
}

// So many rows that they are worked on in several blocks
TYPED_TEST(Matrices, product_of_many_rows_is_the_plain_one)
{
  Random_numbers random(31);
  const std::uint32_t n = 30011;
  std::vector<Matrix_row> rows(n);
  std::vector<std::uint32_t> lengths(n);
  for(std::uint32_t i = 0; i < n; ++i) {
    rows[i].diagonal = random.real();
    lengths[i] = std::uint32_t(random.below(12));
    for(std::uint32_t k = 0; k < lengths[i]; ++k)
      rows[i].entries.push_back({std::uint32_t((i + 1 + k * 997) % n), random.real(),
                                 random.chance(0.2) ? random.real() : 0.});
  }
  const auto h = Matrix_builder::build<TypeParam>(
    lengths, [&](std::uint32_t i, Matrix_row& row) { row = rows[i]; });
  const auto set_real = [&rows](std::uint32_t i, CGAL::Multigrid::Real_row<TypeParam>& row) {
    std::vector<std::uint32_t> column;
    std::vector<double> re;
    for(const auto& entry : rows[i].entries) {
      if(entry.im != 0.)
        return false;
      column.push_back(entry.column);
      re.push_back(entry.re);
    }
    row.set(rows[i].diagonal, re.size(), column.data(), re.data());
    return true;
  };
  const auto same = Matrix_builder::build<TypeParam>(
    lengths, set_real, [&](std::uint32_t i, Matrix_row& row) { row = rows[i]; });
  const Dense_vector x = random_vector(int(n), random);
  Complex_vector<TypeParam> y(n), y_same(n);
  h.multiply(to_vector<TypeParam>(x), y);
  same.multiply(to_vector<TypeParam>(x), y_same);
  EXPECT_EQ(y, y_same);
  for(std::uint32_t i = 0; i < n; ++i) {
    std::complex<double> expected = rows[i].diagonal * x(i);
    for(const auto& entry : rows[i].entries)
      expected += std::complex<double>(entry.re, entry.im) * x(entry.column);
    ASSERT_NEAR(std::abs(std::complex<double>(y[i]) - expected), 0., this->tolerance()) << i;
  }
}

TYPED_TEST(Matrices, rows_may_be_shorter_than_announced)
{
  Random_numbers random(2);
  const Dense_matrix a = random_hermitian_matrix(50, 0.1, random);
  const Dense_vector x = random_vector(50, random);
  const auto h = sparse_matrix<TypeParam>(a, 3);
  Complex_vector<TypeParam> y(50);
  h.multiply(to_vector<TypeParam>(x), y);
  EXPECT_LE(relative_error(to_dense(y), a * x), this->tolerance());
}

TYPED_TEST(Matrices, entries_are_those_that_were_put_in)
{
  Random_numbers random(3);
  for(const int n : sizes) {
    const Dense_matrix a = random_hermitian_matrix(n, 0.1, random);
    EXPECT_LE((to_dense(sparse_matrix<TypeParam>(a)) - a).norm(), this->tolerance() * a.norm());
  }
}

TYPED_TEST(Matrices, of_no_rows)
{
  const auto h = sparse_matrix<TypeParam>(Dense_matrix(0, 0));
  Complex_vector<TypeParam> none;
  h.multiply(none, none);
  EXPECT_EQ(h.size(), 0u);
}

TEST(Matrix, of_doubles_becomes_one_of_floats)
{
  Random_numbers random(4);
  const Dense_matrix a = random_hermitian_matrix(40, 0.2, random);
  Hermitian_matrix<float> rounded;
  rounded.assign(sparse_matrix<double>(a));
  EXPECT_LE((to_dense(rounded) - a).cwiseAbs().maxCoeff(), 1e-7 * a.cwiseAbs().maxCoeff());
}

// The eigenvalues of D^-1 H are those of D^-1/2 H D^-1/2.
TEST(L1_diagonal, bounds_the_spectrum_by_2)
{
  Random_numbers random(5);
  double greatest = 0.;
  for(int n : {1, 5, 30, 60})
    for(double density : {0., 0.1, 1.}) {
      const Dense_matrix a = random_definite_matrix(n, density, random);
      const std::vector<double> inverse = l1_inverse_diagonal(sparse_matrix<double>(a));
      const Eigen::VectorXd root
        = Eigen::Map<const Eigen::VectorXd>(inverse.data(), n).cwiseSqrt();
      const Dense_matrix scaled = root.asDiagonal() * a * root.asDiagonal();
      const auto spectrum = Eigen::SelfAdjointEigenSolver<Dense_matrix>(scaled).eigenvalues();
      EXPECT_LE(spectrum.maxCoeff(), 2. * (1. + 1e-12)) << n << " " << density;
      greatest = (std::max)(greatest, spectrum.maxCoeff());
    }
  EXPECT_GT(greatest, 1.9); // the bound is reached, by diagonal matrices
}

TEST(L1_diagonal, is_0_for_rows_of_pins)
{
  Random_numbers random(6);
  const auto h = sparse_matrix<double>(with_pins(random_definite_matrix(20, 0.3, random), {3, 11}));
  const std::vector<double> inverse = l1_inverse_diagonal(h);
  for(int i = 0; i < 20; ++i)
    EXPECT_EQ(inverse[i] == 0., i == 3 || i == 11);
}

//
// The smoother
//

// Chebyshev polynomials of the fourth kind: W_k(cos t) = sin((k + 1/2) t) / sin(t / 2). The error
// is multiplied by W_k(1 - lambda) / (2k + 1) (Lottes 2022, for a spectrum up to 2).
TEST(Chebyshev, error_is_the_polynomial_of_the_fourth_kind)
{
  const int n = 41;
  Dense_matrix a = Dense_matrix::Zero(n, n);
  for(int i = 0; i < n; ++i)
    a(i, i) = 2. * (i + 1) / n;
  const auto h = sparse_matrix<double>(a);
  for(unsigned int steps = 1; steps <= 7; ++steps) {
    Complex_vector<double> u(n, 0.), r(n), z;
    for(int i = 0; i < n; ++i)
      r[i] = a(i, i); // the solution is 1
    chebyshev_steps(h, std::vector<double>(n, 1.), steps, u, r, z);
    for(int i = 0; i < n; ++i) {
      const double angle = std::acos(1. - a(i, i).real());
      const double expected
        = std::sin((steps + 0.5) * angle) / std::sin(0.5 * angle) / (2. * steps + 1.);
      EXPECT_NEAR(1. - u[i].real(), expected, 1e-12) << "steps " << steps << " at " << a(i, i);
      EXPECT_EQ(u[i].imag(), 0.);
    }
  }
}

TEST(Chebyshev, leaves_the_residual_before_the_last_step)
{
  Random_numbers random(7);
  const Dense_matrix a = random_definite_matrix(30, 0.2, random);
  const auto h = sparse_matrix<double>(a);
  const Dense_vector f = random_vector(30, random), start = random_vector(30, random);
  for(unsigned int steps = 1; steps <= 3; ++steps) {
    Complex_vector<double> u = to_vector<double>(start), r = to_vector<double>(f - a * start), z;
    chebyshev_steps(h, l1_inverse_diagonal(h), steps, u, r, z);
    EXPECT_LE(relative_error(to_dense(r) - a * to_dense(z), f - a * to_dense(u)), 1e-12);
  }
}

TEST(Chebyshev, is_symmetric_and_lowers_the_energy)
{
  Random_numbers random(8);
  const int n = 40;
  const Dense_matrix a = random_definite_matrix(n, 0.2, random);
  const auto h = sparse_matrix<double>(a);
  const auto inverse = l1_inverse_diagonal(h);
  for(unsigned int steps = 1; steps <= 5; ++steps) {
    const auto apply = [&](const Dense_vector& f) {
      Complex_vector<double> u(n, 0.), r = to_vector<double>(f), z;
      chebyshev_steps(h, inverse, steps, u, r, z);
      return to_dense(u);
    };
    const Dense_matrix b = matrix_of(n, apply);
    EXPECT_LE((b - b.adjoint()).norm(), 1e-12 * b.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Dense_matrix>(b).eigenvalues().minCoeff(), 0.);
    const Dense_vector error = random_vector(n, random);
    const Dense_vector after = error - apply(a * error);
    EXPECT_LT(after.dot(a * after).real(), error.dot(a * error).real());
  }
}

//
// Prolongation and restriction
//

TEST(Transfer, restriction_is_the_transpose_of_prolongation)
{
  Random_numbers random(9);
  for(int kept : {1, 3, 20}) {
    const Prolongation p = random_prolongation(kept, 60, random);
    const Dense_matrix matrix = matrix_of(kept, [&](const Dense_vector& x) {
      Complex_vector<double> fine;
      p.prolongate(to_vector<double>(x), fine);
      return to_dense(fine);
    });
    const Dense_matrix transposed = matrix_of(60, [&](const Dense_vector& x) {
      Complex_vector<double> coarse, work = to_vector<double>(x);
      p.restrict_in_place(work, coarse);
      return to_dense(coarse);
    });
    EXPECT_LE((transposed - matrix.transpose()).norm(), 1e-14 * matrix.norm());
    // Constants stay constants, vertices of both levels keep their values.
    EXPECT_LE((matrix.rowwise().sum() - Dense_vector::Ones(60)).norm(), 1e-5);
    for(int j = 0; j < kept; ++j)
      EXPECT_EQ(matrix.row(p.kept()[j]), Dense_matrix::Identity(kept, kept).row(j));
  }
}

//
// Preconditioners and factorizations
//

TEST(Jacobi, divides_by_the_diagonal)
{
  Random_numbers random(22);
  const std::vector<int> pins = {4, 7};
  const Dense_matrix a = with_pins(random_definite_matrix(25, 0.3, random), pins);
  const Jacobi_preconditioner<double> jacobi(sparse_matrix<double>(a));
  const Dense_vector r = random_vector(25, random);
  Complex_vector<double> z;
  jacobi(to_vector<double>(r), z);
  for(int i = 0; i < 25; ++i) {
    const auto expected = i == 4 || i == 7 ? std::complex<double>(0.) : r(i) / a(i, i);
    EXPECT_NEAR(std::abs(z[i] - expected), 0., 1e-14);
  }
}

TEST(Symmetric_gauss_seidel, is_the_dense_formula)
{
  Random_numbers random(23);
  for(int n : {1, 9, 70}) {
    const Dense_matrix a = random_definite_matrix(n, 0.2, random);
    const Symmetric_gauss_seidel_preconditioner<double> sweeps(sparse_matrix<double>(a));
    const Dense_vector r = random_vector(n, random);
    Complex_vector<double> z;
    sweeps(to_vector<double>(r), z);
    const Dense_matrix lower = a.triangularView<Eigen::Lower>();
    const Dense_vector expected
      = lower.adjoint().inverse() * (a.diagonal().asDiagonal() * (lower.inverse() * r));
    EXPECT_LE(relative_error(to_dense(z), expected), 1e-12);
  }
}

TEST(Symmetric_gauss_seidel, leaves_pins_out)
{
  Random_numbers random(24);
  const std::vector<int> pins = {0, 5, 19};
  const Dense_matrix a = random_definite_matrix(20, 0.4, random);
  const auto with_pin_columns = sparse_matrix<double>(with_pinned_rows(a, pins));
  const auto without = sparse_matrix<double>(with_pins(a, pins));
  const Dense_vector r = random_vector(20, random);
  Complex_vector<double> z, expected;
  Symmetric_gauss_seidel_preconditioner<double> sweeps(with_pin_columns);
  sweeps(to_vector<double>(r), z);
  Symmetric_gauss_seidel_preconditioner<double> reference(without);
  reference(to_vector<double>(r), expected);
  EXPECT_EQ(z, expected);
  for(const int pin : pins)
    EXPECT_EQ(z[pin], std::complex<double>(0.));
}

template <class Solver>
Dense_vector solve(Solver& solver, const Hermitian_matrix<double>& h, const Dense_vector& f)
{
  EXPECT_TRUE(solver.factorize(h));
  Complex_vector<double> x;
  solver.solve(to_vector<double>(f), x);
  return to_dense(x);
}

TEST(Factorizations, solve_and_agree)
{
  typedef CGAL::Eigen_solver_traits<
    Eigen::SimplicialLDLT<CGAL::Eigen_sparse_matrix<double>::EigenType>> Solver_traits;
  Random_numbers random(25);
  for(int n : {1, 2, 30, 200}) {
    const std::vector<int> pins = n > 2 ? std::vector<int>{1, n - 1} : std::vector<int>();
    const Dense_matrix a = random_definite_matrix(n, 3. / n, random);
    const auto h = sparse_matrix<double>(with_pinned_rows(a, pins));
    Dense_vector f = random_vector(n, random);
    for(const int pin : pins)
      f(pin) = 0.;
    Sparse_cholesky<> eigen;
    Sparse_cholesky<Large_factorization> large;
    CGAL::Surface_mesh_parameterization::Solver_traits_cholesky<Solver_traits> traits;
    const Dense_vector x = solve(eigen, h, f);
    EXPECT_LE((with_pins(a, pins) * x - f).norm(), 1e-10 * f.norm());
    EXPECT_LE(relative_error(solve(large, h, f), x), 1e-10);
    EXPECT_LE(relative_error(solve(traits, h, f), x), 1e-10);
    for(const int pin : pins)
      EXPECT_EQ(x(pin), std::complex<double>(0.));
  }
}

TEST(Factorizations, of_pins_only)
{
  const auto h = sparse_matrix<double>(Dense_matrix::Zero(3, 3));
  Sparse_cholesky<> eigen;
  EXPECT_EQ(solve(eigen, h, Dense_vector::Zero(3)), Dense_vector(Dense_vector::Zero(3)));
}

#if defined(CGAL_HLSCM_USE_CHOLMOD) && defined(__linux__)
std::ptrdiff_t number_of_threads_of_this_process()
{
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

// OpenMP would start three, and they would wait busily.
TEST(Factorizations, by_cholmod_start_no_threads)
{
  constexpr int side = 200; // of a grid, so that CHOLMOD's loops are long enough for threads
  std::vector<Eigen::Triplet<double>> entries;
  for(int i = 0; i < side * side; ++i) {
    entries.emplace_back(i, i, 4.1);
    if(i + side < side * side)
      entries.emplace_back(i + side, i, -1.);
    if((i + 1) % side != 0)
      entries.emplace_back(i + 1, i, -1.);
  }
  Eigen::SparseMatrix<double> laplacian(side * side, side * side);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd f = Eigen::VectorXd::Ones(side * side);
  Eigen::VectorXd x;
  const std::ptrdiff_t before = number_of_threads_of_this_process();
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> factorization;
  ASSERT_TRUE(CGAL::Multigrid::factorize_sparse(factorization, laplacian));
  CGAL::Multigrid::solve_sparse(factorization, f, x);
  EXPECT_EQ(number_of_threads_of_this_process(), before);
  EXPECT_LE((laplacian.selfadjointView<Eigen::Lower>() * x - f).norm(), 1e-10 * f.norm());
}
#endif

} // namespace multigrid_matrix_test
