// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_ARCS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_ARCS_H

#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_net.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// One end of an arc.
struct Arc_end
{
  Vertex_index node;
  std::uint32_t arc;
  bool is_last; // the end of the last halfedge, not the beginning of the first
};

// The seams inside a surface as paths between *nodes*, which are junctions, ends of seams, pinned
// vertices, and vertices on the border of the surface. Arcs without nodes are closed.
struct Seam_arcs
{
  std::vector<std::vector<Halfedge>> arcs;
  std::vector<Arc_end> ends; // by node
};

inline bool is_seam_node(const Seam_net& graph, Vertex_index v)
{
  return graph.degree(v) != 2 || graph.is_border(v) || graph.is_pinned(v);
}

// The other seam at the end of h, which is no node, as a halfedge from there.
inline Halfedge next_seam(const Seam_net& graph, Halfedge h)
{
  Halfedge g = next_halfedge(h);
  while(!graph.is_seam(g))
    g = next_halfedge(graph.mesh().opposite(g));
  return g;
}

// The arcs in the order of their first halfedges. Time linear in the number of triangles; but for a
// look at each, in that of the seams.
inline Seam_arcs find_seam_arcs(const Seam_net& graph)
{
  Seam_arcs result;
  const Linked_triangles& mesh = graph.mesh();
  std::vector<std::uint8_t> is_done(graph.seams().size(), 0);
  const auto trace = [&](Halfedge h) {
    std::vector<Halfedge> arc;
    const Vertex_index first = mesh.source(h);
    for(;; h = next_seam(graph, h)) {
      arc.push_back(h);
      is_done[h / 3] |= std::uint8_t(1u << h % 3);
      const Halfedge o = mesh.opposite(h);
      is_done[o / 3] |= std::uint8_t(1u << o % 3);
      if(mesh.target(h) == first || is_seam_node(graph, mesh.target(h)))
        break;
    }
    result.arcs.push_back(std::move(arc));
  };
  const auto trace_all = [&](bool from_nodes) {
    for(std::uint32_t t = 0; t < is_done.size(); ++t)
      if(graph.seams()[t] != is_done[t])
        for(Halfedge h = 3 * t; h < 3 * t + 3; ++h)
          if(graph.is_seam(h) && !(is_done[t] >> h % 3 & 1) && mesh.opposite(h) != no_halfedge
             && (!from_nodes || is_seam_node(graph, mesh.source(h))))
            trace(h);
  };
  trace_all(true);
  trace_all(false);
  for(std::uint32_t a = 0; a < result.arcs.size(); ++a) {
    const Vertex_index first = mesh.source(result.arcs[a].front());
    const Vertex_index last = mesh.target(result.arcs[a].back());
    if(is_seam_node(graph, first)) {
      result.ends.push_back({first, a, false});
      result.ends.push_back({last, a, true});
    }
  }
  std::sort(result.ends.begin(), result.ends.end(), [](const Arc_end& x, const Arc_end& y) {
    return std::tie(x.node, x.arc, x.is_last) < std::tie(y.node, y.arc, y.is_last);
  });
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_ARCS_H
