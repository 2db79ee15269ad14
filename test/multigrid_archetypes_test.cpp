// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multigrid layer with models of its concepts that can do nothing but what the concept pages
// ask for: whatever else a header uses does not compile here. Where a concept does not ask for
// copies or default construction, its archetype has none.

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Multigrid/Rayleigh_quotient.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace multigrid_archetypes_test {

using namespace CGAL::Multigrid;

typedef Self_adjoint_matrix<double> Matrix;
typedef std::vector<double> Vector;

struct No_copies // and neither moves nor a default constructor
{
  explicit No_copies(int) {}
  No_copies(const No_copies&) = delete;
  No_copies& operator=(const No_copies&) = delete;
};

// --- The concepts

// Each value of the coarse level is that of two neighbours of the fine one.
class Transfer_archetype : No_copies // MultigridTransfer
{
public:
  Transfer_archetype() : No_copies(0) {}

  void prolongate(const Vector& coarse, Vector& fine) const
  {
    fine.resize(2 * coarse.size());
    for(std::size_t i = 0; i < fine.size(); ++i)
      fine[i] = coarse[i / 2];
  }
  void restrict_in_place(Vector& fine, Vector& coarse) const
  {
    coarse.resize(fine.size() / 2);
    for(std::size_t i = 0; i < coarse.size(); ++i)
      coarse[i] = fine[2 * i] + fine[2 * i + 1];
    fine.assign(fine.size(), std::nan("")); // may be lost
  }
};

// Gaussian elimination, without pins.
class Coarsest_solver_archetype // MultigridCoarsestSolver
{
public:
  Coarsest_solver_archetype() {}
  Coarsest_solver_archetype(const Coarsest_solver_archetype&) = delete;
  Coarsest_solver_archetype& operator=(const Coarsest_solver_archetype&) = delete;

  bool factorize(const Matrix& h)
  {
    m_a.assign(h.size(), Vector(h.size(), 0.));
    const auto slot = h.slot_of_row();
    for(std::uint32_t i = 0; i < h.size(); ++i) {
      m_a[i][i] = h.diagonal()[i];
      h.for_each_entry(slot[i], [&](std::uint32_t j, double value) { m_a[i][j] = value; });
    }
    return true;
  }
  bool is_factorized() const { return !m_a.empty(); }
  void solve(const Vector& f, Vector& x)
  {
    std::vector<Vector> a = m_a;
    x = f;
    for(std::size_t k = 0; k < a.size(); ++k)
      for(std::size_t i = 0; i < a.size(); ++i)
        if(i != k) {
          const double factor = a[i][k] / a[k][k];
          for(std::size_t j = 0; j < a.size(); ++j)
            a[i][j] -= factor * a[k][j];
          x[i] -= factor * x[k];
        }
    for(std::size_t i = 0; i < a.size(); ++i)
      x[i] /= a[i][i];
  }

private:
  std::vector<Vector> m_a;
};

// Steps of Richardson's method, for matrices with a spectrum below 8.
class Smoother_archetype // MultigridSmoother
{
public:
  Smoother_archetype() {}
  Smoother_archetype(Smoother_archetype&&) = default;
  Smoother_archetype& operator=(Smoother_archetype&&) = delete;

  void set_matrix(const Matrix&) {}
  void update_row(const Matrix&, std::uint32_t) {}
  void smooth(const Matrix& h, unsigned int steps, Vector& u, Vector& r, Vector& z) const
  {
    z.assign(u.size(), 0.);
    for(unsigned int k = 0; k < steps; ++k) {
      Vector product(z.size());
      h.multiply(z, product);
      for(std::size_t i = 0; i < u.size(); ++i) {
        r[i] -= product[i];
        u[i] += z[i] = r[i] / 5.;
      }
    }
  }
  std::size_t memory() const { return 0; }
};

// One unknown on each level, whose value is counted up.
class Levels_archetype : No_copies // MultigridLevels
{
public:
  Levels_archetype() : No_copies(0) {}

  void smooth(std::size_t, unsigned int steps) { calls += steps; }
  void restrict_residual(std::size_t) { ++calls; }
  void correct(std::size_t) { ++calls; }
  void solve_coarsest() { ++calls; }
  template <class CoarseCycle>
  void accelerate(std::size_t, unsigned int, const CoarseCycle& coarse_cycle) { coarse_cycle(); }

  unsigned int calls = 0;
};

// The product with tridiag(-1, 3, -1).
class Operator_archetype : No_copies // MultigridOperator
{
public:
  Operator_archetype() : No_copies(0) {}

  void operator()(const Vector& x, Vector& y) const
  {
    for(std::size_t i = 0; i < x.size(); ++i)
      y[i] = 3. * x[i] - (i > 0 ? x[i - 1] : 0.) - (i + 1 < x.size() ? x[i + 1] : 0.);
  }
};

class Preconditioner_archetype : No_copies // MultigridPreconditioner
{
public:
  Preconditioner_archetype() : No_copies(0) {}

  void operator()(const Vector& r, Vector& z) const { z = r; }
};

double inner_product(const Vector& x, const Vector& y)
{
  double sum = 0.;
  for(std::size_t i = 0; i < x.size(); ++i)
    sum += x[i] * y[i];
  return sum;
}

// Those of the operator above, and of the identity as B; without a preconditioner.
class Rayleigh_vectors_archetype : No_copies // RayleighVectors
{
public:
  typedef double Inner;

  explicit Rayleigh_vectors_archetype(const Vector& x) : No_copies(0)
  {
    m_x.fill(Vector(x.size(), 0.));
    m_x[0] = x;
  }

  double begin()
  {
    project(m_x[0]);
    return normalize();
  }
  void set_residual(double q)
  {
    Operator_archetype()(m_x[0], m_x[1]);
    for(std::size_t i = 0; i < m_x[0].size(); ++i)
      m_x[1][i] -= q * m_x[0][i];
    project(m_x[1]);
  }
  Rayleigh_products<double> products(int count)
  {
    std::array<Vector, 3> h = m_x;
    for(int i = 0; i < count; ++i)
      Operator_archetype()(m_x[i], h[i]);
    return Rayleigh_products<double>::of(
      count, [&](int i, int j) { return inner_product(m_x[i], h[j]); },
      [&](int i, int j) { return inner_product(m_x[i], m_x[j]); });
  }
  double step(const std::vector<double>& y)
  {
    for(std::size_t i = 0; i < m_x[0].size(); ++i) {
      m_x[2][i] = y[1] * m_x[1][i] + (y.size() > 2 ? y[2] * m_x[2][i] : 0.);
      m_x[0][i] = y[0] * m_x[0][i] + m_x[2][i];
    }
    return normalize();
  }
  double largest_change() { return largest_entry(m_x[2]); }

  const Vector& first() const { return m_x[0]; } // for the test

private:
  static void project(Vector& x)
  {
    const double mean = inner_product(x, Vector(x.size(), 1.)) / double(x.size());
    for(double& value : x)
      value -= mean;
  }
  double normalize()
  {
    const double norm = std::sqrt(inner_product(m_x[0], m_x[0]));
    for(Vector* x : {&m_x[0], &m_x[2]})
      for(double& value : *x)
        value /= norm;
    Vector h(m_x[0].size());
    Operator_archetype()(m_x[0], h);
    return inner_product(m_x[0], h);
  }

  std::array<Vector, 3> m_x;
};

// --- Their use

Matrix matrix_of_operator(std::uint32_t n)
{
  return Matrix_builder::build_matrix<double>(
    std::vector<std::uint32_t>(n, 2), [n](std::uint32_t i, Matrix::Row& row) {
      row.diagonal = 3.;
      if(i > 0)
        row.entries.push_back({i - 1, -1.});
      if(i + 1 < n)
        row.entries.push_back({i + 1, -1.});
    });
}

const auto always = [](double) { return true; };

Energy_stop strict()
{
  Energy_stop stop;
  stop.tolerance = 1e-20;
  return stop;
}

// |f - H x| / |f|
double relative_residual(const Vector& f, const Vector& x)
{
  Vector y(x.size());
  Operator_archetype()(x, y);
  add_scaled(-1., f, y);
  return std::sqrt(squared_norm(y) / squared_norm(f));
}

TEST(Multigrid_archetypes, of_the_cycle)
{
  Levels_archetype levels;
  cycle(levels, Schedule::v_cycle(1, 2), 2);
  EXPECT_EQ(levels.calls, 2u * (1 + 2 + 2) + 1);
  cycle(levels, Schedule::k_cycle(1, 1), 3);
}

TEST(Multigrid_archetypes, of_the_conjugate_gradients)
{
  const Operator_archetype apply;
  const Preconditioner_archetype precondition;
  Vector f(20, 0.), x(20, 0.);
  f[7] = 1.;
  EXPECT_TRUE(minimize_energy(apply, f, x, precondition, strict(), always).converged);
  EXPECT_LE(relative_residual(f, x), 1e-9);
  Vector y(20, 1.);
  EXPECT_TRUE(minimize_energy(apply, y, 30. - 19., precondition, strict(), always).converged);
  EXPECT_LE(largest_entry(y), 1e-9);
  Energy_stop few;
  few.maximal_iterations = 3;
  x[0] = 1.;
  minimize_rayleigh_quotient(apply, Diagonal_mass({{0, 1.}, {9, 2.}}), x, precondition, few, always);
}

// Of all vectors of length 1 and mean 0 the one of least energy: its residual is constant, and its
// energy is at most that of a known eigenvector of mean 0.
TEST(Multigrid_archetypes, of_the_rayleigh_quotient)
{
  Vector x(20, 0.), h(20);
  x[3] = 1.;
  x[11] = -2.;
  Rayleigh_vectors_archetype vectors(x);
  const Iteration_report report = minimize_rayleigh_quotient(vectors, strict(), always);
  EXPECT_TRUE(report.converged);
  x = vectors.first();
  EXPECT_NEAR(inner_product(x, x), 1., 1e-12);
  EXPECT_NEAR(inner_product(x, Vector(20, 1.)), 0., 1e-12);
  Operator_archetype()(x, h);
  const double q = inner_product(x, h), pi = std::acos(-1.);
  EXPECT_NEAR(q, 2. * report.energy, 1e-12);
  EXPECT_LE(q, 3. - 2. * std::cos(2. * pi / 21.) + 1e-12);
  const double constant = h[0] - q * x[0];
  for(std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(h[i] - q * x[i], constant, 1e-8);
}

TEST(Multigrid_archetypes, of_the_levels)
{
  const Transfer_archetype transfer;
  const std::vector<Matrix> matrices = {matrix_of_operator(8), matrix_of_operator(16)};
  Multigrid_levels<Transfer_archetype, Coarsest_solver_archetype, double, Smoother_archetype> levels;
  levels.add_level(matrices[0], nullptr);
  levels.add_level(matrices[1], &transfer);
  levels.update_row(1, 3);
  const auto precondition = [&](const Vector& r, Vector& z) {
    EXPECT_TRUE(levels.precondition(Schedule::v_cycle(2, 2), 1, r, z));
  };
  Vector f(16, 1.), x(16, 0.);
  f[2] = -3.;
  const auto report
    = minimize_energy(matrices[1], f, x, precondition, strict(), always);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(relative_residual(f, x), 1e-9);
  std::ostringstream out;
  out << levels;
  EXPECT_NE(out.str().find("16"), std::string::npos);
}

} // namespace multigrid_archetypes_test
