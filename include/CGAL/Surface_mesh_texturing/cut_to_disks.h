// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H
#define CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/chart_topology.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_straightener.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `cut_to_disks()`.
struct Disk_cut_options
{
  /// The number of extremities, vertices far from each other, that the cut of a closed chart goes
  /// to at most: the tips of limbs, which would be tiny in the plane otherwise.
  std::size_t extremities = 8;
  /// The distance of an extremity from the cut, as a part of that of the first, below which no more
  /// are added.
  double least_distance = 0.3;
  /// What is taken to be short.
  Crease_weights creases;
};

namespace internal {

// Cuts one connected manifold mesh to a disk.
//
// Loops of handles, and paths between borders: with the forest of the shortest paths to the
// borders, or to one vertex, those edges that neither the forest nor a spanning tree of the
// triangles across the other edges has, each with the paths from its ends, are the cut; the
// spanning tree takes the edges with the longest paths (Erickson and Whittlesey 2005, "Greedy
// optimal homotopy and homology generators").
class Disk_cutter
{
public:
  // `avoided`: see Refinable_seam_graph::avoid()
  Disk_cutter(const Indexed_triangle_mesh& mesh, const Disk_cut_options& options,
              std::vector<std::uint8_t> avoided = {});

  // Returns the seams of each triangle.
  std::vector<std::uint8_t> cut();

private:
  typedef Refinable_seam_graph::Length Length;

  struct Forest
  {
    std::vector<Length> distance;
    std::vector<Halfedge> arrival;
  };

  static constexpr Length far = (std::numeric_limits<Length>::max)();

  static Crease_weights plain_weights()
  {
    Crease_weights result;
    result.crease_length = 1.;
    return result;
  }

  Length plain_length(Halfedge h) const
  {
    return m_plain.length(m_graph.mesh().source(h), m_graph.mesh().target(h));
  }

  template <class EdgeLength, class IsGoal>
  Forest shortest_paths(const std::vector<Vertex_index>& sources, const EdgeLength& length,
                        const IsGoal& is_goal, Vertex_index* goal = nullptr) const;
  std::vector<Vertex_index> seam_vertices() const;
  Vertex_index farthest(const std::vector<Vertex_index>& sources, Length& distance) const;
  void add_generators();
  std::size_t add_path(const Forest& forest, Vertex_index v);
  void prune();
  void add_extremities();

  Disk_cut_options m_options;
  Halfedge_triangles m_mesh;
  Refinable_seam_graph m_graph;
  Crease_metric m_plain;
  bool m_is_closed = true;
};

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

CGAL_HLSCM_INLINE Disk_cutter::Disk_cutter(const Indexed_triangle_mesh& mesh,
                                           const Disk_cut_options& options,
                                           std::vector<std::uint8_t> avoided)
  : m_options(options), m_mesh(mesh.triangles, mesh.points.size())
  , m_graph(m_mesh, mesh.points, options.creases)
  , m_plain(mesh.points, plain_weights())
{
  m_graph.avoid(std::move(avoided));
  m_graph.set_seams(label_charts(m_mesh, std::vector<std::uint8_t>(mesh.triangles.size())).seams);
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    m_is_closed = m_is_closed && !m_graph.is_on_border(v);
}

CGAL_HLSCM_INLINE std::vector<std::uint8_t> Disk_cutter::cut()
{
  add_generators();
  Seam_straightener(m_graph).run({8, 48, 0, 4});
  if(m_is_closed)
    add_extremities();
  return m_graph.seams();
}

// The paths to the nearest sources, until the first goal.
template <class EdgeLength, class IsGoal>
Disk_cutter::Forest Disk_cutter::shortest_paths(const std::vector<Vertex_index>& sources,
                                                const EdgeLength& length, const IsGoal& is_goal,
                                                Vertex_index* goal) const
{
  typedef std::pair<Length, Vertex_index> Entry;
  const Halfedge_triangles& mesh = m_graph.mesh();
  Forest forest = {std::vector<Length>(mesh.number_of_vertices(), Length(far)),
                   std::vector<Halfedge>(mesh.number_of_vertices(), no_halfedge)};
  std::vector<Entry> heap;
  for(const Vertex_index s : sources) {
    forest.distance[s] = 0;
    heap.push_back({0, s});
  }
  std::make_heap(heap.begin(), heap.end(), std::greater<Entry>());
  const auto relax = [&](Length so_far, Halfedge h, Vertex_index to) {
    const Length sum = so_far + length(h);
    if(sum >= forest.distance[to])
      return;
    forest.distance[to] = sum;
    forest.arrival[to] = h;
    heap.push_back({sum, to});
    std::push_heap(heap.begin(), heap.end(), std::greater<Entry>());
  };
  while(!heap.empty()) {
    const Entry entry = heap.front();
    std::pop_heap(heap.begin(), heap.end(), std::greater<Entry>());
    heap.pop_back();
    if(entry.first > forest.distance[entry.second])
      continue;
    if(is_goal(entry.second)) {
      *goal = entry.second;
      break;
    }
    mesh.for_each_outgoing(mesh.outgoing(entry.second), [&](Halfedge h) {
      relax(entry.first, h, mesh.target(h));
      return true;
    });
  }
  return forest;
}

CGAL_HLSCM_INLINE std::vector<Vertex_index> Disk_cutter::seam_vertices() const
{
  std::vector<Vertex_index> result;
  for(Vertex_index v = 0; v < m_graph.mesh().number_of_vertices(); ++v)
    if(m_graph.degree(v) > 0)
      result.push_back(v);
  return result;
}

CGAL_HLSCM_INLINE Vertex_index Disk_cutter::farthest(const std::vector<Vertex_index>& sources,
                                                     Length& distance) const
{
  const Forest forest = shortest_paths(sources, [this](Halfedge h) { return plain_length(h); },
                                       [](Vertex_index) { return false; });
  Vertex_index best = sources.front();
  for(Vertex_index v = 0; v < forest.distance.size(); ++v)
    if(forest.distance[v] != far && forest.distance[v] > forest.distance[best])
      best = v;
  distance = forest.distance[best];
  return best;
}

// Adds the path from a source of the forest to v; returns the number of edges that are new.
CGAL_HLSCM_INLINE std::size_t Disk_cutter::add_path(const Forest& forest, Vertex_index v)
{
  std::size_t number = 0;
  while(forest.arrival[v] != no_halfedge) {
    const Halfedge h = forest.arrival[v];
    if(!m_graph.is_seam(h)) {
      m_graph.add_seam(h);
      ++number;
    }
    v = m_graph.mesh().source(h);
  }
  return number;
}

CGAL_HLSCM_INLINE void Disk_cutter::add_generators()
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  std::vector<Vertex_index> sources = seam_vertices();
  Length distance = 0;
  if(sources.empty())
    sources.push_back(farthest({0}, distance));
  const Forest forest = shortest_paths(sources, [this](Halfedge h) { return m_graph.length(h); },
                                       [](Vertex_index) { return false; });
  std::vector<std::pair<Length, Halfedge>> edges;
  for(Halfedge h = 0; h < mesh.number_of_halfedges(); ++h) {
    const Halfedge o = mesh.opposite(h);
    const Vertex_index v = mesh.source(h), w = mesh.target(h);
    if(o == no_halfedge || o < h)
      continue;
    if(forest.arrival[w] != h && forest.arrival[w] != o && forest.arrival[v] != h
       && forest.arrival[v] != o)
      edges.push_back({forest.distance[v] + forest.distance[w] + m_graph.length(h), h});
  }
  std::sort(edges.begin(), edges.end(), std::greater<std::pair<Length, Halfedge>>());
  Disjoint_sets sets(mesh.number_of_halfedges() / 3);
  for(const auto& edge : edges) {
    const Halfedge h = edge.second;
    if(sets.join(triangle_of(h), triangle_of(mesh.opposite(h))))
      continue;
    m_graph.add_seam(h);
    add_path(forest, mesh.source(h));
    add_path(forest, mesh.target(h));
  }
  prune();
}

// Removes seams that end inside the surface, edge by edge.
CGAL_HLSCM_INLINE void Disk_cutter::prune()
{
  const Halfedge_triangles& mesh = m_graph.mesh();
  for(Vertex_index first = 0; first < mesh.number_of_vertices(); ++first)
    for(Vertex_index v = first; m_graph.degree(v) == 1;) {
      Halfedge last = no_halfedge;
      mesh.for_each_outgoing(mesh.outgoing(v), [&](Halfedge h) {
        last = h;
        return !m_graph.is_seam(h);
      });
      m_graph.remove_seam(last);
      v = mesh.target(last);
    }
}

CGAL_HLSCM_INLINE void Disk_cutter::add_extremities()
{
  std::vector<Vertex_index> cut = seam_vertices();
  std::size_t number = 0, edges = cut.size();
  Length first_distance = 0, distance = 0;
  if(cut.empty()) {
    cut.push_back(farthest({0}, distance));
    ++number;
  }
  std::vector<char> is_cut(m_graph.mesh().number_of_vertices(), 0);
  for(const Vertex_index v : cut)
    is_cut[v] = 1;
  for(; number < m_options.extremities || edges < 2; ++number) {
    const Vertex_index extremity = farthest(cut, distance);
    first_distance = first_distance == 0 ? distance : first_distance;
    if(edges >= 2 && double(distance) < m_options.least_distance * double(first_distance))
      break;
    Vertex_index goal = no_vertex;
    const Forest forest
      = shortest_paths({extremity}, [this](Halfedge h) { return m_graph.length(h); },
                       [&](Vertex_index v) { return is_cut[v] != 0; }, &goal);
    edges += add_path(forest, goal);
    for(const Vertex_index v : seam_vertices())
      is_cut[v] = 1;
    cut = seam_vertices();
  }
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

// Cuts charts for which `needs_cut(topology)` to disks. Mesh and charts have been checked; `avoided`
// may be empty, see Refinable_seam_graph::avoid().
template <class NeedsCut>
Face_charts cut_charts(const Indexed_triangle_mesh& mesh, const Triangle_adjacency& adjacency,
                       Face_charts charts, const Disk_cut_options& options,
                       const std::vector<std::uint8_t>& avoided, const NeedsCut& needs_cut)
{
  charts.seams = without_lonely_seams(adjacency, std::move(charts.seams));
  const std::vector<Chart_topology> topologies = chart_topologies(adjacency, charts);
  if(std::none_of(topologies.begin(), topologies.end(), needs_cut))
    return charts;
  const std::vector<Chart_mesh> meshes = cut_out_charts(mesh, adjacency, charts);
  for(std::size_t c = 0; c < meshes.size(); ++c) {
    if(!needs_cut(topologies[c]))
      continue;
    const std::vector<std::uint8_t> seams
      = Disk_cutter(meshes[c].mesh, options, meshes[c].entries_of(avoided)).cut();
    for(std::size_t t = 0; t < seams.size(); ++t)
      charts.seams[meshes[c].triangles[t]] |= seams[t];
  }
  return charts;
}

// The mesh as the only chart, uncut, with its own numbers.
inline Chart_mesh whole_as_chart(const Indexed_triangle_mesh& mesh)
{
  Chart_mesh result;
  result.mesh = mesh;
  result.vertices.resize(mesh.points.size());
  result.triangles.resize(mesh.triangles.size());
  std::iota(result.vertices.begin(), result.vertices.end(), Vertex_index(0));
  std::iota(result.triangles.begin(), result.triangles.end(), Triangle_index(0));
  return result;
}

// As the public one.
inline Face_charts cut_to_disks(const Indexed_triangle_mesh& mesh,
                                const Triangle_adjacency& adjacency, Face_charts charts,
                                const Disk_cut_options& options,
                                const std::vector<std::uint8_t>& avoided)
{
  return cut_charts(mesh, adjacency, std::move(charts), options, avoided,
                    [](const Chart_topology& topology) { return !topology.is_disk(); });
}

// None if the charts are not those of the mesh.
inline Face_charts checked_disks(const Indexed_triangle_mesh& mesh,
                                 const Triangle_adjacency& adjacency, Face_charts charts,
                                 const Disk_cut_options& options)
{
  if(!adjacency_error(mesh.triangles.size(), adjacency, charts).is_ok())
    return {};
  return cut_to_disks(mesh, adjacency, std::move(charts), options, {});
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns `charts` with seams added within those charts that are no disks, until all are. Seams are
short and prefer creases, concave ones above all. A chart with several borders gets seams between
them, a chart with handles seams along these, and a closed chart a tree of seams to its extremities.

Any surface that `Face_charts` can describe will do; if there is a `charts_error()` there are no
charts. Time \f$ O(n \log n) \f$ for the charts that are no disks, linear for the others.
*/
inline Face_charts cut_to_disks(const Indexed_triangle_mesh& mesh, Face_charts charts,
                                const Disk_cut_options& options = Disk_cut_options())
{
  if(!surface_error(mesh).empty())
    return {};
  return internal::checked_disks(mesh, Indexed_mesh::Triangle_adjacency(mesh.triangles),
                                 std::move(charts), options);
}

/*!
\ingroup PkgHLSCMTexturing

Returns the charts between seams, marked as in `Face_charts::seams`, each cut to one disk as by
`cut_to_disks()`. None if there is a `charts_error()`.
*/
inline Face_charts disks_between(const Indexed_triangle_mesh& mesh, std::vector<std::uint8_t> seams,
                                 const Disk_cut_options& options = Disk_cut_options())
{
  if(!surface_error(mesh).empty() || seams.size() != mesh.triangles.size())
    return {};
  const Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  return internal::checked_disks(mesh, adjacency, charts_between(adjacency, std::move(seams)),
                                 options);
}

/*!
\ingroup PkgHLSCMTexturing

Returns the connected components of `mesh` as charts, each cut to one disk. On a mesh of many
triangles it is faster to cut a coarse one and to refine the cut; see `segment_coarse_to_fine()`. None
if there is a `charts_error()`.
*/
inline Face_charts one_disk_per_component(const Indexed_triangle_mesh& mesh,
                                          const Disk_cut_options& options = Disk_cut_options())
{
  return disks_between(mesh, std::vector<std::uint8_t>(mesh.triangles.size()), options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CUT_TO_DISKS_H
