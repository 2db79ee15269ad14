// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_NEWTON_STEPS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_NEWTON_STEPS_H

#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Surface_mesh_multigrid/galerkin_rows.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Past_steps.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/stretch_matrix.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Where the cycles get the matrices of coarser levels from.
enum class Coarse_matrices
{
  OF_LAST_STEPS, // those of the last steps that were made there: nothing is computed for them
  GALERKIN       // products of that of the finest level: slower, where those do not fit or are not there
};

// The steps of Newton's method on a level after the other: conjugate gradients, preconditioned by
// multigrid cycles.
class Newton_steps
{
public:
  typedef std::vector<Plane_point> Vectors;

  // Of conjugate gradients, a step, and where these are too few.
  static constexpr std::size_t usual_iterations = 5, many_iterations = 20;

  explicit Newton_steps(Coarse_matrices coarse = Coarse_matrices::OF_LAST_STEPS) : m_coarse(coarse) {}

  // Begins with the next finer level; `from_coarser` is null for the first. It must live as long as
  // the object.
  void add_level(const Surface_mesh_multiresolution::Prolongation* from_coarser)
  {
    m_past.forget();
    m_rest = 0;
    m_next_rest = 1;
    m_is_solved = true;
    if(!m_transfers.empty())
      m_coarser.push_back(std::make_unique<Stretch_matrix::Single>(m_matrix.take_single()));
    m_transfers.push_back(from_coarser);
  }

  // From now on the matrices of coarser levels are these; once `GALERKIN`, those of last steps are lost.
  void use(Coarse_matrices coarse) { m_coarse = coarse; }

  // Steps made so far say nothing of those to come: what is fixed is elsewhere.
  void forget_past() { m_past.forget(); }

  // Makes one step on the finest level so far, by at most `iterations` iterations.
  template <class Energy>
  void operator()(Stretch_level<Energy>& level, std::size_t iterations)
  {
    double slope = 0.;
    Vectors step = direction(level, Vectors(), iterations, slope);
    const Descent descent = slope < 0. ? level.go(step, slope) : Descent();
    Multigrid::for_each_index(step.size(), [&](std::size_t v) { step[v] = step[v] * descent.length; });
    m_step = std::move(step);
    m_gain = descent.gain;
    m_is_full = descent.length >= full;
    if(!m_is_full) {
      m_past.forget();
      m_rest = m_next_rest;
      m_next_rest = (std::min)(2 * m_next_rest, longest_rest);
    } else if(m_rest > 0)
      --m_rest;
  }

  // By how much the energy fell in the last step, should have fallen up to the second order, and fell
  // otherwise, as a part of that.
  double gain() const { return m_gain; }
  double foretold() const { return m_solved; }
  double surprise() const { return m_solved > 0. ? std::abs(m_gain - m_solved) / m_solved : 1.; }
  // By how much the energy, up to the second order, would have fallen beyond what the linear system of
  // the step gained, as far as can be estimated.
  double unsolved() const { return m_unsolved; }
  // Whether its solution surely got half the way.
  bool is_solved() const { return m_is_solved; }
  // Whether no triangle that would have turned over made the step short.
  bool is_full() const { return m_is_full; }
  // Whether the last step did not move, though the second order foretold, if it is a number at all, that
  // the energy falls by more than that.
  bool is_stuck(double energy) const { return !(m_gain > 0.) && !(m_solved <= energy); }

  // By how much the energy should have fallen in all, up to the second order, which is known of the last steps.
  double decrement() const { return m_decrement; }
  // That of the next step, as far as the matrix of this one tells: most of that step is spared. Infinity if it is not
  // known, as after a short one.
  template <class Energy>
  double next_decrement(Stretch_level<Energy>& level);

  // The way of each vertex in it; none if there was nowhere to go.
  const Vectors& last_step() const { return m_step; }

  // Where such a step goes; `slope` becomes the derivative of the energy there. Fixed vertices go by
  // `pulled`, if it is not empty, and all others as the energy, up to the second order, is least then.
  // Empty if there is nowhere to go.
  template <class Energy>
  Vectors direction(Stretch_level<Energy>& level, const Vectors& pulled, std::size_t iterations, double& slope);

  std::size_t iterations() const { return m_iterations; } // of all steps

private:
  typedef Multigrid::Sparse_cholesky<Multigrid::Real_factorization> Coarsest;
  typedef Multigrid::Multigrid_levels<Surface_mesh_multiresolution::Prolongation, Coarsest,
                                      Eigen::Matrix2f> Levels;

  // The coarsest matrix is made definite: translations and the rotation change no energy.
  static constexpr double shift = 1e-6;

  // What ends iterations: the residual, of that before them, or what the energy will still fall by, as far as can be
  // estimated, of what it fell by; a better direction gains hardly more.
  static constexpr double residual = 1e-3, part_left = 0.03;

  // A few iterations say little of their rate: so many more as good as the last ones are the most that
  // an energy has still to fall.
  static constexpr double tail = 20.;

  // Where triangles are about to turn over steps are short, and the past says nothing of what comes:
  // it is left out for a while after each of them, for a longer one every time.
  static constexpr double full = 0.5;
  static constexpr std::size_t longest_rest = 16;

  static double norm(const Vectors& vectors) { return std::sqrt(Past_steps::product(vectors, vectors)); }

  // Of a linear system: where its energy is least, as far as the iterations got, by how much it fell until then, and
  // by how much it will fall.
  struct Solution
  {
    Vectors way;
    double gain = 0., unsolved = 0.;
    bool is_half_way = true; // surely
  };

  // For a gradient, or for the way of fixed vertices, see `direction()`.
  template <class Energy>
  Solution solve(Vectors gradient, const Stretch_level<Energy>& level, const Vectors& pulled,
                 std::size_t iterations);

  // Products of the matrix on coarser levels; the coarsest may be itself.
  void set_coarser()
  {
    Multigrid::Sparse_rows<Eigen::Matrix2d> rows;
    for(const auto& matrix : m_coarser)
      *matrix = Stretch_matrix::Single();
    if(m_coarser.empty())
      rows = Multigrid::Sparse_rows<Eigen::Matrix2d>(m_matrix);
    for(std::size_t l = m_coarser.size(); l-- > 0;) {
      const auto& transfer = *m_transfers[l + 1];
      rows = l + 1 == m_coarser.size() ? Surface_mesh_multigrid::galerkin_rows(m_matrix, transfer)
                                       : Surface_mesh_multigrid::galerkin_rows(rows, transfer);
      *m_coarser[l] = rows.matrix<Stretch_matrix::Single::Traits::Stored>();
    }
    rows.shift_diagonal(shift);
    m_coarsest = rows.matrix<Eigen::Matrix2d>();
  }

  Coarse_matrices m_coarse;
  std::vector<const Surface_mesh_multiresolution::Prolongation*> m_transfers;
  Stretch_matrix m_matrix; // of the finest level so far
  std::vector<std::unique_ptr<Stretch_matrix::Single>> m_coarser;
  Multigrid::Self_adjoint_matrix<Eigen::Matrix2d> m_coarsest;
  Past_steps m_past;
  Vectors m_step;
  std::size_t m_rest = 0, m_next_rest = 1; // steps without the past
  double m_solved = 0., m_unsolved = 0., m_decrement = 0., m_gain = 0.;
  bool m_is_solved = true, m_is_full = true;
  std::size_t m_iterations = 0;
};

template <class Energy>
Newton_steps::Vectors Newton_steps::direction(Stretch_level<Energy>& level, const Vectors& pulled,
                                              std::size_t iterations, double& slope)
{
  level.linearize();
  m_matrix = Stretch_matrix(); // before there is another one
  Vectors().swap(m_step);
  Vectors its_own;
  m_matrix = stretch_matrix(level, its_own);
  const bool is_noted = pulled.empty() && m_rest == 0;
  if(is_noted)
    m_past.add(level.places(), std::move(its_own));
  const Vectors& gradient = is_noted ? m_past.gradient() : its_own;
  Vectors rest = m_past.rest_of(gradient);
  m_solved = m_unsolved = m_decrement = 0.;
  m_is_solved = true;
  if(m_coarse == Coarse_matrices::GALERKIN || m_coarser.empty())
    set_coarser();
  Solution found = solve(std::move(rest), level, pulled, iterations);
  if(found.way.empty())
    return {};
  m_solved = found.gain;
  m_unsolved = found.unsolved;
  m_is_solved = found.is_half_way;
  if(is_noted)
    m_past.leave(level.places());
  if(pulled.empty())
    m_past.complete(found.way);
  slope = Past_steps::product(found.way, gradient);
  m_decrement = -0.5 * slope + m_unsolved;
  if(!(slope < 0.))
    m_past.forget();
  return std::move(found.way);
}

template <class Energy>
double Newton_steps::next_decrement(Stretch_level<Energy>& level)
{
  constexpr std::size_t few_iterations = 3; // with fewer no one knows what they leave
  constexpr double infinity = (std::numeric_limits<double>::infinity)();
  if(!m_is_full || m_rest > 0)
    return infinity;
  level.linearize();
  m_past.add(level.places(), stretch_gradient(level));
  Solution found = solve(m_past.rest_of(m_past.gradient()), level, Vectors(), few_iterations);
  if(found.way.empty())
    return infinity;
  m_past.complete(found.way);
  const double slope = Past_steps::product(found.way, m_past.gradient());
  return slope < 0. ? found.unsolved - 0.5 * slope : infinity;
}

template <class Energy>
Newton_steps::Solution Newton_steps::solve(Vectors gradient, const Stretch_level<Energy>& level,
                                           const Vectors& pulled, std::size_t iterations)
{
  typedef Eigen::Vector2d Vector;
  Levels levels;
  for(std::size_t l = 0; l < m_coarser.size(); ++l)
    levels.add_level(*m_coarser[l], m_transfers[l]);
  levels.add_level(m_matrix.single(), m_transfers.back());
  if(!levels.coarsest_solver().factorize(m_coarsest))
    return {};
  double size = norm(gradient);
  if(!pulled.empty() && !(size > 0.))
    size = norm(pulled);
  if(!(size > 0.))
    return {};
  std::vector<Vector> f(gradient.size()), x(gradient.size(), Vector::Zero());
  for(std::size_t v = 0; v < f.size(); ++v)
    f[v] = Vector(-gradient[v].x / size, -gradient[v].y / size);
  Vectors().swap(gradient);
  for(std::size_t v = 0; v < pulled.size(); ++v)
    if(level.is_fixed(v))
      x[v] = Vector(pulled[v].x / size, pulled[v].y / size);
  Multigrid::Energy_stop stop;
  stop.tolerance = part_left;
  stop.residual_tolerance = residual;
  stop.maximal_iterations = iterations;
  const auto schedule = Multigrid::Schedule::v_cycle(1, 1);
  const auto cycle = [&](const std::vector<Vector>& r, std::vector<Vector>& z) {
    levels.precondition(schedule, m_coarser.size(), r, z);
  };
  const Multigrid::Iteration_report report
    = Multigrid::minimize_energy(m_matrix, std::move(f), x, cycle, stop, [](double) { return true; });
  m_iterations += report.iterations;
  const double most = report.converged ? -part_left * report.energy : tail * report.decrease;
  Solution result = {Vectors(x.size()), -report.energy * size * size,
                     (std::min)(report.energy_gap, most) * size * size,
                     report.converged || report.energy_gap <= -report.energy};
  for(std::size_t v = 0; v < x.size(); ++v)
    result.way[v] = Plane_point{x[v].x(), x[v].y()} * size;
  return result;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_NEWTON_STEPS_H
