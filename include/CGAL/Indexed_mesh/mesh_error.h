// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_MESH_ERROR_H
#define CGAL_INDEXED_MESH_MESH_ERROR_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>

#include <cmath>
#include <string>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

// The first of these vertices that has no place, as a sentence.
inline std::string point_error(const std::vector<Indexed_triangle_mesh::Point_3>& points)
{
  for(std::size_t v = 0; v < points.size(); ++v)
    for(int c = 0; c < 3; ++c)
      if(!std::isfinite(points[v][c]))
        return "vertex " + std::to_string(v) + " has a coordinate that is not a finite number";
  return {};
}

// What keeps a mesh from being decimated; empty if nothing does. `source` has for each vertex of
// the rings its number in the input.
inline std::string ring_error(const Vertex_rings& rings, const std::vector<Vertex_index>& source)
{
  if(rings.defect() == Ring_defect::NONE)
    return {};
  const std::string vertex = "vertex " + std::to_string(source[rings.defective_vertex()]);
  if(rings.defect() == Ring_defect::ISOLATED)
    return vertex + " has no face; remove it first";
  if(rings.defect() == Ring_defect::REPEATED_HALFEDGE)
    return vertex + " has two edges to the same vertex; repair the mesh first";
  return "the faces at " + vertex + " do not form one fan; split the vertex first";
}

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_MESH_ERROR_H
