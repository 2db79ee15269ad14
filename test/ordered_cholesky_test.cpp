// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Systems of blocks, beside dense ones.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_texturing/internal/filling/Ordered_cholesky.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace ordered_cholesky_test {

using CGAL::Surface_mesh_texturing::internal::Ordered_cholesky;
using CGAL::Surface_mesh_texturing::internal::Upper_blocks;
using namespace test_support;

std::size_t index(std::size_t below, Random& random)
{
  return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
}

double number(Random& random) { return std::uniform_real_distribution<>(-1., 1.)(random); }

// A symmetric matrix of blocks for points, a few of which meet.
struct System
{
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  System(std::size_t points, std::size_t pairs, Random& random)
    : matrix(Eigen::MatrixXd::Zero(2 * points, 2 * points)), right(2 * points)
  {
    for(std::size_t i = 0; i < points; ++i)
      add(i, i, random);
    for(std::size_t k = 0; k < pairs; ++k)
      add(index(points, random), index(points, random), random);
    for(Eigen::Index i = 0; i < right.size(); ++i)
      right[i] = number(random);
  }

  // A square of what two points have in common
  void add(std::size_t i, std::size_t j, Random& random)
  {
    Eigen::MatrixXd root = Eigen::MatrixXd::Zero(2, matrix.cols());
    for(Eigen::Index side = 0; side < 2; ++side)
      for(Eigen::Index k = 0; k < 2; ++k) {
        root(side, Eigen::Index(2 * i) + k) += number(random) + (side == k ? 2. : 0.);
        root(side, Eigen::Index(2 * j) + k) += number(random);
      }
    matrix += root.transpose() * root;
  }

  // Sets what `Ordered_cholesky::solve()` asks for.
  void operator()(const Ordered_cholesky& solver, Upper_blocks& upper, Eigen::VectorXd& ordered) const
  {
    upper = Upper_blocks();
    upper.begin.push_back(0);
    const std::vector<std::uint32_t>& order = solver.order();
    for(std::uint32_t column = 0; column < order.size(); ++column) {
      for(std::uint32_t k = 0; k <= column; ++k) {
        const std::uint32_t row = column - k; // in any order
        const Upper_blocks::Block block = matrix.block<2, 2>(2 * order[row], 2 * order[column]);
        if(row == column || block != Upper_blocks::Block::Zero()) {
          upper.rows.push_back(row);
          upper.blocks.push_back(block);
        }
      }
      upper.begin.push_back(std::uint32_t(upper.rows.size()));
      ordered.segment<2>(2 * column) = right.segment<2>(2 * order[column]);
    }
  }
};

bool solve(Ordered_cholesky& solver, const System& system, Eigen::VectorXd& solution)
{
  const auto assemble = [&](Upper_blocks& upper, Eigen::VectorXd& right) { system(solver, upper, right); };
  return solver.solve(assemble, solution);
}

TEST(Ordered_cholesky, solves_what_dense_factors_solve)
{
  for(std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const std::size_t points = 1 + index(40, random);
    Ordered_cholesky solver(points);
    for(int time = 0; time < 4; ++time) { // with an order that may be of another system
      const System system(points, index(3 * points, random), random);
      Eigen::VectorXd solution;
      ASSERT_TRUE(solve(solver, system, solution)) << "seed " << seed;
      const Eigen::VectorXd dense = system.matrix.llt().solve(system.right);
      EXPECT_LT((solution - dense).norm(), 1e-9 * dense.norm()) << "seed " << seed;
      std::set<std::uint32_t> all(solver.order().begin(), solver.order().end());
      EXPECT_EQ(all.size(), points) << "seed " << seed;
      for(std::uint32_t i = 0; i < points; ++i)
        EXPECT_EQ(solver.rank()[solver.order()[i]], i) << "seed " << seed;
    }
  }
}

TEST(Ordered_cholesky, refuses_what_is_not_positive_definite)
{
  constexpr std::size_t points = 12;
  for(std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    Ordered_cholesky solver(points);
    System system(points, 20, random);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(system.matrix);
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(2 * points, 2 * points);
    Eigen::VectorXd solution;
    system.matrix -= 0.5 * eigen.eigenvalues()[0] * identity;
    EXPECT_TRUE(solve(solver, system, solution)) << "seed " << seed;
    system.matrix -= eigen.eigenvalues()[0] * identity;
    EXPECT_FALSE(solve(solver, system, solution)) << "seed " << seed;
  }
}

// A point that meets all others comes last, where it adds nothing to the factor.
TEST(Ordered_cholesky, finds_an_order_that_keeps_factors_sparse)
{
  constexpr std::size_t points = 50;
  Random random(20261130);
  System star(points, 0, random);
  for(std::size_t i = 1; i < points; ++i)
    star.add(0, i, random);
  Ordered_cholesky solver(points);
  Eigen::VectorXd solution;
  ASSERT_TRUE(solve(solver, star, solution));
  EXPECT_GE(solver.rank()[0], points - 2); // the last two are alike
}

} // namespace ordered_cholesky_test
