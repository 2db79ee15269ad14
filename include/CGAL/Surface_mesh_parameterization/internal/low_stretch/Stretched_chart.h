// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCHED_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCHED_CHART_H

#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Low_stretch_solver.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

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

// Makes a chart that of the surface with another area; returns the factor of areas.
inline double scale_to_area(Chart& chart, double area)
{
  double here = 0.;
  for(const Triangle_indices& t : chart.mesh.triangles)
    here += Reference_triangle<double>::of_points(chart.mesh.points[t[0]], chart.mesh.points[t[1]],
                                                  chart.mesh.points[t[2]]).area();
  if(!(area > 0.) || !(here > 0.))
    return 1.;
  const double before = chart.scale;
  chart.scale = std::sqrt(here / area); // lengths here to those of the other
  return before / chart.scale * (before / chart.scale);
}

inline std::string options_error(const Low_stretch_options& options)
{
  if(!(options.tolerance > 0.))
    return "the tolerance must be greater than 0";
  if(!(options.time_limit >= 0.))
    return "the time limit must not be negative";
  return {};
}

inline bool speaks_of_faces(const Low_stretch_options& options)
{
  return !options.start.empty() || !options.face_weights.empty();
}

// A copy of the faces, if options speak of them.
inline std::vector<Triangle_indices>
faces_if_asked_for(const Indexed_mesh::Indexed_triangle_mesh& mesh, const Low_stretch_options& options)
{
  return speaks_of_faces(options) ? mesh.triangles : std::vector<Triangle_indices>();
}

// A chart of a mesh of `n` vertices, and its low-stretch maps: from the numbers and units of the mesh
// to those of the solver, and back.
template <class Energy>
class Stretched_chart
{
public:
  typedef std::vector<Triangle_indices> Triangles;

  Stretched_chart(std::size_t n, const Low_stretch_options& options, const Energy& energy)
    : m_n(n), m_options(options), m_energy(energy), m_solver(m_options, m_energy)
  {}
  Stretched_chart(const Stretched_chart&) = delete;
  Stretched_chart& operator=(const Stretched_chart&) = delete;

  // `faces` are all those of the mesh in its own order and numbers; they may be missing if no option
  // speaks of faces or of a start.
  Low_stretch_map map(Prepared_chart prepared, const Triangles& faces);

  // After that, if there was a map: the same with other pins, beginning with the last map.
  Low_stretch_map map_again(const std::vector<HLSCM_pin>& pins);

private:
  typedef Indexed_mesh::Mesh_status Mesh_status;

  // Says what is wrong with the pins; those of the chart, in its unit, otherwise.
  std::vector<Held_vertex> held_vertices(const std::vector<HLSCM_pin>& wanted, Low_stretch_map& result);
  std::string pinned_face_error(const Triangles& triangles, const std::vector<Held_vertex>& held) const;
  std::string held_border_error(const std::vector<Held_vertex>& held) const;
  std::vector<Plane_point> start(const Triangles& faces, Low_stretch_map& result) const;
  std::vector<double> face_weights(const Triangles& faces, Low_stretch_map& result) const;
  void finish(std::vector<Plane_point> places, Low_stretch_map& result);

  std::size_t m_n;
  const Low_stretch_options m_options;
  const Energy m_energy;
  Low_stretch_solver<Energy> m_solver;
  Chart m_chart; // without mesh and rings, once the solver has them
  int m_exponent = 0;
  std::vector<Plane_point> m_places; // of the last map
};

template <class Energy>
Low_stretch_map Stretched_chart<Energy>::map(Prepared_chart prepared, const Triangles& faces)
{
  Low_stretch_map result;
  if(result.fail(Mesh_status::BAD_OPTIONS, options_error(m_options))
     || result.fail(prepared.has_bad_metric ? Mesh_status::BAD_OPTIONS : Mesh_status::BAD_MESH,
                    prepared.status.message))
    return result;
  m_chart = std::move(prepared.chart);
  m_exponent = scale_to_power_of_two(m_chart);
  Stretch_task task;
  task.held = held_vertices(m_options.pins, result);
  result.fail(Mesh_status::FAILED, held_border_error(task.held));
  result.fail(Mesh_status::FAILED, pinned_face_error(m_chart.mesh.triangles, task.held));
  task.start = start(faces, result);
  task.face_weights = face_weights(faces, result);
  task.metric = std::move(m_chart.metric);
  if(m_options.is_one_to_one)
    task.borders = m_chart.borders;
  if(!task.borders.empty() && !task.start.empty() && !are_apart(task.borders, task.start))
    result.fail(Mesh_status::BAD_OPTIONS, "the map to start from is not one-to-one: its border crosses "
                "itself");
  if(!result.is_ok())
    return result;
  finish(m_solver.run(std::move(m_chart.mesh), std::move(m_chart.rings), std::move(task)), result);
  return result;
}

template <class Energy>
Low_stretch_map Stretched_chart<Energy>::map_again(const std::vector<HLSCM_pin>& pins)
{
  Low_stretch_map result;
  std::vector<Held_vertex> held = held_vertices(pins, result);
  result.fail(Mesh_status::FAILED, pinned_face_error(m_solver.triangles(), held));
  if(result.is_ok())
    finish(m_solver.run_again(m_places, std::move(held)), result);
  return result;
}

template <class Energy>
void Stretched_chart<Energy>::finish(std::vector<Plane_point> places, Low_stretch_map& result)
{
  result.report = m_solver.report();
  result.report.area = std::ldexp(result.report.area, 2 * m_exponent);
  result.report.borders = m_chart.borders.size();
  if(places.empty()) {
    const bool is_too_late = m_solver.misses_pins() && m_solver.report().is_cut_short;
    result.fail(Mesh_status::FAILED, is_too_late
      ? "the pins were not at their places yet when the time was over or the progress said stop"
      : m_solver.misses_pins()
      ? std::string("no way was found to the places of the pins on which no triangle turns over")
          + (m_options.is_one_to_one ? " and no border meets another or itself" : "")
      : "rounding leaves no place for a vertex of the map");
    return;
  }
  m_places = std::move(places);
  result.uv.assign(m_n, Simple_cartesian<double>::Point_2(0., 0.));
  for(std::size_t v = 0; v < m_places.size(); ++v)
    result.uv[m_chart.source[v]] = Simple_cartesian<double>::Point_2(
      std::ldexp(m_places[v].x, m_exponent), std::ldexp(m_places[v].y, m_exponent));
}

template <class Energy>
std::vector<Held_vertex>
Stretched_chart<Energy>::held_vertices(const std::vector<HLSCM_pin>& wanted, Low_stretch_map& result)
{
  std::vector<Held_vertex> held;
  if(wanted.empty())
    return held;
  Status status;
  const Pins pins = pins_of_chart(m_chart, m_n, wanted, status);
  check_each_pin(m_chart.source, pins, status);
  if(!result.fail(Mesh_status::BAD_OPTIONS, status.message))
    for(const Pin& pin : pins)
      held.push_back({pin.vertex, {std::ldexp(pin.value.real(), -m_exponent),
                                   std::ldexp(pin.value.imag(), -m_exponent)}});
  return held;
}

// Which face, the first of several, has three pins that turn it over.
template <class Energy>
std::string
Stretched_chart<Energy>::pinned_face_error(const Triangles& triangles,
                                           const std::vector<Held_vertex>& held) const
{
  if(held.size() < 3)
    return {};
  std::vector<Plane_point> place(m_chart.source.size());
  std::vector<bool> is_held(place.size(), false);
  for(const Held_vertex& h : held) {
    place[h.vertex] = h.place;
    is_held[h.vertex] = true;
  }
  for(const Triangle_indices& t : triangles)
    if(is_held[t[0]] && is_held[t[1]] && is_held[t[2]]
       && !is_surely_positive(place[t[0]], place[t[1]], place[t[2]], 2.)) {
      const auto name = [&](int c) { return std::to_string(m_chart.source[t[c]]); };
      return "the face of the vertices " + name(0) + ", " + name(1) + " and " + name(2)
           + ", which are pinned, turns over or has no area there";
    }
  return {};
}

// What no map can have where all borders are held: they run around its area, counted as often as it is
// covered, so that theirs must be positive.
template <class Energy>
std::string
Stretched_chart<Energy>::held_border_error(const std::vector<Held_vertex>& held) const
{
  std::vector<Plane_point> place(held.empty() ? 0 : m_chart.source.size());
  std::vector<bool> is_held(place.size(), false);
  for(const Held_vertex& h : held) {
    place[h.vertex] = h.place - held[0].place;
    is_held[h.vertex] = true;
  }
  double twice_area = 0.;
  for(const auto& border : m_chart.borders)
    for(std::size_t i = 0; i < border.size(); ++i) {
      const Vertex_index v = border[i], w = border[(i + 1) % border.size()];
      if(held.empty() || !is_held[v])
        return {};
      twice_area += place[v].cross(place[w]);
    }
  return twice_area > 0. ? std::string()
       : "the border has no area where it is pinned, or runs the wrong way round: no map is without "
         "a triangle that turns over";
}

// The start in the unit of the chart.
template <class Energy>
std::vector<Plane_point>
Stretched_chart<Energy>::start(const Triangles& faces, Low_stretch_map& result) const
{
  std::vector<Plane_point> places;
  const auto& uv = m_options.start;
  if(uv.empty() || !result.is_ok())
    return places;
  if(uv.size() != m_n) {
    result.fail(Mesh_status::BAD_OPTIONS, "the start has " + std::to_string(uv.size())
                + " parameters, not one for each of the " + std::to_string(m_n) + " vertices");
    return places;
  }
  const auto rank = Indexed_mesh::ranks(m_chart.source, m_n);
  for(std::size_t f = 0; f < faces.size(); ++f) {
    const Triangle_indices& t = faces[f];
    const auto point = [&](int c) { return Uv_point(uv[t[c]].x(), uv[t[c]].y()); };
    const bool is_here = rank[t[0]] != Indexed_mesh::no_vertex; // faces of other components do not count
    if(is_here && orientation_of({point(0), point(1), point(2)}) != LEFT_TURN) {
      result.fail(Mesh_status::BAD_OPTIONS, "face " + std::to_string(f)
                  + " is flipped or degenerate in the map to start from");
      return places;
    }
  }
  for(const std::uint32_t v : m_chart.source)
    places.push_back({std::ldexp(uv[v].x(), -m_exponent), std::ldexp(uv[v].y(), -m_exponent)});
  for(const Triangle_indices& t : m_chart.mesh.triangles)
    if(!is_surely_positive(places[t[0]], places[t[1]], places[t[2]], 2.)) {
      result.fail(Mesh_status::BAD_OPTIONS, "the face of the vertices "
                  + std::to_string(m_chart.source[t[0]]) + ", " + std::to_string(m_chart.source[t[1]])
                  + " and " + std::to_string(m_chart.source[t[2]])
                  + " has an area that rounding may have made in the map to start from");
      return places;
    }
  const std::size_t branch = first_branch_point(m_chart.mesh.triangles, m_chart.rings, places);
  if(branch < places.size())
    result.fail(Mesh_status::BAD_OPTIONS, "the faces of vertex " + std::to_string(m_chart.source[branch])
                + " go around it more than once in the map to start from");
  return places;
}

// The weights of the triangles of the chart over their mean.
template <class Energy>
std::vector<double>
Stretched_chart<Energy>::face_weights(const Triangles& faces, Low_stretch_map& result) const
{
  std::vector<double> weights;
  const std::vector<double>& wanted = m_options.face_weights;
  if(wanted.empty() || !result.is_ok())
    return weights;
  if(wanted.size() != faces.size()) {
    result.fail(Mesh_status::BAD_OPTIONS, "there are " + std::to_string(wanted.size())
                + " weights for " + std::to_string(faces.size()) + " faces");
    return weights;
  }
  for(std::size_t f = 0; f < wanted.size(); ++f)
    if(!(wanted[f] > 0.) || !std::isfinite(wanted[f])) {
      result.fail(Mesh_status::BAD_OPTIONS, "the weight of face " + std::to_string(f)
                  + " is not a positive number");
      return weights;
    }
  for(const auto f : numbers_in_input(faces, m_n, m_chart.mesh.triangles, m_chart.source))
    weights.push_back(wanted[f]);
  double weighted = 0., area = 0.;
  for(std::size_t t = 0; t < weights.size(); ++t) {
    const Triangle_indices& v = m_chart.mesh.triangles[t];
    const auto& p = m_chart.mesh.points;
    const double a = Reference_triangle<double>::of_points(p[v[0]], p[v[1]], p[v[2]]).area();
    weighted += a * weights[t];
    area += a;
  }
  for(double& w : weights)
    w *= area / weighted;
  return weights;
}

#ifdef CGAL_HLSCM_COMPILED
#ifdef CGAL_HLSCM_SOURCE
template class Stretched_chart<Symmetric_dirichlet_energy>;
template class Stretched_chart<Mips_energy>;
template class Stretched_chart<Area_weighted_mips_energy>;
template class Stretched_chart<Barrier_energy<Arap_energy>>;
#else
extern template class Stretched_chart<Symmetric_dirichlet_energy>;
extern template class Stretched_chart<Mips_energy>;
extern template class Stretched_chart<Area_weighted_mips_energy>;
extern template class Stretched_chart<Barrier_energy<Arap_energy>>;
#endif
#endif

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCHED_CHART_H
