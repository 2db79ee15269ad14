// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RAYLEIGH_VECTORS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RAYLEIGH_VECTORS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_solver.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The vectors of a map without pins on a level in files, and their products with the matrix; the
// mass is that of the border, a few rows. A step makes five passes over the rows beside the cycle,
// one of them with the matrix.
//
// A model of `RayleighVectors`.
class Streamed_rayleigh_vectors
{
public:
  typedef std::complex<double> Inner;

  // The first of them is z, on level l.
  Streamed_rayleigh_vectors(Work_folder& folder, Streamed_solver& solver, std::size_t l,
                            const Streamed_map& z)
    : m_folder(folder), m_solver(solver), m_l(l), m_level(solver.level(l))
    , m_mass({m_level.border_mass.begin(), m_level.border_mass.end()})
  {
    for(std::size_t k = 0; k < names.size(); ++k)
      m_own[k] = folder.create_scratch<Inner>(name(k), z.size());
    m_x = {&z, &m_own[3], &m_own[4]};
    m_h = {&m_own[0], &m_own[1], &m_own[2]};
  }
  Streamed_rayleigh_vectors(const Streamed_rayleigh_vectors&) = delete;
  Streamed_rayleigh_vectors& operator=(const Streamed_rayleigh_vectors&) = delete;
  ~Streamed_rayleigh_vectors()
  {
    for(std::size_t k = 0; k < names.size(); ++k)
      m_folder.remove(name(k));
  }

  double begin()
  {
    const Streamed_map &x = *m_x[0], &h = *m_h[0];
    const Inner mean = m_mass.weighted_sum(x) / m_mass.total();
    stream_rows(x.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        x[i] -= mean;
    }, releases(x));
    multiply(0);
    const double factor = 1. / std::sqrt(m_mass.inner_product(x, x).real());
    return take_sums(sum_rows<Row_sums>(x.size(), [&](std::size_t begin, std::size_t end) {
      Row_sums sums;
      for(std::size_t i = begin; i < end; ++i) {
        x[i] *= factor;
        h[i] *= factor;
        add(x[i], h[i], sums);
      }
      return sums;
    }, releases(x, h)));
  }

  void set_residual(double quotient)
  {
    const Streamed_map &x = *m_x[0], &h = *m_h[0], &w = *m_x[1];
    auto& f = m_solver.set_right_side(m_l, h, m_norm);
    for(const auto& e : m_mass.entries())
      f[e.row] = Rounded((h[e.row] - quotient * e.value * x[e.row]) / m_norm);
    const auto& u = m_solver.run_cycle(m_l);
    const Inner mean = m_mass.weighted_sum(u) / m_mass.total();
    stream_rows(w.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        w[i] = m_norm * (Inner(u[i]) - mean);
    }, releases(u, w));
    multiply(1);
  }

  Multigrid::Rayleigh_products<Inner> products(int count) const
  {
    const auto sums = sum_rows<Energies>(
      m_level.size(),
      [&](std::size_t begin, std::size_t end) {
        Energies result;
        for(int i = 0; i < count; ++i)
          for(int j = i; j < count; ++j) {
            const Inner *x = m_x[i]->data(), *h = m_h[j]->data();
            for(std::size_t k = begin; k < end; ++k)
              result.of[i][j] += std::conj(x[k]) * h[k];
          }
        return result;
      },
      releases(*m_x[0], *m_x[1], *m_x[2], *m_h[0], *m_h[1], *m_h[2]));
    return Multigrid::Rayleigh_products<Inner>::of(
      count, [&sums](int i, int j) { return sums.of[i][j]; },
      [this](int i, int j) { return m_mass.inner_product(*m_x[i], *m_x[j]); });
  }

  double step(const std::vector<Inner>& y)
  {
    const Inner y0 = y[0], y1 = y[1], y2 = y.size() == 3 ? y[2] : 0.;
    const Streamed_map &x = *m_x[0], &w = *m_x[1], &p = *m_x[2], &hx = *m_h[0], &hw = *m_h[1],
                       &hp = *m_h[2];
    double norm = 0.; // that of the new vector, before the pass
    for(const auto& e : m_mass.entries())
      norm += e.value * std::norm(y0 * x[e.row] + (y1 * w[e.row] + y2 * p[e.row]));
    const double factor = 1. / std::sqrt(norm);
    return take_sums(sum_rows<Row_sums>(x.size(), [&](std::size_t begin, std::size_t end) {
      Row_sums sums;
      for(std::size_t i = begin; i < end; ++i) {
        p[i] = y1 * w[i] + y2 * p[i];
        hp[i] = y1 * hw[i] + y2 * hp[i];
        x[i] = factor * (y0 * x[i] + p[i]);
        hx[i] = factor * (y0 * hx[i] + hp[i]);
        add(x[i], hx[i], sums);
      }
      return sums;
    }, releases(x, w, p, hx, hw, hp)));
  }

  double largest_change() const { return largest_entry(*m_x[2]); }

private:
  struct Energies // x_i^H H x_j for i <= j
  {
    std::array<std::array<Inner, 3>, 3> of = {};

    Energies& operator+=(const Energies& other) { return *this = *this + other; }
    friend Energies operator+(Energies a, const Energies& b)
    {
      for(int i = 0; i < 3; ++i)
        for(int j = i; j < 3; ++j)
          a.of[i][j] += b.of[i][j];
      return a;
    }
  };

  static constexpr std::array<const char*, 5> names = {"hx", "hw", "hp", "w", "p"};
  std::string name(std::size_t k) const
  {
    return "quotient" + std::to_string(m_l) + "_" + names[k];
  }

  void multiply(int k)
  {
    const Streamed_map& h = *m_h[k];
    Streamed_solver::apply(m_level.matrix, *m_x[k], [&h](std::size_t i, const Inner& s) {
      h[i] = s;
      return Inner(0.);
    }, releases(*m_x[k], h));
  }

  // The sums of a new x_0: x^H H x, and the square of the norm of H x, in whose unit its residual
  // is rounded.
  static void add(const Inner& x, const Inner& h, Row_sums& sums)
  {
    sums.first += std::conj(x) * h;
    sums.second += std::norm(h);
  }
  double take_sums(const Row_sums& sums)
  {
    const double norm = std::sqrt(sums.second.real());
    m_norm = norm > 0. ? norm : 1.;
    return sums.first.real();
  }

  Work_folder& m_folder;
  Streamed_solver& m_solver;
  std::size_t m_l;
  const Streamed_level& m_level;
  Multigrid::Diagonal_mass m_mass;
  double m_norm = 1.;
  std::array<Streamed_map, 5> m_own;
  std::array<const Streamed_map*, 3> m_x, m_h;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RAYLEIGH_VECTORS_H
