// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_LEVEL_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_LEVEL_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Multigrid/vector_operations.h>
#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Border_barrier.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Border_guard.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Stretched_star.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A step along a direction: by how much the energy fell, and how long it was, in lengths of the direction.
struct Descent
{
  double gain = 0., length = 0.;
};

// The total energy of a map of a mesh, with what Newton's method wants to know of it; with a barrier
// between its borders, if they are to be kept apart.
//
// Invariant: all triangles of the map are surely positive.
template <class Energy>
class Stretch_level
{
public:
  typedef std::vector<Plane_point> Places;
  typedef std::vector<Triangle_indices> Triangles;

  // `reference(t)` is triangle t laid out by its metric. The vertices for which `is_fixed` never
  // move; none if it is empty. The triangles must live as long as the level.
  template <class Reference>
  Stretch_level(const Triangles& triangles, const Reference& reference, Places places,
                std::vector<bool> is_fixed, const Energy& energy)
    : m_triangles(triangles), m_corners(triangles, places.size()), m_energy(energy)
    , m_is_fixed(std::move(is_fixed)), m_places(std::move(places))
  {
    m_references.resize(triangles.size());
    Multigrid::for_each_index(triangles.size(), [&](std::size_t t) { m_references[t] = reference(t); });
    m_area = sum_over_triangles([this](std::size_t t) { return m_references[t].area(); });
    m_value = energy_at(m_places);
  }

  // From now on the borders, which do not cross now, are kept apart. None: they are not.
  void keep_apart(Border_loops loops)
  {
    m_barrier.reset();
    m_border.assign(loops.empty() ? 0 : size(), false);
    for(const auto& loop : loops)
      for(const Vertex_index v : loop)
        m_border[v] = true;
    if(!loops.empty())
      m_barrier.emplace(std::move(loops), m_places);
    m_value = energy_at(m_places);
  }

  const Places& places() const { return m_places; }
  Places take_places() { return std::move(m_places); } // the last that is asked of a level
  std::size_t size() const { return m_places.size(); }
  bool is_fixed(std::size_t v) const { return !m_is_fixed.empty() && m_is_fixed[v]; }
  double area() const { return m_area; } // of the reference triangles
  double value() const { return m_value; }
  double mean() const { return (m_value - barrier_at(m_places)) / m_area; } // without the barrier

  // The energy of a map, infinity if it is not valid.
  double energy_at(const Places& z) const
  {
    const double barrier = barrier_at(z);
    if(!(barrier < infinity))
      return infinity;
    const double sum = barrier + sum_over_triangles([&](std::size_t t) {
      const std::array<Plane_point, 3> c = corners_at(z, t);
      const Plane_jacobian<double> j(m_references[t], c);
      const double d = j.determinant();
      return d > 0. && is_surely_positive(c[0], c[1], c[2])
           ? m_references[t].area() * m_energy.value(j.squared_norm(), d) : infinity;
    });
    return std::isfinite(sum) ? sum : infinity;
  }

  // Takes other places, if they are a valid map; returns by how much the energy fell.
  double put(Places places)
  {
    const double before = m_value, value = energy_at(places);
    if(!(value < infinity))
      return 0.;
    m_places.swap(places);
    m_value = value;
    return before - value;
  }

  // Scales the map to its least energy among all scales, or to the area of the surface if none is
  // better than the others. Not with fixed vertices.
  void scale();

  // Takes a local step at each vertex, and then at those at which much changes; returns by how much
  // the energy fell.
  double sweep(double share_of_queue);

  // Computes the derivatives of the barrier at the map.
  void linearize()
  {
    if(m_barrier)
      m_barrier->linearize(m_places);
  }

  // What the derivatives are made of, after `linearize()`; see `stretch_matrix()`.
  const Triangles& triangles() const { return m_triangles; }
  const Indexed_mesh::Triangles_at_vertices& corners() const { return m_corners; }
  // Calls `use` for the corners of the triangles at v.
  template <class Use>
  void for_each_corner_around(Vertex_index v, const Use& use) const
  {
    Indexed_mesh::for_each_corner_around(m_triangles, m_corners, v, use);
  }
  const Energy& energy() const { return m_energy; }
  const Reference_triangle<double>& reference(std::size_t t) const { return m_references[t]; }
  // That of a triangle at the map: to compute it for each corner anew takes no longer than to store it.
  Stretch_element<double> element(std::size_t t) const
  {
    return Stretch_element<double>(
      m_references[t], Plane_jacobian<double>(m_references[t], corners_at(m_places, t)), m_energy,
      Curvature::PROJECTED);
  }
  template <class Use>
  void for_each_contact_of(Vertex_index v, const Use& use) const
  {
    if(m_barrier)
      m_barrier->for_each_contact_of(v, use);
  }

  // Goes along `direction` as far as the energy falls and no triangle turns over. `slope` is the
  // derivative of the energy there.
  Descent go(const Places& direction, double slope);

  // Moves along `direction`, whose end has each of the vertices `held` at its place, half as far as no
  // triangle turns over; returns whether that is all the way.
  template <class Held_vertex>
  bool move_towards(const std::vector<Held_vertex>& held, const Places& direction)
  {
    Places target = moved(direction, 1.);
    for(const Held_vertex& h : held)
      target[h.vertex] = h.place;
    const double limit = longest_step(direction);
    const bool is_there = limit > 1. && energy_at(target) < infinity;
    for(double t = (std::min)(0.5, 0.5 * limit); !is_there && t > 1e-6; t *= 0.5) {
      target = moved(direction, t);
      if(energy_at(target) < infinity)
        break;
    }
    put(std::move(target));
    return is_there;
  }

private:
  static constexpr std::size_t block_size = 16384;
  static constexpr double infinity = (std::numeric_limits<double>::infinity)();

  std::array<Plane_point, 3> corners_at(const Places& z, std::size_t t) const
  {
    const Triangle_indices& v = m_triangles[t];
    return {z[v[0]], z[v[1]], z[v[2]]};
  }

  // Infinity once a term is.
  template <class Term>
  double sum_over_triangles(const Term& term) const
  {
    return Blocked_execution::blocked_sum<double>(
      m_triangles.size(), block_size, [&](std::size_t begin, std::size_t end) {
        double part = 0.;
        for(std::size_t t = begin; t < end && part < infinity; ++t)
          part += term(t);
        return part;
      });
  }

  double barrier_at(const Places& z) const { return m_barrier ? m_barrier->energy_at(z) : 0.; }

  bool has_ring_within(Vertex_index v, std::size_t begin, std::size_t end) const
  {
    bool is_within = true;
    for_each_corner_around(v, [&](Vertex_index w) { is_within = is_within && begin <= w && w < end; });
    return is_within;
  }
  double relax(Vertex_index v, Stretched_star& star, Border_guard* guard);
  double longest_step(const Places& direction) const;
  Places moved(const Places& direction, double t) const
  {
    Places result(size());
    Multigrid::for_each_index(size(), [&](std::size_t v) { result[v] = m_places[v] + direction[v] * t; });
    return result;
  }

  const Triangles& m_triangles;
  Indexed_mesh::Triangles_at_vertices m_corners;
  Energy m_energy;
  std::vector<bool> m_is_fixed;
  std::optional<Border_barrier> m_barrier;
  std::vector<bool> m_border; // with a barrier: the vertices of the border
  Places m_places;
  std::vector<Reference_triangle<double>> m_references;
  double m_area = 0., m_value = 0.;
};

// Newton's method for the logarithm s of the scale: I and D are multiplied by e^2s.
template <class Energy>
void Stretch_level<Energy>::scale()
{
  const auto derivatives = [this](double factor) {
    std::array<double, 3> sum = {0., 0., 0.}; // first, second, and what they are measured by
    for(std::size_t t = 0; t < m_triangles.size(); ++t) {
      const Plane_jacobian<double> j(m_references[t], corners_at(m_places, t));
      const double i = factor * j.squared_norm(), d = factor * j.determinant();
      const Stretch_jet<double> f = m_energy(i, d);
      const double w = m_references[t].area(), first = i * f.f_i + d * f.f_d;
      sum[0] += w * 2. * first;
      sum[1] += w * 4. * (first + i * i * f.f_ii + 2. * i * d * f.f_id + d * d * f.f_dd);
      sum[2] += w * (std::abs(i * f.f_i) + std::abs(d * f.f_d));
    }
    return sum;
  };
  double s = 0.;
  for(int i = 0; i < 50; ++i) {
    const std::array<double, 3> f = derivatives(std::exp(2. * s));
    if(!(std::abs(f[0]) > 1e-12 * f[2]))
      break;
    const double step = f[1] > 0. ? -f[0] / f[1] : (f[0] > 0. ? -0.5 : 0.5);
    s += (std::max)(-0.5, (std::min)(0.5, step));
    if(std::abs(step) < 1e-3)
      break;
  }
  if(s == 0.) { // no scale is better
    double image = 0.;
    for(std::size_t t = 0; t < m_triangles.size(); ++t) {
      const std::array<Plane_point, 3> c = corners_at(m_places, t);
      image += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    }
    s = 0.5 * std::log(m_area / image);
  }
  Places scaled = m_places;
  for(Plane_point& z : scaled)
    z = z * std::exp(s);
  put(std::move(scaled));
}

// Takes a local step at v; returns by how much the energy fell.
template <class Energy>
double Stretch_level<Energy>::relax(Vertex_index v, Stretched_star& star, Border_guard* guard)
{
  if(is_fixed(v))
    return 0.;
  star.clear();
  for(const Halfedge* c = m_corners.begin(v); c != m_corners.end(v); ++c) {
    const Indexed_mesh::Triangle_corner corner(*c);
    const Triangle_indices& t = m_triangles[corner.triangle];
    star.add(m_references[corner.triangle], int(corner_of(*c)), m_places[t[corner.next]],
             m_places[t[corner.last]]);
  }
  double energy = star.energy_at(m_places[v], m_energy);
  if(!m_barrier || !m_border[v])
    return star.improve(m_places[v], energy, m_energy);
  Plane_point z = m_places[v];
  const double gain = star.improve(z, energy, m_energy);
  if(!(gain > 0.) || !guard->allows_move(z, v))
    return 0.;
  m_places[v] = z;
  guard->move(v);
  return gain;
}

// First, block by block, the vertices whose neighbours are in the same block and, where borders are kept
// apart, that are on none; then the others.
template <class Energy>
double Stretch_level<Energy>::sweep(double share_of_queue)
{
  const double much = 1e-6 * m_value, before = m_value;
  const Places places_before = m_barrier ? m_places : Places();
  Border_guard guard(m_barrier ? m_barrier->loops() : Border_loops(), m_places, Border_barrier::reach);
  enum State : std::uint8_t { IS_DONE, IS_LEFT, HAS_CHANGED };
  std::vector<State> state(size());
  const auto take_step = [&](Vertex_index v, Stretched_star& star) {
    state[v] = relax(v, star, &guard) > much ? HAS_CHANGED : IS_DONE;
  };
  Blocked_execution::blocked_for(size(), block_size, [&](std::size_t begin, std::size_t end) {
    Stretched_star star;
    for(Vertex_index v = Vertex_index(begin); v < end; ++v)
      if((m_barrier && m_border[v]) || !has_ring_within(v, begin, end))
        state[v] = IS_LEFT;
      else
        take_step(v, star);
  });
  Stretched_star star;
  std::deque<Vertex_index> queue;
  std::vector<bool> is_queued(size(), false);
  const auto push_with_ring = [&](Vertex_index v) {
    for_each_corner_around(v, [&](Vertex_index w) {
      if(!is_queued[w]) {
        is_queued[w] = true;
        queue.push_back(w);
      }
    });
  };
  for(Vertex_index v = 0; v < size(); ++v) {
    if(state[v] == IS_LEFT)
      take_step(v, star);
    if(state[v] == HAS_CHANGED)
      push_with_ring(v);
  }
  std::size_t steps = std::size_t(share_of_queue * double(size()));
  for(; steps > 0 && !queue.empty(); --steps) {
    const Vertex_index v = queue.front();
    queue.pop_front();
    is_queued[v] = false;
    if(relax(v, star, &guard) > much)
      push_with_ring(v);
  }
  m_value = energy_at(m_places);
  if(m_barrier && !(m_value <= before)) { // vertices see the barrier only as a place to keep off
    m_places = places_before;
    m_value = before;
  }
  return before - m_value;
}

template <class Energy>
double Stretch_level<Energy>::longest_step(const Places& direction) const
{
  return Blocked_execution::blocked_sum<Least>(
    m_triangles.size(), block_size, [&](std::size_t begin, std::size_t end) {
      Least least;
      for(std::size_t t = begin; t < end; ++t) {
        const std::array<Plane_point, 3> z = corners_at(m_places, t), d = corners_at(direction, t);
        least.value = (std::min)(least.value, largest_step(z[1] - z[0], d[1] - d[0], z[2] - z[0],
                                                           d[2] - d[0]));
      }
      return least;
    }).value;
}

// Armijo's rule; then, as long as the energy falls, steps twice as long.
template <class Energy>
Descent Stretch_level<Energy>::go(const Places& direction, double slope)
{
  constexpr double share = 0.9, sufficient = 1e-4, longest = 4.;
  constexpr int halvings = 30;
  const double limit = share * longest_step(direction), before = m_value;
  double t = (std::min)(1., limit);
  Places best;
  for(int i = 0; i < halvings && best.empty(); ++i) {
    Places next = moved(direction, t);
    const double value = energy_at(next);
    if(value <= before + sufficient * t * slope && value < before) {
      best.swap(next);
      m_value = value;
    } else
      t *= 0.5;
  }
  if(best.empty())
    return {};
  while(2. * t <= (std::min)(longest, limit)) {
    Places next = moved(direction, 2. * t);
    const double value = energy_at(next);
    if(!(value < m_value))
      break;
    t *= 2.;
    best.swap(next);
    m_value = value;
  }
  m_places.swap(best);
  return {before - m_value, t};
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_LEVEL_H
