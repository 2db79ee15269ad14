// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_LEVEL_EXTRACTOR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_LEVEL_EXTRACTOR_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Wedge_mesh` is a triangle mesh with texture coordinates whose triangles are given by
wedges, as in a level of a `Textured_progressive_mesh`: a wedge is a vertex with one texture
coordinate, and a vertex on a seam has several.

Invariant: `vertex` and `uv` have the same size; the entries of `vertex` are smaller than
`points.size()`, those of `triangles` smaller than `uv.size()`.
*/
struct Wedge_mesh
{
  typedef Textured_progressive_mesh::Point_2 Point_2; ///< a texture coordinate
  typedef Textured_progressive_mesh::Point_3 Point_3; ///< a point of the surface

  std::vector<Point_3> points;             ///< of each vertex
  std::vector<Vertex_index> vertex;        ///< of each wedge
  std::vector<Point_2> uv;                 ///< of each wedge
  std::vector<Triangle_indices> triangles; ///< the wedges of each triangle
};

namespace internal {

// The first whole position with at most this many triangles, the coarsest if there is none;
// `numbers` are the `triangle_numbers()`.
inline std::size_t position_with(const Textured_progressive_mesh& mesh,
                                 const std::vector<std::uint32_t>& numbers, std::size_t triangles)
{
  const auto beyond = std::upper_bound(numbers.begin(), numbers.end(), triangles);
  const std::size_t collapses = std::size_t(numbers.end() - beyond);
  return mesh.whole_position((std::min)(collapses, mesh.number_of_collapses()));
}

} // namespace internal

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the number of triangles after `k` collapses. Linear time; `Level_extractor` knows it for
/// all `k`. Precondition: there are so many collapses.
inline std::size_t number_of_triangles_after(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses());
  return internal::triangle_numbers(mesh)[mesh.number_of_wedges_after(k)];
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the mesh after `k` collapses, vertices and wedges numbered as in `mesh`. Linear time.
/// Precondition: there are so many collapses, and `mesh.is_whole(k)`.
inline Wedge_mesh textured_level(const Textured_progressive_mesh& mesh, std::size_t k)
{
  CGAL_precondition(k <= mesh.number_of_collapses() && mesh.is_whole(k));
  const std::size_t wedges = mesh.number_of_wedges_after(k);
  Wedge_mesh level;
  level.points.assign(mesh.points.begin(), mesh.points.begin() + mesh.number_of_vertices_after(k));
  level.vertex.assign(mesh.vertex.begin(), mesh.vertex.begin() + wedges);
  level.uv.assign(mesh.uv.begin(), mesh.uv.begin() + (mesh.has_texture() ? wedges : 0));
  level.triangles = internal::level_triangles(mesh, k, internal::wedge_ancestors(mesh, 0, k));
  return level;
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

The class `Level_extractor` returns the triangles of any level of a `Textured_progressive_mesh` in
time proportional to their number.

A level after \f$ k \f$ collapses has the first wedges, vertices and triangles of the fine mesh; a
corner that is not among these wedges has collapsed into one of them. Corners are stored at every
other halving of the mesh, so that few steps lead there. No `k` may be greater than the number of
collapses.

Memory: up to 24 bytes a triangle and 8 a wedge. Construction in linear time.
*/
class Level_extractor
{
public:
  /// Prepares the extraction from `mesh`, which must live as long.
  explicit Level_extractor(const Textured_progressive_mesh& mesh);

  /// Returns the number of triangles after `k` collapses.
  std::size_t number_of_triangles(std::size_t k) const
  {
    return m_triangles_before[m_mesh.number_of_wedges_after(k)];
  }

  /// Returns the number of triangles of the coarsest level.
  std::size_t smallest_number_of_triangles() const
  {
    return number_of_triangles(m_mesh.number_of_collapses());
  }

  /// Returns the smallest number of collapses after which there are at most `n` triangles and the
  /// level is whole; all collapses if no level has so few. Logarithmic time.
  std::size_t position_of_triangles(std::size_t n) const
  {
    return internal::position_with(m_mesh, m_triangles_before, n);
  }

  /// Returns the triangles after `k` collapses, as indices of wedges.
  std::vector<Triangle_indices> triangles(std::size_t k) const
  {
    std::vector<Triangle_indices> result;
    extract(k, result);
    return result;
  }

  /// Sets `result` to the triangles after `k` collapses, as indices of wedges.
  void extract(std::size_t k, std::vector<Triangle_indices>& result) const;

  /// Returns the mesh after `k` collapses: its vertices and wedges are the first ones of the fine
  /// mesh. Without texture `uv` is empty.
  Textured_triangle_mesh mesh(std::size_t k) const;

  /// Returns for each wedge of the level after `fine` collapses the one into which it has collapsed
  /// after `coarse` collapses: a geomorph (Hoppe 1996) between the two levels draws the triangles
  /// of the fine one with wedge \f$ w \f$ at \f$ (1 - \alpha) x_w + \alpha x_{a(w)} \f$, its
  /// texture coordinate likewise. Precondition: `fine <= coarse`.
  std::vector<Vertex_index> ancestors(std::size_t fine, std::size_t coarse) const
  {
    return internal::wedge_ancestors(m_mesh, fine, coarse);
  }

private:
  Vertex_index ancestor(Vertex_index w, Vertex_index end) const
  {
    while(w >= end)
      w = m_parent[w];
    return w;
  }

  struct Halving
  {
    std::size_t wedges;
    std::vector<Triangle_indices> triangles;
  };

  const Textured_progressive_mesh& m_mesh;
  std::vector<Vertex_index> m_parent;
  std::vector<std::uint32_t> m_triangles_before; // triangles of the mesh of the first w wedges
  std::vector<Halving> m_halvings;               // from fine to coarse, without the fine mesh
};

inline Level_extractor::Level_extractor(const Textured_progressive_mesh& mesh)
  : m_mesh(mesh), m_parent(mesh.number_of_wedges(), no_vertex)
  , m_triangles_before(internal::triangle_numbers(mesh))
{
  const std::size_t n = mesh.number_of_wedges();
  const std::size_t base = mesh.number_of_wedges_after(mesh.number_of_collapses());
  for(Vertex_index w = Vertex_index(base); w < n; ++w)
    m_parent[w] = mesh.parent(w);
  for(std::size_t wedges = n / 2; wedges > (std::max)(base, std::size_t(64)); wedges /= 2) {
    Halving halving = {wedges, {}};
    extract(n - wedges, halving.triangles);
    m_halvings.push_back(std::move(halving));
  }
}

inline void Level_extractor::extract(std::size_t k, std::vector<Triangle_indices>& result) const
{
  CGAL_precondition(k <= m_mesh.number_of_collapses());
  const Vertex_index end = Vertex_index(m_mesh.number_of_wedges_after(k));
  const std::vector<Triangle_indices>* source = &m_mesh.progressive_mesh.triangles;
  for(const Halving& halving : m_halvings)
    if(halving.wedges >= end)
      source = &halving.triangles;
  const std::size_t number = number_of_triangles(k);
  result.resize(number);
  for(std::size_t t = 0; t < number; ++t)
    for(int c = 0; c < 3; ++c)
      result[t][c] = ancestor((*source)[t][c], end);
}

inline Textured_triangle_mesh Level_extractor::mesh(std::size_t k) const
{
  Textured_triangle_mesh result;
  extract(k, result.wedges);
  result.points.assign(m_mesh.points.begin(),
                       m_mesh.points.begin() + m_mesh.number_of_vertices_after(k));
  if(m_mesh.has_texture())
    result.uv.assign(m_mesh.uv.begin(), m_mesh.uv.begin() + m_mesh.number_of_wedges_after(k));
  result.triangles.reserve(result.wedges.size());
  for(const Triangle_indices& t : result.wedges)
    result.triangles.push_back({m_mesh.vertex[t[0]], m_mesh.vertex[t[1]], m_mesh.vertex[t[2]]});
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_LEVEL_EXTRACTOR_H
