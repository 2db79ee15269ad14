// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_HOLD_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_HOLD_PINS_H

#include <CGAL/Surface_mesh_parameterization/internal/descent/Remaining_gain.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/circle_map.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/reach_pins.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Brings the pins of the coarsest level, which has all of them, to their places: by Tutte's map if they
// are a border that allows it, or else from the map `z` without pins. Asks `goes_on()` before each step, if they
// take long. Returns whether they arrived.
template <class Energy, class Goes_on>
bool hold_pins(const Stretch_hierarchy& levels, const Energy& energy, std::vector<Plane_point>& z,
               const Goes_on& goes_on)
{
  constexpr int steps = 100;
  constexpr std::size_t soon_done = 1000; // vertices, with which there is no need to give up
  const std::vector<Triangle_indices>& triangles = levels[0].mesh.triangles;
  const auto reference = levels.triangles_of(0);
  const std::vector<Held_vertex> held = levels.held_of(0);
  const auto goes_on_here = [&](double) { return goes_on() || levels[0].vertices.size() < soon_done; };
  Circle_map tutte(levels[0].mesh);
  const std::vector<Plane_point> border_map = tutte.run(held);
  std::vector<Giving_way> ways = {Giving_way::AT_ONCE};
  Newton_steps newton;
  newton.add_level(nullptr);
  if(is_valid(triangles, border_map) && tutte.goes_around_once(border_map))
    z = border_map;
  else {
    Stretch_level<Energy> level(triangles, reference, std::move(z), {}, energy);
    level.scale();
    level.keep_apart(levels.borders_of(0));
    Remaining_gain gains;
    for(int i = 0; i < steps; ++i) {
      newton(level, Newton_steps::usual_iterations);
      gains.add(newton, level.sweep(0.));
      if(gains.value() <= Remaining_gain::tolerance_of_coarsest * level.value())
        break;
    }
    z = level.places();
    align(held, z);
    if(border_map.empty() && !levels.is_one_to_one())
      ways.insert(ways.begin(), Giving_way::AFTERWARDS);
  }
  for(const Giving_way way : ways) {
    Stretch_level<Energy> level(triangles, reference, z, levels.fixed_of(0), energy);
    level.keep_apart(levels.borders_of(0));
    if(std::isfinite(level.value()) && reach_pins(level, newton, held, way, goes_on_here)) {
      z = level.take_places();
      return true;
    }
  }
  return false;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_HOLD_PINS_H
