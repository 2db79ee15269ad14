// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_PROGRESSIVE_MODELS_H
#define HLSCM_TEST_SUPPORT_PROGRESSIVE_MODELS_H

// Progressive meshes of random collapses; textured ones, with and without seams.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <algorithm>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_multiresolution::Progressive_mesh;
using CGAL::Surface_mesh_multiresolution::Textured_progressive_mesh;
using CGAL::Indexed_mesh::Vertex_rings;

// Random halfedge collapses as long as topology allows any; geometry is ignored.
inline Progressive_mesh random_collapses(const Indexed_triangle_mesh& mesh,
                                         std::size_t target_vertices, std::uint64_t seed)
{
  Random random(seed);
  Vertex_rings rings(mesh);
  Progressive_mesh pm
    = CGAL::Surface_mesh_multiresolution::trivial_progressive_mesh(mesh.points.size());
  pm.triangles = mesh.triangles;
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(std::size_t trial = 0; trial < 30 * mesh.points.size(); ++trial) {
    if(pm.number_of_vertices_after(pm.collapses.size()) <= target_vertices)
      break;
    const auto v = Vertex_index(uniform_index(random, mesh.points.size()));
    const auto k = std::uint32_t(uniform_index(random, rings.degree(v)));
    if(is_gone[v] || !rings.is_collapse_valid(v, k))
      continue;
    pm.collapses.push_back({v, rings.ring(v)[k]});
    rings.collapse(v, k);
    is_gone[v] = true;
  }
  return pm;
}

// A mesh of wedges before the numbering coarse first, each wedge with its vertex.
struct Wedge_arrays
{
  Indexed_triangle_mesh wedges;
  std::vector<Vertex_index> vertex;
  std::vector<Point_3> points; // of the vertices
};

inline Wedge_arrays without_seams(const Indexed_triangle_mesh& mesh)
{
  Wedge_arrays result = {mesh, {}, mesh.points};
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    result.vertex.push_back(v);
  return result;
}

// Two grids side by side, each a chart; the wedges on their common side are pairs.
inline Wedge_arrays two_charts(Vertex_index columns, Vertex_index rows, std::uint64_t seed)
{
  Wedge_arrays result;
  result.wedges = irregular_grid(columns, rows, seed);
  const Indexed_triangle_mesh right = translated(irregular_grid(columns, rows, seed + 1),
                                                 double(columns), 0., 0.);
  const Vertex_index n = Vertex_index(result.wedges.points.size());
  for(Vertex_index w = 0; w < 2 * n; ++w) {
    const bool is_on_seam = w >= n && (w - n) % (columns + 1) == 0;
    result.vertex.push_back(is_on_seam ? w - n + columns : Vertex_index(result.points.size()));
    if(is_on_seam) {
      result.wedges.points.push_back(result.points[w - n + columns]);
      continue;
    }
    if(w >= n)
      result.wedges.points.push_back(right.points[w - n]);
    result.points.push_back(result.wedges.points[w]);
  }
  for(const Triangle_indices& t : right.triangles)
    result.wedges.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return result;
}

// Collapses of all wedges of a random vertex into those of a random neighbour as long as the rings
// of the charts allow any, and the mesh that comes of it, coarse first.
inline Textured_progressive_mesh random_textured_mesh(const Wedge_arrays& mesh,
                                                      std::size_t target_wedges,
                                                      std::uint64_t seed)
{
  Random random(seed);
  const std::size_t n = mesh.vertex.size();
  Vertex_rings rings(mesh.wedges);
  std::vector<std::vector<Vertex_index>> wedges_of(mesh.points.size());
  for(Vertex_index w = 0; w < n; ++w)
    wedges_of[mesh.vertex[w]].push_back(w);
  Textured_progressive_mesh result;
  auto& pm = result.progressive_mesh;
  pm.number_of_vertices = n;
  pm.triangles = mesh.wedges.triangles;
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(std::size_t trial = 0; trial < 30 * n && n - pm.collapses.size() > target_wedges; ++trial) {
    const std::size_t v = uniform_index(random, mesh.points.size());
    const std::vector<Vertex_index>& wedges = wedges_of[v];
    if(is_gone[v])
      continue;
    const Vertex_index* first_ring = rings.ring(wedges[0]);
    const Vertex_index t = mesh.vertex[first_ring[uniform_index(random, rings.degree(wedges[0]))]];
    std::vector<std::uint32_t> places;
    for(const Vertex_index w : wedges)
      for(std::uint32_t k = 0; k < rings.degree(w); ++k)
        if(mesh.vertex[rings.ring(w)[k]] == t && rings.is_collapse_valid(w, k))
          places.push_back(k);
    if(places.size() != wedges.size())
      continue;
    for(std::size_t i = 0; i < wedges.size(); ++i) {
      pm.collapses.push_back({wedges[i], rings.ring(wedges[i])[places[i]]});
      rings.collapse(wedges[i], places[i]);
    }
    is_gone[v] = true;
    if(random() % 50 == 0)
      pm.batch_ends.push_back(pm.collapses.size());
  }
  if(!pm.batch_ends.empty() && pm.batch_ends.back() != pm.collapses.size())
    pm.batch_ends.push_back(pm.collapses.size());
  result.vertex = mesh.vertex;
  result.points = mesh.points;
  for(Vertex_index w = 0; w < n; ++w) {
    const Point_3& p = mesh.wedges.points[w];
    result.uv.emplace_back(0.1 * p.x() + (w % 3) * 1e-3, 0.1 * p.y() - 0.05 * p.z());
  }
  return CGAL::Surface_mesh_multiresolution::coarse_first(result);
}

} // namespace test_support

#endif
