// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_STRAIGHTENER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_STRAIGHTENER_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Band_search.h>

#include <algorithm>
#include <tuple>
#include <utility>
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

// The arcs in the order of their first halfedges. Time linear in the number of triangles; but for a
// look at each, in that of the seams.
inline Seam_arcs find_seam_arcs(const Refinable_seam_graph& graph)
{
  Seam_arcs result;
  const Halfedge_triangles& mesh = graph.mesh();
  std::vector<std::uint8_t> is_done(graph.seams().size(), 0);
  const auto trace = [&](Halfedge h) {
    std::vector<Halfedge> arc;
    const Vertex_index first = mesh.source(h);
    for(;; h = graph.next_seam(h)) {
      arc.push_back(h);
      mark(is_done, h);
      mark(is_done, mesh.opposite(h));
      if(mesh.target(h) == first || graph.is_node(mesh.target(h)))
        break;
    }
    result.arcs.push_back(std::move(arc));
  };
  const auto trace_all = [&](bool from_nodes) {
    for(std::uint32_t t = 0; t < is_done.size(); ++t)
      if(graph.seams()[t] != is_done[t])
        for(Halfedge h = 3 * t; h < 3 * t + 3; ++h)
          if(graph.is_seam(h) && !is_marked(is_done, h) && mesh.opposite(h) != no_halfedge
             && (!from_nodes || graph.is_node(mesh.source(h))))
            trace(h);
  };
  trace_all(true);
  trace_all(false);
  for(std::uint32_t a = 0; a < result.arcs.size(); ++a) {
    const Vertex_index first = mesh.source(result.arcs[a].front());
    const Vertex_index last = mesh.target(result.arcs[a].back());
    if(graph.is_node(first)) {
      result.ends.push_back({first, a, false});
      result.ends.push_back({last, a, true});
    }
  }
  std::sort(result.ends.begin(), result.ends.end(), [](const Arc_end& x, const Arc_end& y) {
    return std::tie(x.node, x.arc, x.is_last) < std::tie(y.node, y.arc, y.is_last);
  });
  return result;
}

// How the seams are pulled straight.
struct Straightening_reach
{
  int rings;          // how far a piece of a seam may move, in edges
  std::size_t window; // the length of a piece, in edges
  int first_round, end_round; // in odd ones pieces are shifted by half their length
};

// Makes the seams of a mesh shorter, piece by piece.
//
// Why all charts stay disks: a piece has a chart on each side. Without the piece the two are one
// disk, with the ends of the piece on its border; any other path between these ends, and through
// the sectors that were open to the piece, cuts it into two disks again. If the same chart is on
// both sides, the piece either joins the two borders of an annulus, as any other path would, or one
// of its ends is the end of the seam. For a junction of several seams the same holds in a band
// without holes.
class Seam_straightener
{
public:
  explicit Seam_straightener(Refinable_seam_graph& graph) : m_graph(graph), m_band(graph) {}

  // Straightens the seams between the triangles that the graph has at present.
  void run(const Straightening_reach& reach)
  {
    m_reach = reach;
    if(reach.first_round == reach.end_round)
      return;
    Seam_arcs arcs = find_seam_arcs(m_graph);
    for(int round = reach.first_round; round < reach.end_round; ++round) {
      for(Path& arc : arcs.arcs)
        straighten(arc, round);
      for(const Arc_end* first = arcs.ends.data(), *end = first + arcs.ends.size(); first != end;) {
        const Arc_end* last = first;
        while(last != end && last->node == first->node)
          ++last;
        slide(first, last, arcs.arcs);
        first = last;
      }
    }
  }

private:
  typedef Refinable_seam_graph::Length Length;
  typedef Band_search::Path Path;

  Vertex_index source(Halfedge h) const { return m_graph.mesh().source(h); }
  Vertex_index target(Halfedge h) const { return m_graph.mesh().target(h); }
  Halfedge opposite(Halfedge h) const { return m_graph.mesh().opposite(h); }

  Length length(const Path& path) const
  {
    Length sum = 0;
    for(const Halfedge h : path)
      sum += m_graph.length(h);
    return sum;
  }
  void add(const Path& path)
  {
    for(const Halfedge h : path)
      m_graph.add_seam(h);
  }
  void remove(const Path& path)
  {
    for(const Halfedge h : path)
      m_graph.remove_seam(h);
  }
  void add_seeds(const Path& path)
  {
    for(std::size_t i = 1; i < path.size(); ++i)
      m_band.add_seed(source(path[i]));
  }

  void straighten(Path& arc, int round);
  void retrace(Path& piece);
  void slide(const Arc_end* first, const Arc_end* last, std::vector<Path>& arcs);
  void slide_on_border(const Arc_end& end, Path& arc);
  void slide_inside(const Arc_end* first, const Arc_end* last, std::vector<Path>& arcs);
  bool meet_at_ends_only(const std::vector<Path>& paths) const;
  Path tail(const Path& arc, bool is_last, std::size_t length) const;
  void replace_tail(Path& arc, bool is_last, std::size_t length, const Path& tail) const;

  Refinable_seam_graph& m_graph;
  Band_search m_band;
  Band_search::Paths m_paths;
  Straightening_reach m_reach = {};
};

// Retraces an arc piece by piece; where the pieces end changes from round to round.
inline void Seam_straightener::straighten(Path& arc, int round)
{
  const bool is_closed = source(arc.front()) == target(arc.back());
  const std::size_t window = is_closed ? (std::min)(m_reach.window, arc.size() / 2)
                                       : (std::min)(m_reach.window, arc.size());
  if(window < 2)
    return;
  const std::size_t half = window / 2;
  if(is_closed && round % 2 == 1 && !m_graph.is_node(source(arc.front())))
    std::rotate(arc.begin(), arc.begin() + std::ptrdiff_t(half), arc.end());
  Path result;
  for(std::size_t begin = 0, end; begin < arc.size(); begin = end) {
    end = (std::min)(arc.size(), begin + (begin == 0 && round % 2 == 1 ? half : window));
    Path piece(arc.begin() + std::ptrdiff_t(begin), arc.begin() + std::ptrdiff_t(end));
    retrace(piece);
    result.insert(result.end(), piece.begin(), piece.end());
  }
  arc.swap(result);
}

// Replaces a piece of an arc by the shortest path between its ends.
inline void Seam_straightener::retrace(Path& piece)
{
  if(piece.size() < 2)
    return;
  const Vertex_index p = source(piece.front()), q = target(piece.back());
  const Length old_length = length(piece);
  remove(piece);
  m_band.clear();
  m_band.add_end(piece.front());
  m_band.add_end(opposite(piece.back()));
  add_seeds(piece);
  m_band.grow(m_reach.rings);
  m_band.search(0, 1, old_length - 1, m_paths);
  if(m_band.length(m_paths, q) < old_length) {
    Path path = m_band.path_to(m_paths, q);
    // A seam of a single edge would cut nothing open
    if(path.size() > 1 || m_graph.degree(p) > 0 || m_graph.degree(q) > 0)
      piece.swap(path);
  }
  add(piece);
}

inline void Seam_straightener::slide(const Arc_end* first, const Arc_end* last,
                                     std::vector<Path>& arcs)
{
  const Arc_end& end = *first;
  const Path& arc = arcs[end.arc];
  const Vertex_index node = end.is_last ? target(arc.back()) : source(arc.front());
  const std::uint32_t degree = std::uint32_t(last - first);
  if(m_graph.is_pinned(node))
    return;
  if(m_graph.is_on_border(node)) {
    if(degree == 1 && m_graph.degree(node) == 3)
      slide_on_border(end, arcs[end.arc]);
  } else if(degree >= 3 && degree == m_graph.degree(node)) {
    slide_inside(first, last, arcs);
  }
}

// The last edges of an arc, toward its end.
inline Band_search::Path Seam_straightener::tail(const Path& arc, bool is_last,
                                                 std::size_t length) const
{
  Path result;
  for(std::size_t i = length; i-- > 0;)
    result.push_back(is_last ? arc[arc.size() - 1 - i] : opposite(arc[i]));
  return result;
}

inline void Seam_straightener::replace_tail(Path& arc, bool is_last, std::size_t length,
                                            const Path& tail) const
{
  if(is_last) {
    arc.resize(arc.size() - length);
    arc.insert(arc.end(), tail.begin(), tail.end());
    return;
  }
  Path result;
  for(std::size_t i = tail.size(); i-- > 0;)
    result.push_back(opposite(tail[i]));
  result.insert(result.end(), arc.begin() + std::ptrdiff_t(length), arc.end());
  arc.swap(result);
}

// Lets an arc end at that place on the border of the surface which makes it shortest.
inline void Seam_straightener::slide_on_border(const Arc_end& end, Path& arc)
{
  const std::size_t number = (std::min)(arc.size() - 1, std::size_t(m_reach.rings) + 2);
  if(number < 2)
    return;
  const Path old = tail(arc, end.is_last, number);
  const Length old_length = length(old);
  remove(old);
  m_band.clear();
  m_band.add_end(old.front());
  add_seeds(old);
  m_band.add_border(target(old.back()), m_reach.rings);
  m_band.grow(m_reach.rings);
  Vertex_index best = no_vertex;
  if(m_band.is_contractible()) {
    m_band.search(0, -1, old_length - 1, m_paths);
    for(const Vertex_index v : m_band.vertices())
      if(m_graph.is_on_border(v) && !m_band.is_end(v) && m_band.length(m_paths, v) < old_length
         && (best == no_vertex || m_band.length(m_paths, v) < m_band.length(m_paths, best)))
        best = v;
  }
  if(best == no_vertex) {
    add(old);
    return;
  }
  const Path path = m_band.path_to(m_paths, best);
  add(path);
  replace_tail(arc, end.is_last, number, path);
}

// Moves a junction to where the sum of the shortest paths to it is least.
inline void Seam_straightener::slide_inside(const Arc_end* first, const Arc_end* last,
                                            std::vector<Path>& arcs)
{
  std::vector<Path> old;
  std::vector<Vertex_index> far;
  Length old_length = 0;
  for(const Arc_end* e = first; e != last; ++e) {
    const Path& arc = arcs[e->arc];
    old.push_back(tail(arc, e->is_last, (std::min)(arc.size(), std::size_t(m_reach.rings) + 2)));
    far.push_back(source(old.back().front()));
    old_length += length(old.back());
  }
  const Vertex_index node = target(old.front().back());
  for(const Arc_end* e = first; e + 1 != last; ++e)
    if(e->arc == e[1].arc && arcs[e->arc].size() < 2 * std::size_t(m_reach.rings + 2))
      return; // the loop is too short
  std::vector<Vertex_index> sorted = far;
  sorted.push_back(node);
  std::sort(sorted.begin(), sorted.end());
  if(std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    return; // two arcs have the same ends
  for(const Path& path : old)
    remove(path);
  m_band.clear();
  for(const Path& path : old)
    m_band.add_end(path.front());
  m_band.add_seed(node);
  for(const Path& path : old)
    add_seeds(path);
  m_band.grow(m_reach.rings);
  std::vector<Band_search::Paths> paths(old.size());
  Vertex_index best = no_vertex;
  Length best_length = old_length;
  if(m_band.is_contractible()) {
    for(std::size_t i = 0; i < old.size(); ++i)
      m_band.search(int(i), -1, old_length - 1, paths[i]);
    for(const Vertex_index v : m_band.vertices()) {
      Length sum = 0;
      for(std::size_t i = 0; i < old.size() && sum < best_length; ++i) {
        const Length length = m_band.length(paths[i], v);
        sum = length == Band_search::no_length ? best_length : sum + length;
      }
      if(!m_band.is_end(v) && sum < best_length) {
        best = v;
        best_length = sum;
      }
    }
  }
  std::vector<Path> shorter;
  for(std::size_t i = 0; i < old.size() && best != no_vertex; ++i)
    shorter.push_back(m_band.path_to(paths[i], best));
  if(!meet_at_ends_only(shorter))
    best = no_vertex;
  for(std::size_t i = 0; i < old.size(); ++i) {
    add(best == no_vertex ? old[i] : shorter[i]);
    if(best != no_vertex)
      replace_tail(arcs[first[i].arc], first[i].is_last, old[i].size(), shorter[i]);
  }
}

// Whether paths to the same vertex have no other one in common. For three shortest paths to the
// best vertex that is so; more may go the last edges in pairs.
inline bool Seam_straightener::meet_at_ends_only(const std::vector<Path>& paths) const
{
  std::vector<Vertex_index> sources;
  for(const Path& path : paths)
    for(const Halfedge h : path)
      sources.push_back(source(h));
  std::sort(sources.begin(), sources.end());
  return std::adjacent_find(sources.begin(), sources.end()) == sources.end();
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_STRAIGHTENER_H
