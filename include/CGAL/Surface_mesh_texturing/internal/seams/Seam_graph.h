// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Halfedge_triangles.h>

#include <CGAL/assertions.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The edges at which a surface is cut. Edges on the border of the surface are seams that stay.
class Seam_graph
{
public:
  // `seams` as in `Face_charts`, symmetric; the mesh must live as long as the graph.
  Seam_graph(const Halfedge_triangles& mesh, std::vector<std::uint8_t> seams)
    : m_mesh(&mesh)
  {
    set_seams(std::move(seams));
  }

  const Halfedge_triangles& mesh() const { return *m_mesh; }
  Vertex_index source(Halfedge h) const { return m_mesh->source(h); }
  Vertex_index target(Halfedge h) const { return m_mesh->target(h); }
  Halfedge opposite(Halfedge h) const { return m_mesh->opposite(h); }
  bool is_border(Halfedge h) const { return opposite(h) == no_halfedge; }

  bool is_seam(Halfedge h) const { return is_marked(m_seams, h); }
  const std::vector<std::uint8_t>& seams() const { return m_seams; }
  void set_seams(std::vector<std::uint8_t> seams);

  // The number of seams at v, border edges included.
  std::uint32_t degree(Vertex_index v) const { return m_degree[v]; }

  void add_seam(Halfedge h)
  {
    if(!is_seam(h))
      set(h, true, 1);
  }

  void remove_seam(Halfedge h)
  {
    if(is_seam(h) && !is_border(h))
      set(h, false, std::uint32_t(-1));
  }

  // The seam after the seam h around the chart on its left.
  Halfedge next_seam(Halfedge h) const
  {
    h = next_halfedge(h);
    while(!is_seam(h))
      h = next_halfedge(opposite(h));
    return h;
  }

  // Removes the seam that ends within a chart at vertex v, if there is one, as far as the next
  // junction, and appends it to `removed`. One that is all the chart has of a border stays.
  void zip(Vertex_index v, std::vector<Halfedge>& removed)
  {
    if(m_degree[v] != 1)
      return;
    std::vector<Halfedge> path(1, last_seam(v));
    while(m_degree[target(path.back())] == 2)
      path.push_back(next_seam(path.back()));
    if(m_degree[target(path.back())] == 1)
      return;
    for(const Halfedge g : path) {
      remove_seam(g);
      removed.push_back(g);
    }
  }

  // Whether the seam at v ends with its first edge at both sides.
  bool is_single_edge(Vertex_index v) const
  {
    return m_degree[v] == 1 && m_degree[target(last_seam(v))] == 1;
  }

protected:
  // Marks both sides of an edge; degrees stay as they are.
  void mark_edge(Halfedge h, bool is_seam)
  {
    for(const Halfedge g : {h, opposite(h)})
      if(g != no_halfedge)
        is_seam ? mark(m_seams, g) : unmark(m_seams, g);
  }

  std::uint32_t& degree_of(Vertex_index v) { return m_degree[v]; }

private:
  // The seam at v, where there is one only.
  Halfedge last_seam(Vertex_index v) const
  {
    Halfedge h = m_mesh->outgoing(v);
    while(!is_seam(h))
      h = m_mesh->clockwise(h);
    return h;
  }

  void set(Halfedge h, bool is_seam, std::uint32_t change)
  {
    mark_edge(h, is_seam);
    m_degree[source(h)] += change;
    m_degree[target(h)] += change;
  }

  const Halfedge_triangles* m_mesh;
  std::vector<std::uint8_t> m_seams;   // of each triangle, as in `Face_charts`
  std::vector<std::uint32_t> m_degree; // of each vertex
};

inline void Seam_graph::set_seams(std::vector<std::uint8_t> seams)
{
  CGAL_precondition(3 * seams.size() == m_mesh->number_of_halfedges());
  m_seams = std::move(seams);
  m_degree.assign(m_mesh->number_of_vertices(), 0);
  for(Halfedge h = 0; h < m_mesh->number_of_halfedges(); ++h)
    if(is_seam(h) && (is_border(h) || h < opposite(h))) {
      ++m_degree[source(h)];
      ++m_degree[target(h)];
    }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H
