// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MEND_PATCH_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MEND_PATCH_H

#include <CGAL/Surface_mesh_parameterization/internal/repair/Patch_energy.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Newton's method with a Hessian that is positive by construction.
class Patch_minimizer
{
public:
  typedef Patch_energy::Values Values;

  // Takes steps only as long as there is `effort`, from which each takes its vertices.
  Patch_minimizer(const Patch_energy& energy, double& effort) : m_energy(energy), m_effort(effort)
  {}

  // Lowers the energy of `z` until a step gains less than the part `precision` of it.
  void minimize(Values& z, const Energy_terms& terms, int steps, double precision);

private:
  double take_step(Values& z, const Energy_terms& terms, double value);

  const Patch_energy& m_energy;
  double& m_effort;
  Eigen::SimplicialLDLT<Patch_energy::Matrix> m_solver;
  bool m_is_analyzed = false;
  Eigen::VectorXd m_gradient;
  Patch_energy::Matrix m_hessian;
};

inline void Patch_minimizer::minimize(Values& z, const Energy_terms& terms, int steps,
                                      double precision)
{
  double value = m_energy.value(z, terms);
  for(int i = 0; i < steps && m_effort > 0.; ++i) {
    m_effort -= double(m_energy.number_free());
    const double before = value;
    value = take_step(z, terms, before);
    if(!(before - value > precision * before))
      break;
  }
}

// Returns the energy after the step, which is `value` if there was none.
inline double Patch_minimizer::take_step(Values& z, const Energy_terms& terms, double value)
{
  m_energy.differentiate(z, terms, m_gradient, m_hessian);
  m_hessian.diagonal() *= 1. + 1e-9; // where it is only semidefinite
  if(!m_is_analyzed)
    m_solver.analyzePattern(m_hessian);
  m_is_analyzed = true;
  m_solver.factorize(m_hessian);
  if(m_solver.info() != Eigen::Success)
    return value;
  const Eigen::VectorXd step = m_solver.solve(-m_gradient);
  const double slope = m_gradient.dot(step);
  if(!(slope < 0.) || !std::isfinite(slope))
    return value;
  Values d(z.size(), 0.), next(z.size());
  for(std::size_t i = 0; i < m_energy.number_free(); ++i)
    d[i] = std::complex<double>(step[2 * i], step[2 * i + 1]);
  double length = 1.;
  if(terms.epsilon == 0.) // no triangle may pass through a flip
    length = (std::min)(1., 0.9 * m_energy.first_flip(z, d));
  for(int halvings = 0; halvings < 50; ++halvings, length *= 0.5) {
    for(std::size_t i = 0; i < z.size(); ++i)
      next[i] = z[i] + length * d[i];
    const double reached = m_energy.value(next, terms);
    if(reached <= value + 1e-4 * length * slope) { // Armijo
      z.swap(next);
      return reached;
    }
  }
  return value;
}

// Moves the free values to where all triangles have positive areas; returns whether such a place
// was found. The area scale must be about 1.
inline bool untangle(const Patch_energy& energy, double& effort, Patch_energy::Values& z)
{
  Patch_minimizer minimizer(energy, effort);
  // A greater epsilon is no worse a start: the first minimiser is then the conformal map.
  double epsilon = (std::max)(1., -energy.least_determinant(z));
  for(int round = 0; round < 60 && effort > 0.; ++round, epsilon *= 0.5) {
    minimizer.minimize(z, Energy_terms{0., 1., 0.1, epsilon}, 10, 1e-2);
    const double least = energy.least_determinant(z);
    if(least > 0.)
      return true;
    // As long as there is a way, the least determinant follows epsilon to 0. It stays behind if,
    // for instance, the border of the patch turns the wrong way round.
    if(!(least > -30. * epsilon))
      return false;
  }
  return false;
}

enum class Mended { YES, REFUSED, NO };

// Moves the free values of a patch to where all its triangles have positive areas and its conformal
// energy is near the least one that can be had so, unless `is_accepted(z)` is false of where it is
// first free of flips: then it is refused. `start` is the energy that untangles, `barrier` the
// weight of the term that keeps areas away from 0. Takes what it needs from `effort`; if that is over
// it fails, or the energy stays somewhat higher.
template <class Predicate>
Mended mend_patch(const Patch_energy& energy, const Patch_energy& start, double barrier,
                  double& effort, const Predicate& is_accepted, Patch_energy::Values& z)
{
  const double scale = std::sqrt(energy.area_scale(z));
  if(!(scale > 0.) || !std::isfinite(scale))
    return Mended::NO;
  const std::complex<double> origin = z.back();
  const auto back = [&](Patch_energy::Values values) {
    for(auto& value : values)
      value = origin + scale * value;
    return values;
  };
  for(auto& value : z)
    value = (value - origin) / scale;
  if(!untangle(start, effort, z))
    return Mended::NO;
  if(!is_accepted(back(z)))
    return Mended::REFUSED;
  Patch_minimizer minimizer(energy, effort);
  for(double weight = 0.1; weight > 0.5 * barrier; weight *= 0.1)
    minimizer.minimize(z, Energy_terms{1., (std::max)(weight, barrier), 0., 0.}, 30, 1e-6);
  z = back(std::move(z));
  return Mended::YES;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MEND_PATCH_H
