// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_WELD_POINTS_H
#define CGAL_INDEXED_MESH_WELD_POINTS_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>
#include <CGAL/Indexed_mesh/internal/Point_buckets.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/*!
\ingroup PkgHLSCMIndexedMesh

Merges the vertices of a soup that lie in one place, as files without indices have them, and returns
how many there are less then.

The vertices are taken in their order. Each becomes the first of those kept so far that is not
farther than the distance; if there is none, it is kept itself, at its place. So no chain forms:
a vertex is never farther than the distance from the one that it became, and those that are kept lie
farther than it from each other, both up to rounding. The result depends on nothing but the order of
the vertices.

Faces and texture coordinates keep their numbers. A face may have a vertex twice afterwards, which
`surface_of_soup()` takes.

\param soup the soup. Precondition: its corners are smaller than its number of vertices
\param distance how far apart vertices may lie that become one, in the units of the points. With 0,
  only equal points do; -0 is equal to 0. Points that are not finite stay alone. Precondition: not
  negative

Expected time and memory are linear, unless very many points crowd within \f$ 2^{-40} \f$ of the
largest coordinate and are farther apart than the distance.
*/
inline std::size_t weld_points(Polygon_soup& soup, double distance)
{
  CGAL_precondition(distance >= 0);
  typedef Polygon_soup::Point_3 Point_3;
  const std::size_t n = soup.points.size();
  std::vector<Point_3>& points = soup.points; // those that are kept move to the front
  internal::Point_buckets buckets(points, distance);
  std::vector<Vertex_index> number(n);
  Vertex_index kept = 0;
  for(std::size_t v = 0; v < n; ++v) {
    const Point_3 p = points[v];
    number[v] = buckets.find(points, p);
    if(number[v] == no_vertex) {
      points[kept] = p;
      buckets.add(p, kept);
      number[v] = kept++;
    }
  }
  points.resize(kept);
  for(Vertex_index& v : soup.corners)
    v = number[v];
  return n - kept;
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_WELD_POINTS_H
