// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_TURNS_OF_BORDER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_TURNS_OF_BORDER_H

#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The edges of the faces of a patch that have no opposite among them, by their first vertices; with
// the number of edges. Empty if two begin at one vertex.
inline std::vector<std::array<std::uint32_t, 2>>
border_of_patch(const Vertex_patch& patch,
                const std::vector<Indexed_mesh::Triangle_indices>& triangles)
{
  typedef std::array<std::uint32_t, 2> Edge;
  std::vector<Edge> edges, border;
  for(const std::uint32_t t : patch.faces)
    for(int c = 0; c < 3; ++c)
      edges.push_back({triangles[t][c], triangles[t][(c + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  for(const Edge& e : edges)
    if(!std::binary_search(edges.begin(), edges.end(), Edge{e[1], e[0]}))
      border.push_back(e);
  const auto begin_alike = [](const Edge& a, const Edge& b) { return a[0] == b[0]; };
  if(std::adjacent_find(border.begin(), border.end(), begin_alike) != border.end())
    border.clear();
  return border;
}

// How often the image of the border of a patch turns around, counterclockwise. Nothing if the patch
// is no disk, if its border has vertices that may move, or turns by nearly a half turn at once.
//
// For a map without flips the exterior angles of the border have the sum 2 pi (1 + b), b the number
// of times that faces wind around vertices more than once, whatever the values inside are.
inline std::optional<long>
turns_of_border(const Vertex_patch& patch,
                const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                const std::vector<std::complex<double>>& z)
{
  typedef std::array<std::uint32_t, 2> Edge;
  const std::vector<Edge> border = border_of_patch(patch, triangles);
  if(border.empty())
    return std::nullopt;
  const auto moves = [&patch](const Edge& e) {
    return std::binary_search(patch.vertices.begin(), patch.vertices.end(), e[0]);
  };
  // Vertices less edges plus faces is 1: of the vertices, those that do not move are on the border
  const long faces = long(patch.faces.size()), edges = (3 * faces + long(border.size())) / 2;
  if(long(patch.vertices.size() + border.size()) - edges + faces != 1
     || std::any_of(border.begin(), border.end(), moves))
    return std::nullopt;
  const auto next_of = [&border](const Edge& e) {
    return *std::lower_bound(border.begin(), border.end(), Edge{e[1], 0});
  };
  constexpr double largest_turn = CGAL_PI - 1e-6;
  double sum = 0.;
  Edge e = border.front();
  for(std::size_t i = 0; i < border.size(); ++i) {
    const Edge next = next_of(e);
    const double turn = std::arg((z[next[1]] - z[next[0]]) * std::conj(z[e[1]] - z[e[0]]));
    if(!(std::abs(turn) < largest_turn) || (next == border.front() && i + 1 < border.size()))
      return std::nullopt;
    sum += turn;
    e = next;
  }
  return std::lround(sum / (2. * CGAL_PI));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_TURNS_OF_BORDER_H
