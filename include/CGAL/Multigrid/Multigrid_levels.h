// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_MULTIGRID_LEVELS_H
#define CGAL_MULTIGRID_MULTIGRID_LEVELS_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Multigrid/Smoothers.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <utility>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Multigrid_levels` runs cycles over the matrices of a hierarchy, which it refers to. They
are in single precision by default: a cycle is a preconditioner, which need not be exact.

\tparam Transfer a model of `MultigridTransfer`
\tparam CoarsestSolver a model of `MultigridCoarsestSolver`
\tparam Value an entry of the matrices, of any type that `Value_traits` knows
\tparam Smoother a model of `MultigridSmoother`

\cgalModels{MultigridLevels}
*/
template <class Transfer, class CoarsestSolver, class Value = std::complex<float>,
          class Smoother = Chebyshev_smoother<Value>>
class Multigrid_levels
{
public:
  typedef Self_adjoint_matrix<Value> Matrix; ///< the matrix of a level
  typedef Value_vector<Value> Vector;        ///< a vector of a level

  /// Adds a level that is finer than those before it. Level 0 has no transfer. The matrix and the
  /// transfer must stay where they are.
  void add_level(const Matrix& matrix, const Transfer* from_coarser)
  {
    Level level;
    level.matrix = &matrix;
    level.smoother.set_matrix(matrix);
    level.from_coarser = from_coarser;
    for(std::uint32_t i = 0; i < matrix.size(); ++i)
      if(Diagonal_traits::is_zero(matrix.diagonal()[i]))
        level.pins.push_back(i);
    m_levels.push_back(std::move(level));
  }

  /// Takes note that row `i` of the matrix of `level` has been taken out or put back. Of level 0
  /// the matrix must then be factorized anew, by `factorize_coarsest()`. Logarithmic in the number
  /// of rows of zeros if they are taken out in ascending order, linear otherwise.
  void update_row(std::size_t level, std::uint32_t i)
  {
    const Matrix& h = matrix(level);
    m_levels[level].smoother.update_row(h, i);
    std::vector<std::uint32_t>& pins = m_levels[level].pins;
    const auto at = std::lower_bound(pins.begin(), pins.end(), i);
    const bool is_pin = Diagonal_traits::is_zero(h.diagonal()[i]);
    const bool was_pin = at != pins.end() && *at == i;
    if(is_pin && !was_pin)
      pins.insert(at, i);
    else if(was_pin && !is_pin)
      pins.erase(at);
  }

  /// Returns the number of levels.
  std::size_t number_of_levels() const { return m_levels.size(); }

  /// Returns the matrix of a level.
  const Matrix& matrix(std::size_t level) const { return *m_levels[level].matrix; }

  /// Returns the solver of level 0, which may be made ready by a more precise matrix than that of
  /// level 0.
  CoarsestSolver& coarsest_solver() { return m_coarsest; }

  /// Factorizes the matrix of level 0; returns whether that succeeded. `precondition()` does it if
  /// `coarsest_solver()` is not factorized by then.
  ///
  /// \pre there is a level
  bool factorize_coarsest() { return m_coarsest.factorize(matrix(0)); }

  /// Sets `x` to the result of one cycle of `schedule` on the right-hand side `r` of level `l`,
  /// from 0. The right-hand side is scaled to norm 1 meanwhile, so that single precision can hold
  /// it.
  ///
  /// \tparam V an entry of a vector, perhaps in another precision than those of the levels
  ///
  /// Returns whether the coarsest level had a factorization. Without one it adds nothing to the
  /// cycle, which then converges as slowly as its smoother.
  template <class V>
  bool precondition(const Schedule& schedule, std::size_t l, const std::vector<V>& r,
                    std::vector<V>& x)
  {
    typedef typename Value_traits<V>::Real Real;
    Level& level = m_levels[l];
    const double norm = std::sqrt(squared_norm(r));
    const Real down = norm > 0. ? Real(1. / norm) : Real(0), up = Real(norm);
    level.f.resize(r.size());
    for_each_index(r.size(), [&](std::size_t i) {
      level.f[i] = Vector_traits::from(r[i] * down);
    });
    if(!m_coarsest.is_factorized())
      factorize_coarsest();
    start_at_zero(l);
    cycle(*this, schedule, l);
    materialize(level);
    x.resize(r.size());
    for_each_index(r.size(), [&](std::size_t i) {
      x[i] = Value_traits<V>::from(level.u[i]) * up;
    });
    return m_coarsest.is_factorized();
  }

  /// Returns the bytes that the levels take: matrices, smoothers, and the vectors of cycles so far.
  std::size_t memory() const
  {
    std::size_t result = 0;
    for(const Level& level : m_levels)
      result += memory(level);
    return result;
  }

  /// Prints the levels as a table: the rows, nonzeros and memory (matrices and the vectors of
  /// cycles so far) of each, the ratio of its rows to those of the next coarser one, and the sums
  /// of all levels divided by the finest one's (the operator complexity). The finest level comes
  /// first. Linear time.
  friend std::ostream& operator<<(std::ostream& out, const Multigrid_levels& levels)
  {
    Blocked_execution::Level_table table("rows", "nonzeros");
    for(const Level& level : levels.m_levels)
      table.add({level.matrix->size(), level.matrix->number_of_nonzeros(), memory(level)});
    return out << table;
  }

  /// \name The operations of a cycle
  /// @{

  /// Takes `steps` steps of the smoother on the system of `level`.
  void smooth(std::size_t level, unsigned int steps);
  /// Sets the right-hand side of `level - 1` to the restricted residual of `level`, its unknowns
  /// to 0.
  void restrict_residual(std::size_t level);
  /// Adds the prolonged unknowns of `level - 1` to those of `level`.
  void correct(std::size_t level);
  /// Solves the system of level 0.
  void solve_coarsest();
  /// Approximates the solution on `level` by up to `steps` steps of the flexible conjugate gradient
  /// method preconditioned by `coarse_cycle()`, fewer if the residual has fallen to a quarter.
  template <class Coarse_cycle>
  void accelerate(std::size_t level, unsigned int steps, const Coarse_cycle& coarse_cycle);
  /// @}

private:
  typedef Value_traits<typename Value_traits<Value>::Diagonal> Diagonal_traits;
  typedef typename Value_traits<Value>::Vector_value Vector_value;
  typedef Value_traits<Vector_value> Vector_traits;
  typedef typename Vector_traits::Scalar Scalar;

  struct Level
  {
    const Matrix* matrix = nullptr;
    Smoother smoother;
    const Transfer* from_coarser = nullptr;
    std::vector<std::uint32_t> pins; // rows of zeros, ascending, whose corrections stay 0
    Vector u, f;                   // the system of the moment
    Vector r, z;                   // residual f - H u, and the step of the smoother
    bool is_zero = true;           // u is 0, whatever is stored
    bool has_residual = false;     // r is f - H u
    bool has_step = false;         // r - H z is f - H u
    Vector x;                      // of the accelerator
    std::vector<Vector> p, q;      // earlier directions and H times them
  };

  void start_at_zero(std::size_t l)
  {
    m_levels[l].is_zero = true;
    forget_residual(m_levels[l]);
  }

  static std::size_t memory(const Level& level)
  {
    std::size_t entries = 0;
    for(const Vector* x : {&level.u, &level.f, &level.r, &level.z, &level.x})
      entries += x->size();
    for(const std::vector<Vector>* vectors : {&level.p, &level.q})
      for(const Vector& x : *vectors)
        entries += x.size();
    return level.matrix->memory() + level.smoother.memory() + entries * sizeof(Vector_value);
  }

  // What comes from or goes to a coarser level that does not have a pin leaves it alone.
  static void clear_pins(const Level& level, Vector& x)
  {
    for(const std::uint32_t i : level.pins)
      x[i] = Vector_traits::zero();
  }

  static void forget_residual(Level& level) { level.has_residual = level.has_step = false; }

  void materialize(Level& level)
  {
    if(level.is_zero)
      set_zero(level.f.size(), level.u);
    level.is_zero = false;
  }

  void update_residual(Level& level);

  std::vector<Level> m_levels;
  CoarsestSolver m_coarsest;
};

template <class Transfer, class CoarsestSolver, class Value, class Smoother>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::update_residual(Level& level)
{
  if(level.has_residual)
    return;
  const Matrix& h = *level.matrix;
  if(level.has_step) // r - H z
    h.for_each_row_sum(level.z, [&](std::size_t i, const Vector_value& s) {
      level.r[i] -= h.diagonal()[i] * level.z[i] + s;
    });
  else if(level.is_zero) {
    level.r.resize(level.f.size());
    for_each_index(level.r.size(), [&level](std::size_t i) { level.r[i] = level.f[i]; });
  } else {
    level.r.resize(level.f.size());
    h.for_each_row_sum(level.u, [&](std::size_t i, const Vector_value& s) {
      level.r[i] = level.f[i] - (h.diagonal()[i] * level.u[i] + s);
    });
  }
  level.has_residual = true;
}

template <class Transfer, class CoarsestSolver, class Value, class Smoother>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::smooth(std::size_t l, unsigned int steps)
{
  if(steps == 0)
    return;
  Level& level = m_levels[l];
  update_residual(level);
  materialize(level);
  level.smoother.smooth(*level.matrix, steps, level.u, level.r, level.z);
  level.has_residual = false;
  level.has_step = true; // its product waits until the residual is asked for
}

template <class Transfer, class CoarsestSolver, class Value, class Smoother>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::restrict_residual(std::size_t l)
{
  Level& level = m_levels[l];
  Level& coarse = m_levels[l - 1];
  update_residual(level);
  clear_pins(level, level.r);
  level.from_coarser->restrict_in_place(level.r, coarse.f);
  forget_residual(level);
  start_at_zero(l - 1);
}

template <class Transfer, class CoarsestSolver, class Value, class Smoother>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::correct(std::size_t l)
{
  Level& level = m_levels[l];
  materialize(m_levels[l - 1]);
  materialize(level);
  level.from_coarser->prolongate(m_levels[l - 1].u, level.z);
  clear_pins(level, level.z);
  for_each_index(level.u.size(), [&](std::size_t i) { level.u[i] += level.z[i]; });
  forget_residual(level);
}

template <class Transfer, class CoarsestSolver, class Value, class Smoother>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::solve_coarsest()
{
  Level& level = m_levels[0];
  if(m_coarsest.is_factorized())
    m_coarsest.solve(level.f, level.u);
  else
    set_zero(level.f.size(), level.u);
  level.is_zero = false;
  forget_residual(level);
}

// Steps of the flexible conjugate gradient method, preconditioned by the cycle: each direction is
// made H-orthogonal to the earlier ones. A step that has reduced the residual to a quarter is the
// last (Notay and Vassilevski 2008, section 3).
template <class Transfer, class CoarsestSolver, class Value, class Smoother>
template <class Coarse_cycle>
void Multigrid_levels<Transfer, CoarsestSolver, Value, Smoother>::
accelerate(std::size_t l, unsigned int steps, const Coarse_cycle& coarse_cycle)
{
  Level& level = m_levels[l];
  set_zero(level.f.size(), level.x);
  level.p.resize(steps);
  level.q.resize(steps);
  const double enough = 0.0625 * squared_norm(level.f); // a quarter, squared
  for(unsigned int step = 0; step < steps; ++step) {
    start_at_zero(l);
    coarse_cycle();
    materialize(level);
    Vector& p = level.p[step];
    Vector& q = level.q[step];
    p.swap(level.u);
    level.u.resize(p.size());
    q.resize(p.size());
    level.matrix->multiply(p, q);
    for(unsigned int j = 0; j < step; ++j) {
      const Scalar c(-inner_product(level.q[j], p)
                     / std::real(inner_product(level.p[j], level.q[j])));
      add_scaled(c, level.p[j], p);
      add_scaled(c, level.q[j], q);
    }
    const double curvature = std::real(inner_product(p, q));
    if(!(curvature > 0.))
      break;
    const Scalar alpha(inner_product(p, level.f) / curvature);
    add_scaled(alpha, p, level.x);
    if(step + 1 == steps)
      break;
    add_scaled(-alpha, q, level.f);
    if(squared_norm(level.f) <= enough)
      break;
  }
  level.u.swap(level.x);
  level.is_zero = false;
  forget_residual(level);
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_MULTIGRID_LEVELS_H
