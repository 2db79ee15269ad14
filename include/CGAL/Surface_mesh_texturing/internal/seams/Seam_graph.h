// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <CGAL/assertions.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A triangle mesh that halfedge collapses make coarser and vertex splits finer again.
//
//          L              L        A collapse of r into k links the neighbours a and b of a dying
//      a /   \ b        a | b      triangle to each other. The dying triangle keeps its links and
//       /     \     ->    |        vertices, so that the split finds everything in it: the doubly
//      r --e-> k          k        linked list of which Knuth says that its links dance.
//
// Every triangle keeps its number and corners.
class Halfedge_triangles
{
public:
  Halfedge_triangles(const std::vector<Triangle_indices>& triangles, std::size_t number_of_vertices)
    : m_triangles(triangles), m_opposite(Triangle_adjacency(triangles).take())
    , m_outgoing(number_of_vertices, no_halfedge)
  {
    for(Halfedge h = 0; h < m_opposite.size(); ++h)
      m_outgoing[source(h)] = h;
  }

  std::size_t number_of_halfedges() const { return m_opposite.size(); }
  std::size_t number_of_vertices() const { return m_outgoing.size(); }

  Halfedge opposite(Halfedge h) const { return m_opposite[h]; }
  Vertex_index source(Halfedge h) const { return vertex_of(m_triangles, h); }
  Vertex_index target(Halfedge h) const { return source(next_halfedge(h)); }

  // A halfedge from v; `no_halfedge` if v has no triangle.
  Halfedge outgoing(Vertex_index v) const { return m_outgoing[v]; }

  // The next halfedges from the same vertex, or `no_halfedge` beyond the border. Counterclockwise
  // the last edge at a border vertex has no halfedge from it, but one to it.
  Halfedge counterclockwise(Halfedge h) const { return m_opposite[previous_halfedge(h)]; }
  Halfedge clockwise(Halfedge h) const
  {
    const Halfedge o = m_opposite[h];
    return o == no_halfedge ? o : next_halfedge(o);
  }

  // Calls use(h) for the halfedges from the source of h, until use returns false.
  template <class Use>
  void for_each_outgoing(Halfedge h, const Use& use) const
  {
    Halfedge g = h;
    do {
      if(!use(g))
        return;
      g = counterclockwise(g);
    } while(g != h && g != no_halfedge);
    if(g == h)
      return;
    for(g = clockwise(h); g != no_halfedge; g = clockwise(g))
      if(!use(g))
        return;
  }

  // Collapses r into k and returns a halfedge between them, which `split()` wants back;
  // `no_halfedge`, and nothing done, if there is none.
  Halfedge collapse(Vertex_index r, Vertex_index k);

  // Undoes the collapse that returned e. r is the vertex that it removed.
  void split(Halfedge e, Vertex_index r);

  // Calls use(d) for the one or two triangles at the edge e that a collapse removes or a split has
  // made; e is as `collapse()` returns it.
  template <class Use>
  void for_each_dying(Halfedge e, Vertex_index r, const Use& use) const
  {
    use(dying(e, r));
    if(m_opposite[e] != no_halfedge)
      use(dying(m_opposite[e], r));
  }

  // A triangle at a collapsed edge: its other halfedges, and its corners at both ends.
  struct Dying
  {
    Halfedge side_of_r, side_of_k;
    Halfedge corner_of_r, corner_of_k;
  };

private:
  Dying dying(Halfedge e, Vertex_index r) const
  {
    return source(e) == r ? Dying{previous_halfedge(e), next_halfedge(e), e, next_halfedge(e)}
                          : Dying{next_halfedge(e), previous_halfedge(e), next_halfedge(e), e};
  }

  // Writes v to the corners around the source of a halfedge.
  void rename(Halfedge outgoing, Vertex_index v)
  {
    for_each_outgoing(outgoing, [&](Halfedge h) {
      m_triangles[triangle_of(h)][corner_of(h)] = v;
      return true;
    });
  }

  void note_outgoing(Halfedge h)
  {
    if(h == no_halfedge)
      return;
    m_outgoing[source(h)] = h;
    m_outgoing[target(h)] = next_halfedge(h);
  }

  std::vector<Triangle_indices> m_triangles;
  std::vector<Halfedge> m_opposite;
  std::vector<Halfedge> m_outgoing; // of each vertex
};

inline Halfedge Halfedge_triangles::collapse(Vertex_index r, Vertex_index k)
{
  Halfedge e = no_halfedge;
  for_each_outgoing(m_outgoing[r], [&](Halfedge h) {
    if(target(h) == k)
      e = h;
    else if(source(previous_halfedge(h)) == k)
      e = previous_halfedge(h);
    return e == no_halfedge;
  });
  if(e == no_halfedge)
    return e;
  Dying all[2];
  int n = 0;
  for_each_dying(e, r, [&](const Dying& d) { all[n++] = d; });
  rename(all[0].corner_of_r, k);
  for(int i = 0; i < n; ++i) {
    const Dying& d = all[i];
    m_triangles[triangle_of(d.corner_of_r)][corner_of(d.corner_of_r)] = r;
    const Halfedge a = m_opposite[d.side_of_r], b = m_opposite[d.side_of_k];
    if(a != no_halfedge)
      m_opposite[a] = b;
    if(b != no_halfedge)
      m_opposite[b] = a;
    note_outgoing(a);
    note_outgoing(b);
  }
  return e;
}

inline void Halfedge_triangles::split(Halfedge e, Vertex_index r)
{
  for_each_dying(e, r, [&](const Dying& d) {
    const Halfedge a = m_opposite[d.side_of_r], b = m_opposite[d.side_of_k];
    if(a != no_halfedge)
      m_opposite[a] = d.side_of_r;
    if(b != no_halfedge)
      m_opposite[b] = d.side_of_k;
  });
  const Dying d = dying(e, r);
  rename(d.corner_of_r, r);
  m_outgoing[r] = d.corner_of_r;
  m_outgoing[source(d.corner_of_k)] = d.corner_of_k;
}

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
