// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_SOLVER_H

#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The K-cycle over distributed levels, as PETSc's two-level cycles in one another: the coarse
// problem of each is solved by flexible conjugate gradients preconditioned by the next, at the end
// by the hierarchy in the memory of rank 0.
class Distributed_solver
{
public:
  typedef std::complex<double> Complex;

  Distributed_solver(Ranks& ranks, Distributed_hierarchy& hierarchy)
    : m_ranks(ranks), m_hierarchy(hierarchy)
  {
    const std::size_t n = hierarchy.size_of_gathered(), own = ranks.rank() == 0 ? n : 0;
    check(VecCreateMPI(ranks.comm(), PetscInt(own), PETSC_DETERMINE, m_gathered.put()));
    check(MatCreateConstantDiagonal(ranks.comm(), PetscInt(own), PetscInt(own), PetscInt(n),
                                    PetscInt(n), 1., m_nothing.put()));
    if(!levels().empty())
      create_cycle();
  }

  std::size_t number_of_levels() const { return m_hierarchy.levels().size(); }
  const Distributed_level& level(std::size_t l) const { return m_hierarchy.levels()[l - 1]; }

  // A vector of level l, from 1 on; or of level 0, which is all on rank 0.
  Petsc_vector vector(std::size_t l) const
  {
    return vector_like(l == 0 ? Vec(m_gathered) : Vec(level(l).pinned));
  }

  // Lowers the energy of z on level l, whose pins are 0 there.
  template <class Observe>
  Multigrid::Iteration_report minimize(std::size_t l, Vec z, const Multigrid::Energy_stop& stop,
                                       const Observe& observe);

  // Sets u to the result of one cycle on the right-hand side r of level l.
  void precondition(std::size_t l, Vec r, Vec u) const;

  // x^H y
  static Complex product(Vec x, Vec y)
  {
    PetscScalar result;
    check(VecDot(y, x, &result));
    return result;
  }

  double energy(std::size_t l, Vec z) const
  {
    const Petsc_vector r = residual(l, z);
    return energy(l, z, r);
  }

  // What `internal::relax_flipped_faces()` does, on the finest level. `values(x)` returns those of
  // a map at the corners of `triangles`.
  template <class Values>
  void relax_flips(Vec z, const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                   const Values& values);

  // z with its pins.
  Petsc_vector with_pins(std::size_t l, Vec z) const
  {
    Petsc_vector result = vector(l);
    check(VecWAXPY(result, 1., z, level(l).pinned));
    return result;
  }

private:
  std::vector<Distributed_level>& levels() { return m_hierarchy.levels(); }

  // The residual of z.
  Petsc_vector residual(std::size_t l, Vec z) const
  {
    Petsc_vector r = vector(l);
    check(MatMult(level(l).matrix, z, r));
    check(VecAYPX(r, -1., level(l).right_side));
    return r;
  }
  double energy(std::size_t l, Vec z, Vec r) const
  {
    return level(l).energy_of_pins - 0.5 * (product(z, r) + product(z, level(l).right_side)).real();
  }

  void minimize_on_patch(Vec z, const std::vector<PetscInt>& patch);
  void create_cycle();
  void set_cycle(KSP solver, std::size_t l);

  static PetscErrorCode smooth_diagonally(PC pc, Vec r, Vec z);
  static PetscErrorCode solve_gathered(PC pc, Vec r, Vec z);

  Ranks& m_ranks;
  Distributed_hierarchy& m_hierarchy;
  Petsc_vector m_gathered;
  Petsc_matrix m_nothing; // in place of the matrix of level 0, which PETSc does not see
  Petsc_solver m_cycle;   // its preconditioner is that of the finest level
};

// PETSc calls these: what fails must not be thrown through it.
inline PetscErrorCode Distributed_solver::smooth_diagonally(PC pc, Vec r, Vec z)
{
  void* context = nullptr;
  const PetscErrorCode error = PCShellGetContext(pc, &context);
  if(error != 0)
    return error;
  return VecPointwiseMult(z, r, static_cast<Distributed_level*>(context)->inverse_diagonal);
}

inline PetscErrorCode Distributed_solver::solve_gathered(PC pc, Vec r, Vec z)
{
  void* context = nullptr;
  const PetscErrorCode error = PCShellGetContext(pc, &context);
  Distributed_solver& self = *static_cast<Distributed_solver*>(context);
  if(error != 0 || self.m_ranks.rank() != 0)
    return error;
  try {
    Petsc_part right(r), solution(z);
    Gathered_hierarchy::Vector f(right.begin(), right.end()), u;
    self.m_hierarchy.gathered().correct(f, u);
    std::copy(u.begin(), u.end(), solution.begin());
  } catch(const std::bad_alloc&) { // the others wait for an answer
    MPI_Abort(self.m_ranks.comm(), 1);
  }
  return 0;
}

inline void Distributed_solver::create_cycle()
{
  check(KSPCreate(m_ranks.comm(), m_cycle.put()));
  check(KSPSetType(m_cycle, KSPPREONLY)); // no vectors for an iteration of its own
  check(KSPSetOptionsPrefix(m_cycle, "hlscm_distributed_")); // options of the caller are not for it
  set_cycle(m_cycle, number_of_levels());
  check(KSPSetUp(m_cycle));
}

// Gives a solver of level l the cycle as its preconditioner.
inline void Distributed_solver::set_cycle(KSP solver, std::size_t l)
{
  PC pc, diagonal;
  KSP smoother, coarse;
  Distributed_level& fine = levels()[l - 1];
  const Multigrid::Schedule schedule;
  check(KSPSetOperators(solver, fine.matrix, fine.matrix));
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCMG));
  check(PCMGSetLevels(pc, 2, nullptr));
  check(PCMGSetInterpolation(pc, 1, fine.prolongation));
  check(PCMGSetNumberSmooth(pc, PetscInt(schedule.pre_smoothing)));

  check(PCMGGetSmoother(pc, 1, &smoother));
  check(KSPSetType(smoother, KSPCHEBYSHEV));
  check(KSPSetNormType(smoother, KSP_NORM_NONE));
  check(KSPChebyshevSetEigenvalues(smoother, 2., 0.3)); // 2 bounds them; see `Chebyshev_smoother`
  check(KSPSetOperators(smoother, fine.matrix, fine.matrix));
  check(KSPGetPC(smoother, &diagonal));
  check(PCSetType(diagonal, PCSHELL));
  check(PCShellSetContext(diagonal, &fine));
  check(PCShellSetApply(diagonal, smooth_diagonally));

  check(PCMGGetCoarseSolve(pc, &coarse));
  if(l > 1) {
    check(KSPSetType(coarse, KSPFCG));
    check(KSPFCGSetMmax(coarse, PetscInt(schedule.coarse_visits)));
    check(KSPFCGSetNprealloc(coarse, PetscInt(schedule.coarse_visits)));
    check(KSPSetNormType(coarse, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(coarse, 0.25, PETSC_DEFAULT, PETSC_DEFAULT,
                           PetscInt(schedule.coarse_visits)));
    check(KSPConvergedDefaultSetConvergedMaxits(coarse, PETSC_TRUE)); // else it visits once more
    set_cycle(coarse, l - 1);
    return;
  }
  PC shell;
  check(KSPSetType(coarse, KSPPREONLY));
  check(KSPSetOperators(coarse, m_nothing, m_nothing));
  check(KSPGetPC(coarse, &shell));
  check(PCSetType(shell, PCSHELL));
  check(PCShellSetContext(shell, this));
  check(PCShellSetApply(shell, solve_gathered));
}

inline void Distributed_solver::precondition(std::size_t l, Vec r, Vec u) const
{
  PC cycle = nullptr;
  check(KSPGetPC(m_cycle, &cycle));
  for(std::size_t k = number_of_levels(); k > l; --k) {
    KSP coarse;
    check(PCMGGetCoarseSolve(cycle, &coarse));
    check(KSPGetPC(coarse, &cycle));
  }
  check(PCApply(cycle, r, u));
  level(l).clear_pins(u);
}

// As `Multigrid::minimize_energy()`.
template <class Observe>
Multigrid::Iteration_report
Distributed_solver::minimize(std::size_t l, Vec z, const Multigrid::Energy_stop& stop,
                             const Observe& observe)
{
  const Petsc_vector r = residual(l, z), p = vector(l), q = vector(l), u = vector(l);
  Multigrid::Iteration_control control(stop, energy(l, z, r));
  double curvature = 0.;
  while(control.goes_on()) {
    precondition(l, r, u);
    if(curvature > 0.) // make the direction H-orthogonal to the last one
      check(VecAXPY(u, -product(q, u) / curvature, p));
    check(VecSwap(p, u));
    check(MatMult(level(l).matrix, p, q));
    curvature = product(p, q).real();
    const Complex slope = product(p, r);
    if(!(curvature > 0.)) { // r is 0, or no longer above rounding
      control.end(std::norm(slope) == 0. || !(curvature < 0.));
      break;
    }
    const Complex alpha = slope / curvature;
    check(VecAXPY(z, alpha, p));
    check(VecAXPY(r, -alpha, q));
    const double decrease = 0.5 * std::norm(slope) / curvature;
    double change = 0.;
    if(control.watches_changes())
      check(VecNorm(p, NORM_INFINITY, &change));
    control.step(control.report().energy - decrease, decrease, std::abs(alpha) * change, observe);
  }
  return control.report();
}

// The patch is solved by rank 0.
template <class Values>
void Distributed_solver::relax_flips(
  Vec z, const std::vector<Indexed_mesh::Triangle_indices>& triangles, const Values& values)
{
  const std::size_t finest = number_of_levels();
  const Distributed_level& fine = level(finest);
  std::vector<PetscInt> held(fine.pins.begin(), fine.pins.end()); // on rank 0 those of all ranks
  if(m_hierarchy.is_free()) {
    for(const std::uint32_t v : rows_of(fine.mass))
      held.push_back(PetscInt(fine.first + v));
    held = m_ranks.gathered(held);
  }
  std::sort(held.begin(), held.end());
  const auto is_too_large = [&](std::size_t n) {
    return m_ranks.broadcast(n) > largest_relaxed_patch;
  };
  for(const int rings : rings_relaxed) {
    const std::vector<std::uint32_t> flipped
      = faces_without_positive_area(triangles, values(with_pins(finest, z)));
    if(m_ranks.sum(flipped.size()) == 0)
      return;
    std::vector<PetscInt> corners;
    for(const std::uint32_t t : flipped)
      corners.insert(corners.end(), triangles[t].begin(), triangles[t].end());
    corners = m_ranks.gathered(corners);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if(is_too_large(corners.size()))
      return;
    Petsc_indices around;
    check(ISCreateGeneral(PETSC_COMM_SELF, PetscInt(corners.size()), corners.data(),
                          PETSC_COPY_VALUES, around.put()));
    check(MatIncreaseOverlap(level(finest).matrix, 1, around.put(), rings));
    check(ISSort(around));
    const PetscInt* vertices = nullptr;
    PetscInt count = 0;
    check(ISGetLocalSize(around, &count));
    check(ISGetIndices(around, &vertices));
    std::vector<PetscInt> free;
    std::set_difference(vertices, vertices + count, held.begin(), held.end(),
                        std::back_inserter(free));
    check(ISRestoreIndices(around, &vertices));
    if(is_too_large(free.size()))
      return;
    minimize_on_patch(z, free);
  }
}

inline void Distributed_solver::minimize_on_patch(Vec z, const std::vector<PetscInt>& patch)
{
  const Distributed_level& fine = level(number_of_levels());
  const PetscInt n = PetscInt(patch.size());
  Petsc_indices indices;
  check(ISCreateGeneral(PETSC_COMM_SELF, n, patch.data(), PETSC_COPY_VALUES, indices.put()));
  Mat* parts = nullptr;
  const IS set = indices;
  check(MatCreateSubMatrices(fine.matrix, 1, &set, &set, MAT_INITIAL_MATRIX, &parts));
  Petsc_vector local;
  check(VecCreateSeq(PETSC_COMM_SELF, n, local.put()));
  Petsc_object<VecScatter, VecScatterDestroy> scatter;
  check(VecScatterCreate(z, indices, local, nullptr, scatter.put()));
  const Petsc_vector r = residual(number_of_levels(), z);
  check(VecScatterBegin(scatter, r, local, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter, r, local, INSERT_VALUES, SCATTER_FORWARD));
  if(n > 0) {
    struct Entry { std::uint32_t column; Complex value; };
    std::vector<std::vector<Entry>> rows(patch.size());
    std::vector<double> diagonal(patch.size(), 0.);
    for(PetscInt i = 0; i < n; ++i) {
      PetscInt size = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      check(MatGetRow(parts[0], i, &size, &columns, &values));
      for(PetscInt k = 0; k < size; ++k)
        if(columns[k] == i)
          diagonal[std::size_t(i)] = values[k].real();
        else
          rows[std::size_t(i)].push_back({std::uint32_t(columns[k]), values[k]});
      check(MatRestoreRow(parts[0], i, &size, &columns, &values));
    }
    Petsc_part values(local);
    const Multigrid::Complex_vector<double> f(values.begin(), values.end());
    Multigrid::Complex_vector<double> x;
    solve_on_patch(diagonal, [&rows](std::uint32_t i, const auto& use) {
      for(const Entry& entry : rows[i])
        use(entry.column, entry.value);
    }, f, x);
    std::copy(x.begin(), x.end(), values.begin());
  }
  check(VecScatterBegin(scatter, local, z, ADD_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(scatter, local, z, ADD_VALUES, SCATTER_REVERSE));
  check(MatDestroySubMatrices(1, &parts));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_SOLVER_H
