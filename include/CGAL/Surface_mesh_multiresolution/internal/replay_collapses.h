// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_REPLAY_COLLAPSES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_REPLAY_COLLAPSES_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The collapses of a progressive mesh once more, without those that turn triangles over in the
// texture, and those that are no longer possible without them.
class Replay
{
public:
  std::vector<Halfedge_collapse> collapses; // those that take place
  std::vector<std::size_t> batch_ends;      // in terms of them
  std::vector<Vertex_index> vertices;       // that are left
  std::vector<Triangle_indices> triangles;  // that are left, as indices into `vertices`

  // Returns what is wrong with the mesh, if anything is.
  std::string run(const Progressive_mesh& pm,
                  const std::vector<Textured_triangle_mesh::Point_3>& points,
                  const std::vector<Textured_triangle_mesh::Point_2>& uv,
                  std::size_t target_vertices, const std::vector<bool>& is_locked)
  {
    Indexed_triangle_mesh mesh = {points, pm.triangles};
    const std::vector<Vertex_index> source = sort_spatially(mesh);
    const std::vector<Vertex_index> rank = ranks(source, source.size());
    m_rings = Vertex_rings(mesh);
    const std::string error = ring_error(m_rings, source);
    if(!error.empty())
      return error;
    for(const Vertex_index v : source)
      m_uv.push_back(uv[v]);
    std::vector<bool> is_gone(source.size(), false);
    auto batch_end = pm.batch_ends.begin();
    for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
      const auto [removed, kept] = pm.collapses[i];
      if(points.size() - collapses.size() > target_vertices
         && (is_locked.empty() || !is_locked[removed]) && try_collapse(rank[removed], rank[kept])) {
        collapses.push_back(pm.collapses[i]);
        is_gone[removed] = true;
      }
      if(batch_end != pm.batch_ends.end() && *batch_end == i + 1) {
        if(!collapses.empty() && (batch_ends.empty() || batch_ends.back() < collapses.size()))
          batch_ends.push_back(collapses.size());
        ++batch_end;
      }
    }
    collect(source, is_gone);
    return {};
  }

private:
  bool try_collapse(Vertex_index v, Vertex_index t)
  {
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t k = std::uint32_t(std::find(r, r + m_rings.degree(v), t) - r);
    if(k == m_rings.degree(v) || !m_rings.is_collapse_valid(v, k) || turns_over(v, t))
      return false;
    m_rings.collapse(v, k);
    return true;
  }

  bool turns_over(Vertex_index v, Vertex_index t) const
  {
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t d = m_rings.degree(v);
    bool result = false;
    for(std::uint32_t i = m_rings.is_border(v) ? 1 : 0; i < d; ++i) {
      const Vertex_index a = r[i == 0 ? d - 1 : i - 1], b = r[i];
      if(a == t || b == t)
        continue;
      result |= has_turned_over(double_area(m_uv[v], m_uv[a], m_uv[b]),
                                double_area(m_uv[t], m_uv[a], m_uv[b]));
    }
    return result;
  }

  // The triangles come in the order of their smallest vertex.
  void collect(const std::vector<Vertex_index>& source, const std::vector<bool>& is_gone)
  {
    std::vector<Vertex_index> position(source.size(), no_vertex);
    for(Vertex_index v = 0; v < source.size(); ++v)
      if(!is_gone[source[v]]) {
        position[v] = Vertex_index(vertices.size());
        vertices.push_back(source[v]);
      }
    for(Vertex_index v = 0; v < source.size(); ++v) {
      if(position[v] == no_vertex)
        continue;
      const Vertex_index* r = m_rings.ring(v);
      const std::uint32_t d = m_rings.degree(v);
      for(std::uint32_t i = m_rings.is_border(v) ? 1 : 0; i < d; ++i) {
        const Vertex_index a = r[i == 0 ? d - 1 : i - 1], b = r[i];
        if(v < a && v < b)
          triangles.push_back({position[v], position[a], position[b]});
      }
    }
  }

  Vertex_rings m_rings;
  std::vector<Textured_triangle_mesh::Point_2> m_uv;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_REPLAY_COLLAPSES_H
