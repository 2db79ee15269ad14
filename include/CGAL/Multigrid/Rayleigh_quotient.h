// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H
#define CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H

#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Multigrid/diagonalize.h>
#include <CGAL/Multigrid/vector_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Diagonal_mass` is the matrix \f$ B = \mathrm{diag}(b) \f$ of an eigenvalue problem
\f$ H x = \lambda B x \f$ with the entries \f$ b_i \ge 0 \f$, most of which may be 0.
*/
class Diagonal_mass
{
public:
  /// An entry that is not 0.
  struct Entry
  {
    std::uint32_t row; ///< its row
    double value;      ///< its value, > 0
  };

  /// Constructs the matrix of the given entries, of different rows; by default it is 0.
  explicit Diagonal_mass(std::vector<Entry> entries = {}) : m_entries(std::move(entries))
  {
    for(const Entry& e : m_entries)
      m_total += e.value;
  }

  /// Returns the entries.
  const std::vector<Entry>& entries() const { return m_entries; }

  /// Returns \f$ x^H B y \f$.
  template <class V>
  typename Value_traits<V>::Inner inner_product(const std::vector<V>& x,
                                                const std::vector<V>& y) const
  {
    typedef Value_traits<typename Value_traits<V>::Double> Traits;
    typename Value_traits<V>::Inner sum = 0.;
    for(const Entry& e : m_entries)
      sum += Traits::product(e.value * Traits::from(x[e.row]), Traits::from(y[e.row]));
    return sum;
  }

  /// Subtracts a constant from `x` so that \f$ \sum_i b_i x_i = 0 \f$.
  template <class V>
  void remove_mean(std::vector<V>& x) const
  {
    typedef Value_traits<typename Value_traits<V>::Double> Traits;
    typename Value_traits<V>::Double sum = Traits::zero();
    for(const Entry& e : m_entries)
      sum += e.value * Traits::from(x[e.row]);
    const V mean = Value_traits<V>::from(sum / m_total);
    for_each_index(x.size(), [&](std::size_t i) { x[i] -= mean; });
  }

private:
  std::vector<Entry> m_entries;
  double m_total = 0.;
};

namespace internal {

// A vector of the iteration and its product with H.
template <class V>
struct Vector_and_product
{
  typedef typename Value_traits<V>::Inner Inner;
  typedef typename Value_traits<V>::Scalar Scalar;

  std::vector<V> x, hx;

  explicit Vector_and_product(std::size_t n) : x(n), hx(n) {}

  void scale(const Inner& factor)
  {
    const Scalar s(factor);
    for(std::vector<V>* v : {&x, &hx})
      for_each_index(v->size(), [&](std::size_t i) { (*v)[i] *= s; });
  }
  void add_scaled(const Inner& s, const Vector_and_product& other)
  {
    Multigrid::add_scaled(Scalar(s), other.x, x);
    Multigrid::add_scaled(Scalar(s), other.hx, hx);
  }
};

// Of up to three vectors
template <class Inner>
using Small_matrix = Multigrid::Small_matrix<Inner, 3>;

// The coefficients y of least y^H E y / y^H N y with y_0 >= 0, where E is definite and N semidefinite;
// none if E is nearly singular.
template <class Inner>
std::vector<Inner> best_coefficients(int n, Small_matrix<Inner> energy,
                                     const Small_matrix<Inner>& norm)
{
  typedef Value_traits<Inner> Traits;
  constexpr double nearly_singular = 1e-10;
  // In units in which each vector has the energy 1
  std::array<double, 3> unit = {};
  for(int i = 0; i < n; ++i) {
    if(!(std::real(energy[i][i]) > 0.))
      return {};
    unit[i] = 1. / std::sqrt(std::real(energy[i][i]));
  }
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < n; ++j)
      energy[i][j] *= unit[i] * unit[j];
  // W^H E W = 1 for the columns of W, and the largest eigenvalue of W^H N W is what is looked for.
  Small_matrix<Inner> w = diagonalize(n, energy), reduced = {};
  for(int j = 0; j < n; ++j) {
    if(!(std::real(energy[j][j]) > nearly_singular))
      return {};
    for(int i = 0; i < n; ++i)
      w[i][j] *= unit[i] / std::sqrt(std::real(energy[j][j]));
  }
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < n; ++j)
      for(int k = 0; k < n; ++k)
        for(int l = 0; l < n; ++l)
          reduced[i][j] += Traits::adjoint(w[k][i]) * norm[k][l] * w[l][j];
  const Small_matrix<Inner> u = diagonalize(n, reduced);
  int best = 0;
  for(int j = 1; j < n; ++j)
    if(std::real(reduced[j][j]) > std::real(reduced[best][best]))
      best = j;
  std::vector<Inner> y(n, Inner(0.));
  for(int i = 0; i < n; ++i)
    for(int k = 0; k < n; ++k)
      y[i] += w[i][k] * u[k][best];
  const double size = std::abs(y[0]);
  const Inner phase = size > 0. ? Inner(Traits::adjoint(y[0]) / size) : Inner(1.);
  for(Inner& value : y)
    value *= phase;
  return y;
}

// The combination of the first `count` vectors with the smallest quotient, by its coefficients;
// none if the vectors are linearly dependent.
template <class V>
std::vector<typename Value_traits<V>::Inner>
best_combination(const std::array<const Vector_and_product<V>*, 3>& vectors, int count,
                 const Diagonal_mass& mass)
{
  typedef typename Value_traits<V>::Inner Inner;
  Small_matrix<Inner> energy = {}, norm = {};
  for(int i = 0; i < count; ++i)
    for(int j = i; j < count; ++j) {
      energy[i][j] = inner_product(vectors[i]->x, vectors[j]->hx);
      norm[i][j] = mass.inner_product(vectors[i]->x, vectors[j]->x);
      energy[j][i] = Value_traits<Inner>::adjoint(energy[i][j]);
      norm[j][i] = Value_traits<Inner>::adjoint(norm[i][j]);
    }
  return best_coefficients(count, energy, norm);
}

// The iteration of `minimize_rayleigh_quotient()`.
template <class V>
Iteration_report optimal_gradients(const Iteration_parts<V>& parts, const Diagonal_mass& mass,
                                   std::vector<V>& x, const Energy_stop& stop)
{
  typedef Vector_and_product<V> Pair;
  typedef typename Value_traits<V>::Real Real;
  const std::size_t n = x.size();
  Pair current(n), residual(n), direction(n);
  std::vector<V> r(n);
  bool has_direction = false;
  current.x.swap(x);
  mass.remove_mean(current.x);
  parts.apply(current.x, current.hx);
  const auto normalize = [&](Pair& pair) {
    pair.scale(1. / std::sqrt(std::real(mass.inner_product(pair.x, pair.x))));
  };
  normalize(current);
  Iteration_control control(stop, 0.5 * std::real(inner_product(current.x, current.hx)));
  while(control.goes_on()) {
    const double quotient = 2. * control.report().energy;
    r = current.hx;
    for(const Diagonal_mass::Entry& e : mass.entries())
      r[e.row] -= Real(quotient * e.value) * current.x[e.row];
    parts.precondition(r, residual.x);
    mass.remove_mean(residual.x);
    parts.apply(residual.x, residual.hx);
    std::vector<typename Pair::Inner> y;
    for(int count = has_direction ? 3 : 2; y.empty() && count > 1; --count)
      y = best_combination<V>({&current, &residual, &direction}, count, mass);
    if(y.empty()) { // the residual is 0, or no longer above rounding
      control.end(true);
      break;
    }
    // The part of the step that is not along the vector itself is the next direction.
    if(y.size() == 3) {
      direction.scale(y[2]);
      direction.add_scaled(y[1], residual);
    } else {
      std::swap(direction, residual);
      direction.scale(y[1]);
    }
    has_direction = true;
    current.scale(y[0]);
    current.add_scaled(1., direction);
    normalize(current);
    const double energy = 0.5 * std::real(inner_product(current.x, current.hx));
    const double change = control.watches_changes() ? largest_entry(direction.x) : 0.;
    control.step(energy, (std::max)(0., control.report().energy - energy), change, parts.observe);
  }
  x.swap(current.x);
  return control.report();
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

Minimizes the Rayleigh quotient \f$ x^H H x / x^H B x \f$ over the vectors with \f$ \sum b_i x_i = 0
\f$ by the locally optimal preconditioned conjugate gradient method (Knyazev 2001), from the given
`x`: each step takes the best combination of the vector, its preconditioned residual and the last
direction. \f$ H \f$ must be semidefinite with the constants as kernel.

\param apply \f$ H \f$, a model of `MultigridOperator`: `apply(x, y)` sets y to \f$ H x \f$
\param mass \f$ B \f$
\param x the vector; in the end \f$ x^H B x = 1 \f$
\param precondition `precondition(r, w)` sets w to an approximation of \f$ H^{-1} r \f$ up to a
       constant
\param stop when to stop, where the energy is \f$ \frac12 x^H H x = \lambda / 2 \f$
\param observe `observe(part)` is told after each step how far the iteration has come, in [0, 1];
       returning false stops it

Seven vectors beside `x`; one product with the matrix, one preconditioning a step.
*/
template <class V, class Apply, class Precondition, class Observe>
Iteration_report minimize_rayleigh_quotient(const Apply& apply, const Diagonal_mass& mass,
                                            std::vector<V>& x,
                                            const Precondition& precondition,
                                            const Energy_stop& stop, const Observe& observe)
{
  return internal::optimal_gradients<V>({apply, precondition, observe}, mass, x, stop);
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H
