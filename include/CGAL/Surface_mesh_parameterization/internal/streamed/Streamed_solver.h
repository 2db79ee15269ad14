// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_SOLVER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_SOLVER_H

#include <CGAL/Multigrid/Iteration_control.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_levels.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

typedef Mapped_array<std::complex<double>> Streamed_map; // the values of the vertices of a level

// Sums over blocks of rows.
struct Row_sums
{
  std::complex<double> first = 0., second = 0.;

  Row_sums& operator+=(const Row_sums& other) { return *this = *this + other; }
  friend Row_sums operator+(const Row_sums& a, const Row_sums& b)
  {
    return {a.first + b.first, a.second + b.second};
  }
};

// Alone: no step of an iteration in use waits for it.
inline double largest_entry(const Streamed_map& p)
{
  double largest = 0.;
  for(std::size_t i = 0; i < p.size(); ++i) {
    largest = (std::max)(largest, std::abs(p[i]));
    if(i % 65536 == 0)
      p.release(0, i);
  }
  return largest;
}

// The flexible conjugate gradient method on levels in files, as `Multigrid::minimize_energy()`,
// with the passes over the rows put together: one with the matrix, and two without, a step.
class Streamed_solver
{
public:
  typedef std::complex<double> Complex;

  Streamed_solver(Work_folder& folder, std::vector<Streamed_level>& levels, Streamed_levels& cycle)
    : m_folder(folder), m_levels(levels), m_cycle(cycle)
  {}

  // Lowers the energy of z on level l, from 1 on, whose pins stay.
  template <class Observe>
  Multigrid::Iteration_report minimize(std::size_t l, const Streamed_map& z,
                                       const Multigrid::Energy_stop& stop, const Observe& observe);

  static double energy(const Streamed_level& level, const Streamed_map& z)
  {
    return 0.5 * apply(level.matrix, z, [](std::size_t, const Complex&) {
      return Complex(0.);
    }, releases(z)).first.real();
  }

  const Streamed_level& level(std::size_t l) const { return m_levels[l - 1]; }

  // Calls `use(i, (H x)_i)`; the sums of conj(x_i) (H x)_i, and of what it returns.
  template <class Use, class Release>
  static Row_sums apply(const Streamed_matrix& h, const Streamed_map& x, const Use& use,
                        const Release& release)
  {
    return sum_rows<Row_sums>(
      h.size(),
      [&](std::size_t begin, std::size_t end) {
        Row_sums sums;
        h.for_each_product(begin, end, x.data(), [&](std::size_t i, const Complex& s) {
          sums.first += std::conj(x[i]) * s;
          sums.second += use(i, s);
        });
        return sums;
      },
      [&](std::size_t begin, std::size_t end) {
        h.release(begin, end);
        release(begin, end);
      });
  }

  // The right-hand side of the cycle on level l becomes r / norm; 0 if the norm is 0.
  const Streamed_levels::Vector& set_right_side(std::size_t l, const Streamed_map& r, double norm)
  {
    const float down = norm > 0. ? float(1. / norm) : 0.f;
    const auto& f = m_cycle.right_side(l);
    stream_rows(
      r.size(),
      [&](std::size_t begin, std::size_t end) {
        for(std::size_t i = begin; i < end; ++i)
          f[i] = Rounded(r[i] * double(down));
      },
      releases(r, f));
    return f;
  }

  // The preconditioned right-hand side, whose entries at pins do not count.
  const Streamed_levels::Solution& run_cycle(std::size_t l)
  {
    for(const std::uint32_t pin : level(l).pins)
      m_cycle.right_side(l)[pin] = 0.f;
    m_cycle.start_at_zero(l);
    Multigrid::cycle(m_cycle, Multigrid::Schedule(), l);
    return m_cycle.solution(l);
  }

private:
  Work_folder& m_folder;
  std::vector<Streamed_level>& m_levels;
  Streamed_levels& m_cycle;
};

template <class Observe>
Multigrid::Iteration_report
Streamed_solver::minimize(std::size_t l, const Streamed_map& z, const Multigrid::Energy_stop& stop,
                          const Observe& observe)
{
  const Streamed_level& level = m_levels[l - 1];
  const std::size_t n = level.size();
  const std::string name = "solve" + std::to_string(l) + "_";
  const Streamed_map r = m_folder.create_scratch<Complex>(name + "r", n),
                     p = m_folder.create_scratch<Complex>(name + "p", n),
                     q = m_folder.create_scratch<Complex>(name + "q", n);
  const auto clear_pins = [&level](const Streamed_map& x) {
    for(const std::uint32_t pin : level.pins)
      x[pin] = 0.;
  };
  const double energy = 0.5 * apply(level.matrix, z, [&](std::size_t i, const Complex& s) {
    r[i] = -s;
    return Complex(0.);
  }, releases(z, r)).first.real();
  clear_pins(r);
  double squared_norm = sum_rows<Row_sums>(n, [&](std::size_t begin, std::size_t end) {
    Row_sums sums;
    for(std::size_t i = begin; i < end; ++i)
      sums.first += std::norm(r[i]);
    return sums;
  }, releases(r)).first.real();
  Multigrid::Iteration_control control(stop, energy);
  double curvature = 0.;
  while(control.goes_on()) {
    const double scale = std::sqrt(squared_norm);
    set_right_side(l, r, scale);
    const auto& u = run_cycle(l);
    Complex c = 0.;
    if(curvature > 0.) // make the direction H-orthogonal to the last one
      c = -scale / curvature * sum_rows<Row_sums>(n, [&](std::size_t begin, std::size_t end) {
        Row_sums sums;
        for(std::size_t i = begin; i < end; ++i)
          sums.first += std::conj(q[i]) * u[i];
        return sums;
      }, releases(q, u)).first;
    stream_rows(n, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        p[i] = scale * u[i] + c * p[i];
    }, releases(p, u));
    const Row_sums sums = apply(level.matrix, p, [&](std::size_t i, const Complex& s) {
      q[i] = s;
      return std::conj(p[i]) * r[i];
    }, releases(p, q, r));
    clear_pins(q); // where p is 0
    curvature = sums.first.real();
    const Complex slope = sums.second;
    if(!(curvature > 0.)) { // r is 0, or no longer above rounding
      control.end(std::norm(slope) == 0. || !(curvature < 0.));
      break;
    }
    const Complex alpha = slope / curvature;
    squared_norm = sum_rows<Row_sums>(n, [&](std::size_t begin, std::size_t end) {
      Row_sums parts;
      for(std::size_t i = begin; i < end; ++i) {
        z[i] += alpha * p[i];
        r[i] -= alpha * q[i];
        parts.first += std::norm(r[i]);
      }
      return parts;
    }, releases(z, p, q, r)).first.real();
    const double largest = control.watches_changes() ? largest_entry(p) : 0.;
    const double decrease = 0.5 * std::norm(slope) / curvature;
    control.step(control.report().energy - decrease, decrease, std::abs(alpha) * largest, observe);
  }
  for(const char* vector : {"r", "p", "q"})
    m_folder.remove(name + vector);
  return control.report();
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_SOLVER_H
