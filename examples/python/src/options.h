// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_OPTIONS_H
#define HLSCM_PYTHON_OPTIONS_H

#include "arrays.h"
#include "outcomes.h"

#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {

namespace SMP = CGAL::Surface_mesh_parameterization;

/// The value with a name among the choices of an option.
template <class Value>
Value chosen(const std::string& option, const std::string& name,
             const std::vector<std::pair<const char*, Value>>& choices)
{
  std::string names;
  for(const auto& [known, value] : choices) {
    if(name == known)
      return value;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw Bad_input(Mesh_status::BAD_OPTIONS, option + " is \"" + name + "\", and none of " + names);
}

/// Vertices by their numbers, an array (k,) of type int64.
inline std::vector<std::size_t> to_vertices(const py::array_t<std::int64_t>& numbers)
{
  std::vector<std::size_t> vertices;
  for(py::ssize_t i = 0; i < numbers.size(); ++i) {
    if(numbers.at(i) < 0)
      throw Bad_input(Mesh_status::BAD_OPTIONS,
                      "there is no vertex " + std::to_string(numbers.at(i)));
    vertices.push_back(std::size_t(numbers.at(i)));
  }
  return vertices;
}

/// Pins as the vertices (k,) and their places (k, 2).
inline std::vector<SMP::HLSCM_pin> to_pins(const py::array_t<std::int64_t>& numbers,
                                           const py::array& places)
{
  const std::vector<std::size_t> vertices = to_vertices(numbers);
  const std::vector<Point_2> points = to_points<Point_2, 2>(places, "places of pins");
  if(points.size() != vertices.size())
    throw Bad_input(Mesh_status::BAD_OPTIONS, "there are " + std::to_string(points.size())
                    + " places for " + std::to_string(vertices.size()) + " pins");
  std::vector<SMP::HLSCM_pin> pins;
  for(std::size_t i = 0; i < points.size(); ++i)
    pins.push_back({vertices[i], points[i].x(), points[i].y()});
  return pins;
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_OPTIONS_H
