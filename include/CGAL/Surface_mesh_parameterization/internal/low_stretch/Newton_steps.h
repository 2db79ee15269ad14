// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_NEWTON_STEPS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_NEWTON_STEPS_H

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_level.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The steps of Newton's method on a level after the other: conjugate gradients, preconditioned by
// multigrid cycles. The matrix of a coarser level is that of the last step that was made there.
class Newton_steps
{
public:
  typedef Multigrid::Self_adjoint_matrix<Eigen::Matrix2f> Matrix;

  // Begins with the next finer level; `from_coarser` is null for the first. It must live as long as
  // the object.
  void add_level(const Surface_mesh_multiresolution::Prolongation* from_coarser)
  {
    m_transfers.push_back(from_coarser);
    m_matrices.push_back(std::make_unique<Matrix>());
  }

  // Makes one step on the finest level so far, by at most `iterations` iterations, fewer if the
  // residual is below `residual` of that at first. Returns by how much the energy fell.
  template <class Energy>
  double operator()(Stretch_level<Energy>& level, std::size_t iterations, double residual);

  std::size_t iterations() const { return m_iterations; } // of all steps

private:
  typedef Multigrid::Sparse_cholesky<Multigrid::Real_factorization> Coarsest;
  typedef Multigrid::Multigrid_levels<Surface_mesh_multiresolution::Prolongation, Coarsest,
                                      Eigen::Matrix2f> Levels;

  // The coarsest matrix is made definite: translations and the rotation change no energy.
  static constexpr double shift = 1e-6;

  std::vector<const Surface_mesh_multiresolution::Prolongation*> m_transfers;
  std::vector<std::unique_ptr<Matrix>> m_matrices;
  Multigrid::Self_adjoint_matrix<Eigen::Matrix2d> m_coarsest;
  std::size_t m_iterations = 0;
};

template <class Energy>
double Newton_steps::operator()(Stretch_level<Energy>& level, std::size_t iterations,
                                double residual)
{
  typedef Eigen::Vector2d Vector; // a few very stiff triangles hide all others from single precision
  level.linearize();
  const std::vector<Plane_point> gradient = level.gradient();
  const auto matrix = level.template matrix<Eigen::Matrix2d>();
  m_matrices.back()->assign(matrix);
  Levels levels;
  for(std::size_t l = 0; l < m_matrices.size(); ++l)
    levels.add_level(*m_matrices[l], m_transfers[l]);
  if(m_matrices.size() == 1)
    m_coarsest = level.template matrix<Eigen::Matrix2d>(shift);
  if(!levels.coarsest_solver().factorize(m_coarsest))
    return 0.;
  level.forget_derivatives();
  const double size = std::sqrt(Blocked_execution::blocked_sum<double>(
    gradient.size(), 16384, [&](std::size_t begin, std::size_t end) {
      double sum = 0.;
      for(std::size_t v = begin; v < end; ++v)
        sum += gradient[v].squared_length();
      return sum;
    }));
  if(!(size > 0.))
    return 0.;
  std::vector<Vector> f(gradient.size()), x(gradient.size(), Vector::Zero());
  for(std::size_t v = 0; v < f.size(); ++v)
    f[v] = Vector(-gradient[v].x / size, -gradient[v].y / size);
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.residual_tolerance = residual;
  stop.maximal_iterations = iterations;
  const auto schedule = Multigrid::Schedule::v_cycle(1, 1);
  const auto cycle = [&](const std::vector<Vector>& r, std::vector<Vector>& z) {
    levels.precondition(schedule, m_matrices.size() - 1, r, z);
  };
  m_iterations += Multigrid::minimize_energy(matrix, f, x, cycle, stop,
                                             [](double) { return true; }).iterations;
  std::vector<Plane_point> direction(x.size());
  double slope = 0.;
  for(std::size_t v = 0; v < x.size(); ++v) {
    direction[v] = Plane_point{x[v].x(), x[v].y()} * size;
    slope += direction[v].dot(gradient[v]);
  }
  return slope < 0. ? level.go(direction, slope) : 0.;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_NEWTON_STEPS_H
