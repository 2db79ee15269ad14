// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_BORDER_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_BORDER_PINS_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The border vertices of a mesh as a chart without faces: a vertex is followed by the one to which
// its row has the imaginary part 1/2. `entries` are those of the border, by rows; `point(v)` is
// that of a vertex; `source` of the chart are vertices of the mesh, ascending.
template <class Point>
Chart border_of(const std::vector<Border_entry>& entries, const Point& point)
{
  Chart border;
  std::vector<std::uint32_t> next;
  for(const Border_entry& entry : entries)
    if(entry.im > 0.) {
      border.source.push_back(entry.row);
      next.push_back(entry.column);
    }
  for(const std::uint32_t v : border.source) {
    const Three_numbers& p = point(v);
    border.mesh.points.emplace_back(p[0], p[1], p[2]);
  }
  const auto position = [&border](std::uint32_t v) {
    return std::uint32_t(std::lower_bound(border.source.begin(), border.source.end(), v)
                         - border.source.begin());
  };
  std::vector<bool> is_seen(next.size(), false);
  for(std::uint32_t start = 0; start < next.size(); ++start) {
    if(is_seen[start])
      continue;
    border.borders.emplace_back();
    for(std::uint32_t i = start; !is_seen[i]; i = position(next[i])) {
      is_seen[i] = true;
      border.borders.back().push_back(i);
    }
  }
  return border;
}

// The pins of a mesh with such a border: those that it would get in memory.
template <class Point>
Pins far_border_pins(const std::vector<Border_entry>& entries, const Point& point)
{
  const Chart border = border_of(entries, point);
  if(border.borders.empty())
    refuse("the surface is closed; cut it open first", ERROR_NO_TOPOLOGICAL_DISC);
  Pins pins = far_border_pins(border);
  for(Pin& pin : pins)
    pin.vertex = border.source[pin.vertex];
  return pins;
}

// Half the lengths of the two border edges of each border vertex: see `border_mass()` of a level in
// memory. Its row has an imaginary part for each of them.
template <class Point>
Multigrid::Diagonal_mass border_mass(const std::vector<Border_entry>& entries, const Point& point)
{
  std::vector<Multigrid::Diagonal_mass::Entry> masses;
  for(const Border_entry& entry : entries) {
    if(entry.im == 0.)
      continue;
    if(masses.empty() || masses.back().row != entry.row)
      masses.push_back({entry.row, 0.});
    const Three_numbers &p = point(entry.row), &q = point(entry.column);
    masses.back().value += 0.5 * std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  return Multigrid::Diagonal_mass(std::move(masses));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_BORDER_PINS_H
