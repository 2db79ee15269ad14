// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CORNER_RINGS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CORNER_RINGS_H

#include <CGAL/Blocked_execution/internal/Uninitialized_vector.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Vertex_rings.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

using Blocked_execution::internal::Uninitialized_vector;

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

// The triangles of a mesh that grows by vertex splits, with the ring of each vertex as a list of
// its corners, counterclockwise. A corner is 4 t + c, place c < 3 of triangle t: no divisions by 3.
//
//        a                       a              INSIDE: the corners of t in the triangles between
//      / | \                   / | \            b and a become corners of the new vertex v. New
//  m_i   t    ..   ->      m_i v - t  ..        are (v, t, b), to the left of v -> t, and
//      \ | /                   \ | /            (v, a, t). At a border, END makes no a and BEGIN
//        b                       b              no b, and may move no corner at all.
//
// As v is new and a is not b, any such split of a manifold gives a manifold.
//
// Lists are faster here than `Vertex_rings`, where the rings of all m_i change and each has to be
// searched: those of b and a change in one place, which the triangles beside them name.
class Corner_rings
{
public:
  typedef std::uint32_t Corner;

  // No split passes more corners, which bounds the time that bad data can cost.
  static constexpr std::uint32_t max_walk = 1u << 14;

  // A bound on numbers of triangles.
  static constexpr std::size_t max_triangles = std::size_t(1) << 29;

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
  void prefetch(Vertex_index v) const { internal::prefetch(&m_first[v]); }
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

  // Makes the next vertex and calls use(w) for the neighbours beside the parent that tell where it
  // may be: all of a vertex inside, the one on the border of a border vertex. Returns false if
  // there is no such split; the triangles then have the new vertex in some places of its parent.
  // `use` is copied and assigned: a copy of it stays in registers.
  template <class Use>
  bool split(const Ring_split& split, Use& use);

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

  // The split of t that makes the triangles with b and a, one of which may be `no_vertex`. Uses
  // `ring` as memory.
  Ring_split find_split(Vertex_index t, Vertex_index b, Vertex_index a,
                        std::vector<Vertex_index>& ring) const;

private:
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
    internal::prefetch(&m_next[flat(corner)]);
    internal::prefetch(&m_triangles[corner / 4]);
  }

  // From here on `corner` begins the ring of v, which stays open if it was.
  void set_first(Vertex_index v, Corner corner) { m_first[v] = corner | (m_first[v] & border_flag); }

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

  // Puts the triangle `right`, behind the corners that moved, into the rings of t and a; `last` is
  // the last corner that moved, `after` the one that followed it.
  void link_right(Corner right, Corner last, Corner after)
  {
    set_following(right + 2, after);
    if(after != no_corner)
      insert_after(next(after), right + 1);
    else
      insert_first(previous(last), right + 1);
  }

  void list_ring(Vertex_index v, std::vector<Vertex_index>& ring) const;

  template <class Use>
  bool split_inside(const Ring_split& split, Use& use);
  template <class Use>
  bool split_begin(const Ring_split& split, Use& use);
  template <class Use>
  bool split_end(const Ring_split& split, Use& use);

  // The arrays may have more room than this.
  std::size_t m_number_of_vertices = 0, m_number_of_triangles = 0;
  std::vector<Triangle_indices> m_triangles;
  std::size_t m_room_for_vertices = 0, m_room_for_triangles = 0; // without divisions
  Uninitialized_vector<Corner> m_next;  // of the same vertex; `no_corner` ends an open ring
  Uninitialized_vector<Corner> m_first; // of each vertex, with `border_flag` if its ring is open
};

inline Ring_defect Corner_rings::build(std::vector<Triangle_indices> triangles,
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

template <class Use>
bool Corner_rings::split(const Ring_split& split, Use& use)
{
  if(split.kind == Split_kind::INSIDE)
    return split_inside(split, use);
  if(!is_border(split.parent))
    return false;
  return split.kind == Split_kind::BEGIN ? split_begin(split, use) : split_end(split, use);
}

template <class Use>
bool Corner_rings::split_inside(const Ring_split& split, Use& use)
{
  const Vertex_index t = split.parent, v = Vertex_index(m_number_of_vertices);
  if(split.moved == 0 || split.moved > max_walk || split.skipped > max_walk || !has_room(2))
    return false;
  const bool is_open = is_border(t);
  Corner before = is_open ? no_corner : first(t);
  Corner from = is_open ? first(t) : following(before);
  for(std::uint32_t i = 0; i < split.skipped; ++i) {
    before = from;
    from = following(from);
    if(from == no_corner)
      return false;
  }
  Use neighbors = use;
  neighbors(at(next(from)));
  Corner last = from, after = from;
  for(std::uint32_t i = 0; i < split.moved; ++i) {
    if(after == no_corner || after == before)
      return false;
    set(after, v);
    neighbors(at(previous(after)));
    last = after;
    after = following(after);
  }
  use = neighbors;
  const Corner left = add_triangle(v, t, at(next(from)));
  const Corner right = add_triangle(v, at(previous(last)), t);
  m_first[m_number_of_vertices++] = left;
  set_following(left, from);
  set_following(last, right);
  set_following(right, left);
  if(before != no_corner)
    set_following(before, left + 1);
  set_following(left + 1, right + 2);
  if(!is_open || before == no_corner)
    set_first(t, left + 1);
  insert_after(next(from), left + 2);
  link_right(right, last, after);
  return true;
}

template <class Use>
bool Corner_rings::split_begin(const Ring_split& split, Use& use)
{
  const Vertex_index t = split.parent, v = Vertex_index(m_number_of_vertices);
  if(split.skipped != 0 || split.moved > max_walk || !has_room(1))
    return false;
  const Corner from = first(t);
  Corner last = no_corner, after = from;
  use(at(next(from)));
  for(std::uint32_t i = 0; i < split.moved; ++i) {
    if(after == no_corner)
      return false;
    set(after, v);
    last = after;
    after = following(after);
  }
  const bool moves = last != no_corner;
  const Corner right = add_triangle(v, moves ? at(previous(last)) : at(next(from)), t);
  m_first[m_number_of_vertices++] = (moves ? from : right) | border_flag;
  set_following(right, no_corner);
  if(moves)
    set_following(last, right);
  set_first(t, right + 2);
  link_right(right, last, after);
  return true;
}

template <class Use>
bool Corner_rings::split_end(const Ring_split& split, Use& use)
{
  const Vertex_index t = split.parent, v = Vertex_index(m_number_of_vertices);
  if(split.moved != 0 || split.skipped > max_walk || !has_room(1))
    return false;
  Corner before = no_corner, from = first(t);
  for(std::uint32_t i = 0; i < split.skipped; ++i) {
    if(from == no_corner)
      return false;
    before = from;
    from = following(from);
  }
  std::uint32_t moved = 0;
  Corner last = before;
  for(Corner corner = from; corner != no_corner; corner = following(corner)) {
    if(++moved > max_walk)
      return false;
    set(corner, v);
    last = corner;
  }
  use(at(previous(last)));
  const Corner left = add_triangle(v, t, moved > 0 ? at(next(from)) : at(previous(before)));
  m_first[m_number_of_vertices++] = left | border_flag;
  set_following(left, from);
  set_following(left + 1, no_corner);
  if(before != no_corner)
    set_following(before, left + 1);
  else
    set_first(t, left + 1);
  if(moved > 0)
    insert_after(next(from), left + 2);
  else
    insert_first(previous(before), left + 2);
  return true;
}

inline Ring_split Corner_rings::find_split(Vertex_index t, Vertex_index b, Vertex_index a,
                                           std::vector<Vertex_index>& ring) const
{
  const Ring_split none = {no_vertex, Split_kind::INSIDE, 0, 0};
  list_ring(t, ring);
  const auto position = [&ring](Vertex_index w) {
    return std::uint32_t(std::find(ring.begin(), ring.end(), w) - ring.begin());
  };
  const std::uint32_t d = std::uint32_t(ring.size()), of_b = position(b), of_a = position(a);
  Ring_split result = {t, Split_kind::INSIDE, of_b, 0};
  if(b == no_vertex)
    result = {t, Split_kind::BEGIN, 0, of_a};
  else if(a == no_vertex)
    result.kind = Split_kind::END;
  else
    result.moved = is_border(t) ? of_a - of_b : (of_a + d - of_b) % d;
  const bool is_known = (b == no_vertex || of_b < d) && (a == no_vertex || of_a < d);
  const bool is_possible = result.kind == Split_kind::INSIDE
                             ? result.moved != 0 && (!is_border(t) || of_a > of_b)
                             : is_border(t) && (a == no_vertex) != (b == no_vertex);
  return is_known && is_possible && d <= max_walk ? result : none;
}

// The neighbours of v as `Ring_split` counts them.
inline void Corner_rings::list_ring(Vertex_index v, std::vector<Vertex_index>& ring) const
{
  ring.clear();
  const Corner begin = is_border(v) ? first(v) : following(first(v));
  Corner corner = begin, last = begin;
  do {
    ring.push_back(at(next(corner)));
    last = corner;
    corner = following(corner);
  } while(corner != begin && corner != no_corner);
  if(corner == no_corner)
    ring.push_back(at(previous(last)));
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_CORNER_RINGS_H
