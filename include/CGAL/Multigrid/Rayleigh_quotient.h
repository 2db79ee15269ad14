// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H
#define CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H

#include <CGAL/Multigrid/Iteration_control.h>
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

  /// Returns \f$ \sum_i b_i \f$.
  double total() const { return m_total; }

  /// Returns \f$ x^H B y \f$ for arrays of numbers.
  template <class Array>
  auto inner_product(const Array& x, const Array& y) const
  {
    typedef Value_traits<typename Array::value_type> Value;
    typedef Value_traits<typename Value::Double> Traits;
    typename Value::Inner sum = 0.;
    for(const Entry& e : m_entries)
      sum += Traits::product(e.value * Traits::from(x[e.row]), Traits::from(y[e.row]));
    return sum;
  }

  /// Returns \f$ \sum_i b_i x_i \f$.
  template <class Array>
  auto weighted_sum(const Array& x) const
  {
    typedef Value_traits<typename Value_traits<typename Array::value_type>::Double> Traits;
    auto sum = Traits::zero();
    for(const Entry& e : m_entries)
      sum += e.value * Traits::from(x[e.row]);
    return sum;
  }

  /// Subtracts a constant from `x` so that \f$ \sum_i b_i x_i = 0 \f$.
  template <class V>
  void remove_mean(std::vector<V>& x) const
  {
    const V mean = Value_traits<V>::from(weighted_sum(x) / m_total);
    for_each_index(x.size(), [&](std::size_t i) { x[i] -= mean; });
  }

private:
  std::vector<Entry> m_entries;
  double m_total = 0.;
};

/// \ingroup PkgHLSCMMultigrid
/// The products of up to three vectors: \f$ x_i^H H x_j \f$ and \f$ x_i^H B x_j \f$.
template <class Inner>
struct Rayleigh_products
{
  Small_matrix<Inner, 3> energy = {}; ///< those by \f$ H \f$
  Small_matrix<Inner, 3> norm = {};   ///< those by \f$ B \f$

  /// Sets the products of the first `count` vectors to what these functions return for i <= j.
  template <class Energy, class Norm>
  static Rayleigh_products of(int count, const Energy& energy_of, const Norm& norm_of)
  {
    Rayleigh_products result;
    for(int i = 0; i < count; ++i)
      for(int j = i; j < count; ++j) {
        result.energy[i][j] = energy_of(i, j);
        result.norm[i][j] = norm_of(i, j);
        result.energy[j][i] = Value_traits<Inner>::adjoint(result.energy[i][j]);
        result.norm[j][i] = Value_traits<Inner>::adjoint(result.norm[i][j]);
      }
    return result;
  }
};

namespace internal {

// The coefficients y of least y^H E y / y^H N y with y_0 >= 0, where E is definite and N
// semidefinite; none if E is nearly singular.
template <class Inner>
std::vector<Inner> best_coefficients(int n, Small_matrix<Inner, 3> energy,
                                     const Small_matrix<Inner, 3>& norm)
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
  Small_matrix<Inner, 3> w = diagonalize(n, energy), reduced = {};
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
  const Small_matrix<Inner, 3> u = diagonalize(n, reduced);
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

// The vectors of the iteration in memory.
//
// A model of `RayleighVectors`.
template <class V>
class Stored_rayleigh_vectors
{
public:
  typedef typename Value_traits<V>::Inner Inner;

  // `x` is the first of them; it is given back by the destructor.
  Stored_rayleigh_vectors(const Iteration_parts<V>& parts, const Diagonal_mass& mass,
                          std::vector<V>& x)
    : m_parts(parts), m_mass(mass), m_result(x), m_map(x.size()), m_residual(x.size())
    , m_direction(x.size()), m_r(x.size())
  {
    m_map.x.swap(x);
  }
  Stored_rayleigh_vectors(const Stored_rayleigh_vectors&) = delete;
  Stored_rayleigh_vectors& operator=(const Stored_rayleigh_vectors&) = delete;
  ~Stored_rayleigh_vectors() { m_result.swap(m_map.x); }

  double begin()
  {
    m_mass.remove_mean(m_map.x);
    m_parts.apply(m_map.x, m_map.hx);
    return normalize();
  }

  void set_residual(double quotient)
  {
    typedef typename Value_traits<V>::Real Real;
    m_r = m_map.hx;
    for(const Diagonal_mass::Entry& e : m_mass.entries())
      m_r[e.row] -= Real(quotient * e.value) * m_map.x[e.row];
    m_parts.precondition(m_r, m_residual.x);
    m_mass.remove_mean(m_residual.x);
    m_parts.apply(m_residual.x, m_residual.hx);
  }

  Rayleigh_products<Inner> products(int count) const
  {
    const Pair* const pairs[] = {&m_map, &m_residual, &m_direction};
    return Rayleigh_products<Inner>::of(
      count, [&](int i, int j) { return inner_product(pairs[i]->x, pairs[j]->hx); },
      [&](int i, int j) { return m_mass.inner_product(pairs[i]->x, pairs[j]->x); });
  }

  double step(const std::vector<Inner>& y)
  {
    if(y.size() == 3) {
      m_direction.scale(y[2]);
      m_direction.add_scaled(y[1], m_residual);
    } else {
      std::swap(m_direction, m_residual);
      m_direction.scale(y[1]);
    }
    m_map.scale(y[0]);
    m_map.add_scaled(1., m_direction);
    return normalize();
  }

  double largest_change() const { return largest_entry(m_direction.x); }

private:
  // A vector and its product with H.
  struct Pair
  {
    typedef typename Value_traits<V>::Scalar Scalar;

    std::vector<V> x, hx;

    explicit Pair(std::size_t n) : x(n), hx(n) {}

    void scale(const Inner& factor)
    {
      const Scalar s(factor);
      for(std::vector<V>* v : {&x, &hx})
        for_each_index(v->size(), [&](std::size_t i) { (*v)[i] *= s; });
    }
    void add_scaled(const Inner& s, const Pair& other)
    {
      Multigrid::add_scaled(Scalar(s), other.x, x);
      Multigrid::add_scaled(Scalar(s), other.hx, hx);
    }
  };

  double normalize()
  {
    m_map.scale(1. / std::sqrt(std::real(m_mass.inner_product(m_map.x, m_map.x))));
    return std::real(inner_product(m_map.x, m_map.hx));
  }

  const Iteration_parts<V>& m_parts;
  const Diagonal_mass& m_mass;
  std::vector<V>& m_result;
  Pair m_map, m_residual, m_direction;
  std::vector<V> m_r;
};

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

Minimizes the Rayleigh quotient \f$ x^H H x / x^H B x \f$ over the vectors with \f$ \sum b_i x_i = 0
\f$ by the locally optimal preconditioned conjugate gradient method (Knyazev 2001): each step takes
the best combination of the vector, its preconditioned residual and the last direction. \f$ H \f$
must be semidefinite with the constants as kernel.

\tparam RayleighVectors is a model of the concept `RayleighVectors`
\param vectors these three vectors
\param stop when to stop, where the energy is \f$ \frac12 x^H H x = \lambda / 2 \f$
\param observe `observe(part)` is told after each step how far the iteration has come, in [0, 1];
       returning false stops it
*/
template <class RayleighVectors>
Iteration_report minimize_rayleigh_quotient(RayleighVectors& vectors, const Energy_stop& stop,
                                            Blocked_execution::Function_ref<bool(double)> observe)
{
  typedef typename RayleighVectors::Inner Inner;
  Iteration_control control(stop, 0.5 * vectors.begin());
  for(int count = 2; control.goes_on(); count = 3) { // there is no direction in the first step
    vectors.set_residual(2. * control.report().energy);
    const Rayleigh_products<Inner> products = vectors.products(count);
    std::vector<Inner> y;
    for(int n = count; y.empty() && n > 1; --n)
      y = internal::best_coefficients(n, products.energy, products.norm);
    if(y.empty()) { // the residual is 0, or no longer above rounding
      control.end(true);
      break;
    }
    const double energy = 0.5 * vectors.step(y);
    const double change = control.watches_changes() ? vectors.largest_change() : 0.;
    control.step(energy, (std::max)(0., control.report().energy - energy), change, observe);
  }
  return control.report();
}

/*!
\ingroup PkgHLSCMMultigrid

The same for vectors in memory, from the given `x`.

\param apply \f$ H \f$, a model of `MultigridOperator`: `apply(x, y)` sets y to \f$ H x \f$
\param mass \f$ B \f$
\param x the vector; in the end \f$ x^H B x = 1 \f$
\param precondition `precondition(r, w)` sets w to an approximation of \f$ H^{-1} r \f$ up to a
       constant
\param stop, observe as above

Seven vectors beside `x`; one product with the matrix, one preconditioning a step.
*/
template <class V, class Apply, class Precondition, class Observe>
Iteration_report minimize_rayleigh_quotient(const Apply& apply, const Diagonal_mass& mass,
                                            std::vector<V>& x,
                                            const Precondition& precondition,
                                            const Energy_stop& stop, const Observe& observe)
{
  const internal::Iteration_parts<V> parts = {apply, precondition, observe};
  internal::Stored_rayleigh_vectors<V> vectors(parts, mass, x);
  return minimize_rayleigh_quotient(vectors, stop, parts.observe);
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_RAYLEIGH_QUOTIENT_H
