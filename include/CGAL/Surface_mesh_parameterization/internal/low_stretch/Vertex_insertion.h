// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Border_guard.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Stretched_star.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A stretch [first, last) of the collapses of a pass whose rings, when they took place, have vertices of
// [low, high) alone: no other stretch of the pass has any of these, so that they can be undone at the same
// time.
struct Insertion_part
{
  std::size_t first, last;
  Vertex_index low, high;
  std::vector<std::size_t> waiting;  // collapses that cannot be undone without others, the last one first
  std::vector<Vertex_index> crowded; // around which vertices beyond the bounds, or of borders, give way, too
};

// Cuts the collapses [first, last) of one pass, whose vertices ascend, into such parts; `rings` are those
// before they are undone. The parts do not depend on the number of threads.
inline std::vector<Insertion_part>
insertion_parts(const Indexed_mesh::Vertex_rings& rings,
                const std::vector<Surface_mesh_multiresolution::Halfedge_collapse>& collapses,
                std::size_t first, std::size_t last)
{
  constexpr std::size_t least_size = 4096, block = 4096;
  const std::size_t n = last - first;
  if(n < 2 * least_size)
    return {};
  std::vector<Vertex_index> low(n), high(n); // of each ring, then of it and all after, or before it
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const Vertex_index v = collapses[first + i].removed;
      const Vertex_index* r = rings.ring(v);
      const auto [least, greatest] = std::minmax_element(r, r + rings.degree(v));
      low[i] = (std::min)(v, *least);
      high[i] = (std::max)(v, *greatest);
    }
  });
  for(std::size_t i = 1; i < n; ++i) {
    high[i] = (std::max)(high[i], high[i - 1]);
    low[n - 1 - i] = (std::min)(low[n - 1 - i], low[n - i]);
  }
  std::vector<Insertion_part> parts = {{first, last, 0, Vertex_index(rings.size()), {}, {}}};
  for(std::size_t i = least_size; i + least_size <= n; ++i)
    if(high[i - 1] < low[i] && first + i - parts.back().first >= least_size) {
      parts.back().last = first + i;
      parts.back().high = low[i];
      parts.push_back({first + i, last, low[i], Vertex_index(rings.size()), {}, {}});
    }
  return parts;
}

// Puts the vertices of a mesh that collapses removed back into the map, one after the other.
//
//      r2 ---- r1          The ring of v without v is filled by triangles at t, all positive. So t
//     /  .    .  \         sees all edges of the ring from their left side, and close to t there are
//   r3     v  .  t = r0    points that see them strictly so: places for v that turn no triangle over.
//     \  .    .  /
//      r4 ---- r5
//
template <class Metric, class Energy>
class Vertex_insertion
{
public:
  typedef Surface_mesh_multiresolution::Halfedge_collapse Halfedge_collapse;

  // `rings` are those after the collapses, `places` those of all vertices, of which only those that
  // are there count; `metric(a, b, c)` is the triangle of three vertices. The border does not cross
  // itself if there is a guard.
  Vertex_insertion(Indexed_mesh::Vertex_rings& rings, std::vector<Plane_point>& places,
                   const std::vector<bool>& is_fixed, const Metric& metric, const Energy& energy,
                   Border_guard* guard)
    : m_rings(rings), m_places(places), m_is_fixed(is_fixed), m_metric(metric), m_energy(energy)
    , m_guard(guard)
  {}

  // The same for one part of a pass while others undo other ones. The guard is not used then: borders wait.
  Vertex_insertion for_part(Insertion_part& part) const
  {
    Vertex_insertion result(*this);
    result.m_part = &part;
    return result;
  }

  // Undoes a collapse. Where the energy is more than twice `mean` an area, the neighbourhood gives
  // way. Returns whether there was a place for the vertex that rounding knows of; in a part, whether it
  // could be undone without others.
  bool operator()(const Halfedge_collapse& c, double mean)
  {
    constexpr int attempts = 10;
    const Vertex_index v = c.removed;
    if(m_part != nullptr && (is_guarded(v) || m_rings.needs_new_spill_to_split(v, c.kept)))
      return false;
    std::pair<double, bool> placed = place(v, c.kept);
    if(m_part != nullptr && !placed.second)
      return false;
    for(int i = 0; i < attempts && !placed.second; ++i) { // make room around v
      relax(c.kept);
      relax_ring(v);
      placed = place(v, c.kept);
    }
    if(!placed.second)
      return false;
    m_rings.split(v, c.kept);
    if(is_guarded(v))
      m_guard->insert(v, previous(v), m_rings.ring(v)[0]);
    if(!(placed.first > 2. * mean * m_star.area()))
      return true;
    if(m_part == nullptr || is_within_part(v))
      relax_crowd(v);
    else
      m_part->crowded.push_back(v);
    return true;
  }

  // Relaxes v and its neighbours as long as much is gained.
  void relax_crowd(Vertex_index v)
  {
    constexpr int rounds = 8;
    constexpr double much = 0.05;
    double last = relax(v)[1];
    for(int i = 0; i < rounds; ++i) {
      relax_ring(v);
      const double energy = relax(v)[1];
      if(!(energy < (1. - much) * last))
        break;
      last = energy;
    }
  }

private:
  bool is_guarded(Vertex_index v) const { return m_guard != nullptr && m_rings.is_border(v); }

  // Whether all that counts where v and its neighbours are relaxed belongs to the part.
  bool is_within_part(Vertex_index v) const
  {
    const auto has_ring = [this](Vertex_index w) {
      const Vertex_index* r = m_rings.ring(w);
      return !is_guarded(w) && std::all_of(r, r + m_rings.degree(w), [this](Vertex_index x) {
        return m_part->low <= x && x < m_part->high;
      });
    };
    const Vertex_index* r = m_rings.ring(v);
    return has_ring(v) && std::all_of(r, r + m_rings.degree(v), has_ring);
  }

  // The vertex before v on the border.
  Vertex_index previous(Vertex_index v) const { return m_rings.ring(v)[m_rings.degree(v) - 1]; }

  void gather_star(Vertex_index v)
  {
    m_star.clear();
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t d = m_rings.degree(v), wedges = m_rings.is_border(v) ? d - 1 : d;
    for(std::uint32_t i = 0; i < wedges; ++i) {
      const Vertex_index a = r[i], b = r[i + 1 == d ? 0 : i + 1];
      m_star.add(m_metric(v, a, b), 0, m_places[a], m_places[b]);
    }
  }

  // Finds a place for v, which goes back to where t is, in its ring; returns the energy of its star
  // and whether there is one.
  std::pair<double, bool> place(Vertex_index v, Vertex_index t)
  {
    constexpr int steps = 3;
    gather_star(v);
    // Around a vertex inside the surface the ring goes once, by angles at t of less than 2 pi
    const bool may_turn_twice = !m_rings.is_border(v) && m_rings.is_border(t);
    const auto energy_at = [&](const Plane_point& z) {
      const double energy = m_star.energy_at(z, m_energy);
      return may_turn_twice && energy < infinity && !m_star.goes_around_once(z) ? infinity : energy;
    };
    Plane_point z = m_star.most_conformal_place();
    double energy = energy_at(z);
    if(!(energy < infinity)) {
      z = m_star.middle_of_kernel();
      energy = energy_at(z);
    }
    if(!(energy < infinity))
      return {energy, false};
    for(int i = 0; i < steps && m_star.improve(z, energy, m_energy) > enough * energy; ++i)
      ;
    if(is_guarded(v) && !keep_off_border(v, z, energy))
      return {energy, false};
    m_places[v] = z;
    return {energy, true};
  }

  // Moves the place z that was found for v so that the border does not cross itself there: towards the
  // edge that v divides; beyond it, to the inside, where v has more than one triangle; or very near to
  // it. Of these the place of least energy, off other borders if there is one; returns whether there is any.
  bool keep_off_border(Vertex_index v, Plane_point& z, double& energy) const
  {
    constexpr double off = 0.1; // the length of an edge, where the barrier does not rise steeply yet
    const Vertex_index a = previous(v), b = m_rings.ring(v)[0];
    const Plane_point &p = m_places[a], &q = m_places[b];
    if(m_guard->allows(z, a, b, off))
      return true;
    const Plane_point middle = (p + q) * 0.5, way = z - middle, across = {q.y - p.y, p.x - q.x};
    energy = infinity;
    for(const double distance : {off, 0.}) {
      const auto consider = [&](const Plane_point& place) {
        const double there = m_star.energy_at(place, m_energy);
        if(there < energy && m_guard->allows(place, a, b, distance)) {
          z = place;
          energy = there;
        }
      };
      for(const double part : {1., 0.5, 0.25, 0.125})
        consider(middle + way * part);
      consider(m_star.middle_of_kernel_beside(p, q));
      for(double height = 0.25; height > 1e-4; height *= 0.5)
        consider(middle + across * height);
      if(energy < infinity)
        return true;
    }
    return false;
  }

  // Takes a local step at a vertex; returns its energy before and after.
  std::array<double, 2> relax(Vertex_index v)
  {
    gather_star(v);
    double energy = m_star.energy_at(m_places[v], m_energy);
    const double before = energy;
    if(!m_is_fixed.empty() && m_is_fixed[v])
      return {before, energy};
    Plane_point z = m_places[v];
    m_star.improve(z, energy, m_energy);
    if(is_guarded(v)) {
      if(!m_guard->allows_move(z, v))
        return {before, before};
      m_places[v] = z;
      m_guard->move(v);
    }
    m_places[v] = z;
    return {before, energy};
  }

  void relax_ring(Vertex_index v)
  {
    m_ring.assign(m_rings.ring(v), m_rings.ring(v) + m_rings.degree(v));
    for(const Vertex_index w : m_ring)
      relax(w);
  }

  static constexpr double infinity = (std::numeric_limits<double>::infinity)();
  static constexpr double enough = 0.01; // of the energy: what another step must gain

  Indexed_mesh::Vertex_rings& m_rings;
  std::vector<Plane_point>& m_places;
  const std::vector<bool>& m_is_fixed;
  const Metric& m_metric;
  const Energy& m_energy;
  Border_guard* m_guard;
  Insertion_part* m_part = nullptr;
  Stretched_star m_star;
  std::vector<Vertex_index> m_ring;
};

// Collapses that have not been undone yet though others before them have: which of these must wait, too.
// Each fills the star of the vertex that it removes. Those whose rings have not this vertex were in other
// triangles, and can be undone in any order.
class Waiting_collapses
{
public:
  typedef Surface_mesh_multiresolution::Halfedge_collapse Halfedge_collapse;

  explicit Waiting_collapses(const Indexed_mesh::Vertex_rings& rings)
    : m_rings(rings), m_marks(rings.size(), 0)
  {}

  void add(const Halfedge_collapse& c)
  {
    m_marks[c.removed] |= IS_REMOVED;
    m_marks[c.kept] |= IS_KEPT; // what is known of it changes with each collapse
  }

  bool are_before(const Halfedge_collapse& c) const
  {
    const Vertex_index* r = m_rings.ring(c.removed);
    return (m_marks[c.kept] & IS_KEPT) != 0
        || std::any_of(r, r + m_rings.degree(c.removed),
                       [this](Vertex_index v) { return (m_marks[v] & IS_REMOVED) != 0; });
  }

private:
  enum Mark : std::uint8_t { IS_REMOVED = 1, IS_KEPT = 2 };

  const Indexed_mesh::Vertex_rings& m_rings;
  std::vector<std::uint8_t> m_marks; // of each vertex
};

// Undoes the collapses [first, last) of one pass, the last one first, or those that have nothing to do
// with each other at the same time. `undo(i)` is told of each before. Returns whether all were undone.
template <class Insertion, class Undo>
bool insert_pass(Insertion insertion, const Indexed_mesh::Vertex_rings& rings,
                 const std::vector<Surface_mesh_multiresolution::Halfedge_collapse>& collapses,
                 std::size_t first, std::size_t last, double mean, const Undo& undo)
{
  const auto insert = [&](std::size_t i, Insertion& some) {
    undo(i);
    return some(collapses[i], mean);
  };
  std::vector<Insertion_part> parts = insertion_parts(rings, collapses, first, last);
  if(parts.size() < 2) {
    while(last > first)
      if(!insert(--last, insertion))
        return false;
    return true;
  }
  Waiting_collapses waiting(rings);
  Blocked_execution::blocked_for(parts.size(), 1, [&](std::size_t p, std::size_t) {
    Insertion some = insertion.for_part(parts[p]);
    for(std::size_t i = parts[p].last; i-- > parts[p].first;)
      if(waiting.are_before(collapses[i]) || !insert(i, some)) {
        waiting.add(collapses[i]);
        parts[p].waiting.push_back(i);
      }
  });
  for(const Insertion_part& part : parts) {
    for(const std::size_t i : part.waiting)
      if(!insert(i, insertion))
        return false;
    for(const Vertex_index v : part.crowded)
      insertion.relax_crowd(v);
  }
  return true;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H
