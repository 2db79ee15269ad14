// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
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

typedef std::vector<Pin> Pins;

// Two vertices of the longest border that are far from each other: twice the farthest vertex from
// the last one found. They go to (0, 0) and (1, 0).
inline Pins far_border_pins(const Chart& chart)
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

// What a user or a border parameterizer wants pinned, by positions in the input; nothing if the far
// border pair is to be.
typedef std::optional<std::vector<HLSCM_pin>> Wanted_pins;

// Converts pins to those of a chart of an input with `n` vertices; says in `status` which one is
// not of the chart. Linear in the pins and the vertices.
inline Pins pins_of_chart(const Chart& chart, std::size_t n, const std::vector<HLSCM_pin>& wanted,
                          Status& status)
{
  const auto rank = Indexed_mesh::ranks(chart.source, n);
  Pins pins;
  for(const HLSCM_pin& pin : wanted) {
    if(pin.vertex >= n || rank[pin.vertex] == Indexed_mesh::no_vertex) {
      status.fail(ERROR_WRONG_PARAMETER, "the pinned vertex " + std::to_string(pin.vertex)
                  + " does not belong to the chart; pin vertices of the chart");
      break;
    }
    pins.push_back({rank[pin.vertex], {pin.u, pin.v}});
  }
  return pins;
}

// The pins by positions in the input.
inline std::vector<HLSCM_pin> reported_pins(const std::vector<std::uint32_t>& source,
                                            const Pins& pins)
{
  std::vector<HLSCM_pin> result;
  for(const Pin& pin : pins)
    result.push_back({source[pin.vertex], pin.value.real(), pin.value.imag()});
  return result;
}

inline std::string name_of(const std::vector<std::uint32_t>& source, const Pin& pin)
{
  return "vertex " + std::to_string(source[pin.vertex]);
}

// Says in `status` which of the pins of a chart with these sources is no good by itself.
inline void check_each_pin(const std::vector<std::uint32_t>& source, const Pins& pins, Status& status)
{
  const auto name = [&](const Pin& pin) { return name_of(source, pin); };
  std::vector<bool> is_pinned(source.size(), false);
  for(const Pin& pin : pins) {
    if(!std::isfinite(pin.value.real()) || !std::isfinite(pin.value.imag()))
      return status.fail(ERROR_WRONG_PARAMETER,
                         Indexed_mesh::not_finite_error("the pin of " + name(pin)));
    if(is_pinned[pin.vertex])
      return status.fail(ERROR_WRONG_PARAMETER, name(pin) + " is pinned twice; pin it once");
    is_pinned[pin.vertex] = true;
  }
}

// Says in `status` what is wrong with the pins of a conformal map of a chart with these sources.
inline void check_pins(const std::vector<std::uint32_t>& source, const Pins& pins, Status& status)
{
  if(pins.size() < 2)
    return status.fail(ERROR_WRONG_PARAMETER,
                       "fewer than two vertices are pinned; pin two or more");
  check_each_pin(source, pins, status);
  if(std::all_of(pins.begin(), pins.end(),
                 [&pins](const Pin& pin) { return pin.value == pins[0].value; }))
    return status.fail(ERROR_WRONG_PARAMETER, "the pins of " + name_of(source, pins[0]) + " and "
                       + name_of(source, pins[1])
                       + " lie in one point of the parameter plane; move one of them");
}

// Says what is odd about two pins.
inline void warn_of_pins(const Chart& chart, const Pins& pins, std::vector<std::string>& warnings)
{
  if(pins.size() != 2)
    return;
  const std::uint32_t* ring = chart.rings.ring(pins[0].vertex);
  const std::uint32_t* end = ring + chart.rings.degree(pins[0].vertex);
  if(std::find(ring, end, pins[1].vertex) != end)
    warnings.push_back("the pins " + name_of(chart.source, pins[0]) + " and "
                       + name_of(chart.source, pins[1])
                       + " are neighbours; the map will be large far from them");
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_PINS_H
