// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_SELECTIVELY_REFINED_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_SELECTIVELY_REFINED_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>

#include <CGAL/assertions.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The class `Selectively_refined_mesh` is a mesh between the levels of a `Textured_progressive_mesh`:
fine in some places, coarse in others, and open to change at any time.

Each vertex beyond the coarsest level is there or not. A vertex split needs the triangles that it
changes as they were in the progressive mesh, hence the splits that made them so: these
dependencies are kept (a multi-triangulation; De Floriani, Magillo, Puppo 1997). What results is
what the same splits in their original order would make, for any set of vertices that is closed
under the dependencies; so it is a manifold of the same topology, without cracks at seams.

Memory: 16 bytes a triangle, about 60 bytes a vertex.
*/
class Selectively_refined_mesh
{
public:
  /// Stands at the coarsest level of `mesh`, which must live as long. Linear time.
  explicit Selectively_refined_mesh(const Textured_progressive_mesh& mesh);

  /// Returns the triangles as indices of wedges; those with `is_alive(t)` make up the mesh.
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }

  /// Returns whether triangle `t` is part of the mesh.
  bool is_alive(std::uint32_t t) const { return m_last[t] != dead; }

  /// Returns the number of triangles of the mesh.
  std::size_t number_of_triangles() const { return m_number_of_triangles; }

  /// Returns whether vertex `v` is there.
  bool has_vertex(Vertex_index v) const { return v < m_base || m_is_split[v - m_base]; }

  /// Adds vertex `v`, and before it those that it depends on, if they are not there. Time in
  /// proportion to the vertices added.
  void refine(Vertex_index v);

  /// Removes vertex `v` if no other depends on it; returns whether it is gone.
  bool coarsen(Vertex_index v);

  /// Adds and removes vertices until those are there for which `needs(v)` is true, and those that
  /// they depend on, and no others. Linear time in the number of vertices, with a small constant:
  /// what is costly is what changes.
  ///
  /// \tparam Needs a function of a `Vertex_index` that returns `bool`
  template <class Needs>
  void adapt(const Needs& needs);

private:
  static constexpr std::uint32_t dead = std::uint32_t(-1);
  static constexpr std::uint32_t from_start = std::uint32_t(-2);

  // What the split that adds a vertex does to a corner
  struct Change
  {
    Vsplit_table::Corner corner;
    Vertex_index wedge;     // that the corner gets
    Vertex_index old_wedge; // that it had
    std::uint32_t previous; // the vertex whose split changed or made the triangle before
  };

  std::uint32_t index(Vertex_index v) const { return v - m_base; }
  void split(Vertex_index v);
  void unsplit(Vertex_index v);

  std::size_t m_number_of_triangles = 0;
  Vertex_index m_base = 0;                    // vertices of the coarsest level
  std::vector<Triangle_indices> m_triangles;  // those that are not alive as they are born
  std::vector<std::uint32_t> m_last;          // of each triangle: the vertex that changed it last
  std::vector<std::uint32_t> m_first_change;  // of each vertex beyond the base
  std::vector<std::uint32_t> m_first_triangle; // that is born with it
  std::vector<Change> m_changes;
  std::vector<bool> m_is_split, m_is_needed;
  std::vector<Vertex_index> m_stack;
};

inline Selectively_refined_mesh::Selectively_refined_mesh(const Textured_progressive_mesh& mesh)
{
  const Progressive_mesh& pm = mesh.progressive_mesh;
  const Vsplit_table table(pm);
  const std::size_t n = mesh.number_of_collapses();
  m_triangles = table.triangles_at_death();
  m_last.assign(m_triangles.size(), dead);
  std::uint32_t born = 0;
  while(born < m_triangles.size() && table.death(born) == Vsplit_table::never)
    m_last[born++] = from_start;
  m_number_of_triangles = born;
  m_base = Vertex_index(mesh.number_of_vertices_after(n));
  const std::size_t splits = mesh.points.size() - m_base;
  m_is_split.assign(splits, false);
  m_is_needed.assign(splits, false);
  std::vector<std::uint32_t> last = m_last; // with all splits so far
  auto guard = table.guards().rbegin();
  for(std::size_t i = n; i-- > 0;) {
    const auto [removed, kept] = pm.collapses[i];
    const Vertex_index v = mesh.vertex[removed];
    if(m_first_change.size() == index(v)) {
      m_first_change.push_back(std::uint32_t(m_changes.size()));
      m_first_triangle.push_back(born);
    }
    const auto change = [&](Vsplit_table::Corner corner, Vertex_index wedge, Vertex_index old) {
      m_changes.push_back({corner, wedge, old, last[triangle_of(corner)]});
      last[triangle_of(corner)] = v;
    };
    for(const Vsplit_table::Corner corner : table.moved(i))
      change(corner, removed, kept);
    for(; guard != table.guards().rend() && guard->collapse == i; ++guard)
      change(3 * guard->triangle, no_vertex, no_vertex);
    for(std::size_t d = table.dying(i).size(); d > 0; --d)
      last[born++] = v;
  }
  m_first_change.push_back(std::uint32_t(m_changes.size()));
  m_first_triangle.push_back(born);
}

inline void Selectively_refined_mesh::split(Vertex_index v)
{
  const std::uint32_t i = index(v);
  for(std::uint32_t c = m_first_change[i]; c < m_first_change[i + 1]; ++c) {
    const Change& change = m_changes[c];
    if(change.wedge != no_vertex)
      m_triangles[triangle_of(change.corner)][corner_of(change.corner)] = change.wedge;
    m_last[triangle_of(change.corner)] = v;
  }
  for(std::uint32_t t = m_first_triangle[i]; t < m_first_triangle[i + 1]; ++t)
    m_last[t] = v;
  m_number_of_triangles += m_first_triangle[i + 1] - m_first_triangle[i];
  m_is_split[i] = true;
}

inline void Selectively_refined_mesh::unsplit(Vertex_index v)
{
  const std::uint32_t i = index(v);
  for(std::uint32_t c = m_first_change[i + 1]; c-- > m_first_change[i];) {
    const Change& change = m_changes[c];
    if(change.wedge != no_vertex)
      m_triangles[triangle_of(change.corner)][corner_of(change.corner)] = change.old_wedge;
    m_last[triangle_of(change.corner)] = change.previous;
  }
  for(std::uint32_t t = m_first_triangle[i]; t < m_first_triangle[i + 1]; ++t)
    m_last[t] = dead;
  m_number_of_triangles -= m_first_triangle[i + 1] - m_first_triangle[i];
  m_is_split[i] = false;
}

inline void Selectively_refined_mesh::refine(Vertex_index v)
{
  if(has_vertex(v))
    return;
  m_stack.assign(1, v);
  while(!m_stack.empty()) {
    const Vertex_index top = m_stack.back();
    if(has_vertex(top)) {
      m_stack.pop_back();
      continue;
    }
    const std::size_t before = m_stack.size();
    for(std::uint32_t c = m_first_change[index(top)]; c < m_first_change[index(top) + 1]; ++c) {
      const std::uint32_t previous = m_changes[c].previous;
      if(previous != from_start && previous != top && !has_vertex(previous))
        m_stack.push_back(previous);
    }
    if(m_stack.size() == before) {
      split(top);
      m_stack.pop_back();
    }
  }
}

inline bool Selectively_refined_mesh::coarsen(Vertex_index v)
{
  if(v < m_base)
    return false;
  if(!has_vertex(v))
    return true;
  const std::uint32_t i = index(v);
  for(std::uint32_t c = m_first_change[i]; c < m_first_change[i + 1]; ++c)
    if(m_last[triangle_of(m_changes[c].corner)] != v)
      return false;
  for(std::uint32_t t = m_first_triangle[i]; t < m_first_triangle[i + 1]; ++t)
    if(m_last[t] != v)
      return false;
  unsplit(v);
  return true;
}

template <class Needs>
void Selectively_refined_mesh::adapt(const Needs& needs)
{
  const Vertex_index end = Vertex_index(m_base + m_is_split.size());
  for(Vertex_index v = m_base; v < end; ++v)
    m_is_needed[index(v)] = needs(v);
  for(Vertex_index v = end; v-- > m_base;) {
    if(!m_is_needed[index(v)])
      continue;
    for(std::uint32_t c = m_first_change[index(v)]; c < m_first_change[index(v) + 1]; ++c)
      if(m_changes[c].previous != from_start)
        m_is_needed[index(m_changes[c].previous)] = true;
  }
  for(Vertex_index v = end; v-- > m_base;) // what depends on others goes before them
    if(m_is_split[index(v)] && !m_is_needed[index(v)])
      unsplit(v);
  for(Vertex_index v = m_base; v < end; ++v)
    if(!m_is_split[index(v)] && m_is_needed[index(v)])
      split(v);
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_SELECTIVELY_REFINED_MESH_H
