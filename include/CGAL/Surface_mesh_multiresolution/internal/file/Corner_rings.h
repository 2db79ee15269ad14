// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_RINGS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_RINGS_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_lists.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A mesh that grows by vertex splits.
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
  : public Corner_lists
{
public:
  // No split passes more corners, which bounds the time that bad data can cost.
  static constexpr std::uint32_t max_walk = 1u << 14;

  // Makes the next vertex and calls use(w) for the neighbours beside the parent that tell where it
  // may be: all of a vertex inside, the one on the border of a border vertex. Returns false if
  // there is no such split; the triangles then have the new vertex in some places of its parent.
  // `use` is copied and assigned: a copy of it stays in registers.
  template <class Use>
  bool split(const Ring_split& split, Use& use);

  // The split of t that makes the triangles with b and a, one of which may be `no_vertex`. Uses
  // `ring` as memory.
  Ring_split find_split(Vertex_index t, Vertex_index b, Vertex_index a,
                        std::vector<Vertex_index>& ring) const;

private:
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
};

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

// Asks for what splits to come will need of the memory. Rings are lists, whose next corner is known
// only when the one before is there: so each of the splits to come goes one corner on.
class Rings_ahead
{
public:
  // To be called before split i. parent_of(j) is the parent of split j, or `no_vertex` if it is not
  // known or not there; prefetch_values(w) asks for what belongs to a wedge.
  template <class ParentOf, class PrefetchValues>
  void prefetch(const Corner_rings& rings, std::size_t i, const ParentOf& parent_of,
                const PrefetchValues& prefetch_values)
  {
    const Vertex_index parent = parent_of(i + corners_ahead + 4);
    if(parent != no_vertex) {
      rings.prefetch(parent);
      prefetch_values(parent);
    }
    for(std::size_t j = 0; j < corners_ahead; ++j)
      m_cursors[j] = rings.prefetch_next(m_cursors[j + 1], prefetch_values);
    const Vertex_index next = parent_of(i + corners_ahead + 1);
    m_cursors[corners_ahead] = next != no_vertex ? rings.prefetch_first(next) : 0;
  }

private:
  // The corners of a ring that are asked for one after the other: about as many as splits pass.
  static constexpr std::size_t corners_ahead = 4;

  // That of split i + 1 + j.
  std::array<Corner_rings::Corner, corners_ahead + 1> m_cursors = {};
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_CORNER_RINGS_H
