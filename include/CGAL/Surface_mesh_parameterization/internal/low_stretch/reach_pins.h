// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H

#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Newton_steps.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_level.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A vertex that is held, and where.
struct Held_vertex
{
  Vertex_index vertex;
  Plane_point place;
};

// Turns and moves a map so that the held vertices are as near to their places as possible.
inline void align(const std::vector<Held_vertex>& held, std::vector<Plane_point>& z)
{
  Plane_point from, to, turn; // turn: the sum of (place - to) times the conjugate of (z - from)
  const double share = 1. / double(held.size());
  for(const Held_vertex& h : held) {
    from = from + z[h.vertex] * share;
    to = to + h.place * share;
  }
  for(const Held_vertex& h : held)
    turn = turn + (h.place - to).times((z[h.vertex] - from).conjugate());
  const double length = std::sqrt(turn.squared_length());
  turn = length > 0. ? turn * (1. / length) : Plane_point{1., 0.};
  for(Plane_point& p : z)
    p = to + (p - from).times(turn);
}

// Brings the held vertices of a small map to their places, by steps that turn no triangle over: they go
// half as far as they can, and the others follow by Newton's method. Returns whether they arrived.
template <class Energy, class Reference>
bool reach_pins(const std::vector<Triangle_indices>& triangles, const Reference& reference,
                const Energy& energy, const std::vector<Held_vertex>& held,
                std::vector<Plane_point>& z)
{
  constexpr int attempts = 300, steps = 3;
  constexpr std::size_t iterations = 5;
  constexpr double residual = 1e-3;
  align(held, z);
  std::vector<bool> is_fixed(z.size(), false);
  for(const Held_vertex& h : held)
    is_fixed[h.vertex] = true;
  Stretch_level<Energy> level(triangles, reference, z, is_fixed, energy);
  if(!std::isfinite(level.value())) // turned into what rounding does not know of
    return false;
  Newton_steps newton;
  newton.add_level(nullptr);
  for(int i = 0; i < attempts; ++i) {
    if(level.move_towards(held)) {
      z = level.places();
      return true;
    }
    level.sweep(1.);
    for(int step = 0; step < steps; ++step)
      newton(level, iterations, residual);
  }
  return false;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H
