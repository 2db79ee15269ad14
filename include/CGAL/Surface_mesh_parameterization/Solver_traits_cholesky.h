// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_SOLVER_TRAITS_CHOLESKY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_SOLVER_TRAITS_CHOLESKY_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Multigrid/Hermitian_matrix.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Multigrid/Sparse_cholesky.h>
#endif

#include <CGAL/Default.h>

#include <complex>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

namespace internal {

// Matrices of iterative solvers know that they are symmetric; others are told.
template <class Matrix>
std::shared_ptr<Matrix> symmetric_matrix(int size)
{
  if constexpr(std::is_constructible<Matrix, int, int, bool>::value)
    return std::make_shared<Matrix>(size, size, true);
  else
    return std::make_shared<Matrix>(size);
}

} // namespace internal

/*!
\ingroup PkgHLSCMParameterizer

The class `Solver_traits_cholesky` lets a solver of CGAL, on real numbers, solve the coarsest level:
the complex unknown \f$ u + iv \f$ becomes two real ones, and the row \f$ h = a + ib \f$ the rows
\f$ (a, -b) \f$ and \f$ (b, a) \f$.

\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d`

\cgalModels{MultigridCoarsestSolver}
*/
template <class SolverTraits>
class Solver_traits_cholesky
{
public:
  /// Constructs it on a copy of `traits`.
  explicit Solver_traits_cholesky(const SolverTraits& traits = SolverTraits()) : m_traits(traits) {}

  /// Factorizes `matrix`, rows of zeros left out; returns whether that succeeded.
  template <class Real>
  bool factorize(const Multigrid::Hermitian_matrix<Real>& matrix)
  {
    typedef typename SolverTraits::NT NT;
    const std::uint32_t pinned = std::uint32_t(-1);
    std::vector<std::uint32_t> rank(matrix.size(), pinned);
    m_free.clear();
    for(std::uint32_t i = 0; i < matrix.size(); ++i)
      if(matrix.diagonal()[i] != Real(0)) {
        rank[i] = std::uint32_t(m_free.size());
        m_free.push_back(i);
      }
    m_is_factorized = true;
    if(m_free.empty())
      return true;
    const int n = int(m_free.size());
    const std::vector<std::uint32_t> slot = matrix.slot_of_row();
    m_matrix = internal::symmetric_matrix<typename SolverTraits::Matrix>(2 * n);
    const auto set = [&](int i, int j, std::complex<double> h) {
      m_matrix->set_coef(2 * i, 2 * j, NT(h.real()), true);
      m_matrix->set_coef(2 * i + 1, 2 * j + 1, NT(h.real()), true);
      if(h.imag() != 0.) {
        m_matrix->set_coef(2 * i, 2 * j + 1, NT(-h.imag()), true);
        m_matrix->set_coef(2 * i + 1, 2 * j, NT(h.imag()), true);
      }
    };
    for(int i = 0; i < n; ++i) {
      set(i, i, std::complex<double>(matrix.diagonal()[m_free[i]]));
      matrix.for_each_entry(slot[m_free[i]], [&](std::uint32_t j, std::complex<Real> value) {
        if(rank[j] != pinned)
          set(i, int(rank[j]), std::complex<double>(value));
      });
    }
    NT scale;
    m_is_factorized = m_traits.factor(*m_matrix, scale);
    return m_is_factorized;
  }

  /// Returns whether the last call of `factorize()` succeeded; `false` before.
  bool is_factorized() const { return m_is_factorized; }

  /// Solves for `x`; unknowns of rows of zeros become 0.
  template <class Real>
  void solve(const Multigrid::Complex_vector<Real>& f, Multigrid::Complex_vector<Real>& x)
  {
    typedef typename SolverTraits::NT NT;
    x.assign(f.size(), std::complex<Real>(0));
    const int n = int(m_free.size());
    if(n == 0)
      return;
    typename SolverTraits::Vector b(2 * n), y(2 * n);
    for(int i = 0; i < n; ++i) {
      b.set(2 * i, NT(f[m_free[i]].real()));
      b.set(2 * i + 1, NT(f[m_free[i]].imag()));
    }
    m_traits.linear_solver(b, y);
    for(int i = 0; i < n; ++i)
      x[m_free[i]] = std::complex<Real>(Real(y[2 * i]), Real(y[2 * i + 1]));
  }

private:
  SolverTraits m_traits;
  std::shared_ptr<typename SolverTraits::Matrix> m_matrix; // some factorizations refer to it
  std::vector<std::uint32_t> m_free;
  bool m_is_factorized = false;
};

namespace internal {

// What solves the coarsest level: a model of `MultigridCoarsestSolver` that hides which one it is,
// so that all that is above it is compiled once. Copies share the solver.
class Coarsest_solver
{
public:
  // Constructs the default one, a sparse Cholesky factorization.
  Coarsest_solver();

  template <class Solver>
  explicit Coarsest_solver(std::shared_ptr<Solver> solver)
    : m_solver(std::make_shared<Model<Solver>>(std::move(solver)))
  {}

  template <class Real>
  bool factorize(const Multigrid::Hermitian_matrix<Real>& matrix)
  {
    return m_solver->factorize(matrix);
  }

  bool is_factorized() const { return m_solver->is_factorized(); }

  template <class Real>
  void solve(const Multigrid::Complex_vector<Real>& f, Multigrid::Complex_vector<Real>& x)
  {
    m_solver->solve(f, x);
  }

private:
  struct Base
  {
    virtual ~Base() {}
    virtual bool factorize(const Multigrid::Hermitian_matrix<float>& matrix) = 0;
    virtual bool factorize(const Multigrid::Hermitian_matrix<double>& matrix) = 0;
    virtual bool is_factorized() const = 0;
    virtual void solve(const Multigrid::Complex_vector<float>& f,
                       Multigrid::Complex_vector<float>& x) = 0;
    virtual void solve(const Multigrid::Complex_vector<double>& f,
                       Multigrid::Complex_vector<double>& x) = 0;
  };

  template <class Solver>
  struct Model
    : public Base
  {
    explicit Model(std::shared_ptr<Solver> s) : solver(std::move(s)) {}

    bool factorize(const Multigrid::Hermitian_matrix<float>& matrix) override
    {
      return solver->factorize(matrix);
    }
    bool factorize(const Multigrid::Hermitian_matrix<double>& matrix) override
    {
      return solver->factorize(matrix);
    }
    bool is_factorized() const override { return solver->is_factorized(); }
    void solve(const Multigrid::Complex_vector<float>& f,
               Multigrid::Complex_vector<float>& x) override
    {
      solver->solve(f, x);
    }
    void solve(const Multigrid::Complex_vector<double>& f,
               Multigrid::Complex_vector<double>& x) override
    {
      solver->solve(f, x);
    }

    std::shared_ptr<Solver> solver;
  };

  std::shared_ptr<Base> m_solver;
};

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE Coarsest_solver::Coarsest_solver()
  : Coarsest_solver(std::make_shared<Multigrid::Sparse_cholesky<>>())
{}
#endif

template <class SolverTraits, class = void>
struct Has_factor
  : std::false_type
{};
template <class SolverTraits>
struct Has_factor<SolverTraits, std::void_t<decltype(std::declval<SolverTraits&>().factor(
                                  std::declval<const typename SolverTraits::Matrix&>(),
                                  std::declval<typename SolverTraits::NT&>()))>>
  : std::true_type
{};

// What solves the coarsest level for an object of the template argument of a parameterizer.
template <class SolverTraits>
Coarsest_solver coarsest_solver_of(const SolverTraits& traits)
{
  static_assert(Has_factor<SolverTraits>::value,
                "The solver of a conformal parameterizer needs factor(): it must be a model of "
                "SparseLinearAlgebraWithFactorTraits_d.");
  if constexpr(Has_factor<SolverTraits>::value)
    return Coarsest_solver(std::make_shared<Solver_traits_cholesky<SolverTraits>>(traits));
  else
    return Coarsest_solver();
}

inline Coarsest_solver coarsest_solver_of(const Default&) { return Coarsest_solver(); }

} // namespace internal

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_SOLVER_TRAITS_CHOLESKY_H
