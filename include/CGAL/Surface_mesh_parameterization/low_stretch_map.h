// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Low_stretch_solver.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMStretch
/// What `low_stretch_map()` returns.
struct Low_stretch_map
  : Indexed_mesh::Mesh_outcome
{
  /// The parameter of each vertex, in the unit of the points; empty if there is an error.
  std::vector<Simple_cartesian<double>::Point_2> uv;
  Low_stretch_report report; ///< how it went
};

namespace internal {

// Scales a mesh so that its units of length are those of the input up to a power of 2, by which the
// map can be multiplied without rounding, that is without turning a triangle over. Returns the
// exponent.
inline int scale_to_power_of_two(Chart& chart)
{
  int exponent;
  const double factor = 2. * std::frexp(1. / chart.scale, &exponent); // in [1, 2)
  for(auto& p : chart.mesh.points)
    p = Indexed_mesh::Indexed_triangle_mesh::Point_3(factor * p.x(), factor * p.y(), factor * p.z());
  return exponent - 1;
}

inline std::string options_error(const Low_stretch_options& options)
{
  if(!(options.tolerance > 0.))
    return "the tolerance must be greater than 0";
  if(!(options.time_limit >= 0.))
    return "the time limit must not be negative";
  return {};
}

// The pins as vertices of the chart and places in its unit; says in `status` what is wrong with them.
inline std::vector<Held_vertex> held_vertices(const std::vector<HLSCM_pin>& pins, const Chart& chart,
                                              std::size_t n, int exponent, Status& status)
{
  std::vector<Held_vertex> held;
  if(pins.empty())
    return held;
  const Pins here = pins_of_chart(chart, n, pins, status);
  check_each_pin(chart.source, here, status);
  for(const Pin& pin : here)
    held.push_back({pin.vertex, {std::ldexp(pin.value.real(), -exponent),
                                 std::ldexp(pin.value.imag(), -exponent)}});
  return held;
}

template <class Energy>
void map_chart(Prepared_chart prepared, std::size_t n, const Low_stretch_options& options,
               const Energy& energy, Low_stretch_map& result)
{
  using Indexed_mesh::Mesh_status;
  if(result.fail(Mesh_status::BAD_OPTIONS, options_error(options))
     || result.fail(Mesh_status::BAD_OPTIONS, prepared.chart.metric_error)
     || result.fail(Mesh_status::BAD_MESH, prepared.status.message))
    return;
  Chart& chart = prepared.chart;
  const int exponent = scale_to_power_of_two(chart);
  std::vector<Held_vertex> held = held_vertices(options.pins, chart, n, exponent, prepared.status);
  if(result.fail(Mesh_status::BAD_OPTIONS, prepared.status.message))
    return;
  Low_stretch_solver<Energy> solver(options, energy);
  const std::vector<Plane_point> places
    = solver.run(std::move(chart.mesh), std::move(chart.rings), std::move(held),
                 std::move(chart.metric));
  result.report = solver.report();
  result.report.area = std::ldexp(result.report.area, 2 * exponent);
  result.report.borders = chart.borders.size();
  if(places.empty()) {
    result.fail(Mesh_status::FAILED, solver.misses_pins()
      ? "no way was found to the places of the pins on which no triangle turns over"
      : "rounding leaves no place for a vertex of the map");
    return;
  }
  result.uv.assign(n, Simple_cartesian<double>::Point_2(0., 0.));
  for(std::size_t v = 0; v < places.size(); ++v)
    result.uv[chart.source[v]] = Simple_cartesian<double>::Point_2(
      std::ldexp(places[v].x, exponent), std::ldexp(places[v].y, exponent));
}

} // namespace internal

/*!
\ingroup PkgHLSCMStretch

Returns a map of a surface to the plane with little stretch and without a flipped or degenerate
triangle: a local minimum of the mean of an energy of stretch over the surface, with a free border.

Unlike a conformal map it keeps areas as well as angles, as far as both can be kept; by default
neither shrinks nor grows without need (the symmetric Dirichlet energy). Faces are never flipped,
whatever the surface: the mesh is collapsed to some forty vertices, which are mapped one-to-one, and
each vertex that comes back is put where it turns no triangle over, which is always possible. In
between, steps of Newton's method lower the energy of each level, shortened so that no triangle turns
over; their linear systems are solved by conjugate gradients with multigrid cycles. So around every
vertex the map is one-to-one. Parts of the surface that are far from each other may overlap in the
plane; see `certify_map()`.

\tparam Energy a model of `StretchEnergy`

\param mesh a connected surface of genus 0 with at least one border, in any unit of length
\param options when to stop
\param energy the energy

Bad data (indices out of range, coordinates that are not finite, closed or other surfaces) give a
result with `error` set and without parameters. `FAILED` says that the surface is stretched so much
that rounding leaves no place for a vertex, or that no way was found to bring the pins, which are kept
exactly, to their places without a triangle that turns over.

Expected linear time. The result does not depend on the number of threads.
*/
template <class Energy = Symmetric_dirichlet_energy>
Low_stretch_map low_stretch_map(Indexed_mesh::Indexed_triangle_mesh mesh,
                                const Low_stretch_options& options = Low_stretch_options(),
                                const Energy& energy = Energy())
{
  Low_stretch_map result;
  const std::size_t n = mesh.points.size();
  internal::map_chart(internal::chart_of_arrays(std::move(mesh), options.metric), n, options, energy,
                      result);
  return result;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_MAP_H
