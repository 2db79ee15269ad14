// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_IS_SIMPLE_BORDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_IS_SIMPLE_BORDER_H

#include <CGAL/Surface_mesh_parameterization/internal/overlap.h>
#include <CGAL/Surface_mesh_texturing/internal/border_edges.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Whether the images of no two border edges of a mesh, all of which are given, have a point in
// common, the vertex between two successive ones aside. Then a map of a disk whose triangles all
// have a positive area is one-to-one: see `Surface_mesh_parameterization::certify_map()`.
inline bool
is_simple_border(const std::vector<Border_edge>& border,
                 const std::vector<Simple_cartesian<double>::Point_2>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  const auto point = [&uv](Surface_mesh_multiresolution::Vertex_index v) {
    return SMP::internal::Uv_point(uv[v].x(), uv[v].y());
  };
  std::vector<std::pair<Bbox_2, Border_edge>> items;
  for(const Border_edge& e : border)
    items.push_back({point(e[0]).bbox() + point(e[1]).bbox(), e});
  return !SMP::internal::any_pair_of_boxes(items, [&](const Border_edge& e, const Border_edge& f) {
    if(e[0] == f[1] && e[1] != f[0])
      return SMP::internal::successive_segments_meet(point(f[0]), point(f[1]), point(e[1]));
    if(e[1] == f[0] && e[0] != f[1])
      return SMP::internal::successive_segments_meet(point(e[0]), point(e[1]), point(f[1]));
    return SMP::internal::segments_meet(point(e[0]), point(e[1]), point(f[0]), point(f[1]));
  });
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_IS_SIMPLE_BORDER_H
