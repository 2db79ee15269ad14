// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <CGAL/assertions.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The class `Progressive_mesh_cursor` stands at one mesh of a `Progressive_mesh` and goes to the next
coarser one by a halfedge collapse or to the next finer one by the vertex split that undoes it.

Triangles keep their index; at a position those with `is_alive(t)` make up the mesh. A step costs the
triangles that it changes.

Memory: 28 bytes a triangle, 8 bytes a vertex and 4 bytes a collapse.
*/
class Progressive_mesh_cursor
{
public:
  /// Stands at the fine mesh of `pm`, which must live as long as the cursor.
  explicit Progressive_mesh_cursor(const Progressive_mesh& pm);

  /// Returns the number of collapses that lead from the fine mesh to this one.
  std::size_t position() const { return m_position; }

  /// Returns the number of triangles of the present mesh.
  std::size_t number_of_triangles() const { return m_number_of_triangles; }

  /// Returns the triangles; those that are not alive are as they were when they died.
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }

  /// Returns whether triangle `t` is part of the present mesh.
  bool is_alive(std::uint32_t t) const { return m_death[t] == none; }

  /// Goes to the next coarser mesh. Precondition: there is one.
  void collapse();

  /// Goes to the next finer mesh. Precondition: `position() > 0`.
  void split();

  /// Goes to the mesh after `k` collapses.
  void move_to(std::size_t k)
  {
    while(m_position < k)
      collapse();
    while(m_position > k)
      split();
  }

  /// Returns the living triangles that the collapse before the present position changed.
  std::vector<std::uint32_t> last_changed_triangles() const;

private:
  static constexpr std::uint32_t none = std::uint32_t(-1);

  // Calls use(triangle, c) for each corner c of a living triangle in the list of v.
  template <class Use>
  void for_each_living_corner(Vertex_index v, const Use& use) const
  {
    for(std::uint32_t corner = m_first[v]; corner != none; corner = m_next[corner]) {
      if(is_alive(corner / 3))
        use(corner / 3, corner % 3);
      if(corner == m_last[v]) // the lists of others may follow
        break;
    }
  }

  const Progressive_mesh& m_pm;
  std::size_t m_position = 0;
  std::size_t m_number_of_triangles;
  std::vector<Triangle_indices> m_triangles;
  std::vector<std::uint32_t> m_death; // the collapse that a triangle died of, or `none`
  // The corners at each vertex as a linked list. The list of a removed vertex becomes the tail of
  // the list of the vertex that is kept, and a split cuts it off again at the joint.
  std::vector<std::uint32_t> m_first, m_last, m_next;
  std::vector<std::uint32_t> m_joint; // for each collapse made: the corner before the tail
};

inline Progressive_mesh_cursor::Progressive_mesh_cursor(const Progressive_mesh& pm)
  : m_pm(pm), m_number_of_triangles(pm.triangles.size()), m_triangles(pm.triangles)
  , m_death(pm.triangles.size(), none)
  , m_first(pm.number_of_vertices, none), m_last(pm.number_of_vertices, none)
  , m_next(3 * pm.triangles.size(), none)
{
  for(std::uint32_t corner = 0; corner < m_next.size(); ++corner) {
    const Vertex_index v = m_triangles[corner / 3][corner % 3];
    (m_first[v] == none ? m_first[v] : m_next[m_last[v]]) = corner;
    m_last[v] = corner;
  }
}

inline void Progressive_mesh_cursor::collapse()
{
  CGAL_precondition(m_position < m_pm.collapses.size());
  const auto [removed, kept] = m_pm.collapses[m_position];
  for_each_living_corner(removed, [&, kept = kept](std::uint32_t t, std::uint32_t c) {
    Triangle_indices& triangle = m_triangles[t];
    if(triangle[(c + 1) % 3] == kept || triangle[(c + 2) % 3] == kept) {
      m_death[t] = std::uint32_t(m_position);
      --m_number_of_triangles;
    } else {
      triangle[c] = kept;
    }
  });
  m_joint.push_back(m_last[kept]);
  if(m_first[removed] != none) {
    (m_first[kept] == none ? m_first[kept] : m_next[m_last[kept]]) = m_first[removed];
    m_last[kept] = m_last[removed];
  }
  ++m_position;
}

inline void Progressive_mesh_cursor::split()
{
  CGAL_precondition(m_position > 0);
  --m_position;
  const auto [removed, kept] = m_pm.collapses[m_position];
  m_last[kept] = m_joint.back();
  m_joint.pop_back();
  (m_last[kept] == none ? m_first[kept] : m_next[m_last[kept]]) = none;
  for_each_living_corner(removed, [&, removed = removed](std::uint32_t t, std::uint32_t c) {
    m_triangles[t][c] = removed;
  });
  for(std::uint32_t corner = m_first[removed]; corner != none; corner = m_next[corner]) {
    if(m_death[corner / 3] == m_position) {
      m_death[corner / 3] = none;
      ++m_number_of_triangles;
    }
    if(corner == m_last[removed])
      break;
  }
}

inline std::vector<std::uint32_t> Progressive_mesh_cursor::last_changed_triangles() const
{
  std::vector<std::uint32_t> result;
  if(m_position > 0)
    for_each_living_corner(m_pm.collapses[m_position - 1].removed,
                           [&](std::uint32_t t, std::uint32_t) { result.push_back(t); });
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H
