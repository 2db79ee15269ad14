// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The conjugate gradient method against dense solutions, and the estimate of what it has still to
// gain.

#include <support/dense_multigrid.h>

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Smoothers.h>

#include <gtest/gtest.h>

#include <limits>

namespace conjugate_gradient_test {

using namespace CGAL::Multigrid;
using namespace test_support;

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
  Sparse_levels<> levels(hierarchy);
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

// What one of the last two steps lowered the energy by, in the mean.
TEST(Conjugate_gradient, tells_what_its_last_steps_gained)
{
  Random_numbers random(22);
  const Pinned_system s = random_system(10, random);
  const auto after = [&s](std::size_t iterations) {
    Energy_stop stop;
    stop.tolerance = 0.;
    stop.maximal_iterations = iterations;
    Dense_vector x;
    return minimize(s, stop, Jacobi_preconditioner<double>(s.matrix), x);
  };
  for(std::size_t k = 2; k < 6; ++k) {
    const double gain = after(k - 2).energy - after(k).energy;
    EXPECT_GT(gain, 0.);
    EXPECT_NEAR(after(k).decrease, 0.5 * gain, 1e-9 * after(0).energy);
  }
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

} // namespace conjugate_gradient_test
