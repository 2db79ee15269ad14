// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H

#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A pin in the indices of a chart.
struct Pin
{
  std::uint32_t vertex;
  std::complex<double> value;
};

// Two vertices of the longest border that are far from each other: twice the farthest vertex from
// the last one found. They go to (0, 0) and (1, 0).
inline std::vector<Pin> far_border_pins(const Chart& chart)
{
  const auto length = [&chart](const std::vector<std::uint32_t>& loop) {
    double sum = 0.;
    for(std::size_t i = 0; i < loop.size(); ++i)
      sum += std::sqrt(squared_distance(chart.mesh.points[loop[i]],
                                        chart.mesh.points[loop[(i + 1) % loop.size()]]));
    return sum;
  };
  std::size_t longest = 0;
  for(std::size_t b = 1; b < chart.borders.size(); ++b)
    if(length(chart.borders[b]) > length(chart.borders[longest]))
      longest = b;
  const std::vector<std::uint32_t>& loop = chart.borders[longest];
  const auto farthest = [&](std::uint32_t from) {
    std::uint32_t best = loop[0] == from ? loop[1] : loop[0];
    for(const std::uint32_t v : loop)
      if(v != from
         && compare_squared_distance(chart.mesh.points[from], chart.mesh.points[v],
                                     squared_distance(chart.mesh.points[from],
                                                      chart.mesh.points[best])) == LARGER)
        best = v;
    return best;
  };
  const std::uint32_t a = farthest(farthest(loop[0]));
  return {{a, 0.}, {farthest(a), 1.}};
}

inline std::string name_of(const Chart& chart, const Pin& pin)
{
  return "vertex " + std::to_string(chart.source[pin.vertex]);
}

// Says in `chart` what is wrong with the pins.
inline void check_pins(Chart& chart, const std::vector<Pin>& pins)
{
  const auto name = [&](const Pin& pin) { return name_of(chart, pin); };
  if(pins.size() < 2)
    return chart.fail(ERROR_WRONG_PARAMETER, "fewer than two vertices are pinned; pin two or more");
  std::vector<bool> is_pinned(chart.source.size(), false);
  bool is_spread = false;
  for(const Pin& pin : pins) {
    if(!std::isfinite(pin.value.real()) || !std::isfinite(pin.value.imag()))
      return chart.fail(ERROR_WRONG_PARAMETER, "the pin of " + name(pin)
                        + " has a coordinate that is not a finite number");
    if(is_pinned[pin.vertex])
      return chart.fail(ERROR_WRONG_PARAMETER, name(pin) + " is pinned twice; pin it once");
    is_pinned[pin.vertex] = true;
    is_spread = is_spread || pin.value != pins[0].value;
  }
  if(!is_spread)
    return chart.fail(ERROR_WRONG_PARAMETER, "the pins of " + name(pins[0]) + " and "
                      + name(pins[1]) + " lie in one point of the parameter plane; move one of them");
}

// Says what is odd about the pins of a chart that still has its rings.
inline void warn_of_pins(const Chart& chart, const std::vector<Pin>& pins,
                         std::vector<std::string>& warnings)
{
  if(chart.error != OK || pins.size() > 2)
    return;
  const std::uint32_t* ring = chart.rings.ring(pins[0].vertex);
  const std::uint32_t* end = ring + chart.rings.degree(pins[0].vertex);
  if(std::find(ring, end, pins[1].vertex) != end)
    warnings.push_back("the pins " + name_of(chart, pins[0]) + " and " + name_of(chart, pins[1])
                       + " are neighbours; the map will be large far from them");
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H
