// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_LEVELS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_LEVELS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Multigrid/Schedule.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Gathered_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_matrix.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/decimate_blocks.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

typedef std::complex<float> Rounded;

// A level in files: its matrix, the way from the next coarser level, its border and its pins.
struct Streamed_level
{
  // What a step of the smoother multiplies residuals by; pinned vertices do not move.
  struct Inverse_diagonal
  {
    const float* values;
    std::size_t first_pin, last_pin;

    float operator[](std::size_t i) const
    {
      return i == first_pin || i == last_pin ? 0.f : values[i];
    }
  };

  Streamed_matrix matrix;
  Mapped_array<Streamed_stencil> stencils; // sources are vertices of the coarser level
  Mapped_array<Multigrid::Diagonal_mass::Entry> border_mass;
  std::vector<std::uint32_t> pins;         // one or two

  std::size_t size() const { return matrix.size(); }
  Inverse_diagonal inverse_diagonal() const
  {
    return {matrix.inverse_diagonal().data(), pins.front(), pins.back()};
  }

  // Calls `use(i, value)` for all rows with what vertex i gets of a coarse vector, and
  // `release(begin, end)` for what was used.
  template <class Use, class Release>
  void prolong(const std::complex<double>* coarse, const Use& use, const Release& release) const
  {
    stream_rows(
      size(),
      [&](std::size_t begin, std::size_t end) {
        for(std::size_t i = begin; i < end; ++i)
          use(i, stencils[i].mean(coarse));
      },
      [&](std::size_t begin, std::size_t end) {
        stencils.release(begin, end);
        release(begin, end);
      });
  }
};

// The cycle over the levels in files, the coarsest first; below them, as level 0, a hierarchy in
// memory. As `Multigrid_levels`, with the same smoother, but each pass over the rows of a level
// does all that can be done in it.
//
// Solutions are not rounded: the energy of smooth ones, all but holomorphic, falls as 1 / n^2 with the
// number n of vertices, that of what rounding adds to them does not. At 14 million this changes no
// iteration yet.
//
// A model of `MultigridLevels`.
class Streamed_levels
{
public:
  typedef Mapped_array<Rounded> Vector;
  typedef std::complex<double> Complex;
  typedef Mapped_array<Complex> Solution;

  Streamed_levels(Work_folder& folder, std::vector<Streamed_level>& levels,
                  Gathered_hierarchy& gathered)
    : m_folder(folder), m_gathered(gathered)
  {
    for(Streamed_level& level : levels)
      m_levels.push_back(make_level(level, m_levels.size() + 1));
    m_coarsest_f.resize(gathered.size());
    m_coarsest_u.resize(gathered.size());
  }

  // The right-hand side and, after a cycle, the solution of a level from 1 on.
  Vector& right_side(std::size_t l) { return at(l).f; }
  Solution& solution(std::size_t l) { return at(l).u; }
  void start_at_zero(std::size_t l) { at(l).is_zero = true; }

  // The operations of `Multigrid::cycle()`.
  void smooth(std::size_t l, unsigned int steps);
  void restrict_residual(std::size_t l);
  void correct(std::size_t l);
  void solve_coarsest() { m_gathered.correct(m_coarsest_f, m_coarsest_u); }
  template <class Coarse_cycle>
  void accelerate(std::size_t l, unsigned int steps, const Coarse_cycle& coarse_cycle);

private:
  struct Level
  {
    Streamed_level* files = nullptr;
    Solution u;
    Vector f, r, z, next;  // right-hand side; residual; the last step of the smoother, the next
    bool is_zero = true;   // u is 0, whatever is stored
    bool has_step = false; // r - H z is f - H u
    std::vector<std::pair<Solution, Vector>> directions; // and H times them; for the accelerator
    Solution x;
  };

  template <class T>
  Mapped_array<T> create(std::size_t l, std::size_t n, const std::string& name)
  {
    return m_folder.create_scratch<T>("cycle" + std::to_string(l) + "_" + name, n);
  }
  Level make_level(Streamed_level& files, std::size_t l)
  {
    const std::size_t n = files.size();
    Level level;
    level.files = &files;
    level.u = create<Complex>(l, n, "u");
    level.f = create<Rounded>(l, n, "f");
    level.r = create<Rounded>(l, n, "r");
    level.z = create<Rounded>(l, n, "z");
    level.next = create<Rounded>(l, n, "next");
    return level;
  }

  Level& at(std::size_t l) { return m_levels[l - 1]; }

  // What is in files.
  static void release(const Level& level, std::size_t begin, std::size_t end)
  {
    level.files->matrix.release(begin, end);
    level.u.release_passed(begin, end);
    for(const Vector* vector : {&level.f, &level.r, &level.z, &level.next})
      vector->release_passed(begin, end);
  }

  template <class Body>
  static void pass(const Level& level, const Body& body)
  {
    stream_rows(level.files->size(), body, [&level](std::size_t begin, std::size_t end) {
      release(level, begin, end);
    });
  }

  template <class Values>
  static void clear_pins(const Level& level, const Values& x)
  {
    for(const std::uint32_t pin : level.files->pins)
      x[pin] = 0.f;
  }

  template <class X, class Y>
  static Complex product(const X& x, const Y& y)
  {
    return sum_rows<Complex>(
      x.size(), [&](std::size_t begin, std::size_t end) {
        Complex sum = 0.;
        for(std::size_t i = begin; i < end; ++i)
          sum += std::conj(Complex(x[i])) * Complex(y[i]);
        return sum;
      }, releases(x, y));
  }

  template <class Values>
  static void add_scaled(const typename Values::value_type& c, const Values& x, const Values& y)
  {
    stream_rows(x.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        y[i] += c * x[i];
    }, releases(x, y));
  }

  Work_folder& m_folder;
  Gathered_hierarchy& m_gathered;
  std::vector<Level> m_levels;
  std::vector<Rounded> m_coarsest_f;
  std::vector<Complex> m_coarsest_u;
};

// Steps of the Chebyshev method of the fourth kind, as `Multigrid::chebyshev_steps()`. u gets a
// step only when the pass that needs it for its neighbours is over.
inline void Streamed_levels::smooth(std::size_t l, unsigned int steps)
{
  if(steps == 0)
    return;
  Level& level = at(l);
  const Streamed_matrix& h = level.files->matrix;
  const Streamed_level::Inverse_diagonal inverse = level.files->inverse_diagonal();
  const bool starts_at_zero = level.is_zero;
  float weight = 2.f / 3.f;
  if(starts_at_zero)
    pass(level, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i) {
        level.r[i] = level.f[i];
        level.z[i] = weight * inverse[i] * level.f[i];
      }
    });
  else
    pass(level, [&](std::size_t begin, std::size_t end) {
      h.for_each_product(begin, end, level.u.data(), [&](std::size_t i, const Complex& s) {
        level.r[i] = Rounded(Complex(level.f[i]) - s);
        level.z[i] = weight * inverse[i] * level.r[i];
      });
    });
  const auto add_step = [&](std::size_t i, const Rounded& step, bool is_first) {
    level.u[i] = starts_at_zero && is_first ? Complex(step) : level.u[i] + Complex(step);
  };
  for(unsigned int k = 2; k <= steps; ++k) {
    const float old_weight = float(2 * k - 3) / float(2 * k + 1);
    weight = float(8 * k - 4) / (float(2 * k + 1) * 2.f);
    pass(level, [&](std::size_t begin, std::size_t end) {
      h.for_each_product(begin, end, level.z.data(), [&](std::size_t i, const Rounded& s) {
        level.r[i] -= s;
        level.next[i] = old_weight * level.z[i] + weight * inverse[i] * level.r[i];
        add_step(i, k == steps ? level.z[i] + level.next[i] : level.z[i], k == 2);
      });
    });
    std::swap(level.z, level.next);
  }
  if(steps == 1)
    pass(level, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        add_step(i, level.z[i], true);
    });
  level.is_zero = false;
  level.has_step = true;
}

// Slab by slab: the residual by all threads, what it means for the coarse level in order.
inline void Streamed_levels::restrict_residual(std::size_t l)
{
  Level& level = at(l);
  const Streamed_matrix& h = level.files->matrix;
  Rounded* const coarse = l == 1 ? m_coarsest_f.data() : at(l - 1).f.data();
  std::fill_n(coarse, l == 1 ? m_coarsest_f.size() : at(l - 1).f.size(), Rounded(0.f));
  stream_rows(
    h.size(),
    [&](std::size_t begin, std::size_t end) {
      if(level.has_step)
        h.for_each_product(begin, end, level.z.data(), [&](std::size_t i, const Rounded& s) {
          level.r[i] -= s;
        });
      else if(level.is_zero)
        std::copy(level.f.begin() + begin, level.f.begin() + end, level.r.begin() + begin);
      else
        h.for_each_product(begin, end, level.u.data(), [&](std::size_t i, const Complex& s) {
          level.r[i] = Rounded(Complex(level.f[i]) - s);
        });
    },
    [&](std::size_t begin, std::size_t end) {
      for(const std::uint32_t pin : level.files->pins)
        if(pin >= begin && pin < end)
          level.r[pin] = 0.f;
      for(std::size_t i = begin; i < end; ++i) {
        const Streamed_stencil& s = level.files->stencils[i];
        for(int c = 0; c < 3; ++c)
          coarse[s.source[c]] += s.weight[c] * level.r[i];
      }
      release(level, begin, end);
      level.files->stencils.release(begin, end);
    });
  level.has_step = false;
  if(l > 1) {
    at(l - 1).f.release();
    start_at_zero(l - 1);
  }
}

inline void Streamed_levels::correct(std::size_t l)
{
  Level& level = at(l);
  const bool was_zero = level.is_zero;
  level.files->prolong(l == 1 ? m_coarsest_u.data() : at(l - 1).u.data(),
                       [&](std::size_t i, const Complex& value) {
                         level.u[i] = was_zero ? value : level.u[i] + value;
                       },
                       releases(level.u));
  if(l > 1)
    at(l - 1).u.release();
  clear_pins(level, level.u); // of a correction it has none
  level.is_zero = level.has_step = false;
}

// As `Multigrid_levels::accelerate()`.
template <class Coarse_cycle>
void Streamed_levels::accelerate(std::size_t l, unsigned int steps,
                                 const Coarse_cycle& coarse_cycle)
{
  Level& level = at(l);
  const std::size_t n = level.files->size();
  if(level.x.empty())
    level.x = create<Complex>(l, n, "x");
  while(level.directions.size() < steps) {
    const std::string number = std::to_string(level.directions.size());
    level.directions.emplace_back(create<Complex>(l, n, "p" + number),
                                  create<Rounded>(l, n, "q" + number));
  }
  stream_rows(n, [&level](std::size_t begin, std::size_t end) {
    std::fill(level.x.begin() + begin, level.x.begin() + end, Complex(0.));
  }, releases(level.x));
  const double enough = 0.0625 * product(level.f, level.f).real(); // a quarter, squared
  for(unsigned int step = 0; step < steps; ++step) {
    start_at_zero(l);
    coarse_cycle();
    Solution& p = level.directions[step].first;
    Vector& q = level.directions[step].second;
    std::swap(p, level.u);
    pass(level, [&](std::size_t begin, std::size_t end) {
      level.files->matrix.for_each_product(
        begin, end, p.data(), [&](std::size_t i, const Complex& s) { q[i] = Rounded(s); });
    });
    p.release();
    q.release();
    clear_pins(level, q);
    for(unsigned int j = 0; j < step; ++j) {
      const auto& [pj, qj] = level.directions[j];
      const Complex c = -product(qj, p) / product(pj, qj).real();
      add_scaled(c, pj, p);
      add_scaled(Rounded(c), qj, q);
    }
    const double curvature = product(p, q).real();
    if(!(curvature > 0.))
      break;
    const Complex alpha = product(p, level.f) / curvature;
    add_scaled(alpha, p, level.x);
    if(step + 1 == steps)
      break;
    add_scaled(Rounded(-alpha), q, level.f);
    if(product(level.f, level.f).real() <= enough)
      break;
  }
  std::swap(level.u, level.x);
  level.is_zero = level.has_step = false;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_LEVELS_H
