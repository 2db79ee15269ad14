// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid cycle against algorithm 1 of the paper: first as a list of operations without any
// numbers, then with dense matrices.

#include <support/dense_multigrid.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace multigrid_cycle_test {

using namespace CGAL::Multigrid;
using namespace test_support;

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
// The cycle with numbers
//

template <class Levels>
Dense_vector precondition(Levels& levels, const Schedule& schedule, const Dense_vector& r)
{
  Complex_vector<double> x;
  EXPECT_TRUE(levels.precondition(schedule, levels.number_of_levels() - 1, to_vector<double>(r),
                                  x));
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
    Sparse_levels<> levels(hierarchy);
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

// A second smoother: steps z = w D^-1 r with the diagonal D of the matrix.
class Damped_jacobi
{
public:
  typedef Hermitian_matrix<float> Matrix;
  typedef Complex_vector<float> Vector;
  static constexpr float weight = 0.6f;

  void set_matrix(const Matrix& h)
  {
    m_inverse.resize(h.size());
    for(std::uint32_t i = 0; i < h.size(); ++i)
      update_row(h, i);
  }
  void update_row(const Matrix& h, std::uint32_t i)
  {
    m_inverse[i] = h.diagonal()[i] > 0.f ? 1.f / h.diagonal()[i] : 0.f;
  }
  void smooth(const Matrix& h, unsigned int steps, Vector& u, Vector& r, Vector& z) const
  {
    z.resize(u.size());
    for(unsigned int k = 0; k < steps; ++k) {
      if(k > 0) {
        Vector product(z.size());
        h.multiply(z, product);
        add_scaled(-1.f, product, r);
      }
      for(std::size_t i = 0; i < u.size(); ++i)
        u[i] += z[i] = weight * m_inverse[i] * r[i];
    }
  }
  std::size_t memory() const { return m_inverse.size() * sizeof(float); }

private:
  std::vector<float> m_inverse;
};

void dense_damped_jacobi(const Dense_matrix& a, unsigned int steps, const Dense_vector& f,
                         Dense_vector& u)
{
  Dense_vector inverse = Dense_vector::Zero(u.size());
  for(Eigen::Index i = 0; i < u.size(); ++i)
    if(a(i, i) != 0.)
      inverse(i) = double(Damped_jacobi::weight) / a(i, i);
  for(unsigned int k = 0; k < steps; ++k)
    u += inverse.cwiseProduct(f - a * u);
}

TEST(Multigrid_levels, take_another_smoother)
{
  Random_numbers random(26);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels<Damped_jacobi> levels(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  for(std::size_t s = 0; s < schedules.size(); ++s) {
    Dense_levels reference(hierarchy, dense_damped_jacobi);
    EXPECT_LE(relative_error(precondition(levels, schedules[s], f),
                             reference.cycle(schedules[s], f)), 2e-3) << "schedule " << s;
  }
}

// Taking a row out on all levels is what building the levels without it is.
TEST(Multigrid_levels, take_note_of_rows)
{
  Random_numbers random(27);
  Chain_hierarchy hierarchy(3, random);
  Sparse_levels<> levels(hierarchy);
  Sparse_levels<Damped_jacobi> with_jacobi(hierarchy);
  for(std::size_t l = 0; l < hierarchy.matrices.size(); ++l) {
    const int middle = int(hierarchy.matrices[l].rows()) / 2;
    hierarchy.pins[l].push_back(middle);
    hierarchy.matrices[l] = with_pinned_rows(hierarchy.matrices[l], {middle});
    levels.matrices[l].take_row(std::uint32_t(middle));
    levels.update_row(l, std::uint32_t(middle));
    with_jacobi.matrices[l].take_row(std::uint32_t(middle));
    with_jacobi.update_row(l, std::uint32_t(middle));
  }
  Sparse_levels<> expected(hierarchy);
  Sparse_levels<Damped_jacobi> expected_with_jacobi(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  for(const Schedule& s : schedules) {
    EXPECT_EQ(precondition(levels, s, f), precondition(expected, s, f));
    EXPECT_EQ(precondition(with_jacobi, s, f), precondition(expected_with_jacobi, s, f));
  }
}

// Whoever does not factorize the coarsest matrix loses nothing.
TEST(Multigrid_levels, factorize_the_coarsest_matrix_themselves)
{
  Random_numbers random(28);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels<> lazy(hierarchy), eager(hierarchy);
  EXPECT_FALSE(lazy.coarsest_solver().is_factorized());
  EXPECT_TRUE(eager.factorize_coarsest());
  EXPECT_TRUE(eager.coarsest_solver().is_factorized());
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  EXPECT_EQ(precondition(lazy, Schedule(), f), precondition(eager, Schedule(), f));
}

// Without pins the chain has no factorization: the cycle says so, and smooths.
TEST(Multigrid_levels, say_that_the_coarsest_matrix_is_singular)
{
  Dense_matrix a = Dense_matrix::Zero(9, 9);
  for(int i = 0; i + 1 < 9; ++i)
    a.block(i, i, 2, 2) += (Dense_matrix(2, 2) << 1., -1., -1., 1.).finished();
  const auto h = sparse_matrix<float>(a);
  Multigrid_levels<CGAL::Surface_mesh_multiresolution::Prolongation, Sparse_cholesky<>> levels;
  levels.add_level(h, nullptr);
  Complex_vector<double> x;
  EXPECT_FALSE(levels.factorize_coarsest());
  EXPECT_FALSE(levels.precondition(Schedule(), 0, Complex_vector<double>(9, 1.), x));
  EXPECT_EQ(x, Complex_vector<double>(9, 0.));
}

TEST(Multigrid_levels, keep_pins_at_0)
{
  Random_numbers random(11);
  const Chain_hierarchy hierarchy(4, random);
  Sparse_levels<> levels(hierarchy);
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
  Sparse_levels<> levels(hierarchy);
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
  Sparse_levels<> levels(hierarchy);
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
  Sparse_levels<> levels(hierarchy);
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
  Sparse_levels<> levels(hierarchy);
  const Dense_vector f = hierarchy.random_right_hand_side(random);
  const Dense_vector x = precondition(levels, Schedule(), f);
  for(const double factor : {1e-60, 1e-20, 1e20, 1e60})
    EXPECT_LE(relative_error(precondition(levels, Schedule(), factor * f), factor * x), 1e-4);
  EXPECT_EQ(precondition(levels, Schedule(), 0. * f).norm(), 0.);
}

} // namespace multigrid_cycle_test
