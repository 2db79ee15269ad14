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

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PAST_STEPS_H
