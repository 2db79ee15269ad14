// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVEL_START_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVEL_START_H

#include <CGAL/Surface_mesh_multiresolution/internal/nearest_on_surface.h>

#include <memory>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A level of a progressive mesh, where the points that belong to a wedge are at its ancestor.
class Level_start
{
public:
  Level_start(const Textured_progressive_mesh& mesh, std::size_t k)
    : m_mesh(mesh), m_ancestor(wedge_ancestors(mesh, 0, k))
    , m_triangles(level_triangles(mesh, k, m_ancestor)), m_kept(mesh.number_of_wedges_after(k))
    , m_view(mesh.points, mesh.vertex, mesh.uv, m_triangles, m_kept)
  {
    if(mesh.points.size() < mesh.number_of_wedges())
      join_charts();
  }

  Level_start(const Level_start&) = delete;
  Level_start& operator=(const Level_start&) = delete;

  const Textured_view& view() const { return m_view; }

  bool is_kept(Vertex_index w) const { return w < m_kept; }

  bool is_common_edge(Vertex_index v, Vertex_index w) const
  {
    if(!is_kept(v) || !is_kept(w))
      return false;
    for(const std::uint32_t* at = m_view.at().begin(v); at != m_view.at().end(v); ++at) {
      const Triangle_indices& t = m_triangles[*at / 3];
      if(t[0] == w || t[1] == w || t[2] == w)
        return true;
    }
    return false;
  }

  Triangle_number start(Vertex_index w) const { return m_view.triangle_at(m_ancestor[w]); }

  // Beyond a seam, the descent goes on in other charts.
  double squared_distance(Vertex_index w, const Surface_point& nearest) const
  {
    return m_joined ? descend_to_nearest(*m_joined, nearest.triangle, m_view.point(w))
                        .squared_distance
                    : nearest.squared_distance;
  }

private:
  // The same triangles as a mesh of the vertices
  void join_charts()
  {
    m_joined_triangles.reserve(m_triangles.size());
    for(const Triangle_indices& t : m_triangles)
      m_joined_triangles.push_back(replaced(t, m_mesh.vertex));
    m_identity.resize(m_mesh.points.size());
    std::iota(m_identity.begin(), m_identity.end(), Vertex_index(0));
    m_joined = std::make_unique<Textured_view>(m_mesh.points, m_identity, m_mesh.uv,
                                               m_joined_triangles, m_identity.size());
  }

  const Textured_progressive_mesh& m_mesh;
  std::vector<Vertex_index> m_ancestor;
  std::vector<Triangle_indices> m_triangles;
  std::size_t m_kept;
  Textured_view m_view;
  std::vector<Triangle_indices> m_joined_triangles;
  std::vector<Vertex_index> m_identity;
  std::unique_ptr<Textured_view> m_joined; // none if there are no seams
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVEL_START_H
