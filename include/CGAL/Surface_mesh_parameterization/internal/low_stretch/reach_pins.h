// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H

#include <CGAL/Surface_mesh_parameterization/internal/descent/Newton_steps.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Stretch_level.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_task.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

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

// How far the held vertices are from their places; 0 for all others.
inline std::vector<Plane_point> ways_to(const std::vector<Held_vertex>& held,
                                        const std::vector<Plane_point>& z)
{
  std::vector<Plane_point> ways(z.size());
  for(const Held_vertex& h : held)
    ways[h.vertex] = h.place - z[h.vertex];
  return ways;
}

inline bool are_there(const std::vector<Held_vertex>& held, const std::vector<Plane_point>& z)
{
  return std::all_of(held.begin(), held.end(), [&z](const Held_vertex& h) {
    return z[h.vertex].x == h.place.x && z[h.vertex].y == h.place.y;
  });
}

// How others give way when held vertices go to their places.
enum class Giving_way
{
  AFTERWARDS, // by Newton's method, after each step
  AT_ONCE     // as the second derivative of the energy says: a linear system more for each step
};

// Brings the held vertices of a map to their places, by steps half as far as no triangle turns over.
// Asks `goes_on(part done)` before each of them. Returns whether they arrived.
template <class Energy, class Goes_on>
bool reach_pins(Stretch_level<Energy>& level, Newton_steps& newton, const std::vector<Held_vertex>& held,
                Giving_way giving_way, const Goes_on& goes_on)
{
  const bool is_at_once = giving_way == Giving_way::AT_ONCE;
  const int attempts = is_at_once ? 60 : 300;
  const std::size_t iterations = is_at_once ? Newton_steps::many_iterations : Newton_steps::usual_iterations;
  constexpr int steps = 3;
  for(int i = 0; i < attempts && !are_there(held, level.places()) && goes_on(double(i) / attempts);
      ++i) {
    const std::vector<Plane_point> ways = ways_to(held, level.places());
    newton.forget_past();
    double slope = 0.;
    const std::vector<Plane_point> direction
      = is_at_once ? newton.direction(level, ways, iterations, slope) : ways;
    if(!level.move_towards(held, direction.empty() ? ways : direction))
      for(int step = 0; step < steps; ++step)
        newton(level, iterations);
    level.sweep(1.);
  }
  return are_there(held, level.places());
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_REACH_PINS_H
