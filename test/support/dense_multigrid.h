// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_DENSE_MULTIGRID_H
#define HLSCM_TEST_SUPPORT_DENSE_MULTIGRID_H

// Dense linear algebra to hold the multigrid layer against. To be included first:
#if defined(__GNUC__) && !defined(__clang__)
// the compiler's own AVX-512 intrinsics alarm GCC 12 where Eigen uses them on complex numbers.
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include <support/mesh_generators.h>

#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>

#include <Eigen/Dense>

#include <algorithm>
#include <complex>
#include <functional>
#include <utility>
#include <vector>

namespace test_support {

typedef Eigen::MatrixXcd Dense_matrix;
typedef Eigen::VectorXcd Dense_vector;

class Random_numbers
{
public:
  explicit Random_numbers(std::uint64_t seed) : m_random(seed) {}

  double real() { return uniform(m_random, -1., 1.); }
  std::complex<double> complex() { const double re = real(); return {re, real()}; }
  bool chance(double probability) { return uniform(m_random, 0., 1.) < probability; }
  std::size_t below(std::size_t size) { return uniform_index(m_random, size); }
  Random& engine() { return m_random; }

private:
  Random m_random;
};

// --- Vectors

inline Dense_vector random_vector(int n, Random_numbers& random)
{
  Dense_vector x(n);
  for(int i = 0; i < n; ++i)
    x(i) = random.complex();
  return x;
}

template <class Real>
CGAL::Multigrid::Complex_vector<Real> to_vector(const Dense_vector& x)
{
  CGAL::Multigrid::Complex_vector<Real> result;
  for(Eigen::Index i = 0; i < x.size(); ++i)
    result.push_back(std::complex<Real>(x(i)));
  return result;
}

template <class Real>
Dense_vector to_dense(const CGAL::Multigrid::Complex_vector<Real>& x)
{
  Dense_vector result(x.size());
  for(std::size_t i = 0; i < x.size(); ++i)
    result(i) = std::complex<double>(x[i]);
  return result;
}

inline double relative_error(const Dense_vector& x, const Dense_vector& expected)
{
  return (x - expected).norm() / (std::max)(expected.norm(), 1e-300);
}

// The matrix of the linear map `apply`.
template <class Apply>
Dense_matrix matrix_of(int columns, const Apply& apply)
{
  Dense_matrix result;
  for(int j = 0; j < columns; ++j) {
    const Dense_vector column = apply(Dense_vector(Dense_vector::Unit(columns, j)));
    result.conservativeResize(column.size(), columns);
    result.col(j) = column;
  }
  return result;
}

// --- Matrices

// Off-diagonal entries are there with the probability `density`; half of them are real; every fifth
// row and column is empty beside the diagonal.
inline Dense_matrix random_hermitian_matrix(int n, double density, Random_numbers& random)
{
  Dense_matrix a = Dense_matrix::Zero(n, n);
  for(int i = 0; i < n; ++i) {
    a(i, i) = random.real();
    for(int j = 0; j < i; ++j)
      if(i % 5 != 4 && j % 5 != 4 && random.chance(density)) {
        a(i, j) = random.chance(0.5) ? random.complex() : random.real();
        a(j, i) = std::conj(a(i, j));
      }
  }
  return a;
}

// The same with a diagonal that makes it positive definite: it exceeds the sum of the moduli of the
// row by the part `excess`.
inline Dense_matrix random_definite_matrix(int n, double density, Random_numbers& random,
                                           double excess = 0.1)
{
  Dense_matrix a = random_hermitian_matrix(n, density, random);
  for(int i = 0; i < n; ++i) {
    a(i, i) = 0.;
    a(i, i) = a.row(i).cwiseAbs().sum() * (1. + excess) + excess;
  }
  return a;
}

// The sum over the edges of a side x side grid of w |x_i - e^(i phase) x_j|^2 with random weights
// and small random phases: as hard for an iteration as the matrix of a surface.
inline Dense_matrix twisted_grid_matrix(int side, Random_numbers& random)
{
  Dense_matrix a = Dense_matrix::Zero(side * side, side * side);
  const auto add_edge = [&](int i, int j) {
    const double weight = 1. + 0.8 * random.real();
    a(i, i) += weight;
    a(j, j) += weight;
    a(i, j) = -weight * std::polar(1., 0.02 * random.real());
    a(j, i) = std::conj(a(i, j));
  };
  for(int i = 0; i < side * side; ++i) {
    if(i % side + 1 < side)
      add_edge(i, i + 1);
    if(i + side < side * side)
      add_edge(i, i + side);
  }
  return a;
}

// With the rows of `pins` 0, as the solvers expect the matrix of a pinned system.
inline Dense_matrix with_pinned_rows(Dense_matrix a, const std::vector<int>& pins)
{
  for(const int pin : pins)
    a.row(pin).setZero();
  return a;
}

// With the rows and columns of `pins` 0.
inline Dense_matrix with_pins(const Dense_matrix& a, const std::vector<int>& pins)
{
  return with_pinned_rows(with_pinned_rows(a, pins).adjoint(), pins).adjoint();
}

// Solves for what is not pinned; pins get 0.
inline Dense_vector solve_free(Dense_matrix a, const std::vector<int>& pins, Dense_vector f)
{
  a = with_pins(a, pins);
  for(const int pin : pins) {
    a(pin, pin) = 1.;
    f(pin) = 0.;
  }
  return a.ldlt().solve(f);
}

// The minimiser of x^H a x with the values of `x` at the pins.
inline Dense_vector minimizer(const Dense_matrix& a, const std::vector<int>& pins, Dense_vector x)
{
  return x + solve_free(a, pins, -(a * x));
}

// The matrix with the entries of `a` that are not 0, in random order; rows are announced longer
// than they are by `slack`.
template <class Real>
CGAL::Multigrid::Hermitian_matrix<Real> sparse_matrix(const Dense_matrix& a, int slack = 0)
{
  std::vector<CGAL::Multigrid::Matrix_row> rows(a.rows());
  std::vector<std::uint32_t> lengths;
  Random_numbers random(99);
  for(int i = 0; i < a.rows(); ++i) {
    rows[i].diagonal = a(i, i).real();
    for(const auto j : random_permutation(a.cols(), random.engine()))
      if(int(j) != i && a(i, j) != std::complex<double>(0.))
        rows[i].entries.push_back({j, a(i, j).real(), a(i, j).imag()});
    lengths.push_back(std::uint32_t(rows[i].entries.size() + slack));
  }
  return CGAL::Multigrid::Matrix_builder::build<Real>(
    lengths, [&](std::uint32_t i, CGAL::Multigrid::Matrix_row& row) { row = rows[i]; });
}

// What is stored in a matrix.
template <class Real>
Dense_matrix to_dense(const CGAL::Multigrid::Hermitian_matrix<Real>& h)
{
  Dense_matrix result = Dense_matrix::Zero(h.size(), h.size());
  const auto slot = h.slot_of_row();
  for(std::size_t i = 0; i < h.size(); ++i) {
    result(i, i) = double(h.diagonal()[i]);
    h.for_each_entry(slot[i], [&](std::uint32_t j, std::complex<Real> value) {
      result(i, j) = std::complex<double>(value);
    });
  }
  return result;
}

// --- Hierarchies

// From the `coarse` first vertices of a random order to all `fine` ones; the stencils of later
// vertices may refer to earlier ones.
inline CGAL::Surface_mesh_multiresolution::Prolongation
random_prolongation(int coarse, int fine, Random_numbers& random)
{
  const auto order = random_permutation(fine, random.engine());
  typedef CGAL::Surface_mesh_multiresolution::Prolongation Prolongation;
  std::vector<Prolongation::Stencil> stencils;
  for(int k = coarse; k < fine; ++k) {
    const double a = 0.5 + 0.5 * random.real(), b = (1. - a) * (0.5 + 0.5 * random.real());
    stencils.push_back({order[k], {order[random.below(k)], order[random.below(k)],
                                   order[random.below(k)]},
                        {float(a), float(b), float(1. - a - b)}});
  }
  return Prolongation({order.begin(), order.begin() + coarse}, std::move(stencils));
}

inline Dense_matrix dense_prolongation(const CGAL::Surface_mesh_multiresolution::Prolongation& p)
{
  return matrix_of(int(p.kept().size()), [&](const Dense_vector& x) {
    CGAL::Multigrid::Complex_vector<double> fine;
    p.prolongate(to_vector<double>(x), fine);
    return to_dense(fine);
  });
}

// A chain of 2^k * 8 + 1 vertices whose ends are pinned, with a Laplacian that is twisted a little
// by complex phases, and the Galerkin matrices of its coarser versions. Rows and columns of pins
// are 0.
struct Chain_hierarchy
{
  Dense_matrix whole;                   // the finest matrix with the pins' rows and columns
  std::vector<Dense_matrix> matrices;   // of each level, the coarsest first
  std::vector<std::vector<int>> pins;   // of each level
  std::vector<CGAL::Surface_mesh_multiresolution::Prolongation> prolongations; // [0] is empty

  Chain_hierarchy(std::size_t number_of_levels, Random_numbers& random)
    : matrices(number_of_levels), pins(number_of_levels), prolongations(number_of_levels)
  {
    whole = twisted_chain((8 << (number_of_levels - 1)) + 1, random);
    Dense_matrix a = whole;
    for(std::size_t l = number_of_levels; l-- > 0;) {
      pins[l] = {0, int(a.rows()) - 1};
      matrices[l] = with_pins(a, pins[l]);
      if(l == 0)
        break;
      prolongations[l] = halving(int(a.rows()));
      const Dense_matrix p = dense_prolongation(prolongations[l]);
      a = p.transpose() * a * p;
    }
  }

  int size() const { return int(whole.rows()); }

  // A vector that is 0 at the pins.
  Dense_vector random_solution(Random_numbers& random) const
  {
    Dense_vector x = random_vector(size(), random);
    for(const int pin : pins.back())
      x(pin) = 0.;
    return x;
  }

  Dense_vector random_right_hand_side(Random_numbers& random) const
  {
    return random_solution(random);
  }

private:
  // The sum over the edges of |x_i - e^(i phase) x_(i+1)|^2
  static Dense_matrix twisted_chain(int n, Random_numbers& random)
  {
    Dense_matrix a = Dense_matrix::Zero(n, n);
    for(int i = 0; i + 1 < n; ++i) {
      const double weight = 1. + 0.3 * random.real();
      a(i, i) += weight;
      a(i + 1, i + 1) += weight;
      a(i, i + 1) = -weight * std::polar(1., 0.02 * random.real());
      a(i + 1, i) = std::conj(a(i, i + 1));
    }
    return a;
  }

  // Every other vertex stays, the others are the means of their neighbours.
  static CGAL::Surface_mesh_multiresolution::Prolongation halving(int n)
  {
    typedef CGAL::Surface_mesh_multiresolution::Prolongation Prolongation;
    std::vector<Vertex_index> kept;
    std::vector<Prolongation::Stencil> stencils;
    for(Vertex_index v = 0; v < Vertex_index(n); ++v)
      if(v % 2 == 0)
        kept.push_back(v);
      else
        stencils.push_back({v, {v - 1, v + 1, v + 1}, {0.5f, 0.25f, 0.25f}});
    return Prolongation(std::move(kept), std::move(stencils));
  }
};

// The levels of a chain in single precision.
template <class Smoother = CGAL::Multigrid::Chebyshev_smoother<std::complex<float>>>
struct Sparse_levels
  : CGAL::Multigrid::Multigrid_levels<CGAL::Surface_mesh_multiresolution::Prolongation,
                                      CGAL::Multigrid::Sparse_cholesky<>, std::complex<float>,
                                      Smoother>
{
  std::vector<CGAL::Multigrid::Hermitian_matrix<float>> matrices;

  explicit Sparse_levels(const Chain_hierarchy& hierarchy)
  {
    for(const auto& h : hierarchy.matrices)
      matrices.push_back(sparse_matrix<float>(h));
    for(std::size_t l = 0; l < matrices.size(); ++l)
      this->add_level(matrices[l], l == 0 ? nullptr : &hierarchy.prolongations[l]);
  }
};

// `steps` steps of a smoother on a u = f.
typedef std::function<void(const Dense_matrix& a, unsigned int steps, const Dense_vector& f,
                           Dense_vector& u)> Dense_smoother;

// The Chebyshev smoother by its three-term recurrence (Lottes 2022, algorithm 3), on D of its
// definition.
inline void dense_chebyshev(const Dense_matrix& a, unsigned int steps, const Dense_vector& f,
                            Dense_vector& u)
{
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(a.rows());
  for(Eigen::Index i = 0; i < a.rows(); ++i)
    if(a(i, i).real() > 0.)
      inverse(i) = 2. / (a(i, i).real() + a.row(i).cwiseAbs().sum() - std::abs(a(i, i)));
  Dense_vector z = Dense_vector::Zero(u.size());
  for(unsigned int k = 1; k <= steps; ++k) {
    z = (2. * k - 3.) / (2. * k + 1.) * z
      + (8. * k - 4.) / (2. * k + 1.) / 2. * inverse.cwiseProduct(f - a * u);
    u += z;
  }
}

// Algorithm 1 of the paper in dense matrices, and the Krylov acceleration of Notay and Vassilevski.
class Dense_levels
{
public:
  explicit Dense_levels(const Chain_hierarchy& hierarchy, Dense_smoother smooth = dense_chebyshev)
    : m_hierarchy(hierarchy), m_smooth(std::move(smooth))
  {
    for(std::size_t l = 0; l < hierarchy.matrices.size(); ++l)
      m_prolongations.push_back(l == 0 ? Dense_matrix()
                                       : dense_prolongation(hierarchy.prolongations[l]));
  }

  // One cycle from 0 on the finest level.
  Dense_vector cycle(const CGAL::Multigrid::Schedule& s, const Dense_vector& f)
  {
    Dense_vector u = Dense_vector::Zero(f.size());
    cycle(s, m_hierarchy.matrices.size() - 1, f, u);
    return u;
  }

private:
  void cycle(const CGAL::Multigrid::Schedule& s, std::size_t l, const Dense_vector& f,
             Dense_vector& u)
  {
    const Dense_matrix& a = m_hierarchy.matrices[l];
    if(l == 0) {
      u = solve_free(a, m_hierarchy.pins[0], f);
      return;
    }
    m_smooth(a, s.pre_smoothing, f, u);
    const Dense_vector coarse_f = m_prolongations[l].transpose() * (f - a * u);
    Dense_vector v = Dense_vector::Zero(coarse_f.size());
    if(s.acceleration == CGAL::Multigrid::Acceleration::KRYLOV && l > 1)
      v = accelerate(s, l - 1, coarse_f);
    else
      for(unsigned int visit = 0; visit < s.coarse_visits; ++visit)
        cycle(s, l - 1, coarse_f, v);
    u += m_prolongations[l] * v;
    m_smooth(a, s.post_smoothing, f, u);
  }

  // Minimises the energy over the span of all directions so far, each a cycle on the residual.
  Dense_vector accelerate(const CGAL::Multigrid::Schedule& s, std::size_t l, const Dense_vector& f)
  {
    const Dense_matrix& a = m_hierarchy.matrices[l];
    Dense_matrix directions(f.size(), 0);
    Dense_vector x = Dense_vector::Zero(f.size());
    for(unsigned int step = 0; step < s.coarse_visits; ++step) {
      const Dense_vector residual = f - a * x;
      if(step > 0 && residual.norm() <= 0.25 * f.norm())
        break;
      Dense_vector direction = Dense_vector::Zero(f.size());
      cycle(s, l, residual, direction);
      directions.conservativeResize(f.size(), step + 1);
      directions.col(step) = direction;
      const Dense_matrix gram = directions.adjoint() * a * directions;
      x = directions * gram.ldlt().solve(directions.adjoint() * f);
    }
    return x;
  }

  const Chain_hierarchy& m_hierarchy;
  Dense_smoother m_smooth;
  std::vector<Dense_matrix> m_prolongations;
};

} // namespace test_support

#endif
