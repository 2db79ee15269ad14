// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_SURFACE_OF_SOUP_H
#define CGAL_INDEXED_MESH_SURFACE_OF_SOUP_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/Soup_diagnosis.h>
#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Indexed_mesh/internal/Soup_sides.h>
#include <CGAL/Indexed_mesh/internal/Soup_triangles.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// What `surface_of_soup()` did, by the indices of the soup.
struct Soup_repairs
{
  Soup_finding triangulated; ///< faces cut into triangles, with their number of corners
  Soup_finding folded;       ///< faces that use a vertex twice; what is left of them is taken
  Soup_finding collapsed;    ///< faces left out, as they have less than three different vertices
  Soup_finding duplicate;    ///< faces left out, each with the face of the same vertices that stays
  Soup_finding turned;       ///< faces taken in the opposite direction
  Soup_finding cut;          ///< edges cut since the surface has one side only there: two vertices
  Soup_finding separated;    ///< edges with three or more faces, which do not all stay joined
  Soup_finding split;        ///< vertices that joined separate fans of faces, with their number
  Soup_finding isolated;     ///< vertices of no face, left out

  /// Returns a sentence for each kind of repair that was made.
  std::vector<std::string> sentences() const;
};

/*!
\ingroup PkgHLSCMIndexedMesh

What `surface_of_soup()` returns: an oriented manifold of triangles and the way back to the soup.
*/
struct Surface_of_soup
  : Mesh_outcome
{
  Indexed_triangle_mesh mesh;        ///< see `manifold_error()`: it has none
  std::vector<Vertex_index> vertex;  ///< for each vertex of `mesh` the one of the soup; ascending
  std::vector<Triangle_indices> corners; ///< for each triangle the corners of the soup, of one face
  std::vector<std::uint32_t> face;   ///< for each triangle the face of the soup; ascending
  /// Of each triangle, three bits: whether an edge is a diagonal of its face of the soup. Bit
  /// \f$ c \f$ stands for the edge between the corners \f$ c \f$ and \f$ (c + 1) \bmod 3 \f$.
  std::vector<std::uint8_t> diagonals;
  /// Faces that were left out for others: a pair of each and the one that stays for it.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> duplicates;
  Soup_repairs repairs; ///< what was done
};

/*!
\ingroup PkgHLSCMIndexedMesh

Returns the surface that a soup is meant to be. Nothing moves, and what can stay together does:

- faces of more than three corners are cut into triangles along diagonals, concave ones and such with
  holes that a bridge joins to the rim, too;
- of faces with the same vertices the first one stays; faces without three different vertices are
  left out, and vertices without a face;
- at an edge of more than two faces, those stay joined that continue each other within 45 degrees,
  if they agree about the two sides of the surface; the others have their border there;
- faces are turned until neighbours agree, as few as possible in each component; where that cannot
  be, on a Moebius strip or a Klein bottle, the surface is cut along edges;
- a vertex where several fans of faces meet becomes one vertex for each fan.

Faces without area stay. Errors: `soup_error()`, and no face is left.

Time \f$ O(n \log d) \f$ for degrees up to \f$ d \f$. About 120 bytes a triangle of temporary memory.
*/
Surface_of_soup surface_of_soup(const Polygon_soup& soup);

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the same where `diagnosis` is what `diagnose_soup()` returned: what is an oriented manifold
/// of triangles already is only copied.
Surface_of_soup surface_of_soup(const Polygon_soup& soup, const Soup_diagnosis& diagnosis);

/*!
\ingroup PkgHLSCMIndexedMesh

Returns for each corner of a soup the texture coordinate that a map of its surface gives it.

\param soup the soup
\param surface what `surface_of_soup()` returned for it
\param wedges for each triangle of `surface.mesh` the texture coordinates of its corners, as indices

\return for each of `soup.corners` an index; corners of a face that was left out have that of the
face which stays for it, or that of another corner of their vertex, or of their face; or `no_vertex`,
which all corners of a face have then.
Where both triangles at a diagonal have different ones for the same corner, it is that of the first;
see `cut_faces()`.

Linear time.
*/
std::vector<std::uint32_t> uv_corners_of_soup(const Polygon_soup& soup,
                                              const Surface_of_soup& surface,
                                              const std::vector<Triangle_indices>& wedges);

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the faces of a soup with a corner for which its triangles have different texture
/// coordinates: a seam runs along a diagonal. Ascending. Linear time.
std::vector<std::uint32_t> cut_faces(const Polygon_soup& soup, const Surface_of_soup& surface,
                                     const std::vector<Triangle_indices>& wedges);

/// \ingroup PkgHLSCMIndexedMesh
/// Returns the first vertex of the surface that stands for a vertex of the soup, or `no_vertex`.
/// Logarithmic time.
inline Vertex_index vertex_of_surface(const Surface_of_soup& surface, std::size_t v)
{
  const auto found = std::lower_bound(surface.vertex.begin(), surface.vertex.end(), v);
  return found != surface.vertex.end() && *found == v
         ? Vertex_index(found - surface.vertex.begin()) : no_vertex;
}

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE std::vector<std::string> Soup_repairs::sentences() const
{
  std::vector<std::string> all;
  const auto say = [&all](const Soup_finding& finding, const std::string& one,
                          const std::string& several) {
    const std::string first = std::to_string(finding.first[0]);
    if(finding.count == 1)
      all.push_back("1 " + one + " (" + first + ")");
    else if(finding)
      all.push_back(std::to_string(finding.count) + " " + several + " (" + first + " and others)");
  };
  const auto say_of_edges = [&all](const Soup_finding& finding, const std::string& what) {
    if(finding)
      all.push_back(std::to_string(finding.count) + (finding.count == 1 ? " edge " : " edges ")
                    + what + " (the first between vertices " + std::to_string(finding.first[0])
                    + " and " + std::to_string(finding.first[1]) + ")");
  };
  say(triangulated, "face has more than three corners: it is cut into triangles for the computation",
      "faces have more than three corners: they are cut into triangles for the computation");
  say(folded, "face uses a vertex twice: what is left of it is taken",
      "faces use a vertex twice: what is left of them is taken");
  say(collapsed, "face has less than three different vertices: it is left out",
      "faces have less than three different vertices: they are left out");
  say(duplicate, "face has the same vertices as another one: it is left out",
      "faces have the same vertices as others: they are left out");
  say_of_edges(separated, "with more than two faces: only faces that continue each other stay joined");
  say(turned, "face ran the other way round than its neighbours: it is turned",
      "faces ran the other way round than their neighbours: they are turned");
  say_of_edges(cut, "cut open, since the surface has one side only");
  say(split, "vertex joined separate fans of faces: each fan has its own now",
      "vertices joined separate fans of faces: each fan has its own now");
  say(isolated, "vertex is in no face: it is left out", "vertices are in no face: they are left out");
  return all;
}

namespace internal {

// Gives each fan of triangles at a vertex of the soup a vertex of its own.
inline void number_vertices(const Polygon_soup& soup, const Soup_sides& sides,
                            const Soup_triangles& triangles, Surface_of_soup& result)
{
  const std::size_t corners = 3 * triangles.vertices.size();
  const std::vector<Halfedge> first
    = first_corners_of_wedges(corners, [&sides](Halfedge h) { return sides.opposite(h); });
  std::vector<std::uint32_t> next(soup.points.size() + 1, 0); // number of the vertices of each
  for(Halfedge h = 0; h < corners; ++h)
    next[vertex_of(triangles.vertices, h) + 1] += first[h] == h;
  result.repairs.isolated = result.repairs.split = Soup_finding();
  for(std::size_t v = 0; v < soup.points.size(); ++v) {
    if(next[v + 1] == 0)
      result.repairs.isolated.add(v);
    else if(next[v + 1] > 1)
      result.repairs.split.add(v, next[v + 1]);
    next[v + 1] += next[v];
  }
  result.vertex.resize(next.back());
  result.mesh.points.resize(next.back());
  result.mesh.triangles.resize(triangles.vertices.size());
  for(Halfedge h = 0; h < corners; ++h) {
    Vertex_index& vertex = result.mesh.triangles[triangle_of(h)][corner_of(h)];
    if(first[h] != h) {
      vertex = vertex_of(result.mesh.triangles, first[h]);
      continue;
    }
    const Vertex_index v = vertex_of(triangles.vertices, h);
    vertex = next[v]++;
    result.vertex[vertex] = v;
    result.mesh.points[vertex] = soup.points[v];
  }
}

inline void tell_turned_faces(const Soup_triangles& triangles, Soup_repairs& repairs)
{
  for(std::size_t t = 0; t < triangles.face.size(); ++t)
    if(triangles.is_turned[t] && (t == 0 || triangles.face[t] != triangles.face[t - 1]))
      repairs.turned.add(triangles.face[t]);
}

} // namespace internal

CGAL_HLSCM_INLINE Surface_of_soup surface_of_soup(const Polygon_soup& soup)
{
  Surface_of_soup result;
  if(result.fail(Mesh_status::BAD_MESH, soup_error(soup)))
    return result;
  internal::Soup_triangles triangles(soup);
  if(triangles.vertices.empty()) {
    result.fail(Mesh_status::BAD_MESH, "no face has three different vertices");
    return result;
  }
  typedef internal::Crossing_joints Joints;
  for(const Joints joints : {Joints::ALL, Joints::DIAGONALS, Joints::NONE}) {
    internal::Soup_sides sides(soup, triangles, joints);
    sides.turn(triangles);
    internal::number_vertices(soup, sides, triangles, result);
    result.repairs.cut = sides.cut;
    result.repairs.separated = sides.separated;
    if(sides.separated && joints != Joints::NONE // joined fans may, rarely, meet an edge twice
       && Vertex_rings(result.mesh).defect() != Ring_defect::NONE)
      continue;
    for(Halfedge h = 0; triangles.triangulated && h < 3 * triangles.vertices.size(); ++h)
      if(!sides.is_within_face(h))
        triangles.diagonals[triangle_of(h)] &= std::uint8_t(~(1u << corner_of(h)));
    break;
  }
  result.repairs.triangulated = triangles.triangulated;
  result.repairs.folded = triangles.folded;
  result.repairs.collapsed = triangles.collapsed;
  result.repairs.duplicate = triangles.duplicate;
  internal::tell_turned_faces(triangles, result.repairs);
  result.corners = std::move(triangles.corners);
  result.face = std::move(triangles.face);
  result.diagonals = std::move(triangles.diagonals);
  result.duplicates = std::move(triangles.duplicates);
  return result;
}

namespace internal {

// Triangles that are a surface already.
inline Surface_of_soup copy_surface(const Polygon_soup& soup)
{
  Surface_of_soup surface;
  surface.mesh.points = soup.points;
  surface.vertex.resize(soup.points.size());
  std::iota(surface.vertex.begin(), surface.vertex.end(), Vertex_index(0));
  const std::uint32_t n = std::uint32_t(soup.number_of_faces());
  surface.mesh.triangles.resize(n);
  surface.corners.resize(n);
  surface.face.resize(n);
  surface.diagonals.assign(n, 0);
  for(std::uint32_t t = 0, c = 0; t < n; ++t, c += 3) {
    surface.mesh.triangles[t] = {soup.corners[c], soup.corners[c + 1], soup.corners[c + 2]};
    surface.corners[t] = {c, c + 1, c + 2};
    surface.face[t] = t;
  }
  return surface;
}

// For each corner of a soup the texture coordinate that the first of its triangles gives it.
inline std::vector<std::uint32_t> first_wedges(const Polygon_soup& soup,
                                               const Surface_of_soup& surface,
                                               const std::vector<Triangle_indices>& wedges)
{
  std::vector<std::uint32_t> uv(soup.corners.size(), no_vertex);
  for(Halfedge h = 0; h < 3 * wedges.size(); ++h) {
    std::uint32_t& entry = uv[vertex_of(surface.corners, h)];
    if(entry == no_vertex)
      entry = vertex_of(wedges, h);
  }
  return uv;
}

// Gives corners of faces without a triangle the texture coordinates of others of their vertex.
inline void give_to_others(const Polygon_soup& soup, const Surface_of_soup& surface,
                           std::vector<std::uint32_t>& uv)
{
  const auto give = [&](std::uint32_t f, std::uint32_t from) { // to face f, from a face
    for(std::uint32_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c)
      for(std::uint32_t d = soup.first_corner[from]; uv[c] == no_vertex
                                                     && d < soup.first_corner[from + 1]; ++d)
        if(soup.corners[d] == soup.corners[c])
          uv[c] = uv[d];
  };
  for(const auto& pair : surface.duplicates)
    give(pair.first, pair.second);
  if(std::find(uv.begin(), uv.end(), no_vertex) == uv.end())
    return;
  for(std::uint32_t f = 0; f < soup.number_of_faces(); ++f)
    give(f, f);
  std::vector<std::uint32_t> any(soup.points.size(), no_vertex);
  for(std::size_t c = uv.size(); c-- > 0;)
    if(uv[c] != no_vertex)
      any[soup.corners[c]] = uv[c];
  for(std::size_t c = 0; c < uv.size(); ++c)
    if(uv[c] == no_vertex)
      uv[c] = any[soup.corners[c]];
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto begin = uv.begin() + soup.first_corner[f], end = uv.begin() + soup.first_corner[f + 1];
    const auto some
      = std::find_if(begin, end, [](std::uint32_t entry) { return entry != no_vertex; });
    if(some != end)
      std::replace(begin, end, std::uint32_t(no_vertex), std::uint32_t(*some));
  }
}

} // namespace internal

CGAL_HLSCM_INLINE Surface_of_soup surface_of_soup(const Polygon_soup& soup,
                                                  const Soup_diagnosis& diagnosis)
{
  return diagnosis.is_surface() ? internal::copy_surface(soup) : surface_of_soup(soup);
}

CGAL_HLSCM_INLINE std::vector<std::uint32_t>
uv_corners_of_soup(const Polygon_soup& soup, const Surface_of_soup& surface,
                   const std::vector<Triangle_indices>& wedges)
{
  std::vector<std::uint32_t> uv = internal::first_wedges(soup, surface, wedges);
  internal::give_to_others(soup, surface, uv);
  return uv;
}

CGAL_HLSCM_INLINE std::vector<std::uint32_t> cut_faces(const Polygon_soup& soup,
                                                       const Surface_of_soup& surface,
                                                       const std::vector<Triangle_indices>& wedges)
{
  const std::vector<std::uint32_t> uv = internal::first_wedges(soup, surface, wedges);
  std::vector<std::uint32_t> result;
  for(Halfedge h = 0; h < 3 * wedges.size(); ++h) {
    const std::uint32_t face = surface.face[triangle_of(h)];
    if(uv[vertex_of(surface.corners, h)] != vertex_of(wedges, h)
       && (result.empty() || result.back() != face))
      result.push_back(face);
  }
  return result;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_SURFACE_OF_SOUP_H
