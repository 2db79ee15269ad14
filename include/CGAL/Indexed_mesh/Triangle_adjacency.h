// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H
#define CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/*!
\ingroup PkgHLSCMIndexedMesh

The class `Triangles_at_vertices` has for each vertex the corners that it has in triangles.

Linear time; 4 bytes a vertex and 12 a triangle.
*/
class Triangles_at_vertices
{
public:
  /// Finds the corners of vertices 0 to `number_of_vertices - 1`, which are all the triangles have.
  Triangles_at_vertices(const std::vector<Triangle_indices>& triangles,
                        std::size_t number_of_vertices)
  {
    const auto for_each_corner = [&triangles](const auto& use) {
      for(std::uint32_t t = 0; t < triangles.size(); ++t)
        for(std::uint32_t c = 0; c < 3; ++c)
          use(triangles[t][c], 3 * t + c);
    };
    m_begin = Blocked_execution::sort_by_key(
      number_of_vertices, for_each_corner, [this](std::size_t count) { m_corner.resize(count); },
      [this](std::uint32_t i, std::uint32_t corner) { m_corner[i] = corner; });
  }

  /// Returns the number of vertices.
  std::size_t number_of_vertices() const { return m_begin.size() - 1; }
  /// Returns the first corner of `v`; those that follow are ascending.
  const Halfedge* begin(Vertex_index v) const { return m_corner.data() + m_begin[v]; }
  /// Returns the end of the corners of `v`.
  const Halfedge* end(Vertex_index v) const { return m_corner.data() + m_begin[v + 1]; }
  /// Returns the number of corners of `v`.
  std::uint32_t number(Vertex_index v) const { return m_begin[v + 1] - m_begin[v]; }

private:
  Blocked_execution::Uninitialized_vector<std::uint32_t> m_begin, m_corner;
};

/// \ingroup PkgHLSCMIndexedMesh
/// Calls `use(w)` for the corners `w` of the triangles at `v`, `v` among them; most come twice.
template <class Use>
void for_each_corner_around(const std::vector<Triangle_indices>& triangles, const Triangles_at_vertices& at,
                            Vertex_index v, const Use& use)
{
  for(const Halfedge* corner = at.begin(v); corner != at.end(v); ++corner)
    for(const Vertex_index w : triangles[triangle_of(*corner)])
      use(w);
}

/// \ingroup PkgHLSCMIndexedMesh
/// Vertices of a mesh, and all triangles that have one of them.
struct Vertex_patch
{
  std::vector<Vertex_index> vertices; ///< ascending
  std::vector<Triangle_index> faces;  ///< ascending
};

/*!
\ingroup PkgHLSCMIndexedMesh

Returns the connected patches of those of the `vertices` for which `is_inside`, in their order. No triangle
has vertices of two patches, so that these can be worked on in any order, and at the same time.

Linear time in the size of the patches, but for sorting them.

\param is_inside of each vertex of the mesh, true only for some of the `vertices`; false for all afterwards
*/
inline std::vector<Vertex_patch> connected_patches(const std::vector<Triangle_indices>& triangles,
                                                   const Triangles_at_vertices& at,
                                                   const std::vector<Vertex_index>& vertices,
                                                   std::vector<bool>& is_inside)
{
  std::vector<Vertex_patch> patches;
  for(const Vertex_index first : vertices) {
    if(!is_inside[first])
      continue;
    Vertex_patch patch;
    patch.vertices.push_back(first);
    is_inside[first] = false;
    for(std::size_t i = 0; i < patch.vertices.size(); ++i) {
      const Vertex_index v = patch.vertices[i];
      for_each_corner_around(triangles, at, v, [&](Vertex_index w) {
        if(is_inside[w])
          patch.vertices.push_back(w);
        is_inside[w] = false;
      });
      for(const Halfedge* corner = at.begin(v); corner != at.end(v); ++corner)
        patch.faces.push_back(triangle_of(*corner));
    }
    std::sort(patch.vertices.begin(), patch.vertices.end());
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
    patches.push_back(std::move(patch));
  }
  return patches;
}

/*!
\ingroup PkgHLSCMIndexedMesh

The class `Triangle_adjacency` has the triangle across each edge of a mesh whose edges have one or
two triangles, of equal orientation.

Linear time, but for a logarithm at vertices of very many edges; 12 bytes a triangle. Build it once
and pass it on.
*/
class Triangle_adjacency
{
public:
  /// Finds the neighbours.
  explicit Triangle_adjacency(const std::vector<Triangle_indices>& triangles)
    : m_opposite(3 * triangles.size(), no_halfedge)
  {
    // The halfedges by their smaller vertex, which the two of an edge share; meshes may be in any order
    Vertex_index n = 0;
    for(const Triangle_indices& t : triangles)
      for(const Vertex_index v : t)
        n = v < n ? n : v + 1;
    const auto for_each_side = [&triangles](const auto& use) {
      for(Triangle_index t = 0; t < triangles.size(); ++t)
        for(std::uint32_t c = 0; c < 3; ++c) {
          const Vertex_index v = triangles[t][c], w = triangles[t][c == 2 ? 0 : c + 1];
          use((std::min)(v, w), Side{(std::max)(v, w), 3 * t + c, v < w});
        }
    };
    Blocked_execution::Uninitialized_vector<Side> sides;
    const auto begin = Blocked_execution::sort_by_key(
      n, for_each_side, [&sides](std::size_t count) { sides.resize(count); },
      [&sides](std::uint32_t i, const Side& side) { sides[i] = side; });
    constexpr std::size_t block = 4096;
    Blocked_execution::blocked_for(n, block, [&](std::size_t first, std::size_t last) {
      for(std::size_t v = first; v < last; ++v)
        match(sides.data() + begin[v], sides.data() + begin[v + 1]);
    });
  }

  /// Returns the number of halfedges, three to a triangle.
  std::size_t number_of_halfedges() const { return m_opposite.size(); }
  /// Returns the halfedge on the other side of `h`, or `no_halfedge` on the border.
  Halfedge opposite(Halfedge h) const { return m_opposite[h]; }
  /// Returns the same for the halfedge from corner `c` of triangle `t`.
  Halfedge opposite(Triangle_index t, int c) const { return m_opposite[3 * t + c]; }

  /// Gives the array of opposite halfedges away.
  std::vector<Halfedge> take() { return std::move(m_opposite); }

private:
  // A halfedge, without a look at its triangle. (`Edge_table` has sides of polygons too, which it sorts.)
  struct Side
  {
    Vertex_index larger;  // of its vertices
    Halfedge halfedge;
    bool goes_to_larger;
  };

  // Finds those among these sides, which share their smaller vertex and are ascending, that have the same
  // ends in opposite directions.
  void match(Side* begin, Side* end)
  {
    constexpr std::ptrdiff_t few = 32; // more are sorted by their ends first
    const bool is_sorted = end - begin > few;
    if(is_sorted)
      std::stable_sort(begin, end, [](const Side& g, const Side& h) { return g.larger < h.larger; });
    for(Side* h = begin; h != end; ++h)
      for(Side* g = h; g-- != begin;)
        if(g->larger != h->larger) {
          if(is_sorted)
            break;
        } else if(g->goes_to_larger != h->goes_to_larger) {
          Halfedge& across = m_opposite[h->halfedge];
          m_opposite[g->halfedge] = h->halfedge;
          across = across == no_halfedge ? g->halfedge : across;
        }
  }

  std::vector<Halfedge> m_opposite;
};

/// \ingroup PkgHLSCMIndexedMesh
/// The ends of an edge that has one triangle, in the direction in which this has it.
typedef std::array<Vertex_index, 2> Border_edge;

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the edges of a mesh that have one triangle, in the order of their halfedges.
inline std::vector<Border_edge> border_edges(const std::vector<Triangle_indices>& triangles)
{
  const Triangle_adjacency adjacency(triangles);
  std::vector<Border_edge> result;
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h)
    if(adjacency.opposite(h) == no_halfedge)
      result.push_back({vertex_of(triangles, h), vertex_of(triangles, next_halfedge(h))});
  return result;
}

/*!
\ingroup PkgHLSCMIndexedMesh

The class `Disjoint_sets` is a partition of \f$ [0, n) \f$ into sets that grow; each is known by its
smallest member. Nearly constant time for each call.
*/
class Disjoint_sets
{
public:
  /// Makes `n` sets of one member each.
  explicit Disjoint_sets(std::size_t n) : m_parent(n)
  {
    std::iota(m_parent.begin(), m_parent.end(), 0u);
  }

  /// Takes trees: a smaller or the same member of the set of each, `parent[i] <= i`.
  explicit Disjoint_sets(std::vector<std::uint32_t> parent) : m_parent(std::move(parent)) {}

  /// Returns the smallest member of the set of `i`.
  std::uint32_t find(std::uint32_t i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }

  /// Joins the sets of `i` and `j`; returns whether they were different ones.
  bool join(std::uint32_t i, std::uint32_t j)
  {
    i = find(i);
    j = find(j);
    m_parent[(std::max)(i, j)] = (std::min)(i, j);
    return i != j;
  }

private:
  std::vector<std::uint32_t> m_parent;
};

/// \ingroup PkgHLSCMIndexedMesh
/// Returns for each of `n` corners, which are halfedges too, the first corner of its wedge: of the
/// corners at the same vertex that are connected across open edges. `across(h)` is the halfedge on
/// the other side of `h`, whose other side is `h`, or `no_halfedge` if the edge is not open. Linear time.
template <class Across>
std::vector<Halfedge> first_corners_of_wedges(std::size_t n, const Across& across)
{
  std::vector<Halfedge> first(n, no_halfedge);
  for(Halfedge h = 0; h < n; ++h) {
    if(first[h] != no_halfedge)
      continue;
    first[h] = h;
    const auto go_around = [&](const auto& next) {
      for(Halfedge c = next(h); c != no_halfedge && first[c] == no_halfedge; c = next(c))
        first[c] = h;
    };
    go_around([&](Halfedge c) {
      const Halfedge opposite = across(c);
      return opposite == no_halfedge ? opposite : next_halfedge(opposite);
    });
    go_around([&](Halfedge c) { return across(previous_halfedge(c)); });
  }
  return first;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_TRIANGLE_ADJACENCY_H
