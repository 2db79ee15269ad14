// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSEST_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSEST_SOLVER_H

#include <CGAL/Multigrid/Hermitian_matrix.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>

#include <memory>
#include <utility>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What solves the coarsest level: a model of `MultigridCoarsestSolver` that hides which one it is,
// so that all that is above it is compiled once. Copies share the solver.
class Coarsest_solver
{
public:
  // Constructs the default one, a sparse Cholesky factorization.
  Coarsest_solver() : Coarsest_solver(std::make_shared<Multigrid::Sparse_cholesky<>>()) {}

  template <class Solver>
  explicit Coarsest_solver(std::shared_ptr<Solver> solver)
    : m_solver(std::make_shared<Model<Solver>>(std::move(solver)))
  {}

  bool factorize(const Multigrid::Hermitian_matrix<double>& matrix)
  {
    return m_solver->factorize(matrix);
  }

  template <class Real>
  void solve(const Multigrid::Complex_vector<Real>& f, Multigrid::Complex_vector<Real>& x)
  {
    m_solver->solve(f, x);
  }

private:
  struct Base
  {
    virtual ~Base() {}
    virtual bool factorize(const Multigrid::Hermitian_matrix<double>& matrix) = 0;
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

    bool factorize(const Multigrid::Hermitian_matrix<double>& matrix) override
    {
      return solver->factorize(matrix);
    }
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

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_COARSEST_SOLVER_H
