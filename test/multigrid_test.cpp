// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid layer against dense linear algebra: every sparse kernel against the formula in its
// documentation, and the cycle against algorithm 1 of the paper, first as a list of operations
// without any numbers, then with dense matrices.

#include <support/dense_multigrid.h>

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Monogrid_preconditioners.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>

#include <CGAL/Eigen_solver_traits.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <type_traits>

namespace multigrid_test {

using namespace CGAL::Multigrid;
using namespace test_support;
using CGAL::Surface_mesh_multiresolution::Prolongation;

//
// The cycle without numbers
//

// Writes the operations down: "S2x3" is three smoothing steps on level 2, "R2" the restriction of
// the residual of level 2, "D" the coarsest solution, "C2" the correction of level 2, and "K1( )"
// encloses what is accelerated on level 1.
class Traced_levels
{
public:
  void smooth(std::size_t level, unsigned int steps)
  {
    if(steps > 0)
      m_trace << " S" << level << "x" << steps;
  }
  void restrict_residual(std::size_t level) { m_trace << " R" << level; }
  void correct(std::size_t level) { m_trace << " C" << level; }
  void solve_coarsest() { m_trace << " D"; }
  template <class Coarse_cycle>
  void accelerate(std::size_t level, unsigned int steps, const Coarse_cycle& coarse_cycle)
  {
    m_trace << " K" << level << "(";
    for(unsigned int step = 0; step < steps; ++step)
      coarse_cycle();
    m_trace << " )";
  }

  std::string trace() const { return m_trace.str(); }

private:
  std::ostringstream m_trace;
};

std::string trace_of_cycle(const Schedule& schedule, std::size_t finest)
{
  Traced_levels levels;
  cycle(levels, schedule, finest);
  return levels.trace();
}

TEST(Cycle, of_one_level_is_the_coarsest_solution)
{
  for(const Schedule& s : {Schedule(), Schedule::cascade(3), Schedule::w_cycle(1, 1)})
    EXPECT_EQ(trace_of_cycle(s, 0), " D");
}

TEST(Cycle, cascade)
{
  EXPECT_EQ(trace_of_cycle(Schedule::cascade(4), 3), " R3 R2 R1 D C1 S1x4 C2 S2x4 C3 S3x4");
}

TEST(Cycle, v_cycle)
{
  EXPECT_EQ(trace_of_cycle(Schedule::v_cycle(2, 1), 3),
            " S3x2 R3 S2x2 R2 S1x2 R1 D C1 S1x1 C2 S2x1 C3 S3x1");
}

TEST(Cycle, w_cycle)
{
  EXPECT_EQ(trace_of_cycle(Schedule::w_cycle(1, 2), 3),
            " S3x1 R3"
            " S2x1 R2 S1x1 R1 D C1 S1x2 S1x1 R1 D C1 S1x2 C2 S2x2"
            " S2x1 R2 S1x1 R1 D C1 S1x2 S1x1 R1 D C1 S1x2 C2 S2x2"
            " C3 S3x2");
}

TEST(Cycle, general)
{
  EXPECT_EQ(trace_of_cycle({3, 0, 3, Acceleration::NONE}, 2),
            " S2x3 R2 S1x3 R1 D C1 S1x3 R1 D C1 S1x3 R1 D C1 C2");
}

TEST(Cycle, k_cycle)
{
  EXPECT_EQ(trace_of_cycle(Schedule::k_cycle(1, 2), 3),
            " S3x1 R3"
            " K2( S2x1 R2 K1( S1x1 R1 D C1 S1x2 S1x1 R1 D C1 S1x2 ) C2 S2x2"
            " S2x1 R2 K1( S1x1 R1 D C1 S1x2 S1x1 R1 D C1 S1x2 ) C2 S2x2 )"
            " C3 S3x2");
}

// Algorithm 1 of the paper, line by line. The coarsest level is solved exactly, so it is visited
// once where the paper visits it m_c times.
std::string algorithm_1(const Schedule& s, std::size_t level)
{
  if(level == 0)
    return " D";                                                                    // 1, 2
  const std::string number = std::to_string(level);
  const auto smooth = [&](unsigned int steps) {
    return steps == 0 ? std::string() : " S" + number + "x" + std::to_string(steps);
  };
  std::string visits;
  for(unsigned int visit = 0; visit < (level == 1 ? 1 : s.coarse_visits); ++visit)
    visits += algorithm_1(s, level - 1);                                            // 7
  if(s.acceleration == Acceleration::KRYLOV && level > 1)
    visits = " K" + std::to_string(level - 1) + "(" + visits + " )";
  return smooth(s.pre_smoothing) + " R" + number + visits + " C" + number           // 4 - 9
       + smooth(s.post_smoothing);                                                  // 10
}

TEST(Cycle, is_algorithm_1)
{
  for(std::size_t finest = 0; finest <= 4; ++finest)
    for(unsigned int pre : {0u, 1u, 2u})
      for(unsigned int post : {0u, 1u, 3u})
        for(unsigned int visits : {1u, 2u, 3u})
          for(Acceleration a : {Acceleration::NONE, Acceleration::KRYLOV}) {
            const Schedule s = {pre, post, visits, a};
            EXPECT_EQ(trace_of_cycle(s, finest), algorithm_1(s, finest));
          }
}

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
// The cycle with numbers
//

typedef Multigrid_levels<Prolongation, Sparse_cholesky<>> Levels;

struct Sparse_levels : Levels
{
  std::vector<Hermitian_matrix<float>> matrices;

  explicit Sparse_levels(const Chain_hierarchy& hierarchy)
  {
    for(const auto& h : hierarchy.matrices)
      matrices.push_back(sparse_matrix<float>(h));
    for(std::size_t l = 0; l < matrices.size(); ++l)
      add_level(matrices[l], l == 0 ? nullptr : &hierarchy.prolongations[l]);
    EXPECT_TRUE(coarsest_solver().factorize(matrix(0)));
  }
};

Dense_vector precondition(Levels& levels, const Schedule& schedule, const Dense_vector& r)
{
  Complex_vector<double> x;
  levels.precondition(schedule, levels.number_of_levels() - 1, to_vector<double>(r), x);
  return to_dense(x);
}

const std::vector<Schedule> schedules
  = {Schedule::cascade(2), Schedule::v_cycle(1, 1), Schedule::v_cycle(2, 2),
     Schedule::v_cycle(0, 3), Schedule::w_cycle(1, 2), {2, 0, 3, Acceleration::NONE},
     Schedule::k_cycle(1, 1), Schedule::k_cycle(2, 1), {1, 1, 1, Acceleration::KRYLOV},
     {1, 1, 4, Acceleration::KRYLOV}};

TEST(Multigrid_levels, are_the_dense_cycle)
{
  Random_numbers random(10);
  for(std::size_t number_of_levels : {1, 2, 3, 5}) {
    const Chain_hierarchy hierarchy(number_of_levels, random);
    Sparse_levels levels(hierarchy);
    const Dense_vector f = hierarchy.random_right_hand_side(random);
    for(std::size_t s = 0; s < schedules.size(); ++s) {
      Dense_levels reference(hierarchy);
      const Dense_vector expected = reference.cycle(schedules[s], f);
      // Single precision, and systems whose condition is about 1e4
      EXPECT_LE(relative_error(precondition(levels, schedules[s], f), expected), 2e-3)
        << "schedule " << s << " on " << number_of_levels << " levels";
    }
  }
}

TEST(Multigrid_levels, keep_pins_at_0)
{
  Random_numbers random(11);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels levels(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  for(const Schedule& s : schedules) {
    const Dense_vector x = precondition(levels, s, f);
    for(const int pin : hierarchy.pins.back())
      EXPECT_EQ(x(pin), Dense_vector::Scalar(0.));
  }
}

// Without acceleration a cycle is linear, symmetric if it smooths the same before and after, and
// positive definite.
TEST(Multigrid_levels, are_a_symmetric_positive_preconditioner)
{
  Random_numbers random(12);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels levels(hierarchy);
  for(const Schedule& s : {Schedule::v_cycle(1, 1), Schedule::v_cycle(3, 3),
                           Schedule::w_cycle(2, 2)})
    for(int trial = 0; trial < 10; ++trial) {
      const Dense_vector x = hierarchy.random_right_hand_side(random),
                         y = hierarchy.random_right_hand_side(random);
      const Dense_vector bx = precondition(levels, s, x), by = precondition(levels, s, y);
      EXPECT_LE(std::abs(y.dot(bx) - std::conj(x.dot(by))), 1e-3 * y.norm() * bx.norm());
      EXPECT_GT(x.dot(bx).real(), 0.);
      EXPECT_LE(std::abs(x.dot(bx).imag()), 1e-3 * x.dot(bx).real());
    }
}

TEST(Multigrid_levels, reduce_the_error)
{
  Random_numbers random(13);
  const Chain_hierarchy hierarchy(5, random);
  Sparse_levels levels(hierarchy);
  const Dense_matrix& a = hierarchy.matrices.back();
  for(const Schedule& s : {Schedule::v_cycle(1, 1), Schedule::w_cycle(1, 1),
                           Schedule::k_cycle(1, 1), Schedule::k_cycle(2, 2)}) {
    Dense_vector error = hierarchy.random_solution(random);
    const double before = error.dot(a * error).real();
    error -= precondition(levels, s, a * error);
    EXPECT_LT(error.dot(a * error).real(), 0.25 * before);
  }
}

// Nothing in a cycle depends on the one before.
TEST(Multigrid_levels, have_no_memory)
{
  Random_numbers random(14);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels levels(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  for(const Schedule& s : schedules) {
    const Dense_vector first = precondition(levels, s, f);
    precondition(levels, Schedule::k_cycle(2, 0), hierarchy.random_right_hand_side(random));
    EXPECT_EQ(precondition(levels, s, f), first);
  }
}

// The size of the right-hand side does not matter, not even beyond the range of single precision.
TEST(Multigrid_levels, are_homogeneous)
{
  Random_numbers random(15);
  const Chain_hierarchy hierarchy(3, random);
  Sparse_levels levels(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  const Dense_vector x = precondition(levels, Schedule(), f);
  for(const double factor : {1e-60, 1e-20, 1e20, 1e60})
    EXPECT_LE(relative_error(precondition(levels, Schedule(), factor * f), factor * x), 1e-4);
  EXPECT_EQ(precondition(levels, Schedule(), 0. * f).norm(), 0.);
}

//
// Conjugate gradients
//

double energy(const Dense_matrix& a, const Dense_vector& x) { return 0.5 * x.dot(a * x).real(); }

// A system with pins: the energy of the whole and the matrix of the solver.
struct Pinned_system
{
  Dense_matrix whole;
  std::vector<int> pins;
  Dense_vector start, solution;
  Hermitian_matrix<double> matrix;

  Pinned_system(const Dense_matrix& a, std::vector<int> pinned, Random_numbers& random)
    : whole(a), pins(std::move(pinned)), start(Dense_vector::Zero(a.rows()))
    , matrix(sparse_matrix<double>(with_pinned_rows(a, pins)))
  {
    for(const int pin : pins)
      start(pin) = random.complex();
    solution = minimizer(whole, pins, start);
  }

  double least() const { return energy(whole, solution); }
};

template <class Precondition>
Iteration_report minimize(const Pinned_system& s, const Energy_stop& stop,
                          const Precondition& precondition, Dense_vector& x)
{
  Complex_vector<double> z = to_vector<double>(s.start);
  const Iteration_report report
    = minimize_energy(s.matrix, z, energy(s.whole, s.start), precondition, stop,
                      [](double part) { return part >= 0. && part <= 1.; });
  x = to_dense(z);
  return report;
}

Pinned_system random_system(int side, Random_numbers& random)
{
  return Pinned_system(twisted_grid_matrix(side, random), {0, side * side / 2 + 1}, random);
}

TEST(Conjugate_gradient, reaches_the_dense_solution)
{
  Random_numbers random(16);
  for(int side : {2, 3, 9, 16}) {
    const Pinned_system s = random_system(side, random);
    Energy_stop stop;
    stop.tolerance = 1e-24;
    stop.maximal_iterations = 2000;
    Dense_vector x;
    const auto report = minimize(s, stop, Jacobi_preconditioner<double>(s.matrix), x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(relative_error(x, s.solution), 1e-7) << side;
    for(const int pin : s.pins)
      EXPECT_EQ(x(pin), s.start(pin));
  }
}

TEST(Conjugate_gradient, keeps_account_of_the_energy)
{
  Random_numbers random(17);
  const Pinned_system s = random_system(10, random);
  for(std::size_t iterations : {1, 2, 5, 20}) {
    Energy_stop stop;
    stop.tolerance = 0.;
    stop.maximal_iterations = iterations;
    Dense_vector x;
    const auto report = minimize(s, stop, Jacobi_preconditioner<double>(s.matrix), x);
    EXPECT_EQ(report.iterations, iterations);
    EXPECT_FALSE(report.converged);
    EXPECT_NEAR(report.energy, energy(s.whole, x), 1e-10 * energy(s.whole, s.start));
  }
}

// The estimate of the gap is an extrapolation of the steps so far, so it may be wrong by a factor,
// most of all after three or four of them. Where more are needed, the tolerance is met.
TEST(Conjugate_gradient, estimates_the_gap)
{
  Random_numbers random(18);
  for(int trial = 0; trial < 10; ++trial) {
    const Pinned_system s = random_system(15, random);
    const Symmetric_gauss_seidel_preconditioner<double> sweeps(s.matrix);
    for(const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6}) {
      Energy_stop stop;
      stop.tolerance = tolerance;
      Dense_vector x;
      const auto report = minimize(s, stop, sweeps, x);
      ASSERT_TRUE(report.converged);
      const double e = energy(s.whole, x), gap = e - s.least();
      EXPECT_LE(gap, 5. * report.energy_gap) << "trial " << trial << " to " << tolerance;
      EXPECT_GE(gap, 1e-3 * report.energy_gap) << "trial " << trial << " to " << tolerance;
      if(tolerance <= 1e-2) {
        EXPECT_LE(gap, tolerance * e) << "trial " << trial;
      }
    }
  }
}

TEST(Conjugate_gradient, takes_the_multigrid_cycle)
{
  Random_numbers random(19);
  const Chain_hierarchy hierarchy(6, random);
  Sparse_levels levels(hierarchy);
  const Pinned_system s(hierarchy.whole, hierarchy.pins.back(), random);
  Energy_stop stop;
  stop.tolerance = 1e-8;
  std::size_t iterations_of_k_cycle = 0;
  for(const Schedule& schedule : {Schedule::v_cycle(1, 1), Schedule::k_cycle(1, 1)}) {
    const auto precondition = [&](const Complex_vector<double>& r, Complex_vector<double>& z) {
      levels.precondition(schedule, levels.number_of_levels() - 1, r, z);
    };
    Dense_vector x;
    const auto report = minimize(s, stop, precondition, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(energy(s.whole, x) - s.least(), 1e-8 * energy(s.whole, x));
    iterations_of_k_cycle = report.iterations;
  }
  Dense_vector x;
  const auto plain = minimize(s, stop, Jacobi_preconditioner<double>(s.matrix), x);
  EXPECT_LT(4 * iterations_of_k_cycle, plain.iterations); // or there would be no point in it
}

TEST(Conjugate_gradient, stops_when_told)
{
  Random_numbers random(20);
  const Pinned_system s = random_system(10, random);
  Complex_vector<double> z = to_vector<double>(s.start);
  Energy_stop stop;
  stop.tolerance = 1e-12;
  int calls = 0;
  const auto report = minimize_energy(s.matrix, z, energy(s.whole, s.start),
                                      Jacobi_preconditioner<double>(s.matrix), stop,
                                      [&](double) { return ++calls < 3; });
  EXPECT_TRUE(report.cancelled);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3u);
}

TEST(Conjugate_gradient, stands_still_at_the_minimum)
{
  Random_numbers random(21);
  Pinned_system s = random_system(7, random);
  s.start = Dense_vector::Zero(49); // all pins in one point: the minimum is that point
  Dense_vector x;
  const auto report = minimize(s, Energy_stop(), Jacobi_preconditioner<double>(s.matrix), x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.energy_gap, 0.);
  EXPECT_EQ(x, s.start);
}

// Never too low on a geometric series, and at first not much too high. (Of a long iteration the
// estimate is what its second half has gained.)
TEST(Energy_gap_estimator, bounds_a_geometric_series)
{
  for(const double rate : {0.1, 0.5, 0.9, 0.99}) {
    Energy_gap_estimator estimator;
    double step = 1.;
    for(int k = 0; k < 150; ++k, step *= rate) {
      const double exact = step / (1. - rate), estimate = estimator.remaining();
      if(k < 3) {
        EXPECT_EQ(estimate, std::numeric_limits<double>::infinity());
      } else {
        EXPECT_GE(estimate, 0.999 * exact) << "step " << k << " of rate " << rate;
      }
      if(k >= 3 && k <= 64) {
        EXPECT_LE(estimate, 20. / rate * exact) << "step " << k << " of rate " << rate;
      }
      estimator.add(step);
    }
  }
}

// The first step gains a thousand times what the next one does, and these fall slowly.
TEST(Energy_gap_estimator, does_not_take_the_first_fall_for_the_rate)
{
  for(const auto kind : {Gap_estimate::STEADY, Gap_estimate::WARY}) {
    Energy_gap_estimator estimator(0., kind);
    estimator.add(1000.);
    double step = 1.;
    for(int k = 1; k < 30; ++k, step *= 0.9) {
      estimator.add(step);
      EXPECT_GE(estimator.remaining(), step * 0.9 / 0.1) << "step " << k;
    }
  }
}

TEST(Energy_gap_estimator, is_wary_after_a_burst)
{
  Energy_gap_estimator steady, wary(0., Gap_estimate::WARY);
  const auto add = [&](double decrease) {
    steady.add(decrease);
    wary.add(decrease);
    EXPECT_GE(wary.remaining(), steady.remaining());
  };
  for(int k = 0; k < 12; ++k)
    add(std::pow(0.5, k));
  EXPECT_LT(wary.remaining(), 0.01);
  for(const double burst : {3., 2., 1.}) // hundreds of times what was promised
    add(burst);
  for(int k = 0; k < 12; ++k)
    add(std::pow(0.5, k));
  EXPECT_GT(wary.remaining(), 100. * steady.remaining());
}

// Steps that gain nothing are the end.
TEST(Energy_gap_estimator, is_zero_where_nothing_is_gained)
{
  Energy_gap_estimator estimator(0., Gap_estimate::WARY);
  for(int k = 0; k < 6; ++k)
    estimator.add(0.);
  EXPECT_EQ(estimator.remaining(), 0.);
}

// Without a good preconditioner the energy falls in steps; what lies between is not the end.
TEST(Energy_gap_estimator, does_not_trust_a_plateau)
{
  Energy_gap_estimator estimator;
  for(int k = 0; k < 150; ++k)
    estimator.add(k < 100 ? 1. : std::pow(0.9, k - 100) * 1e-3);
  EXPECT_GE(estimator.remaining(), 20.);
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

} // namespace multigrid_test
