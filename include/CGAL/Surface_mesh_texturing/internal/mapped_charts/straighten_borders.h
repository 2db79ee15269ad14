// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHTEN_BORDERS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHTEN_BORDERS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/Straight_chains.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The cotangents of the angles of triangles in the plane, none smaller than a hundredth: as weights
// of the opposite edges they make a positive definite matrix.
inline std::vector<std::array<double, 3>>
edge_weights(const std::vector<Triangle_indices>& triangles, const std::vector<Point_2>& uv)
{
  constexpr double least = 0.01, most = 100.;
  std::vector<std::array<double, 3>> result;
  for(const Triangle_indices& t : triangles) {
    result.emplace_back();
    for(int c = 0; c < 3; ++c) { // of the edge from c to c + 1
      const auto p = uv[t[c]] - uv[t[(c + 2) % 3]], q = uv[t[(c + 1) % 3]] - uv[t[(c + 2) % 3]];
      const double area = p.x() * q.y() - p.y() * q.x();
      result.back()[c] = area > 0. ? std::clamp((p * q) / area, least, most) : most;
    }
  }
  return result;
}

// Moves one coordinate of some vertices to where they have to be, and the others along: how far is
// the harmonic function of the plane. Returns whether that could be solved. Complexity: that of a
// sparse Cholesky factorization.
inline bool move_coordinate(const std::vector<Triangle_indices>& triangles,
                            const std::vector<std::array<double, 3>>& weights,
                            const Fixed_coordinate& fixed, std::vector<double>& coordinate)
{
  constexpr double negligible = 1e-12; // of the extent, for which nobody has to make way
  const auto [least, most] = std::minmax_element(coordinate.begin(), coordinate.end());
  const double extent = *most - *least;
  double farthest = 0.;
  std::vector<std::size_t> row(coordinate.size());
  std::size_t n = 0;
  for(std::size_t v = 0; v < row.size(); ++v)
    if(fixed.is_fixed[v])
      farthest = (std::max)(farthest, std::abs(fixed.place[v] - coordinate[v]));
    else
      row[v] = n++;
  if(farthest > negligible * extent && n > 0) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(Eigen::Index(n)), move;
    for(std::size_t t = 0; t < triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        for(int end = 0; end < 2; ++end) {
          const std::size_t v = triangles[t][(c + end) % 3], w = triangles[t][(c + 1 - end) % 3];
          if(fixed.is_fixed[v])
            continue;
          const int i = int(row[v]);
          entries.emplace_back(i, i, weights[t][c]);
          if(fixed.is_fixed[w])
            right[i] += weights[t][c] * (fixed.place[w] - coordinate[w]);
          else
            entries.emplace_back(i, int(row[w]), -weights[t][c]);
        }
    Eigen::SparseMatrix<double> matrix{Eigen::Index(n), Eigen::Index(n)};
    matrix.setFromTriplets(entries.begin(), entries.end());
    Multigrid::Real_factorization factorization;
    if(!Multigrid::factorize_sparse(factorization, matrix))
      return false;
    Multigrid::solve_sparse(factorization, right, move);
    for(std::size_t v = 0; v < row.size(); ++v)
      if(!fixed.is_fixed[v])
        coordinate[v] += move[Eigen::Index(row[v])];
  }
  for(std::size_t v = 0; v < row.size(); ++v)
    if(fixed.is_fixed[v])
      coordinate[v] = fixed.place[v];
  return true;
}

// Where the vertices go when chains become straight; empty if that could not be solved.
inline std::vector<Point_2> with_straight_chains(const std::vector<Triangle_indices>& triangles,
                                                 const std::array<Fixed_coordinate, 2>& fixed,
                                                 const std::vector<Point_2>& uv)
{
  const auto weights = edge_weights(triangles, uv);
  std::array<std::vector<double>, 2> moved;
  for(int axis = 0; axis < 2; ++axis) {
    for(const Point_2& p : uv)
      moved[axis].push_back(p[axis]);
    if(!move_coordinate(triangles, weights, fixed[axis], moved[axis]))
      return {};
  }
  std::vector<Point_2> result;
  for(std::size_t v = 0; v < uv.size(); ++v)
    result.emplace_back(moved[0][v], moved[1][v]);
  return result;
}

// Gives a chart straight chains of border, if its map stays one-to-one, by exact predicates, and
// within the bound, or not beyond what it was. `uv` is the map, perhaps turned. Its area in the plane
// is kept. Returns whether it did so.
inline bool take_chains(const Chart_mapping& mapping, const std::vector<Border_edge>& border,
                        const std::vector<Straight_chain>& chains, std::vector<Point_2> uv,
                        Mapped_chart& map)
{
  if(chains.empty() || !mapping.has_time())
    return false;
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  const Chart_distortion& given = map.report.distortion;
  const Distortion_bound allowed
    = {(std::max)(mapping.bound.area_scale, given.area_scale),
       (std::max)(mapping.bound.quasi_conformal, given.quasi_conformal)};
  const double uv_area = measure_chart_distortion(mesh, uv).uv_area; // with its density
  uv = with_straight_chains(mesh.triangles, fixed_coordinates(chains, uv.size()), uv);
  if(uv.empty())
    return false;
  Chart_distortion distortion;
  if(!mend_map(mesh, border, allowed, uv, distortion))
    return false;
  const double scale = std::sqrt(uv_area / distortion.uv_area);
  for(Point_2& p : uv)
    p = Point_2(scale * p.x(), scale * p.y());
  distortion.uv_area = given.uv_area;
  map.uv = std::move(uv);
  map.report.distortion = distortion;
  return true;
}

// Lets a chart that is turned along the axes have straight borders. One with four sides becomes a
// rectangle; of others what is nearly straight becomes straight. If that is too much, only what is
// still more so.
inline void straighten_border(const Chart_mapping& mapping, Mapped_chart& map)
{
  const std::vector<Border_edge> border = map.chart.border_edges();
  std::vector<Point_2> turned = map.uv;
  const std::vector<Straight_chain> sides = sides_of_quad(border, turned);
  if(take_chains(mapping, border, sides, std::move(turned), map))
    return;
  for(const Chain_limits& limits : {Chain_limits{40., 0.03, 0.12}, Chain_limits{20., 0.015, 0.06},
                                    Chain_limits{10., 0.005, 0.01}})
    if(take_chains(mapping, border, straight_chains(border, map.uv, limits), map.uv, map))
      return;
}

inline void straighten_borders(const Chart_mapping& mapping, std::vector<Mapped_chart>& maps)
{
  Blocked_execution::blocked_for(maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      straighten_border(mapping, maps[i]);
  });
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHTEN_BORDERS_H
