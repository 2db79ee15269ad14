// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PAST_STEPS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PAST_STEPS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/vector_operations.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/plane_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What the last steps of an iteration have found out of the second derivative: along them it is the
// change of the gradient. The projected one exaggerates it where triangles turn, as limbs do that bend,
// so that steps by it alone are too short there. (L-BFGS, Nocedal 1980, with the projected one as its
// first guess.)
class Past_steps
{
public:
  typedef std::vector<Plane_point> Vectors;

  void forget()
  {
    m_steps.clear();
    m_places.clear();
  }

  // Takes note of where the iteration has come to; of the places until then only what was changed is kept.
  void add(const Vectors& places, Vectors gradient)
  {
    constexpr double least = 1e-12; // cosine of a step and its change: smaller ones may be rounding
    if(m_places.size() == places.size()) {
      Step step = {differences(places, m_places), differences(gradient, m_gradient), 0., 0.};
      step.curvature = product(step.way, step.change);
      if(step.curvature > least * std::sqrt(product(step.way, step.way) * product(step.change, step.change)))
        m_steps.push_back(std::move(step));
      if(m_steps.size() > memory)
        m_steps.pop_front();
    }
    Vectors().swap(m_places);
    m_gradient = std::move(gradient);
  }

  // Takes note that the iteration goes on from the places that were added last.
  void leave(const Vectors& places) { m_places = places; }

  const Vectors& gradient() const { return m_gradient; } // that was added last

  // What is left of the gradient for the first guess to invert.
  Vectors rest_of(Vectors gradient)
  {
    for(auto step = m_steps.rbegin(); step != m_steps.rend(); ++step) {
      step->share = product(step->way, gradient) / step->curvature;
      add_scaled(-step->share, step->change, gradient);
    }
    return gradient;
  }

  // Makes the direction against that rest one against the gradient.
  void complete(Vectors& direction) const
  {
    for(const Step& step : m_steps)
      add_scaled(-step.share - product(step.change, direction) / step.curvature, step.way, direction);
  }

  template <class Real, class Other_real>
  static double product(const std::vector<Plane_vector<Real>>& a,
                        const std::vector<Plane_vector<Other_real>>& b)
  {
    return Blocked_execution::blocked_sum<double>(
      a.size(), block_size, [&](std::size_t begin, std::size_t end) {
        double sum = 0.;
        for(std::size_t v = begin; v < end; ++v)
          sum += double(a[v].x) * double(b[v].x) + double(a[v].y) * double(b[v].y);
        return sum;
      });
  }

private:
  // What helps to foretell needs no more digits, and takes half the memory.
  typedef std::vector<Plane_vector<float>> Single_vectors;

  struct Step
  {
    Single_vectors way, change; // of the places and of the gradient
    double curvature, share;    // way . change; what `rest_of()` took of the change
  };

  static constexpr std::size_t memory = 3; // with 5, 10 the iterations are as long
  static constexpr std::size_t block_size = 16384;

  static Single_vectors differences(const Vectors& a, const Vectors& b)
  {
    Single_vectors result(a.size());
    Multigrid::for_each_index(a.size(), [&](std::size_t v) {
      result[v] = {float(a[v].x - b[v].x), float(a[v].y - b[v].y)};
    });
    return result;
  }

  static void add_scaled(double factor, const Single_vectors& a, Vectors& sum)
  {
    Multigrid::for_each_index(a.size(), [&](std::size_t v) {
      sum[v] = sum[v] + Plane_point{double(a[v].x), double(a[v].y)} * factor;
    });
  }

  std::deque<Step> m_steps; // the oldest first
  Vectors m_places, m_gradient;
};

// How much an iteration has still to gain, by what its steps gained: the last gain goes on as a
// geometric series.
class Remaining_gain
{
public:
  // Takes note of what a step gained, which was off from what the second order foretold by a part
  // `surprise` of that, and whether it was not made short.
  void add(double gain, double surprise, bool is_full)
  {
    m_gains.push_back(gain);
    m_surprise = surprise;
    m_was_full = m_is_full;
    m_is_full = is_full;
  }

  // Whether there was one step only.
  bool is_first() const { return m_gains.size() == 1; }

  // The slowest mean rate over the last one, two, four, eight and sixteen steps counts. A small gain after a
  // large one may be luck: an eighth of that counts. Less is left where the iteration is known to be
  // fast: by how well the first gain was foretold, and how small the last one is beside that before.
  double value() const
  {
    const std::size_t n = m_gains.size();
    if(n == 0)
      return 0.;
    const double last = m_gains[n - 1], before = gain_before();
    double rate = before > 0. ? (std::max)(usual_rate, last / before) : usual_rate;
    for(std::size_t span = 1; span <= 16 && span + 1 < n; span *= 2)
      if(larger_of_two(n - 1 - span) > 0.)
        rate = (std::max)(rate, std::pow(larger_of_two(n - 1) / larger_of_two(n - 1 - span),
                                         1. / double(span)));
    rate = (std::min)(rate, largest_rate);
    const double part = before > 0. ? last / before / fast : std::pow(m_surprise / fast, 2.);
    return (std::max)(last, before / 8.) * rate / (1. - rate)
         * (std::min)(1., (std::max)(least_part, part));
  }

private:
  static constexpr double usual_rate = 0.8, largest_rate = 0.98, fast = 0.2, least_part = 0.1;

  double larger_of_two(std::size_t i) const { return (std::max)(m_gains[i], m_gains[i - 1]); }

  // That of a step that was made short says little.
  double gain_before() const
  {
    const std::size_t n = m_gains.size();
    return n > 2 && !m_was_full ? larger_of_two(n - 2) : n > 1 ? m_gains[n - 2] : 0.;
  }

  std::vector<double> m_gains;
  double m_surprise = 0.;
  bool m_is_full = true, m_was_full = true;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PAST_STEPS_H
