// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_LOW_STRETCH_CHECKS_H
#define HLSCM_TEST_SUPPORT_LOW_STRETCH_CHECKS_H

// What is promised of low-stretch maps, as functions that return what is wrong.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace test_support {

using namespace CGAL::Surface_mesh_parameterization;

typedef std::vector<CGAL::Simple_cartesian<double>::Point_2> Uv;

// Exactly: every triangle is counterclockwise.
inline std::string error_in_orientation(const Indexed_triangle_mesh& mesh, const Uv& uv)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point;
  const auto point = [&uv](Vertex_index v) { return Point(uv[v].x(), uv[v].y()); };
  if(uv.size() != mesh.points.size())
    return "the map has " + std::to_string(uv.size()) + " parameters";
  for(const auto& p : uv)
    if(!std::isfinite(p.x()) || !std::isfinite(p.y()))
      return "a parameter is not a finite number";
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    if(CGAL::orientation(point(v[0]), point(v[1]), point(v[2])) != CGAL::LEFT_TURN)
      return "triangle " + std::to_string(t) + " is flipped or degenerate";
  }
  return {};
}

// The triangles at a vertex inside go around it once.
inline std::string error_in_turns(const Indexed_triangle_mesh& mesh, const Uv& uv)
{
  std::vector<double> angle(uv.size(), 0.);
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      const auto a = uv[t[(c + 1) % 3]] - uv[t[c]], b = uv[t[(c + 2) % 3]] - uv[t[c]];
      angle[t[c]] += std::atan2(a.x() * b.y() - a.y() * b.x(), a * b);
    }
  const std::vector<bool> is_border = border_vertices_of(mesh);
  for(std::size_t v = 0; v < uv.size(); ++v)
    if(!is_border[v] && std::abs(angle[v] - 2. * CGAL_PI) > 1e-3)
      return "the triangles at vertex " + std::to_string(v) + " turn by " + std::to_string(angle[v]);
  return {};
}

template <class Energy>
double energy_of(const Indexed_triangle_mesh& mesh, const Uv& uv, const Energy& energy)
{
  double sum = 0., area = 0.;
  for(const Triangle_indices& t : mesh.triangles) {
    const auto reference = Reference_triangle<double>::of_points(mesh.points[t[0]], mesh.points[t[1]],
                                                                 mesh.points[t[2]]);
    const auto place = [&](int c) { return Plane_vector<double>{uv[t[c]].x(), uv[t[c]].y()}; };
    const Plane_jacobian<double> j(reference, {place(0), place(1), place(2)});
    sum += reference.area() * energy.value(j.squared_norm(), j.determinant());
    area += reference.area();
  }
  return sum / area;
}

// All that is promised of any result.
template <class Energy>
std::string error_in_map(const Indexed_triangle_mesh& mesh, const Low_stretch_map& map,
                         const Energy& energy)
{
  if(!map.is_ok())
    return map.error;
  std::string error = error_in_orientation(mesh, map.uv);
  if(error.empty())
    error = error_in_turns(mesh, map.uv);
  if(error.empty() && !(std::abs(energy_of(mesh, map.uv, energy) / map.report.energy - 1.) < 1e-6))
    error = "the energy is not that of the report";
  return error;
}

inline std::string error_in_map(const Indexed_triangle_mesh& mesh, const Low_stretch_map& map)
{
  return error_in_map(mesh, map, Symmetric_dirichlet_energy());
}

// By how much a map changes the lengths of edges, as a part of the mean length.
inline double largest_change_of_length(const Indexed_triangle_mesh& mesh, const Uv& uv)
{
  double largest = 0., sum = 0.;
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = t[c], w = t[(c + 1) % 3];
      const double length = std::sqrt(squared_distance(mesh.points[v], mesh.points[w]));
      largest = std::max(largest, std::abs(std::sqrt(squared_distance(uv[v], uv[w])) - length));
      sum += length;
    }
  return largest * 3. * double(mesh.triangles.size()) / sum;
}

inline std::vector<Named_mesh> low_stretch_charts(std::uint64_t seed)
{
  return {{"hills", with_hills(irregular_grid(30, 25, seed), 8., seed)},
          {"noisy hills", with_noise(with_hills(irregular_grid(26, 21, seed), 6., seed), 0.3, seed)},
          {"dome", on_sphere(round_disk(18), 2.2)},
          {"sphere with holes", with_holes(sphere(3), 5, seed)}};
}

// What is wrong with pins: that they are not kept, exactly.
inline std::string error_in_pins(const std::vector<HLSCM_pin>& pins, const Uv& uv)
{
  for(const auto& pin : pins)
    if(uv[pin.vertex] != Uv::value_type(pin.u, pin.v))
      return "vertex " + std::to_string(pin.vertex) + " is not where it is pinned";
  return {};
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_LOW_STRETCH_CHECKS_H
