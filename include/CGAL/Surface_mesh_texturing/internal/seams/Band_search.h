// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_BAND_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_BAND_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/seams/Refinable_seam_graph.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Shortest paths in a band of a few edges around a piece of a seam graph that was taken away.
//
// The band is made of vertices without seams and of its *ends*, which may have some. Paths go from
// end to end through vertices without seams, and leave and reach an end within its *sector*: the
// edges around it, between two seams, among which was the seam that was taken away.
class Band_search
{
public:
  typedef Refinable_seam_graph::Length Length;
  typedef std::vector<Halfedge> Path;

  static constexpr Length no_length = (std::numeric_limits<Length>::max)();

  explicit Band_search(const Refinable_seam_graph& graph)
    : m_graph(graph), m_place(graph.mesh().number_of_vertices(), {0, 0})
  {}

  // Begins a new band.
  void clear()
  {
    ++m_band_number;
    m_band.clear();
    m_ends.clear();
  }

  // Adds an end whose sector has the edge of `outgoing`, a halfedge from it.
  void add_end(Halfedge outgoing)
  {
    End end = {m_graph.mesh().source(outgoing), {}};
    add(end.vertex);
    for_each_in_sector(outgoing, [&](Halfedge h) { end.sector.push_back(h); });
    m_ends.push_back(std::move(end));
  }

  // Adds a vertex where the band begins.
  void add_seed(Vertex_index v) { add(v); }

  // Adds the vertices up to `rings` edges along the border of the surface on both sides of v, as
  // far as no other seams end there. Paths may end at these.
  void add_border(Vertex_index v, int rings);

  // Grows the band by `rings` edges from its seeds through vertices without seams.
  void grow(int rings);

  const std::vector<Vertex_index>& vertices() const { return m_band; }

  bool is_end(Vertex_index v) const
  {
    return std::any_of(m_ends.begin(), m_ends.end(), [v](const End& e) { return e.vertex == v; });
  }

  // Whether the triangles and edges between vertices of the band make up something without holes,
  // in which all paths between the same ends are as good as each other.
  bool is_contractible() const;

  // Shortest paths from an end; of length at most `bound`. Stops at the end `to` if that is not -1.
  struct Paths
  {
    std::vector<Length> length;    // of each vertex of the band
    std::vector<Halfedge> arrival; // the last halfedge
  };
  void search(int from, int to, Length bound, Paths& paths);

  Length length(const Paths& paths, Vertex_index v) const
  {
    return paths.length[m_place[v].index];
  }

  // The path to v.
  Path path_to(const Paths& paths, Vertex_index v) const
  {
    Path path;
    for(Halfedge h = paths.arrival[m_place[v].index]; h != no_halfedge;
        h = paths.arrival[m_place[m_graph.mesh().source(h)].index])
      path.push_back(h);
    std::reverse(path.begin(), path.end());
    return path;
  }

private:
  struct End
  {
    Vertex_index vertex;
    std::vector<Halfedge> sector; // outgoing
  };

  struct Place
  {
    std::uint32_t band, index; // the number of the last band with the vertex, and its index there
  };

  bool has(Vertex_index v) const { return m_place[v].band == m_band_number; }

  void add(Vertex_index v)
  {
    if(has(v))
      return;
    m_place[v] = {m_band_number, std::uint32_t(m_band.size())};
    m_band.push_back(v);
  }

  template <class Use>
  void for_each_in_sector(Halfedge outgoing, const Use& use) const;
  template <class Use>
  void for_each_neighbor(Vertex_index v, const Use& use) const;
  bool is_arrival(const End& end, Halfedge h) const
  {
    return std::find(end.sector.begin(), end.sector.end(), m_graph.mesh().opposite(h))
           != end.sector.end();
  }
  void relax(Halfedge h, Length so_far, Length bound, const End* to, Paths& paths);

  const Refinable_seam_graph& m_graph;
  std::vector<Place> m_place; // of each vertex
  std::uint32_t m_band_number = 0;
  std::vector<Vertex_index> m_band;
  std::vector<End> m_ends;
  typedef std::pair<Length, Vertex_index> Entry;
  std::vector<Entry> m_heap;
};

template <class Use>
void Band_search::for_each_in_sector(Halfedge outgoing, const Use& use) const
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  Halfedge h = outgoing;
  do {
    use(h);
    h = mesh.counterclockwise(h);
  } while(h != no_halfedge && h != outgoing && !m_graph.is_seam(h));
  if(h == outgoing)
    return;
  for(h = mesh.clockwise(outgoing); h != no_halfedge && !m_graph.is_seam(h);
      h = mesh.clockwise(h))
    use(h);
}

template <class Use>
void Band_search::for_each_neighbor(Vertex_index v, const Use& use) const
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  mesh.for_each_outgoing(mesh.outgoing(v), [&](Halfedge h) {
    use(mesh.target(h));
    return true;
  });
}

inline void Band_search::add_border(Vertex_index v, int rings)
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  Halfedge first = mesh.outgoing(v);
  while(mesh.opposite(first) != no_halfedge)
    first = mesh.clockwise(first);
  add(v);
  Halfedge h = first;
  for(int i = 0; i < rings && m_graph.degree(mesh.target(h)) == 2; ++i) {
    add(mesh.target(h));
    for(h = next_halfedge(h); mesh.opposite(h) != no_halfedge;)
      h = next_halfedge(mesh.opposite(h));
  }
  h = first;
  for(int i = 0; i < rings; ++i) {
    for(h = previous_halfedge(h); mesh.opposite(h) != no_halfedge;)
      h = previous_halfedge(mesh.opposite(h));
    if(m_graph.degree(mesh.source(h)) != 2)
      break;
    add(mesh.source(h));
  }
}

inline void Band_search::grow(int rings)
{
  std::size_t begin = 0;
  for(int ring = 0; ring < rings; ++ring) {
    const std::size_t end = m_band.size();
    for(; begin < end; ++begin) {
      const Vertex_index v = m_band[begin];
      if(is_end(v) || m_graph.is_on_border(v))
        continue;
      for_each_neighbor(v, [&](Vertex_index w) {
        if(m_graph.degree(w) == 0)
          add(w);
      });
    }
  }
}

inline bool Band_search::is_contractible() const
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  // Connected by construction; so its Euler characteristic decides. Seams that are left, which no
  // path may cross, are no part of it, nor are the triangles at them
  long twice_edges = 0, triangles = 0;
  const auto is_open = [&](Halfedge h) { return !m_graph.is_seam(h); };
  for(const Vertex_index v : m_band)
    mesh.for_each_outgoing(mesh.outgoing(v), [&](Halfedge h) {
      const bool has_target = has(mesh.target(h));
      twice_edges += has_target && is_open(h) ? 1 : 0;
      triangles += has_target && has(mesh.source(previous_halfedge(h))) && is_open(h)
                   && is_open(next_halfedge(h)) && is_open(previous_halfedge(h)) ? 1 : 0;
      return true;
    });
  return long(m_band.size()) - twice_edges / 2 + triangles / 3 == 1;
}

inline void Band_search::relax(Halfedge h, Length so_far, Length bound, const End* to,
                               Paths& paths)
{
  const Vertex_index w = m_graph.mesh().target(h);
  if(!has(w) || (m_graph.degree(w) > 0 && !m_graph.is_on_border(w) && !is_end(w)))
    return;
  if(is_end(w) && (to == nullptr || to->vertex != w || !is_arrival(*to, h)))
    return;
  const std::uint32_t i = m_place[w].index;
  if(so_far >= paths.length[i])
    return;
  const Length length = so_far + m_graph.length(h);
  if(length >= paths.length[i] || length > bound)
    return;
  paths.length[i] = length;
  paths.arrival[i] = h;
  m_heap.push_back({length, w});
  std::push_heap(m_heap.begin(), m_heap.end(), std::greater<Entry>());
}

inline void Band_search::search(int from, int to, Length bound, Paths& paths)
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  const End* const target = to < 0 ? nullptr : &m_ends[to];
  paths.length.assign(m_band.size(), Length(no_length));
  paths.arrival.assign(m_band.size(), no_halfedge);
  m_heap.clear();
  const Vertex_index source = m_ends[from].vertex;
  paths.length[m_place[source].index] = 0;
  for(const Halfedge h : m_ends[from].sector)
    relax(h, 0, bound, target, paths);
  while(!m_heap.empty()) {
    const Entry entry = m_heap.front();
    std::pop_heap(m_heap.begin(), m_heap.end(), std::greater<Entry>());
    m_heap.pop_back();
    const Vertex_index v = entry.second;
    if(entry.first > paths.length[m_place[v].index])
      continue;
    if(target != nullptr && target->vertex == v)
      return;
    if(is_end(v) || m_graph.is_on_border(v)) // where paths end
      continue;
    mesh.for_each_outgoing(mesh.outgoing(v), [&](Halfedge h) {
      relax(h, entry.first, bound, target, paths);
      return true;
    });
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_BAND_SEARCH_H
