// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CUT_MESH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CUT_MESH_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/trial_map.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A chart as a mesh of its own, with its border and a hash of its triangles and seams.
struct Cut_mesh
{
  Indexed_triangle_mesh mesh;
  std::vector<Border_edge> border;
  std::uint64_t key = 0xcbf29ce484222325u;

  void add_to_key(std::uint64_t x)
  {
    key = (key ^ x) * 0x100000001b3u;
    key ^= key >> 29;
  }
};

// Cuts charts out of a mesh.
class Mesh_cutter
{
  typedef std::vector<std::uint32_t> Indices;

public:
  explicit Mesh_cutter(const Indexed_triangle_mesh& mesh)
    : m_mesh(mesh), m_position(mesh.triangles.size())
  {}

  // The mesh of the triangles, cut along the seams but those that are opened.
  Cut_mesh operator()(const Seam_graph& graph, const Indices& triangles, const Indices& opened);

private:
  const Indexed_triangle_mesh& m_mesh;
  Indices m_position; // of each triangle in the chart that is being cut out
};

inline Cut_mesh Mesh_cutter::operator()(const Seam_graph& graph, const Indices& triangles,
                                        const Indices& opened)
{
  for(std::uint32_t i = 0; i < triangles.size(); ++i)
    m_position[triangles[i]] = i;
  std::vector<std::uint8_t> is_open(3 * triangles.size());
  for(std::uint32_t i = 0; i < is_open.size(); ++i)
    is_open[i] = !graph.is_seam(3 * triangles[i / 3] + i % 3);
  for(const std::uint32_t h : opened)
    for(const std::uint32_t g : {h, graph.opposite(h)})
      is_open[3 * m_position[g / 3] + g % 3] = 1;
  Disjoint_sets corners(is_open.size());
  Cut_mesh result;
  for(std::uint32_t i = 0; i < is_open.size(); ++i) {
    const std::uint32_t h = 3 * triangles[i / 3] + i % 3;
    result.add_to_key(2 * h + is_open[i]);
    if(!is_open[i] || graph.opposite(h) > h)
      continue;
    const std::uint32_t g = graph.opposite(h), j = 3 * m_position[g / 3] + g % 3;
    corners.join(i, next_halfedge(j));
    corners.join(next_halfedge(i), j);
  }
  Indices wedge(is_open.size());
  result.mesh.triangles.resize(triangles.size());
  for(std::uint32_t i = 0; i < is_open.size(); ++i) {
    const std::uint32_t first = corners.find(i);
    if(first == i) {
      wedge[i] = std::uint32_t(result.mesh.points.size());
      result.mesh.points.push_back(
        m_mesh.points[m_mesh.triangles[triangles[i / 3]][i % 3]]);
    }
    result.mesh.triangles[i / 3][i % 3] = wedge[first];
  }
  for(std::uint32_t i = 0; i < is_open.size(); ++i)
    if(!is_open[i])
      result.border.push_back({wedge[corners.find(i)], wedge[corners.find(next_halfedge(i))]});
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CUT_MESH_H
