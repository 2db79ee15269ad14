// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BAD_SURFACES_H
#define HLSCM_TEST_SUPPORT_BAD_SURFACES_H

// Surfaces of few triangles that are hard to make an atlas of: slivers, needles, hubs, dust.

#include <support/mesh_generators.h>

#include <cmath>
#include <string>
#include <vector>

namespace test_support {

// Appends the triangles of `b` as parts of their own.
inline void append(Indexed_triangle_mesh& a, const Indexed_triangle_mesh& b)
{
  const Vertex_index first = Vertex_index(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for(const Triangle_indices& t : b.triangles)
    a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

// A grid every `period`-th row of which is `distance` above the one before, not 1.
inline Indexed_triangle_mesh sliver_rows(Vertex_index side, Vertex_index period, double distance)
{
  Indexed_triangle_mesh mesh = grid(side, side);
  std::vector<double> y(side + 1, 0.);
  for(Vertex_index j = 1; j <= side; ++j)
    y[j] = y[j - 1] + (j % period == 0 ? distance : 1.);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x(), y[std::size_t(p.y())], 0.);
  return mesh;
}

// A grid that is `height` times as high as it is wide; 0: all vertices lie on one line.
inline Indexed_triangle_mesh flattened_grid(Vertex_index side, double height)
{
  Indexed_triangle_mesh mesh = grid(side, side);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x(), height * p.y(), 0.);
  return mesh;
}

// A fan around a hub, whose rim goes up and down: all the way round, or with a gap.
inline Indexed_triangle_mesh wavy_fan(Vertex_index degree, bool is_open)
{
  Indexed_triangle_mesh mesh = fan(degree);
  for(Vertex_index i = 1; i <= degree; ++i) {
    const Point_3 p = mesh.points[i];
    mesh.points[i] = Point_3(p.x(), p.y(), 0.1 * std::sin(50. * std::atan2(p.y(), p.x())));
  }
  if(is_open)
    mesh.triangles.pop_back();
  return mesh;
}

// Two hubs above and below a circle.
inline Indexed_triangle_mesh bipyramid(Vertex_index degree)
{
  Indexed_triangle_mesh mesh = fan(degree);
  mesh.points[0] = Point_3(0., 0., 1.);
  mesh.points.emplace_back(0., 0., -1.);
  for(Vertex_index i = 0; i < degree; ++i)
    mesh.triangles.push_back({degree + 1, (i + 1) % degree + 1, i + 1});
  return mesh;
}

// A straight strip of quads, `width` times as wide as these are long.
inline Indexed_triangle_mesh thin_strip(Vertex_index quads, double width)
{
  Indexed_triangle_mesh mesh = grid(quads, 1);
  for(Point_3& p : mesh.points)
    p = Point_3(p.x(), width * p.y(), 0.);
  return mesh;
}

// Tetrahedra, the edges of which are from 1e-6 to 1e2 long.
inline Indexed_triangle_mesh tetrahedra_of_all_sizes(std::size_t number, std::uint64_t seed)
{
  Random random(seed);
  Indexed_triangle_mesh mesh;
  for(std::size_t i = 0; i < number; ++i) {
    Indexed_triangle_mesh part;
    part.points = {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1)};
    part.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    part = scaled(part, std::pow(10., uniform(random, -6., 2.)));
    append(mesh, translated(part, uniform(random, 0., 1e3), uniform(random, 0., 1e3), 0.));
  }
  return mesh;
}

// Triangles without any neighbours.
inline Indexed_triangle_mesh single_triangles(std::size_t number, std::uint64_t seed)
{
  Random random(seed);
  Indexed_triangle_mesh mesh;
  for(std::size_t i = 0; i < number; ++i) {
    for(int c = 0; c < 3; ++c)
      mesh.points.emplace_back(uniform(random, 0., 1.) + 2. * double(i % 100),
                               uniform(random, 0., 1.) + 2. * double(i / 100),
                               uniform(random, 0., 1.));
    const Vertex_index v = Vertex_index(3 * i);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return mesh;
}

// All of these, with about `size` triangles; those that are bad enough with few have fewer.
inline std::vector<Named_mesh> bad_surfaces(std::size_t size, std::uint64_t seed)
{
  const Vertex_index n = Vertex_index(size), side = Vertex_index(std::sqrt(double(size) / 28.));
  return {{"sliver rows", sliver_rows(side, 10, 1e-13)},
          {"needles", flattened_grid(side, 1e-12)},
          {"narrow grid", flattened_grid(side / 2, 1e-8)},
          {"collinear grid", flattened_grid(side / 2, 0.)},
          {"hub", wavy_fan(n / 2, false)},
          {"open fan", wavy_fan(n / 2, true)},
          {"bipyramid", bipyramid(n / 2)},
          {"thin strip", thin_strip(n / 2, 1e-3)},
          {"tetrahedra", tetrahedra_of_all_sizes(n / 50, seed)},
          {"single triangles", single_triangles(n / 20, seed)}};
}

} // namespace test_support

#endif
