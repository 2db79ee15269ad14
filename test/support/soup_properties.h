// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_SOUP_PROPERTIES_H
#define HLSCM_TEST_SUPPORT_SOUP_PROPERTIES_H

#include <support/polygon_soups.h>

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Indexed_mesh/surface_of_soup.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

// What the surface of a soup is to be: each returns what is wrong, or nothing.

namespace test_support {

using CGAL::Indexed_mesh::Surface_of_soup;

// The way back to the soup.
inline std::string source_error(const Polygon_soup& soup, const Surface_of_soup& s)
{
  using namespace CGAL::Indexed_mesh;
  const std::size_t n = s.mesh.triangles.size();
  if(s.corners.size() != n || s.face.size() != n || s.diagonals.size() != n
     || s.vertex.size() != s.mesh.points.size())
    return "the arrays have wrong sizes";
  if(!std::is_sorted(s.vertex.begin(), s.vertex.end())
     || !std::is_sorted(s.face.begin(), s.face.end()))
    return "the order is not that of the soup";
  for(std::size_t v = 0; v < s.vertex.size(); ++v)
    if(s.mesh.points[v] != soup.points[s.vertex[v]])
      return "vertex " + std::to_string(v) + " has moved";
  for(Halfedge h = 0; h < 3 * n; ++h) {
    const std::uint32_t corner = vertex_of(s.corners, h), f = s.face[triangle_of(h)];
    if(corner < soup.first_corner[f] || corner >= soup.first_corner[f + 1])
      return "a corner is not one of the face";
    if(soup.corners[corner] != s.vertex[vertex_of(s.mesh.triangles, h)])
      return "a corner has another vertex";
  }
  return {};
}

// Diagonals have both triangles in one face, and other edges of a face are edges of the polygon.
inline std::string diagonal_error(const Surface_of_soup& s)
{
  using namespace CGAL::Indexed_mesh;
  const Triangle_adjacency adjacency(s.mesh.triangles);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const bool is_diagonal = (s.diagonals[triangle_of(h)] >> (h % 3) & 1) != 0;
    const Halfedge o = adjacency.opposite(h);
    if(is_diagonal && o != no_halfedge && s.face[triangle_of(o)] != s.face[triangle_of(h)])
      return "a diagonal joins two faces";
    if(!is_diagonal && o != no_halfedge && s.face[triangle_of(o)] == s.face[triangle_of(h)]
       && (s.diagonals[triangle_of(o)] >> (o % 3) & 1) != 0)
      return "an edge is a diagonal of one triangle only";
  }
  return {};
}

// An oriented manifold that leads back to the soup.
inline std::string surface_of_soup_error(const Polygon_soup& soup, const Surface_of_soup& s)
{
  for(const std::string& error :
      {CGAL::Indexed_mesh::manifold_error(s.mesh), source_error(soup, s)})
    if(!error.empty())
      return error;
  return diagonal_error(s);
}

// There is nothing more to mend.
inline std::string second_repair_error(const Surface_of_soup& s)
{
  const Polygon_soup soup = to_soup(s.mesh);
  const Surface_of_soup again = CGAL::Indexed_mesh::surface_of_soup(soup);
  const auto sentences = again.repairs.sentences();
  if(!sentences.empty())
    return "mended a second time: " + sentences.front();
  if(again.mesh.triangles != s.mesh.triangles)
    return "other triangles the second time";
  return CGAL::Indexed_mesh::diagnose_soup(soup).is_surface() ? "" : "no surface by its diagnosis";
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_SOUP_PROPERTIES_H
