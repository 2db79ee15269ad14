// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RAYLEIGH_VECTORS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RAYLEIGH_VECTORS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_solver.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The vectors of a map without pins on a distributed level. What ranks have of a sum by the mass is
// added in their order, so that all of them find the same number.
//
// A model of `RayleighVectors`.
class Distributed_rayleigh_vectors
{
public:
  typedef std::complex<double> Inner;

  // The first of them is z, on level l.
  Distributed_rayleigh_vectors(const Ranks& ranks, Distributed_solver& solver, std::size_t l, Vec z)
    : m_ranks(ranks), m_solver(solver), m_l(l), m_mass(solver.level(l).mass)
    , m_total(sum(m_mass.total())), m_r(solver.vector(l)), m_w(solver.vector(l))
    , m_p(solver.vector(l)), m_hz(solver.vector(l)), m_hw(solver.vector(l)), m_hp(solver.vector(l))
    , m_x{z, m_w, m_p}, m_h{m_hz, m_hw, m_hp}
  {}
  Distributed_rayleigh_vectors(const Distributed_rayleigh_vectors&) = delete;
  Distributed_rayleigh_vectors& operator=(const Distributed_rayleigh_vectors&) = delete;

  double begin()
  {
    remove_mean(m_x[0]);
    multiply(0);
    return normalize();
  }

  void set_residual(double quotient)
  {
    check(VecCopy(m_h[0], m_r));
    {
      Petsc_part r(m_r), x(m_x[0]);
      for(const auto& e : m_mass.entries())
        r[e.row] -= quotient * e.value * x[e.row];
    }
    m_solver.precondition(m_l, m_r, m_x[1]);
    remove_mean(m_x[1]);
    multiply(1);
  }

  Multigrid::Rayleigh_products<Inner> products(int count) const
  {
    return Multigrid::Rayleigh_products<Inner>::of(
      count,
      [this](int i, int j) { return Distributed_solver::product(m_x[i], m_h[j]); },
      [this](int i, int j) { return mass_product(m_x[i], m_x[j]); });
  }

  double step(const std::vector<Inner>& y)
  {
    for(Vec* v : {m_x, m_h}) {
      check(VecAXPBY(v[2], y[1], y.size() == 3 ? y[2] : 0., v[1]));
      check(VecAYPX(v[0], y[0], v[2]));
    }
    return normalize();
  }

  double largest_change() const
  {
    double change = 0.;
    check(VecNorm(m_x[2], NORM_INFINITY, &change));
    return change;
  }

private:
  template <class T>
  T sum(const T& own) const
  {
    T result = T();
    for(const T& of_rank : m_ranks.all(own))
      result += of_rank;
    return result;
  }

  Inner mass_product(Vec x, Vec y) const
  {
    return sum(m_mass.inner_product(Petsc_part(x), Petsc_part(y)));
  }

  void remove_mean(Vec x) const
  {
    const Inner moment = sum(m_mass.weighted_sum(Petsc_part(x)));
    check(VecShift(x, -moment / m_total));
  }

  void multiply(int k) { check(MatMult(m_solver.level(m_l).matrix, m_x[k], m_h[k])); }

  double normalize()
  {
    const double factor = 1. / std::sqrt(mass_product(m_x[0], m_x[0]).real());
    check(VecScale(m_x[0], factor));
    check(VecScale(m_h[0], factor));
    return Distributed_solver::product(m_x[0], m_h[0]).real();
  }

  const Ranks& m_ranks;
  Distributed_solver& m_solver;
  std::size_t m_l;
  const Multigrid::Diagonal_mass& m_mass; // of the border vertices of this rank
  double m_total;
  Petsc_vector m_r, m_w, m_p, m_hz, m_hw, m_hp;
  Vec m_x[3], m_h[3];
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RAYLEIGH_VECTORS_H
