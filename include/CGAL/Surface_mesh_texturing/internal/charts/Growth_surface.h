// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Halfedge_triangles.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A mesh with what the growth of charts asks it again and again.
struct Growth_surface
{
  typedef Indexed_triangle_mesh::Point_3 Point;

  Indexed_triangle_mesh mesh;        // in a unit and at a place of its own
  double scale = 1.;                 // its lengths to those of the input
  Halfedge_triangles adjacency;
  std::vector<double> length;        // of each halfedge
  std::vector<double> angle;         // across each halfedge between the normals, 0 on the border
  std::vector<double> area;          // of each triangle
  std::vector<Point> centre;         // of each triangle
  std::vector<double> defect;        // of each vertex 2 pi less its angles, 0 on the border
  std::vector<std::uint32_t> component;
  std::size_t number_of_components = 0;

  explicit Growth_surface(const Indexed_triangle_mesh& input);

  std::size_t size() const { return mesh.triangles.size(); }
};

// Takes the mesh to unit edge length and rounds its coordinates, so that the same surface in
// another unit or at another place gives the same charts although it differs in the last bits.
inline double round_to_unit(Indexed_triangle_mesh& mesh)
{
  const double scale = Indexed_mesh::normalize(mesh);
  constexpr double cells = 1 << 28;    // of unit length
  constexpr double offset = 0.2360679; // coordinates that are simple fractions are no ties
  const auto round = [](double x) { return std::floor(x * cells + offset) / cells; };
  for(auto& p : mesh.points)
    p = Growth_surface::Point(round(p.x()), round(p.y()), round(p.z()));
  return scale;
}

inline Growth_surface::Growth_surface(const Indexed_triangle_mesh& input)
  : mesh(input), scale(round_to_unit(mesh)), adjacency(mesh.triangles, mesh.points.size())
  , length(3 * size()), angle(3 * size(), 0.), area(size()), centre(size())
  , defect(mesh.points.size(), 2. * CGAL_PI)
{
  std::vector<Simple_cartesian<double>::Vector_3> normal(size());
  for(std::uint32_t t = 0; t < size(); ++t) {
    const Point &p = mesh.points[mesh.triangles[t][0]], &q = mesh.points[mesh.triangles[t][1]],
                &r = mesh.points[mesh.triangles[t][2]];
    normal[t] = cross_product(q - p, r - p);
    area[t] = 0.5 * std::sqrt(normal[t] * normal[t]);
    centre[t] = centroid(p, q, r);
    for(std::uint32_t c = 0; c < 3; ++c) {
      const Point &u = mesh.points[mesh.triangles[t][c]],
                  &v = mesh.points[mesh.triangles[t][(c + 1) % 3]],
                  &w = mesh.points[mesh.triangles[t][(c + 2) % 3]];
      length[3 * t + c] = std::sqrt(squared_distance(u, v));
      defect[mesh.triangles[t][c]] -= std::atan2(2. * area[t], (v - u) * (w - u));
    }
  }
  for(std::uint32_t h = 0; h < angle.size(); ++h) {
    const Halfedge g = adjacency.opposite(h);
    if(g == no_halfedge) {
      defect[adjacency.source(h)] = 0.;
      continue;
    }
    const auto &m = normal[triangle_of(h)], &n = normal[triangle_of(g)];
    const auto x = cross_product(m, n);
    angle[h] = std::atan2(std::sqrt(x * x), m * n);
  }
  const Face_charts components
    = label_charts(adjacency, std::vector<std::uint8_t>(size(), 0));
  component = components.chart;
  number_of_components = components.number_of_charts;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_GROWTH_SURFACE_H
