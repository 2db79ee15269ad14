// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_PINS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_PINS_H

#include "../charts/chart_io.h"

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

namespace side_by_side {

using charts::Kernel;
using charts::Surface_mesh;
using Vertex = Surface_mesh::Vertex_index;
using Halfedge = Surface_mesh::Halfedge_index;
using Uv_map = Surface_mesh::Property_map<Vertex, Kernel::Point_2>;

// Two border vertices and where they go: the same for all methods.
using Pins = std::array<std::pair<Vertex, Kernel::Point_2>, 2>;

// Two border vertices far from each other: each is the farthest from the other. They go to (0, 0)
// and (1, 0). Throws if there is no border. Complexity: a few passes over the border.
inline Pins far_border_pins(const Surface_mesh& mesh)
{
  std::vector<Vertex> border;
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
      border.push_back(mesh.target(h));
  if(border.empty())
    throw std::runtime_error("the surface is closed");
  const auto farthest_from = [&](Vertex v) {
    Vertex best = v;
    for(Vertex w : border)
      if(CGAL::squared_distance(mesh.point(v), mesh.point(w))
         > CGAL::squared_distance(mesh.point(v), mesh.point(best)))
        best = w;
    return best;
  };
  Vertex a = border.front(), b = farthest_from(a);
  for(Vertex c = farthest_from(b); c != a; c = farthest_from(b)) {
    if(CGAL::squared_distance(mesh.point(b), mesh.point(c))
       <= CGAL::squared_distance(mesh.point(b), mesh.point(a)))
      break; // equally far
    a = b;
    b = c;
  }
  return {{{a, Kernel::Point_2(0, 0)}, {b, Kernel::Point_2(1, 0)}}};
}

// A halfedge on the border.
inline Halfedge border_halfedge(const Surface_mesh& mesh)
{
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
      return h;
  return Surface_mesh::null_halfedge();
}

// The border parameterizer that pins given vertices at given places, for CGAL's LSCM.
class Pins_parameterizer
{
public:
  Pins_parameterizer() = default;
  explicit Pins_parameterizer(const Pins& pins) : m_pins(pins) {}

  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  CGAL::Surface_mesh_parameterization::Error_code parameterize(const Surface_mesh&, Halfedge,
                                                               VertexUVMap uvmap, VertexIndexMap,
                                                               VertexParameterizedMap vpmap) const
  {
    for(const auto& [vertex, uv] : m_pins) {
      put(uvmap, vertex, uv);
      put(vpmap, vertex, true);
    }
    return CGAL::Surface_mesh_parameterization::OK;
  }

private:
  Pins m_pins;
};

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_PINS_H
