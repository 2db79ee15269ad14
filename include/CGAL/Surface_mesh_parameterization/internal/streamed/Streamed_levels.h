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
#include <functional>
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
  template <class Value, class Use, class Release>
  void prolong(const Value* coarse, const Use& use, const Release& release) const
  {
    typedef typename Value::value_type Real;
    stream_rows(
      size(),
      [&](std::size_t begin, std::size_t end) {
        for(std::size_t i = begin; i < end; ++i) {
          const Streamed_stencil& s = stencils[i];
          use(i, Real(s.weight[0]) * coarse[s.source[0]] + Real(s.weight[1]) * coarse[s.source[1]]
                   + Real(s.weight[2]) * coarse[s.source[2]]);
        }
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
// A model of `MultigridLevels`.
class Streamed_levels
{
public:
  typedef Mapped_array<Rounded> Vector;

  Streamed_levels(Work_folder& folder, std::vector<Streamed_level>& levels,
                  Gathered_hierarchy& gathered)
    : m_gathered(gathered)
  {
    for(Streamed_level& level : levels)
      m_levels.push_back(make_level(folder, level, m_levels.size() + 1));
    m_coarsest_f.resize(gathered.size());
    m_coarsest_u.resize(gathered.size());
  }

  // The right-hand side and, after a cycle, the solution of a level from 1 on.
  Vector& right_side(std::size_t l) { return at(l).f; }
  Vector& solution(std::size_t l) { return at(l).u; }
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
    Vector u, f, r, z, next;  // of the system; residual; the last step of the smoother, the next
    bool is_zero = true;      // u is 0, whatever is stored
    bool has_step = false;    // r - H z is f - H u
    std::vector<std::pair<Vector, Vector>> directions; // and H times them; for the accelerator
    Vector x;
    std::function<Vector(const std::string&)> create;
  };

  Level make_level(Work_folder& folder, Streamed_level& files, std::size_t l)
  {
    Level level;
    level.files = &files;
    level.create = [&folder, &files, l](const std::string& name) {
      return folder.create_scratch<Rounded>("cycle" + std::to_string(l) + "_" + name, files.size());
    };
    level.u = level.create("u");
    level.f = level.create("f");
    level.r = level.create("r");
    level.z = level.create("z");
    level.next = level.create("next");
    return level;
  }

  Level& at(std::size_t l) { return m_levels[l - 1]; }

  // What is in files.
  static void release(const Level& level, std::size_t begin, std::size_t end)
  {
    level.files->matrix.release(begin, end);
    for(const Vector* vector : {&level.u, &level.f, &level.r, &level.z, &level.next})
      vector->release_passed(begin, end);
  }

  template <class Body>
  static void pass(const Level& level, const Body& body)
  {
    stream_rows(level.files->size(), body, [&level](std::size_t begin, std::size_t end) {
      release(level, begin, end);
    });
  }

  static void clear_pins(const Level& level, const Vector& x)
  {
    for(const std::uint32_t pin : level.files->pins)
      x[pin] = 0.f;
  }

  static std::complex<double> product(const Vector& x, const Vector& y)
  {
    return sum_rows<std::complex<double>>(
      x.size(), [&](std::size_t begin, std::size_t end) {
        std::complex<double> sum = 0.;
        for(std::size_t i = begin; i < end; ++i)
          sum += std::conj(std::complex<double>(x[i])) * std::complex<double>(y[i]);
        return sum;
      }, releases(x, y));
  }

  static void add_scaled(Rounded c, const Vector& x, const Vector& y)
  {
    stream_rows(x.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        y[i] += c * x[i];
    }, releases(x, y));
  }

  Gathered_hierarchy& m_gathered;
  std::vector<Level> m_levels;
  std::vector<Rounded> m_coarsest_f, m_coarsest_u;
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
      h.for_each_product(begin, end, level.u.data(), [&](std::size_t i, const Rounded& s) {
        level.r[i] = level.f[i] - s;
        level.z[i] = weight * inverse[i] * level.r[i];
      });
    });
  const auto add_step = [&](std::size_t i, const Rounded& step, bool is_first) {
    level.u[i] = starts_at_zero && is_first ? step : level.u[i] + step;
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
        h.for_each_product(begin, end, level.u.data(), [&](std::size_t i, const Rounded& s) {
          level.r[i] = level.f[i] - s;
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
                       [&](std::size_t i, const Rounded& value) {
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
  if(level.x.empty())
    level.x = level.create("x");
  while(level.directions.size() < steps) {
    const std::string number = std::to_string(level.directions.size());
    level.directions.emplace_back(level.create("p" + number), level.create("q" + number));
  }
  stream_rows(level.x.size(), [&level](std::size_t begin, std::size_t end) {
    std::fill(level.x.begin() + begin, level.x.begin() + end, Rounded(0.f));
  }, releases(level.x));
  const double enough = 0.0625 * product(level.f, level.f).real(); // a quarter, squared
  for(unsigned int step = 0; step < steps; ++step) {
    start_at_zero(l);
    coarse_cycle();
    Vector& p = level.directions[step].first;
    Vector& q = level.directions[step].second;
    std::swap(p, level.u);
    pass(level, [&](std::size_t begin, std::size_t end) {
      level.files->matrix.for_each_product(
        begin, end, p.data(), [&](std::size_t i, const Rounded& s) { q[i] = s; });
    });
    p.release();
    q.release();
    clear_pins(level, q);
    for(unsigned int j = 0; j < step; ++j) {
      const auto& [pj, qj] = level.directions[j];
      const Rounded c(-product(qj, p) / product(pj, qj).real());
      add_scaled(c, pj, p);
      add_scaled(c, qj, q);
    }
    const double curvature = product(p, q).real();
    if(!(curvature > 0.))
      break;
    const Rounded alpha(product(p, level.f) / curvature);
    add_scaled(alpha, p, level.x);
    if(step + 1 == steps)
      break;
    add_scaled(-alpha, q, level.f);
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
