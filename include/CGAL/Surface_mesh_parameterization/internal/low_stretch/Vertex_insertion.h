// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Border_guard.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretched_star.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

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

  // Undoes a collapse. Where the energy is more than twice `mean` an area, the neighbourhood gives
  // way. Returns whether there was a place for the vertex that rounding knows of.
  bool operator()(const Halfedge_collapse& c, double mean)
  {
    constexpr int attempts = 10;
    const Vertex_index v = c.removed;
    std::pair<double, bool> placed = place(v, c.kept);
    for(int i = 0; i < attempts && !placed.second; ++i) { // make room around v
      relax(c.kept);
      relax_ring(v);
      placed = place(v, c.kept);
    }
    if(!placed.second)
      return false;
    m_rings.split(v, c.kept);
    if(m_guard != nullptr && m_rings.is_border(v))
      m_guard->insert(v, previous(v), m_rings.ring(v)[0]);
    if(placed.first > 2. * mean * m_star.area())
      relax_crowd(v);
    return true;
  }

private:
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
    if(m_guard != nullptr && m_rings.is_border(v) && !keep_off_border(v, z, energy))
      return {energy, false};
    m_places[v] = z;
    return {energy, true};
  }

  // Moves the place z that was found for v so that the border does not cross itself there: towards the
  // edge that v divides; beyond it, to the inside, where v has more than one triangle; or very near to
  // it. Returns whether there is a valid place.
  bool keep_off_border(Vertex_index v, Plane_point& z, double& energy) const
  {
    const Vertex_index a = previous(v), b = m_rings.ring(v)[0];
    const Plane_point &p = m_places[a], &q = m_places[b];
    if(m_guard->allows(z, a, b))
      return true;
    const Plane_point middle = (p + q) * 0.5, way = z - middle;
    for(const double part : {0.5, 0.25, 0.125}) {
      z = middle + way * part;
      energy = m_star.energy_at(z, m_energy);
      if(energy < infinity && m_guard->allows(z, a, b))
        return true;
    }
    z = m_star.middle_of_kernel_beside(p, q);
    for(double height = 0.25; height > 1e-4; height *= 0.5) {
      energy = m_star.energy_at(z, m_energy);
      if(energy < infinity && m_guard->allows(z, a, b))
        return true;
      z = middle + Plane_point{q.y - p.y, p.x - q.x} * height;
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
    if(m_guard != nullptr && m_rings.is_border(v)) {
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

  static constexpr double infinity = (std::numeric_limits<double>::infinity)();
  static constexpr double enough = 0.01; // of the energy: what another step must gain

  Indexed_mesh::Vertex_rings& m_rings;
  std::vector<Plane_point>& m_places;
  const std::vector<bool>& m_is_fixed;
  const Metric& m_metric;
  const Energy& m_energy;
  Border_guard* m_guard;
  Stretched_star m_star;
  std::vector<Vertex_index> m_ring;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_VERTEX_INSERTION_H
