// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Vsplit_table.h>

#include <CGAL/assertions.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The class `Progressive_mesh_cursor` stands at one mesh of a `Progressive_mesh` and goes to the next
coarser one by a halfedge collapse or to the next finer one by the vertex split that undoes it.

Triangles keep their index; at a position those with `is_alive(t)` make up the mesh. A step costs
the triangles that it changes.

Memory: 12 bytes a triangle beside the `Vsplit_table`.
*/
class Progressive_mesh_cursor
{
public:
  /// Stands at the fine mesh of `pm`, which must live as long as the cursor. Linear time.
  explicit Progressive_mesh_cursor(const Progressive_mesh& pm)
    : m_pm(pm), m_table(pm), m_number_of_triangles(pm.triangles.size())
    , m_triangles(pm.triangles)
  {}

  /// Returns the number of collapses that lead from the fine mesh to this one.
  std::size_t position() const { return m_position; }

  /// Returns the number of triangles of the present mesh.
  std::size_t number_of_triangles() const { return m_number_of_triangles; }

  /// Returns the triangles; those that are not alive are as they were when they died.
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }

  /// Returns whether triangle `t` is part of the present mesh.
  bool is_alive(std::uint32_t t) const { return m_table.death(t) >= m_position; }

  /// Returns what the steps change.
  const Vsplit_table& table() const { return m_table; }

  /// Goes to the next coarser mesh. Precondition: there is one.
  void collapse()
  {
    CGAL_precondition(m_position < m_pm.collapses.size());
    write(m_position, m_pm.collapses[m_position].kept);
    m_number_of_triangles -= m_table.dying(m_position).size();
    ++m_position;
  }

  /// Goes to the next finer mesh. Precondition: `position() > 0`.
  void split()
  {
    CGAL_precondition(m_position > 0);
    --m_position;
    write(m_position, m_pm.collapses[m_position].removed);
    m_number_of_triangles += m_table.dying(m_position).size();
  }

  /// Goes to the mesh after `k` collapses.
  void move_to(std::size_t k)
  {
    while(m_position < k)
      collapse();
    while(m_position > k)
      split();
  }

  /// Returns the living triangles that the collapse before the present position changed.
  std::vector<std::uint32_t> last_changed_triangles() const
  {
    std::vector<std::uint32_t> result;
    if(m_position > 0)
      for(const Vsplit_table::Corner corner : m_table.moved(m_position - 1))
        result.push_back(triangle_of(corner));
    return result;
  }

private:
  void write(std::size_t i, Vertex_index v)
  {
    for(const Vsplit_table::Corner corner : m_table.moved(i))
      m_triangles[triangle_of(corner)][corner_of(corner)] = v;
  }

  const Progressive_mesh& m_pm;
  Vsplit_table m_table;
  std::size_t m_position = 0;
  std::size_t m_number_of_triangles;
  std::vector<Triangle_indices> m_triangles;
};

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H
