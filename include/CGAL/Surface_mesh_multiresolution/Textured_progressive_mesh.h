// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_PROGRESSIVE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Textured_progressive_mesh` is a `Progressive_mesh` with texture coordinates: all its
levels share one texture, as no vertex that is left ever moves on the surface or in the texture.

Where the texture has a seam, a vertex of the surface has several texture coordinates. The
progressive mesh is therefore one of *wedges* (Hoppe 1996): a wedge is a vertex with one texture
coordinate, the corners at a vertex between one seam and the next. In terms of wedges each chart is
a mesh of its own, whose border is made of seams and of the border of the surface. Collapsing an
edge on a seam takes two halfedge collapses, one a chart, which follow each other; a level between
them would have a crack.

    chart A   a                a        The vertex v has the wedge v' in chart A and v'' in
            / | \             / |       chart B. Its collapse into t is the pair (v', t'),
       s === v === t    s ======= t     (v'', t'') of collapses of wedges, each of which removes
            \ | /             \ |       one triangle.
    chart B   b                b

Invariants
- The wedges are numbered *coarse first*: collapse \f$ i \f$ removes the wedge \f$ n - 1 - i \f$, so
  that the wedges of each level are the first ones. The triangles come in the order in which splits
  make them, so that those of each level are the first ones too.
- `vertex` does not descend from wedge to wedge and takes every value below `points.size()`: the
  vertices of each level are the first ones as well.
- Without texture `uv` is empty and each vertex has one wedge, with its number.
- The wedges of a vertex are removed one directly after the other; how many there are is any number
  for a vertex of the coarsest level, one or two for the others.
- A triangle that a collapse removes has, when it dies, the removed wedge as its first corner; of
  two triangles that die together, that to the left of the halfedge from the removed to the kept
  wedge comes first.

Memory: 12 bytes a triangle, 28 bytes a wedge, 28 bytes a vertex.
*/
struct Textured_progressive_mesh
{
  typedef Simple_cartesian<double>::Point_2 Point_2; ///< a texture coordinate
  typedef Simple_cartesian<double>::Point_3 Point_3; ///< a point of the surface

  Progressive_mesh progressive_mesh; ///< of the wedges
  std::vector<Vertex_index> vertex;  ///< of each wedge
  std::vector<Point_2> uv;           ///< of each wedge; empty without texture
  std::vector<Point_3> points;       ///< of each vertex
  /// The number of each vertex in the mesh from which this was built; empty if that is not known.
  std::vector<Vertex_index> source_vertex;

  /// Returns whether there is a texture, or just the surface.
  bool has_texture() const { return !uv.empty(); }

  /// Returns the number of wedges of the fine mesh.
  std::size_t number_of_wedges() const { return progressive_mesh.number_of_vertices; }

  /// Returns the number of collapses.
  std::size_t number_of_collapses() const { return progressive_mesh.collapses.size(); }

  /// Returns the number of wedges after `k` collapses.
  std::size_t number_of_wedges_after(std::size_t k) const { return number_of_wedges() - k; }

  /// Returns the number of vertices after `k` collapses. Precondition: `is_whole(k)`.
  std::size_t number_of_vertices_after(std::size_t k) const
  {
    const std::size_t wedges = number_of_wedges_after(k);
    return wedges == 0 ? 0 : vertex[wedges - 1] + 1;
  }

  /// Returns the wedge into which wedge `w` collapses. Precondition: it is removed at some time.
  Vertex_index parent(Vertex_index w) const
  {
    return progressive_mesh.collapses[number_of_wedges() - 1 - w].kept;
  }

  /// Returns whether the mesh after `k` collapses is not between the two collapses of one vertex.
  bool is_whole(std::size_t k) const
  {
    const std::size_t wedges = number_of_wedges_after(k);
    return wedges == 0 || wedges == vertex.size() || vertex[wedges - 1] != vertex[wedges];
  }

  /// Returns the nearest position from `k` on, towards the coarser ones, that is whole.
  std::size_t whole_position(std::size_t k) const
  {
    CGAL_precondition(k <= number_of_collapses());
    while(!is_whole(k)) // at most once
      ++k;
    return k;
  }
};

namespace internal {

// How a triangle of a mesh comes into being whose wedges are numbered coarse first.
struct Triangle_birth
{
  std::uint32_t order; // 0 in the coarsest level; 1 and 2 to the left and to the right of what the
                       // first split adds, 3 and 4 of the second ...
  std::uint32_t place; // of the new wedge; 0 in the coarsest level
};

// The corner with the largest wedge is the next to go, until it goes to another corner. There are
// two such steps a triangle, as collapses move about four corners and remove two triangles.
inline Triangle_birth triangle_birth(Triangle_indices t, const Textured_progressive_mesh& mesh)
{
  const std::size_t base = mesh.number_of_wedges_after(mesh.number_of_collapses());
  while(true) {
    const std::uint32_t c = std::uint32_t(std::max_element(t.begin(), t.end()) - t.begin());
    if(t[c] < base)
      return {0, 0};
    const Vertex_index kept = mesh.parent(t[c]);
    const std::uint32_t order = std::uint32_t(2 * (t[c] - base));
    if(t[(c + 1) % 3] == kept)
      return {order + 1, c};
    if(t[(c + 2) % 3] == kept)
      return {order + 2, c};
    t[c] = kept;
  }
}

// Brings the triangles of a mesh whose wedges are numbered coarse first into the order in which
// splits make them, which is a stable counting sort, and turns each as the invariants want it.
inline void sort_triangles(Textured_progressive_mesh& mesh)
{
  const std::vector<Triangle_indices> triangles = std::move(mesh.progressive_mesh.triangles);
  std::vector<Triangle_birth> births(triangles.size());
  std::vector<std::uint32_t> begin(2 * mesh.number_of_collapses() + 2, 0);
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    births[t] = triangle_birth(triangles[t], mesh);
    ++begin[births[t].order + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  mesh.progressive_mesh.triangles.resize(triangles.size());
  for(std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle_indices& t = triangles[i];
    const std::uint32_t c = births[i].place;
    mesh.progressive_mesh.triangles[begin[births[i].order]++]
      = {t[c], t[(c + 1) % 3], t[(c + 2) % 3]};
  }
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns `mesh`, which has the invariants of `Textured_progressive_mesh` but for the numbering, with
the numbering that they want. Wedges that are never removed and triangles that never die keep their
order, vertices follow their wedges. Linear time.

\pre the wedges of a vertex that are removed at all are removed one directly after the other, and
     either all or none of them.
*/
inline Textured_progressive_mesh coarse_first(const Textured_progressive_mesh& mesh)
{
  const Progressive_mesh& pm = mesh.progressive_mesh;
  const std::size_t n = pm.number_of_vertices, removed = pm.collapses.size();
  // The new number of each wedge; those of the base by vertex, which is a stable counting sort
  std::vector<Vertex_index> wedge(n, no_vertex), source(n);
  for(std::size_t i = 0; i < removed; ++i)
    wedge[pm.collapses[i].removed] = Vertex_index(n - 1 - i);
  std::vector<Vertex_index> begin(mesh.points.size() + 1, 0);
  for(Vertex_index w = 0; w < n; ++w)
    if(wedge[w] == no_vertex)
      ++begin[mesh.vertex[w] + 1];
  for(std::size_t v = 0; v < mesh.points.size(); ++v)
    begin[v + 1] += begin[v];
  for(Vertex_index w = 0; w < n; ++w) {
    if(wedge[w] == no_vertex)
      wedge[w] = begin[mesh.vertex[w]]++;
    source[wedge[w]] = w;
  }

  Textured_progressive_mesh result;
  result.vertex.resize(n);
  result.uv.resize(mesh.uv.size());
  result.points.reserve(mesh.points.size());
  result.source_vertex.reserve(mesh.points.size());
  for(Vertex_index w = 0; w < n; ++w) {
    const Vertex_index v = mesh.vertex[source[w]];
    if(w == 0 || v != mesh.vertex[source[w - 1]]) {
      result.points.push_back(mesh.points[v]);
      result.source_vertex.push_back(mesh.source_vertex.empty() ? v : mesh.source_vertex[v]);
    }
    result.vertex[w] = Vertex_index(result.points.size() - 1);
    if(mesh.has_texture())
      result.uv[w] = mesh.uv[source[w]];
  }
  Progressive_mesh& fine = result.progressive_mesh;
  fine.number_of_vertices = n;
  fine.batch_ends = pm.batch_ends;
  fine.collapses.reserve(removed);
  for(const Halfedge_collapse& c : pm.collapses)
    fine.collapses.push_back({wedge[c.removed], wedge[c.kept]});
  fine.triangles.reserve(pm.triangles.size());
  for(const Triangle_indices& t : pm.triangles)
    fine.triangles.push_back({wedge[t[0]], wedge[t[1]], wedge[t[2]]});
  internal::sort_triangles(result);
  return result;
}

namespace internal {

// For each w the number of triangles of the level that has the first w wedges; for less wedges than
// the coarsest level has, that of the coarsest. A split makes two triangles inside a chart and one
// at its border. Linear time.
inline std::vector<std::uint32_t> triangle_numbers(const Textured_progressive_mesh& mesh)
{
  const std::size_t n = mesh.number_of_wedges();
  const std::size_t base = mesh.number_of_wedges_after(mesh.number_of_collapses());
  const std::vector<Triangle_indices>& triangles = mesh.progressive_mesh.triangles;
  // Round a wedge inside a chart the edges opposite to it close, and their differences add up to
  // zero
  std::vector<Vertex_index> gap(n, 0);
  for(const Triangle_indices& t : triangles)
    for(int c = 0; c < 3; ++c)
      gap[t[c]] += t[(c + 2) % 3] - t[(c + 1) % 3];
  std::vector<std::uint32_t> result(n + 1);
  std::uint32_t number = std::uint32_t(triangles.size());
  for(std::size_t w = n; w > base; --w) {
    result[w] = number;
    number -= gap[w - 1] == 0 ? 2 : 1;
  }
  for(std::size_t w = 0; w <= base; ++w)
    result[w] = number;
  return result;
}

// For each wedge of the level after `fine` collapses the one into which it has collapsed after
// `coarse` collapses.
inline std::vector<Vertex_index> wedge_ancestors(const Textured_progressive_mesh& mesh,
                                                 std::size_t fine, std::size_t coarse)
{
  CGAL_precondition(fine <= coarse);
  const std::size_t kept = mesh.number_of_wedges_after(coarse);
  std::vector<Vertex_index> result(mesh.number_of_wedges_after(fine));
  for(Vertex_index w = 0; w < result.size(); ++w)
    result[w] = w < kept ? w : result[mesh.parent(w)];
  return result;
}

inline Triangle_indices replaced(const Triangle_indices& t, const std::vector<Vertex_index>& by)
{
  return {by[t[0]], by[t[1]], by[t[2]]};
}

// The triangles after k collapses, given the `wedge_ancestors()` of the fine mesh there.
inline std::vector<Triangle_indices> level_triangles(const Textured_progressive_mesh& mesh,
                                                     std::size_t k,
                                                     const std::vector<Vertex_index>& ancestor)
{
  std::vector<Triangle_indices> result(triangle_numbers(mesh)[mesh.number_of_wedges_after(k)]);
  for(std::size_t t = 0; t < result.size(); ++t)
    result[t] = replaced(mesh.progressive_mesh.triangles[t], ancestor);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURED_PROGRESSIVE_MESH_H
