// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_TEXTURED_MESHES_H
#define HLSCM_TEST_SUPPORT_TEXTURED_MESHES_H

// Meshes with texture coordinates and seams of all kinds.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh;
typedef Textured_triangle_mesh::Point_2 Point_2;

struct Named_textured_mesh
{
  std::string name;
  Textured_triangle_mesh mesh;
};

// One texture coordinate a corner: whether neighbours share them is for the library to find out.
inline Textured_triangle_mesh
textured(const Indexed_triangle_mesh& mesh,
         const std::function<Point_2(std::size_t triangle, Vertex_index v)>& uv)
{
  Textured_triangle_mesh result;
  result.points = mesh.points;
  result.triangles = mesh.triangles;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle_indices wedges;
    for(int c = 0; c < 3; ++c) {
      wedges[c] = Vertex_index(result.uv.size());
      result.uv.push_back(uv(t, mesh.triangles[t][c]));
    }
    result.wedges.push_back(wedges);
  }
  return result;
}

// Without seams: the projection along z.
inline Textured_triangle_mesh seen_from_above(const Indexed_triangle_mesh& mesh)
{
  return textured(mesh, [&](std::size_t, Vertex_index v) {
    return Point_2(mesh.points[v].x(), mesh.points[v].y());
  });
}

// One chart for each side of a cube onto which triangles are projected along the longest axis of
// their normal.
inline Textured_triangle_mesh cube_mapped(const Indexed_triangle_mesh& mesh)
{
  return textured(mesh, [&](std::size_t t, Vertex_index v) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto n = cross_product(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    int axis = 0;
    for(int k = 1; k < 3; ++k)
      if(std::abs(n[k]) > std::abs(n[axis]))
        axis = k;
    const bool is_back = n[axis] < 0.;
    const Point_3& p = mesh.points[v];
    const double x = p[(axis + 1) % 3], y = p[(axis + 2) % 3];
    return Point_2((is_back ? -x : x) + 10. * axis, y + (is_back ? 10. : 0.));
  });
}

// The torus of torus(major, minor) cut into rectangles of its angles.
inline Textured_triangle_mesh cut_torus(Vertex_index major, Vertex_index minor,
                                        Vertex_index columns, Vertex_index rows)
{
  const Indexed_triangle_mesh mesh = torus(major, minor);
  return textured(mesh, [=](std::size_t t, Vertex_index v) {
    const Vertex_index i = Vertex_index(t / 2) / minor, j = Vertex_index(t / 2) % minor;
    Vertex_index x = v / minor, y = v % minor; // of the corner, not yet beyond the last square
    if(x < i)
      x += major;
    if(y < j)
      y += minor;
    const double column = double(i * columns / major), row = double(j * rows / minor);
    return Point_2(double(x) + 3. * column, double(y) + 3. * row);
  });
}

// The grid of grid(size, size) with a slit from the middle to the right whose sides move apart.
inline Textured_triangle_mesh with_slit(Vertex_index size)
{
  const Indexed_triangle_mesh mesh = with_hills(grid(size, size), 1., 7);
  return textured(mesh, [&mesh, size](std::size_t t, Vertex_index v) {
    const double x = mesh.points[v].x(), y = mesh.points[v].y(), middle = double(size / 2);
    const bool is_above = t / (2 * size) >= size / 2;
    const double gap = x > middle ? 0.1 * (x - middle) : 0.;
    return Point_2(x, y + (is_above ? gap : 0.));
  });
}

// Surfaces with one chart and with many, closed and with borders, with seams that end and meet.
inline std::vector<Named_textured_mesh> textured_meshes(std::uint64_t seed)
{
  const Indexed_triangle_mesh hills = with_hills(irregular_grid(18, 14, seed), 2., seed + 1);
  const Indexed_triangle_mesh ball = with_noise(sphere(4), 0.01, seed + 2);
  return {
    {"hills", seen_from_above(hills)},
    {"hills with holes", seen_from_above(with_holes(hills, 5, seed + 3))},
    {"mirrored hills", textured(hills, [&](std::size_t, Vertex_index v) {
       return Point_2(-hills.points[v].x(), hills.points[v].y());
     })},
    {"ball in a cube", cube_mapped(ball)},
    {"ball with holes in a cube", cube_mapped(with_holes(ball, 4, seed + 4))},
    {"torus in rectangles", cut_torus(36, 18, 4, 3)},
    {"torus in rings", cut_torus(36, 18, 3, 1)},
    {"torus in one chart", cut_torus(30, 15, 1, 1)},
    {"slit", with_slit(24)},
    {"two halves", textured(hills, [&](std::size_t t, Vertex_index v) {
       return Point_2(hills.points[v].x() + (t % 36 < 18 ? 0. : 5.), hills.points[v].y());
     })},
    {"charts of single triangles", textured(grid(3, 3), [](std::size_t t, Vertex_index v) {
       return Point_2(double(v % 4) + 9. * double(t), double(v / 4));
     })},
  };
}

} // namespace test_support

#endif
