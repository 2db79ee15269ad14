// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_CURSOR_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/assertions.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The class `Vsplit_table` tells for each collapse of a `Progressive_mesh` which corners it moves and
which triangles it removes, so that the collapse, and the vertex split that undoes it, cost a few
reads in a row.

A corner is the number \f$ 3 t + c \f$, the place \f$ c \f$ of triangle \f$ t \f$. Collapse \f$ i
\f$ writes its kept vertex to the corners `moved(i)`, and the split writes back the removed one.

Linear time. Memory: 16 bytes a triangle, and about 32 a collapse.
*/
class Vsplit_table
{
public:
  typedef std::uint32_t Corner;                  ///< three times a triangle, and a place
  typedef Iterator_range<const Corner*> Corners; ///< corners in a row

  /// The death of triangles that are there at the end.
  static constexpr std::uint32_t never = std::uint32_t(-1);

  /// Constructs the table of a mesh without collapses.
  Vsplit_table() : m_begin(1, 0) {}

  /// Constructs the table of `pm`.
  explicit Vsplit_table(const Progressive_mesh& pm);

  /// Returns the number of collapses.
  std::size_t number_of_collapses() const { return m_begin.size() - 1; }

  /// Returns the corners that collapse `i` moves from the removed to the kept vertex.
  Corners moved(std::size_t i) const
  {
    return Corners(m_corners.data() + m_begin[i] + m_number_of_dying[i],
                   m_corners.data() + m_begin[i + 1]);
  }

  /// Returns the corners at the removed vertex of the triangles that die with collapse `i`.
  Corners dying(std::size_t i) const
  {
    return Corners(m_corners.data() + m_begin[i],
                   m_corners.data() + m_begin[i] + m_number_of_dying[i]);
  }

  /// A triangle that a split needs though it does not change it.
  struct Guard
  {
    std::uint32_t collapse; ///< that the split undoes
    std::uint32_t triangle; ///< the other triangle at the edge
  };

  /// Returns, in the order of the collapses, the triangles beyond the edge where a split puts an
  /// ear, that is a triangle whose new vertex gets no other.
  const std::vector<Guard>& guards() const { return m_guards; }

  /// Returns the collapse that triangle `t` dies of, or `never`.
  std::uint32_t death(std::uint32_t t) const { return m_death[t]; }

  /// Returns the triangles as they are when they die, that is when a split makes them; those that
  /// never die as they are at the end.
  const std::vector<Triangle_indices>& triangles_at_death() const { return m_triangles; }

private:
  class Descent;

  void add_guard(const Descent& descent, const Progressive_mesh& pm, std::size_t i);

  std::vector<std::uint32_t> m_begin; // of the corners of each collapse, those of the dying first
  std::vector<std::uint8_t> m_number_of_dying;
  std::vector<Corner> m_corners;
  std::vector<std::uint32_t> m_death;
  std::vector<Triangle_indices> m_triangles;
  std::vector<Guard> m_guards;
};

// The corners at each vertex as a linked list. The list of a removed vertex becomes the tail of the
// list of the vertex that is kept; corners of dead triangles are left out on the way.
class Vsplit_table::Descent
{
public:
  explicit Descent(const Progressive_mesh& pm)
    : m_first(pm.number_of_vertices, no_halfedge), m_last(pm.number_of_vertices, no_halfedge)
    , m_next(3 * pm.triangles.size(), no_halfedge)
  {
    for(Corner corner = 0; corner < m_next.size(); ++corner)
      append(vertex_of(pm.triangles, corner), corner);
  }

  // Calls use(corner) for the corners of living triangles at v and forgets the list of v.
  template <class IsDead, class Use>
  void take(Vertex_index v, const IsDead& is_dead, const Use& use)
  {
    Corner next = no_halfedge;
    for(Corner corner = m_first[v]; corner != no_halfedge; corner = next) {
      next = m_next[corner];
      if(!is_dead(triangle_of(corner)))
        use(corner);
    }
    m_first[v] = m_last[v] = no_halfedge;
  }

  // Asks for what a later call for v will need: `distance` calls ahead, and half as many.
  void prefetch(const Progressive_mesh& pm, std::size_t i,
                const std::vector<Triangle_indices>& triangles) const
  {
    constexpr std::size_t distance = 16; // about the latency of the memory
    if(i + distance >= pm.collapses.size())
      return;
    Blocked_execution::prefetch(&m_first[pm.collapses[i + distance].removed]);
    Blocked_execution::prefetch(&m_last[pm.collapses[i + distance].kept]);
    const Corner corner = m_first[pm.collapses[i + distance / 2].removed];
    if(corner != no_halfedge) {
      Blocked_execution::prefetch(&m_next[corner]);
      Blocked_execution::prefetch(&triangles[triangle_of(corner)]);
    }
  }

  // Calls use(corner) for the corners at v, of dead triangles too.
  template <class Use>
  void for_each(Vertex_index v, const Use& use) const
  {
    for(Corner corner = m_first[v]; corner != no_halfedge; corner = m_next[corner])
      use(corner);
  }

  void append(Vertex_index v, Corner corner)
  {
    (m_first[v] == no_halfedge ? m_first[v] : m_next[m_last[v]]) = corner;
    m_last[v] = corner;
    m_next[corner] = no_halfedge;
  }

private:
  std::vector<Corner> m_first, m_last, m_next;
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE Vsplit_table::Vsplit_table(const Progressive_mesh& pm)
  : m_death(pm.triangles.size(), never), m_triangles(pm.triangles)
{
  Descent descent(pm);
  const std::size_t n = pm.collapses.size();
  m_begin.reserve(n + 1);
  m_number_of_dying.reserve(n);
  m_corners.reserve(6 * n);
  std::vector<Corner> moved;
  for(std::size_t i = 0; i < n; ++i) {
    const Vertex_index kept = pm.collapses[i].kept;
    descent.prefetch(pm, i, m_triangles);
    m_begin.push_back(std::uint32_t(m_corners.size()));
    moved.clear();
    descent.take(
      pm.collapses[i].removed, [this](std::uint32_t t) { return m_death[t] != never; },
      [&](Corner corner) {
        const Triangle_indices& t = m_triangles[triangle_of(corner)];
        const bool is_dying = t[0] == kept || t[1] == kept || t[2] == kept;
        (is_dying ? m_corners : moved).push_back(corner);
      });
    m_number_of_dying.push_back(std::uint8_t(m_corners.size() - m_begin.back()));
    for(std::size_t d = m_begin.back(); d < m_corners.size(); ++d)
      m_death[triangle_of(m_corners[d])] = std::uint32_t(i);
    if(moved.empty())
      add_guard(descent, pm, i);
    for(const Corner corner : moved) {
      m_triangles[triangle_of(corner)][corner_of(corner)] = kept;
      descent.append(kept, corner);
    }
    m_corners.insert(m_corners.end(), moved.begin(), moved.end());
  }
  m_begin.push_back(std::uint32_t(m_corners.size()));
}

// The triangle that shares the edge from the kept to the third vertex with the ear that has died.
CGAL_HLSCM_INLINE void Vsplit_table::add_guard(const Descent& descent, const Progressive_mesh& pm,
                                               std::size_t i)
{
  const Vertex_index removed = pm.collapses[i].removed, kept = pm.collapses[i].kept;
  for(std::size_t d = m_begin[i]; d < m_corners.size(); ++d) {
    const Corner ear = m_corners[d];
    Vertex_index third = no_vertex;
    for(const Vertex_index v : m_triangles[triangle_of(ear)])
      if(v != removed && v != kept)
        third = v;
    descent.for_each(kept, [&](Corner corner) {
      const Triangle_indices& t = m_triangles[triangle_of(corner)];
      if(m_death[triangle_of(corner)] == never && (t[0] == third || t[1] == third || t[2] == third))
        m_guards.push_back({std::uint32_t(i), triangle_of(corner)});
    });
  }
}

#endif // CGAL_HLSCM_DEFINITIONS

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
