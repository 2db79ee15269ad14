// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_LISTS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_LISTS_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Indexed_mesh/mesh_indices.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What a new vertex takes of the ring of its parent: corners INSIDE a ring, or as a border vertex
// the BEGIN or the END of an open one.
enum class Split_kind : std::uint8_t { INSIDE, BEGIN, END };

// A vertex split in terms of the ring of its parent.
struct Ring_split
{
  Vertex_index parent; // `no_vertex`: there is no such split
  Split_kind kind;
  // Where the corners that move begin: in an open ring the number of corners before them, in a
  // closed one that number less one. 0 for BEGIN.
  std::uint32_t skipped;
  std::uint32_t moved; // the corners that move; 0 for END, which moves all that follow
};

using Blocked_execution::Uninitialized_vector;

// The triangles of a mesh, with room for more, and the ring of each vertex as a list of its
// corners, counterclockwise. A corner is 4 t + c, place c < 3 of triangle t < 2^29: no divisions by 3.
class Corner_lists
{
public:
  typedef std::uint32_t Corner;

  // Begins with a mesh; returns what is wrong with it.
  Ring_defect build(std::vector<Triangle_indices> triangles, std::size_t number_of_vertices);

  void reserve(std::size_t vertices, std::size_t triangles)
  {
    m_first.reserve(vertices);
    m_next.reserve(3 * triangles);
    m_triangles.reserve(triangles);
  }

  // Makes room for so many vertices and triangles in all. There is no split without room for it.
  void make_room(std::size_t vertices, std::size_t triangles)
  {
    m_first.resize(vertices);
    m_next.resize(3 * triangles);
    m_triangles.resize(triangles);
    m_room_for_vertices = vertices;
    m_room_for_triangles = triangles;
  }

  // Gives back the room that is left.
  void trim() { make_room(m_number_of_vertices, m_number_of_triangles); }

  std::size_t number_of_triangles() const { return m_number_of_triangles; }

  // With the room for those to come, if there is.
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }
  std::vector<Triangle_indices> take_triangles() { return std::move(m_triangles); }
  bool is_border(Vertex_index v) const { return (m_first[v] & border_flag) != 0; }

  // Ask for the memory that a split of v will need: first that of v, then, when that is there,
  // along the ring, a corner a call.
  void prefetch(Vertex_index v) const { Blocked_execution::prefetch(&m_first[v]); }
  Corner prefetch_first(Vertex_index v) const
  {
    prefetch_corner(first(v));
    return first(v);
  }
  template <class Prefetch_vertex>
  Corner prefetch_next(Corner corner, const Prefetch_vertex& prefetch_vertex) const
  {
    prefetch_vertex(at(previous(corner)));
    const Corner after = following(corner);
    if(after == no_corner)
      return corner;
    prefetch_corner(after);
    return after;
  }

  // Goes back to the first triangles, with ancestor(v) in the place of each vertex v. It cannot be
  // split any more.
  template <class Ancestor>
  void truncate(std::size_t triangles, const Ancestor& ancestor)
  {
    m_number_of_triangles = triangles;
    m_triangles.resize(triangles);
    for(Triangle_indices& t : m_triangles)
      for(Vertex_index& v : t)
        v = ancestor(v);
  }

protected:
  static constexpr std::uint32_t border_flag = 1u << 31;
  static constexpr Corner no_corner = border_flag - 1;

  static Corner next(Corner corner) { return corner % 4 == 2 ? corner - 2 : corner + 1; }
  static Corner previous(Corner corner) { return corner % 4 == 0 ? corner + 2 : corner - 1; }

  // 3 (corner / 4) + corner % 4: the place of a corner in arrays without gaps
  static std::size_t flat(Corner corner) { return corner - corner / 4; }

  Vertex_index at(Corner corner) const
  {
    return reinterpret_cast<const Vertex_index*>(m_triangles.data())[flat(corner)];
  }
  void set(Corner corner, Vertex_index v)
  {
    reinterpret_cast<Vertex_index*>(m_triangles.data())[flat(corner)] = v;
  }
  // The next corner of the same vertex
  Corner following(Corner corner) const { return m_next[flat(corner)]; }
  void set_following(Corner corner, Corner next) { m_next[flat(corner)] = next; }
  Corner first(Vertex_index v) const { return m_first[v] & ~border_flag; }

  void prefetch_corner(Corner corner) const
  {
    Blocked_execution::prefetch(&m_next[flat(corner)]);
    Blocked_execution::prefetch(&m_triangles[corner / 4]);
  }

  // From here on `corner` begins the ring of v, which stays open if it was.
  void set_first(Vertex_index v, Corner corner)
  {
    m_first[v] = corner | (m_first[v] & border_flag);
  }

  bool has_room(std::size_t triangles) const
  {
    return m_number_of_vertices < m_room_for_vertices
        && m_number_of_triangles + triangles <= m_room_for_triangles;
  }

  // The next corners of the new ones are for the caller to set.
  Corner add_triangle(Vertex_index v, Vertex_index w, Vertex_index x)
  {
    m_triangles[m_number_of_triangles] = {v, w, x};
    return Corner(4 * m_number_of_triangles++);
  }

  void insert_after(Corner corner, Corner inserted)
  {
    set_following(inserted, following(corner));
    set_following(corner, inserted);
  }

  void insert_first(Corner corner, Corner inserted)
  {
    set_following(inserted, corner);
    set_first(at(corner), inserted);
  }

  // The arrays may have more room than this.
  std::size_t m_number_of_vertices = 0, m_number_of_triangles = 0;
  std::vector<Triangle_indices> m_triangles;
  std::size_t m_room_for_vertices = 0, m_room_for_triangles = 0; // without divisions
  Uninitialized_vector<Corner> m_next;  // of the same vertex; `no_corner` ends an open ring
  Uninitialized_vector<Corner> m_first; // of each vertex, with `border_flag` if its ring is open
};

inline Ring_defect Corner_lists::build(std::vector<Triangle_indices> triangles,
                                       std::size_t number_of_vertices)
{
  m_triangles = std::move(triangles);
  m_number_of_triangles = m_triangles.size();
  m_number_of_vertices = number_of_vertices;
  m_next.assign(3 * m_triangles.size(), no_corner);
  m_first.assign(number_of_vertices, no_corner);
  std::vector<Corner> corners;
  for(Corner c = 0; c < 4 * m_triangles.size(); ++c)
    if(c % 4 != 3)
      corners.push_back(c);
  // The corners that halfedges leave, sorted by halfedge
  std::vector<std::pair<std::uint64_t, Corner>> halfedges;
  const auto halfedge = [](Vertex_index v, Vertex_index w) { return std::uint64_t(v) << 32 | w; };
  for(const Corner c : corners)
    halfedges.push_back({halfedge(at(c), at(next(c))), c});
  std::sort(halfedges.begin(), halfedges.end());
  for(std::size_t i = 1; i < halfedges.size(); ++i)
    if(halfedges[i].first == halfedges[i - 1].first)
      return Ring_defect::REPEATED_HALFEDGE;
  std::vector<bool> has_predecessor(4 * m_triangles.size(), false);
  std::vector<std::uint32_t> degree(number_of_vertices, 0);
  for(const Corner c : corners) {
    const std::uint64_t wanted = halfedge(at(c), at(previous(c)));
    const auto found = std::lower_bound(halfedges.begin(), halfedges.end(),
                                        std::make_pair(wanted, Corner(0)));
    if(found != halfedges.end() && found->first == wanted) {
      set_following(c, found->second);
      has_predecessor[found->second] = true;
    }
    ++degree[at(c)];
    m_first[at(c)] = c;
    if(at(c) == at(next(c)))
      return Ring_defect::REPEATED_HALFEDGE;
  }
  for(const Corner c : corners)
    if(!has_predecessor[c])
      m_first[at(c)] = c | border_flag;
  for(Vertex_index v = 0; v < number_of_vertices; ++v) {
    if(degree[v] == 0)
      return Ring_defect::ISOLATED;
    std::uint32_t reached = 0;
    Corner c = first(v);
    do {
      ++reached;
      c = following(c);
    } while(c != no_corner && c != first(v));
    if(reached != degree[v])
      return Ring_defect::SEVERAL_FANS;
    if(!is_border(v) && reached < 3) // two triangles back to back
      return Ring_defect::REPEATED_HALFEDGE;
  }
  return Ring_defect::NONE;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_LISTS_H
