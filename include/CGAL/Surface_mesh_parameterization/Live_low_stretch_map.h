// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LIVE_LOW_STRETCH_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LIVE_LOW_STRETCH_MAP_H

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

The class `Live_low_stretch_map` keeps a map of `low_stretch_map()` up to date while its pins are
dragged. The hierarchy is built once, and every solution begins with the map before: nothing that is
between the two has a flipped face, and the pins are where they are wanted, exactly.

\tparam Energy a model of `StretchEnergy`
\tparam ConcurrencyTag as of `low_stretch_map()`

\sa `Hierarchical_conformal_map`, which does the same for conformal maps
*/
template <class Energy = Symmetric_dirichlet_energy, class ConcurrencyTag = Default>
class Live_low_stretch_map
{
public:
  typedef Indexed_mesh::Indexed_triangle_mesh Mesh;   ///< the mesh
  typedef Simple_cartesian<double>::Point_2 Point_2; ///< a parameter (u, v)

  /// Builds the hierarchy and the first map, with the pins of `options`. What can be wrong is what can
  /// be with `low_stretch_map()`; then there will be no map.
  explicit Live_low_stretch_map(Mesh mesh, const Low_stretch_options& options = Low_stretch_options(),
                                const Energy& energy = Energy())
    : m_chart(mesh.points.size(), options, energy), m_threads(options.threads)
  {
    const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(m_threads);
    for(const HLSCM_pin& pin : options.pins)
      m_pins[pin.vertex] = Point_2(pin.u, pin.v);
    const auto faces = internal::faces_if_asked_for(mesh, options);
    m_map = m_chart.map(internal::chart_of_arrays(std::move(mesh), options.metric), faces);
    m_outcome = m_map;
  }

  /// Returns what became of the last solution, the first or that of `solve()`, and why.
  const Indexed_mesh::Mesh_outcome& outcome() const { return m_outcome; }

  /// Returns the report of the last map that there is.
  const Low_stretch_report& report() const { return m_map.report; }

  /// Pins vertex `v` at `p`, or moves it there if it is pinned already; takes effect with the next
  /// `solve()`. Pins that the map began with are in all levels; others cost some iterations.
  void set_pin(std::size_t v, const Point_2& p) { m_pins[v] = p; }

  /// Lets `v` go with the next `solve()`; returns whether it was pinned.
  bool release_pin(std::size_t v) { return m_pins.erase(v) > 0; }

  /// Returns the number of pins.
  std::size_t number_of_pins() const { return m_pins.size(); }

  /// Brings the map up to date. Returns whether that succeeded: if no way is found to the pins, or one
  /// of them makes no sense, the map stays what it was, and `outcome()` says why.
  bool solve()
  {
    if(!has_map())
      return false;
    const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(m_threads);
    std::vector<HLSCM_pin> pins;
    for(const auto& [v, p] : m_pins)
      pins.push_back({v, p.x(), p.y()});
    Low_stretch_map map = m_chart.map_again(pins);
    m_outcome = map;
    if(map.is_ok())
      m_map = std::move(map);
    return m_outcome.is_ok();
  }

  /// Returns whether there is a map.
  bool has_map() const { return !m_map.uv.empty(); }

  /// Returns the parameter of each vertex; (0, 0) of those without a face.
  const std::vector<Point_2>& uv() const { return m_map.uv; }

private:
  internal::Stretched_chart<Energy> m_chart;
  std::map<std::size_t, Point_2> m_pins;
  Low_stretch_map m_map;
  Indexed_mesh::Mesh_outcome m_outcome;
  unsigned int m_threads;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LIVE_LOW_STRETCH_MAP_H
