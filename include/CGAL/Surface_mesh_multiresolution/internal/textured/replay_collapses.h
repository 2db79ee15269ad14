// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_REPLAY_COLLAPSES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_REPLAY_COLLAPSES_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/textured/Chart_borders.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <algorithm>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The collapses of a progressive mesh once more, without those that turn triangles over in the
// texture or take a border over a corner of one, and those that are no longer possible without
// them.
class Replay
{
public:
  std::vector<Halfedge_collapse> collapses; // those that take place
  std::vector<std::size_t> batch_ends;      // in terms of them
  std::vector<Vertex_index> vertices;       // that are left
  std::vector<Triangle_indices> triangles;  // that are left, as indices into `vertices`

  // Returns what is wrong with the mesh, if anything is. Vertices that are near in space should be
  // near in memory.
  std::string run(const Progressive_mesh& pm,
                  const std::vector<Textured_triangle_mesh::Point_3>& points,
                  const std::vector<Textured_triangle_mesh::Point_2>& uv,
                  std::size_t target_vertices, const std::vector<bool>& is_locked,
                  bool keep_borders_simple)
  {
    m_rings = Vertex_rings({points, pm.triangles});
    const std::string error = ring_error(m_rings);
    if(!error.empty())
      return error;
    std::vector<bool> is_gone(points.size(), false);
    if(keep_borders_simple)
      m_borders = Chart_borders(border_corners(uv), pm.triangles, uv);
    std::size_t next_update = points.size() / 2; // vertices left
    const auto is_gone_corner = [&is_gone](const Chart_border_corner& corner) {
      return bool(is_gone[corner.wedge]);
    };
    auto batch_end = pm.batch_ends.begin();
    for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
      const auto [removed, kept] = pm.collapses[i];
      prefetch(pm.collapses, i, uv);
      if(points.size() - collapses.size() > target_vertices
         && (is_locked.empty() || !is_locked[removed])
         && try_collapse(removed, kept, uv, is_gone_corner)) {
        collapses.push_back(pm.collapses[i]);
        is_gone[removed] = true;
        if(points.size() - collapses.size() <= next_update) {
          m_borders.update(is_gone_corner);
          next_update /= 2;
        }
      }
      if(batch_end != pm.batch_ends.end() && *batch_end == i + 1) {
        if(!collapses.empty() && (batch_ends.empty() || batch_ends.back() < collapses.size()))
          batch_ends.push_back(collapses.size());
        ++batch_end;
      }
    }
    collect(is_gone);
    return {};
  }

private:
  typedef std::vector<Textured_triangle_mesh::Point_2> Uv;

  // Asks for what the collapses after number i will need.
  void prefetch(const std::vector<Halfedge_collapse>& all, std::size_t i, const Uv& uv) const
  {
    constexpr std::size_t distance = 6; // about the latency of the memory
    if(i + 2 * distance >= all.size())
      return;
    const Vertex_index later = all[i + 2 * distance].removed, next = all[i + distance].removed;
    m_rings.prefetch(later);
    Blocked_execution::prefetch(&uv[later]);
    const Vertex_index* r = m_rings.ring(next);
    for(std::uint32_t k = 0; k < (std::min)(m_rings.degree(next), 8u); ++k) {
      m_rings.prefetch(r[k]);
      Blocked_execution::prefetch(&uv[r[k]]);
    }
  }

  std::vector<Chart_border_corner> border_corners(const Uv& uv) const
  {
    std::vector<Chart_border_corner> corners;
    for(Vertex_index v = 0; v < uv.size(); ++v)
      if(m_rings.is_border(v))
        corners.push_back({uv[v], v, v});
    return corners;
  }

  template <class IsGone>
  bool try_collapse(Vertex_index v, Vertex_index t, const Uv& uv, const IsGone& is_gone)
  {
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t k = std::uint32_t(std::find(r, r + m_rings.degree(v), t) - r);
    if(k == m_rings.degree(v) || !m_rings.is_collapse_valid(v, k) || turns_over(v, t, uv))
      return false;
    const Vertex_index s = r[k == 0 ? m_rings.degree(v) - 1 : 0]; // the other end if t is one
    if(m_rings.is_border(v) && !m_borders.is_free({v, t, s}, uv, is_gone))
      return false;
    m_rings.collapse(v, k);
    return true;
  }

  bool turns_over(Vertex_index v, Vertex_index t, const Uv& uv) const
  {
    const Vertex_index* r = m_rings.ring(v);
    const std::uint32_t d = m_rings.degree(v);
    bool result = false;
    for(std::uint32_t i = m_rings.is_border(v) ? 1 : 0; i < d; ++i) {
      const Vertex_index a = r[i == 0 ? d - 1 : i - 1], b = r[i];
      if(a == t || b == t)
        continue;
      result |= has_turned_over(double_area(uv[v], uv[a], uv[b]), double_area(uv[t], uv[a], uv[b]));
    }
    return result;
  }

  // The triangles come in the order of their smallest vertex.
  void collect(const std::vector<bool>& is_gone)
  {
    for(Vertex_index v = 0; v < is_gone.size(); ++v)
      if(!is_gone[v])
        vertices.push_back(v);
    const std::vector<Vertex_index> position = ranks(vertices, is_gone.size());
    for(const Vertex_index v : vertices) {
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
  Chart_borders m_borders; // none if they need not stay simple
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_TEXTURED_REPLAY_COLLAPSES_H
