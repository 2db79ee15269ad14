// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_REMAINING_GAIN_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_REMAINING_GAIN_H

#include <CGAL/Surface_mesh_parameterization/internal/descent/Newton_steps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// How much Newton's method has still to gain on a level, by what its steps gained: the last gain goes on
// as a geometric series.
class Remaining_gain
{
public:
  static constexpr double tolerance_of_coarsest = 1e-7; // part of its energy that this level may have to lose

  // Takes note of the last one of steps (`Newton_steps`), and of what a sweep gained after it.
  template <class Steps>
  void add(const Steps& newton, double swept)
  {
    m_gains.push_back(newton.gain() + swept);
    m_decrements.push_back(newton.decrement());
    m_swept = swept;
    m_surprise = newton.surprise();
    m_was_full = m_is_full;
    m_is_full = newton.is_full();
  }

  // Whether few stiff triangles may hide all others from the last step: the sweep gained more, or the linear
  // system of a later one is not half solved.
  bool is_doubtful(const Newton_steps& newton) const
  {
    return m_swept > newton.gain() || !(newton.is_solved() || m_gains.size() == 1);
  }

  // The slowest mean rate over the last one, two, four, eight and sixteen steps counts. A small gain after a
  // large one may be luck: an eighth of that counts. Less is left where the iteration is known to be
  // fast: by how well the first gain was foretold, and how small the last one is beside that before.
  double value() const
  {
    constexpr double usual_rate = 0.8, largest_rate = 0.98, fast = 0.2, least_part = 0.1;
    const std::size_t n = m_gains.size();
    if(n == 0)
      return 0.;
    const double last = m_gains[n - 1], before = gain_before();
    double rate = before > 0. ? (std::max)(usual_rate, last / before) : usual_rate;
    if(n > 1)
      rate = (std::max)(rate, slowest_rate(n - 1, 1, [this](std::size_t i) { return larger_gain(i); }));
    rate = (std::min)(rate, largest_rate);
    const double part = before > 0. ? last / before / fast : std::pow(m_surprise / fast, 2.);
    return (std::max)(last, before / 8.) * rate / (1. - rate)
         * (std::min)(1., (std::max)(least_part, part));
  }

  // The same on the finest level, where what the last linear system left counts, too. In one-to-one maps, where
  // borders make steps short, what these should have gained.
  double value_on_finest(const Newton_steps& newton, bool is_one_to_one) const
  {
    constexpr double doubt = 10., likely = 0.5; // of what may be unsolved
    if(!is_one_to_one)
      return (std::max)(value(), newton.unsolved()) * (is_doubtful(newton) ? doubt : 1.);
    return newton.is_full() ? value()
                            : (std::max)(value(), newton.foretold() + likely * newton.unsolved());
  }

  // The same by what the next step should gain, up to the second order: a few times that, less where these
  // values fall fast. That exaggerates the second derivative where triangles turn: where it is 1/c times the true
  // one, these values fall to (1 - c)^2 of themselves in a step, and 1/c of the value is left, more where faster
  // directions hide such ones. After many steps of which hardly anything else is left it says little.
  double value(double next_decrement) const
  {
    constexpr double least = 1.5, usual = 7.; // in multiples of it
    constexpr std::size_t few_steps = 8;
    std::vector<double> all = m_decrements;
    all.push_back(next_decrement);
    const double rate = slowest_rate(all.size() - 1, 0, [&all](std::size_t i) { return all[i]; });
    const double slow = rate < 1. ? least / std::pow(1. - std::sqrt(rate), 2.)
                                  : (std::numeric_limits<double>::infinity)();
    return next_decrement * (m_gains.size() <= few_steps ? (std::min)(usual, slow) : slow);
  }

private:
  double larger_gain(std::size_t i) const { return (std::max)(m_gains[i], m_gains[i - 1]); }

  // That of a step that was made short says little.
  double gain_before() const
  {
    const std::size_t n = m_gains.size();
    return n > 2 && !m_was_full ? larger_gain(n - 2) : n > 1 ? m_gains[n - 2] : 0.;
  }

  // The slowest mean rate at which positive values of [first, last] fall over powers of two up to the last one.
  template <class Value>
  static double slowest_rate(std::size_t last, std::size_t first, const Value& value)
  {
    double rate = 0.;
    for(std::size_t span = 1; span <= 16 && first + span <= last; span *= 2)
      if(value(last - span) > 0.)
        rate = (std::max)(rate, std::pow(value(last) / value(last - span), 1. / double(span)));
    return rate;
  }

  std::vector<double> m_gains, m_decrements;
  double m_surprise = 0., m_swept = 0.;
  bool m_is_full = true, m_was_full = true;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_REMAINING_GAIN_H
